use crate::rule::{largest, number};
use crate::{DepthRule, ROW, RUN, Reduction, Row, Stored};
use glam::DVec2;
use umbrage_plane::{Decode, Facet};

/// The second surface, whichever way it faces, found with two buffers (Wang & Molnar 1994).
///
/// A two-sided sheet is inserted twice, so that it is its own second surface. A texel with a single surface of a solid
/// stores nothing.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Second;

/// What [`Second`] keeps of a tile's row.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SecondRow {
    first: [f32; ROW],
    second: [f32; ROW],
}

impl Row<[f32; 2]> for SecondRow {
    #[inline(always)]
    fn all([first, second]: [f32; 2]) -> Self {
        Self { first: [first; ROW], second: [second; ROW] }
    }

    #[inline(always)]
    fn get(&self, column: usize) -> [f32; 2] {
        [self.first[column], self.second[column]]
    }

    #[inline(always)]
    fn set(&mut self, column: usize, cell: [f32; 2]) {
        [self.first[column], self.second[column]] = cell;
    }
}

impl Reduction for Second {
    /// The two smallest keys, in order.
    type Cell = [f32; 2];
    type Row = SecondRow;
    const EMPTY: [f32; 2] = [f32::INFINITY; 2];

    #[inline(always)]
    fn add(&self, _pass: u32, cell: &mut [f32; 2], key: f32, _front: bool, facet: &Facet) {
        *cell = two_smallest(*cell, key);
        if facet.sheet {
            *cell = two_smallest(*cell, key);
        }
    }

    #[inline(always)]
    fn add_run(&self, _pass: u32, row: &mut SecondRow, first: usize, keys: &[f32; RUN], _front: bool, facet: &Facet) {
        let first = first & (ROW - RUN);
        for _ in 0..=u32::from(facet.sheet) {
            for (column, key) in (first..).zip(keys) {
                row.set(column, two_smallest(row.get(column), *key));
            }
        }
    }

    #[inline(always)]
    fn farthest(&self, _pass: u32, rows: &[SecondRow; ROW]) -> f32 {
        largest(rows.iter().map(|row| &row.second))
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

/// The two smallest keys, in order, once another has come; NaN changes nothing.
#[inline(always)]
fn two_smallest([first, second]: [f32; 2], key: f32) -> [f32; 2] {
    let key = number(key);
    let (nearer, farther) = if key < first { (key, first) } else { (first, key) };
    [nearer, if farther < second { farther } else { second }]
}
