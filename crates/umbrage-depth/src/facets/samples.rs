//! Samples and links of a map.

use super::FacetMap;
use super::source::{FacetSample, FacetSource};
use glam::IVec2;
use umbrage_plane::TexelRect;

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
