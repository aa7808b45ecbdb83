use crate::{Biased, Filter, Probe, Query, ReceiverDepth};
use fearless_simd::Simd;
use umbrage_depth::DepthMap;
use umbrage_sample::{Jittered, Pattern};

/// Percentage-closer filtering (Reeves, Salesin & Cook 1987, §2, §3.2 and Fig. 4).
///
/// Each texel under the region becomes "nearer or not", and those results are averaged.
///
/// Departures from the printed listing, by the errata of [`as_printed`](crate::as_printed): (1) both half-extents get their minimum;
/// (2) sample counts are clamped in an order that cannot divide by zero; (3) jitter spans whole cells;
/// (4) positions are floored; (5) samples outside the map or the cone are settled by the view's rules;
/// (6) the cull uses depth ranges and never changes a result.
///
/// ```
/// use umbrage_sample::Disc;
/// use umbrage_shadow::{BiasCone, Pcf};
///
/// let wide = Pcf::default().with_pattern(Disc::default()).with_depth(BiasCone::default()).with_min_size(2.0);
/// assert_eq!(wide.res_factor, 3.0);
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub struct Pcf<P = Jittered, D = Biased> {
    /// Where to look.
    pub pattern: P,
    /// Which depth to compare.
    pub depth: D,
    /// Multiplies the region's size: softness. Reeves advises 2 to 4; below 1 the map's own aliases appear.
    pub res_factor: f32,
    /// Least half-extent of the region after `res_factor`, in texels.
    pub min_size: f32,
    /// Whether depth ranges may settle a region without a look-up. Changes no result.
    pub cull: bool,
}

impl Default for Pcf {
    /// The printed listing's values.
    fn default() -> Self {
        Self { pattern: Jittered::default(), depth: Biased::default(), res_factor: 3.0, min_size: 0.0, cull: true }
    }
}

umbrage_plane::builders!([P, D] Pcf<P, D> { with_res_factor res_factor: f32, with_min_size min_size: f32, with_cull cull: bool });

impl<P, D> Pcf<P, D> {
    /// The same with another pattern.
    #[must_use]
    pub fn with_pattern<Q: Pattern>(self, pattern: Q) -> Pcf<Q, D> {
        let Self { depth, res_factor, min_size, cull, .. } = self;
        Pcf { pattern, depth, res_factor, min_size, cull }
    }

    /// The same with another compared depth.
    #[must_use]
    pub fn with_depth<E: ReceiverDepth>(self, depth: E) -> Pcf<P, E> {
        let Self { pattern, res_factor, min_size, cull, .. } = self;
        Pcf { pattern, depth, res_factor, min_size, cull }
    }
}

impl<P: Pattern, D: ReceiverDepth> Filter for Pcf<P, D> {
    #[inline(always)]
    fn shadow<S: Simd, M: DepthMap, Q: Probe>(&self, query: &mut Query<'_, S, M, Q>) -> f32 {
        let region = query.region(self.res_factor, self.min_size);
        query.settled_or_share(&region, &self.pattern, &self.depth, self.cull)
    }

    #[inline(always)]
    fn asks_tilt<M: DepthMap>(&self, _: &M) -> bool {
        self.depth.asks_tilt()
    }
}
