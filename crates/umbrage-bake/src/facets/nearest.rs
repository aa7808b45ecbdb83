//! The nearest facets at the points of a grid.

use super::casters::Casters;
use glam::{DVec2, IVec2};
use std::ops::Range;
use umbrage_depth::NO_FACET;
use umbrage_plane::{Affine, TexelRect, vectorized};
use umbrage_raster::Lines;

/// 1/256 texel: what corners are snapped to, and all places here are multiples of.
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

/// Planes of a tile, each once, of those facets that are nearest somewhere.
pub(super) struct Planes {
    pub planes: Vec<Affine>,
    /// From the numbers of gathered facets to planes; [`NO_FACET`] for those that have none.
    index: Vec<u32>,
}

impl Planes {
    /// None yet, of so many gathered facets.
    pub fn of(gathered: usize) -> Self {
        Self { planes: Vec::new(), index: vec![NO_FACET; gathered] }
    }
}

/// The nearest facets at the points of a square grid that begins at a place of the map, in 1/256 texel.
struct Nearest {
    first: IVec2,
    /// Points along a side.
    side: usize,
    keys: Vec<f64>,
    facets: Vec<u32>,
}

impl Nearest {
    fn new(first: IVec2, side: usize) -> Self {
        Self { first, side, keys: vec![f64::INFINITY; side * side], facets: vec![NO_FACET; side * side] }
    }

    /// Offers a plane to some points of a row; `key` is its key at the first point of the row, `dx` its change from point to point.
    #[inline(always)]
    fn offer(&mut self, row: usize, points: Range<usize>, key: f64, dx: f64, facet: u32) -> bool {
        let first = row * self.side;
        let keys = &mut self.keys[first + points.start..first + points.end];
        let facets = &mut self.facets[first + points.start..first + points.end];
        let mut any = 0;
        // Signed 32-bit counters become floats several at a time.
        for (i, (nearest, own)) in (points.start as i32..).zip(keys.iter_mut().zip(facets)) {
            let key = key + dx * f64::from(i);
            let nearer = key < *nearest;
            *nearest = if nearer { key } else { *nearest };
            *own = if nearer { facet } else { *own };
            any |= u32::from(nearer);
        }
        any != 0
    }

    /// The same of a plane with holes: it is offered to those points alone, of all that it is nearest at, at which it is `there`.
    #[cold]
    fn offer_masked(
        &mut self,
        row: usize,
        points: Range<usize>,
        key: f64,
        dx: f64,
        facet: u32,
        there: impl Fn(usize) -> bool,
    ) -> bool {
        let first = row * self.side;
        let mut any = false;
        for point in points {
            let key = key + dx * f64::from(point as i32);
            if key < self.keys[first + point] && there(point) {
                (self.keys[first + point], self.facets[first + point]) = (key, facet);
                any = true;
            }
        }
        any
    }
}

/// A square grid of points in square parts, each of which may be left out. Neighbouring parts may share points: those that lie just
/// beyond a part, to the right and downward, then count for it as well.
#[derive(Clone, Copy)]
pub(super) struct Grid {
    /// The place of the first point, in 1/256 texel, and how far the next is.
    pub first: IVec2,
    pub step: i32,
    /// Parts along a side, and log₂ of the points along a part's, without those beyond it.
    pub parts: usize,
    pub shift: u32,
    /// Points beyond each part that it has as well: 0 or 1.
    pub beyond: usize,
}

impl Grid {
    /// Points along a part's side, without those beyond it.
    #[inline(always)]
    pub fn side(self) -> usize {
        1 << self.shift
    }

    /// The part, along one axis, that a point lies in.
    #[inline(always)]
    fn part(self, point: usize) -> usize {
        point >> self.shift
    }

    /// The first part, along one axis, that has a point.
    #[inline(always)]
    fn first_part(self, point: usize) -> usize {
        self.part(point.saturating_sub(self.beyond))
    }

    /// The place of a point, in 1/256 texel.
    #[inline(always)]
    pub fn place(self, [x, y]: [usize; 2]) -> IVec2 {
        self.first + self.step * IVec2::new(x as i32, y as i32)
    }
}

/// The nearest facets at the points of a grid.
pub(super) struct Samples {
    pub grid: Grid,
    parts: Vec<Option<Nearest>>,
}

