//! Pass 1 of maps that store facets.

mod budget;
mod casters;
mod hidden;
mod links;
mod merged;
mod nearest;
mod refined;
mod refinement;
mod surface;

pub use refinement::Refinement;

use crate::Casting;
use crate::masks::Masks;
use crate::pass1::{BY_WINDING, Pass};
use budget::Level;
use glam::{IVec2, UVec2};
use merged::merged;
use rayon::prelude::*;
use refined::{Refined, Scratch};
use std::sync::Arc;
use umbrage_depth::{FacetCells, FacetDepths, FacetMap, FacetRule, FacetTile, First, NO_FACET, Stored};
use umbrage_plane::{Sampling, TexelRect, View};
use umbrage_raster::{BIN, Bins, Cull, Stats, each_fragment};

/// Cells of a tile.
const CELLS: usize = (BIN * BIN) as usize;

/// A map of facets, and the statistics of its triangles.
#[derive(Clone, Debug)]
pub struct BakedFacets {
    /// The map.
    pub map: Arc<FacetMap>,
    /// How the rasteriser handled the triangles.
    pub stats: Stats,
}

/// As [`bake`](crate::bake), but storing which facet each texel sees: the same depths, bit for bit, in less memory where facets are
/// larger than a few texels. Of facets with equal keys the first triangle's is stored.
pub fn bake_facets<'a, R: FacetRule>(
    view: &View,
    casters: impl IntoIterator<Item: Into<Casting<'a>>>,
    rule: &R,
    cull: Cull,
) -> BakedFacets {
    let mut masks = Masks::new(view);
    let geometry = casters.into_iter().map(|casters| masks.note(casters));
    let bins = Bins::new(view, TexelRect::of_size(view.size()), cull, geometry);
    let pass = Pass { view, fine: view, rule, masks: &masks, front: BY_WINDING };
    let stored = match (rule.stored(), cull) {
        (Stored::First, Cull::Front) => Stored::BackFace,
        (stored, _) => stored,
    };
    let depths = FacetDepths::of(view);
    let tiles = by_tile(
        view,
        || (),
        |(), tile| {
            let cells = pass.cells(&bins, tile).0?;
            let origin = (tile * BIN).as_ivec2();
            let mut texels = vec![NO_FACET; CELLS];
            let mut planes = Vec::new();
            masks.tile(&bins, tile, |facet, coverage| {
                let mut number = None;
                each_fragment(view, origin, facet, coverage, |cell, _, key| {
                    if texels[cell] == NO_FACET && key == rule.key(&cells[cell]) {
                        texels[cell] = *number.get_or_insert_with(|| {
                            planes.push(facet.plane);
                            planes.len() as u32 - 1
                        });
                    }
                });
            });
            pack(view, &depths, tile, 1, &FacetCells { planes: &planes, texels: &texels, blocks: &[] })
        },
    );
    BakedFacets { map: Arc::new(FacetMap::from_tiles(*view, stored, 1, 1, tiles)), stats: bins.stats() }
}

/// The nearest facet of each texel and, where the surface over a texel is not one plane, of `fine` × `fine` samples in it with links between
/// them: the map for [`DualPlane`]. Texels are sampled at their centres, whatever the view's own sampling.
///
/// A texel is refined when one of its samples, or the first sample beyond its right or lower side, lies off its own plane by more than
/// the tolerance, within a budget of ten bytes per texel of the map, or 640 KB if that is more: beyond it, the tiles that take most first let samples share
/// planes that are nearly their own, then
/// refine only edges that matter by more texels, and finally none. A link is stored between neighbouring samples of refined
/// texels whose facets' planes do not meet there. A caster's [mask](crate::Mask) is evaluated at every sample and at every slot of a link:
/// its holes are edges like any others.
///
/// [`DualPlane`]: https://docs.rs/umbrage-shadow
///
/// # Panics
/// When `fine` is not 2, 4 or 8, or `slots` is not a power of two from 2 to 64/`fine`.
pub fn bake_refined<'a>(
    view: &View,
    casters: impl IntoIterator<Item: Into<Casting<'a>>>,
    refinement: &Refinement,
) -> BakedFacets {
    let Refinement { fine, slots, .. } = *refinement;
    assert!(matches!(fine, 2 | 4 | 8), "{fine} samples along a texel's side");
    assert!(slots > 1 && slots.is_power_of_two() && slots * fine <= 64, "{slots} slots with {fine} samples");
    let view = &view.with_sampling(Sampling::Centre);
    let mut masks = Masks::new(view);
    let geometry = casters.into_iter().map(|casters| masks.note(casters));
    let bins = Bins::for_spans(view, TexelRect::of_size(view.size()), Cull::None, geometry);
    let depths = FacetDepths::of(view);
    let kept = |tile: UVec2, level: Level, scratch: &mut Scratch| {
        let refinement = &refinement.with_tolerance(refinement.tolerance * level.tolerance);
        let found = Refined { view, bins: &bins, masks: &masks, refinement }.tile(tile, level.parts, scratch)?;
        let cells = found.cells();
        if !level.merged {
            return pack(view, &depths, tile, fine, &cells);
        }
        let (texels, blocks) = merged(view, &cells, (tile * BIN).as_ivec2(), fine);
        pack(view, &depths, tile, fine, &FacetCells { texels: &texels, blocks: &blocks, ..cells })
    };
    let grid = view.size().map(|side| side.div_ceil(BIN));
    let again = |index: usize, level| {
        kept(UVec2::new(index as u32 % grid.x, index as u32 / grid.x), level, &mut Scratch::default())
    };
    let tiles = by_tile(view, Scratch::default, |scratch, tile| kept(tile, Level::ALL, scratch));
    let tiles = budget::within(view.size().element_product() as usize, tiles, again);
    let map = FacetMap::from_tiles(*view, umbrage_depth::DepthRule::stored(&First), fine, slots, tiles);
    BakedFacets { map: Arc::new(map), stats: bins.stats() }
}

/// All tiles of a map, in parallel; `scratch` makes the buffers that consecutive tiles reuse.
fn by_tile<S>(
    view: &View,
    scratch: impl Fn() -> S + Sync + Send,
    tile: impl Fn(&mut S, UVec2) -> Option<FacetTile> + Sync + Send,
) -> Vec<Option<FacetTile>> {
    let grid = view.size().map(|side| side.div_ceil(BIN));
    let indices = (0..grid.element_product()).into_par_iter();
    indices.map_init(scratch, |scratch, index| tile(scratch, UVec2::new(index % grid.x, index / grid.x))).collect()
}

fn pack(view: &View, depths: &FacetDepths, tile: UVec2, fine: u32, cells: &FacetCells<'_>) -> Option<FacetTile> {
    let origin = (tile * BIN).as_ivec2();
    let valid = (view.size() - tile * BIN).min(UVec2::splat(BIN));
    FacetTile::new(cells, origin, valid, fine, |texel: IVec2, plane| depths.depth(texel, plane))
}
