use super::pyramid::Level;
use super::{MomentMap, Moments};
use crate::{DepthMap, Stored, rows};
use fearless_simd::{Simd, f32x16};
use glam::IVec2;
use umbrage_plane::{TexelRect, View};

impl MomentMap {
    /// The moments of a map's depths, those of the nearest surfaces where it holds several.
    ///
    /// `prefilter` is the standard deviation, in texels, of a normal law by which the moments are blurred along rows and columns, as far as
    /// three standard deviations reach. Beyond an edge of the map lies what lies on it. 0, NaN and negative numbers are none; more than 64
    /// counts as 64. Coarser levels are means of two by two texels. Sums are f64, and rounded once for each level.
    #[must_use]
    pub fn of(map: &impl DepthMap, kind: Moments, prefilter: f32) -> Self {
        let depths = rows::copy(map, TexelRect::of_size(map.view().size()));
        Self::new(map.view(), map.stored(), depths, kind, prefilter)
    }
}

impl DepthMap for MomentMap {
    fn view(&self) -> &View {
        &self.view
    }

    #[inline(always)]
    fn depth(&self, texel: IVec2) -> f32 {
        rows::depth(&self.depths, TexelRect::of_size(self.view.size()), texel)
    }

    #[inline(always)]
    fn look<S: Simd>(&self, simd: S, _within: TexelRect, x: f32x16<S>, y: f32x16<S>) -> f32x16<S> {
        rows::look(simd, &self.depths, TexelRect::of_size(self.view.size()), x, y)
    }

    #[inline(always)]
    fn moments(&self) -> Option<&Self> {
        Some(self)
    }

    fn stored(&self) -> Stored {
        self.stored
    }

    /// Those of its depths and of all moments.
    fn bytes(&self) -> usize {
        size_of_val(self.depths.as_slice()) + self.levels.iter().map(Level::bytes).sum::<usize>()
    }

    fn allocated(&self) -> usize {
        self.bytes() + self.levels.len() * size_of::<Level>() + size_of::<Self>()
    }
}
