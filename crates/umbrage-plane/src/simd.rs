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

/// Whole numbers below 2³¹ in size, as integers. This takes fewer instructions than a conversion that is defined for all numbers: any other number, and NaN,
/// gives an unspecified integer.
///
/// ```
/// assert_eq!(umbrage_plane::integers([0.0, -1.0, 16_777_217.0, -2_147_483_647.0]), [0, -1, 16_777_217, -i32::MAX]);
/// ```
#[inline(always)]
pub fn integers<const N: usize>(numbers: [f64; N]) -> [i32; N] {
    // From 2⁵² to 2⁵³ the last bits of a double are those of an integer; the middle of that is a multiple of 2³².
    const MIDDLE: f64 = 1.5 * (1_u64 << 52) as f64;
    let mut integers = [0; N];
    for (integer, number) in integers.iter_mut().zip(numbers) {
        *integer = (number + MIDDLE).to_bits() as i32;
    }
    integers
}

/// Runs an expression compiled for the machine's instructions, with a [`Simd`] token that names them: AVX2 on an x86 processor that
/// has it, otherwise what the target always has.
///
/// ```
/// use umbrage_plane::{floor_texel, vectorized};
/// use fearless_simd::{SimdBase, f32x16};
///
/// let first = vectorized!(simd => floor_texel(simd, f32x16::splat(simd, 2.5))[0]);
/// assert_eq!(first, 2);
/// ```
///
/// Two instruction sets, not all that there are, because every filter is compiled once for each. Vectors of AVX-512 would add nothing: on a
/// processor that has them look-ups take as long with either, and bakes of refined maps up to 1.4 times as long with AVX-512. SSE4.2 alone is a
/// processor of before 2013. A program that is compiled for AVX2 in the first place (`-C target-cpu=x86-64-v3`) has only that set,
/// and compiles in two thirds of the time.
#[macro_export]
macro_rules! vectorized {
    ($simd:pat => $body:expr) => {{
        #[cfg(any(target_arch = "x86", target_arch = "x86_64"))]
        let answer = match $crate::fearless_simd::Level::new().as_avx2() {
            Some(token) => $crate::vectorized!(@with token, $simd => $body),
            #[cfg(not(target_feature = "avx2"))]
            None => $crate::vectorized!(@baseline $simd => $body),
            #[cfg(target_feature = "avx2")]
            None => unreachable!("the program was compiled for processors that have AVX2"),
        };
        #[cfg(not(any(target_arch = "x86", target_arch = "x86_64")))]
        let answer = $crate::fearless_simd::dispatch!($crate::fearless_simd::Level::new(), $simd => $body);
        answer
    }};
    (@with $token:ident, $simd:pat => $body:expr) => {
        $crate::fearless_simd::Simd::vectorize(
            $token,
            #[inline(always)]
            || {
                let $simd = $token;
                $body
            },
        )
    };
    (@baseline $simd:pat => $body:expr) => {{
        let token = $crate::fearless_simd::Level::baseline().as_sse2().expect("every x86 target that this crate runs on has SSE2");
        $crate::vectorized!(@with token, $simd => $body)
    }};
}
