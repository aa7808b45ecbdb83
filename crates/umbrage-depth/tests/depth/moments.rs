//! Maps of moments: what they keep, exactly and within the roundings of 32 bits.

use glam::{DVec3, UVec2, Vec2};
use umbrage_depth::{DeepMap, DepthMap, Map, MomentMap, Moments, Raw, Step, Storage, Stored};
use umbrage_plane::{View, mix32};

const KINDS: [Moments; 5] = [Moments::Variance, Moments::ESM, Moments::EVSM2, Moments::EVSM4, Moments::Four];

fn map(width: u32, height: u32, depth: impl Fn(u32, u32) -> f32) -> Raw {
    let size = UVec2::new(width, height);
    let view = View::orthographic(DVec3::Y, DVec3::ZERO, DVec3::X, 1.0, 0.0, 100.0, size).unwrap();
    let texels = (0..height).flat_map(|y| (0..width).map(move |x| (x, y)));
    Raw::new(view, texels.map(|(x, y)| depth(x, y)).collect()).unwrap()
}

/// Depths of 20..30, with a hole in eight texels of a hundred.
fn noise(x: u32, y: u32) -> f32 {
    let bits = mix32(x << 16 | y);
    if bits.is_multiple_of(12) { f32::INFINITY } else { 20.0 + (bits >> 8) as f32 * 10.0 / (1 << 24) as f32 }
}

fn close(found: [f64; 4], wanted: [f64; 4], what: &str) {
    for (found, wanted) in found.into_iter().zip(wanted) {
        assert!((found - wanted).abs() <= 3e-7 * wanted.abs(), "{what}: {found}, not {wanted}");
    }
}

#[test]
fn texels_keep_functions_of_their_scaled_depths_and_the_map_its_depths() {
    let raw = map(13, 6, noise).with_stored(Stored::Midpoint);
    let (near, far) = raw
        .depths()
        .iter()
        .filter(|depth| depth.is_finite())
        .fold((f32::INFINITY, f32::NEG_INFINITY), |(near, far), &depth| (near.min(depth), far.max(depth)));
    for kind in KINDS {
        let moments = MomentMap::of(&raw, kind, 0.0);
        assert_eq!((moments.kind(), moments.depths(), moments.stored()), (kind, raw.depths(), Stored::Midpoint));
        assert_eq!((moments.scaled(near), moments.scaled(near - 1.0), moments.scaled(f32::INFINITY)), (0.0, 0.0, 1.0));
        assert!((moments.scaled(far) - 8.0 / 9.0).abs() < 1e-15 && moments.scaled(f32::NAN).is_nan());
        for y in 0..6 {
            for x in 0..13 {
                let depth = moments.scaled(noise(x, y));
                close(moments.at(Vec2::new(x as f32, y as f32) + 0.5, 0.0), kind.of(depth), &format!("{kind:?}"));
            }
        }
    }
}

#[test]
fn coarser_levels_are_means_and_places_between_are_interpolated() {
    let raw = map(16, 16, noise);
    for kind in KINDS {
        let moments = MomentMap::of(&raw, kind, 0.0);
        assert_eq!(moments.levels(), 5);
        let texel = |x: u32, y: u32| kind.of(moments.scaled(noise(x, y)));
        let mean = |left: u32, top: u32, side: u32| -> [f64; 4] {
            let texels = (0..side * side).map(|i| texel(left + i % side, top + i / side));
            let sum = texels.fold([0.0; 4], |sum, texel| std::array::from_fn(|i| sum[i] + texel[i]));
            sum.map(|sum| sum / f64::from(side * side))
        };
        for level in 0..5 {
            let side = 1 << level;
            let centre = |at: u32| Vec2::splat((side * at) as f32 + side as f32 * 0.5);
            let last = 16 / side - 1;
            close(moments.at(centre(last), level as f32), mean(side * last, side * last, side), &format!("{kind:?}"));
        }
        let [a, b] = [mean(4, 4, 4), mean(8, 4, 4)];
        let quarter = std::array::from_fn(|i| a[i] * 0.75 + b[i] * 0.25);
        close(moments.at(Vec2::new(7.0, 6.0), 2.0), quarter, "between texels");
        let at = Vec2::new(6.0, 6.0);
        let [fine, coarse] = [moments.at(at, 2.0), moments.at(at, 3.0)];
        close(moments.at(at, 2.25), std::array::from_fn(|i| fine[i] * 0.75 + coarse[i] * 0.25), "between levels");
    }
}

#[test]
fn levels_of_odd_sides_and_places_beyond_the_map_take_what_is_on_the_edge() {
    let raw = map(5, 3, |x, y| (x + 10 * y) as f32);
    let moments = MomentMap::of(&raw, Moments::Variance, 0.0);
    assert_eq!(moments.levels(), 4);
    let mean = |texels: &[f32]| texels.iter().map(|depth| moments.scaled(*depth)).sum::<f64>() / texels.len() as f64;
    let at = |x: f32, y: f32, level: f32| moments.at(Vec2::new(x, y), level)[0];
    assert!((at(5.0, 3.0, 1.0) - mean(&[24.0])).abs() < 1e-7, "one texel counts four times");
    assert!((at(1e9, -1e9, 0.0) - mean(&[4.0])).abs() < 1e-7);
    assert_eq!((at(2.0, 2.0, 9.0), at(2.0, 2.0, -1.0)), (at(2.0, 2.0, 3.0), at(2.0, 2.0, 0.0)));
    assert_eq!((at(2.0, 2.0, f32::NAN), at(2.0, 2.0, f32::INFINITY)), (at(2.0, 2.0, 0.0), at(2.0, 2.0, 3.0)));
    assert_eq!(at(f32::NAN, 2.0, 0.0), at(0.0, 2.0, 0.0));
}

