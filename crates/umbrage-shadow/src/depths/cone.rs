use super::Compared;
use fearless_simd::{Simd, f32x16, prelude::*};
use glam::DVec2;
use umbrage_plane::{Bias, DepthRange, Kind, Receiver, TexelRect, View, floor_texel};
use umbrage_sample::Taps;

/// The distance that a [`BiasCone`] measures (Burley 2006).
#[derive(Clone, Copy, Debug, PartialEq, Eq, Default)]
pub enum Radius {
    /// To the place in the texel that is read where its depth was taken: the centre, or its own offset in a stochastic map.
    #[default]
    TexelCentre,
    /// To the tap itself, as the note prints it. Needs a base of τ·tanθ/√2 in addition, and twice that in a stochastic map, whose
    /// samples lie up to a whole diagonal of a texel away.
    Nominal,
}

/// The bias cone: the receiver's depth falls toward the light with the distance of the place that is looked up
/// (Burley 2006).
///
/// Distances are in world units on the plane perpendicular to the light's axis through the receiver, so that `slope` is the tangent of the steepest
/// tilt that is free of false shadow. That is certain with [`Radius::TexelCentre`], whatever the texel, in maps of
/// axial and of screen depth, except for rounding at the very tip (see `base`).
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub struct BiasCone {
    /// Bias at the cone's tip, world units, from 0. A receiver exactly on a sample of the map needs the rounding of stored depths, some 10⁻⁶ of
    /// its distance; elsewhere the slope covers it.
    pub base: f32,
    /// World units of bias for each world unit of distance, from 0. 2 is the note's production value, 63.4°; 1 is 45°.
    pub slope: f32,
    /// How distances are measured.
    pub radius: Radius,
}

impl Default for BiasCone {
    /// Base 0, slope 2, measured to the texel that is read.
    fn default() -> Self {
        Self { base: 0.0, slope: 2.0, radius: Radius::TexelCentre }
    }
}

umbrage_plane::builders!([] BiasCone { with_base base: f32, with_slope slope: f32, with_radius radius: Radius });

impl BiasCone {
    /// The bias at a distance, both in world units.
    #[inline(always)]
    pub fn bias(&self, radius: f32) -> f32 {
        self.base + self.slope * radius
    }
}

impl BiasCone {
    /// For one receiver.
    #[inline(always)]
    pub(super) fn ready<'a>(&self, view: &'a View, receiver: &'a Receiver) -> Ready<'a> {
        Ready { cone: *self, view, receiver, tip: receiver.texel, world: receiver.texel_world.as_dvec2() }
    }
}

by_what_is_ready!(BiasCone, |_| false);

/// [`BiasCone`] of one receiver.
#[derive(Clone, Copy)]
pub(super) struct Ready<'a> {
    cone: BiasCone,
    view: &'a View,
    receiver: &'a Receiver,
    /// Where its tip is, texels.
    tip: DVec2,
    /// World units of a texel there.
    world: DVec2,
}

impl Ready<'_> {
    /// The depth at a distance, world units.
    #[inline(always)]
    fn at(&self, distance: f64) -> f32 {
        self.receiver.nearer(self.view, Bias::World(self.cone.bias(distance as f32)))
    }
}

impl Compared for Ready<'_> {
    #[inline(always)]
    fn lanes<S: Simd>(&self, simd: S, taps: &Taps<S>) -> f32x16<S> {
        let [x, y] = match self.cone.radius {
            Radius::TexelCentre => {
                let (columns, rows) = (floor_texel(simd, taps.x), floor_texel(simd, taps.y));
                self.view.sampling().positions(&columns.into(), &rows.into())
            }
            Radius::Nominal => {
                let places: [[f32; 16]; 2] = [taps.x.into(), taps.y.into()];
                let mut wide = [[0.0; 16]; 2];
                for i in 0..16 {
                    (wide[0][i], wide[1][i]) = (f64::from(places[0][i]), f64::from(places[1][i]));
                }
                wide
            }
        };
        let mut distances = [0.0; 16];
        for i in 0..16 {
            distances[i] = ((DVec2::new(x[i], y[i]) - self.tip) * self.world).length();
        }
        let mut depths = [0.0; 16];
        // Two loops, so that the one without branches becomes vector instructions: `nearer` of a world bias in maps of any depth but the
        // screen's is a difference.
        if self.view.kind() == Kind::Screen {
            for i in 0..16 {
                depths[i] = self.at(distances[i]);
            }
        } else {
            for i in 0..16 {
                depths[i] = self.receiver.depth - self.cone.bias(distances[i] as f32);
            }
        }
        f32x16::load_array(simd, depths)
    }

    #[inline(always)]
    fn bounds(&self, rect: TexelRect) -> DepthRange {
        DepthRange { min: self.farthest(rect), max: self.nearest(rect) }
    }

    #[inline(always)]
    fn settled(&self, rect: TexelRect, stored: DepthRange) -> Option<bool> {
        // Where one end of the bounds lies within the stored range, the other cannot change that.
        let max = self.nearest(rect);
        if max <= stored.min {
            Some(false)
        } else if max > stored.max && self.farthest(rect) > stored.max {
            Some(true)
        } else {
            None
        }
    }
}

impl Ready<'_> {
    /// The smallest depth: that where the rectangle is farthest from the tip.
    #[inline(always)]
    fn farthest(&self, rect: TexelRect) -> f32 {
        let (low, high) = (rect.min.as_dvec2() - self.tip, rect.max.as_dvec2() - self.tip);
        self.at((low.abs().max(high.abs()) * self.world).length()).next_down()
    }

    /// The largest depth.
    #[inline(always)]
    fn nearest(&self, rect: TexelRect) -> f32 {
        let (low, high) = (rect.min.as_dvec2() - self.tip, rect.max.as_dvec2() - self.tip);
        self.at((DVec2::ZERO.clamp(low, high) * self.world).length()).next_up()
    }
}
