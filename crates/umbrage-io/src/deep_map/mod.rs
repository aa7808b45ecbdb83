//! Deep maps as deep EXR files (Burley 2006).
//!
//! One part, `deepscanline`, ZIPS, display and data window and the attributes of the view as in flat maps. A sample is a surface; those of a
//! texel ascend in depth. All channels are 32-bit floats:
//!
//! | channel | of a sample |
//! |---|---|
//! | `Z` | the depth |
//! | `A` | the opacity of this surface alone, to the mean of red, green and blue |
//! | `AR`, `AG`, `AB` | the same to one of them, as OpenEXR has it for coloured shadows; in coloured maps only |
//! | `passes.R`, `passes.G`, `passes.B` | what passes this surface and all before it; in coloured maps only |
//! | `passes.Y` | the same in grey maps |
//!
//! Compositing a texel's samples over `A`, or over `AR`, `AG`, `AB` each for itself, gives 1 − transmittance to within roundings.
//! Opacities do not keep every bit: next to 1 nothing is left of a small rest. `passes` does, and is what is read again; `A` to `AB` must
//! then belong to it. The bound of the map is in `epsilon`; view and digest are in `comments` as in flat maps.

mod columns;
mod content;
mod opacity;
mod packing;
mod read;
mod volumes;
mod write;

use crate::error::{Fault, IoError};
use crate::file::read_bytes;
use crate::map_options::MapOptions;
use crate::shadow_map::{About, Parts, encode_parts, only};
use crate::write_file::write_bytes;
use std::path::Path;
use umbrage_depth::DeepMap;

pub(crate) use read::deep;
pub(crate) use write::deep_part;

/// Most texels, and most steps of all texels together, that [`read_deep_map`] takes: 67,108,864, which is 1 GiB of steps.
pub const DEFAULT_DEEP_BUDGET: u64 = 1 << 26;

/// A deep map's file as bytes; the same bytes for the same map.
///
/// # Errors
/// A [`Fault`] when a row of texels takes more than 1 GiB.
pub fn encode_deep_map(map: &DeepMap) -> Result<Vec<u8>, Fault> {
    encode_parts(&[deep_part(map, About::only(map))?])
}

/// Writes a deep map's file, as a whole or not at all.
///
/// # Errors
/// [`IoError`], when the system refuses or a row of texels takes more than 1 GiB.
pub fn write_deep_map(path: &Path, map: &DeepMap) -> Result<(), IoError> {
    write_bytes(path, &encode_deep_map(map).map_err(|fault| fault.in_file(path))?)
}

/// Reads a deep map: view, bound and steps equal those that were written bit for bit (Burley 2006).
///
/// Files of other makers are taken when one of their parts is `deepscanline` with a channel `Z` of 32-bit floats, `A` or `AR`, `AG`, `AB`,
/// and has the four attributes of a flat map. Their samples come in any order; those at one depth are one surface. Depths of 1e30 and more
/// count as no surface. A sample whose `ZBack` lies behind its `Z` is a volume, which lets (1 − A)^f of the light through at the
/// fraction f of its thickness, as OpenEXR has it; volumes that overlap dim one another. A map keeps steps: those of a volume are never
/// farther from that than 2⁻¹¹. The bound of a map is the larger one of this, if it has volumes, and its attribute `epsilon`, 0 without one.
///
/// # Errors
/// [`IoError`]: one line with the file, the field and its value, when the system refuses or the file is damaged, hostile, too large
/// ([`DEFAULT_DEEP_BUDGET`]) or no deep map.
pub fn read_deep_map(path: &Path) -> Result<DeepMap, IoError> {
    read_deep_map_within(path, DEFAULT_DEEP_BUDGET)
}

/// As [`read_deep_map`], for maps of at most `most_steps` steps in all and at most as many texels.
///
/// # Errors
/// As [`read_deep_map`].
pub fn read_deep_map_within(path: &Path, most_steps: u64) -> Result<DeepMap, IoError> {
    // Without loss a texel takes four bytes at most, and a sample four for each of eight channels; the rest is for more channels of other
    // makers, header, offset table and what a coder adds.
    let most_bytes = most_steps.saturating_mul(48).saturating_add(1 << 20);
    decode_deep_map(&read_bytes(path, most_bytes)?, most_steps).map_err(|fault| fault.in_file(path))
}

/// As [`read_deep_map_within`], from bytes.
///
/// # Errors
/// A [`Fault`], when the bytes are not a deep map of that size.
pub fn decode_deep_map(bytes: &[u8], most_steps: u64) -> Result<DeepMap, Fault> {
    let parts = Parts::read(bytes, bytes.len() as u64, u64::MAX)?;
    let map = only(&parts)?;
    deep(&parts, map.part, bytes, &MapOptions::default().with_most_texels(most_steps)).map(|(map, _)| map)
}
