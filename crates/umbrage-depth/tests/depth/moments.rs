//! Maps of moments: what they keep, exactly and within the roundings of 32 bits.

use glam::{DVec3, UVec2, Vec2};
use umbrage_depth::{DeepMap, DepthMap, Map, MomentMap, MomentSource, Moments, Raw, Step, Storage, Stored};
use umbrage_plane::{Kind, View, mix32};

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

/// A number from 0 to 1 as the nearest of 11 binary digits, as 16-bit floats have it down to 2⁻¹⁴, and on the grid of 2⁻²⁴ below that.
fn half(value: f64) -> f64 {
    let step = if value < 2f64.powi(-14) { 2f64.powi(-24) } else { 2f64.powi(value.log2().floor() as i32 - 10) };
    (value / step).round_ties_even() * step
}

/// Both passes of `vsm.glsl.js` (three.js r187), pixel by pixel: `gl_FragCoord.xy`, texture coordinates of 0..1, the nearest texel of the depth
/// texture, then linear interpolation of what the first pass wrote.
fn passes_of_three(depths: &[f64], size: UVec2, radius: f64, samples: u32) -> Vec<[f64; 2]> {
    let (width, height) = (f64::from(size.x), f64::from(size.y));
    let fetch = |from: &dyn Fn(usize) -> [f64; 2], x: f64, y: f64| {
        let [x, y] = [x.clamp(0.0, width - 1.0), y.clamp(0.0, height - 1.0)];
        from(y as usize * size.x as usize + x as usize)
    };
    let nearest = |u: f64, v: f64| fetch(&|texel| [depths[texel], 0.0], (u * width).floor(), (v * height).floor())[0];
    let offset = |i: u32| if samples <= 1 { 0.0 } else { -1.0 + f64::from(i) * 2.0 / (f64::from(samples) - 1.0) };
    let written = |mean: f64, squared_mean: f64| {
        let (mean, squared_mean) = (mean / f64::from(samples), squared_mean / f64::from(samples));
        [half(mean), half((squared_mean - mean * mean).max(0.0).sqrt())]
    };
    let pixels = || (0..size.y).flat_map(|y| (0..size.x).map(move |x| (f64::from(x) + 0.5, f64::from(y) + 0.5)));
    let vertical: Vec<[f64; 2]> = pixels()
        .map(|(x, y)| {
            let depth = |i| nearest(x / width, (y + offset(i) * radius) / height);
            written((0..samples).map(depth).sum(), (0..samples).map(|i| depth(i).powi(2)).sum())
        })
        .collect();
    let linear = |u: f64, v: f64| {
        let (x, y) = (u * width - 0.5, (v * height - 0.5).round());
        let from = |texel: usize| vertical[texel];
        let (left, right) = (fetch(&from, x.floor(), y), fetch(&from, x.floor() + 1.0, y));
        let share = x - x.floor();
        [left[0] * (1.0 - share) + right[0] * share, left[1] * (1.0 - share) + right[1] * share]
    };
    pixels()
        .map(|(x, y)| {
            let seen = |i| linear((x + offset(i) * radius) / width, y / height);
            let squares = |i| seen(i)[1].powi(2) + seen(i)[0].powi(2);
            written((0..samples).map(|i| seen(i)[0]).sum(), (0..samples).map(squares).sum())
        })
        .collect()
}

#[test]
fn deviations_are_what_both_passes_of_three_write() {
    let raw = map(19, 11, noise);
    let size = raw.view().size();
    for (radius, samples) in [(1.0f32, 8), (0.0, 8), (2.3, 8), (1.0, 1), (4.1, 5), (1.7, 2)] {
        let moments = MomentMap::of(&raw, Moments::Deviation { samples }, radius);
        assert_eq!((moments.levels(), moments.depths()), (1, raw.depths()));
        // The range of the view is 0 to 100.
        let depths: Vec<f64> = raw.depths().iter().map(|depth| f64::from(*depth / 100.0).min(1.0)).collect();
        let wanted = passes_of_three(&depths, size, f64::from(radius), samples);
        let mut apart = 0;
        for (i, wanted) in (0..).zip(&wanted) {
            let at = Vec2::new((i % size.x) as f32, (i / size.x) as f32) + 0.5;
            let found = moments.at(at, 0.0);
            assert_eq!(found, moments.at(at, 3.0), "there is one level");
            for (found, wanted) in found.into_iter().zip(wanted) {
                // What lies just between two 16-bit floats may go either way.
                assert!((found - wanted).abs() <= 0.0005, "{found}, not {wanted} at {at}");
                apart += u32::from(found != *wanted);
            }
        }
        assert!(apart * 50 <= size.element_product(), "{apart} differ: radius {radius}, {samples} samples");
    }
    let kept = |samples| MomentMap::of(&raw, Moments::Deviation { samples }, 1.0).kind();
    assert_eq!([kept(0), kept(u32::MAX)], [1, 256].map(|samples| Moments::Deviation { samples }));
}

#[test]
fn deviations_are_of_screen_depth_whatever_the_map_stores() {
    let size = UVec2::splat(8);
    let view = View::perspective(DVec3::Y * 9.0, DVec3::ZERO, DVec3::X, 0.7, 2.0, 18.0, size).unwrap();
    for kind in [Kind::Axial, Kind::Screen] {
        let view = view.with_kind(kind);
        let stored = |zeta: f64| if kind == Kind::Screen { view.key(zeta) } else { zeta } as f32;
        let depths = (0..64).map(|i| if i % 8 < 4 { stored(6.0) } else { f32::INFINITY }).collect();
        let moments = MomentMap::of(&Raw::new(view, depths).unwrap(), Moments::Deviation { samples: 8 }, 0.0);
        // f(ζ − n)/(ζ(f − n)).
        let wanted = 18.0 * 4.0 / (6.0 * 16.0);
        assert!((moments.scaled(stored(6.0)) - wanted).abs() < 1e-6, "{kind:?}");
        assert_eq!(moments.at(Vec2::splat(2.5), 0.0)[..2], [0.75, 0.0], "{kind:?}");
        assert_eq!(moments.at(Vec2::new(6.5, 2.5), 0.0)[..2], [1.0, 0.0], "{kind:?}");
        assert_eq!((moments.scaled(stored(18.0)), moments.scaled(stored(2.0))), (1.0, 0.0), "{kind:?}");
        assert_eq!((moments.scaled(f32::INFINITY), moments.scaled(f32::NEG_INFINITY)), (1.0, 0.0), "{kind:?}");
        assert!(moments.scaled(f32::NAN).is_nan(), "{kind:?}");
    }
}
