use crate::{EveryTexel, Key, Pattern, Taps, tent::weigh};
use fearless_simd::{Simd, f32x16, prelude::*};
use umbrage_plane::Footprint;

/// [`EveryTexel`] with the weights that Castaño's 9 and 16 bilinear comparisons add up to (*Shadow Mapping Summary, Part 1*, The Witness, 2013):
/// those of Bevy's `Gaussian` and of Babylon.js' `FILTER_PCF`. Over a region of a half-extent of 3 texels (5 × 5) or 4 (7 × 7) they are exactly theirs.
///
/// On each axis the weight falls in straight lines through 4, 3, 1, 0 or 16, 12, 5, 1, 0 at the centre and after each third or quarter of
/// the half-extent: texels at whole distances have 1 3 4 3 1 or 1 5 12 16 12 5 1. His 3 × 3 texels by 4 comparisons are a [`Tent`](crate::Tent) of a half-extent of 2.
///
/// An axis of at most one texel's extent has one tap, of weight 1.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Castano {
    /// 5 × 5 texels.
    #[default]
    Five,
    /// 7 × 7 texels.
    Seven,
}

impl Castano {
    /// The weight at a distance of `t` thirds or quarters of the half-extent.
    #[inline(always)]
    fn at<S: Simd>(self, t: f32x16<S>) -> f32x16<S> {
        match self {
            Self::Five => ramp(t, 3.0) + ramp(t, 2.0) - ramp(t, 1.0),
            Self::Seven => (ramp(t, 3.0) + ramp(t, 2.0) - ramp(t, 1.0)) * 3.0 + ramp(t, 4.0),
        }
    }
}

/// How far `t` is before `end`; 0 behind it.
#[inline(always)]
fn ramp<S: Simd>(t: f32x16<S>, end: f32) -> f32x16<S> {
    (-t + end).max(f32x16::splat(t.simd, 0.0))
}

impl Pattern for Castano {
    #[inline(always)]
    fn weighted(&self) -> bool {
        true
    }

    #[inline(always)]
    fn taps<S: Simd>(&self, simd: S, region: &Footprint, key: Key, mut each: impl FnMut(&Taps<S>)) {
        let parts = if *self == Self::Five { 3.0 } else { 4.0 };
        EveryTexel.taps(
            simd,
            region,
            key,
            #[inline(always)]
            |taps| {
                each(&weigh(
                    simd,
                    region,
                    taps,
                    #[inline(always)]
                    |away: f32x16<S>, half| self.at(away * (parts / half)),
                ));
            },
        );
    }
}
