//! Depth maps as EXR files (Reeves 1987).
//!
//! One part, tiled 64 × 64, ZIP, one channel `Z` of 32-bit floats, one level. The display window is the map, the data
//! window the box around its finite depths; texels outside it are +∞. Attributes: `worldToCamera` (left-handed, +z ahead, as
//! OpenEXR has it), `worldToNDC` ((0, 0) upper left to (1, 1) lower right), `near`, `far`, `textureformat = "Shadow"`, and in
//! `comments` the view in full precision, the data window where it is not the whole map, and a digest of view and depths, by which
//! damage is noticed. Files without `comments` are read from the matrices. A tool that fills a file of ours up to its display window,
//! as `maketx --shadow` does with 0, leaves the same map: what `comments` says was not written is +∞. Tools that change depths must
//! drop `comments` and `software`.
//!
//! A file may have a second part, named `facets`, which is not looked at here: the file of a map of facets is a shadow map too. Files of
//! several maps are those of [`write_maps`](crate::write_maps).

mod channel;
mod file;
mod found;
mod layout;
mod matrices;
mod nearest;
mod parts;
mod read;
mod rows;
mod text;
mod words;
mod write;

use crate::error::{Fault, IoError};
use crate::file::read_bytes;
use crate::map_options::DEFAULT_BUDGET;
use crate::write_file::write_bytes;
use std::path::Path;
use umbrage_depth::{DepthMap, Raw};

pub(crate) use channel::{Channel, place};
pub(crate) use file::{Part, encode as encode_parts};
pub(crate) use found::{Found, facets_of, found, only};
pub(crate) use layout::{Layout, MOST_BYTES_PER_BYTE};
pub(crate) use nearest::Nearest;
pub(crate) use parts::Parts;
pub(crate) use read::{Preface, check_digest, depths, flat};
pub use rows::{TileRows, write_shadow_map_by_rows};
pub(crate) use text::{Head, digest, of_map as comments, value};
pub(crate) use words::{NAME as FACETS, SIGNATURE as FACETS_SIGNATURE, WordPart, words_part};
pub(crate) use write::{About, encode, part, stored_window};

/// A shadow map's file as bytes; the same bytes for the same map, whatever its storage. Of a deep map and of one of facets that
/// is the depths alone: [`encode_deep_map`](crate::encode_deep_map) and [`encode_facet_map`](crate::encode_facet_map) keep the rest.
///
/// # Errors
/// A [`Fault`] when the coder refuses; no map that can be made is known to bring that about.
pub fn encode_shadow_map(map: &impl DepthMap) -> Result<Vec<u8>, Fault> {
    encode(map)
}

/// Writes a map's file, as a whole or not at all (Reeves 1987); the depths alone, as [`encode_shadow_map`] does.
///
/// # Errors
/// [`IoError`], when the system refuses.
pub fn write_shadow_map(path: &Path, map: &impl DepthMap) -> Result<(), IoError> {
    write_bytes(path, &encode_shadow_map(map).map_err(|fault| fault.in_file(path))?)
}

/// Reads a map: depths, view and stored surface equal those that were written bit for bit (Reeves 1987). Depths of 1e30 and more count as +∞.
///
/// The file of a map of facets is taken as the depths it holds. Files of other makers are taken when one of their parts has a channel `Z`, or
/// one that ends in `.Z`, of floats of 16 or 32 bits, stored without loss, and says where the light stands: `worldToCamera` (or `worldtocamera`, `Nl`), `worldToNDC` (or `worldtoscreen`, `NP`; −1 to 1 with y up is understood), and `near` and `far`, if
/// they do not follow from the second. Their depths are axial, their texels sampled at the centre, and what lies outside is lit.
///
/// # Errors
/// [`IoError`]: one line with the file, the field and its value, when the system refuses or the file is damaged, hostile, too large
/// ([`DEFAULT_BUDGET`]) or no shadow map.
pub fn read_shadow_map(path: &Path) -> Result<Raw, IoError> {
    read_shadow_map_within(path, DEFAULT_BUDGET)
}

/// As [`read_shadow_map`], for maps of at most `most_texels` texels.
///
/// # Errors
/// As [`read_shadow_map`].
pub fn read_shadow_map_within(path: &Path, most_texels: u64) -> Result<Raw, IoError> {
    // Stored without loss, a texel takes four bytes at most; the rest is header, offset table and what a coder adds. The facets behind
    // the depths may take four times as much.
    let (depths, all) = (most_texels.saturating_mul(5), most_texels.saturating_mul(25));
    let most_bytes = depths.max(all.min(5 * DEFAULT_BUDGET)).saturating_add(1 << 20);
    decode_shadow_map(&read_bytes(path, most_bytes)?, most_texels).map_err(|fault| fault.in_file(path))
}

/// As [`read_shadow_map_within`], from bytes.
///
/// # Errors
/// A [`Fault`], when the bytes are not a shadow map of that size.
pub fn decode_shadow_map(bytes: &[u8], most_texels: u64) -> Result<Raw, Fault> {
    let parts = Parts::read(bytes, bytes.len() as u64, u64::MAX)?;
    let map = only(&parts)?;
    raw(&flat(&parts, map.part, None, None, most_texels, None)?, bytes)
}

/// The map of a part.
pub(crate) fn raw(file: &Preface<'_>, bytes: &[u8]) -> Result<Raw, Fault> {
    let map = Raw::new(file.view, depths(file, bytes)?).map_err(|error| Fault::new("channel Z", "no map", error))?;
    Ok(map.with_stored(file.stored))
}
