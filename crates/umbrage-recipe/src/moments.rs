//! Recipes that filter the map before it is looked up: the moments that they store, and what compares them.

use crate::PresetName;
use umbrage_depth::{DepthMap, Map, MomentMap, Moments};
use umbrage_shadow::{FromMoments, presets};

/// The settings of recipes over moments of depths, besides the bias.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct MomentValues {
    /// The sharpness of one exponential, or the positive exponent.
    pub exponent: f32,
    pub negative: f32,
    /// Standard deviation of the blur, or how far its box reaches to each side, texels.
    pub prefilter: f32,
    /// Samples along a row of the box.
    pub samples: u32,
    pub filter: FromMoments,
}

impl MomentValues {
    /// As a preset has them; as `vsm` for one of another family.
    pub fn of(preset: PresetName) -> Self {
        let (kind, filter) = match preset {
            PresetName::Esm => (Moments::ESM, presets::esm().filter),
            PresetName::Evsm2 => (Moments::EVSM2, presets::evsm2().filter),
            PresetName::Evsm4 => (Moments::EVSM4, presets::evsm4().filter),
            PresetName::Msm => (Moments::Four, presets::msm().filter),
            PresetName::ThreeVsm => (Moments::Deviation { samples: SAMPLES }, three()),
            _ => (Moments::Variance, presets::vsm().filter),
        };
        let (exponent, negative) = match kind {
            Moments::Exponential { sharpness } => (sharpness, 0.0),
            Moments::ExponentialVariance { positive, negative } => (positive, negative.unwrap_or(0.0)),
            Moments::Variance | Moments::Four | Moments::Deviation { .. } => (0.0, 0.0),
        };
        Self { exponent, negative, prefilter: 1.0, samples: SAMPLES, filter }
    }

    /// Which moments a preset stores; `None` for one that compares depths.
    fn kept(&self, preset: PresetName) -> Option<Moments> {
        let Self { exponent, negative, .. } = *self;
        match preset {
            PresetName::Vsm => Some(Moments::Variance),
            PresetName::Esm => Some(Moments::Exponential { sharpness: exponent }),
            PresetName::Evsm2 => Some(Moments::ExponentialVariance { positive: exponent, negative: None }),
            PresetName::Evsm4 => Some(Moments::ExponentialVariance { positive: exponent, negative: Some(negative) }),
            PresetName::Msm => Some(Moments::Four),
            PresetName::ThreeVsm => Some(Moments::Deviation { samples: self.samples }),
            _ => None,
        }
    }

    /// A map as a preset uses it: with moments, where it needs some and the map has none. Deep maps stay as they are: the light that passes them is
    /// evaluated texel by texel.
    pub fn over(&self, preset: PresetName, map: Map) -> Map {
        match self.kept(preset) {
            Some(kind) if map.moments().is_none() && map.translucent().is_none() => {
                MomentMap::of(&map, kind, self.prefilter).into()
            }
            _ => map,
        }
    }

    /// Texels to each side of a place on which its moments depend, at least.
    pub fn reach(&self, preset: PresetName) -> f32 {
        match preset {
            // Both passes and the look-up interpolate, or round to a texel.
            PresetName::ThreeVsm => 2.0 + self.prefilter.ceil(),
            _ => 1.0 + (3.0 * self.prefilter).ceil(),
        }
    }
}

/// `blurSamples` of three.js (r187, `LightShadow.js`).
const SAMPLES: u32 = 8;

/// The numbers of `getShadow` for `VSMShadowMap` (r187, `shadowmap_pars_fragment.glsl.js`).
fn three() -> FromMoments {
    FromMoments::default().with_bleeding(0.3).with_lit_from(0.95).with_least_variance(1e-7)
}
