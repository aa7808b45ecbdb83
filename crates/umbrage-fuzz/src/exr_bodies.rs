//! Shadow maps, deep maps and maps of facets from any bytes.

use crate::exr_seeds::{CODERS, tile_packed_by};
use crate::promises::{assert_line, most_bytes};
use umbrage_depth::{DepthMap, Map};
use umbrage_io::{
    decode_deep_map, decode_facet_map, decode_map, decode_shadow_map, encode_deep_map, encode_facet_map,
    encode_shadow_map,
};

/// Maps of more texels are not written again: that would take the time of thousands of small files.
const MOST_WRITTEN_AGAIN: u32 = 4096;

/// Texels that may be read from a file, as the `umbrage` command counts them: 64 bytes each.
pub(crate) fn most_texels(file: &[u8]) -> u64 {
    most_bytes(file) / 64
}

/// Whether a map is small enough to be written and read again.
///
/// # Panics
/// When it has more texels than were allowed.
fn is_small(map: &impl DepthMap, file: &[u8]) -> bool {
    let size = map.view().size();
    assert!(u64::from(size.x) * u64::from(size.y) <= most_texels(file), "{size}");
    size.x * size.y <= MOST_WRITTEN_AGAIN
}

/// Takes bytes as a map of any kind, and as the depths of one. Whether they were.
///
/// # Panics
/// When a refusal is not one line, more is read than was allowed, or what was read is another map after it was written.
pub fn exr_header(file: &[u8]) -> bool {
    let most = most_texels(file);
    let depths = match decode_shadow_map(file, most) {
        Err(fault) => {
            assert_line(fault);
            false
        }
        Ok(map) => {
            if is_small(&map, file) {
                let again = encode_shadow_map(&map).expect("written");
                assert_eq!(decode_shadow_map(&again, most), Ok(map));
            }
            true
        }
    };
    let whole = match decode_map(file, most) {
        Err(fault) => {
            assert_line(fault);
            false
        }
        Ok(Map::Facets(map)) => {
            if is_small(&*map, file) {
                let again = encode_facet_map(&map).expect("written");
                assert!(decode_facet_map(&again, most) == Ok((*map).clone()), "another map of facets");
            }
            true
        }
        Ok(_) => true,
    };
    depths || whole
}

/// Takes bytes as the packed samples of the one tile of a map of 8 × 8 texels, whose header is sound. The first byte chooses the coder.
/// Whether it is a map.
///
/// # Panics
/// As [`exr_header`].
pub fn exr_blocks(data: &[u8]) -> bool {
    let Some((coder, packed)) = data.split_first() else { return false };
    exr_header(&tile_packed_by(CODERS[usize::from(*coder) % CODERS.len()].0, packed))
}

/// Takes bytes as a deep map. Whether they are one.
///
/// # Panics
/// As [`exr_header`].
pub fn deep_exr(file: &[u8]) -> bool {
    let most = most_texels(file);
    match decode_deep_map(file, most) {
        Err(fault) => {
            assert_line(fault);
            false
        }
        Ok(map) => {
            if is_small(&map, file) {
                let again = encode_deep_map(&map).expect("written");
                assert!(decode_deep_map(&again, most) == Ok(map), "another deep map");
            }
            true
        }
    }
}
