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
        insert(cell, key);
        if facet.sheet {
            insert(cell, key);
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
                let later = if keys[i] < second[i] { keys[i] } else { second[i] };
                second[i] = if keys[i] < first[i] { first[i] } else { later };
                first[i] = if keys[i] < first[i] { keys[i] } else { first[i] };
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

#[inline(always)]
fn insert(cell: &mut [f32; 2], key: f32) {
    if key < cell[0] {
        *cell = [key, cell[0]];
    } else if key < cell[1] {
        cell[1] = key;
    }
}
