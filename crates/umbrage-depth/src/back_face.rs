use crate::rule::largest;
use crate::{DepthRule, ROW, Reduction, Stored};
use glam::DVec2;
use umbrage_plane::{Decode, Facet};

/// The nearest surface that faces away from the light (Wang & Molnar 1994): front-face culling for
/// polygons, the test of N·L < 0 for curved surfaces, which a facet's [`Facing`](umbrage_plane::Facing) answers texel by texel.
///
/// Two-sided sheets are never culled. An open surface passed off as a solid stores nothing where its front is seen.
/// Equals [`Second`](crate::Second) for solids that do not reach into each other; where they do, it skips hidden fronts.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct BackFace;

impl Reduction for BackFace {
    /// The smallest key among those that take part.
    type Cell = f32;
    type Row = [f32; ROW];
    const EMPTY: f32 = f32::INFINITY;

    #[inline(always)]
    fn add(&self, _pass: u32, cell: &mut f32, key: f32, front: bool, facet: &Facet) {
        if !front || facet.sheet {
            // The smaller without a branch, so that several cells become one vector; of NaN and a number, the number.
            *cell = key.min(*cell);
        }
    }

    #[inline(always)]
    fn farthest(&self, _pass: u32, rows: &[[f32; ROW]; ROW]) -> f32 {
        largest(rows.iter())
    }
}

impl DepthRule for BackFace {
    fn stored(&self) -> Stored {
        Stored::BackFace
    }

    #[inline(always)]
    fn resolve(&self, cell: f32, decode: &Decode, at: DVec2) -> f32 {
        decode.depth(cell, at)
    }
}
