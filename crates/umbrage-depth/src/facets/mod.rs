//! Maps of facets: which flat piece of surface a texel sees, instead of how far away it is.

mod known;
mod look_up;
mod map_words;
mod packed;
mod planar;
mod samples;
mod source;
mod tile;
mod tile_words;
mod tiles;
mod words;

use crate::{Stored, TILE, no_surface};
use glam::{DVec2, IVec2, UVec2};
pub use known::Facets;
pub use source::{FacetSample, FacetSource};
pub use tile::{FacetBlock, FacetCells, FacetTile, NO_FACET};
use tiles::Tiles;
use umbrage_plane::{Affine, Decode, TexelRect, View};
pub use words::FacetWordsError;

/// log₂ of [`TILE`].
const SHIFT: u32 = TILE.trailing_zeros();

/// A map that keeps the *facet* of each texel and each facet's plane once per tile. Depths and slopes are those of the plane, so that a
/// look-up knows not only how far the caster is at the texel's centre but where it is anywhere, and large facets take next to no room.
///
/// Without refinement (`fine` 1) it is a storage like the others: planes keep all their bits, and every depth is the one that pass 1 would
/// have stored, bit for bit. With it, a texel over which the surface is not one plane is kept as `fine` × `fine` samples with
/// *links* between neighbours: how far from one to the next the first surface changes. Planes are then rounded to twelve bytes,
/// which no comparison that allows for roundings notices. Where facets are as small as texels, a tile keeps depths with slopes.
///
/// Umbrage's own; silhouettes in texels are after Sen, Cammarano & Hanrahan 2003, facets in texels after Lecocq et al. 2014.
#[derive(Clone, Debug, PartialEq)]
pub struct FacetMap {
    depths: FacetDepths,
    stored: Stored,
    fine: u32,
    slots: u32,
    grid: UVec2,
    tiles: Tiles,
}

/// What a facet map makes of keys: apart from the map, so that tiles can be packed before it exists.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct FacetDepths {
    view: View,
    decode: Decode,
    /// The near plane's key, as it is stored.
    nearest: f32,
}

impl FacetDepths {
    /// Of a map of `view`.
    pub fn of(view: &View) -> Self {
        Self { decode: view.decode(), nearest: view.key(view.near()) as f32, view: *view }
    }

    /// The depth that a texel with a facet on this plane stores; what is nearer than the near plane is at it.
    #[inline(always)]
    pub fn depth(&self, texel: IVec2, plane: &Affine) -> f32 {
        let at = self.view.sampling().position(texel);
        no_surface::kept(self.decode.depth(plane.at(at) as f32, at).max(self.decode.depth(self.nearest, at)))
    }

    /// The depths that sixteen texels store, by the keys of their planes at their samples and by the samples' positions: all x, all y.
    #[inline(always)]
    fn of_keys(&self, keys: &[f32; 16], [x, y]: &[[f64; 16]; 2], depths: &mut [f32; 16]) {
        self.decode.in_loops(
            #[inline(always)]
            |decode| {
                for i in 0..16 {
                    let at = DVec2::new(x[i], y[i]);
                    depths[i] = no_surface::kept(decode.depth(keys[i], at).max(decode.depth(self.nearest, at)));
                }
            },
        );
    }
}

impl FacetMap {
    /// From all tiles of a map of `view`, row by row from the top; `None` for those without a surface. Refined texels are of `fine` × `fine`
    /// samples and links of `slots` slots.
    ///
    /// # Panics
    /// When there is not one entry for each tile: ⌈width/32⌉·⌈height/32⌉; or when `fine` or `slots` is 0.
    pub fn from_tiles(view: View, stored: Stored, fine: u32, slots: u32, tiles: Vec<Option<FacetTile>>) -> Self {
        let grid = view.size().map(|side| side.div_ceil(TILE));
        assert_eq!(tiles.len(), grid.element_product() as usize, "tiles of a map of {} texels", view.size());
        assert!(fine > 0 && slots > 0, "{fine} samples, {slots} slots");
        Self { depths: FacetDepths::of(&view), stored, fine, slots, grid, tiles: Tiles::new(tiles) }
    }

    /// Parts of a link of which one is remembered as where the surface changes.
    pub fn slots(&self) -> u32 {
        self.slots
    }

    /// Refined texels.
    pub fn refined(&self) -> usize {
        self.tiles.iter().flatten().map(FacetTile::refined).sum()
    }

    /// The tile of a texel, with the tile's middle and the texel's place in it; `None` where no surface is kept and outside the map.
    #[inline(always)]
    fn tile(&self, texel: IVec2) -> Option<(&FacetTile, DVec2, UVec2)> {
        if !TexelRect::of_size(self.depths.view.size()).contains(texel) {
            return None;
        }
        let (tile, at) = (texel.as_uvec2() >> SHIFT, texel.as_uvec2() & (TILE - 1));
        let kept = self.tiles.get((tile.y * self.grid.x + tile.x) as usize)?;
        Some((kept, (tile << SHIFT).as_dvec2() + 0.5 * f64::from(TILE), at))
    }

    /// The plane of a texel that is not refined.
    #[inline(always)]
    fn plane(&self, reader: &tile::Reader<'_>, texel: IVec2) -> Affine {
        match reader.texel(texel.as_uvec2() & (TILE - 1)) {
            tile::Stored::Plane(plane) => plane,
            tile::Stored::Depth(depth) => Affine::constant(self.key(texel, depth)),
        }
    }

    /// The key of a stored depth.
    fn key(&self, texel: IVec2, depth: f32) -> f64 {
        if depth == f32::INFINITY {
            return f64::INFINITY;
        }
        let at: DVec2 = self.depths.view.sampling().position(texel);
        self.depths.view.key(self.depths.decode.zeta_of_depth(depth, at))
    }
}
