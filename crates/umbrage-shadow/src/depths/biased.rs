use super::Compared;
use fearless_simd::{Simd, f32x16, prelude::*};
use umbrage_plane::{Bias, DepthRange, Receiver, TexelRect, View};
use umbrage_sample::{Taps, radical_inverses};

/// How a bias is chosen from its range at each tap.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Default)]
pub enum Spread {
    /// At random (Reeves 1987): a surface that curves away shadows itself gradually, with noise.
    #[default]
    Random,
    /// As a ramp: tap k takes the radical inverse of k, so that the taps of a region share the range without noise; evenly when
    /// they are a power of two. Bias and place in the region are then correlated, as taps come row by row.
    Ramp,
}

/// One depth for the whole region, moved toward the light by a bias from a range (Reeves 1987, §3.2 and Fig. 4).
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub struct Biased {
    /// Smallest bias.
    pub low: Bias,
    /// Largest bias; equal to `low` for a fixed bias. Never reached exactly when it differs.
    pub high: Bias,
    /// How a tap's bias is chosen from the range.
    pub spread: Spread,
}

umbrage_plane::builders!([] Biased { with_low low: Bias, with_high high: Bias, with_spread spread: Spread });

impl Biased {
    /// The same bias at every tap.
    pub const fn constant(bias: Bias) -> Self {
        Self { low: bias, high: bias, spread: Spread::Random }
    }

    /// World units drawn at random from `low..high`.
    pub const fn world(low: f32, high: f32) -> Self {
        Self { low: Bias::World(low), high: Bias::World(high), spread: Spread::Random }
    }

    /// For one receiver.
    #[inline(always)]
    pub(super) fn ready(&self, view: &View, receiver: &Receiver) -> Ready {
        let (near_end, far_end) = (receiver.nearer(view, self.low), receiver.nearer(view, self.high));
        let constant = near_end == far_end || !(far_end - near_end).is_finite();
        Ready { near_end, span: if constant { None } else { Some(far_end - near_end) }, spread: self.spread }
    }
}

impl Default for Biased {
    /// Reeves' (0.3, 0.4), for worlds of about 100 units.
    fn default() -> Self {
        Self::world(0.3, 0.4)
    }
}

by_what_is_ready!(Biased, |depth| depth.low.asks_tilt() || depth.high.asks_tilt());

/// [`Biased`] of one receiver.
#[derive(Clone, Copy)]
pub(super) struct Ready {
    /// The depth moved by the smallest bias.
    near_end: f32,
    /// How far beyond that the largest bias moves it; `None` where there is one bias alone.
    span: Option<f32>,
    spread: Spread,
}

impl Ready {
    /// One depth at every tap.
    #[inline(always)]
    pub fn at(depth: f32) -> Self {
        Self { near_end: depth, span: None, spread: Spread::Random }
    }
}

impl Compared for Ready {
    #[inline(always)]
    fn lanes<S: Simd>(&self, simd: S, taps: &Taps<S>) -> f32x16<S> {
        let Some(span) = self.span else { return f32x16::splat(simd, self.near_end) };
        let share = match self.spread {
            Spread::Random => taps.u,
            Spread::Ramp => radical_inverses(simd, taps.first),
        };
        share * span + self.near_end
    }

    #[inline(always)]
    fn bounds(&self, _rect: TexelRect) -> DepthRange {
        let Some(span) = self.span else { return DepthRange { min: self.near_end, max: self.near_end } };
        let last = self.near_end + span;
        DepthRange { min: self.near_end.min(last), max: self.near_end.max(last) }
    }
}
