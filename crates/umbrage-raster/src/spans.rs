//! What facets cover along the lines of a finer grid: exact, from the same snapped corners as the texels' samples.

use crate::Bins;
use crate::gathered::{Gathered, Shown};
use crate::setup::SUBTEXELS;
use glam::IVec2;
use std::ops::Range;
use umbrage_plane::fearless_simd::{Select, Simd, SimdBase, SimdFloat, f64x4, mask64x4};
use umbrage_plane::{Facet, TexelRect, integers, vectorized};

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
#[derive(Clone, Copy, Debug)]
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
    /// Where the first of them does: the least coordinate along the line that is not before the edge.
    at: i64,
    /// From line to line: quotient and remainder of the movement, over `height`.
    step: (i64, i64),
    remainder: i64,
    height: i64,
}

impl Crossed {
    /// The edge from `top` to `bottom`, both as (along, across), and those lines of a grid, one at least, that cross it: lines y with top ≤ y < bottom.
    #[inline(always)]
    fn of(top: IVec2, bottom: IVec2, grid: Grid, lines: Range<i32>) -> Self {
        let (dx, dy) = (i64::from(bottom.x - top.x), i64::from(bottom.y - top.y));
        // The crossing is before x while dy·(x − top.x) ≥ dx·(y − top.y): from ⌈dx·(y − top.y)/dy⌉ on.
        let upward = dx * i64::from(grid.first + (lines.start << grid.shift) - top.y) + dy - 1;
        let quotient = upward.div_euclid(dy);
        // One line needs no way to the next.
        let step = if lines.len() > 1 {
            let each = dx << grid.shift;
            let quotient = each.div_euclid(dy);
            (quotient, each - quotient * dy)
        } else {
            (0, 0)
        };
        Self { at: i64::from(top.x) + quotient, remainder: upward - quotient * dy, step, height: dy }
    }

    /// The crossing at the first of the lines that are left, which then is the next one.
    #[inline(always)]
    fn next(&mut self) -> i32 {
        let at = self.at as i32;
        // Without a branch, which nobody could predict.
        let carry = i64::from(self.remainder + self.step.1 >= self.height);
        self.at += self.step.0 + carry;
        self.remainder += self.step.1 - carry * self.height;
        at
    }
}

/// How far from the map's origin corners may be for vectors of `f64`, in 1/256 texel, inclusive: twice the side of the largest map. Up to there, the products that say where
/// an edge crosses a line are exact, and the quotient is rounded to a whole number only where it is one.
const NEAR: i32 = 1 << 24;

/// An edge from its end that is met first to the other.
#[derive(Clone, Copy)]
struct Edge<S: Simd> {
    x: f64x4<S>,
    y: f64x4<S>,
    dx: f64x4<S>,
    dy: f64x4<S>,
}

impl<S: Simd> Edge<S> {
    #[inline(always)]
    fn of(simd: S, top: IVec2, bottom: IVec2) -> Self {
        let splat = |number: i32| f64x4::splat(simd, number.into());
        let way = bottom - top;
        Self { x: splat(top.x), y: splat(top.y), dx: splat(way.x), dy: splat(way.y) }
    }

    #[inline(always)]
    fn either(first: mask64x4<S>, a: Self, b: Self) -> Self {
        Self {
            x: first.select(a.x, b.x),
            y: first.select(a.y, b.y),
            dx: first.select(a.dx, b.dx),
            dy: first.select(a.dy, b.dy),
        }
    }

    /// The least coordinate along each line that is not before the edge; meaningless for a line that does not cross the edge.
    #[inline(always)]
    fn crossing(self, y: f64x4<S>) -> f64x4<S> {
        self.x + (self.dx * (y - self.y) / self.dy).ceil()
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
        let gathered = self.gathered(region);
        let Some(band) = gathered.band(region, lines, step) else { return };
        let mut runs = Runs::default();
        for number in 0..gathered.len() as u32 {
            let facet = gathered.facet(number);
            runs.clear();
            vectorized!(simd => band.covered(simd, Shown { number, covers: false }, |_| true, &mut runs));
            for (_, first, along) in runs.iter() {
                for (line, along) in along.iter().enumerate().filter(|(_, along)| !along.is_empty()) {
                    sink(&facet, band.grid.first + (((first + line) as i32) << band.grid.shift), along.clone());
                }
            }
        }
    }
}

