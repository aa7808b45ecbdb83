use crate::{
    Key, Pattern, Taps,
    grid::{Area, batches},
};
use fearless_simd::{Simd, f32x16};
use umbrage_plane::Footprint;

/// Independent positions under a normal law cut off at the bounding box (Reeves 1987, Fig. 3b): denser toward the centre.
///
/// The standard deviation is half of the half-extent on each axis, so that the box is ±2σ. The paper leaves the
/// deviation open. Drawing again whatever falls outside would take a varying number of draws (0.911 of them
/// stay inside); the same law is reached here by inverting its distribution, with one draw per axis.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub struct Gaussian {
    /// Taps a region; 0 counts as 1.
    pub num_samples: u32,
}

impl Default for Gaussian {
    fn default() -> Self {
        Self { num_samples: 16 }
    }
}

umbrage_plane::builders!([] Gaussian { with_num_samples num_samples: u32 });

impl Pattern for Gaussian {
    #[inline(always)]
    fn taps<S: Simd>(&self, simd: S, region: &Footprint, key: Key, mut each: impl FnMut(&Taps<S>)) {
        let area = Area::of(region);
        let sigma = region.half * 0.5;
        for batch in batches(self.num_samples.max(1)) {
            let x = deviate(key.unit_lanes(simd, batch.0, 0)) * sigma.x + region.centre.x;
            let y = deviate(key.unit_lanes(simd, batch.0, 1)) * sigma.y + region.centre.y;
            each(&area.taps(simd, key, batch, (x, y)));
        }
    }
}

/// The normal law cut off at ±2, at `unit` of its distribution: √2·erf⁻¹(erf(√2)·(2·unit − 1)).
///
/// A rational fit of relative error below 5e-6 (rounding: 2e-5), because it needs nothing but operations that every machine rounds alike.
#[inline(always)]
fn deviate<S: Simd>(unit: f32x16<S>) -> f32x16<S> {
    let v = unit * 2.0 - 1.0;
    let t = v * v;
    let above = ((t * -0.085_932_486 + 0.886_458) * t - 1.944_997_5) * t + 1.196_290_9;
    let below = ((t * -0.175_305_12 + 1.065_494_3) * t - 1.864_279_6) * t + 1.0;
    v * (above / below)
}
