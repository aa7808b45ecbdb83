use crate::{Soup, bake};
use umbrage_depth::{DepthMap, DepthRule, Raw, Tiled};
use umbrage_plane::{Sampling, View, mix32};
use umbrage_raster::Cull;
use umbrage_scene::Scene;

/// Pass 1 over an exposure: each texel sees the scene at one of its moments, drawn once per texel from `seed` (EXT-2). A filter over such a
/// map blurs what moves, with noise.
///
/// `moments` are the scene at evenly spread times; none gives an empty map.
pub fn bake_moments<R: DepthRule>(view: &View, moments: &[&Scene], rule: &R, seed: u32) -> Tiled {
    let baked = |scene: &&Scene| bake(view, Soup::casters(scene, view).triangles(), rule, Cull::None).map;
    let maps: Vec<Tiled> = moments.iter().map(baked).collect();
    let Some(first) = maps.first() else {
        return bake(view, std::iter::empty(), rule, Cull::None).map;
    };
    let moment = |texel| {
        // Of its own seed: the view's samples may be jittered by the same one, and time must not go with place.
        let bits = Sampling::Jittered { seed: mix32(seed ^ 0x71E5) }.offset_256(texel);
        (bits.x * 256 + bits.y) as usize * maps.len() / 65_536
    };
    let drawn = Raw::copy_of(first).map_depths(|texel, _| maps[moment(texel)].depth(texel));
    drawn.map_or_else(|_| first.clone(), |map| Tiled::from(&map))
}
