use fearless_simd::{Simd, SimdFloat, f32x16, i32x16, prelude::*};

/// The texel indices of sixteen texel coordinates: rounded toward −∞, saturated at ±2³⁰.
///
/// This is the only float-to-index conversion on the sampling path. NaN lanes give an unspecified index, which
/// every map answers (maps are total).
#[inline(always)]
pub fn floor_texel<S: Simd>(simd: S, x: f32x16<S>) -> i32x16<S> {
    const FAR: f32 = 1_073_741_824.0;
    let clamped = x.max(f32x16::splat(simd, -FAR)).min(f32x16::splat(simd, FAR));
    clamped.floor().to_int()
}
