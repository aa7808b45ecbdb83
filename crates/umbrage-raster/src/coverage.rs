//! Which samples of a tile lie inside a polygon, exactly.
//!
//! A sample is inside when a ray to its right crosses the outline an odd number of times. An edge from (a_x, a_y) down to (b_x, b_y) is crossed
//! when a_y ≤ y < b_y and its crossing lies strictly to the right. For a triangle this is the top-left rule. Each edge's part is a function
//! of its two ends alone, so two polygons that share an edge never both claim a sample on it, and never both leave it.

use crate::BIN;
use crate::piece::{PATCH, Patch};
use crate::setup::{Reach, SUBTEXELS, bounds};
use glam::{IVec2, UVec2};
use std::ops::Range;
use umbrage_plane::{Sampling, TexelRect};

const SIDE: i32 = BIN as i32;

/// The texels of one tile that a facet covers.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Coverage {
    /// Bit x of row y: texel (x, y) of the tile is covered.
    pub rows: [u32; 32],
    /// First row with a bit set.
    pub first: u8,
    /// One past the last row with a bit set.
    pub end: u8,
}

impl Coverage {
    /// How many texels are covered.
    #[inline(always)]
    pub fn count(&self) -> u32 {
        self.rows[usize::from(self.first)..usize::from(self.end)].iter().map(|row| row.count_ones()).sum()
    }

    /// None yet.
    pub(crate) const NOTHING: Self = Self { rows: [0; 32], first: 0, end: 0 };

    /// Makes it that of a patch, some texel of which is covered.
    #[inline(always)]
    pub(crate) fn set(&mut self, patch: Patch) {
        let ((column, row), covered) = (patch.at(), patch.covered());
        self.rows = [0; 32];
        for below in 0..PATCH as u32 {
            // Rows past the tile's last, of which none is covered, come round to others that are not.
            let bits = covered >> (PATCH as u32 * below) & 0xf;
            self.rows[(row + below) as usize % 32] = bits << column;
        }
        self.first = (row + covered.trailing_zeros() / PATCH as u32) as u8;
        self.end = (row + covered.ilog2() / PATCH as u32) as u8 + 1;
    }

    /// From rows of which only those of `within` may have a bit set; `None` when none has.
    fn new(rows: [u32; 32], within: Range<i32>) -> Option<Self> {
        let first = within.clone().find(|&row| rows[row as usize] != 0)?;
        let last = within.rev().find(|&row| rows[row as usize] != 0)?;
        Some(Self { rows, first: first as u8, end: last as u8 + 1 })
    }
}

/// An edge relative to a tile's upper left corner, in 1/256 texel, from its upper end downward. Horizontal edges are crossed by no ray.
struct Edge {
    top: IVec2,
    bottom: IVec2,
}

impl Edge {
    /// The direction, in wider numbers: components are below 2³⁰ in size, products with offsets inside a tile's row below 2⁶¹.
    fn along(&self) -> (i64, i64) {
        let along = (self.bottom - self.top).as_i64vec2();
        (along.x, along.y)
    }

    /// Positive when the crossing at the height of (x, y) lies to the right of it: the distance times the edge's height.
    fn ahead(&self, x: i32, y: i32) -> i64 {
        let (dx, dy) = self.along();
        dx * i64::from(y - self.top.y) - dy * i64::from(x - self.top.x)
    }
}

/// Triangles up to this width and height, in 1/256 texel, are covered in 32-bit numbers: of a tile's texels and 64 more, products of
/// coordinates and of sizes stay below 2²⁹.
const NARROW: i32 = 64 * SUBTEXELS;

/// Where an edge of a narrow triangle is crossed, from a row on downward.
struct Crossing {
    /// [`Edge::ahead`] at the first column of the next row, its change from row to row, and from column to column to the left.
    ahead: i32,
    step: i32,
    width: i32,
}

impl Crossing {
    /// Of the edge from `top` to `bottom`, relative to the first sample.
    #[inline(always)]
    fn of(top: IVec2, bottom: IVec2, row: i32) -> Self {
        let along = bottom - top;
        let ahead = along.x * (row * SUBTEXELS - top.y) + along.y * top.x;
        Self { ahead, step: along.x * SUBTEXELS, width: along.y * SUBTEXELS }
    }

    /// The columns from whose samples the edge is crossed in this row. Then the next row's turn comes.
    #[inline(always)]
    fn next(&mut self) -> u32 {
        // ⌈ahead / width⌉ of them.
        let upward = (self.ahead + self.width - 1).max(0) as u32;
        self.ahead += self.step;
        below((upward / self.width as u32) as i32)
    }
}

/// A tile's samples.
pub(crate) struct Samples {
    /// The tile's upper left corner, in texels.
    origin: IVec2,
    /// Columns (as a mask) and rows of the tile that are inside the window.
    columns: u32,
    rows: Range<i32>,
    sampling: Sampling,
    /// Jittered samples' offsets in their texels, row by row; empty when they are at the centres.
    offsets: Vec<[u8; 2]>,
}

