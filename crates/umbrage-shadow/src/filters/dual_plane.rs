//! Two planes instead of a bias: the caster's own and the receiver's, compared at both ends.

use crate::query::answer;
use crate::{Filter, OnPlane, Probe, Query};
use fearless_simd::Simd;
use glam::{DVec2, IVec2};
use umbrage_depth::{DepthMap, FacetMap, FacetSample};
use umbrage_plane::{Affine, View};
use umbrage_sample::EveryTexel;

/// Shadow without a bias over a map of facets ([`FacetMap`]): the receiver's tangent plane is compared with the caster's own plane, and edges run
/// between the samples of a texel, not along its border.
///
/// A sample of the map calls a place of the receiver dark when the receiver's plane lies behind the sample's **both** at the sample's centre and at
/// the place itself: convex folds pass the first test, concave folds the second. What both must pass by is not a bias but what a sample cannot
/// know: half a sample's width and a quarter of the gentler slope over it. Of the four samples around a place that disagree, the
/// map's links say where between two of them the surface changes, and marching squares where the edge runs. A region is the mean of
/// `across` × `across` places.
///
/// Umbrage's own. Casters' planes are after Dou et al. 2014, edges in texels after Sen, Cammarano & Hanrahan 2003.
/// Over a map that knows no facets it compares the receiver's plane at every texel of its region, which is the best that such a map can give.
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
        let Some(map) = query.map().facets() else {
            let region = query.region(1.0, 1.0);
            return query.share(&region, &EveryTexel, &OnPlane::default());
        };
        let (fraction, looked) = Asked::new(self, map, query).fraction();
        query.count(looked);
        fraction
    }
}

/// A receiver asked of a map of facets.
struct Asked<'a> {
    map: &'a FacetMap,
    view: &'a View,
    /// The receiver's tangent plane.
    plane: Affine,
    texel: DVec2,
    /// Half-axes of the region, texels.
    axes: [DVec2; 2],
    across: u32,
    /// What a sample of one texel's width must pass by for its width, and for each unit of slope, as keys.
    width: f64,
    slope: f64,
    /// The least width of a sample, texels.
    least: f64,
    /// Roundings of what is compared.
    rounding: f64,
}

/// The four samples around a place, and the finer grid's column and row of the upper left one.
#[derive(Clone, Copy)]
struct Cell {
    at: IVec2,
    samples: [FacetSample; 4],
}

impl<'a> Asked<'a> {
    #[inline(always)]
    fn new<S: Simd, M: DepthMap, P: Probe>(filter: &DualPlane, map: &'a FacetMap, query: &Query<'a, S, M, P>) -> Self {
        let (view, receiver) = (query.view(), query.receiver());
        let plane = receiver.plane(view).key;
        let most = view.size().as_dvec2() * 0.125;
        let axes = receiver.axes.map(|axis| axis.as_dvec2().clamp(-most, most));
        let wide = 2.0 * axes[0].length().max(axes[1].length());
        let key = plane.at(receiver.texel);
        Self {
            map,
            view,
            plane,
            texel: receiver.texel,
            axes,
            across: if axes == [DVec2::ZERO; 2] { 1 } else { filter.across.max(1) },
            width: filter.width_term * view.key_width(key),
            slope: filter.slope_term,
            least: filter.footprint_term * wide,
            rounding: key.abs() * 1e-14,
        }
    }

    /// The fraction in shadow, and how many samples were looked at.
    #[inline(always)]
    fn fraction(&self) -> (f32, u32) {
        let across = self.across;
        let offset = |i: u32| f64::from(2 * i + 1) / f64::from(across) - 1.0;
        let (mut dark, mut looked) = (0.0, 0);
        let mut cell: Option<Cell> = None;
        for j in 0..across {
            for i in 0..across {
                let at = self.texel + self.axes[0] * offset(i) + self.axes[1] * offset(j);
                if let Some(ruled) = answer(self.view.rules().verdict(self.view.locate(at.as_vec2()))) {
                    dark += ruled;
                    continue;
                }
                let fine = at * f64::from(self.map.fine()) - 0.5;
                let corner = fine.floor().as_ivec2();
                if cell.is_none_or(|cell| cell.at != corner) {
                    cell = Some(self.cell(corner));
                    looked += 4;
                }
                let Some(cell) = &cell else { continue };
                dark += f32::from(u8::from(self.dark(cell, at, fine - corner.as_dvec2())));
            }
        }
        (dark / (across * across) as f32, looked)
    }

    fn cell(&self, at: IVec2) -> Cell {
        let sample = |k: i32| self.map.sample(at + IVec2::new(k & 1, k >> 1));
        Cell { at, samples: [sample(0), sample(1), sample(2), sample(3)] }
    }

