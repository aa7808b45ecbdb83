use std::ops::{Add, Mul};
use umbrage_plane::Footprint;
use umbrage_sample::{Key, Pattern, Tap, each_tap};

/// The weighted mean over a region of anything that can be computed at a tap: the order of *transform, then filter*
/// that percentage-closer filtering is one case of (Reeves 1987, §6).
///
/// [`Pcf`](crate::Pcf) is this with `f` = "is the texel nearer?", with its ranges and its SIMD. For transforms of what a map stores see
/// [`Query::each`](crate::Query::each), which knows the rules outside the map.
///
/// ```
/// use glam::Vec2;
/// use umbrage_plane::Footprint;
/// use umbrage_sample::{EveryTexel, Key};
/// use umbrage_shadow::weighted_mean;
///
/// // Reeves' Figure 2: the fraction of nearer depths, not the nearness of the mean depth.
/// let depths = [[50.2, 50.0, 50.0], [50.1, 1.2, 1.1], [1.3, 1.4, 1.2]];
/// let region = Footprint::boxed(Vec2::splat(1.5), Vec2::splat(1.5));
/// let at = |x: f32, y: f32| depths[y as usize][x as usize];
/// let key = Key::new(0, 0, 0);
/// let fraction: f32 = weighted_mean(&EveryTexel, &region, key, |tap| if 49.8 > at(tap.at.x, tap.at.y) { 1.0 } else { 0.0 });
/// assert!((fraction - 5.0 / 9.0).abs() < 1e-6);
/// ```
pub fn weighted_mean<T: Add<Output = T> + Mul<f32, Output = T> + Default + Copy>(
    pattern: &impl Pattern,
    region: &Footprint,
    key: Key,
    mut f: impl FnMut(&Tap) -> T,
) -> T {
    let (mut sum, mut weight) = (T::default(), 0.0);
    each_tap(pattern, region, key, |tap| {
        sum = sum + f(tap) * tap.weight;
        weight += tap.weight;
    });
    if weight > 0.0 { sum * (1.0 / weight) } else { T::default() }
}
