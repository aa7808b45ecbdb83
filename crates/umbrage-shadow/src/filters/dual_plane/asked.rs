//! A receiver asked of what knows facets: votes of samples, and the edge between those that disagree.

use super::parameters::DualPlane;
use super::voters::{Compared, LANES, Said, Voters};
use crate::query::answer;
use crate::{Crossing, Probe, Query};
use arrayvec::ArrayVec;
use fearless_simd::Simd;
use glam::{DVec2, IVec2, UVec2};
use umbrage_depth::{DepthMap, FacetSample, FacetSource};
use umbrage_plane::{Affine, Cells, TexelRect, View};

/// A receiver asked of what knows facets.
pub(super) struct Asked<'a, F: ?Sized> {
    pub map: &'a F,
    pub view: &'a View,
    /// What every sample is compared with.
    pub compared: Compared,
    texel: DVec2,
    /// The middle of the region's parallelogram, its half-axes, texels, and what of it is the surface.
    middle: DVec2,
    axes: [DVec2; 2],
    cells: Cells,
    across: u32,
    /// Change of the key per world unit along the axis of view, at the receiver.
    pub per_world: f64,
}

/// Samples along each side of the region that are kept at hand; larger regions ask the map for each place.
const AT_HAND: usize = 12;

/// Crossings that are remembered: more than an edge through a region has.
const CROSSED: usize = 16;

/// How often the cell between two places of different answers is halved to find the edge.
const HALVINGS: u32 = 3;

/// Regions of more texels along a side are not asked whether all of their samples agree.
const MOST_AGREED: f64 = 16.0;

/// Beyond so many samples from the origin, and at NaN, no map has one.
pub(super) const FAR: f64 = 1e9;

/// The samples at up to `N` places of the finer grid, as many as lie under a region or at the corners of a cell.
pub(super) struct Grid<'a, 'b, F: ?Sized, const N: usize, const CHUNKS: usize> {
    asked: &'b Asked<'a, F>,
    rect: TexelRect,
    /// Places of a row.
    columns: usize,
    /// What the samples say, each once, and which part of the rectangle each stands for.
    voters: ArrayVec<Voters, CHUNKS>,
    parts: ArrayVec<TexelRect, N>,
    /// For each place, row by row, whose it is.
    of: [u8; N],
    /// Crossings that were looked for before, by their place and whether they lead downward.
    crossed: ArrayVec<((usize, bool), f64), CROSSED>,
}

impl<'a, F: FacetSource + ?Sized> Asked<'a, F> {
    #[inline(always)]
    pub fn new<S: Simd, M: DepthMap, P: Probe>(filter: &DualPlane, map: &'a F, query: &Query<'a, S, M, P>) -> Self {
        let (view, receiver) = (query.view(), query.receiver());
        let zeta = -receiver.eye.z;
        let per_world = view.key_per_world(zeta);
        let plane = view.affine(receiver.eye, receiver.normal).unwrap_or_else(|| Affine::constant(view.key(zeta)));
        let most = view.size().as_dvec2() * 0.125;
        let axes = receiver.axes.map(|axis| axis.as_dvec2().clamp(-most, most));
        let cells = receiver.cells;
        let (middle, part) = if cells.is_whole() {
            (receiver.texel, (receiver.texel, axes))
        } else {
            let along = |at: DVec2| axes[0] * at.x + axes[1] * at.y;
            let (middle, (at, half)) = (receiver.texel - along(cells.centroid()), cells.bounds());
            (middle, (middle + along(at), [axes[0] * half.x, axes[1] * half.y]))
        };
        let wide = 2.0 * part.1[0].length_squared().max(part.1[1].length_squared()).sqrt();
        let texel = receiver.texel_world.as_dvec2();
        Self {
            map,
            view,
            compared: Compared {
                plane,
                steep: plane.dx.abs() + plane.dy.abs(),
                part,
                width: filter.width_term * (texel.x * texel.y).sqrt() * per_world,
                slope: filter.slope_term,
                least: filter.footprint_term * wide,
                rounding: plane.at(receiver.texel).abs() * 1e-14,
            },
            texel: receiver.texel,
            middle,
            axes,
            cells,
            across: if wide == 0.0 { 1 } else { filter.across.max(1) },
            per_world,
        }
    }

