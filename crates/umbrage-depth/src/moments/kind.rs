/// Which moments of its depths a [`MomentMap`](crate::MomentMap) keeps, that is, means of functions of them, or what is made of such means.
///
/// Depths are scaled to 0..=1 as [`MomentSource::scaled`](crate::MomentSource::scaled) says. Exponents are per unit of what they multiply. Those that
/// 32-bit floats cannot hold are lowered to the largest that they can, negative ones and NaN count as 0.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Moments {
    /// The depth z and its square: variance shadow maps (Donnelly & Lauritzen 2006). Two channels.
    Variance,
    /// exp(s·z): exponential shadow maps (Annen, Mertens, Seidel, Flerackers & Kautz 2008). One channel.
    Exponential {
        /// s, at most 88. The larger, the closer the exponential is to a comparison; 80 suits 32-bit floats.
        sharpness: f32,
    },
    /// exp(c·u) and its square, u = 2z − 1 being the depth scaled to −1..=1: exponential variance shadow maps (Lauritzen & McCool 2008).
    /// Two channels, or four with −exp(−n·u) and its square.
    ExponentialVariance {
        /// c, at most 44, beyond which the square no longer fits into a 32-bit float.
        positive: f32,
        /// n, with the same bound; `None` for two channels.
        negative: Option<f32>,
    },
    /// The first four powers of the depth: moment shadow maps (Peters & Klein 2015). Four channels.
    Four,
    /// The mean of the depth and the standard deviation about it: `VSMShadowMap` of three.js (r187, `vsm.glsl.js` and `VSMPass` in `WebGLShadowMap.js`). Two
    /// channels, each rounded to a 16-bit float, on the scale of screen depth.
    ///
    /// The blur is a box of `prefilter` texels to each side (three's `radius`). First, in each column, this many texels at even distances from one side to the
    /// other give a mean and a deviation; then, in each row, as many places do, at which both are interpolated linearly before the deviation is squared. What
    /// is interpolated that way is not the variance of all texels: it is smaller between different deviations. Roundings are to the nearest, where a graphics
    /// driver may cut off.
    ///
    /// There are no coarser levels.
    Deviation {
        /// Samples along a column and along a row, from 1 to [`Moments::MOST_SAMPLES`]; `blurSamples` of three.js, 8 there.
        samples: u32,
    },
}

impl Moments {
    /// Exponential shadow maps with a sharpness of 80, for 32-bit floats (Annen et al. 2008).
    pub const ESM: Self = Self::Exponential { sharpness: 80.0 };
    /// Exponential variance shadow maps of two channels with an exponent of 40.
    pub const EVSM2: Self = Self::ExponentialVariance { positive: 40.0, negative: None };
    /// Exponential variance shadow maps of four channels with exponents of 40 and 5.
    pub const EVSM4: Self = Self::ExponentialVariance { positive: 40.0, negative: Some(5.0) };

    /// Largest exponent of [`Moments::ExponentialVariance`]: exp(2 · 44) is below the largest 32-bit float, exp(2 · 45) is not.
    pub const MOST_EXPONENT: f32 = 44.0;
    /// Largest exponent of [`Moments::Exponential`].
    pub const MOST_SHARPNESS: f32 = 88.0;
    /// Most samples of [`Moments::Deviation`] along a row.
    pub const MOST_SAMPLES: u32 = 256;

    /// Floats a texel.
    #[must_use]
    pub const fn channels(self) -> usize {
        match self {
            Self::Exponential { .. } => 1,
            Self::Variance | Self::ExponentialVariance { negative: None, .. } | Self::Deviation { .. } => 2,
            Self::ExponentialVariance { negative: Some(_), .. } | Self::Four => 4,
        }
    }

    /// The same with exponents that 32-bit floats can hold, and with as many samples as may be.
    #[must_use]
    pub(crate) fn held(self) -> Self {
        // NaN becomes 0.
        let within = |exponent: f32, most: f32| exponent.max(0.0).min(most);
        match self {
            Self::Variance | Self::Four => self,
            Self::Exponential { sharpness } => Self::Exponential { sharpness: within(sharpness, Self::MOST_SHARPNESS) },
            Self::ExponentialVariance { positive, negative } => Self::ExponentialVariance {
                positive: within(positive, Self::MOST_EXPONENT),
                negative: negative.map(|exponent| within(exponent, Self::MOST_EXPONENT)),
            },
            Self::Deviation { samples } => Self::Deviation { samples: samples.clamp(1, Self::MOST_SAMPLES) },
        }
    }

    /// A depth of 0..=1 as [`Moments::ExponentialVariance`] bends it: exp(c·u) for an exponent c, and −exp(−n·u) for an exponent −n. Both
    /// grow with the depth.
    #[must_use]
    pub fn warped(exponent: f64, depth: f64) -> f64 {
        (exponent * (2.0 * depth - 1.0)).exp().copysign(exponent)
    }

    /// What one texel keeps of its scaled depth; channels beyond [`Moments::channels`] are 0.
    #[must_use]
    pub fn of(self, depth: f64) -> [f64; 4] {
        match self {
            Self::Variance => [depth, depth * depth, 0.0, 0.0],
            Self::Exponential { sharpness } => [(f64::from(sharpness) * depth).exp(), 0.0, 0.0, 0.0],
            Self::ExponentialVariance { positive, negative } => {
                let far = Self::warped(f64::from(positive), depth);
                let near = negative.map_or(0.0, |exponent| Self::warped(-f64::from(exponent), depth));
                [far, far * far, near, near * near]
            }
            Self::Four => {
                let square = depth * depth;
                [depth, square, square * depth, square * square]
            }
            // One texel deviates from nothing.
            Self::Deviation { .. } => [depth, 0.0, 0.0, 0.0],
        }
    }
}
