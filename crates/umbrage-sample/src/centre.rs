use crate::{Key, Pattern, Taps, grid::Area};
use fearless_simd::{Simd, f32x16, prelude::*};
use umbrage_plane::Footprint;

/// One tap at the region's centre: the ordinary shadow map look-up (Reeves 1987).
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Centre;

impl Pattern for Centre {
    #[inline(always)]
    fn taps<S: Simd>(&self, simd: S, region: &Footprint, key: Key, mut each: impl FnMut(&Taps<S>)) {
        let at = (f32x16::splat(simd, region.centre.x), f32x16::splat(simd, region.centre.y));
        each(&Area::of(region).taps(simd, key, (0, 1), at));
    }
}