    /// The fraction in shadow, and how many samples were looked at.
    #[inline(always)]
    pub fn fraction(&self) -> (f32, u32) {
        let (centre, axes) = self.compared.part;
        let reach = axes[0].abs() + axes[1].abs();
        let fine = f64::from(self.map.fine());
        let corner = |at: DVec2| (at * fine - 0.5).floor();
        let (low, high) = (corner(centre - reach), corner(centre + reach) + 2.0);
        if !(low.abs().max_element() < FAR && high.abs().max_element() < FAR) {
            return (self.share(false, |_| false), 0);
        }
        let rect = TexelRect::new(low.as_ivec2(), high.as_ivec2());
        let inside = self.view.holds(centre.as_vec2(), reach.as_vec2());
        if inside && let Some(dark) = self.of_one_plane(rect, reach) {
            return (f32::from(u8::from(dark)), 1);
        }
        let wide = (high - low).max_element();
        let looked = rect.area().min(4 * (self.across * self.across) as usize) as u32;
        if wide <= AT_HAND as f64 {
            let mut grid = Grid::<F, { AT_HAND * AT_HAND }, { AT_HAND * AT_HAND / LANES }>::empty(self, rect);
            let agreed = grid.fill();
            if inside && let Some(dark) = agreed {
                return (f32::from(u8::from(dark)), grid.parts.len() as u32);
            }
            return (grid.fraction(inside), looked);
        }
        if inside && wide <= MOST_AGREED * fine {
            let (agreed, looked) = self.agreed(rect);
            if let Some(dark) = agreed {
                return (f32::from(u8::from(dark)), looked);
            }
        }
        (self.one_by_one(inside), looked)
    }

    /// The answer where all samples of a rectangle see one facet, that answers alike for each of them and for all places of the region.
    #[inline(always)]
    fn of_one_plane(&self, rect: TexelRect, reach: DVec2) -> Option<bool> {
        let sample = self.map.one_facet(rect)?;
        let behind = Voters::of(&self.compared, &[sample]).behind(0);
        // Wherever the samples of these places were taken, and the region.
        let side = 1.0 / f64::from(self.map.fine());
        let low = (rect.min.as_dvec2() * side - 1.0).min(self.compared.part.0 - reach);
        let high = (rect.max.as_dvec2() * side + 1.0).max(self.compared.part.0 + reach);
        let middle = behind.at(0.5 * (low + high));
        let half = 0.5 * (high - low);
        let spread = (behind.dx.abs() * half.x + behind.dy.abs() * half.y) * (1.0 + 1e-9);
        let (dark, lit) = (middle - spread > 0.0, middle + spread <= 0.0);
        (dark != lit).then_some(dark)
    }

    /// The answer of all samples of a rectangle for all places of the region, where it is one; and how many were looked at.
    #[inline(never)]
    fn agreed(&self, rect: TexelRect) -> (Option<bool>, u32) {
        let mut samples = ArrayVec::<FacetSample, LANES>::new_const();
        let (mut said, mut looked) = (Said::default(), 0);
        self.map.each_sample(rect, &mut |_, sample| {
            samples.push(*sample);
            looked += 1;
            if samples.is_full() {
                said.add(&Voters::of(&self.compared, &samples));
                samples.clear();
            }
            said.can_agree()
        });
        if !samples.is_empty() {
            said.add(&Voters::of(&self.compared, &samples));
        }
        (said.agreed(), looked)
    }

    /// The answer of a place that the view's rules settle.
    #[inline(always)]
    pub fn ruled(&self, at: DVec2) -> Option<f32> {
        answer(self.view.rules().verdict(self.view.locate(at.as_vec2())))
    }