    /// Where a cell's corner was sampled, texels: a texel that is not refined at its own centre.
    #[inline(always)]
    fn centre(&self, cell: &Cell, corner: usize) -> DVec2 {
        let at = cell.at + IVec2::new(corner as i32 & 1, corner as i32 >> 1);
        let fine = f64::from(self.map.fine());
        let at = (at.as_dvec2() + 0.5) / fine;
        if cell.samples[corner].side < 1.0 { at } else { at.floor() + 0.5 }
    }

    /// How far the receiver's plane lies behind a sample's, as a key.
    #[inline(always)]
    fn behind(&self, sample: &FacetSample, at: DVec2) -> f64 {
        self.plane.at(at) - sample.plane.at(at)
    }

    /// Whether a sample calls a place dark.
    #[inline(always)]
    fn votes(&self, cell: &Cell, corner: usize, at: DVec2) -> bool {
        let sample = &cell.samples[corner];
        if sample.plane.c == f64::INFINITY {
            return false;
        }
        let steep = |plane: &Affine| plane.dx.abs() + plane.dy.abs();
        let (own, other) = (steep(&self.plane), steep(&sample.plane));
        // Planes of refined maps are three floats about the middle of a tile.
        let rounding = self.rounding + 1e-6 * own.min(other).min(self.width);
        let passed = rounding + (self.width + self.slope * own.min(other)) * sample.side.max(self.least);
        self.behind(sample, at) > passed && self.behind(sample, self.centre(cell, corner)) > passed
    }

    /// Whether a place is dark: `within` the cell, 0 to 1 from its upper left corner.
    #[inline(always)]
    fn dark(&self, cell: &Cell, at: DVec2, within: DVec2) -> bool {
        let votes: [bool; 4] = std::array::from_fn(|corner| self.votes(cell, corner, at));
        if votes == [votes[0]; 4] {
            return votes[0];
        }
        self.shape(cell, votes, within)
    }

    /// Marching squares: which side of the edge a place is on, where the corners disagree.
    #[inline(never)]
    fn shape(&self, cell: &Cell, votes: [bool; 4], within: DVec2) -> bool {
        let [a, b, c, d] = votes;
        let dark = votes.iter().filter(|vote| **vote).count();
        // Where the upper, lower, left and right sides are crossed, from their upper or left end.
        let crossed = |from: usize, to: usize| self.crossing(cell, from, to);
        match dark {
            // One corner stands alone.
            1 | 3 => {
                let alone = votes.iter().position(|vote| *vote == (dark == 1)).unwrap_or(0);
                self.beyond_corner(cell, alone, within) != (dark == 1)
            }
            // Two opposite sides are crossed: upper and lower, or left and right.
            _ if a == c && b == d => {
                let (upper, lower) = (crossed(0, 1), crossed(2, 3));
                let left = within.x < upper + (lower - upper) * within.y;
                if left { a } else { b }
            }
            _ if a == b && c == d => {
                let (left, right) = (crossed(0, 2), crossed(1, 3));
                let above = within.y < left + (right - left) * within.x;
                if above { a } else { c }
            }
            // Opposite corners agree: the middle is in shadow.
            _ => (0..4).filter(|corner| !votes[*corner]).all(|corner| self.beyond_corner(cell, corner, within)),
        }
    }

    /// Whether a place lies beyond the line that cuts a corner off.
    fn beyond_corner(&self, cell: &Cell, corner: usize, within: DVec2) -> bool {
        let (beside, below) = (corner ^ 1, corner ^ 2);
        let from_corner = |from: usize, to: usize| {
            let place = self.crossing(cell, from.min(to), from.max(to));
            if from < to { place } else { 1.0 - place }
        };
        let (p, q) = (from_corner(corner, beside), from_corner(corner, below));
        let x = if corner & 1 == 0 { within.x } else { 1.0 - within.x };
        let y = if corner & 2 == 0 { within.y } else { 1.0 - within.y };
        // x/p + y/q < 1 is this side; a crossing at the corner itself leaves nothing of it.
        x * q + y * p >= p * q
    }

    /// Where a side of a cell is crossed, 0 at `from` (its upper or left end) to 1: where the map saw the surface change, or where the two planes
    /// meet the receiver's, or in the middle.
    fn crossing(&self, cell: &Cell, from: usize, to: usize) -> f64 {
        let down = to - from == 2;
        let at = cell.at + IVec2::new(from as i32 & 1, from as i32 >> 1);
        if let Some(place) = self.map.link(at, down) {
            return place;
        }
        let behind = |corner: usize| self.behind(&cell.samples[corner], self.centre(cell, corner));
        let (a, b) = (behind(from), behind(to));
        if (a > 0.0) != (b > 0.0) && a.is_finite() && b.is_finite() { a / (a - b) } else { 0.5 }
    }
}
