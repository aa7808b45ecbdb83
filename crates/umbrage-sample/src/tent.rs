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
                    |away: f32x16<S>, half| (-(away / half) + 1.0).max(f32x16::splat(simd, 0.0)),
                ));
            },
        );
    }
}

/// Taps with the product of what `side` gives for their distances from the region's centre along x and y, and the half-extents there. An axis of at most one
/// texel's extent counts as 1. `side` is called twice: to be compiled for the machine's own instructions it says `#[inline(always)]`.
#[inline(always)]
pub(crate) fn weigh<S: Simd>(
    simd: S,
    region: &Footprint,
    taps: &Taps<S>,
    side: impl Fn(f32x16<S>, f32) -> f32x16<S>,
) -> Taps<S> {
    let weight = along(simd, taps.x, (region.centre.x, region.half.x), &side)
        * along(simd, taps.y, (region.centre.y, region.half.y), &side);
    Taps { weight, ..*taps }
}

/// The weights along one axis, of which the region has a centre and a half-extent. A function, since a closure that is called twice is not inlined, and
/// then not compiled for the machine's own instructions.
#[inline(always)]
fn along<S: Simd>(
    simd: S,
    at: f32x16<S>,
    (centre, half): (f32, f32),
    side: &impl Fn(f32x16<S>, f32) -> f32x16<S>,
) -> f32x16<S> {
    if half > 0.5 { side((at - centre).abs(), half) } else { f32x16::splat(simd, 1.0) }
}