    /// The share of the region's surface that is dark, by lines across it: on each, what lies between two places that answer alike is as they are, and between
    /// two that do not the edge is looked for. `dark` is asked about places that the view's rules do not settle.
    #[inline(always)]
    pub fn share(&self, inside: bool, mut dark: impl FnMut(DVec2) -> bool) -> f32 {
        let mut answer = |at: DVec2| match if inside { None } else { self.ruled(at) } {
            Some(ruled) => ruled > 0.0,
            None => dark(at),
        };
        if self.across == 1 {
            return f32::from(u8::from(answer(self.texel)));
        }
        // Lines go across the edge rather than along it.
        let (centre, [x, y]) = self.compared.part;
        let [a, b] = [answer(centre + (-x - y)), answer(centre + (x - y))];
        let [c, d] = [answer(centre + (y - x)), answer(centre + (x + y))];
        let along_x = !(a == b && c == d && a != c);
        let [x, y] = self.axes;
        let (along, beside) = if along_x { (x, y) } else { (y, x) };
        let step = 1.0 / f64::from(self.across);
        let (mut sum, mut all) = (0.0, 0.0);
        for line in 0..self.across {
            let first = self.middle + beside * (f64::from(2 * line + 1) * step - 1.0) - along;
            let at = |cells: f64| first + along * (2.0 * step * cells);
            let mut before = None;
            for cell in 0..self.across {
                let (column, row) = if along_x { (cell, line) } else { (line, cell) };
                let share = self.cells.share(column, row, self.across);
                if share == 0.0 {
                    before = None;
                    continue;
                }
                let from = f64::from(cell);
                let left = before.unwrap_or_else(|| answer(at(from)));
                let right = answer(at(from + 1.0));
                let mut changed = if left { 1.0 } else { 0.0 };
                if left != right {
                    let (mut low, mut high) = (0.0, 1.0);
                    for _ in 0..HALVINGS {
                        let middle = 0.5 * (low + high);
                        *(if answer(at(from + middle)) == left { &mut low } else { &mut high }) = middle;
                    }
                    let edge = 0.5 * (low + high) as f32;
                    changed = if left { edge } else { 1.0 - edge };
                }
                all += share;
                sum += share * changed;
                before = Some(right);
            }
        }
        if all > 0.0 { sum / all } else { f32::from(u8::from(answer(self.texel))) }
    }

