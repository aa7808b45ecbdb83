//! Two planes instead of a bias: the caster's own and the receiver's, compared at both ends.

use crate::query::answer;
use crate::{Filter, OnPlane, Probe, Query};
use fearless_simd::Simd;
use glam::{DVec2, IVec2, Vec2};
use umbrage_depth::{DepthMap, FacetSample, FacetSource, Facets};
use umbrage_plane::{Affine, Bias, Cells, TexelRect, View};
use umbrage_sample::EveryTexel;

/// Shadow without a bias over a map of facets ([`FacetMap`](umbrage_depth::FacetMap)): the receiver's tangent plane is compared with the caster's own plane, and edges run
/// between the samples of a texel, not along its border.
///
/// A sample of the map calls a place of the receiver dark when the receiver's plane lies behind the sample's **both** at the sample's centre and at
/// the place itself: convex folds pass the first test, concave folds the second. What both must pass by is not a bias but what a sample cannot
/// know: half a sample's width and a quarter of the gentler slope over it. Of the four samples around a place that disagree, the
/// map's links say where between two of them the surface changes, and marching squares where the edge runs. A region is the mean of
/// `across` × `across` places, of those that are its [surface](Cells).
///
/// Umbrage's own. Casters' planes are after Dou et al. 2014, edges in texels after Sen, Cammarano & Hanrahan 2003.
/// Over a map that knows no facets it compares the receiver's plane at every texel of its region, which is the best that such a map can give; over a deep one as much nearer
/// as the plane's own slope makes of a texel's samples there.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub struct DualPlane {
    /// Places along each side of the region.
    pub across: u32,
    /// What a sample must pass by for its width: in widths of the sample. ½ is half of it.
    pub width_term: f64,
    /// The same for slope: in changes of depth over a sample's width along both axes, of the gentler of the two planes.
    pub slope_term: f64,
    /// The least width of a sample for both terms, in widths of the region: a region's tangent plane leaves a curved surface toward its
    /// sides.
    pub footprint_term: f64,
}

impl Default for DualPlane {
    fn default() -> Self {
        Self { across: 4, width_term: 0.5, slope_term: 0.25, footprint_term: 0.25 }
    }
}

umbrage_plane::builders!([] DualPlane {
    with_across across: u32,
    with_width_term width_term: f64,
    with_slope_term slope_term: f64,
    with_footprint_term footprint_term: f64,
});

impl Filter for DualPlane {
    #[inline(always)]
    fn shadow<S: Simd, M: DepthMap, P: Probe>(&self, query: &mut Query<'_, S, M, P>) -> f32 {
        if query.receiver().axes == [Vec2::ZERO; 2]
            && let Some(dark) = query.placed(query.receiver().texel.as_vec2())
        {
            return dark;
        }
        let (fraction, looked) = match query.map().facets() {
            Some(Facets::Map(map)) => Asked::new(self, map, query).fraction(),
            Some(Facets::Several(maps)) => self.over_several(maps, query),
            None => {
                let region = query.region(1.0, 1.0);
                // A deep map's texel is the mean of samples up to 7/16 of a texel away along both axes: on a slope along its diagonal, 7/16 · √2 steps.
                let bias = if query.map().translucent().is_some() { Bias::Steps(0.625) } else { Bias::ZERO };
                return query.share(&region, &EveryTexel, &OnPlane::biased(bias));
            }
        };
        query.count(looked);
        fraction
    }
}

impl DualPlane {
    /// Maps around a light, whose samples beyond a seam are brought over from the neighbour.
    #[inline(never)]
    fn over_several<'a, S: Simd, M: DepthMap, P: Probe>(
        &self,
        maps: &'a dyn FacetSource,
        query: &Query<'a, S, M, P>,
    ) -> (f32, u32) {
        Asked::new(self, maps, query).fraction()
    }
}