impl Samples {
    /// The samples of a tile that lie in `window`; `None` when there are none.
    pub fn of(tile: UVec2, window: TexelRect, sampling: Sampling) -> Option<Self> {
        let origin = (tile * BIN).as_ivec2();
        let inside = TexelRect::new(origin, origin + SIDE).intersect(window);
        if inside.is_empty() {
            return None;
        }
        let (low, high) = (inside.min - origin, inside.max - origin);
        let offsets = match sampling {
            Sampling::Centre => Vec::new(),
            Sampling::Jittered { .. } => TexelRect::new(origin, origin + SIDE)
                .texels()
                .map(|texel| sampling.offset_256(texel).to_array().map(|offset| offset as u8))
                .collect(),
        };
        Some(Self { origin, columns: below(high.x) & !below(low.x), rows: low.y..high.y, sampling, offsets })
    }

    /// Makes a coverage that of a polygon; whether any sample is inside.
    #[inline(always)]
    pub fn inside(&self, corners: &[IVec2], coverage: &mut Coverage) -> bool {
        if let (Sampling::Centre, &[a, b, c]) = (self.sampling, corners) {
            let (low, high) = bounds(corners);
            if (high - low).max_element() <= NARROW {
                return self.narrow([a, b, c], coverage);
            }
        }
        self.of_any(corners).is_some_and(|found| {
            *coverage = found;
            true
        })
    }

    /// The samples inside any polygon; `None` when there are none.
    #[inline(never)]
    fn of_any(&self, corners: &[IVec2]) -> Option<Coverage> {
        match self.sampling {
            Sampling::Centre => self.centres(corners),
            Sampling::Jittered { .. } => self.jittered(corners),
        }
    }

    /// [`Samples::centres`] of a triangle that is at most [`NARROW`] wide and high, in 32-bit integers.
    #[inline(always)]
    fn narrow(&self, [a, b, c]: [IVec2; 3], coverage: &mut Coverage) -> bool {
        // From above downward, relative to the first sample: samples then lie at multiples of 256.
        let origin = self.origin * SUBTEXELS + SUBTEXELS / 2;
        let sorted = |a: IVec2, b: IVec2| if a.y <= b.y { (a, b) } else { (b, a) };
        let (a, b) = sorted(a - origin, b - origin);
        let (b, c) = sorted(b, c - origin);
        let (a, b) = sorted(a, b);
        // Every row is crossed by the longest edge and by one of the others.
        let row = |corner: IVec2| ((corner.y + SUBTEXELS - 1) >> 8).clamp(self.rows.start, self.rows.end);
        let (from, middle, to) = (row(a), row(b), row(c));
        if from == to || a.x.max(b.x).max(c.x) <= 0 || a.x.min(b.x).min(c.x) > (SIDE - 1) * SUBTEXELS {
            return false;
        }
        coverage.rows = [0; SIDE as usize];
        let (mut first, mut end) = (SIDE, 0);
        let mut longest = Crossing::of(a, c, from);
        for (mut other, within) in [(Crossing::of(a, b, from), from..middle), (Crossing::of(b, c, middle), middle..to)]
        {
            for row in within {
                let covered = (longest.next() ^ other.next()) & self.columns;
                coverage.rows[row as usize & (SIDE as usize - 1)] = covered;
                if covered != 0 {
                    first = first.min(row);
                    end = row + 1;
                }
            }
        }
        (coverage.first, coverage.end) = (first as u8, end as u8);
        end > 0
    }

