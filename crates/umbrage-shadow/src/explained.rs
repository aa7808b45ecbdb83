//! What a query does differently when it is explained.

use crate::{Probe, TapJudged};
use fearless_simd::{Simd, f32x16, prelude::*};
use glam::{IVec2, Vec2};
use umbrage_depth::DepthMap;
use umbrage_plane::TexelRect;
use umbrage_sample::Taps;

/// What a map stores under sixteen taps that lie within a rectangle. For explanations it is read one texel after another, with the same result,
/// and is compiled once for each map instead of into every filter.
#[inline(always)]
pub(crate) fn look<S: Simd, M: DepthMap, P: Probe>(simd: S, map: &M, within: TexelRect, taps: &Taps<S>) -> f32x16<S> {
    if P::EXPLAINS {
        f32x16::load_array(simd, one_by_one(map, taps.x.into(), taps.y.into()))
    } else {
        map.look(simd, within, taps.x, taps.y)
    }
}

#[inline(never)]
fn one_by_one(map: &impl DepthMap, x: [f32; 16], y: [f32; 16]) -> [f32; 16] {
    // Indices as a map's own look-up has them: saturated, so that none overflows.
    let index = |at: f32| at.clamp(-1_073_741_824.0, 1_073_741_824.0).floor() as i32;
    std::array::from_fn(|i| map.depth(IVec2::new(index(x[i]), index(y[i]))))
}

/// Reports sixteen taps to a probe: compared depths, stored ones, and results. `ruled` is the result for a place that the view's rules settle.
#[inline(never)]
pub(crate) fn report<S: Simd>(
    probe: &mut impl Probe,
    (ruled, weighted): (impl Fn(Vec2) -> Option<f32>, bool),
    taps: &Taps<S>,
    [compared, stored, dark]: [&[f32; 16]; 3],
) {
    for i in (0..16).filter(|i| taps.mask >> i & 1 == 1) {
        let at = taps.tap(i).at;
        let weight = if weighted { taps.weight[i] } else { 1.0 };
        let (stored, compared, dark) = (stored[i], compared[i], dark[i]);
        probe.tapped(&TapJudged { at, stored, compared, weight, ruled: ruled(at), dark });
    }
}
