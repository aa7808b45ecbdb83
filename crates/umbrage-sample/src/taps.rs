use crate::Key;
use fearless_simd::{Simd, f32x16};
use umbrage_plane::Footprint;

/// Up to sixteen sample positions of one region.
pub struct Taps<S: Simd> {
    /// Columns, in texel space.
    pub x: f32x16<S>,
    /// Rows, in texel space.
    pub y: f32x16<S>,
    /// One uniform number in \[0, 1) a tap, for what the receiver's depth draws (a bias).
    pub u: f32x16<S>,
    /// Bit i set: tap i takes part. The others hold positions that may be read but do not count.
    pub mask: u32,
    /// Index of the first tap within its region.
    pub first: u32,
    /// Weight of each tap; only read of patterns with [`Pattern::WEIGHTED`].
    pub weight: f32x16<S>,
}

/// Where to look within a region of a map (Reeves 1987, §2, Fig. 3).
///
/// Every tap lies inside `[centre − half, centre + half]` of the region. Key dimensions: 0 the jitter in x, 1 the
/// jitter in y, 2 the number `u`; a pattern that redraws uses 3..8.
pub trait Pattern: Sync {
    /// True when taps carry weights that are not all equal.
    const WEIGHTED: bool = false;

    /// Calls `each` with every batch of taps of `region`, in a fixed order; at least one tap in all.
    fn taps<S: Simd>(&self, simd: S, region: &Footprint, key: Key, each: impl FnMut(&Taps<S>));
}
