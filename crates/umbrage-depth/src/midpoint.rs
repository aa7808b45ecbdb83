use crate::{DepthRule, Reduction, Stored};
use glam::DVec2;
use umbrage_plane::{Decode, Facet};

/// Between the two nearest surfaces, so that the nearest is lit and the second shadowed without any bias
/// (Woo 1992; W92-1, W92-2, W92-3). A texel with fewer than two stores nothing.
///
/// The depth is averaged in world distance along the axis whatever the map's kind (W92-1b). Surfaces that coincide count as one,
/// or shared edges and sheets would store their own depth and shadow themselves (W92-4, T-2). Whether two coincide is
/// asked of the nearest alone, in a second pass; merging them as they arrive would depend on their order (V54).
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub struct Midpoint {
    /// Where between the two: 0 excluded, ½ is Woo's, 1 is the second surface.
    pub ratio: f32,
    /// Surfaces whose distances differ by no more than this share of the larger are one.
    pub merge: f32,
    /// Which fragments belong to one surface.
    pub same: SameSurface,
}

/// Which fragments of a texel belong to one surface (W92-4).
#[derive(Clone, Copy, Debug, PartialEq, Eq, Default)]
pub enum SameSurface {
    /// Those at one depth, whatever their objects.
    #[default]
    Depth,
    /// Those at one depth, of one object.
    Object,
    /// Those of one object that face the same way, at any depth: for texels that are sampled at several places, where one surface has
    /// several depths (W92-3). An object that folds over itself loses shadow between its own folds.
    Surface,
}

umbrage_plane::builders!([] Midpoint { with_ratio ratio: f32, with_merge merge: f32, with_same same: SameSurface });

impl Default for Midpoint {
    fn default() -> Self {
        Self { ratio: 0.5, merge: 1e-6, same: SameSurface::Depth }
    }
}

/// What [`Midpoint`] keeps of a texel while fragments arrive.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct MidpointCell {
    /// The smallest key.
    first: f32,
    /// The smallest key among other surfaces.
    second: f32,
    /// The smallest object id at `first`, and whether its outside is seen there.
    object: (u32, bool),
}

impl Reduction for Midpoint {
    type Cell = MidpointCell;
    const EMPTY: MidpointCell = MidpointCell { first: f32::INFINITY, second: f32::INFINITY, object: (u32::MAX, true) };
    const PASSES: u32 = 2;

    #[inline(always)]
    fn add(&self, pass: u32, cell: &mut MidpointCell, key: f32, front: bool, facet: &Facet) {
        let object = (facet.object, front);
        if pass == 0 {
            if key < cell.first {
                (cell.first, cell.object) = (key, object);
            } else if key == cell.first {
                cell.object = cell.object.min(object);
            }
        } else if key < cell.second && !self.is_first(cell, key, object) {
            cell.second = key;
        }
    }
}

impl DepthRule for Midpoint {
    fn stored(&self) -> Stored {
        Stored::Midpoint
    }

    #[inline(always)]
    fn resolve(&self, cell: MidpointCell, decode: &Decode, at: DVec2) -> f32 {
        if cell.second == f32::INFINITY {
            return f32::INFINITY;
        }
        let ratio = f64::from(self.ratio);
        decode.depth_of_zeta(decode.zeta(cell.first) * (1.0 - ratio) + decode.zeta(cell.second) * ratio, at)
    }
}

impl Midpoint {
    /// Whether a fragment belongs to the nearest surface.
    ///
    /// Keys are ζ or −1/ζ; of both, a difference relative to the larger key is one of ζ relative to the larger ζ.
    #[inline(always)]
    fn is_first(&self, cell: &MidpointCell, key: f32, object: (u32, bool)) -> bool {
        let (first, key) = (f64::from(cell.first), f64::from(key));
        let coincide = key - first <= f64::from(self.merge) * first.abs().max(key.abs());
        match self.same {
            SameSurface::Depth => coincide,
            SameSurface::Object => coincide && object.0 == cell.object.0,
            SameSurface::Surface => object == cell.object,
        }
    }
}
