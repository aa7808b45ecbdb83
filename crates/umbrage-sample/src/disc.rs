use crate::{
    Key, Pattern, Taps,
    grid::{Area, batches},
    taps::indices,
};
use fearless_simd::{Simd, f32x16, prelude::*};
use glam::Vec2;
use umbrage_plane::Footprint;

/// How densely a [`Disc`] is covered (Burley 2006).
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Density {
    /// The same everywhere: radius √y. Burley's pattern for blurring.
    #[default]
    Uniform,
    /// Falling as 1/r from the centre: radius y. Burley's pattern for the occluder search.
    Centred,
}

/// The Hammersley set on the ellipse inscribed in the bounding box: a disc where the box is square (Burley 2006).
///
/// Point i of n has angle 2π·i/n, counted from +x toward +y, and a radius made from the radical inverse of i.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub struct Disc {
    /// Taps a region; 0 counts as 1. Powers of two are spread best.
    pub num_samples: u32,
    /// Where they are dense.
    pub density: Density,
    /// Whether each region turns the set by an angle of its own: noise instead of the same bands everywhere.
    pub rotate: bool,
    /// Whether radii are made from y + ½/n, so that no tap is at the centre and their mean is unbiased.
    pub half_offset: bool,
}

impl Default for Disc {
    fn default() -> Self {
        Self { num_samples: 32, density: Density::Uniform, rotate: true, half_offset: false }
    }
}

umbrage_plane::builders!([] Disc {
    with_num_samples num_samples: u32,
    with_density density: Density,
    with_rotate rotate: bool,
    with_half_offset half_offset: bool,
});

/// Base-2 radical inverse: the bits of `index` mirrored about the binary point, in \[0, 1). The last 8 bits of 32 are dropped.
#[inline(always)]
pub const fn radical_inverse(index: u32) -> f32 {
    (index.reverse_bits() >> 8) as f32 * (1.0 / 16_777_216.0)
}

/// Point `index` of the two-dimensional Hammersley set of `count` points: (index/count, radical inverse of index), in \[0, 1)²
/// for `index < count` (Burley 2006).
#[inline(always)]
pub fn hammersley(index: u32, count: u32) -> Vec2 {
    Vec2::new(index as f32 / count as f32, radical_inverse(index))
}

/// [`radical_inverse`] of sixteen consecutive numbers.
#[inline(always)]
pub fn radical_inverses<S: Simd>(simd: S, first: u32) -> f32x16<S> {
    let mut inverses = [0.0; 16];
    for (inverse, index) in inverses.iter_mut().zip(first..) {
        *inverse = radical_inverse(index);
    }
    f32x16::load_array(simd, inverses)
}

impl Pattern for Disc {
    #[inline(always)]
    fn taps<S: Simd>(&self, simd: S, region: &Footprint, key: Key, mut each: impl FnMut(&Taps<S>)) {
        let area = Area::of(region);
        let n = self.num_samples.max(1);
        let start = if self.rotate { key.unit(0, 0) } else { 0.0 };
        let lift = if self.half_offset { 0.5 / n as f32 } else { 0.0 };
        for batch in batches(n) {
            let (cos, sin) = turned(simd, indices(simd, batch.0) / n as f32 + start);
            let y = radical_inverses(simd, batch.0) + lift;
            let radius = match self.density {
                Density::Uniform => y.sqrt(),
                Density::Centred => y,
            };
            let x = radius * cos * region.half.x + region.centre.x;
            let y = radius * sin * region.half.y + region.centre.y;
            each(&area.taps(simd, key, batch, (x, y)));
        }
    }
}

/// Cosine and sine of `turns` full turns, `turns` ≥ 0, to 2e-7. Quarter turns are exact.
///
/// Taylor's polynomials about the nearest quarter turn, because they need nothing but operations that every machine rounds alike.
#[inline(always)]
pub(crate) fn turned<S: Simd>(simd: S, turns: f32x16<S>) -> (f32x16<S>, f32x16<S>) {
    let quarters = (turns * 4.0 + 0.5).floor();
    let angle = (turns - quarters * 0.25) * std::f32::consts::TAU;
    let quarter = quarters - (quarters * 0.25).floor() * 4.0;
    let t = angle * angle;
    let sin = (((t * (1.0 / 362_880.0) - 1.0 / 5_040.0) * t + 1.0 / 120.0) * t - 1.0 / 6.0) * t * angle + angle;
    let cos = (((t * (1.0 / 40_320.0) - 1.0 / 720.0) * t + 1.0 / 24.0) * t - 0.5) * t + 1.0;
    let is = |k: f32| quarter.simd_eq(f32x16::splat(simd, k));
    let odd = is(1.0) | is(3.0);
    let (swapped_cos, swapped_sin) = (odd.select(sin, cos), odd.select(cos, sin));
    let left = is(1.0) | is(2.0);
    let down = is(2.0) | is(3.0);
    (left.select(-swapped_cos, swapped_cos), down.select(-swapped_sin, swapped_sin))
}
