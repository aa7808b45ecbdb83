//! Samples and links of a map.

use super::source::{FacetSample, FacetSource};
use super::tile::FacetTile;
use super::{FacetMap, SHIFT};
use crate::TILE;
use glam::{DVec2, IVec2, UVec2};
use umbrage_plane::{Affine, TexelRect};

impl FacetMap {
    /// The texel that a place of the finer grid lies in.
    #[inline(always)]
    fn texel_of(&self, at: IVec2) -> IVec2 {
        if self.fine.is_power_of_two() {
            // Shifts round down, below 0 too.
            return at >> self.fine.trailing_zeros();
        }
        at.map(|at| at.div_euclid(self.fine as i32))
    }

    /// The sample of a texel that is not refined; nothing is outside the map.
    #[inline(always)]
    fn whole(&self, texel: IVec2, found: Option<(&FacetTile, DVec2, UVec2)>) -> FacetSample {
        let centre = texel.as_dvec2() + 0.5;
        let Some((tile, middle, within)) = found else { return FacetSample::nothing(centre) };
        FacetSample { plane: self.plane(tile, texel, middle, within), at: centre, side: 1.0 }
    }

    /// The sample of a refined texel at a place of the finer grid.
    #[inline(always)]
    fn part(&self, at: IVec2, plane: Affine) -> FacetSample {
        let side = 1.0 / f64::from(self.fine);
        FacetSample { plane, at: (at.as_dvec2() + 0.5) * side, side }
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
        let texel = self.texel_of(at);
        let found = self.tile(texel);
        if let Some((tile, middle, within)) = found
            && let Some(block) = tile.block(middle, within)
        {
            let place = at - texel * self.fine as i32;
            return self.part(at, block.plane((place.y * self.fine as i32 + place.x) as usize, self.fine));
        }
        self.whole(texel, found)
    }

    /// Once for a texel that is not refined.
    #[inline(always)]
    fn each_sample(&self, rect: TexelRect, each: &mut dyn FnMut(TexelRect, &FacetSample) -> bool) {
        let (from, to) = (self.texel_of(rect.min), self.texel_of(rect.max - 1));
        let (whole, fine) = (TexelRect::of_size(self.depths.view.size()), self.fine as i32);
        // A tile is looked up once for all of its texels that follow each other.
        let mut last = (IVec2::MIN, None);
        for y in from.y..=to.y {
            let (top, bottom) = (rect.min.y.max(y * fine), rect.max.y.min((y + 1) * fine));
            for x in from.x..=to.x {
                let texel = IVec2::new(x, y);
                let found = if whole.contains(texel) {
                    if last.0 != texel >> SHIFT {
                        last = (texel >> SHIFT, self.tile(texel));
                    }
                    last.1.map(|(tile, middle, _)| (tile, middle, texel.as_uvec2() & (TILE - 1)))
                } else {
                    None
                };
                let (left, right) = (rect.min.x.max(x * fine), rect.max.x.min((x + 1) * fine));
                let block = found.and_then(|(tile, middle, within)| tile.block(middle, within));
                let Some(block) = block else {
                    let part = TexelRect { min: IVec2::new(left, top), max: IVec2::new(right, bottom) };
                    if !each(part, &self.whole(texel, found)) {
                        return;
                    }
                    continue;
                };
                for row in top..bottom {
                    let first = ((row - y * fine) * fine - x * fine) as usize;
                    for column in left..right {
                        let at = IVec2::new(column, row);
                        let plane = block.plane(first.wrapping_add(column as usize), self.fine);
                        if !each(TexelRect { min: at, max: at + 1 }, &self.part(at, plane)) {
                            return;
                        }
                    }
                }
            }
        }
    }

    #[inline(always)]
    fn one_facet(&self, rect: TexelRect) -> Option<FacetSample> {
        let (from, to) = (self.texel_of(rect.min), self.texel_of(rect.max - 1));
        let (tile, middle, within) = self.tile(from)?;
        // In one tile, none of whose texels is beyond the map.
        let last = within.as_ivec2() + (to - from);
        if last.cmpge(IVec2::splat(TILE as i32)).any() || to.cmpge(self.depths.view.size().as_ivec2()).any() {
            return None;
        }
        tile.is_one_facet(within, last.as_uvec2()).then(|| self.whole(from, Some((tile, middle, within))))
    }

    #[inline(always)]
    fn link(&self, at: IVec2, down: bool) -> Option<f64> {
        let texel = self.texel_of(at);
        let (tile, middle, within) = self.tile(texel)?;
        let slots = tile.block(middle, within)?.link(at - texel * self.fine as i32, self.fine, down)?;
        Some(f64::from(slots) / f64::from(self.slots))
    }
}
