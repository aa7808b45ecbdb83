use umbrage_depth::{DepthMap, Raw, Stored, Tiled};
use umbrage_plane::{Sampling, View, mix32};

/// One map of an exposure from the maps of its moments: each texel sees one of them, drawn once per texel from `seed`. A filter over
/// such a map blurs what moves, with noise.
///
/// `maps` are of `view`, at evenly spread times; none of them gives an empty map, and texels that one of them does not have are empty in it.
pub fn mix_moments<M: DepthMap>(view: &View, maps: &[M], seed: u32) -> Tiled {
    let moment = |texel| {
        // Of its own seed: the view's samples may be jittered by the same one, and time must not go with place.
        let bits = Sampling::Jittered { seed: mix32(seed ^ 0x71E5) }.offset_256(texel);
        maps.get((bits.x * 256 + bits.y) as usize * maps.len() / 65_536)
    };
    let tiles = view.size().map(|side| side.div_ceil(umbrage_depth::TILE)).element_product() as usize;
    let empty = Tiled::from_tiles(*view, vec![None; tiles]);
    let drawn = Raw::copy_of(&empty).map_depths(|texel, none| moment(texel).map_or(none, |map| map.depth(texel)));
    let stored = maps.first().map_or(Stored::First, DepthMap::stored);
    drawn.map_or(empty, |map| Tiled::from(&map)).with_stored(stored)
}
