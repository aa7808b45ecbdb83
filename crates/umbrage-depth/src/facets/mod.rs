//! Maps of facets: which flat piece of surface a texel sees, instead of how far away it is.

mod look_up;
mod packed;
mod source;
mod tile;

use crate::{Stored, TILE, no_surface};
use glam::{DVec2, IVec2, UVec2};
pub use source::{FacetSample, FacetSource, Facets};
pub use tile::{FacetBlock, FacetCells, FacetTile, NO_FACET};
use umbrage_plane::{Affine, Decode, TexelRect, View};

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
    tiles: Vec<Option<FacetTile>>,
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

    /// The depth that a texel with a facet on this plane stores; what is nearer than the near plane is at it (C-10).
    #[inline(always)]
    pub fn depth(&self, texel: IVec2, plane: &Affine) -> f32 {
        let at = self.view.sampling().position(texel);
        no_surface::kept(self.decode.depth(plane.at(at) as f32, at).max(self.decode.depth(self.nearest, at)))
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
        Self { depths: FacetDepths::of(&view), stored, fine, slots, grid, tiles }
    }

    /// Parts of a link of which one is remembered as where the surface changes.
    pub fn slots(&self) -> u32 {
        self.slots
    }

    /// Refined texels.
    pub fn refined(&self) -> usize {
        self.tiles.iter().flatten().map(FacetTile::refined).sum()
    }

    /// The tile of a texel, with the tile's origin and the texel's place in it; `None` where no surface is kept and outside the map.
    #[inline(always)]
    fn tile(&self, texel: IVec2) -> Option<(&FacetTile, IVec2, UVec2)> {
        if !TexelRect::of_size(self.depths.view.size()).contains(texel) {
            return None;
        }
        let (tile, at) = (texel.as_uvec2() >> SHIFT, texel.as_uvec2() & (TILE - 1));
        let kept = self.tiles[(tile.y * self.grid.x + tile.x) as usize].as_ref()?;
        Some((kept, (tile << SHIFT).as_ivec2(), at))
    }

    /// The plane of a texel that is not refined.
    #[inline(always)]
    fn plane(&self, tile: &FacetTile, texel: IVec2, origin: IVec2, within: UVec2) -> Affine {
        match tile.plane(origin, within) {
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

impl FacetSource for FacetMap {
    #[inline(always)]
    fn fine(&self) -> u32 {
        self.fine
    }

    /// Nothing is outside the map.
    #[inline(always)]
    fn sample(&self, at: IVec2) -> FacetSample {
        let fine = self.fine as i32;
        let texel = IVec2::new(at.x.div_euclid(fine), at.y.div_euclid(fine));
        let centre = texel.as_dvec2() + 0.5;
        let Some((tile, origin, within)) = self.tile(texel) else { return FacetSample::nothing(centre) };
        let place = at - texel * fine;
        let sample = (place.y * fine + place.x) as usize;
        if let Some(plane) = tile.sample(origin, within, sample, (fine * fine) as usize) {
            let side = 1.0 / f64::from(fine);
            return FacetSample { plane, at: (at.as_dvec2() + 0.5) * side, side };
        }
        FacetSample { plane: self.plane(tile, texel, origin, within), at: centre, side: 1.0 }
    }

    /// Once for a texel that is not refined.
    #[inline(always)]
    fn each_sample(&self, rect: TexelRect, each: &mut dyn FnMut(&FacetSample) -> bool) {
        let fine = self.fine as i32;
        let texel_of = |at: IVec2| IVec2::new(at.x.div_euclid(fine), at.y.div_euclid(fine));
        let (from, to) = (texel_of(rect.min), texel_of(rect.max - 1));
        for y in from.y..=to.y {
            for x in from.x..=to.x {
                let texel = IVec2::new(x, y);
                let centre = texel.as_dvec2() + 0.5;
                let goes_on = match self.tile(texel) {
                    None => each(&FacetSample::nothing(centre)),
                    Some((tile, _, within)) if tile.is_refined(within) => {
                        let first = texel * fine;
                        let part = TexelRect::new(first, first + fine).intersect(rect);
                        part.texels().all(|at| each(&self.sample(at)))
                    }
                    Some((tile, origin, within)) => {
                        let plane = self.plane(tile, texel, origin, within);
                        each(&FacetSample { plane, at: centre, side: 1.0 })
                    }
                };
                if !goes_on {
                    return;
                }
            }
        }
    }

    #[inline(always)]
    fn link(&self, at: IVec2, down: bool) -> Option<f64> {
        let fine = self.fine as i32;
        let texel = IVec2::new(at.x.div_euclid(fine), at.y.div_euclid(fine));
        let (tile, _, within) = self.tile(texel)?;
        let place = at - texel * fine;
        let link = 2 * (place.y * fine + place.x) as usize + usize::from(down);
        let slots = tile.link(within, link, (fine * fine) as usize)?;
        Some(f64::from(slots) / f64::from(self.slots))
    }
}
