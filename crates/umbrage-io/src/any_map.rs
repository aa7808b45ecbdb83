//! Whatever map a file holds.

use crate::error::{Fault, IoError};
use crate::file::read_bytes;
use crate::{decode_deep_map, decode_facet_map, decode_shadow_map};
use std::path::Path;
use umbrage_depth::Map;

/// Bits of an EXR file's version field that say what the file is made of.
const DEEP: u32 = 1 << 11;
const SEVERAL_PARTS: u32 = 1 << 12;

/// Reads a map of any kind: one of facets where the file has a part of them, a deep one where its samples are deep, otherwise a shadow map.
/// It takes at most `most_texels` texels, or steps of a deep map.
///
/// # Errors
/// As [`read_shadow_map`](crate::read_shadow_map) of the kind that the file is of.
pub fn read_map(path: &Path, most_texels: u64) -> Result<Map, IoError> {
    let most_bytes = most_texels.saturating_mul(48).saturating_add(1 << 24);
    decode_map(&read_bytes(path, most_bytes)?, most_texels).map_err(|fault| fault.in_file(path))
}

/// As [`read_map`], from bytes.
///
/// # Errors
/// A [`Fault`], when the bytes are no map of that size.
pub fn decode_map(bytes: &[u8], most_texels: u64) -> Result<Map, Fault> {
    let word =
        |at: usize| bytes.get(at..at + 4).map_or(0, |word| u32::from_le_bytes([word[0], word[1], word[2], word[3]]));
    let version = word(4);
    if version & DEEP != 0 {
        return decode_deep_map(bytes, most_texels).map(Map::from);
    }
    if version & SEVERAL_PARTS != 0 {
        match decode_facet_map(bytes, most_texels) {
            // Parts of other makers.
            Err(fault) if fault.field == "parts" => {}
            read => return read.map(Map::from),
        }
    }
    decode_shadow_map(bytes, most_texels).map(Map::from)
}
