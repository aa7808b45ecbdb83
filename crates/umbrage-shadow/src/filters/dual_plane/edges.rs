//! Where the edge runs between samples that disagree: marching squares over the samples under a region.

use super::grid::Grid;
use super::voters::{LANES, OPEN};
use crate::Crossing;
use arrayvec::ArrayVec;
use fearless_simd::Simd;
use glam::{DVec2, IVec2, UVec2};
use umbrage_depth::FacetSource;
use umbrage_plane::integers;

/// The number of crossings, and of shapes of cells, that are remembered: more than an edge through a region has.
const REMEMBERED: usize = 16;

/// A cell whose shape is not known yet, or is not the same for all places of the region.
const UNKNOWN: u8 = u8::MAX;

/// The edges between the samples of a grid, cell by cell; a cell has a sample at each corner.
pub(super) struct Edges<'a, 'b, 'g, F: ?Sized, const N: usize, const CHUNKS: usize> {
    grid: &'g Grid<'a, 'b, F, N, CHUNKS>,
    /// Places of a row, and of a texel's side.
    columns: usize,
    fine: f64,
    /// The middle of the first place, and the last cell.
    first: DVec2,
    last: DVec2,
    /// For each place, row by row, the sample that it belongs to, and that sample's vote for all places of the region.
    of: [u8; N],
    says: [u8; N],
    /// For each cell, by its first place, its shape among `shapes`, or [`UNKNOWN`].
    shape_of: [u8; N],
    /// Shapes of cells: all lit, all dark, and those that were found before.
    shapes: ArrayVec<Shape, REMEMBERED>,
    /// Crossings that were found before, by their place and whether they lead downward.
    crossed: ArrayVec<((usize, bool), f64), REMEMBERED>,
}

/// A line across a cell, places of which run from 0 to 1 from its upper left corner, and which side of it is dark.
#[derive(Clone, Copy, Debug)]
struct Line {
    normal: DVec2,
    offset: f64,
    /// Whether it is dark where `normal` · place ≥ `offset`, or else where it is not.
    dark: bool,
}

impl Line {
    /// All of the cell is dark, or none of it.
    const fn all(dark: bool) -> Self {
        Self { normal: DVec2::ZERO, offset: 0.0, dark }
    }

    #[inline(always)]
    fn dark(&self, within: DVec2) -> bool {
        (within.x * self.normal.x + within.y * self.normal.y >= self.offset) == self.dark
    }
}

/// How the edge runs through a cell: what both lines call dark is dark.
type Shape = [Line; 2];

impl<'a, 'b, 'g, F: FacetSource + ?Sized, const N: usize, const CHUNKS: usize> Edges<'a, 'b, 'g, F, N, CHUNKS> {
    /// The edges of a grid that is filled.
    #[inline(always)]
    pub fn of(grid: &'g Grid<'a, 'b, F, N, CHUNKS>) -> Self {
        let rect = grid.rect;
        let columns = (rect.max.x - rect.min.x) as usize;
        let mut of = grid.of;
        for part in &grid.parts {
            let mut place = usize::from(part.first);
            for _ in 0..part.rows {
                of[place..place + usize::from(part.columns)].fill(part.sample);
                place += columns;
            }
        }
        let mut votes = [0; N];
        for (voters, votes) in grid.voters.iter().zip(votes.as_chunks_mut::<LANES>().0) {
            for (lane, vote) in votes.iter_mut().enumerate() {
                *vote = voters.says(lane);
            }
        }
        let mut says = [0; N];
        for (says, of) in says.iter_mut().zip(&of[..rect.area()]) {
            *says = votes[usize::from(*of)];
        }
        let mut shape_of = [UNKNOWN; N];
        // Slices of one length, which are compared several places at a time.
        let last = columns + 1;
        let (a, b, c, d) = (&says[..N - last], &says[1..N - columns], &says[columns..N - 1], &says[last..]);
        for ((((shape, a), b), c), d) in shape_of.iter_mut().zip(a).zip(b).zip(c).zip(d) {
            *shape = match a | b << 1 | c << 2 | d << 3 {
                0 => 0,
                15 => 1,
                _ => UNKNOWN,
            };
        }
        let shapes = [false, true].map(|dark| [Line::all(dark), Line::all(true)]).into_iter().collect();
        let (first, last) = (rect.min.as_dvec2() + 0.5, (rect.max - rect.min - 2).as_dvec2());
        let fine = f64::from(grid.asked.map.fine());
        Self { grid, columns, fine, first, last, of, says, shape_of, shapes, crossed: ArrayVec::new_const() }
    }

    /// The place of a cell's corner, by its number row by row, among those of the grid.
    #[inline(always)]
    fn corner(&self, cell: UVec2, corner: usize) -> usize {
        (cell.y as usize + (corner >> 1)) * self.columns + cell.x as usize + (corner & 1)
    }

    /// Whether a place is dark.
    #[inline(always)]
    pub fn dark(&mut self, at: DVec2) -> bool {
        let place = at * self.fine - self.first;
        // A place at the region's rim may lie outside by rounding.
        let cell = place.max(DVec2::ZERO).min(self.last).floor();
        let within = place - cell;
        let whole = IVec2::from(integers(cell.to_array()));
        let known = self.shape_of[whole.y as usize * self.columns + whole.x as usize];
        let [a, b] = match self.shapes.get(usize::from(known)) {
            Some(shape) => *shape,
            None => self.found(whole.as_uvec2(), at),
        };
        a.dark(within) & b.dark(within)
    }