/// The lines of a grid over a region, and the facets that were gathered there.
#[derive(Clone, Copy, Debug)]
pub struct Band<'a> {
    gathered: &'a Gathered<'a>,
    lines: Lines,
    grid: Grid,
    /// Where the region begins and ends along the lines.
    low: i32,
    high: i32,
}

impl<'a> Gathered<'a> {
    /// The lines of a grid over a part of what was gathered, as [`Bins::spans`] has them; `None` when there are none.
    #[inline(always)]
    pub fn band(&'a self, region: TexelRect, lines: Lines, step: i32) -> Option<Band<'a>> {
        debug_assert!((2..=SUBTEXELS).contains(&step) && step & (step - 1) == 0, "a step of {step}");
        let window = self.bins.window();
        let region = region.intersect(TexelRect::new(window.min * SUBTEXELS, window.max * SUBTEXELS));
        let (low, high) = (lines.turned(region.min), lines.turned(region.max));
        let (first, shift) = (low.y + (step / 2 - low.y).rem_euclid(step), step.ilog2());
        let count = (high.y - first + step - 1) >> shift;
        let some = !region.is_empty() && count > 0;
        some.then_some(Band { gathered: self, lines, grid: Grid { first, shift, count }, low: low.x, high: high.x })
    }
}

/// What facets cover of parallel lines, in runs: consecutive lines of a facet, with one interval on each.
#[derive(Clone, Debug, Default)]
pub struct Runs {
    all: Vec<Run>,
    along: Vec<Range<i32>>,
    /// Room to work in: where the edges of a polygon cross each line, and how many do.
    crossings: Vec<i32>,
    numbers: Vec<usize>,
}

/// Some lines of a facet.
#[derive(Clone, Debug)]
struct Run {
    facet: u32,
    line: u32,
    /// The intervals among all.
    along: Range<usize>,
}

impl Runs {
    /// Of each run, the number of its facet, that of its first line (both 0-based), and the half-open interval of coordinates, in 1/256 texel, that the facet covers of
    /// this line and of each that follows; empty where it covers nothing. Runs come in the order in which their facets were added; a facet that covers several
    /// parts of a line has several.
    pub fn iter(&self) -> impl Iterator<Item = (u32, usize, &[Range<i32>])> {
        self.all.iter().map(|run| (run.facet, run.line as usize, &self.along[run.along.clone()]))
    }

    /// Forgets all runs.
    pub fn clear(&mut self) {
        self.all.clear();
        self.along.clear();
    }

