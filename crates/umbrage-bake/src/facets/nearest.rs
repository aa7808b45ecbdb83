//! The nearest facets at the points of a grid.

use super::casters::Casters;
use fearless_simd::{Select, Simd, SimdBase, SimdMask, f64x4};
use glam::{DVec2, IVec2};
use std::ops::Range;
use umbrage_depth::NO_FACET;
use umbrage_plane::Affine;
use umbrage_raster::{Band, Shown};

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
    /// Makes them those of a region's lines, of which there are no more than `count`; without a band all of them are empty. Lines of which `wants` says that none is wanted stay empty.
    #[inline(always)]
    pub fn set<'s>(
        &mut self,
        casters: &Casters<'_>,
        band: Option<Band<'_>>,
        count: usize,
        wants: impl Fn(Range<usize>) -> bool,
        shown: impl IntoIterator<Item = &'s Shown>,
    ) {
        if self.lines.len() < count {
            self.lines.resize_with(count, Vec::new);
        }
        self.lines[..count].iter_mut().for_each(Vec::clear);
        let Some(band) = band else { return };
        for shown in shown {
            let facet = shown.number;
            let masked = casters.masks.of(&casters.gathered.facet(facet)).is_some();
            band.covered(
                *shown,
                &wants,
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

    /// Calls `row` with the nearest facets at the points of each row, as `spans` has the rows, and their keys; [`NO_FACET`] and +∞ where there is none. Keys are those at
    /// `from`, a coordinate along the rows, and what they change by to a point.
    #[inline(always)]
    pub fn nearest<S: Simd>(
        self,
        simd: S,
        casters: &Casters<'_>,
        planes: &[Affine],
        spans: &Spans,
        from: i32,
        mut row: impl FnMut(usize, &[u32], &[f64x4<S>]),
    ) {
        let Self { first, step, side } = self;
        let (shift, before) = (step.ilog2(), (first.x - from) / step);
        let vectors = side.div_ceil(LANES);
        let mut keys = [f64x4::splat(simd, 0.0); MOST_POINTS / LANES];
        let mut facets = keys;
        let (keys, facets) = (&mut keys[..vectors], &mut facets[..vectors]);
        let mut seen = [NO_FACET; MOST_POINTS];
        for y in 0..side {
            let at = IVec2::new(from, first.y + step * y as i32);
            keys.fill(f64x4::splat(simd, f64::INFINITY));
            facets.fill(f64x4::splat(simd, NO_FACET.into()));
            for Span { facet, masked, along } in spans.line(y) {
                let covered = points(along, first.x, shift, side);
                let plane = planes[*facet as usize];
                let key = plane.at(texels(at));
                let dx = plane.dx * (f64::from(step) / f64::from(SUBTEXELS));
                let (begin, end) = (f64x4::splat(simd, covered.start as f64), f64x4::splat(simd, covered.end as f64));
                // Numbers of 32 bits are exact as floats, and chosen by the same masks as keys.
                let own = f64x4::splat(simd, f64::from(*facet));
                for vector in covered.start / LANES..covered.end.div_ceil(LANES) {
                    let point = numbers(simd) + f64x4::splat(simd, (LANES * vector) as f64);
                    let key = dx * (point + f64x4::splat(simd, before.into())) + key;
                    let mut is_nearer = key.simd_lt(keys[vector]) & point.simd_ge(begin) & point.simd_lt(end);
                    if *masked {
                        let first = before + (LANES * vector) as i32;
                        let place = |lane: usize| texels(at + IVec2::X * (step * (first + lane as i32)));
                        let there = casters.there(*facet, is_nearer.to_bitmask(), place);
                        is_nearer = SimdMask::from_bitmask(simd, there);
                    }
                    keys[vector] = is_nearer.select(key, keys[vector]);
                    facets[vector] = is_nearer.select(own, facets[vector]);
                }
            }
            for (seen, facets) in seen.as_chunks_mut::<LANES>().0.iter_mut().zip(&*facets) {
                let facets: [f64; LANES] = (*facets).into();
                for lane in 0..LANES {
                    seen[lane] = facets[lane] as u32;
                }
            }
            row(y, &seen[..side], keys);
        }
    }
}

/// The greatest of the first `count` keys.
#[inline(always)]
pub(super) fn farthest<S: Simd>(simd: S, keys: &[f64x4<S>], count: usize) -> f64 {
    let (whole, rest) = keys.split_at(count / LANES);
    let mut most = f64x4::splat(simd, f64::NEG_INFINITY);
    for keys in whole {
        most = most.max(*keys);
    }
    let most: [f64; LANES] = most.into();
    let mut most = most[0].max(most[1]).max(most[2].max(most[3]));
    for number in count - count % LANES..count {
        most = most.max(rest[0][number % LANES]);
    }
    most
}

/// Room for the points of a row, 65 at most, in whole vectors.
const MOST_POINTS: usize = 68;

/// Numbers of a vector.
pub(super) const LANES: usize = 4;

/// 0, 1, 2, 3.
#[inline(always)]
pub(super) fn numbers<S: Simd>(simd: S) -> f64x4<S> {
    f64x4::from_slice(simd, &[0.0, 1.0, 2.0, 3.0])
}