#[test]
fn a_blur_is_a_normal_law_over_both_axes_and_leaves_what_is_even_alone() {
    let (side, centre, sigma) = (33, 16, 1.5f32);
    let raw = map(side, side, |x, y| if (x, y) == (centre, centre) { f32::INFINITY } else { 1.0 });
    let moments = MomentMap::of(&raw, Moments::Variance, sigma);
    assert_eq!(moments.prefilter(), sigma);
    // The hole counts as 1, all else as 0: what is found is the law's weight.
    let weight = |x: u32, y: u32| moments.at(Vec2::new(x as f32, y as f32) + 0.5, 0.0)[0];
    let (sum, spread) = (0..side * side).map(|i| (i % side, i / side)).fold((0.0, 0.0), |(sum, spread), (x, y)| {
        let far = f64::from(x) - f64::from(centre);
        (sum + weight(x, y), spread + far * far * weight(x, y))
    });
    assert!((sum - 1.0).abs() < 1e-6, "{sum}");
    // Cut off at three deviations and a bit, a normal law keeps 98 % of its variance.
    assert!((spread / f64::from(sigma * sigma) - 0.98).abs() < 0.02, "{spread}");
    let ratio = weight(centre + 1, centre + 2) / weight(centre, centre);
    assert!((ratio - (-2.5 / f64::from(sigma * sigma)).exp()).abs() < 1e-6, "{ratio}");
    assert_eq!(weight(centre + 3, centre), weight(centre, centre - 3));
    for kind in KINDS {
        let even = MomentMap::of(&map(7, 4, |_, _| 3.0), kind, 64.0);
        for level in 0..even.levels() {
            close(even.at(Vec2::new(2.2, 3.9), level as f32), kind.of(0.0), &format!("{kind:?}"));
        }
    }
    for none in [0.0, -1.0, f32::NAN] {
        assert_eq!(MomentMap::of(&raw, Moments::Four, none).prefilter(), 0.0);
    }
}

#[test]
fn exponents_that_floats_cannot_hold_are_lowered() {
    let raw = map(4, 4, noise);
    let kind = |kind| MomentMap::of(&raw, kind, 0.0).kind();
    let esm = |sharpness| Moments::Exponential { sharpness };
    let evsm = |positive, negative| Moments::ExponentialVariance { positive, negative };
    assert_eq!([kind(esm(1e9)), kind(esm(-1.0)), kind(esm(f32::NAN))], [esm(88.0), esm(0.0), esm(0.0)]);
    assert_eq!(kind(evsm(f32::INFINITY, Some(99.0))), evsm(44.0, Some(44.0)));
    for kind in [esm(f32::INFINITY), evsm(99.0, Some(99.0))] {
        let moments = MomentMap::of(&raw, kind, 3.0);
        for level in 0..moments.levels() {
            assert!(moments.at(Vec2::splat(2.0), level as f32).iter().all(|moment| moment.is_finite()), "{kind:?}");
        }
    }
}

#[test]
fn a_map_of_moments_counts_all_that_it_holds_and_stays_as_it_is() {
    let raw = map(64, 32, noise);
    for kind in KINDS {
        let moments = MomentMap::of(&raw, kind, 0.0);
        // 64 × 32 texels, then a quarter of them each, the last three levels 4 × 2, 2 × 1 and 1.
        let texels = 2048 + 512 + 128 + 32 + 8 + 2 + 1;
        assert_eq!(moments.bytes(), 4 * (2048 + kind.channels() * texels));
        assert!(moments.allocated() > moments.bytes() && moments.allocated() < moments.bytes() + 1000);
        let shared = Map::from(moments);
        for storage in [Storage::Raw, Storage::Bbox, Storage::Tiled] {
            let kept = shared.clone().kept(storage);
            assert!(std::ptr::eq(kept.moments().unwrap(), shared.moments().unwrap()));
        }
        assert!(shared.facets().is_none() && shared.translucent().is_none());
    }
    assert!(raw.moments().is_none());
}

#[test]
fn deep_maps_give_their_nearest_surfaces_and_empty_maps_nothing_to_be_behind() {
    let raw = map(2, 2, |x, _| if x == 0 { 4.0 } else { 8.0 });
    let steps = |depth: f32| vec![Step { depth, passes: glam::Vec3::splat(0.5) }];
    let deep = DeepMap::new(*DepthMap::view(&raw), 0.0, [4.0, 8.0, 4.0, 8.0].map(steps)).unwrap();
    let flat = MomentMap::of(&raw, Moments::Four, 1.0);
    assert_eq!(MomentMap::of(&deep, Moments::Four, 1.0), flat);
    let empty = MomentMap::of(&map(3, 3, |_, _| f32::INFINITY), Moments::Variance, 0.0);
    assert_eq!(
        (empty.scaled(0.0), empty.scaled(1e30), empty.at(Vec2::ONE, 1.0)[..2].to_vec()),
        (0.0, 0.0, vec![1.0; 2])
    );
}
