use crate::{Biased, Filter, Met, Probe, Query};
use fearless_simd::Simd;
use umbrage_depth::DepthMap;
use umbrage_plane::Bias;
use umbrage_sample::{EveryTexel, Pattern};

/// The control of Reeves' Figure 2a: filter the depths, then compare once. The result is 0 or 1, and near an edge it is meaningless.
///
/// A region that holds a texel without a surface has a mean of +∞ and is lit; one whose point lies outside the map or the cone is
/// settled by the view's rules. Over a deep map the mean is weighted by the fraction of light that each surface stops, and the result is 0 or the fraction
/// that all of them stop together.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub struct FilteredDepth<P = EveryTexel> {
    /// Where to look.
    pub pattern: P,
    /// Moves the receiver toward the light.
    pub bias: Bias,
    /// Multiplies the region's size.
    pub res_factor: f32,
}

impl Default for FilteredDepth {
    /// Every texel of the region as it is, no bias.
    fn default() -> Self {
        Self { pattern: EveryTexel, bias: Bias::ZERO, res_factor: 1.0 }
    }
}

umbrage_plane::builders!([P] FilteredDepth<P> { with_bias bias: Bias, with_res_factor res_factor: f32 });

impl<P> FilteredDepth<P> {
    /// The same with another pattern.
    #[must_use]
    pub fn with_pattern<Q: Pattern>(self, pattern: Q) -> FilteredDepth<Q> {
        let Self { bias, res_factor, .. } = self;
        FilteredDepth { pattern, bias, res_factor }
    }
}

impl<P: Pattern> Filter for FilteredDepth<P> {
    #[inline(always)]
    fn shadow<S: Simd, M: DepthMap, Q: Probe>(&self, query: &mut Query<'_, S, M, Q>) -> f32 {
        if let Some(dark) = query.placed(query.receiver().texel.as_vec2()) {
            return dark;
        }
        let region = query.region(self.res_factor, 0.0);
        let own = Biased::constant(self.bias);
        let compared = query.receiver().nearer(query.view(), self.bias);
        let (mut sum, mut stopped, mut weight) = (0.0f64, 0.0f64, 0.0f64);
        query.each(
            &region,
            &self.pattern,
            &own,
            #[inline(always)]
            |seen| {
                let tap = f64::from(seen.tap.weight);
                weight += tap;
                let mut any = false;
                if let Met::Surfaces(surfaces) = &seen.met {
                    for (depth, stops) in surfaces.iter() {
                        any = true;
                        sum += f64::from(depth) * (tap * f64::from(stops));
                        stopped += tap * f64::from(stops);
                    }
                }
                if !any {
                    sum += f64::INFINITY * tap;
                }
            },
        );
        let mean = sum / stopped;
        if f64::from(compared) > mean { (stopped / weight) as f32 } else { 0.0 }
    }

    #[inline(always)]
    fn asks_tilt<M: DepthMap>(&self, _: &M) -> bool {
        self.bias.asks_tilt()
    }
}
