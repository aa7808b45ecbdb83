//! What small triangles cover, found when they are set up.

use crate::BIN;
use crate::piece::{NOWHERE, PATCH, Patch};
use crate::setup::SUBTEXELS;
use umbrage_plane::TexelRect;

/// What is known of a triangle once it is set up, if it is small.
pub(crate) struct Small {
    /// All bits set where it is: its bounding box holds samples of [`PATCH`]² texels at most, all of them in the window and in one tile.
    pub holds: u32,
    /// The index of its tile, [`NOWHERE`] where it covers no sample.
    pub home: u32,
    pub patch: Patch,
}

impl Small {
    /// Of a triangle by its corners' coordinates, where samples are at the centres; `tiles` is the number of tiles across.
    ///
    /// Without a branch, so that a loop over several triangles becomes vector instructions; of those that are not small, numbers may overflow.
    #[inline(always)]
    pub fn of(x: [i32; 3], y: [i32; 3], window: TexelRect, tiles: u32) -> Self {
        let (left, right) = samples(x);
        let (top, bottom) = samples(y);
        let inside = left >= window.min.x && right <= window.max.x && top >= window.min.y && bottom <= window.max.y;
        let some = left < right && top < bottom && right - left <= PATCH && bottom - top <= PATCH;
        let tile = |texel: i32| texel >> BIN.trailing_zeros();
        let together = tile(left) == tile(right - 1) && tile(top) == tile(bottom - 1);
        let covered = covered(x, y, left, top);
        let home = (tile(top) as u32).wrapping_mul(tiles).wrapping_add(tile(left) as u32);
        let at = |texel: i32| texel as u32 % BIN;
        Self {
            holds: if inside && some && together { u32::MAX } else { 0 },
            home: if covered == 0 { NOWHERE } else { home },
            patch: Patch(if covered == 0 { 0 } else { covered << 16 | at(top) << 8 | at(left) }),
        }
    }
}

/// The texels along an axis whose centres lie inside a box around the corners: the first, and one past the last.
#[inline(always)]
fn samples(along: [i32; 3]) -> (i32, i32) {
    let least = along[0].min(along[1]).min(along[2]);
    let greatest = along[0].max(along[1]).max(along[2]);
    let from = |at: i32| at.wrapping_add(SUBTEXELS / 2 - 1) >> SUBTEXELS.trailing_zeros();
    (from(least), from(greatest))
}

/// Which samples at the centres of [`PATCH`]² texels, the first of which is at `left` and `top`, lie inside a triangle, by the rule of
/// [`Coverage`](crate::Coverage): bit 4·y + x for column x and row y.
#[inline(always)]
fn covered(x: [i32; 3], y: [i32; 3], left: i32, top: i32) -> u32 {
    let (left, top) = (left * SUBTEXELS + SUBTEXELS / 2, top * SUBTEXELS + SUBTEXELS / 2);
    let corner = |corner: usize| [x[corner].wrapping_sub(left), y[corner].wrapping_sub(top)];
    let (a, b, c) = (corner(0), corner(1), corner(2));
    crossed(a, b) ^ crossed(b, c) ^ crossed(c, a)
}

/// From which samples a ray to the right crosses an edge.
#[inline(always)]
fn crossed(a: [i32; 2], b: [i32; 2]) -> u32 {
    let falls = a[1] <= b[1];
    let (upper, lower) = (if falls { a[0] } else { b[0] }, if falls { b[0] } else { a[0] });
    let (top, bottom) = (a[1].min(b[1]), a[1].max(b[1]));
    let (dx, dy) = (lower.wrapping_sub(upper), bottom.wrapping_sub(top));
    // Positive where the crossing lies to the right of a row's first sample.
    let mut ahead = dy.wrapping_mul(upper).wrapping_sub(dx.wrapping_mul(top));
    let mut crossed = 0;
    for row in 0..PATCH {
        let height = row * SUBTEXELS;
        // All bits set or none, as vector instructions compare.
        let within = if top <= height && height < bottom { u32::MAX } else { 0 };
        let mut left = ahead;
        let mut bits = 0;
        for column in 0..PATCH {
            bits |= if left > 0 { 1 << (PATCH * row + column) } else { 0 };
            left = left.wrapping_sub(dy.wrapping_mul(SUBTEXELS));
        }
        crossed |= bits & within;
        ahead = ahead.wrapping_add(dx.wrapping_mul(SUBTEXELS));
    }
    crossed
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::Coverage;
    use crate::coverage::Samples;
    use crate::setup::{Reach, bounds};
    use glam::{IVec2, UVec2};
    use proptest::prelude::*;
    use umbrage_plane::Sampling;

    proptest! {
        #![proptest_config(ProptestConfig::with_cases(20_000))]

        #[test]
        fn x2_small_triangles_are_covered_as_any(
            at in (-300_i32..33 * 256, -300_i32..33 * 256),
            offsets in [corner(), corner(), corner()],
            window in (0_i32..32, 0_i32..32, 1_i32..40, 1_i32..40),
        ) {
            let tile = UVec2::new(5, 3);
            let origin = (tile * BIN).as_ivec2();
            let corners = offsets.map(|offset| origin * SUBTEXELS + IVec2::new(at.0, at.1) + offset);
            let low = origin + IVec2::new(window.0, window.1);
            let window = TexelRect::new(low, low + IVec2::new(window.2, window.3));
            let small = Small::of(corners.map(|corner| corner.x), corners.map(|corner| corner.y), window, 7);

            let reached = Reach::Samples(Sampling::Centre).texels(bounds(&corners));
            let of_tile = TexelRect::new(origin, origin + BIN as i32);
            let fits = !reached.is_empty() && reached.size().max_element() <= PATCH as u32 && window.encloses(reached);
            let (first, last) = (reached.min.map(|v| v >> 5), (reached.max - 1).map(|v| v >> 5));
            prop_assert_eq!(small.holds, if fits && first == last { u32::MAX } else { 0 });
            if small.holds != 0 && of_tile.encloses(reached) {
                let mut any = Coverage::NOTHING;
                if Samples::of(tile, window, Sampling::Centre).unwrap().inside(&corners, &mut any) {
                    // Whatever it held before is gone.
                    let mut coverage = Coverage { rows: [7; 32], first: 3, end: 9 };
                    coverage.set(small.patch);
                    prop_assert_eq!((coverage, small.home), (any, 3 * 7 + 5));
                } else {
                    prop_assert_eq!((small.patch, small.home), (Patch::NONE, NOWHERE));
                }
            }
        }
    }

    /// Up to about four texels away: anywhere, or where samples lie on edges and corners.
    fn corner() -> impl Strategy<Value = IVec2> {
        let axis = || prop_oneof![-150_i32..150, -600_i32..600, (-4_i32..5).prop_map(|halves| halves * 128)];
        (axis(), axis()).prop_map(IVec2::from)
    }
}
