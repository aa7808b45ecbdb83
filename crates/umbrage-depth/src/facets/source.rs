use glam::{DVec2, IVec2};
use umbrage_plane::{Affine, TexelRect};

/// A sample of a facet map.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct FacetSample {
    /// Its facet's plane, over texels of the map; a key of +∞ everywhere where there is none.
    pub plane: Affine,
    /// Where it was taken, texels: a texel that is not refined at its centre.
    pub at: DVec2,
    /// The side of what it stands for, texels: 1, or 1/fine in a refined texel.
    pub side: f64,
}

impl FacetSample {
    /// No facet, as seen from a place.
    pub const fn nothing(at: DVec2) -> Self {
        Self { plane: Affine::constant(f64::INFINITY), at, side: 1.0 }
    }
}

/// Whatever knows facets: a map, or several of them around a light.
pub trait FacetSource {
    /// Samples along a refined texel's side: the finer grid has so many columns and rows for each texel.
    fn fine(&self) -> u32;

    /// The sample at a place of the finer grid.
    fn sample(&self, at: IVec2) -> FacetSample;

    /// Calls `each` with all samples of a rectangle of the finer grid and the part of it that each stands for: one that several places share
    /// perhaps once. Stops when it returns false.
    fn each_sample(&self, rect: TexelRect, each: &mut dyn FnMut(TexelRect, &FacetSample) -> bool) {
        for at in rect.texels() {
            if !each(TexelRect::new(at, at + 1), &self.sample(at)) {
                return;
            }
        }
    }

    /// The sample of a rectangle's first place, where all of the rectangle has that sample's plane and no texel of it is refined. `None` where that is
    /// not so, or not known at once.
    fn one_facet(&self, rect: TexelRect) -> Option<FacetSample> {
        let _ = rect;
        None
    }

    /// Where the first surface changes on the way from a sample of the finer grid to its neighbour to the right, or downward: 0 at the
    /// sample, 1 at the neighbour. `None` where that is not known: their planes meet, or the sample is of no refined texel.
    fn link(&self, at: IVec2, down: bool) -> Option<f64>;
}