    fn edges<'a>(&self, corners: &'a [IVec2]) -> impl Iterator<Item = Edge> + use<'a> {
        let origin = self.origin * SUBTEXELS;
        let ends = corners.iter().zip(corners.iter().cycle().skip(1));
        ends.map(move |(&a, &b)| {
            let (top, bottom) = if a.y <= b.y { (a, b) } else { (b, a) };
            Edge { top: top - origin, bottom: bottom - origin }
        })
    }

    fn centres(&self, corners: &[IVec2]) -> Option<Coverage> {
        let mut rows = [0; 32];
        let (mut first, mut end) = (SIDE, 0);
        for edge in self.edges(corners) {
            // Row r's samples are at 256 r + 128: those from ⌈(top − 128) / 256⌉ on are not above the top.
            let from = ((edge.top.y + 127) >> 8).max(self.rows.start);
            let to = ((edge.bottom.y + 127) >> 8).min(self.rows.end);
            if from < to {
                cross_rows(&edge, from, &mut rows[from as usize..to as usize]);
                first = first.min(from);
                end = end.max(to);
            }
        }
        let within = first..end.max(first);
        for row in within.clone() {
            rows[row as usize] &= self.columns;
        }
        Coverage::new(rows, within)
    }

    fn jittered(&self, corners: &[IVec2]) -> Option<Coverage> {
        let touched = Reach::Samples(self.sampling).texels(bounds(corners));
        let (low, high) = (touched.min - self.origin, touched.max - self.origin);
        let columns = below(high.x) & !below(low.x) & self.columns;
        let within = low.y.max(self.rows.start)..high.y.min(self.rows.end);
        if columns == 0 || within.is_empty() {
            return None;
        }
        let mut rows = [0; 32];
        for edge in self.edges(corners) {
            for row in within.clone() {
                rows[row as usize] ^= self.cross_jittered_row(&edge, row, columns);
            }
        }
        Coverage::new(rows, within)
    }

    /// The columns of a row, among `columns` (not 0), from whose samples the edge is crossed.
    fn cross_jittered_row(&self, edge: &Edge, row: i32, columns: u32) -> u32 {
        let (top, left) = (row * SUBTEXELS, columns.trailing_zeros() as i32 * SUBTEXELS);
        let (bottom, right) = (top + SUBTEXELS - 1, (SIDE - columns.leading_zeros() as i32) * SUBTEXELS - 1);
        if edge.bottom.y <= top || edge.top.y > bottom {
            return 0;
        }
        if edge.ahead(left, top).max(edge.ahead(left, bottom)) <= 0 {
            return 0;
        }
        if edge.top.y <= top && edge.bottom.y > bottom && edge.ahead(right, top).min(edge.ahead(right, bottom)) > 0 {
            return columns;
        }
        let offsets = &self.offsets[(row * SIDE) as usize..][..SIDE as usize];
        let first = columns.trailing_zeros() as usize;
        let last = SIDE as usize - columns.leading_zeros() as usize;
        let mut crossed = 0;
        for (column, [x, y]) in offsets.iter().enumerate().take(last).skip(first) {
            let (x, y) = (column as i32 * SUBTEXELS + i32::from(*x), top + i32::from(*y));
            let hit = (edge.top.y..edge.bottom.y).contains(&y) && edge.ahead(x, y) > 0;
            crossed |= u32::from(hit) << column;
        }
        crossed & columns
    }
}

/// A mask of the first `count` columns; none for a negative count, all for one above 32.
#[inline(always)]
fn below(count: i32) -> u32 {
    ((1_u64 << count.clamp(0, SIDE)) - 1) as u32
}

/// Crosses an edge in consecutive rows, the first of which is row `from` of the tile: flips the columns whose centre is to the left of the crossing.
fn cross_rows(edge: &Edge, from: i32, rows: &mut [u32]) {
    let (dx, dy) = edge.along();
    // Column c is to the left while c · dy · 256 < ahead, ahead taken at column 0.
    let step = dx * i64::from(SUBTEXELS);
    let width = dy * i64::from(SUBTEXELS);
    let start = edge.ahead(SUBTEXELS / 2, from * SUBTEXELS + SUBTEXELS / 2);
    let stop = start + step * (rows.len() as i64 - 1);
    if start.max(stop) <= 0 {
        return;
    }
    if start.min(stop) > width * i64::from(SIDE - 1) {
        for row in rows {
            *row ^= u32::MAX;
        }
        return;
    }
    // ⌈ahead / width⌉ of each row, by quotient and remainder: exact, and two divisions for all rows.
    let upward = start + width - 1;
    let (mut quotient, mut remainder) = (upward.div_euclid(width), upward.rem_euclid(width));
    let (more, rest) = if rows.len() > 1 { (step.div_euclid(width), step.rem_euclid(width)) } else { (0, 0) };
    for row in rows {
        *row ^= below(quotient.clamp(0, i64::from(SIDE)) as i32);
        quotient += more;
        remainder += rest;
        if remainder >= width {
            quotient += 1;
            remainder -= width;
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    /// A corner near a tile: anywhere, or where samples lie on edges and corners.
    fn corner(half: i32) -> impl Strategy<Value = IVec2> {
        let axis = move || prop_oneof![-half..half, (-half / 128..half / 128).prop_map(|halves| halves * 128)];
        (axis(), axis()).prop_map(IVec2::from)
    }

    proptest! {
        #![proptest_config(ProptestConfig::with_cases(20_000))]

        #[test]
        fn x2_narrow_triangles_are_covered_as_any(
            at in corner(40 * SUBTEXELS),
            offsets in prop_oneof![
                [corner(300), corner(300), corner(300)],
                [corner(16 * SUBTEXELS), corner(16 * SUBTEXELS), corner(16 * SUBTEXELS)],
                [corner(NARROW / 2), corner(NARROW / 2), corner(NARROW / 2)],
            ],
            window in (corner(40 * SUBTEXELS), corner(40 * SUBTEXELS)),
        ) {
            let origin = IVec2::splat(5 * SIDE);
            let corners = offsets.map(|offset| (origin + SIDE / 2) * SUBTEXELS + at + offset);
            let (low, high) = (window.0.min(window.1), window.0.max(window.1));
            let window = TexelRect::new(origin + (low >> 8), origin + (high >> 8) + SIDE);
            if let Some(samples) = Samples::of(UVec2::splat(5), window, Sampling::Centre) {
                // Whatever it held before is gone.
                let mut coverage = Coverage { rows: [7; 32], first: 3, end: 9 };
                let found = samples.narrow(corners, &mut coverage).then_some(coverage);
                prop_assert_eq!(found, samples.of_any(&corners));
            }
        }
    }
}
