//! Maps made of one's own ray hits hold what the rasteriser stores.

use crate::pass1::{triangles, views};
use glam::IVec2;
use umbrage_bake::bake;
use umbrage_depth::{BackFace, DepthMap, DepthRule, First, Hit, Midpoint, SameSurface, Second};
use umbrage_plane::{Facing, TexelRect, View};
use umbrage_raster::{Bins, Cull, each_fragment};

/// What meets each texel's sample, at the fragments' own distances.
fn hits(view: &View) -> Vec<Vec<Hit>> {
    let size = view.size();
    let bins = Bins::new(view, TexelRect::of_size(size), Cull::None, triangles());
    let mut all = vec![Vec::new(); size.element_product() as usize];
    for tile in TexelRect::of_size(bins.tiles()).texels() {
        bins.tile(tile.as_uvec2(), |facet, coverage| {
            each_fragment(view, tile * 32, facet, coverage, |cell, _, key| {
                let texel = tile * 32 + IVec2::new(cell as i32 % 32, cell as i32 / 32);
                let zeta = view.decode().zeta(key);
                let hit = if facet.facing == Facing::Front { Hit::front(zeta) } else { Hit::back(zeta) };
                let hit = hit.of_object(facet.object);
                let hit = if facet.sheet { hit.of_sheet() } else { hit };
                all[(texel.y * size.x as i32 + texel.x) as usize].push(hit);
            });
        });
    }
    all
}

fn law(name: &str, rule: &impl DepthRule) {
    for view in views() {
        let map = bake(&view, triangles(), rule, Cull::None).map;
        for (texel, hits) in TexelRect::of_size(view.size()).texels().zip(hits(&view)) {
            let (stored, of_hits) = (map.depth(texel), rule.of(&view, texel, hits.iter().copied()));
            assert_eq!(of_hits.to_bits(), stored.to_bits(), "{name}, {texel}: {of_hits}, baked {stored}: {hits:?}");
        }
    }
}

#[test]
fn hits_at_the_fragments_distances_store_the_baked_bits_under_every_rule() {
    law("first", &First);
    law("second", &Second);
    law("back face", &BackFace);
    law("midpoint", &Midpoint::default());
    law("midpoint by object", &Midpoint::default().with_same(SameSurface::Object));
}
