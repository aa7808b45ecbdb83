use crate::{DepthRule, RUN, Reduction, Stored};
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
        *cell = two_smallest(*cell, key);
        if facet.sheet {
            *cell = two_smallest(*cell, key);
        }
    }

    #[inline(always)]
    fn add_run(&self, _pass: u32, cells: &mut [[f32; 2]; RUN], keys: &[f32; RUN], _front: bool, facet: &Facet) {
        let (mut first, mut second) = ([0.0; RUN], [0.0; RUN]);
        for i in 0..RUN {
            [first[i], second[i]] = cells[i];
        }
        for _ in 0..=u32::from(facet.sheet) {
            for i in 0..RUN {
                [first[i], second[i]] = two_smallest([first[i], second[i]], keys[i]);
            }
        }
        for i in 0..RUN {
            cells[i] = [first[i], second[i]];
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

/// The two smallest keys, in order, once another has come; NaN changes nothing. Of minima and maxima, so that no branch is made of it.
#[inline(always)]
fn two_smallest([first, second]: [f32; 2], key: f32) -> [f32; 2] {
    let other = if key.is_nan() { f32::INFINITY } else { key.max(first) };
    [key.min(first), other.min(second)]
}
