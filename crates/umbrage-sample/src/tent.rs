use crate::{EveryTexel, Key, Pattern, Taps};
use fearless_simd::{Simd, f32x16, prelude::*};
use umbrage_plane::Footprint;

/// [`EveryTexel`] with weights that fall in a straight line from the region's centre to its sides, on both axes: of the nearest four texels
/// (a half-extent of 1) those of bilinear interpolation (Wang & Molnar 1994).
///
/// An axis of at most one texel's extent has one tap, of weight 1: its texel's centre may lie on the region's side, where nothing would count.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Tent;

impl Pattern for Tent {
    #[inline(always)]
    fn weighted(&self) -> bool {
        true
    }

    #[inline(always)]
    fn taps<S: Simd>(&self, simd: S, region: &Footprint, key: Key, mut each: impl FnMut(&Taps<S>)) {
        let side = |at: f32x16<S>, centre: f32, half: f32| {
            let share = if half > 0.5 { (at - centre).abs() / half } else { f32x16::splat(simd, 0.0) };
            (-share + 1.0).max(f32x16::splat(simd, 0.0))
        };
        EveryTexel.taps(
            simd,
            region,
            key,
            #[inline(always)]
            |taps| {
                let weight =
                    side(taps.x, region.centre.x, region.half.x) * side(taps.y, region.centre.y, region.half.y);
                each(&Taps { weight, ..*taps });
            },
        );
    }
}
