//! What facets cover along the lines of a finer grid: exact, from the same snapped corners as the texels' samples.

use crate::setup::{Piece, SUBTEXELS};
use crate::{BIN, Bins};
use glam::{IVec2, UVec2};
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

/// What is nearest all over a region.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Seen {
    /// Nothing reaches it.
    Nothing,
    /// One facet covers it, and lies before whatever else reaches it.
    One(Facet),
    /// It may be several, or one with gaps.
    Several,
}

/// Regions that more pieces may reach are not asked what is nearest.
const MOST_ASKED: usize = 32;

/// Three sides, as nearly every piece has, are crossed by a line twice or not at all.
const TRIANGLE: usize = 3;

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
    /// The lines at first + k·step, k from 0 to count, that cross the edge from `a` to `b`, both as (along, across).
    fn of(a: IVec2, b: IVec2, (first, step, count): (i32, i32, i32)) -> Option<Self> {
        let (top, bottom) = if a.y <= b.y { (a, b) } else { (b, a) };
        // Lines y with top ≤ y < bottom.
        let not_before = |y: i32| (y - first + step - 1).div_euclid(step);
        let (from, to) = (not_before(top.y).max(0), not_before(bottom.y).min(count));
        if from >= to {
            return None;
        }
        let (dx, dy) = (i64::from(bottom.x - top.x), i64::from(bottom.y - top.y));
        // The crossing is before x while dy·(x − top.x) ≥ dx·(y − top.y): from ⌈dx·(y − top.y)/dy⌉ on.
        let upward = dx * i64::from(first + from * step - top.y) + dy - 1;
        let each = dx * i64::from(step);
        Some(Self {
            first: from,
            count: to - from,
            at: i64::from(top.x) + upward.div_euclid(dy),
            remainder: upward.rem_euclid(dy),
            step: (each.div_euclid(dy), each.rem_euclid(dy)),
            height: dy,
        })
    }

    /// Calls `each` with every line, counted from 0, and the crossing there.
    fn each(mut self, mut each: impl FnMut(i32, i32)) {
        for line in self.first..self.first + self.count {
            each(line, self.at as i32);
            self.at += self.step.0;
            self.remainder += self.step.1;
            if self.remainder >= self.height {
                self.at += 1;
                self.remainder -= self.height;
            }
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
        debug_assert!((2..=SUBTEXELS).contains(&step) && step & (step - 1) == 0, "a step of {step}");
        let window = self.window();
        let region = region.intersect(TexelRect::new(window.min * SUBTEXELS, window.max * SUBTEXELS));
        if region.is_empty() {
            return;
        }
        let (low, high) = (lines.turned(region.min), lines.turned(region.max));
        let first = low.y + (step / 2 - low.y).rem_euclid(step);
        let count = (high.y - first + step - 1).div_euclid(step);
        if count <= 0 {
            return;
        }
        let grid = (first, step, count);
        let mut crossings: Vec<Vec<i32>> = Vec::new();
        let mut ends = vec![[0; 2]; count as usize];
        self.each_piece(region, |piece, corners| {
            let turned = |corner: &IVec2| lines.turned(*corner);
            let edges = corners.iter().zip(corners.iter().cycle().skip(1));
            let edges = edges.filter_map(|(a, b)| Crossed::of(turned(a), turned(b), grid));
            let facet = piece.facet();
            let mut report = |line: i32, from: i32, to: i32| {
                let (from, to) = (from.max(low.x), to.min(high.x));
                if from < to {
                    sink(&facet, first + line * step, from..to);
                }
            };
            if corners.len() == TRIANGLE {
                let (mut from, mut to) = (count, 0);
                for edge in edges {
                    (from, to) = (from.min(edge.first), to.max(edge.first + edge.count));
                    edge.each(|line, at| {
                        let end = &mut ends[line as usize];
                        *end = [at, end[0]];
                    });
                }
                for line in from..to {
                    let [a, b] = ends[line as usize];
                    report(line, a.min(b), a.max(b));
                }
                return;
            }
            crossings.clear();
            crossings.resize_with(count as usize, Vec::new);
            for edge in edges {
                edge.each(|line, at| crossings[line as usize].push(at));
            }
            for (line, crossed) in (0..).zip(&mut crossings) {
                crossed.sort_unstable();
                for pair in crossed.chunks_exact(2) {
                    report(line, pair[0], pair[1]);
                }
            }
        });
    }

    /// What is nearest all over a region (in 1/256 texel), where its corners decide that: then no sample in it needs to be asked.
    pub fn seen(&self, region: TexelRect) -> Seen {
        let mut pieces: Vec<(Facet, bool)> = Vec::new();
        let corners =
            [region.min, IVec2::new(region.max.x, region.min.y), region.max, IVec2::new(region.min.x, region.max.y)];
        self.each_piece(region, |piece, outline| {
            if pieces.len() <= MOST_ASKED {
                pieces.push((piece.facet(), corners.iter().all(|corner| holds(outline, *corner))));
            }
        });
        if pieces.is_empty() {
            return Seen::Nothing;
        }
        let keys = |facet: &Facet| corners.map(|corner| facet.plane.at(corner.as_dvec2() / f64::from(SUBTEXELS)));
        let before = |nearer: &Facet, other: &Facet| keys(nearer).iter().zip(keys(other)).all(|(a, b)| *a < b);
        let covering = pieces.iter().filter(|(_, covers)| *covers).map(|(facet, _)| facet);
        let nearest = covering.min_by(|a, b| keys(a)[0].total_cmp(&keys(b)[0]));
        match nearest {
            Some(one) if pieces.len() <= MOST_ASKED => {
                let first = pieces.iter().all(|(other, _)| other.triangle == one.triangle || before(one, other));
                if first { Seen::One(*one) } else { Seen::Several }
            }
            _ => Seen::Several,
        }
    }

    /// Calls `each` with every piece that may reach a region of 1/256 texels, once, in order, with its corners.
    fn each_piece(&self, region: TexelRect, mut each: impl FnMut(&Piece, &[IVec2])) {
        let side = BIN as i32 * SUBTEXELS;
        let (from, to) = ((region.min / side).as_uvec2(), ((region.max - 1) / side).as_uvec2());
        let mut lists: Vec<&[u32]> = Vec::new();
        for y in from.y..=to.y {
            for x in from.x..=to.x {
                lists.push(self.list(UVec2::new(x, y)));
            }
        }
        loop {
            let Some(next) = lists.iter().filter_map(|list| list.first()).min().copied() else { return };
            for list in &mut lists {
                if list.first() == Some(&next) {
                    *list = &list[1..];
                }
            }
            let (piece, corners) = self.piece(next);
            let low = corners.iter().fold(IVec2::MAX, |low, corner| low.min(*corner));
            let high = corners.iter().fold(IVec2::MIN, |high, corner| high.max(*corner));
            if low.cmplt(region.max).all() && high.cmpge(region.min).all() {
                each(piece, corners);
            }
        }
    }
}

/// Whether a triangle surely has a point strictly inside; never for an outline of more corners.
fn holds(outline: &[IVec2], at: IVec2) -> bool {
    let side = |a: IVec2, b: IVec2| (b - a).as_i64vec2().perp_dot((at - a).as_i64vec2()).signum();
    let [a, b, c] = *outline else { return false };
    let sides = [side(a, b), side(b, c), side(c, a)];
    sides == [1; 3] || sides == [-1; 3]
}
