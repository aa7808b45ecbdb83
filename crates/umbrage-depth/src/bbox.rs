use crate::{DepthMap, Stored, rows};
use fearless_simd::{Simd, f32x16};
use glam::IVec2;
use umbrage_plane::{DepthRange, TexelRect, View};

/// Only the rectangle around all surfaces (Reeves 1987, §3.3). A map without a surface keeps nothing.
#[derive(Clone, Debug, PartialEq)]
pub struct Bbox {
    view: View,
    stored: Stored,
    rect: TexelRect,
    depths: Vec<f32>,
}

impl Bbox {
    /// The same depths, said to be those of another surface. A new map's are those of the nearest, a copy's those of the map it
    /// is made from.
    #[must_use]
    pub fn with_stored(self, stored: Stored) -> Self {
        Self { stored, ..self }
    }

    /// The rectangle around all surfaces of another map.
    pub fn copy_of(map: &impl DepthMap) -> Self {
        Self::within(map, TexelRect::of_size(map.view().size()))
    }

    /// As [`Bbox::copy_of`], of a map whose surfaces are all known to lie in `within`.
    pub(crate) fn within(map: &impl DepthMap, within: TexelRect) -> Self {
        let rect = rows::finite(map, within);
        Self { view: *map.view(), stored: map.stored(), rect, depths: rows::copy(map, rect) }
    }

    /// The rectangle that is kept: the smallest around all texels with a surface; empty when there are none.
    pub fn finite(&self) -> TexelRect {
        self.rect
    }

    /// The depths of [`Bbox::finite`], row by row from the top; +∞ where there is no surface.
    pub fn depths(&self) -> &[f32] {
        &self.depths
    }
}

impl DepthMap for Bbox {
    fn view(&self) -> &View {
        &self.view
    }

    #[inline(always)]
    fn depth(&self, texel: IVec2) -> f32 {
        rows::depth(&self.depths, self.rect, texel)
    }

    #[inline(always)]
    fn look<S: Simd>(&self, simd: S, within: TexelRect, x: f32x16<S>, y: f32x16<S>) -> f32x16<S> {
        rows::look(simd, &self.depths, self.rect, within, x, y)
    }

    #[inline(always)]
    fn in_row<S: Simd>(&self, simd: S, texel: IVec2, count: u32) -> f32x16<S> {
        rows::in_row(simd, self, (&self.depths, self.rect), texel, count)
    }

    #[inline(always)]
    fn range(&self, rect: TexelRect) -> DepthRange {
        if self.rect.intersect(rect).is_empty() { DepthRange::NOTHING } else { DepthRange::UNKNOWN }
    }

    fn stored(&self) -> Stored {
        self.stored
    }

    fn bytes(&self) -> usize {
        size_of_val(self.depths.as_slice())
    }

    fn allocated(&self) -> usize {
        self.bytes() + size_of::<Self>()
    }
}
