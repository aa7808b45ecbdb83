use super::{Compared, by_bounds};
use fearless_simd::{Simd, f32x16, prelude::*};
use umbrage_plane::{Bias, DepthPlane, DepthRange, Kind, Receiver, Sampling, TexelRect, View, floor_texel};
use umbrage_sample::Taps;

/// The receiver's tangent plane at the place where the texel that is read was sampled, moved toward the light
/// (the virtual sample of Wang & Molnar 1994).
///
/// A plane then needs no bias for slope, only for rounding. One that is edge-on to the light has the receiver's own depth everywhere; one whose
/// horizon is passed is at +∞ there, behind everything that is stored.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub struct OnPlane {
    /// Moves the whole plane toward the light.
    pub bias: Bias,
    /// Moves it by this many times the rounding of its own depths: 4·10⁻⁶ of screen depth, 10⁻⁶ of other depths, both over |N·L|
    /// (Wang & Molnar 1994). 1 lets a flat sheet be its own second surface.
    pub slack: f32,
    /// The plane's depth goes no farther than this from the receiver's own, in the map's units; +∞ does not limit it (Wang & Molnar 1994).
    pub reach: f32,
}

impl Default for OnPlane {
    /// The plane itself.
    fn default() -> Self {
        Self { bias: Bias::ZERO, slack: 0.0, reach: f32::INFINITY }
    }
}

umbrage_plane::builders!([] OnPlane { with_bias bias: Bias, with_slack slack: f32, with_reach reach: f32 });

impl OnPlane {
    /// The plane moved by a bias.
    pub const fn biased(bias: Bias) -> Self {
        Self { bias, slack: 0.0, reach: f32::INFINITY }
    }

    /// For one receiver.
    #[inline(always)]
    pub(super) fn ready(&self, view: &View, receiver: &Receiver) -> Ready {
        Ready {
            plane: receiver.plane(view),
            sampling: view.sampling(),
            low: receiver.depth - self.reach,
            high: receiver.depth + self.reach,
            shift: self.shift(view, receiver),
        }
    }

    /// How far the plane is moved away from the receiver's own depth, in the map's units; ≤ 0 is toward the light.
    #[inline(always)]
    fn shift(&self, view: &View, receiver: &Receiver) -> f32 {
        let rounding = if view.kind() == Kind::Screen { 4e-6 } else { 1e-6 * receiver.depth.abs() };
        // At the least cosine for which Wang & Molnar's rule compares planes.
        let slack = self.slack * rounding / receiver.facing.abs().max(0.02);
        (receiver.nearer(view, self.bias) - receiver.depth) - slack
    }
}

by_what_is_ready!(OnPlane, |_| true);

/// [`OnPlane`] of one receiver.
#[derive(Clone, Copy)]
pub(super) struct Ready {
    plane: DepthPlane,
    sampling: Sampling,
    /// Depths of the plane are limited, before it is moved, from here
    low: f32,
    /// to here.
    high: f32,
    /// How far it is moved.
    shift: f32,
}

impl Ready {
    /// What is compared where the plane has a depth.
    #[inline(always)]
    fn moved(&self, depth: f32) -> f32 {
        depth.max(self.low).min(self.high) + self.shift
    }
}

impl Compared for Ready {
    #[inline(always)]
    fn lanes<S: Simd>(&self, simd: S, taps: &Taps<S>) -> f32x16<S> {
        let (columns, rows) = (floor_texel(simd, taps.x), floor_texel(simd, taps.y));
        let mut depths = self.plane.at_all(&self.sampling.positions(&columns.into(), &rows.into()));
        for depth in &mut depths {
            *depth = self.moved(*depth);
        }
        f32x16::load_array(simd, depths)
    }

    #[inline(always)]
    fn bounds(&self, rect: TexelRect) -> DepthRange {
        let plane = self.plane.bounds(rect);
        DepthRange { min: self.moved(plane.min), max: self.moved(plane.max) }
    }

    #[inline(always)]
    fn settled(&self, rect: TexelRect, stored: DepthRange) -> Option<bool> {
        // The bounds enclose all corners: one that lies within the stored range leaves everything open.
        let corner = self.moved(self.plane.at(rect.min.as_dvec2()));
        if corner > stored.min && corner <= stored.max {
            return None;
        }
        by_bounds(self.bounds(rect), stored)
    }
}
