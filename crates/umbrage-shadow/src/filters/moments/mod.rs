//! Shadows from moments of depths: variance, exponential and moment shadow maps.
//!
//! A [`MomentMap`](umbrage_depth::MomentMap) keeps means of functions of its depths over regions of all sizes. They do not determine how much of a region lies
//! in front of a
//! receiver, but they bound it from below or above: each method is an inequality, and these are the functions of it. [`FromMoments`] chooses among them by
//! what the map holds.
//!
//! | kept | inequality | method |
//! |---|---|---|
//! | [`Moments::Variance`] | [`at_or_beyond`]: Chebyshev's for one side | variance shadow maps, Donnelly & Lauritzen 2006 |
//! | [`Moments::Exponential`] | [`at_or_beyond_by_mean`]: Markov's, of an exponential | exponential shadow maps, Annen et al. 2008 |
//! | [`Moments::ExponentialVariance`] | Chebyshev's, of one exponential or the better of two | exponential variance shadow maps, Lauritzen & McCool 2008 |
//! | [`Moments::Four`] | [`before`]: the sharp one for four moments | moment shadow maps ("Hamburger 4MSM"), Peters & Klein 2015 |
//! | [`Moments::Deviation`] | Chebyshev's for one side, of a mean and a standard deviation | `VSMShadowMap` of three.js, r187 |

mod bounds;

pub use bounds::{at_or_beyond, at_or_beyond_by_mean, before};

use super::williams::{four, lerp};
use crate::{Biased, Filter, Probe, Query, ReceiverDepth};
use fearless_simd::Simd;
use glam::Vec2;
use umbrage_depth::{DepthMap, MomentSource, Moments};
use umbrage_plane::{Bias, Place};

/// Fractions below this are roundings of 32-bit moments.
const ROUNDING: f64 = 1e-6;

/// The shadow that is certain from moments of the map's depths, by the inequality that goes with them (see [`moments`](crate::moments)).
///
/// The moments are those at the receiver's place, interpolated linearly between texels and levels. The level is
/// log₂ of the larger side of the receiver's footprint in texels, capped as every filter caps it, and 0 for footprints below a texel: its
/// texels are as wide as the footprint. Where a third surface lies behind two others, the inequality admits light that is not there, which is
/// called light bleeding; `bleeding` cuts it off.
///
/// Receivers up to the map's nearest depth are lit. So are those whose depth is NaN. Shadows below 10⁻⁶ are none. A place outside the map
/// or the cone is settled by the view's rules.
///
/// Over a map without moments the depths of four texels are known themselves: the result is the fraction of the four around the receiver's
/// place that is nearer, weighted as in an interpolation, and over deep maps the fraction of light that these stop. Nothing is cut off. Around a light, places
/// that only a neighbour's
/// map sees are settled by its single texel, and moments do not reach across seams.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub struct FromMoments<D = Biased> {
    /// Which depth is compared: the receiver's own moved toward the light, by default. The exact fraction of a tilted plane before its own middle is a half, and the sharper the
    /// inequality the closer it comes to that: four moments need two steps or more.
    pub depth: D,
    /// The part of the fraction that may be lit which counts as none, the rest being stretched to 0..=1 (Lauritzen 2007, GPU Gems 3, ch. 8,
    /// on light-bleeding reduction). 0 cuts nothing off; 1 and more leave only what is wholly lit, NaN and negative numbers are 0. Penumbrae become narrower
    /// by it.
    pub bleeding: f32,
    /// The fraction that may be lit from which all counts as lit: what is between `bleeding` and this is stretched to 0..=1. 1, more and NaN change nothing; at
    /// `bleeding` or below it, only what is wholly lit is left. three.js has 0.95 (r187).
    pub lit_from: f32,
    /// Variance that counts at least, in squares of the scaled depth: what roundings are, and what a tilted plane has within a texel (Donnelly &
    /// Lauritzen 2006). Exponentials have it times the square of their slope at the mean. Not used by other kinds; NaN and negative numbers are 0.
    pub least_variance: f32,
    /// The fraction α by which four moments are mixed with those of a distribution that is half at 0 and half at 1, so that roundings do not
    /// make them impossible (Peters & Klein 2015); the known fraction of the admixture is removed from the result. Not used by other kinds; taken as within
    /// 0..=0.5, and NaN as 0.
    pub moment_bias: f32,
}

umbrage_plane::builders!([D] FromMoments<D> {
    with_bleeding bleeding: f32, with_lit_from lit_from: f32, with_least_variance least_variance: f32, with_moment_bias moment_bias: f32
});

impl<D> FromMoments<D> {
    /// The same, comparing another depth.
    #[must_use]
    pub fn with_depth<E: ReceiverDepth>(self, depth: E) -> FromMoments<E> {
        let Self { bleeding, lit_from, least_variance, moment_bias, .. } = self;
        FromMoments { depth, bleeding, lit_from, least_variance, moment_bias }
    }