/// A receiver asked of what knows facets.
struct Asked<'a, F: ?Sized> {
    map: &'a F,
    view: &'a View,
    /// The receiver's tangent plane, and how fast its key changes, over both axes together.
    plane: Affine,
    steep: f64,
    texel: DVec2,
    /// The middle of the region's parallelogram, its half-axes, texels, and what of it is the surface.
    middle: DVec2,
    axes: [DVec2; 2],
    cells: Cells,
    /// The middle and the half-axes of the part that holds the surface.
    part: (DVec2, [DVec2; 2]),
    across: u32,
    /// What a sample of one texel's width must be passed by for its width, as a key, and for each unit of slope.
    width: f64,
    slope: f64,
    /// The least width of a sample, texels.
    least: f64,
    /// Roundings of what is compared.
    rounding: f64,
}

/// What a sample says before a place is named.
#[derive(Clone, Copy)]
struct Voter {
    /// How far the receiver's plane lies behind the sample's, as a key over texels, less what it must pass by.
    behind: Affine,
    /// The same where the sample was taken.
    there: f64,
    /// What it must pass by.
    passed: f64,
}

impl Voter {
    /// Calls everything lit.
    const NOTHING: Self = Self { behind: Affine::constant(-1.0), there: f64::NEG_INFINITY, passed: 0.0 };

    /// Whether the sample calls a place dark.
    #[inline(always)]
    fn dark(&self, at: DVec2) -> bool {
        self.there > 0.0 && self.behind.at(at) > 0.0
    }
}

/// Samples along each side of the region that are kept at hand; larger regions ask the map for each place.
const AT_HAND: i32 = 9;

/// Regions of more texels along a side are not asked whether all of their samples agree.
const MOST_AGREED: f64 = 16.0;

/// Beyond so many samples from the origin, and at NaN, no map has one.
const FAR: f64 = 1e9;

/// The samples under a region.
struct Grid<'a, 'b, F: ?Sized> {
    asked: &'b Asked<'a, F>,
    /// The finer grid's column and row of the first, and columns.
    rect: TexelRect,
    voters: [Voter; (AT_HAND * AT_HAND) as usize],
}

