//! The samples under a region, and where the edge runs between those that disagree.

use super::asked::Asked;
use super::voters::{LANES, OPEN, Said, Samples, Voters};
use crate::Crossing;
use arrayvec::ArrayVec;
use glam::{DVec2, IVec2, USizeVec2, UVec2};
use umbrage_depth::FacetSource;
use umbrage_plane::TexelRect;

/// The number of crossings, and of shapes of cells, that are remembered: more than an edge through a region has.
const REMEMBERED: usize = 16;

/// The samples at up to `N` places of the finer grid, as many as lie under a region or at the corners of a cell.
pub(super) struct Grid<'a, 'b, F: ?Sized, const N: usize, const CHUNKS: usize> {
    asked: &'b Asked<'a, F>,
    rect: TexelRect,
    /// Places of a row.
    columns: usize,
    /// The samples' votes, each once, and the part of the rectangle that each stands for.
    voters: ArrayVec<Voters, CHUNKS>,
    pub parts: ArrayVec<TexelRect, N>,
    /// For each place, row by row, the sample that it belongs to, and that sample's vote for all places of the region.
    of: [u8; N],
    says: [u8; N],
    /// Crossings that were found before, by their place and whether they lead downward.
    crossed: ArrayVec<((usize, bool), f64), REMEMBERED>,
    /// How the edge runs through cells, by their first place and their corners' votes.
    shapes: ArrayVec<((usize, u8), Shape), REMEMBERED>,
}

/// A corner of a cell that is cut off, and where the two sides from it are crossed: 0 at the corner, 1 at the next.
#[derive(Clone, Copy, Debug)]
struct Cut {
    corner: usize,
    p: f64,
    q: f64,
}

impl Cut {
    /// Whether a place of the cell, 0 to 1 from its upper left corner, lies beyond the line.
    #[inline(always)]
    fn beyond(&self, within: DVec2) -> bool {
        let Self { corner, p, q } = *self;
        let x = if corner & 1 == 0 { within.x } else { 1.0 - within.x };
        let y = if corner & 2 == 0 { within.y } else { 1.0 - within.y };
        // x/p + y/q < 1 is the corner's side; a crossing at the corner itself leaves nothing of that side.
        x * q + y * p >= p * q
    }
}

/// How the edge runs through a cell whose corners disagree.
#[derive(Clone, Copy, Debug)]
enum Shape {
    /// One corner stands alone, dark or lit.
    Alone(Cut, bool),
    /// From the upper side to the lower one, and whether it is dark to the left.
    Upright(f64, f64, bool),
    /// From the left side to the right one, and whether it is dark above.
    Level(f64, f64, bool),
    /// Opposite corners agree: the middle is in shadow, and two corners are lit.
    Saddle([Cut; 2]),
}

impl Shape {
    /// Whether a place of the cell, 0 to 1 from its upper left corner, is dark.
    #[inline(always)]
    fn dark(&self, within: DVec2) -> bool {
        match self {
            Self::Alone(cut, dark) => cut.beyond(within) != *dark,
            Self::Upright(upper, lower, left) => (within.x < upper + (lower - upper) * within.y) == *left,
            Self::Level(left, right, upper) => (within.y < left + (right - left) * within.x) == *upper,
            Self::Saddle(cuts) => cuts.iter().all(|cut| cut.beyond(within)),
        }
    }
}

impl<'a, 'b, F: FacetSource + ?Sized, const N: usize, const CHUNKS: usize> Grid<'a, 'b, F, N, CHUNKS> {
    /// Without samples. They are [filled](Self::fill) in where the grid stands: it is large, and moving it would cost as much as an easy region.
    #[inline(always)]
    pub fn empty(asked: &'b Asked<'a, F>, rect: TexelRect) -> Self {
        let columns = (rect.max.x - rect.min.x) as usize;
        Self {
            asked,
            rect,
            columns,
            voters: ArrayVec::new_const(),
            parts: ArrayVec::new_const(),
            of: [0; N],
            says: [0; N],
            crossed: ArrayVec::new_const(),
            shapes: ArrayVec::new_const(),
        }
    }

    /// Takes the samples of its rectangle, and returns their common vote for all places of the region, where they agree. The sample of each
    /// place must be [noted](Self::place) before any place is judged.
    #[inline(always)]
    pub fn fill(&mut self) -> Option<bool> {
        let mut samples = ArrayVec::<Samples, CHUNKS>::new_const();
        let parts = &mut self.parts;
        self.asked.map.each_sample(self.rect, &mut |part, sample| {
            if parts.len() % LANES == 0 {
                samples.push(Samples::NONE);
            }
            parts.push(part);
            if let Some(last) = samples.last_mut() {
                last.push(sample);
            }
            true
        });
        let mut said = Said::default();
        for samples in &samples {
            let voters = Voters::of(&self.asked.compared, samples);
            said.add(&voters);
            self.voters.push(voters);
        }
        said.agreed()
    }

