use crate::rule::{largest, number};
use crate::{DepthRule, ROW, Reduction, Stored};
use glam::DVec2;
use umbrage_plane::{Decode, Facet};

/// The nearest surface (Williams 1978; Reeves 1987, §3.1).
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct First;

impl Reduction for First {
    /// The smallest key.
    type Cell = f32;
    type Row = [f32; ROW];
    const EMPTY: f32 = f32::INFINITY;

    #[inline(always)]
    fn add(&self, _pass: u32, cell: &mut f32, key: f32, _front: bool, _facet: &Facet) {
        // The smaller one without a branch, so that several cells become one vector.
        *cell = cell.min(number(key));
    }

    #[inline(always)]
    fn farthest(&self, _pass: u32, rows: &[[f32; ROW]; ROW]) -> f32 {
        largest(rows.iter())
    }
}

impl DepthRule for First {
    fn stored(&self) -> Stored {
        Stored::First
    }

    #[inline(always)]
    fn resolve(&self, cell: f32, decode: &Decode, at: DVec2) -> f32 {
        decode.depth(cell, at)
    }
}
