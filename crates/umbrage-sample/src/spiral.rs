use crate::vogel::GOLDEN;
use crate::{
    Density, Key, Pattern, Taps,
    disc::turned,
    grid::{Area, batches},
    taps::indices,
};
use fearless_simd::{Simd, f32x16, prelude::*};
use umbrage_plane::Footprint;

/// One tap at each point of a Fibonacci spiral on the disc that is inscribed in the region: point k of n has the angle k·π(3 − √5) and the radius
/// √((k + ½)/n), or k/n where it is [`Density::Centred`], with the first at the centre.
///
/// This is where Unity's HDRP searches for blockers (`HDPCSS.hlsl`: `ComputeFibonacciSpiralDiskSample` for lamps, `…Clumped_Directional` with the default
/// exponent for directional lights). [`Vogel`](crate::Vogel) has bilinear comparisons at the even points.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub struct Spiral {
    /// Taps a region; 0 counts as 1.
    pub num_samples: u32,
    /// Where they are dense.
    pub density: Density,
    /// Whether each region turns the spiral by an angle of its own.
    pub rotate: bool,
}

impl Default for Spiral {
    /// Twenty-four, evenly spread and turned.
    fn default() -> Self {
        Self { num_samples: 24, density: Density::Uniform, rotate: true }
    }
}

umbrage_plane::builders!([] Spiral { with_num_samples num_samples: u32, with_density density: Density, with_rotate rotate: bool });

impl Spiral {
    /// The radius of a point, as a fraction of the disc's.
    #[inline(always)]
    pub fn share(density: Density, index: u32, count: u32) -> f32 {
        match density {
            Density::Uniform => ((index as f32 + 0.5) / count as f32).sqrt(),
            Density::Centred => index as f32 / count as f32,
        }
    }
}

impl Pattern for Spiral {
    #[inline(always)]
    fn taps<S: Simd>(&self, simd: S, region: &Footprint, key: Key, mut each: impl FnMut(&Taps<S>)) {
        let area = Area::of(region);
        let n = self.num_samples.max(1);
        let start = if self.rotate { key.unit(0, 0) } else { 0.0 };
        for batch in batches(n) {
            let (cos, sin) = turned(simd, indices(simd, batch.0) * GOLDEN + start);
            let mut shares = [0.0; 16];
            for (share, index) in shares.iter_mut().zip(batch.0..) {
                *share = Self::share(self.density, index, n);
            }
            let radius = f32x16::load_array(simd, shares);
            let x = radius * cos * region.half.x + region.centre.x;
            let y = radius * sin * region.half.y + region.centre.y;
            each(&area.taps(simd, key, batch, (x, y)));
        }
    }
}