impl<'a, F: FacetSource + ?Sized> Asked<'a, F> {
    #[inline(always)]
    fn new<S: Simd, M: DepthMap, P: Probe>(filter: &DualPlane, map: &'a F, query: &Query<'a, S, M, P>) -> Self {
        let (view, receiver) = (query.view(), query.receiver());
        let zeta = -receiver.eye.z;
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
            plane,
            steep: plane.dx.abs() + plane.dy.abs(),
            texel: receiver.texel,
            middle,
            axes,
            cells,
            part,
            across: if wide == 0.0 { 1 } else { filter.across.max(1) },
            width: filter.width_term * (texel.x * texel.y).sqrt() * view.key_per_world(zeta),
            slope: filter.slope_term,
            least: filter.footprint_term * wide,
            rounding: plane.at(receiver.texel).abs() * 1e-14,
        }
    }

    /// The fraction in shadow, and how many samples were looked at.
    #[inline(always)]
    fn fraction(&self) -> (f32, u32) {
        let (centre, axes) = self.part;
        let reach = axes[0].abs() + axes[1].abs();
        let fine = f64::from(self.map.fine());
        let corner = |at: DVec2| (at * fine - 0.5).floor();
        let (low, high) = (corner(centre - reach), corner(centre + reach) + 2.0);
        if !(low.abs().max_element() < FAR && high.abs().max_element() < FAR) {
            return (self.places(false, |_| false), 0);
        }
        let rect = TexelRect::new(low.as_ivec2(), high.as_ivec2());
        let inside = self.view.holds(centre.as_vec2(), reach.as_vec2());
        let wide = (high - low).max_element();
        let small = wide <= f64::from(AT_HAND);
        if inside && wide <= MOST_AGREED * fine {
            let (agreed, looked) = self.agreed(rect);
            if let Some(dark) = agreed {
                return (f32::from(u8::from(dark)), looked);
            }
        }
        let looked = rect.area().min(4 * (self.across * self.across) as usize) as u32;
        (if small { Grid::new(self, rect).fraction(inside) } else { self.one_by_one() }, looked)
    }

    /// The answer of all samples of a rectangle for all places of the region, where it is one; and how many were looked at.
    #[inline(always)]
    fn agreed(&self, rect: TexelRect) -> (Option<bool>, u32) {
        let (mut lit, mut dark, mut looked) = (true, true, 0);
        let (centre, axes) = self.part;
        self.map.each_sample(rect, &mut |sample| {
            looked += 1;
            let voter = self.voter(sample);
            let middle = voter.behind.at(centre);
            let along = |axis: DVec2| (voter.behind.dx * axis.x + voter.behind.dy * axis.y).abs();
            // A little more than the region, so that no rounding decides.
            let spread = (along(axes[0]) + along(axes[1])) * (1.0 + 1e-9);
            dark &= voter.there > 0.0 && middle - spread > 0.0;
            lit &= voter.there <= 0.0 || middle + spread <= 0.0;
            dark || lit
        });
        (if dark == lit { None } else { Some(dark) }, looked)
    }

    #[inline(always)]
    fn voter(&self, sample: &FacetSample) -> Voter {
        let plane = &sample.plane;
        if plane.c == f64::INFINITY {
            return Voter::NOTHING;
        }
        let gentle = self.steep.min(plane.dx.abs() + plane.dy.abs());
        // Planes of refined maps are three floats about the middle of a tile.
        let rounding = self.rounding + 1e-6 * gentle.min(self.width);
        let passed = rounding + (self.width + self.slope * gentle) * sample.side.max(self.least);
        let behind =
            Affine { c: self.plane.c - plane.c - passed, dx: self.plane.dx - plane.dx, dy: self.plane.dy - plane.dy };
        Voter { behind, there: behind.at(sample.at), passed }
    }

    /// The places of the region, and the answer of each that the view's rules settle.
    #[inline(always)]
    fn places(&self, inside: bool, mut dark: impl FnMut(DVec2) -> bool) -> f32 {
        let across = self.across;
        let offset = |i: u32| f64::from(2 * i + 1) / f64::from(across) - 1.0;
        let mut answer = |at: DVec2| {
            let ruled = if inside { None } else { answer(self.view.rules().verdict(self.view.locate(at.as_vec2()))) };
            ruled.unwrap_or_else(|| f32::from(u8::from(dark(at))))
        };
        if across == 1 {
            return answer(self.texel);
        }
        let (mut sum, mut all) = (0.0, 0.0);
        for j in 0..across {
            let row = self.middle + self.axes[1] * offset(j);
            for i in 0..across {
                let share = self.cells.share(i, j, across);
                if share > 0.0 {
                    all += share;
                    sum += share * answer(row + self.axes[0] * offset(i));
                }
            }
        }
        if all > 0.0 { sum / all } else { answer(self.texel) }
    }

    /// A large region: the map is asked anew for each place.
    #[inline(never)]
    fn one_by_one(&self) -> f32 {
        self.places(false, |at| {
            let corner = (at * f64::from(self.map.fine()) - 0.5).floor().as_ivec2();
            Grid::new(self, TexelRect::new(corner, corner + 2)).dark(at)
        })
    }
}

impl<'a, 'b, F: FacetSource + ?Sized> Grid<'a, 'b, F> {
    fn new(asked: &'b Asked<'a, F>, rect: TexelRect) -> Self {
        let mut voters = [Voter::NOTHING; (AT_HAND * AT_HAND) as usize];
        for (at, voter) in rect.texels().zip(&mut voters) {
            *voter = asked.voter(&asked.map.sample(at));
        }
        Self { asked, rect, voters }
    }

