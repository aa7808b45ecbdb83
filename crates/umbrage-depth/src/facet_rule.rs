use crate::{BackFace, DepthRule, First, Second};

/// A rule that stores the depth of one facet as it is, so that a map may keep the facet instead ([`FacetMap`](crate::FacetMap)). Midpoints
/// are no facet's.
pub trait FacetRule: DepthRule {
    /// The key of the stored surface, which one of the fragments had; +∞ where nothing is stored.
    fn key(&self, cell: &Self::Cell) -> f32;
}

impl FacetRule for First {
    #[inline(always)]
    fn key(&self, cell: &f32) -> f32 {
        *cell
    }
}

impl FacetRule for BackFace {
    #[inline(always)]
    fn key(&self, cell: &f32) -> f32 {
        *cell
    }
}

impl FacetRule for Second {
    #[inline(always)]
    fn key(&self, cell: &[f32; 2]) -> f32 {
        cell[1]
    }
}
