//! The nearest facets at the points of a grid.

use super::casters::Casters;
use fearless_simd::{Select, Simd, SimdBase, SimdFrom, SimdMask, f64x4};
use glam::{DVec2, IVec2};
use std::ops::Range;
use umbrage_depth::NO_FACET;
use umbrage_plane::{Affine, integers};
use umbrage_raster::{Band, Runs, Shown};

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

/// Makes `runs` what the facets that may be seen in a region cover of its lines, which are those of a band; without a band there are none. A facet is left out when `wants`
/// says of the lines that it crosses that none of them is wanted.
#[inline(always)]
pub(super) fn set<'s, S: Simd>(
    simd: S,
    runs: &mut Runs,
    band: Option<Band<'_>>,
    wants: impl Fn(Range<usize>) -> bool,
    shown: impl IntoIterator<Item = &'s Shown>,
) {
    runs.clear();
    let Some(band) = band else { return };
    for shown in shown {
        band.covered(simd, *shown, &wants, runs);
    }
}

/// Numbers of a vector in memory.
pub(super) type Four = [f64; LANES];

/// Room for the keys and the numbers of the nearest facets, row by row.
#[derive(Default)]
pub(super) struct Seen {
    keys: Vec<Four>,
    facets: Vec<Four>,
}

/// The points of a square grid.
#[derive(Clone, Copy)]
pub(super) struct Grid {
    /// The place of the first and the distance to the next, in 1/256 texel.
    pub first: IVec2,
    pub step: i32,
    /// How many they are along a side.
    pub side: usize,
    /// A coordinate along the rows: keys in a row are the key there and what changes from there to each point.
    pub from: i32,
}

impl Grid {
    /// The place of a point, in 1/256 texel.
    #[inline(always)]
    pub fn place(self, [x, y]: [usize; 2]) -> IVec2 {
        self.first + self.step * IVec2::new(x as i32, y as i32)
    }

    /// Calls `row` with the nearest facets at the points of each row, of which `rows` has what is covered, and their keys; [`NO_FACET`] and +∞ where there is none.
    /// Facets must come in the order of their numbers.
    #[inline(always)]
    pub fn nearest<S: Simd>(
        self,
        simd: S,
        casters: &Casters<'_>,
        planes: &[Affine],
        rows: &Runs,
        nearest: &mut Seen,
        mut row: impl FnMut(usize, &[u32], &[Four]),
    ) {
        let Self { first, step, side, from } = self;
        let (shift, before) = (step.ilog2(), (first.x - from) / step);
        let vectors = side.div_ceil(LANES);
        let Seen { keys, facets } = nearest;
        let count = side * vectors;
        if keys.len() < count {
            keys.resize(count, [0.0; LANES]);
            facets.resize(count, [0.0; LANES]);
        }
        let (keys, facets) = (&mut keys[..count], &mut facets[..count]);
        keys.fill([f64::INFINITY; LANES]);
        facets.fill([NONE; LANES]);
        let (infinite, none) = (f64x4::splat(simd, f64::INFINITY), f64x4::splat(simd, NONE));
        for (facet, line, along) in rows.iter() {
            let plane = planes[facet as usize];
            let masked = casters.is_masked(facet);
            let dx = plane.dx * (f64::from(step) / f64::from(SUBTEXELS));
            // Numbers of 32 bits are exact as floats, and chosen by the same masks as keys.
            let own = f64x4::splat(simd, f64::from(facet));
            for (y, along) in (line..).zip(along) {
                let covered = points(along, first.x, shift, side);
                if covered.is_empty() {
                    continue;
                }
                let at = IVec2::new(from, first.y + step * y as i32);
                let key = plane.at(texels(at));
                let place = |point: usize| f64x4::splat(simd, f64::from(before + point as i32));
                let (begin, end) = (place(covered.start), place(covered.end));
                let reached = covered.start / LANES..covered.end.div_ceil(LANES);
                let mut point = place(LANES * reached.start) + numbers(simd);
                let row = y * vectors + reached.start..y * vectors + reached.end;
                for ((keys, facets), vector) in keys[row.clone()].iter_mut().zip(&mut facets[row]).zip(reached) {
                    let key = dx * point + key;
                    let nearest = f64x4::simd_from(simd, *keys);
                    let mut is_nearer = key.simd_lt(nearest) & point.simd_ge(begin) & point.simd_lt(end);
                    point += f64x4::splat(simd, LANES as f64);
                    if masked {
                        let first = before + (LANES * vector) as i32;
                        let place = |lane: usize| texels(at + IVec2::X * (step * (first + lane as i32)));
                        let there = casters.there(facet, is_nearer.to_bitmask(), place);
                        is_nearer = SimdMask::from_bitmask(simd, there);
                    }
                    // A minimum and a maximum, because choices would become masked stores, which are slow on some processors. A later
                    // facet has the greater number.
                    *keys = nearest.min(is_nearer.select(key, infinite)).into();
                    *facets = f64x4::simd_from(simd, *facets).max(is_nearer.select(own, none)).into();
                }
            }
        }
        let mut seen = [NO_FACET; MOST_POINTS];
        for (y, (keys, facets)) in keys.chunks_exact(vectors).zip(facets.chunks_exact(vectors)).enumerate() {
            for (seen, facets) in seen.as_chunks_mut::<LANES>().0.iter_mut().zip(facets) {
                *seen = integers(*facets).map(|facet| facet as u32);
            }
            row(y, &seen[..side], keys);
        }
    }
}

/// What stands for [`NO_FACET`] among floats: less than the number of any facet, and the same bits as an integer.
const NONE: f64 = -1.0;

/// The greatest of the first `count` keys.
#[inline(always)]
pub(super) fn farthest<S: Simd>(simd: S, keys: &[Four], count: usize) -> f64 {
    let (whole, rest) = keys.split_at(count / LANES);
    let mut most = f64x4::splat(simd, f64::NEG_INFINITY);
    for keys in whole {
        most = most.max(f64x4::simd_from(simd, *keys));
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
