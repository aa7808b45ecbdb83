//! Comparing whole units of depth before fractions (Woo 1992).

use crate::{Biased, Filter, Probe, Query};
use fearless_simd::Simd;
use umbrage_depth::DepthMap;
use umbrage_plane::Bias;
use umbrage_sample::{Jittered, Pattern};

/// Whole units of a depth: what Woo compares first (Woo 1992). Rounded down and saturated, so that it never decreases; NaN is 0.
#[inline(always)]
pub fn whole(depth: f32, unit: f32) -> i32 {
    (depth / unit).floor() as i32
}

/// Whether `receiver` lies behind `stored`, by whole units where these differ; the second says whether they did (Woo 1992).
///
/// The same as `receiver > stored` for all depths, ∞ included, because rounding down keeps order. NaN is never behind.
#[inline(always)]
pub fn behind(receiver: f32, stored: f32, unit: f32) -> (bool, bool) {
    let (near, far) = (whole(stored, unit), whole(receiver, unit));
    if near == far || receiver.is_nan() || stored.is_nan() { (receiver > stored, false) } else { (far > near, true) }
}

/// Percentage-closer filtering without bias, comparing whole units before fractions: Woo's economy of floating-point work
/// (Woo 1992). Meant for midpoint maps.
///
/// The result is that of [`Pcf`](crate::Pcf) with a bias of 0, bit for bit; a [`Probe`] counts how often whole units settled it. On today's machines it
/// saves nothing. Over deep maps it uses the light that passes, and counts no comparison.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub struct IntegerFirst<P = Jittered> {
    /// Where to look.
    pub pattern: P,
    /// Multiplies the region's size.
    pub res_factor: f32,
    /// Least half-extent of the region after that, in texels.
    pub min_size: f32,
    /// The size of a whole unit, in the map's units; above 0.
    pub unit: f32,
}

impl Default for IntegerFirst {
    /// One world unit; the rest as [`Pcf`](crate::Pcf).
    fn default() -> Self {
        Self { pattern: Jittered::default(), res_factor: 3.0, min_size: 0.0, unit: 1.0 }
    }
}

umbrage_plane::builders!([P] IntegerFirst<P> { with_res_factor res_factor: f32, with_min_size min_size: f32, with_unit unit: f32 });

impl<P> IntegerFirst<P> {
    /// The same with another pattern.
    #[must_use]
    pub fn with_pattern<Q: Pattern>(self, pattern: Q) -> IntegerFirst<Q> {
        let Self { res_factor, min_size, unit, .. } = self;
        IntegerFirst { pattern, res_factor, min_size, unit }
    }
}

impl<P: Pattern> Filter for IntegerFirst<P> {
    #[inline(always)]
    fn shadow<S: Simd, M: DepthMap, Q: Probe>(&self, query: &mut Query<'_, S, M, Q>) -> f32 {
        let region = query.region(self.res_factor, self.min_size);
        let own = Biased::constant(Bias::ZERO);
        query.share_by(
            &region,
            &self.pattern,
            &own,
            #[inline(always)]
            |probe, compared, stored, mask| {
                let mut nearer = 0;
                for i in (0..16).filter(|i| mask >> i & 1 == 1) {
                    let (dark, conclusive) = behind(compared[i], stored[i], self.unit);
                    probe.compared(conclusive);
                    nearer |= u32::from(dark) << i;
                }
                nearer
            },
        )
    }

    #[inline(always)]
    fn asks_tilt<M: DepthMap>(&self, _: &M) -> bool {
        false
    }
}
