use crate::Raw;
use umbrage_plane::Kind;

/// Fewest and most bits of an integer depth (Williams 1978).
const BITS: std::ops::RangeInclusive<u32> = 8..=24;

/// The integer that Williams' maps store for a post-projective depth: ⌊z_s·(2^bits − 1) + ½⌋, z_s clamped to 0..=1 and `bits` to
/// 8..=24 (Williams 1978).
pub fn quantum(z_screen: f64, bits: u32) -> u32 {
    (z_screen.clamp(0.0, 1.0) * top(bits) + 0.5) as u32
}

/// The map with its depths rounded to integers of `bits` (8 to 24; others are moved to the nearest of these), kept as
/// q/(2^bits − 1) (Williams 1978).
///
/// The top code is both the far plane and *nothing here*: it becomes +∞, or 1 when `faithful` to the integer buffer,
/// where the far plane then shadows whatever lies beyond it.
///
/// # Panics
/// When the map's kind is not [`Kind::Screen`]: only post-projective depth has a fixed range.
#[must_use]
pub fn quantise(map: &Raw, bits: u32, faithful: bool) -> Raw {
    assert_eq!(crate::DepthMap::view(map).kind(), Kind::Screen, "kind of a map to be quantised");
    map.replaced(|_, depth| {
        let share = f64::from(quantum(f64::from(depth), bits)) / top(bits);
        if share == 1.0 && !faithful { f32::INFINITY } else { share as f32 }
    })
}

/// The largest code.
fn top(bits: u32) -> f64 {
    f64::from((1_u32 << bits.clamp(*BITS.start(), *BITS.end())) - 1)
}