    #[inline(never)]
    fn fraction(&self, inside: bool) -> f32 {
        self.asked.places(inside, |at| self.dark(at))
    }

    #[inline(always)]
    fn voter(&self, at: IVec2) -> &Voter {
        let (from, columns) = (at - self.rect.min, self.rect.max.x - self.rect.min.x);
        &self.voters[(from.y * columns + from.x) as usize]
    }

    /// Whether a place is dark.
    #[inline(always)]
    fn dark(&self, at: DVec2) -> bool {
        let place = at * f64::from(self.asked.map.fine()) - 0.5;
        // Roundings of a place at the region's rim.
        let corner = place.floor().as_ivec2().clamp(self.rect.min, self.rect.max - 2);
        let vote = |k: i32| self.voter(corner + IVec2::new(k & 1, k >> 1)).dark(at);
        let votes = [vote(0), vote(1), vote(2), vote(3)];
        if votes == [votes[0]; 4] {
            return votes[0];
        }
        self.shape(corner, votes, place - corner.as_dvec2())
    }

    /// Marching squares: on which side of the edge a place is, where the corners disagree. `within` the cell, 0 to 1 from its upper left
    /// corner.
    fn shape(&self, corner: IVec2, votes: [bool; 4], within: DVec2) -> bool {
        let [a, b, c, d] = votes;
        let dark = votes.iter().filter(|vote| **vote).count();
        let crossed = |from: usize, to: usize| self.crossing(corner, from, to);
        match dark {
            // One corner stands alone.
            1 | 3 => {
                let alone = votes.iter().position(|vote| *vote == (dark == 1)).unwrap_or(0);
                self.beyond(corner, alone, within) != (dark == 1)
            }
            // The upper and lower sides are crossed.
            _ if a == c && b == d => {
                let (upper, lower) = (crossed(0, 1), crossed(2, 3));
                if within.x < upper + (lower - upper) * within.y { a } else { b }
            }
            // The left and right sides are.
            _ if a == b && c == d => {
                let (left, right) = (crossed(0, 2), crossed(1, 3));
                if within.y < left + (right - left) * within.x { a } else { c }
            }
            // Opposite corners agree: the middle is in shadow.
            _ => (0..4).filter(|corner| !votes[*corner]).all(|lit| self.beyond(corner, lit, within)),
        }
    }

    /// Whether a place lies beyond the line that cuts a corner of a cell off.
    fn beyond(&self, cell: IVec2, corner: usize, within: DVec2) -> bool {
        let from_corner = |to: usize| {
            let place = self.crossing(cell, corner.min(to), corner.max(to));
            if corner < to { place } else { 1.0 - place }
        };
        let (p, q) = (from_corner(corner ^ 1), from_corner(corner ^ 2));
        let x = if corner & 1 == 0 { within.x } else { 1.0 - within.x };
        let y = if corner & 2 == 0 { within.y } else { 1.0 - within.y };
        // x/p + y/q < 1 is this side; a crossing at the corner itself leaves nothing of it.
        x * q + y * p >= p * q
    }

    /// Where a side of a cell is crossed, from 0 at `from`, its upper or left end, to 1: where the map saw the surface change, or where the
    /// receiver's plane passes from behind one to before the other, or in the middle.
    fn crossing(&self, cell: IVec2, from: usize, to: usize) -> f64 {
        let at = |corner: usize| cell + IVec2::new(corner as i32 & 1, corner as i32 >> 1);
        if let Some(place) = self.asked.map.link(at(from), to - from == 2) {
            return place;
        }
        let behind = |corner: usize| {
            let voter = self.voter(at(corner));
            voter.there + voter.passed
        };
        let (a, b) = (behind(from), behind(to));
        if (a > 0.0) != (b > 0.0) && a.is_finite() && b.is_finite() { a / (a - b) } else { 0.5 }
    }
}
