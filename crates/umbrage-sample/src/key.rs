use fearless_simd::{Simd, f32x16, i32x16, prelude::*, u32x16};
use rand::SeedableRng;
use rand_xoshiro::Xoshiro256PlusPlus;
use umbrage_plane::mix32;

/// Names one stream of randomness: a region of one frame under one light.
///
/// The same key gives the same numbers for any thread count, storage and culling. Per-tap code takes numbers by
/// index ([`Key::bits`]); tables and scenes that are drawn once use the stream of [`Key::rng`].
#[derive(Clone, Copy, Debug, PartialEq, Eq, Default)]
pub struct Key {
    state: u32,
}

const GOLDEN: u32 = 0x9E37_79B9;
/// Dimensions kept apart per sample.
const DIMENSIONS: u32 = 8;
/// How far the numbers of sixteen consecutive samples lie from that of the first.
const LANES: [u32; 16] = {
    let mut lanes = [0; 16];
    let mut i = 0;
    while i < 16 {
        lanes[i] = (i as u32).wrapping_mul(DIMENSIONS).wrapping_mul(GOLDEN);
        i += 1;
    }
    lanes
};

impl Key {
    /// The key of a picture's light, before any region is named.
    pub const fn new(seed: u32, frame: u32, light: u32) -> Self {
        let state = mix32(seed ^ 0x5EED_0000);
        let state = mix32(state.wrapping_add(frame.wrapping_mul(GOLDEN)));
        Self { state: mix32(state.wrapping_add(light.wrapping_mul(0x85EB_CA6B))) }
    }

    /// The key of a region. Streams are places in one sequence of 2³² numbers: those of different regions start elsewhere,
    /// and of a million some thousand pairs overlap by a few samples.
    #[inline(always)]
    pub const fn region(self, region: u32) -> Self {
        Self { state: mix32(self.state ^ region.wrapping_mul(GOLDEN)) }
    }

    /// 32 random bits for one sample's dimension (`dim` in 0..8).
    #[inline(always)]
    pub const fn bits(self, sample: u32, dim: u32) -> u32 {
        mix32(self.state.wrapping_add(sample.wrapping_mul(DIMENSIONS).wrapping_add(dim).wrapping_mul(GOLDEN)))
    }

    /// Uniform in \[0, 1): the top 24 bits, exactly representable.
    #[inline(always)]
    pub fn unit(self, sample: u32, dim: u32) -> f32 {
        (self.bits(sample, dim) >> 8) as f32 * (1.0 / 16_777_216.0)
    }

    /// Uniform in \[−1, 1).
    #[inline(always)]
    pub fn signed(self, sample: u32, dim: u32) -> f32 {
        self.unit(sample, dim) * 2.0 - 1.0
    }

    /// [`Key::unit`] of sixteen consecutive samples, bit for bit.
    #[inline(always)]
    pub fn unit_lanes<S: Simd>(self, simd: S, first: u32, dim: u32) -> f32x16<S> {
        let start = self.state.wrapping_add(first.wrapping_mul(DIMENSIONS).wrapping_add(dim).wrapping_mul(GOLDEN));
        let mut bits: u32x16<S> = u32x16::load_array(simd, LANES) + start;
        bits ^= bits >> 16;
        bits *= 0x7FEB_352D;
        bits ^= bits >> 15;
        bits *= 0x846C_A68B;
        bits ^= bits >> 16;
        unit(bits)
    }

    /// A stream for what is drawn once: tables, scenes, camera sets.
    pub fn rng(self) -> Xoshiro256PlusPlus {
        Xoshiro256PlusPlus::seed_from_u64(u64::from(self.state))
    }
}

/// [`Key::unit`] of sixteen times 32 bits.
#[inline(always)]
pub(crate) fn unit<S: Simd>(bits: u32x16<S>) -> f32x16<S> {
    // As signed numbers, which these 24 bits are as well: AVX2 converts no others.
    (bits >> 8).bitcast::<i32x16<S>>().to_float::<f32x16<S>>() * (1.0 / 16_777_216.0)
}

/// Where the random numbers of sixteen taps come from.
pub(crate) trait Draws: Copy {
    /// Uniform in \[0, 1): those of the taps from `first` on, for a dimension.
    fn lanes<S: Simd>(self, simd: S, first: u32, dim: u32) -> f32x16<S>;
}

impl Draws for Key {
    #[inline(always)]
    fn lanes<S: Simd>(self, simd: S, first: u32, dim: u32) -> f32x16<S> {
        self.unit_lanes(simd, first, dim)
    }
}
