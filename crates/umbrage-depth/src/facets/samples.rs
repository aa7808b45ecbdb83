//! Samples and links of a map.

use super::source::{FacetSample, FacetSource};
use super::tile::Reader;
use super::{FacetMap, SHIFT};
use crate::TILE;
use glam::IVec2;
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
    fn whole(&self, texel: IVec2, reader: Option<&Reader<'_>>) -> FacetSample {
        let at = texel.as_dvec2() + 0.5;
        let Some(reader) = reader else { return FacetSample::nothing(at) };
        FacetSample { plane: self.plane(reader, texel), at, side: 1.0 }
    }

    /// The sample of a refined texel at a place of the finer grid.
    #[inline(always)]
    fn part(&self, at: IVec2, plane: Affine) -> FacetSample {
        let side = 1.0 / f64::from(self.fine);
        FacetSample { plane, at: (at.as_dvec2() + 0.5) * side, side }
    }

    /// [`FacetSource::each_sample`] of `texels`, all of which are of one tile; false where `each` was.
    #[inline(always)]
    fn each_of_tile(
        &self,
        texels: TexelRect,
        rect: TexelRect,
        each: &mut dyn FnMut(TexelRect, &FacetSample) -> bool,
    ) -> bool {
        let (size, fine) = (self.depths.view.size().as_ivec2(), self.fine as i32);
        let reader = self.tile(texels.min).map(|(tile, middle, _)| tile.reader(middle));
        for y in texels.min.y..texels.max.y {
            let (top, bottom) = (rect.min.y.max(y * fine), rect.max.y.min((y + 1) * fine));
            let reader = reader.as_ref().filter(|_| y < size.y);
            let refined = reader.map_or(0, |reader| reader.refined(y as u32 & (TILE - 1)));
            for x in texels.min.x..texels.max.x {
                let texel = IVec2::new(x, y);
                let (left, right) = (rect.min.x.max(x * fine), rect.max.x.min((x + 1) * fine));
                let reader = reader.filter(|_| x < size.x);
                let within = texel.as_uvec2() & (TILE - 1);
                let Some(reader) = reader.filter(|_| refined >> within.x & 1 == 1) else {
                    let part = TexelRect { min: IVec2::new(left, top), max: IVec2::new(right, bottom) };
                    if !each(part, &self.whole(texel, reader)) {
                        return false;
                    }
                    continue;
                };
                let first = reader.block(within, self.fine).wrapping_sub(((y * fine + x) * fine) as usize);
                for row in top..bottom {
                    let first = first.wrapping_add((row * fine) as usize);
                    for column in left..right {
                        let at = IVec2::new(column, row);
                        let plane = reader.sample(first.wrapping_add(column as usize));
                        if !each(TexelRect { min: at, max: at + 1 }, &self.part(at, plane)) {
                            return false;
                        }
                    }
                }
            }
        }
        true
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
        let Some((tile, middle, within)) = self.tile(texel) else { return self.whole(texel, None) };
        let reader = tile.reader(middle);
        if reader.refined(within.y) >> within.x & 1 == 0 {
            return self.whole(texel, Some(&reader));
        }
        let place = at - texel * self.fine as i32;
        let number = reader.block(within, self.fine) + (place.y * self.fine as i32 + place.x) as usize;
        self.part(at, reader.sample(number))
    }

    /// Once for a texel that is not refined.
    #[inline(always)]
    fn each_sample(&self, rect: TexelRect, each: &mut dyn FnMut(TexelRect, &FacetSample) -> bool) {
        let (from, to) = (self.texel_of(rect.min), self.texel_of(rect.max - 1));
        let (low, high) = (from >> SHIFT, to >> SHIFT);
        for y in low.y..=high.y {
            for x in low.x..=high.x {
                let origin = IVec2::new(x, y) << SHIFT;
                let texels = TexelRect { min: from.max(origin), max: (to + 1).min(origin + TILE as i32) };
                if !self.each_of_tile(texels, rect, each) {
                    return;
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
        tile.is_one_facet(within, last.as_uvec2()).then(|| self.whole(from, Some(&tile.reader(middle))))
    }

    #[inline(always)]
    fn link(&self, at: IVec2, down: bool) -> Option<f64> {
        let texel = self.texel_of(at);
        let (tile, _, within) = self.tile(texel)?;
        let slots = tile.link(within, at - texel * self.fine as i32, self.fine, down)?;
        Some(f64::from(slots) / f64::from(self.slots))
    }
}
