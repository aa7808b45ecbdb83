//! The nearest facets at the points of a grid.

use super::casters::Casters;
use glam::{DVec2, IVec2};
use std::ops::Range;
use umbrage_depth::NO_FACET;
use umbrage_plane::{Affine, TexelRect};
use umbrage_raster::{Lines, Shown};

/// 1/256 texel: corners are snapped to multiples of it, as are all places here.
pub(super) const SUBTEXELS: i32 = 256;

/// A place of the map in texels, of one in 1/256 texel.
#[inline(always)]
pub(super) fn texels(at: IVec2) -> DVec2 {
    at.as_dvec2() * (1.0 / f64::from(SUBTEXELS))
}

/// Column and row of an index, row by row.
#[inline(always)]
pub(super) fn place_of(index: usize, columns: usize) -> IVec2 {
    IVec2::new((index % columns) as i32, (index / columns) as i32)
}

/// The points of a grid that lie in an interval: those at first + k·2^`shift`, k from 0 to count.
#[inline(always)]
pub(super) fn points(along: &Range<i32>, first: i32, shift: u32, count: usize) -> Range<usize> {
    // Shifts round down, below 0 too.
    let index = |at: i32| ((at - first + (1 << shift) - 1) >> shift).clamp(0, count as i32) as usize;
    index(along.start)..index(along.end)
}

/// The part of a line that a facet covers, in 1/256 texel.
#[derive(Clone, Debug)]
pub(super) struct Span {
    pub facet: u32,
    /// Whether the facet may have holes.
    pub masked: bool,
    pub along: Range<i32>,
}

/// The parts of parallel lines over a region that the facets that may be seen in it cover, in the order of the triangles for each line.
#[derive(Default)]
pub(super) struct Spans {
    lines: Vec<Vec<Span>>,
}

impl Spans {
    /// Makes them those of a region's lines, of which there are no more than `count`.
    #[inline(always)]
    pub fn set<'s>(
        &mut self,
        casters: &Casters<'_>,
        region: TexelRect,
        lines: Lines,
        step: i32,
        count: usize,
        shown: impl IntoIterator<Item = &'s Shown>,
    ) {
        if self.lines.len() < count {
            self.lines.resize_with(count, Vec::new);
        }
        self.lines[..count].iter_mut().for_each(Vec::clear);
        let Some(band) = casters.gathered.band(region, lines, step) else { return };
        for shown in shown {
            let facet = shown.number;
            let masked = casters.masks.of(&casters.gathered.facet(facet)).is_some();
            band.covered(
                *shown,
                #[inline(always)]
                |line, along| self.lines[line].push(Span { facet, masked, along }),
            );
        }
    }

    #[inline(always)]
    pub fn line(&self, line: usize) -> &[Span] {
        &self.lines[line]
    }
}

/// The points of a square grid: the place of the first and the distance to the next, in 1/256 texel, and the number along a side.
#[derive(Clone, Copy)]
pub(super) struct Grid {
    pub first: IVec2,
    pub step: i32,
    pub side: usize,
}

impl Grid {
    /// The place of a point, in 1/256 texel.
    #[inline(always)]
    pub fn place(self, [x, y]: [usize; 2]) -> IVec2 {
        self.first + self.step * IVec2::new(x as i32, y as i32)
    }

    /// Calls `row` with the nearest facets at the points of each row, as `spans` has the rows; [`NO_FACET`] where there is none. Keys are those at
    /// `from`, a coordinate along the rows, and what they change by to a point.
    #[inline(always)]
    pub fn nearest(
        self,
        casters: &Casters<'_>,
        planes: &[Affine],
        spans: &Spans,
        from: i32,
        mut row: impl FnMut(usize, &[u32]),
    ) {
        let Self { first, step, side } = self;
        let (shift, before) = (step.ilog2(), (first.x - from) / step);
        let mut keys = [0.0; MOST_POINTS];
        let mut facets = [NO_FACET; MOST_POINTS];
        let (keys, facets) = (&mut keys[..side], &mut facets[..side]);
        for y in 0..side {
            let at = IVec2::new(from, first.y + step * y as i32);
            keys.fill(f64::INFINITY);
            facets.fill(NO_FACET);
            for Span { facet, masked, along } in spans.line(y) {
                let covered = points(along, first.x, shift, side);
                let plane = planes[*facet as usize];
                let key = plane.at(texels(at));
                let dx = plane.dx * (f64::from(step) / f64::from(SUBTEXELS));
                // Signed 32-bit counters become floats several at a time.
                let counted = before + covered.start as i32..;
                let points = counted.zip(keys[covered.clone()].iter_mut().zip(&mut facets[covered]));
                if *masked {
                    let whole = casters.gathered.facet(*facet);
                    for (i, (nearest, own)) in points {
                        let key = key + dx * f64::from(i);
                        if key < *nearest && casters.is_there(&whole, texels(at + IVec2::X * (step * i))) {
                            (*nearest, *own) = (key, *facet);
                        }
                    }
                    continue;
                }
                for (i, (nearest, own)) in points {
                    let key = key + dx * f64::from(i);
                    let nearer = key < *nearest;
                    *nearest = if nearer { key } else { *nearest };
                    *own = if nearer { *facet } else { *own };
                }
            }
            row(y, facets);
        }
    }
}

/// Most points of a row.
const MOST_POINTS: usize = 65;