impl Samples {
    /// Of those parts of a region that are `asked`; parts come row by row. Planes that are nearest somewhere are added to `planes`.
    pub fn of(
        casters: &Casters<'_>,
        region: TexelRect,
        grid: Grid,
        asked: impl Fn(usize) -> bool,
        planes: &mut Planes,
    ) -> Self {
        vectorized!(_ => Self::found(casters, region, grid, asked, planes))
    }

    #[inline(always)]
    fn found(
        casters: &Casters<'_>,
        region: TexelRect,
        grid: Grid,
        asked: impl Fn(usize) -> bool,
        planes: &mut Planes,
    ) -> Self {
        let (Grid { first, step, .. }, side) = (grid, grid.side());
        let (all, shift) = (grid.parts * side + grid.beyond, step.ilog2());
        let part = |part: usize| {
            let first = grid.place([part % grid.parts * side, part / grid.parts * side]);
            asked(part).then(|| Nearest::new(first, side + grid.beyond))
        };
        let mut parts: Vec<_> = (0..grid.parts.pow(2)).map(part).collect();
        if parts.iter().all(Option::is_none) {
            return Self { grid, parts };
        }
        let wanted = |bounds: TexelRect| {
            let covered = points(&(bounds.min.x..bounds.max.x), first.x, shift, all);
            covered.start < covered.end
        };
        casters.gathered.spans(
            region,
            Lines::Rows,
            step,
            wanted,
            #[inline(always)]
            |number, facet, y, along| {
                let points = points(&along, first.x, shift, all);
                if points.is_empty() {
                    return;
                }
                let row = ((y - first.y) >> shift) as usize;
                let known = planes.index[number];
                let index = if known == NO_FACET { planes.planes.len() as u32 } else { known };
                let masked = casters.masks.of(facet);
                let dx = facet.plane.dx * (f64::from(step) / f64::from(SUBTEXELS));
                let offer = |nearest: &mut Nearest, row: usize, points: Range<usize>| {
                    let first = IVec2::new(nearest.first.x, y);
                    let key = facet.plane.at(texels(first));
                    let Some(masked) = masked else { return nearest.offer(row, points, key, dx, index) };
                    let place = |point: usize| texels(first + IVec2::X * (step * point as i32));
                    let there = |point: usize| casters.masks.is_there(masked, facet, place(point));
                    nearest.offer_masked(row, points, key, dx, index, there)
                };
                let nearer = if let [Some(whole)] = parts.as_mut_slice() {
                    offer(whole, row, points)
                } else {
                    let rows = grid.first_part(row)..=grid.part(row).min(grid.parts - 1);
                    let columns = grid.first_part(points.start)..=grid.part(points.end - 1).min(grid.parts - 1);
                    let mut nearer = false;
                    for (part_row, column) in rows.flat_map(|row| columns.clone().map(move |column| (row, column))) {
                        let Some(nearest) = &mut parts[part_row * grid.parts + column] else { continue };
                        let (above, left) = (part_row << grid.shift, column << grid.shift);
                        let own = points.start.max(left) - left..points.end.min(left + nearest.side) - left;
                        nearer |= offer(nearest, row - above, own);
                    }
                    nearer
                };
                if nearer && known == NO_FACET {
                    planes.index[number] = index;
                    planes.planes.push(facet.plane);
                }
            },
        );
        Self { grid, parts }
    }

    /// The planes of a part's points, row by row, those beyond it among them, and how many make a row; `None` where it was not asked.
    #[inline(always)]
    pub fn part(&self, part: usize) -> Option<(&[u32], usize)> {
        self.parts[part].as_ref().map(|nearest| (nearest.facets.as_slice(), nearest.side))
    }

    /// The planes of a point and of the next one to the right, or downward, as the point's part has them, which was asked.
    #[inline(always)]
    pub fn neighbours(&self, lines: Lines, [x, y]: [usize; 2]) -> [u32; 2] {
        let (grid, within) = (self.grid, self.grid.side() - 1);
        let part = grid.part(y) * grid.parts + grid.part(x);
        let Some(nearest) = &self.parts[part] else { return [NO_FACET; 2] };
        let point = (y & within) * nearest.side + (x & within);
        let next = point + if lines == Lines::Rows { 1 } else { nearest.side };
        [nearest.facets[point], nearest.facets[next]]
    }
}