    /// A large region: the map is asked anew for each place.
    #[inline(never)]
    fn one_by_one(&self, inside: bool) -> f32 {
        self.share(inside, |at| {
            let corner = (at * f64::from(self.map.fine()) - 0.5).floor().as_ivec2();
            let mut grid = Grid::<F, 4, 1>::empty(self, TexelRect::new(corner, corner + 2));
            grid.filled().dark(at)
        })
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
            crossed: ArrayVec::new_const(),
        }
    }

    /// Takes the samples of its rectangle, and returns their answer for all places of the region, where it is one. Whose each place is has to
    /// be [noted](Self::place) before one of them is judged.
    #[inline(always)]
    fn fill(&mut self) -> Option<bool> {
        let mut samples = ArrayVec::<FacetSample, N>::new_const();
        let parts = &mut self.parts;
        self.asked.map.each_sample(self.rect, &mut |part, sample| {
            parts.push(part);
            samples.push(*sample);
            true
        });
        let mut said = Said::default();
        for samples in samples.chunks(LANES) {
            let voters = Voters::of(&self.asked.compared, samples);
            said.add(&voters);
            self.voters.push(voters);
        }
        said.agreed()
    }

    /// Notes for each place whose it is.
    #[inline(always)]
    fn place(&mut self) {
        let (rect, columns) = (self.rect, self.columns);
        for (voter, part) in self.parts.iter().enumerate() {
            let (from, to) = ((part.min - rect.min).as_usizevec2(), (part.max - rect.min).as_usizevec2());
            for row in from.y..to.y {
                for of in &mut self.of[row * columns + from.x..row * columns + to.x] {
                    *of = voter as u8;
                }
            }
        }
    }

    /// With its samples, and each place noted.
    #[inline(always)]
    pub fn filled(&mut self) -> &mut Self {
        self.fill();
        self.place();
        self
    }

    #[inline(never)]
    fn fraction(&mut self, inside: bool) -> f32 {
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
        // Roundings of a place at the region's rim.
        let cell = place.as_uvec2().min((self.rect.max - self.rect.min - 2).as_uvec2());
        let first = self.corner(cell, 0);
        let below = first + self.columns;
        let [a, b, c, d] = [self.of[first], self.of[first + 1], self.of[below], self.of[below + 1]];
        let vote = |voter: u8| self.voters[usize::from(voter) / LANES].dark(usize::from(voter) % LANES, at);
        if a == b && a == c && a == d {
            return vote(a);
        }
        let votes = [vote(a), vote(b), vote(c), vote(d)];
        if votes == [votes[0]; 4] {
            return votes[0];
        }
        self.shape(cell, votes, place - cell.as_dvec2())
    }

    /// Marching squares: on which side of the edge a place is, where the corners disagree. `within` the cell, 0 to 1 from its upper left
    /// corner.
    fn shape(&mut self, cell: UVec2, votes: [bool; 4], within: DVec2) -> bool {
        let [a, b, c, d] = votes;
        let dark = votes.iter().filter(|vote| **vote).count();
        match dark {
            // One corner stands alone.
            1 | 3 => {
                let alone = votes.iter().position(|vote| *vote == (dark == 1)).unwrap_or(0);
                self.beyond(cell, alone, within) != (dark == 1)
            }
            // The upper and lower sides are crossed.
            _ if a == c && b == d => {
                let (upper, lower) = (self.crossed(cell, 0, 1), self.crossed(cell, 2, 3));
                if within.x < upper + (lower - upper) * within.y { a } else { b }
            }
            // The left and right sides are.
            _ if a == b && c == d => {
                let (left, right) = (self.crossed(cell, 0, 2), self.crossed(cell, 1, 3));
                if within.y < left + (right - left) * within.x { a } else { c }
            }
            // Opposite corners agree: the middle is in shadow.
            _ => (0..4).filter(|corner| !votes[*corner]).all(|lit| self.beyond(cell, lit, within)),
        }
    }

    /// Whether a place lies beyond the line that cuts a corner of a cell off.
    #[inline(always)]
    fn beyond(&mut self, cell: UVec2, corner: usize, within: DVec2) -> bool {
        let mut from_corner = |to: usize| {
            let place = self.crossed(cell, corner.min(to), corner.max(to));
            if corner < to { place } else { 1.0 - place }
        };
        let (p, q) = (from_corner(corner ^ 1), from_corner(corner ^ 2));
        let x = if corner & 1 == 0 { within.x } else { 1.0 - within.x };
        let y = if corner & 2 == 0 { within.y } else { 1.0 - within.y };
        // x/p + y/q < 1 is this side; a crossing at the corner itself leaves nothing of it.
        x * q + y * p >= p * q
    }

    /// [`Grid::crossing`], found once for each of the first [`CROSSED`] sides.
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

    /// Where a side of a cell is crossed, from 0 at `from`, its upper or left end, to 1: where the map saw the surface change, or where the
    /// receiver's plane passes from behind one to before the other, or in the middle. The cell is counted from the grid's first.
    #[inline(never)]
    pub fn crossing(&self, cell: UVec2, from: usize, to: usize) -> Crossing {
        let begin = self.rect.min + cell.as_ivec2() + IVec2::new(from as i32 & 1, from as i32 >> 1);
        if let Some(place) = self.asked.map.link(begin, to - from == 2) {
            return Crossing::Link(place);
        }
        // Whether the receiver is behind a plane or before it is not known where it lies on it.
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
