use crate::{EveryTexel, Key, Pattern, Taps, tent::weigh};
use fearless_simd::{Simd, f32x16, prelude::*};
use umbrage_plane::Footprint;

/// [`EveryTexel`] weighted by the area of a triangle over it, on both axes: the tents of Unity's pipelines (`ShadowSamplingTent.hlsl` of its render pipelines' core
/// package). The triangle ends half a texel before the region does, where the last texel that it touches may have its centre: half-extents of 2, 3 and 4
/// texels are Unity's tents of 3 × 3, 5 × 5 and 7 × 7.
///
/// An axis of at most one texel's extent has one tap, of weight 1.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct AreaTent;

impl Pattern for AreaTent {
    #[inline(always)]
    fn weighted(&self) -> bool {
        true
    }

    #[inline(always)]
    fn taps<S: Simd>(&self, simd: S, region: &Footprint, key: Key, mut each: impl FnMut(&Taps<S>)) {
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
                    |away: f32x16<S>, half| {
                        let foot = half - 0.5;
                        (area(simd, away + 0.5, foot) - area(simd, away - 0.5, foot)).max(f32x16::splat(simd, 0.0))
                    },
                ));
            },
        );
    }
}

/// The area of a triangle of slope 1 from its middle to a place, to the left negative; `foot` is half its width.
#[inline(always)]
fn area<S: Simd>(simd: S, place: f32x16<S>, foot: f32) -> f32x16<S> {
    let place = place.max(f32x16::splat(simd, -foot)).min(f32x16::splat(simd, foot));
    (place.abs() * -0.5 + foot) * place
}
