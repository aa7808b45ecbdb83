//! What facets cover along the lines of a finer grid: exact, from the same snapped corners as the texels' samples.

use crate::Bins;
use crate::gathered::Gathered;
use crate::setup::SUBTEXELS;
use glam::IVec2;
use std::ops::Range;
use umbrage_plane::{Facet, TexelRect};

/// Which way lines run over a map.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Lines {
    /// To the right; a line is named by its y.
    Rows,
    /// Downward; a line is named by its x.
    Columns,
}

impl Lines {
    /// A point of the map as (along the line, across the lines), and back.
    #[inline(always)]
    fn turned(self, at: IVec2) -> IVec2 {
        match self {
            Self::Rows => at,
            Self::Columns => IVec2::new(at.y, at.x),
        }
    }
}

/// Lines at first + k·2^`shift`, k from 0 to `count`.
#[derive(Clone, Copy)]
struct Grid {
    first: i32,
    shift: u32,
    count: i32,
}

impl Grid {
    /// How many of the lines are before a coordinate. Shifts round down, below 0 too.
    #[inline(always)]
    fn before(self, at: i32) -> i32 {
        ((at - self.first + (1 << self.shift) - 1) >> self.shift).clamp(0, self.count)
    }
}

/// An edge from its end that is met first to the other, with the lines that cross it.
struct Crossed {
    /// The first line that crosses it and how many do.
    first: i32,
    count: i32,
    /// Where the first of them does: the least coordinate along the line that is not before the edge.
    at: i64,
    /// From line to line: quotient and remainder of the movement, over `height`.
    step: (i64, i64),
    remainder: i64,
    height: i64,
}

impl Crossed {
    /// By no line.
    const NOWHERE: Self = Self { first: 0, count: 0, at: 0, step: (0, 0), remainder: 0, height: 1 };

    /// The lines of a grid that cross the edge from `a` to `b`, both as (along, across).
    #[inline(always)]
    fn of(a: IVec2, b: IVec2, grid: Grid) -> Self {
        let (top, bottom) = if a.y <= b.y { (a, b) } else { (b, a) };
        // Lines y with top ≤ y < bottom.
        let (from, to) = (grid.before(top.y), grid.before(bottom.y));
        if from >= to {
            return Self::NOWHERE;
        }
        let (dx, dy) = (i64::from(bottom.x - top.x), i64::from(bottom.y - top.y));
        // The crossing is before x while dy·(x − top.x) ≥ dx·(y − top.y): from ⌈dx·(y − top.y)/dy⌉ on.
        let upward = dx * i64::from(grid.first + (from << grid.shift) - top.y) + dy - 1;
        let quotient = upward.div_euclid(dy);
        // One line needs no way to the next.
        let step = if to - from > 1 {
            let each = dx << grid.shift;
            let quotient = each.div_euclid(dy);
            (quotient, each - quotient * dy)
        } else {
            (0, 0)
        };
        Self {
            first: from,
            count: to - from,
            at: i64::from(top.x) + quotient,
            remainder: upward - quotient * dy,
            step,
            height: dy,
        }
    }

    /// Calls `each` with every line, counted from 0, and the crossing there.
    #[inline(always)]
    fn each(mut self, mut each: impl FnMut(i32, i32)) {
        for line in self.first..self.first + self.count {
            each(line, self.at as i32);
            // Without a branch, which nobody could predict.
            let carry = i64::from(self.remainder + self.step.1 >= self.height);
            self.at += self.step.0 + carry;
            self.remainder += self.step.1 - carry * self.height;
        }
    }
}

