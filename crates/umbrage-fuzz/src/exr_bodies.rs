//! Shadow maps, deep maps and maps of facets from any bytes.

use crate::exr_seeds::{CODERS, tile_packed_by};
use crate::promises::{assert_line, most_bytes};
use umbrage_depth::{DepthMap, Map};
use umbrage_io::{
    Fault, decode_deep_map, decode_facet_map, decode_map, decode_shadow_map, encode_deep_map, encode_facet_map,
    encode_shadow_map,
};

/// Maps of more texels are not written again: that would take the time of thousands of small files.
const MOST_WRITTEN_AGAIN: u32 = 4096;

/// Texels that may be read from a file, as the `umbrage` command counts them: 64 bytes each.
pub(crate) fn most_texels(file: &[u8]) -> u64 {
    most_bytes(file) / 64
}

/// Checks what a reader made of a file: an error is one line, and a map has no more texels than were allowed and, if it is small, is the
/// same after it was written `again`. Whether it is a map.
///
/// # Panics
/// When it is not so.
fn holds<M: DepthMap>(read: Result<M, Fault>, file: &[u8], again: impl FnOnce(&M) -> bool) -> bool {
    match read {
        Err(fault) => {
            assert_line(fault);
            false
        }
        Ok(map) => {
            let size = map.view().size();
            assert!(u64::from(size.x) * u64::from(size.y) <= most_texels(file), "{size}");
            assert!(size.x * size.y > MOST_WRITTEN_AGAIN || again(&map), "another map after it was written");
            true
        }
    }
}

/// Reads bytes as a map of any kind, and as a map of depths alone. Whether they are either.
///
/// # Panics
/// When an error is longer than one line, more is read than was allowed, or a map changes by being written and read again.
pub fn exr_header(file: &[u8]) -> bool {
    let most = most_texels(file);
    let depths = holds(decode_shadow_map(file, most), file, |map| {
        decode_shadow_map(&encode_shadow_map(map).expect("written"), most).as_ref() == Ok(map)
    });
    let whole = holds(decode_map(file, most), file, |map| match map {
        Map::Facets(map) => {
            decode_facet_map(&encode_facet_map(map).expect("written"), most).is_ok_and(|again| again == **map)
        }
        _ => true,
    });
    depths || whole
}

/// Reads bytes as the packed samples of the one tile of a map of 8 × 8 texels, whose header is sound. The first byte chooses the coder.
/// Whether it is a map.
///
/// # Panics
/// As [`exr_header`].
pub fn exr_blocks(data: &[u8]) -> bool {
    let Some((coder, packed)) = data.split_first() else { return false };
    exr_header(&tile_packed_by(CODERS[usize::from(*coder) % CODERS.len()].0, packed))
}

/// Reads bytes as a deep map. Whether they are one.
///
/// # Panics
/// As [`exr_header`].
pub fn deep_exr(file: &[u8]) -> bool {
    let most = most_texels(file);
    holds(decode_deep_map(file, most), file, |map| {
        decode_deep_map(&encode_deep_map(map).expect("written"), most).as_ref() == Ok(map)
    })
}
