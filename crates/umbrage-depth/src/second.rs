use crate::{DepthRule, Reduction, Stored};
use glam::DVec2;
use umbrage_plane::{Decode, Facet};

/// The second surface, whichever way it faces, found with two buffers (Wang & Molnar 1994; WM94-1 i).
///
/// A two-sided sheet is inserted twice, so that it is its own second surface (WM94-3). A texel with a single surface of a solid
/// stores nothing (V53).
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Second;

impl Reduction for Second {
    /// The two smallest keys, in order.
    type Cell = [f32; 2];
    const EMPTY: [f32; 2] = [f32::INFINITY; 2];

    #[inline(always)]
    fn add(&self, _pass: u32, cell: &mut [f32; 2], key: f32, _front: bool, facet: &Facet) {
        insert(cell, key);
        if facet.sheet {
            insert(cell, key);
        }
    }
}

impl DepthRule for Second {
    fn stored(&self) -> Stored {
        Stored::Second
    }

    #[inline(always)]
    fn resolve(&self, cell: [f32; 2], decode: &Decode, at: DVec2) -> f32 {
        decode.depth(cell[1], at)
    }
}

/// Without a branch, so that several cells become one vector.
#[inline(always)]
fn insert(cell: &mut [f32; 2], key: f32) {
    let [first, second] = *cell;
    let later = if key < second { key } else { second };
    *cell = if key < first { [key, first] } else { [first, later] };
}
