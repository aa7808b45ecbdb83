use crate::{
    Key, Pattern, Taps,
    grid::{Area, Grid},
    key::Draws,
};
use fearless_simd::{Simd, f32x16};
use glam::{UVec2, Vec2};
use umbrage_plane::Footprint;

/// One random position in each cell of a grid over the bounding box (Reeves 1987, Fig. 3c and Fig. 4):
/// close to a Poisson disc, and less noisy than independent positions. The default.
///
/// Departures from the printed listing: (1) both counts are at least `min_samples` and never 0;
/// (2) the jitter spans the whole cell, so that no part of the box is left out; (3) a region without extent is one tap.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub struct Jittered {
    /// Wanted number of taps; 0 counts as 1, and no more than 65,536 are taken. Not a bound: up to half as many again are used with
    /// `min_samples` 1, up to `min_samples` times as many otherwise.
    pub num_samples: u32,
    /// Least number of cells along each axis, at most `num_samples`.
    pub min_samples: u32,
    /// Size of the jitter in cells, 0 (regular grid) to 1 (the whole cell).
    pub jitter: f32,
    /// Whether `num_samples` is a bound: the longer side of the grid is then shortened, below `min_samples` if it must be.
    pub hard_cap: bool,
}

impl Default for Jittered {
    /// The values of Fig. 4.
    fn default() -> Self {
        Self { num_samples: 16, min_samples: 1, jitter: 1.0, hard_cap: false }
    }
}

umbrage_plane::builders!([] Jittered {
    with_num_samples num_samples: u32,
    with_min_samples min_samples: u32,
    with_jitter jitter: f32,
    with_hard_cap hard_cap: bool,
});

/// (k − ½)² for k = 1 to 16.
const HALVES_SQUARED: [f32; 16] = {
    let mut table = [0.0; 16];
    let mut k = 0;
    while k < 16 {
        table[k] = (k as f32 + 0.5) * (k as f32 + 0.5);
        k += 1;
    }
    table
};

impl Jittered {
    /// Columns and rows of the grid for a region of the given half-extents, in texels.
    ///
    /// While the region covers fewer texels than there are taps, one column a texel; beyond, cells as near to squares as the
    /// number of taps allows. Rows are counted first, so the two axes are not alike.
    #[inline(always)]
    pub fn counts(&self, half: Vec2) -> UVec2 {
        let n = self.num_samples.clamp(1, 65_536);
        let m = self.min_samples.clamp(1, n);
        let (a, b) = (half.x.max(0.0), half.y.max(0.0));
        if a == 0.0 && b == 0.0 {
            return UVec2::ONE;
        }
        let (ns, nt) = if 4.0 * a * b < n as f32 {
            let texels = |half: f32| ((2.0 * half + 0.5) as u32).clamp(m, n);
            (texels(a), texels(b))
        } else {
            let nt = rows(a, b, n).clamp(m, n);
            // ⌊n/nt + ½⌋
            (((2 * n + nt) / (2 * nt)).clamp(m, n), nt)
        };
        if self.hard_cap && u64::from(ns) * u64::from(nt) > u64::from(n) {
            return if ns > nt { UVec2::new(n / nt, nt) } else { UVec2::new(ns, n / ns) };
        }
        UVec2::new(ns, nt)
    }
}

/// The number of k in 1..=n with b·n ≥ (k − ½)²·a: ⌊√(b·n/a) + ½⌋ without root or quotient.
#[inline(always)]
fn rows(a: f32, b: f32, n: u32) -> u32 {
    let reach = b * n as f32;
    let count: u32 = HALVES_SQUARED.iter().map(|square| u32::from(reach >= square * a)).sum();
    if count < 16 || n <= 16 {
        return count;
    }
    let more = (16..n).take_while(|&k| reach >= (k as f32 + 0.5) * (k as f32 + 0.5) * a).count();
    count + more as u32
}

impl Jittered {
    /// The grid for a region of the given half-extents.
    #[inline(always)]
    pub(crate) fn grid(&self, half: Vec2) -> Grid {
        let counts = self.counts(half);
        Grid { columns: counts.x, rows: counts.y }
    }

    /// Where in the grid the sixteen taps from `first` on are, in cells from its corner.
    #[inline(always)]
    pub(crate) fn places<S: Simd>(
        &self,
        simd: S,
        grid: Grid,
        numbers: impl Draws,
        first: u32,
    ) -> (f32x16<S>, f32x16<S>) {
        let (i, j) = grid.cells(simd, first);
        // R87-13's (i + ½)·ds + rand11·ds/2, with rand11 = 2·rand01 − 1.
        let x = i + 0.5 + (numbers.lanes(simd, first, 0) - 0.5) * self.jitter;
        let y = j + 0.5 + (numbers.lanes(simd, first, 1) - 0.5) * self.jitter;
        (x, y)
    }
}

impl Pattern for Jittered {
    #[inline(always)]
    fn taps<S: Simd>(&self, simd: S, region: &Footprint, key: Key, mut each: impl FnMut(&Taps<S>)) {
        let (area, grid) = (Area::of(region), self.grid(region.half));
        let cell = area.cell(grid);
        for batch in grid.batches() {
            let (x, y) = self.places(simd, grid, key, batch.0);
            each(&area.taps(simd, key, batch, (x * cell.x + area.low.x, y * cell.y + area.low.y)));
        }
    }
}