    /// The shape of a cell for a place, where it is not known yet.
    #[inline(never)]
    fn found(&mut self, cell: UVec2, at: DVec2) -> Shape {
        let first = self.corner(cell, 0);
        let corners = [first, first + 1, first + self.columns, first + self.columns + 1];
        let open = corners.iter().any(|corner| self.says[*corner] == OPEN);
        let votes = if open {
            self.votes(corners, at)
        } else {
            corners.iter().rev().fold(0, |votes, corner| votes << 1 | self.says[*corner])
        };
        if votes == 0 || votes == 15 {
            return self.shapes[usize::from(votes & 1)];
        }
        let shape = self.shape(cell, [1, 2, 4, 8].map(|corner| votes & corner != 0));
        if !open && !self.shapes.is_full() {
            self.shape_of[first] = self.shapes.len() as u8;
            self.shapes.push(shape);
        }
        shape
    }

    /// The votes of the samples at a cell's corners on a place, one bit for each.
    #[inline(never)]
    fn votes(&self, corners: [usize; 4], at: DVec2) -> u8 {
        let vote = |voter: usize| u8::from(self.grid.voters[voter / LANES].dark(voter % LANES, at));
        corners.iter().rev().fold(0, |votes, place| votes << 1 | vote(usize::from(self.of[*place])))
    }

    /// Marching squares: how the edge runs where the corners disagree.
    fn shape(&mut self, cell: UVec2, votes: [bool; 4]) -> Shape {
        let [a, b, c, d] = votes;
        let dark = votes.iter().filter(|vote| **vote).count();
        let line = match dark {
            1 | 3 => {
                let alone = votes.iter().position(|vote| *vote == (dark == 1)).unwrap_or(0);
                self.cut(cell, alone, dark != 1)
            }
            _ if a == c && b == d => {
                let (upper, lower) = (self.crossed(cell, 0, 1), self.crossed(cell, 2, 3));
                Line { normal: DVec2::new(1.0, upper - lower), offset: upper, dark: !a }
            }
            _ if a == b && c == d => {
                let (left, right) = (self.crossed(cell, 0, 2), self.crossed(cell, 1, 3));
                Line { normal: DVec2::new(left - right, 1.0), offset: left, dark: !a }
            }
            // Opposite corners agree: the middle is in shadow, and two corners are lit.
            _ => return (if a { [1, 2] } else { [0, 3] }).map(|lit| self.cut(cell, lit, true)),
        };
        [line, Line::all(true)]
    }

    /// The line that cuts off a corner of a cell, and whether it is dark beyond.
    fn cut(&mut self, cell: UVec2, corner: usize, dark: bool) -> Line {
        let mut from_corner = |to: usize| {
            let place = self.crossed(cell, corner.min(to), corner.max(to));
            if corner < to { place } else { 1.0 - place }
        };
        let (p, q) = (from_corner(corner ^ 1), from_corner(corner ^ 2));
        // x/p + y/q < 1 is the corner's side, both counted from the corner; a crossing at the corner itself leaves nothing of that side.
        let mut line = Line { normal: DVec2::new(q, p), offset: p * q, dark };
        if corner & 1 != 0 {
            (line.normal.x, line.offset) = (-q, line.offset - q);
        }
        if corner & 2 != 0 {
            (line.normal.y, line.offset) = (-p, line.offset - p);
        }
        line
    }

    /// [`Grid::crossing`], found once for each of the first [`REMEMBERED`] sides.
    fn crossed(&mut self, cell: UVec2, from: usize, to: usize) -> f64 {
        let side = (self.corner(cell, from), to - from == 2);
        if let Some((_, place)) = self.crossed.iter().find(|(known, _)| *known == side) {
            return *place;
        }
        let place = self.crossing(cell, from, to).place();
        if !self.crossed.is_full() {
            self.crossed.push((side, place));
        }
        place
    }

    /// Where a side of a cell is crossed, from 0 at `from`, its upper or left end, to 1: where the map's links say that the surface
    /// changes, or where the receiver's plane passes from behind one surface to in front of the other, or in the middle. The cell is counted from the grid's
    /// first.
    #[inline(never)]
    pub fn crossing(&self, cell: UVec2, from: usize, to: usize) -> Crossing {
        let begin = self.grid.rect.min + cell.as_ivec2() + IVec2::new(from as i32 & 1, from as i32 >> 1);
        if let Some(place) = self.grid.asked.map.link(begin, to - from == 2) {
            return Crossing::Link(place);
        }
        // Where the receiver lies on a plane, rounding decides whether it is behind it or in front of it.
        let behind = |corner: usize| {
            let voter = usize::from(self.of[self.corner(cell, corner)]);
            let (there, passed) = self.grid.voters[voter / LANES].there(voter % LANES);
            Some(there + passed).filter(|behind| behind.is_finite() && behind.abs() > passed)
        };
        match (behind(from), behind(to)) {
            (Some(a), Some(b)) if (a > 0.0) != (b > 0.0) => Crossing::Planes(a / (a - b)),
            _ => Crossing::Halfway,
        }
    }
}

impl<F: FacetSource + ?Sized, const N: usize, const CHUNKS: usize> Grid<'_, '_, F, N, CHUNKS> {
    /// The fraction in shadow, once its samples are [filled](Self::fill) in.
    #[inline(never)]
    pub fn fraction<S: Simd>(&self, simd: S, inside: bool) -> f32 {
        simd.vectorize(
            #[inline(always)]
            || {
                let mut edges = Edges::of(self);
                self.asked.share(
                    inside,
                    #[inline(always)]
                    |at| edges.dark(at),
                )
            },
        )
    }
}