    /// The same, comparing the receiver's own depth moved toward the light.
    #[must_use]
    pub fn with_bias(self, bias: Bias) -> FromMoments {
        self.with_depth(Biased::constant(bias))
    }
}

impl Default for FromMoments {
    /// No bias, a fiftieth is cut off, a least variance of 10⁻⁶ and a moment bias of 3·10⁻⁷, for moments of 32 bits.
    fn default() -> Self {
        let depth = Biased::constant(Bias::ZERO);
        Self { depth, bleeding: 0.02, lit_from: 1.0, least_variance: 1e-6, moment_bias: 3e-7 }
    }
}

impl<D: ReceiverDepth> Filter for FromMoments<D> {
    #[inline(always)]
    fn shadow<S: Simd, M: DepthMap, P: Probe>(&self, query: &mut Query<'_, S, M, P>) -> f32 {
        let view = query.view();
        let (at, compared) = query.at_point(&self.depth);
        if let Some(dark) = query.placed(at) {
            return dark;
        }
        if view.locate(at) == Place::Outside {
            // Outside the map there is nothing to interpolate, only what a neighbour may store there.
            return query.texel(at.floor().as_ivec2()).dark(compared);
        }
        let Some(moments) = query.map().moments() else {
            let (texels, share) = four(view, at);
            return lerp(texels.map(|texel| query.texel(texel).dark(compared)), share);
        };
        let level = (2.0 * query.region(1.0, 0.0).half.max_element()).max(1.0).log2();
        // Four texels of each of two levels.
        query.count(8);
        let Self { bleeding, lit_from, least_variance, moment_bias, .. } = *self;
        Inequality { bleeding, lit_from, least_variance, moment_bias }.over(moments, at, level, compared)
    }

    #[inline(always)]
    fn asks_tilt<M: DepthMap>(&self, _: &M) -> bool {
        self.depth.asks_tilt()
    }
}

/// What a [`FromMoments`] concludes by, whatever it compares.
struct Inequality {
    bleeding: f32,
    lit_from: f32,
    least_variance: f32,
    moment_bias: f32,
}

impl Inequality {
    /// The fraction in shadow by the moments at a place and a level. Apart from what is compiled for every map and machine.
    #[inline(never)]
    fn over(&self, map: &dyn MomentSource, at: Vec2, level: f32, compared: f32) -> f32 {
        let depth = map.scaled(compared);
        if depth.is_nan() || depth <= 0.0 {
            return 0.0;
        }
        let lit = self.lit(map.kind(), map.at(at, level), depth);
        if lit.is_nan() || lit > 1.0 - ROUNDING {
            return 0.0;
        }
        let bleeding = f64::from(self.bleeding.max(0.0));
        let full = if self.lit_from < 1.0 { f64::from(self.lit_from) } else { 1.0 };
        let kept = if bleeding < full { ((lit - bleeding).max(0.0) / (full - bleeding)).min(1.0) } else { 0.0 };
        (1.0 - kept) as f32
    }

    /// The fraction that may be lit.
    fn lit(&self, kind: Moments, moments: [f64; 4], depth: f64) -> f64 {
        let least = f64::from(self.least_variance.max(0.0));
        let [first, second, ..] = moments;
        match kind {
            Moments::Variance => at_or_beyond(first, (second - first * first).max(least), depth),
            Moments::Deviation { .. } => at_or_beyond(first, (second * second).max(least), depth),
            // What is compared is rounded as moments are.
            Moments::Exponential { .. } => at_or_beyond_by_mean(first, f64::from(kind.of(depth)[0] as f32)),
            Moments::ExponentialVariance { positive, negative } => {
                let of = |exponent: f64, mean: f64, square: f64| {
                    // The exponential's slope at a depth is 2c times itself, and to take it at the mean makes the bound smallest for receivers far behind.
                    let slope = 2.0 * exponent * mean;
                    let variance = (square - mean * mean).max(least * slope * slope);
                    at_or_beyond(mean, variance, f64::from(Moments::warped(exponent, depth) as f32))
                };
                let far = of(f64::from(positive), first, second);
                negative.map_or(far, |exponent| far.min(of(-f64::from(exponent), moments[2], moments[3])))
            }
            Moments::Four => {
                let mixed = if self.moment_bias > 0.0 { f64::from(self.moment_bias.min(0.5)) } else { 0.0 };
                // Of the admixture, half lies at 0, before every receiver that comes here, and none of the rest before its 1.
                let share = before(moments.map(|moment| moment + (0.5 - moment) * mixed), depth);
                1.0 - ((share - 0.5 * mixed) / (1.0 - mixed)).clamp(0.0, 1.0)
            }
        }
    }
}
