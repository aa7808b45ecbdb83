use crate::{Taps, key::Draws, taps::indices};
use fearless_simd::{Simd, f32x16, i32x16, prelude::*};
use glam::Vec2;
use umbrage_plane::Footprint;

/// The closed box that all taps of a region stay inside.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Area {
    pub low: Vec2,
    pub high: Vec2,
}

impl Area {
    #[inline(always)]
    pub fn of(region: &Footprint) -> Self {
        let half = region.half.max(Vec2::ZERO);
        Self { low: region.centre - half, high: region.centre + half }
    }

    /// Width and height of a cell of a grid over the box.
    #[inline(always)]
    pub fn cell(&self, grid: Grid) -> Vec2 {
        (self.high - self.low) / Vec2::new(grid.columns as f32, grid.rows as f32)
    }

    /// Unweighted taps at the given positions. Rounding may have put one a last bit outside; such are moved onto the border.
    #[inline(always)]
    pub fn taps<S: Simd>(
        &self,
        simd: S,
        numbers: impl Draws,
        (first, mask): (u32, u32),
        (x, y): (f32x16<S>, f32x16<S>),
    ) -> Taps<S> {
        Taps {
            x: x.max(f32x16::splat(simd, self.low.x)).min(f32x16::splat(simd, self.high.x)),
            y: y.max(f32x16::splat(simd, self.low.y)).min(f32x16::splat(simd, self.high.y)),
            u: numbers.lanes(simd, first, 2),
            mask,
            first,
            weight: f32x16::splat(simd, 1.0),
        }
    }
}

/// `total` taps in batches of sixteen: the first index of each, and the mask of those that exist.
#[inline(always)]
pub(crate) fn batches(total: u32) -> impl Iterator<Item = (u32, u32)> {
    (0..total.div_ceil(16)).map(move |batch| {
        let first = batch * 16;
        let left = total - first;
        (first, if left >= 16 { 0xFFFF } else { (1 << left) - 1 })
    })
}

/// A grid of cells, one tap each, row by row.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Grid {
    /// At most 2¹⁷.
    pub columns: u32,
    /// `columns · rows` is below 2³².
    pub rows: u32,
}

impl Grid {
    /// All cells in batches of sixteen.
    #[inline(always)]
    pub fn batches(self) -> impl Iterator<Item = (u32, u32)> {
        batches(self.columns.saturating_mul(self.rows))
    }

    /// Columns and rows of the sixteen cells from `first` on, a multiple of 16.
    #[inline(always)]
    pub fn cells<S: Simd>(self, simd: S, first: u32) -> (f32x16<S>, f32x16<S>) {
        let (row, column) = if first == 0 { (0, 0) } else { (first / self.columns, first % self.columns) };
        let flat = indices(simd, column);
        // Half a column is more than the rounding of this product, so that cutting it off gives the exact quotient.
        let down = ((flat + 0.5) * (1.0 / self.columns as f32)).to_int::<i32x16<S>>().to_float::<f32x16<S>>();
        (flat - down * self.columns as f32, down + row as f32)
    }
}
