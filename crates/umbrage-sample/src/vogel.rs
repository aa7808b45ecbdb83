use crate::{
    Key, Pattern, Taps,
    disc::turned,
    grid::{Area, batches},
    taps::indices,
};
use fearless_simd::{Simd, f32x16, prelude::*};
use umbrage_plane::Footprint;

/// The golden angle, π(3 − √5), in turns.
pub(crate) const GOLDEN: f32 = 0.381_966;

/// Bilinear comparisons on Vogel's disc: sample k of n has the radius √((k + ½)/n) and the angle k·π(3 − √5), and each is the four texels around it, weighted by
/// nearness. The disc is inscribed in the region less a texel on each side, so that a region of a half-extent of r + 1 has a disc of radius r.
///
/// This is `PCFShadowMap` of three.js (r187, `shadowmap_pars_fragment.glsl.js`: 5 samples, radius 1) and Godot's soft filter
/// (`get_vogel_disk` in `renderer_scene_render_rd.cpp`, `sample_directional_pcf_shadow` and `sample_pcf_shadow` in
/// `scene_forward_lights_inc.glsl`: 4 samples, radius 2 by default). Two departures: both engines turn the disc by interleaved gradient noise of the pixel's place, this
/// by the key of its region, which is as even but knows no neighbours; and Godot rounds the golden angle to 2.4, 0.0001 of a texel at its fourth sample.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub struct Vogel {
    /// Samples a region, each of four taps; 0 counts as 1, and no more than 2²⁸ are taken.
    pub num_samples: u32,
    /// Whether each region turns the disc by an angle of its own.
    pub rotate: bool,
}

impl Default for Vogel {
    /// Five, turned.
    fn default() -> Self {
        Self { num_samples: 5, rotate: true }
    }
}

umbrage_plane::builders!([] Vogel { with_num_samples num_samples: u32, with_rotate rotate: bool });

impl Pattern for Vogel {
    #[inline(always)]
    fn weighted(&self) -> bool {
        true
    }

    #[inline(always)]
    fn taps<S: Simd>(&self, simd: S, region: &Footprint, key: Key, mut each: impl FnMut(&Taps<S>)) {
        let area = Area::of(region);
        let n = self.num_samples.clamp(1, 1 << 28);
        let start = if self.rotate { key.unit(0, 0) } else { 0.0 };
        let reach = (region.half - 1.0).max(glam::Vec2::ZERO);
        for batch in batches(n * 4) {
            let index = indices(simd, batch.0);
            let sample = (index * 0.25).floor();
            let corner = index - sample * 4.0;
            let (cos, sin) = turned(simd, sample * GOLDEN + start);
            let radius = ((sample + 0.5) / n as f32).sqrt();
            let below = (corner * 0.5).floor();
            let right = corner - below * 2.0;
            // The texel's centre to the left of the sample or to its right, above it or below, and its weight.
            let texel = |at: f32x16<S>, beyond: f32x16<S>| {
                let first = (at - 0.5).floor();
                let share = at - 0.5 - first;
                (first + beyond + 0.5, beyond * share + (-beyond + 1.0) * (-share + 1.0))
            };
            let (x, across) = texel(radius * cos * reach.x + region.centre.x, right);
            let (y, down) = texel(radius * sin * reach.y + region.centre.y, below);
            each(&Taps { weight: across * down, ..area.taps(simd, key, batch, (x, y)) });
        }
    }
}
