//! Whose surfaces a map's texels see.

use glam::{IVec2, UVec2};
use std::collections::HashMap;
use umbrage_bake::Masks;
use umbrage_plane::{TexelRect, View};
use umbrage_raster::{BIN, Bins, Cull, each_fragment};
use umbrage_render::Soup;
use umbrage_scene::Scene;

/// The facets that texels of a map see, and their objects.
pub struct Owners {
    facets: HashMap<IVec2, Vec<Owner>>,
    names: Vec<String>,
}

/// A facet as a texel sees it.
#[derive(Clone, Copy, Debug)]
pub struct Owner {
    /// Its number among the scene's triangles that cast, from 0.
    pub facet: u32,
    pub object: u32,
    /// Its depth at the texel's sample, of the map's kind.
    depth: f32,
}

impl Owners {
    /// Of the texels in a window.
    pub fn of(scene: &Scene, view: &View, window: TexelRect) -> Self {
        let window = window.intersect(TexelRect::of_size(view.size()));
        let soup = Soup::casters(scene, view);
        let (mut masks, decode) = (Masks::new(view), view.decode());
        let bins = Bins::new(view, window, Cull::None, soup.casting().map(|caster| masks.note(caster)));
        let mut facets: HashMap<IVec2, Vec<Owner>> = HashMap::new();
        let side = BIN as i32;
        for tile in TexelRect::new(window.min / side, (window.max + side - 1) / side).texels() {
            masks.tile(&bins, tile.as_uvec2(), |facet, coverage| {
                each_fragment(view, tile * side, facet, coverage, |index, at, key| {
                    let texel = tile * side + UVec2::new(index as u32 % BIN, index as u32 / BIN).as_ivec2();
                    let owner = Owner { facet: facet.triangle, object: facet.object, depth: decode.depth(key, at) };
                    facets.entry(texel).or_default().push(owner);
                });
            });
        }
        Self { facets, names: scene.objects.iter().map(|object| object.name.clone()).collect() }
    }

    /// The facet whose depth is stored in a texel, or whose depth is nearest to that; `None` where nothing is seen.
    pub fn at(&self, texel: IVec2, stored: f32) -> Option<Owner> {
        let off = |owner: &&Owner| (owner.depth - stored).abs();
        self.facets.get(&texel)?.iter().min_by(|a, b| off(a).total_cmp(&off(b)).then(a.facet.cmp(&b.facet))).copied()
    }

    /// The nearest facet of a texel.
    pub fn nearest(&self, texel: IVec2) -> Option<Owner> {
        self.at(texel, f32::MIN)
    }

    pub fn name(&self, object: u32) -> &str {
        self.names.get(object as usize).map_or("", String::as_str)
    }
}
