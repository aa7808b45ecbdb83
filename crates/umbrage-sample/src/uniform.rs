use crate::{
    Key, Pattern, Taps,
    grid::{Area, batches},
};
use fearless_simd::Simd;
use umbrage_plane::Footprint;

/// Independent positions, uniform in the bounding box (Reeves 1987, Fig. 3a). *Luxo Jr.* was made with it.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub struct Uniform {
    /// Taps a region; 0 counts as 1.
    pub num_samples: u32,
}

impl Default for Uniform {
    fn default() -> Self {
        Self { num_samples: 16 }
    }
}

umbrage_plane::builders!([] Uniform { with_num_samples num_samples: u32 });

impl Pattern for Uniform {
    #[inline(always)]
    fn taps<S: Simd>(&self, simd: S, region: &Footprint, key: Key, mut each: impl FnMut(&Taps<S>)) {
        let area = Area::of(region);
        let size = area.high - area.low;
        for batch in batches(self.num_samples.max(1)) {
            let x = key.unit_lanes(simd, batch.0, 0) * size.x + area.low.x;
            let y = key.unit_lanes(simd, batch.0, 1) * size.y + area.low.y;
            each(&area.taps(simd, key, batch, (x, y)));
        }
    }
}
