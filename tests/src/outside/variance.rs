use umbrage_depth::DepthMap;
use umbrage_sample::Jittered;
use umbrage_shadow::{Biased, Filter, Met, Probe, Query, Simd};

/// Variance shadows (Donnelly & Lauritzen 2006) with the moments gathered tap by tap: at most the fraction of the region that Chebyshev's
/// inequality allows is lit.
#[derive(Clone, Copy, Debug)]
pub struct Variance {
    /// Where moments are gathered.
    pub pattern: Jittered,
    /// Which depth is compared.
    pub depth: Biased,
}

impl Default for Variance {
    /// A bias that is the same at every tap: one that varies is variance too.
    fn default() -> Self {
        Self { pattern: Jittered::default(), depth: Biased::world(0.3, 0.3) }
    }
}

impl Filter for Variance {
    #[inline(always)]
    fn shadow<S: Simd, M: DepthMap, P: Probe>(&self, query: &mut Query<'_, S, M, P>) -> f32 {
        let (mut taps, mut settled) = (0.0, 0.0);
        // Of how far the receiver lies behind each surface: the sum of weights, of distances and of their squares.
        let (mut stopped, mut first, mut second) = (0.0, 0.0, 0.0);
        query.each(&query.region(2.0, 1.0), &self.pattern, &self.depth, |seen| {
            let weight = f64::from(seen.tap.weight);
            taps += weight;
            match &seen.met {
                Met::Settled(dark) => settled += weight * f64::from(*dark),
                Met::Surfaces(surfaces) => {
                    // What one texel holds is known exactly: only texels among themselves vary.
                    let here = surfaces.iter().fold((0.0, 0.0), |(stopped, sum), (depth, stops)| {
                        (stopped + stops, sum + stops * (seen.compared - depth))
                    });
                    if here.0 > 0.0 {
                        let (behind, weight) = (f64::from(here.1 / here.0), weight * f64::from(here.0));
                        stopped += weight;
                        first += weight * behind;
                        second += weight * behind * behind;
                    }
                }
            }
        });
        let mean = first / stopped;
        let variance = (second / stopped - mean * mean).max(0.0);
        let lit = if mean > 0.0 { variance / (variance + mean * mean) } else { 1.0 };
        (((settled + stopped * (1.0 - lit)) / taps) as f32).clamp(0.0, 1.0)
    }
}