    #[inline(always)]
    fn end(&mut self, facet: u32, line: usize, start: usize) {
        self.all.push(Run { facet, line: line as u32, along: start..self.along.len() });
    }
}

impl Band<'_> {
    /// Adds to `runs` what a facet covers of the lines, whose numbers are 0-based. Of a facet of which it is not known that it covers the region, `covers` is
    /// false. It is left out when `wants` says of the lines that it crosses that none of them is wanted.
    #[inline(always)]
    pub fn covered<S: Simd>(&self, simd: S, shown: Shown, wants: impl Fn(Range<usize>) -> bool, runs: &mut Runs) {
        let Self { lines, grid, low, high, .. } = *self;
        let (facet, start) = (shown.number, runs.along.len());
        if shown.covers {
            let count = grid.count as usize;
            if wants(0..count) {
                runs.along.extend(std::iter::repeat_n(low..high, count));
                runs.end(facet, 0, start);
            }
            return;
        }
        match *self.gathered.outlines[shown.number as usize].corners {
            [a, b, c] if [a, b, c].iter().all(|corner| corner.abs().max_element() <= NEAR) => {
                let sorted = |a: IVec2, b: IVec2| if a.y <= b.y { (a, b) } else { (b, a) };
                let (a, b) = sorted(lines.turned(a), lines.turned(b));
                let (b, c) = sorted(b, lines.turned(c));
                let (a, b) = sorted(a, b);
                let (top, bottom) = (grid.before(a.y), grid.before(c.y));
                // Most of those that are smaller than a step cross no line.
                if top == bottom || !wants(top as usize..bottom as usize) {
                    return;
                }
                let splat = |number: i32| f64x4::splat(simd, number.into());
                let (long, upper, lower) = (Edge::of(simd, a, c), Edge::of(simd, a, b), Edge::of(simd, b, c));
                let (low, high, middle) = (splat(low), splat(high), splat(grid.before(b.y)));
                let four = f64x4::from_slice(simd, &[0.0, 1.0, 2.0, 3.0]);
                let count = (bottom - top) as usize;
                runs.along.resize(start + count.next_multiple_of(4), 0..0);
                for (line, along) in (top..).step_by(4).zip(runs.along[start..].as_chunks_mut::<4>().0) {
                    let number = splat(line) + four;
                    let y = splat(grid.first) + number * splat(1 << grid.shift);
                    let short = Edge::either(number.simd_lt(middle), upper, lower);
                    let (a, b) = (long.crossing(y), short.crossing(y));
                    let from = a.min(b).max(low);
                    let to = a.max(b).min(high).max(from);
                    let (from, to) = (integers::<4>(from.into()), integers::<4>(to.into()));
                    for lane in 0..4 {
                        along[lane] = from[lane]..to[lane];
                    }
                }
                runs.along.truncate(start + count);
                runs.end(facet, top as usize, start);
            }
            ref corners => self.polygon(facet, corners, wants, runs),
        }
    }

    /// What any polygon covers, however far its corners are.
    #[cold]
    fn polygon(&self, facet: u32, corners: &[IVec2], wants: impl Fn(Range<usize>) -> bool, runs: &mut Runs) {
        let Self { lines, grid, low, high, .. } = *self;
        let edges = corners.iter().zip(corners.iter().cycle().skip(1)).filter_map(|(a, b)| {
            let (a, b) = (lines.turned(*a), lines.turned(*b));
            let (a, b) = if a.y <= b.y { (a, b) } else { (b, a) };
            let crossed = grid.before(a.y)..grid.before(b.y);
            (!crossed.is_empty()).then_some((a, b, crossed))
        });
        let ends = edges.clone().map(|(.., crossed)| (crossed.start, crossed.end));
        let Some((top, bottom)) = ends.reduce(|(top, bottom), (start, end)| (top.min(start), bottom.max(end))) else {
            return;
        };
        let lines = top as usize..bottom as usize;
        if !wants(lines.clone()) {
            return;
        }
        // No line crosses an edge twice.
        let Runs { crossings, numbers, .. } = runs;
        let most = corners.len();
        numbers.clear();
        numbers.resize(lines.len(), 0);
        crossings.clear();
        crossings.resize(lines.len() * most, 0);
        for (a, b, crossed) in edges {
            let mut edge = Crossed::of(a, b, grid, crossed.clone());
            for line in crossed {
                let line = (line - top) as usize;
                crossings[line * most + numbers[line]] = edge.next();
                numbers[line] += 1;
            }
        }
        for (crossings, number) in crossings.chunks_exact_mut(most).zip(&*numbers) {
            crossings[..*number].sort_unstable();
        }
        let several = numbers.iter().max().map_or(0, |most| most / 2);
        for pair in 0..several {
            let start = runs.along.len();
            runs.along.extend(runs.crossings.chunks_exact(most).zip(&runs.numbers).map(|(crossings, number)| {
                let [from, to] = crossings[..*number].as_chunks().0.get(pair).copied().unwrap_or([low; 2]);
                let from = from.max(low);
                from..to.min(high).max(from)
            }));
            runs.end(facet, lines.start, start);
        }
    }
}