    /// Notes for each place the sample that it belongs to, and that sample's vote.
    #[inline(always)]
    fn place(&mut self) {
        let (rect, columns) = (self.rect, self.columns);
        for (voter, part) in self.parts.iter().enumerate() {
            let (from, to) = ((part.min - rect.min).as_usizevec2(), (part.max - rect.min).as_usizevec2());
            let says = self.voters[voter / LANES].says(voter % LANES);
            let mut place = from.y * columns + from.x;
            (self.of[place], self.says[place]) = (voter as u8, says);
            if to - from == USizeVec2::ONE {
                continue;
            }
            for _ in from.y..to.y {
                for place in place..place + to.x - from.x {
                    (self.of[place], self.says[place]) = (voter as u8, says);
                }
                place += columns;
            }
        }
    }

    /// A grid with its samples, and with each place noted.
    #[inline(always)]
    pub fn filled(&mut self) -> &mut Self {
        self.fill();
        self.place();
        self
    }

    /// The fraction in shadow, once its samples are [filled](Self::fill) in.
    #[inline(never)]
    pub fn fraction(&mut self, inside: bool) -> f32 {
        self.place();
        self.asked.share(
            inside,
            #[inline(always)]
            |at| self.dark(at),
        )
    }

    /// The place of a cell's corner, by its number row by row, among those of the grid.
    #[inline(always)]
    fn corner(&self, cell: UVec2, corner: usize) -> usize {
        (cell.y as usize + (corner >> 1)) * self.columns + cell.x as usize + (corner & 1)
    }

    /// Whether a place is dark.
    #[inline(always)]
    pub fn dark(&mut self, at: DVec2) -> bool {
        let place = at * f64::from(self.asked.map.fine()) - (self.rect.min.as_dvec2() + 0.5);
        // A place at the region's rim may lie outside by rounding.
        let cell = place.as_uvec2().min((self.rect.max - self.rect.min - 2).as_uvec2());
        let first = self.corner(cell, 0);
        let corners = [first, first + 1, first + self.columns, first + self.columns + 1];
        let [a, b, c, d] = [self.says[corners[0]], self.says[corners[1]], self.says[corners[2]], self.says[corners[3]]];
        let open = (a | b | c | d) & OPEN != 0;
        let votes = if open { self.votes(corners, at) } else { a | b << 1 | c << 2 | d << 3 };
        if votes == 0 || votes == 15 {
            return votes != 0;
        }
        self.edge((first, votes), cell).dark(place - cell.as_dvec2())
    }

    /// The votes of the samples at a cell's corners on a place, one bit for each.
    #[inline(never)]
    fn votes(&self, corners: [usize; 4], at: DVec2) -> u8 {
        let vote = |voter: usize| u8::from(self.voters[voter / LANES].dark(voter % LANES, at));
        corners.iter().rev().fold(0, |votes, place| votes << 1 | vote(usize::from(self.of[*place])))
    }

    /// [`Grid::shape`], found once for each of the first [`REMEMBERED`] cells.
    #[inline(always)]
    fn edge(&mut self, known: (usize, u8), cell: UVec2) -> Shape {
        if let Some((_, shape)) = self.shapes.iter().rev().find(|(other, _)| *other == known) {
            return *shape;
        }
        let shape = self.shape(cell, [1, 2, 4, 8].map(|corner| known.1 & corner != 0));
        if !self.shapes.is_full() {
            self.shapes.push((known, shape));
        }
        shape
    }

    /// Marching squares: how the edge runs where the corners disagree.
    #[inline(never)]
    fn shape(&mut self, cell: UVec2, votes: [bool; 4]) -> Shape {
        let [a, b, c, d] = votes;
        let dark = votes.iter().filter(|vote| **vote).count();
        match dark {
            1 | 3 => {
                let alone = votes.iter().position(|vote| *vote == (dark == 1)).unwrap_or(0);
                Shape::Alone(self.cut(cell, alone), dark == 1)
            }
            _ if a == c && b == d => Shape::Upright(self.crossed(cell, 0, 1), self.crossed(cell, 2, 3), a),
            _ if a == b && c == d => Shape::Level(self.crossed(cell, 0, 2), self.crossed(cell, 1, 3), a),
            _ => Shape::Saddle(if a { [1, 2] } else { [0, 3] }.map(|lit| self.cut(cell, lit))),
        }
    }

    /// The line that cuts off a corner of a cell.
    fn cut(&mut self, cell: UVec2, corner: usize) -> Cut {
        let mut from_corner = |to: usize| {
            let place = self.crossed(cell, corner.min(to), corner.max(to));
            if corner < to { place } else { 1.0 - place }
        };
        let (p, q) = (from_corner(corner ^ 1), from_corner(corner ^ 2));
        Cut { corner, p, q }
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
        let begin = self.rect.min + cell.as_ivec2() + IVec2::new(from as i32 & 1, from as i32 >> 1);
        if let Some(place) = self.asked.map.link(begin, to - from == 2) {
            return Crossing::Link(place);
        }
        // Where the receiver lies on a plane, rounding decides whether it is behind it or in front of it.
        let behind = |corner: usize| {
            let voter = usize::from(self.of[self.corner(cell, corner)]);
            let (there, passed) = self.voters[voter / LANES].there(voter % LANES);
            Some(there + passed).filter(|behind| behind.is_finite() && behind.abs() > passed)
        };
        match (behind(from), behind(to)) {
            (Some(a), Some(b)) if (a > 0.0) != (b > 0.0) => Crossing::Planes(a / (a - b)),
            _ => Crossing::Halfway,
        }
    }
}
