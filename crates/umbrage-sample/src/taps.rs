use crate::Key;
use fearless_simd::{Simd, f32x16, prelude::*};
use glam::{IVec2, Vec2};
use umbrage_plane::{Footprint, TexelRect, vectorized};

/// Up to sixteen sample positions of one region.
#[derive(Clone, Copy, Debug)]
pub struct Taps<S: Simd> {
    /// Columns, in texel space.
    pub x: f32x16<S>,
    /// Rows, in texel space.
    pub y: f32x16<S>,
    /// One uniform number in \[0, 1) for each tap, for what the receiver's depth draws (a bias).
    pub u: f32x16<S>,
    /// Bit i set: tap i takes part; bits 16 and up are 0. The others hold positions that may be read but do not count.
    pub mask: u32,
    /// Index of the first tap within its region.
    pub first: u32,
    /// Weight of each tap, ≥ 0; 1 for patterns that are not [weighted](Pattern::weighted).
    pub weight: f32x16<S>,
}

impl<S: Simd> Taps<S> {
    /// Unweighted taps at the centres of up to sixteen texels of a row, from `texel` to the right: those of a [window](Pattern::window). `first` is the
    /// index of the first of them within the region.
    #[inline(always)]
    pub fn in_row(simd: S, key: Key, first: u32, texel: IVec2, count: u32) -> Self {
        let mask = u32::from(u16::MAX) >> (16 - count.min(16));
        let y = f32x16::splat(simd, texel.y as f32 + 0.5);
        let [u, weight] = [key.unit_lanes(simd, first, 2), f32x16::splat(simd, 1.0)];
        Self { x: indices(simd, 0) + (texel.x as f32 + 0.5), y, u, mask, first, weight }
    }

    /// One of the taps, 0 to 15.
    #[inline(always)]
    pub fn tap(&self, i: usize) -> Tap {
        Tap { at: Vec2::new(self.x[i], self.y[i]), u: self.u[i], weight: self.weight[i] }
    }
}

/// The indices of sixteen consecutive taps, as floats. Exact below 2²⁴.
#[inline(always)]
pub(crate) fn indices<S: Simd>(simd: S, first: u32) -> f32x16<S> {
    const FIRST: [f32; 16] = [0.0, 1.0, 2.0, 3.0, 4.0, 5.0, 6.0, 7.0, 8.0, 9.0, 10.0, 11.0, 12.0, 13.0, 14.0, 15.0];
    f32x16::load_array(simd, FIRST) + first as f32
}

/// Where to look within a region of a map (Reeves 1987, §2, Fig. 3).
///
/// Every tap that takes part lies inside the closed box `[centre − half, centre + half]` of the region, as computed
/// in f32. A tap of index k draws its numbers from the key's sample k: dimension 0 the position in x, 1 the position in y,
/// 2 the number `u`; 3 to 7 are free for patterns that need more. So each tap has its own fixed numbers, in
/// whatever order taps are worked on.
///
/// A region whose centre or extent is not finite gets taps at unspecified positions; nothing panics.
pub trait Pattern: Send + Sync {
    /// True when taps carry weights that are not all equal. The same for all regions.
    #[inline(always)]
    fn weighted(&self) -> bool {
        false
    }

    /// The texels of `region` where its taps are the centres of a rectangle's texels, each once and row by row, so that whole rows can be read; `None`
    /// where they are not.
    #[inline(always)]
    fn window(&self, region: &Footprint) -> Option<TexelRect> {
        let _ = region;
        None
    }

    /// Calls `each` with every batch of taps of `region`, in a fixed order; at least one tap in all.
    ///
    /// A batch may come with an empty mask, where all of its positions were rejected. Implementations mention `each` once:
    /// a closure that is called from two places is not inlined, and then not compiled for the machine's own instructions.
    fn taps<S: Simd>(&self, simd: S, region: &Footprint, key: Key, each: impl FnMut(&Taps<S>));
}

/// One tap, for callers that work one at a time.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Tap {
    /// Position, in texel space.
    pub at: Vec2,
    /// Uniform in \[0, 1), as [`Taps::u`].
    pub u: f32,
    /// Weight, ≥ 0; 1 for patterns without weights.
    pub weight: f32,
}

/// Calls `each` with every tap of a region, in order; at least once. The base of filters over things that are not depths (Reeves 1987).
///
/// The taps are those of [`Pattern::taps`], bit for bit, whatever instructions the machine has.
pub fn each_tap(pattern: &impl Pattern, region: &Footprint, key: Key, each: impl FnMut(&Tap)) {
    vectorized!(simd => one_by_one(simd, pattern, region, key, each));
}

#[inline(always)]
fn one_by_one<S: Simd, P: Pattern>(simd: S, pattern: &P, region: &Footprint, key: Key, mut each: impl FnMut(&Tap)) {
    pattern.taps(
        simd,
        region,
        key,
        #[inline(always)]
        |taps| {
            for i in (0..16).filter(|i| taps.mask >> i & 1 == 1) {
                each(&taps.tap(i));
            }
        },
    );
}
