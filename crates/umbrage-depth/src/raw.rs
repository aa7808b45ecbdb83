use crate::{DepthMap, Stored, no_surface, rows};
use fearless_simd::{Simd, f32x16};
use glam::IVec2;
use umbrage_plane::{TexelRect, View};

/// Why depths are not a map.
#[derive(Clone, Copy, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum MapError {
    /// Not one depth per texel.
    #[error("{found} depths given for a map of {width} x {height} texels")]
    Length {
        /// Columns of the view.
        width: u32,
        /// Rows of the view.
        height: u32,
        /// Number of depths given.
        found: usize,
    },
    /// NaN or −∞, which are not depths.
    #[error("texel ({}, {}) holds {value}, which is not a depth", .texel.x, .texel.y)]
    NotADepth {
        /// The first such texel, by rows from the top.
        texel: IVec2,
        /// What it holds.
        value: f32,
    },
    /// Surfaces of a deep map that are out of order.
    #[error("texel ({}, {}) of a deep map holds {problem}", .texel.x, .texel.y)]
    NotSteps {
        /// The first such texel, by rows from the top.
        texel: IVec2,
        /// What is wrong with its surfaces.
        problem: &'static str,
    },
    /// An error bound of a deep map that bounds nothing.
    #[error("deep map error bound {0} is not within 0..1")]
    Epsilon(f32),
}

/// Every texel of a map: 4 bytes each, row by row from the top (Reeves 1987).
#[derive(Clone, Debug, PartialEq)]
pub struct Raw {
    view: View,
    stored: Stored,
    depths: Vec<f32>,
}

impl Raw {
    /// The same depths, said to be those of another surface. A new map's are those of the nearest, a copy's those of the map it
    /// is made from.
    #[must_use]
    pub fn with_stored(self, stored: Stored) -> Self {
        Self { stored, ..self }
    }

    /// One depth per texel of `view`, row by row, row 0 on top, those of the nearest surface ([`Raw::with_stored`] says another). Values of 1e30 or more, +∞ included, mean *no surface* and become +∞.
    ///
    /// # Errors
    /// When the number of depths is not width times height, or one of them is NaN or −∞.
    pub fn new(view: View, mut depths: Vec<f32>) -> Result<Self, MapError> {
        let size = view.size();
        if depths.len() != size.x as usize * size.y as usize {
            return Err(MapError::Length { width: size.x, height: size.y, found: depths.len() });
        }
        if let Some(index) = depths.iter().position(|depth| depth.is_nan() || *depth == f32::NEG_INFINITY) {
            let texel = IVec2::new(index as i32 % size.x as i32, index as i32 / size.x as i32);
            return Err(MapError::NotADepth { texel, value: depths[index] });
        }
        for depth in &mut depths {
            *depth = no_surface::kept(*depth);
        }
        Ok(Self { view, stored: Stored::First, depths })
    }

    /// Every texel of another map.
    pub fn copy_of(map: &impl DepthMap) -> Self {
        Self { view: *map.view(), stored: map.stored(), depths: rows::copy(map, TexelRect::of_size(map.view().size())) }
    }

    /// The depths, row by row from the top; +∞ where there is no surface.
    pub fn depths(&self) -> &[f32] {
        &self.depths
    }

    /// The map with every depth, +∞ included, replaced by a function of its texel and itself.
    ///
    /// # Errors
    /// When the function returns NaN or −∞.
    pub fn map_depths(&self, f: impl Fn(IVec2, f32) -> f32) -> Result<Self, MapError> {
        let replaced = self.replaced(f);
        Ok(Self::new(replaced.view, replaced.depths)?.with_stored(self.stored))
    }

    /// [`Raw::map_depths`] with a function that returns depths only.
    pub(crate) fn replaced(&self, f: impl Fn(IVec2, f32) -> f32) -> Self {
        let texels = TexelRect::of_size(self.view.size()).texels();
        Self {
            view: self.view,
            stored: self.stored,
            depths: texels.zip(&self.depths).map(|(texel, &depth)| f(texel, depth)).collect(),
        }
    }

    /// The smallest rectangle around all texels that hold a surface; empty when none does (Reeves 1987).
    pub fn finite(&self) -> TexelRect {
        rows::finite(self, TexelRect::of_size(self.view.size()))
    }
}

impl DepthMap for Raw {
    fn view(&self) -> &View {
        &self.view
    }

    #[inline(always)]
    fn depth(&self, texel: IVec2) -> f32 {
        rows::depth(&self.depths, TexelRect::of_size(self.view.size()), texel)
    }

    #[inline(always)]
    fn look<S: Simd>(&self, simd: S, within: TexelRect, x: f32x16<S>, y: f32x16<S>) -> f32x16<S> {
        rows::look(simd, &self.depths, TexelRect::of_size(self.view.size()), within, x, y)
    }

    #[inline(always)]
    fn in_row<S: Simd>(&self, simd: S, texel: IVec2, count: u32) -> f32x16<S> {
        rows::in_row(simd, self, (&self.depths, TexelRect::of_size(self.view.size())), texel, count)
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
