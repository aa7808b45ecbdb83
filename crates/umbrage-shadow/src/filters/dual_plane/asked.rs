//! The look-up of a receiver in a map of facets: votes of samples, and the edge between those that disagree.

use super::parameters::DualPlane;
use super::voters::Compared;
use crate::settled::answer;
use crate::{Probe, Query};
use fearless_simd::Simd;
use glam::DVec2;
use umbrage_depth::{DepthMap, FacetSource};
use umbrage_plane::{Affine, Cells, View};

/// The look-up of a receiver in a map of facets.
pub(super) struct Asked<'a, F: ?Sized> {
    pub map: &'a F,
    pub view: &'a View,
    /// What every sample is compared with.
    pub compared: Compared,
    texel: DVec2,
    /// The middle of the region's parallelogram, its half-axes, texels, and the part of it that is the surface.
    middle: DVec2,
    axes: [DVec2; 2],
    cells: Cells,
    pub across: u32,
    /// Change of the key per world unit along the axis of view, at the receiver.
    pub per_world: f64,
}

/// How often the interval between two places of different results is halved to find the edge.
const HALVINGS: u32 = 3;

/// Beyond this many samples from the origin, and at NaN, no map has a sample.
pub(super) const FAR: f64 = 1e9;

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

    /// The result for a place that the view's rules settle.
    #[inline(always)]
    pub fn ruled(&self, at: DVec2) -> Option<f32> {
        answer(self.view.rules().verdict(self.view.locate(at.as_vec2())))
    }

    /// The fraction of the region's surface that is dark, by lines across it: on each, the part between two places that agree is as they are, and between two
    /// that disagree the edge is searched for. `dark` is called for places that the view's rules do not settle.
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
        let (step, whole) = (1.0 / f64::from(self.across), self.cells.is_whole());
        let (mut sum, mut all) = (0.0, 0.0);
        for line in 0..self.across {
            let first = self.middle + beside * (f64::from(2 * line + 1) * step - 1.0) - along;
            let at = |cells: f64| first + along * (2.0 * step * cells);
            let mut before = None;
            for cell in 0..self.across {
                let (column, row) = if along_x { (cell, line) } else { (line, cell) };
                let share = if whole { 1.0 } else { self.cells.share(column, row, self.across) };
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
}
