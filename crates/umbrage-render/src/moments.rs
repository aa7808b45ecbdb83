use umbrage_depth::{DepthMap, Raw, Tiled};
use umbrage_plane::{Sampling, View, mix32};
use umbrage_scene::Scene;

/// Pass 1 over an exposure: each texel sees the scene at one of its moments, drawn once per texel from `seed` (EXT-2). A filter over such a
/// map blurs what moves, with noise.
///
/// `moments` are the scene at evenly spread times, each made into a map of `view` by `bake`; none gives an empty map.
pub fn bake_moments<M: DepthMap>(view: &View, moments: &[&Scene], seed: u32, bake: impl Fn(&Scene) -> M) -> Tiled {
    let maps: Vec<M> = moments.iter().map(|scene| bake(scene)).collect();
    let moment = |texel| {
        // Of its own seed: the view's samples may be jittered by the same one, and time must not go with place.
        let bits = Sampling::Jittered { seed: mix32(seed ^ 0x71E5) }.offset_256(texel);
        maps.get((bits.x * 256 + bits.y) as usize * maps.len() / 65_536)
    };
    let tiles = view.size().map(|side| side.div_ceil(umbrage_depth::TILE)).element_product() as usize;
    let empty = Tiled::from_tiles(*view, vec![None; tiles]);
    let drawn = Raw::copy_of(&empty).map_depths(|texel, none| moment(texel).map_or(none, |map| map.depth(texel)));
    drawn.map_or(empty, |map| Tiled::from(&map))
}