impl Bins {
    /// Calls `sink` with what each facet covers of the lines of a grid, in the order of the triangles: the facet, the line's coordinate,
    /// and the half-open interval of coordinates along it, all in 1/256 texel of the map.
    ///
    /// Lines are those in `region` (in 1/256 texel) whose coordinate is step/2 more than a multiple of `step`, which is a power of two
    /// from 2 to 256; intervals are cut to `region`. A point on the edge between two triangles belongs to exactly one of them; of
    /// [`Lines::Rows`] a texel's centre belongs to whom [`Bins::tile`] gives it. Nothing outside the bins' window is covered. The view's own
    /// sampling is of no effect. The bins must be [for spans](Bins::for_spans), unless nothing but texels' centres is of interest: others leave
    /// out what lies between those.
    ///
    /// ```
    /// # use glam::{DVec3, IVec2, UVec2};
    /// # use umbrage_plane::{TexelRect, View};
    /// # use umbrage_raster::{Bins, Cull, Lines, Triangle};
    /// let view = View::orthographic(DVec3::ZERO, DVec3::NEG_Z, DVec3::Y, 16.0, 1.0, 9.0, UVec2::splat(32)).unwrap();
    /// let corners = [(0.0, 0.0), (3.0, 0.0), (0.0, 3.0)].map(|(x, y)| DVec3::new(x, y, -5.0));
    /// let triangle = Triangle { corners, object: 7, sheet: false };
    /// let bins = Bins::for_spans(&view, TexelRect::of_size(view.size()), Cull::None, [triangle]);
    /// // Half a texel below the upper corner at (16, 13), the triangle is half a texel wide.
    /// let region = TexelRect::new(IVec2::ZERO, IVec2::splat(32 * 256));
    /// let mut spans = Vec::new();
    /// bins.spans(region, Lines::Rows, 256, |_, y, x| spans.push((y, x)));
    /// assert_eq!(spans[0], (13 * 256 + 128, 16 * 256..16 * 256 + 128));
    /// ```
    pub fn spans(&self, region: TexelRect, lines: Lines, step: i32, mut sink: impl FnMut(&Facet, i32, Range<i32>)) {
        let sink = |_: usize, facet: &Facet, line: i32, along: Range<i32>| sink(facet, line, along);
        self.gathered(region).spans(region, lines, step, |_| true, sink);
    }
}

impl Gathered<'_> {
    /// [`Bins::spans`] of a part of what was gathered, for those facets whose bounding box in 1/256 texel (the last row and column of which
    /// may be empty) is `wanted`. The first that `sink` is given is the facet's number, 0-based among all that were gathered.
    #[inline(always)]
    pub fn spans(
        &self,
        region: TexelRect,
        lines: Lines,
        step: i32,
        wanted: impl Fn(TexelRect) -> bool,
        mut sink: impl FnMut(usize, &Facet, i32, Range<i32>),
    ) {
        debug_assert!((2..=SUBTEXELS).contains(&step) && step & (step - 1) == 0, "a step of {step}");
        let window = self.bins.window();
        let region = region.intersect(TexelRect::new(window.min * SUBTEXELS, window.max * SUBTEXELS));
        if region.is_empty() {
            return;
        }
        let (low, high) = (lines.turned(region.min), lines.turned(region.max));
        let (first, shift) = (low.y + (step / 2 - low.y).rem_euclid(step), step.ilog2());
        let count = (high.y - first + step - 1) >> shift;
        if count <= 0 {
            return;
        }
        let grid = Grid { first, shift, count };
        let mut crossings: Vec<Vec<i32>> = Vec::new();
        let mut ends = vec![[0; 2]; count as usize];
        for (number, outline) in self.outlines.iter().enumerate() {
            let (from, to) = (grid.before(lines.turned(outline.low).y), grid.before(lines.turned(outline.high).y));
            if from >= to || !outline.touches(region) || !wanted(outline.bounds()) {
                continue;
            }
            let (piece, corners) = self.bins.piece(outline.piece);
            let facet = piece.facet();
            // Three sides, as nearly every piece has, are crossed by a line twice or not at all.
            let triangle = corners.len() == 3;
            if let &[a, b, c] = corners {
                let (a, b, c) = (lines.turned(a), lines.turned(b), lines.turned(c));
                for (a, b) in [(a, b), (b, c), (c, a)] {
                    Crossed::of(a, b, grid).each(|line, at| {
                        let end = &mut ends[line as usize];
                        *end = [at, end[0]];
                    });
                }
            } else {
                crossings.iter_mut().for_each(Vec::clear);
                crossings.resize_with(count as usize, Vec::new);
                for (a, b) in corners.iter().zip(corners.iter().cycle().skip(1)) {
                    Crossed::of(lines.turned(*a), lines.turned(*b), grid)
                        .each(|line, at| crossings[line as usize].push(at));
                }
                for crossed in &mut crossings {
                    crossed.sort_unstable();
                }
            }
            for line in from..to {
                let [a, b] = ends[line as usize];
                let two = [a.min(b), a.max(b)];
                let crossed = if triangle { &two } else { crossings[line as usize].as_slice() };
                for pair in crossed.chunks_exact(2) {
                    let (from, to) = (pair[0].max(low.x), pair[1].min(high.x));
                    if from < to {
                        sink(number, &facet, first + (line << shift), from..to);
                    }
                }
            }
        }
    }
}
