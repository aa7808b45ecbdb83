//! The published numbers of sample patterns: vectors V02 to V09, V19, V24, V25, V60 and V61, and what each parameter does.

use glam::{UVec2, Vec2};
use umbrage_plane::Footprint;
use umbrage_sample::{
    Centre, Density, Disc, EveryTexel, Gaussian, InsideQuadReject, InsideQuadWarp, Jittered, Key, Pattern, Tap, Tent,
    Uniform, each_tap, hammersley,
};

const KEY: Key = Key::new(1987, 0, 0);

fn close(got: f64, want: f64, tolerance: f64) {
    assert!((got - want).abs() <= tolerance, "got {got}, want {want} ± {tolerance}");
}

fn taps(pattern: &impl Pattern, region: &Footprint, key: Key) -> Vec<Tap> {
    let mut taps = Vec::new();
    each_tap(pattern, region, key, |tap| taps.push(*tap));
    taps
}

fn boxed(x: f32, y: f32, a: f32, b: f32) -> Footprint {
    Footprint::boxed(Vec2::new(x, y), Vec2::new(a, b))
}

fn counts(a: f32, b: f32, num_samples: u32, min_samples: u32) -> (u32, u32) {
    let UVec2 { x, y } =
        Jittered::default().with_num_samples(num_samples).with_min_samples(min_samples).counts(Vec2::new(a, b));
    (x, y)
}

#[test]
fn v02_counts_of_regions_smaller_than_the_samples() {
    for (half, want) in [(0.0, 1), (0.4, 1), (0.75, 2), (1.0, 2), (1.5, 3)] {
        assert_eq!(counts(half, half, 16, 1), (want, want), "half-extent {half}");
    }
}

#[test]
fn v03_counts_on_both_sides_of_the_branch() {
    assert_eq!(counts(2.0, 2.0, 16, 1), (4, 4));
    assert_eq!(counts(3.0, 3.0, 16, 1), (4, 4));
    assert_eq!(counts(3.0, 1.0, 16, 1), (6, 2));
    assert_eq!(counts(7.9, 0.4, 16, 1), (16, 1));
    assert_eq!(counts(39.0, 0.1, 16, 1), (16, 1));
}

#[test]
fn v04_counts_of_large_regions_e_r8() {
    assert_eq!(counts(8.0, 4.0, 16, 1), (5, 3));
    assert_eq!(counts(4.0, 8.0, 16, 1), (3, 6));
    assert_eq!(counts(6.0, 2.0, 16, 1), (8, 2));
    assert_eq!(counts(2.0, 6.0, 16, 1), (2, 7));
    assert_eq!(counts(20.0, 1.0, 16, 1), (16, 1));
    assert_eq!(counts(1.0, 20.0, 16, 1), (1, 16));
}

#[test]
fn v05_counts_with_a_minimum_e_r5() {
    assert_eq!(counts(20.0, 1.0, 16, 2), (8, 2));
    assert_eq!(counts(1.0, 20.0, 16, 2), (2, 16));
}

#[test]
fn v06_counts_of_slivers_e_r6() {
    assert_eq!(counts(0.5, 40.0, 16, 1), (1, 16));
    assert_eq!(counts(40.0, 0.5, 16, 1), (16, 1));
    assert_eq!(counts(66.0, 1.0, 16, 1), (16, 1));
    assert_eq!(counts(1.0, 66.0, 16, 1), (1, 16));
    assert_eq!(counts(1.0, 67.0, 16, 1), (1, 16));
}

#[test]
fn v07_counts_of_other_sample_numbers_and_their_extremes_e_r7() {
    assert_eq!(counts(24.0, 24.0, 64, 2), (8, 8));
    assert_eq!(counts(3.0, 3.0, 4, 1), (2, 2));
    assert_eq!(counts(3.0, 3.0, 1, 1), (1, 1));
    assert_eq!(counts(5.25, 0.75, 16, 1), (11, 2));
    let halves = || (1..=512).map(|step| step as f32 * 0.25);
    for (n, in_all, when_large) in [(4, 6, 4), (16, 22, 20), (64, 86, 84), (256, 342, 340)] {
        let products = |large: bool| {
            let pairs = halves().flat_map(|a| halves().map(move |b| (a, b)));
            let kept = pairs.filter(move |(a, b)| !large || 4.0 * a * b >= n as f32);
            kept.map(move |(a, b)| counts(a, b, n, 1)).map(|(ns, nt)| ns * nt)
        };
        assert_eq!(products(false).max(), Some(in_all), "NumSamples {n}");
        assert_eq!(products(true).max(), Some(when_large), "NumSamples {n}, large regions");
    }
    let least = halves().flat_map(|a| halves().map(move |b| (a, b))).filter(|(a, b)| 4.0 * a * b >= 16.0);
    assert_eq!(least.map(|(a, b)| counts(a, b, 16, 1)).map(|(ns, nt)| ns * nt).min(), Some(11));
}

/// The bound that the documentation of `num_samples` states.
#[test]
fn e_r7_never_more_than_half_as_many_again() {
    for n in 1..=300 {
        for step in 1..=4000 {
            let (a, b) = (step as f32 / 40.0, 0.49 * n as f32 / (step as f32 / 10.0));
            for (ns, nt) in [counts(a, b, n, 1), counts(b, a, n, 1), counts(a, b * 1.1, n, 1), counts(a, a * 0.1, n, 1)]
            {
                assert!(2 * ns * nt <= 3 * n, "{ns} x {nt} for {n}");
            }
        }
    }
}

#[test]
fn v08_cell_centres_and_the_span_of_the_jitter_e_r9() {
    let region = boxed(100.25, 50.0, 2.0, 2.0);
    let regular = Jittered::default().with_jitter(0.0);
    let columns: Vec<f32> = taps(&regular, &region, KEY).iter().take(4).map(|tap| tap.at.x).collect();
    assert_eq!(columns, [98.75, 99.75, 100.75, 101.75]);
    let (mut least, mut most) = (0.0f32, 0.0f32);
    for k in 0..20_000 {
        let away = taps(&Jittered::default(), &region, KEY.region(k))[0].at.x - 98.75;
        (least, most) = (least.min(away), most.max(away));
    }
    assert!((-0.5..-0.4995).contains(&least) && (0.4995..=0.5).contains(&most), "jitter spans {least} to {most}");
}

/// One region's fraction has variance ¼·¾/4³, so the mean of 100,000 has a deviation of 0.00017.
#[test]
fn v09_expected_fraction_of_a_shadow_edge() {
    let region = boxed(100.25, 50.0, 2.0, 2.0);
    let (mut shadowed, mut all) = (0, 0);
    for k in 0..100_000 {
        each_tap(&Jittered::default(), &region, KEY.region(k), |tap| {
            all += 1;
            shadowed += u32::from(tap.at.x >= 100.0);
        });
    }
    close(f64::from(shadowed) / f64::from(all), 0.5625, 4.0 * 0.000_17);
}

/// Mean and variance of the fraction of taps left of `share` of the region's width.
fn edge_variance(pattern: &impl Pattern, share: f64, half: f32) -> (f64, f64) {
    let region = boxed(0.0, 0.0, half, half);
    let edge = ((2.0 * share - 1.0) * f64::from(half)) as f32;
    let (mut sum, mut squares) = (0.0, 0.0);
    let keys = 60_000;
    for k in 0..keys {
        let all = taps(pattern, &region, KEY.region(k));
        let fraction = all.iter().filter(|tap| tap.at.x < edge).count() as f64 / all.len() as f64;
        sum += fraction;
        squares += fraction * fraction;
    }
    let mean = sum / f64::from(keys);
    (mean, squares / f64::from(keys) - mean * mean)
}

#[test]
fn v19_variance_of_uniform_and_jittered_samples_at_an_edge_d_12() {
    for (n, share, uniform, jittered) in [
        (4, 0.625, 0.014_648_44, 0.003_906_25),
        (4, 0.5, 0.015_625, 0.0),
        (4, 0.55, 0.015_468_75, 0.0025),
        (8, 0.5625, 0.003_845_215, 0.000_488_281_25),
    ] {
        let num_samples = n * n;
        let found = edge_variance(&Uniform::default().with_num_samples(num_samples), share, n as f32);
        close(found.0, share, 4.0 * (uniform / 60_000f64).sqrt());
        close(found.1, uniform, 0.03 * uniform);
        let found = edge_variance(&Jittered::default().with_num_samples(num_samples), share, n as f32);
        close(found.0, share, 4.0 * (jittered / 60_000f64).sqrt() + 1e-9);
        close(found.1, jittered, 0.03 * jittered + 1e-12);
    }
}

#[test]
fn v24_sixteen_samples_give_four_bits_and_seventeen_levels() {
    let pattern = Jittered::default();
    assert_eq!(pattern.num_samples.ilog2(), 4);
    let mut seen = [false; 17];
    for k in 0..4000u32 {
        let edge = k as f32 / 500.0 - 4.0;
        let all = taps(&pattern, &boxed(0.0, 0.0, 3.0, 3.0), KEY.region(k));
        seen[all.iter().filter(|tap| tap.at.x + 0.3 * tap.at.y < edge).count()] = true;
    }
    assert!(seen.iter().all(|&level| level), "{seen:?}");
}

/// ∫ of the normal law's density, by Simpson's rule.
fn normal_mass(low: f64, high: f64) -> f64 {
    let density = |x: f64| (-0.5 * x * x).exp() / std::f64::consts::TAU.sqrt();
    let (steps, h) = (200, (high - low) / 200.0);
    let weight = |i: u32| if i == 0 || i == steps { 1.0 } else { f64::from(2 + 2 * (i % 2)) };
    (0..=steps).map(|i| weight(i) * density(low + f64::from(i) * h)).sum::<f64>() * h / 3.0
}

#[test]
fn v25_gaussian_is_the_normal_law_cut_off_at_the_box() {
    let mass = normal_mass(-2.0, 2.0);
    close(mass, 0.954_500, 1e-6);
    close(mass * mass, 0.911_070, 1e-6);
    let region = boxed(0.0, 0.0, 2.0, 8.0);
    let (mut central, mut all) = (0.0, 0.0);
    for k in 0..5000 {
        let key = KEY.region(k);
        for (tap, index) in taps(&Gaussian::default(), &region, key).iter().zip(0..) {
            close(normal_mass(-2.0, f64::from(tap.at.x)) / mass, f64::from(key.unit(index, 0)), 2e-5);
            close(normal_mass(-2.0, f64::from(tap.at.y) * 0.25) / mass, f64::from(key.unit(index, 1)), 2e-5);
            all += 1.0;
            central += f64::from(u8::from(tap.at.x.abs() < 1.0 && tap.at.y.abs() < 4.0));
        }
    }
    // Figure 3b: the central quarter of the area holds 2.05 times its even share.
    let want = (normal_mass(-1.0, 1.0) / mass).powi(2);
    close(central / all, want, 4.0 * (want * (1.0 - want) / all).sqrt());
    assert!(want > 1.5 * 0.25);
}

#[test]
fn v60_hammersley_points() {
    let four = [(0.0, 0.0), (0.25, 0.5), (0.5, 0.25), (0.75, 0.75)];
    for (i, want) in (0..).zip(four) {
        assert_eq!(hammersley(i, 4), Vec2::from(want));
    }
    let y = [0.0, 0.5, 0.25, 0.75, 0.125, 0.625, 0.375, 0.875];
    for (i, want) in (0..).zip(y) {
        assert_eq!(hammersley(i, 8), Vec2::new(i as f32 / 8.0, want));
    }
    let unit = boxed(0.0, 0.0, 1.0, 1.0);
    let plain = Disc::default().with_num_samples(8).with_rotate(false);
    let blur = [
        (0.0, 0.0),
        (0.5, 0.5),
        (0.0, 0.5),
        (-0.612_372, 0.612_372),
        (-0.353_553, 0.0),
        (-0.559_017, -0.559_017),
        (0.0, -0.612_372),
        (0.661_438, -0.661_438),
    ];
    let depth = [
        (0.0, 0.0),
        (0.353_553, 0.353_553),
        (0.0, 0.25),
        (-0.530_330, 0.530_330),
        (-0.125, 0.0),
        (-0.441_942, -0.441_942),
        (0.0, -0.375),
        (0.618_718, -0.618_718),
    ];
    for (density, want) in [(Density::Uniform, blur), (Density::Centred, depth)] {
        for (tap, want) in taps(&plain.with_density(density), &unit, KEY).iter().zip(want) {
            assert!((tap.at - Vec2::from(want)).abs().max_element() < 1e-6, "{} is not {want:?}", tap.at);
        }
    }
}

#[test]
fn v61_moments_of_sixteen_hammersley_points_d_14() {
    let unit = boxed(0.0, 0.0, 1.0, 1.0);
    let radii = |density| {
        let disc = Disc::default().with_num_samples(16).with_density(density);
        taps(&disc, &unit, KEY).iter().map(|tap| f64::from(tap.at.length())).collect::<Vec<_>>()
    };
    let mean = |radii: &[f64], power: i32| radii.iter().map(|r| r.powi(power)).sum::<f64>() / 16.0;
    let inner = |radii: &[f64]| radii.iter().filter(|&&r| r < 0.5 - 1e-6).count();
    let (blur, depth) = (radii(Density::Uniform), radii(Density::Centred));
    close(mean(&depth, 1), 0.468_75, 1e-6);
    close(mean(&depth, 2), 0.302_734, 1e-6);
    close(mean(&blur, 2), 0.468_75, 1e-6);
    close(mean(&blur, 1), 0.632_331, 1e-6);
    assert_eq!((inner(&depth), inner(&blur)), (8, 4));
    close(depth.iter().map(|r| 1.0 - 0.9 * r).sum(), 9.25, 1e-5);
}

#[test]
fn e_b8_half_offset_makes_the_mean_radius_unbiased() {
    let disc = Disc::default().with_num_samples(16).with_density(Density::Centred).with_half_offset(true);
    let all = taps(&disc, &boxed(0.0, 0.0, 1.0, 1.0), KEY);
    close(all.iter().map(|tap| f64::from(tap.at.length())).sum::<f64>() / 16.0, 0.5, 1e-6);
}

#[test]
fn disc_turns_by_the_angle_of_its_region() {
    let region = boxed(5.0, 7.0, 2.0, 2.0);
    let still = taps(&Disc::default().with_rotate(false), &region, KEY);
    let turned = taps(&Disc::default(), &region, KEY);
    let angle = f64::from(KEY.unit(0, 0)) * std::f64::consts::TAU;
    for (still, turned) in still.iter().zip(&turned) {
        let from = (still.at - region.centre).as_dvec2();
        let want = glam::DVec2::from_angle(angle).rotate(from);
        assert!(
            ((turned.at - region.centre).as_dvec2() - want).length() < 3e-6,
            "{} turned to {}",
            still.at,
            turned.at
        );
    }
}

#[test]
fn fig_2_every_texel_of_three_by_three() {
    let all = taps(&EveryTexel, &boxed(10.5, 20.5, 1.5, 1.5), KEY);
    let found: Vec<(f32, f32)> = all.iter().map(|tap| tap.at.into()).collect();
    let want: Vec<(f32, f32)> = (19..22).flat_map(|j| (9..12).map(move |i| (i as f32 + 0.5, j as f32 + 0.5))).collect();
    assert_eq!(found, want);
}

#[test]
fn every_texel_is_half_open_and_never_empty() {
    let columns =
        |x: f32, a: f32| taps(&EveryTexel, &boxed(x, 0.5, a, 0.0), KEY).iter().map(|tap| tap.at.x).collect::<Vec<_>>();
    // Centres at both borders of the box: the lower one is inside, the upper one is not.
    assert_eq!(columns(2.5, 1.0), [1.5, 2.5]);
    assert_eq!(columns(2.5, 0.25), [2.5]);
    // No centre inside: the texel under the region's own centre, from inside the region.
    assert_eq!(columns(2.125, 0.125), [2.25]);
    assert_eq!(columns(-0.25, 0.0), [-0.25]);
}

#[test]
fn r87_15_a_region_without_extent_is_one_look_up_e_r17() {
    let point = Footprint::point(Vec2::new(3.25, 4.5));
    for pattern in [Jittered::default(), Jittered::default().with_min_samples(3)] {
        assert_eq!(taps(&pattern, &point, KEY), taps(&Centre, &point, KEY));
    }
    assert_eq!(taps(&Centre, &boxed(3.25, 4.5, 9.0, 9.0), KEY)[0].at, point.centre);
}

#[test]
fn r87_11_quadrilaterals_without_an_inside_fall_back_to_their_box() {
    let corner = |x: f32, y: f32| Vec2::new(x, y);
    for (name, corners) in [
        ("crossed", [corner(0.0, 0.0), corner(4.0, 4.0), corner(4.0, 0.0), corner(0.0, 4.0)]),
        ("not convex", [corner(0.0, 0.0), corner(4.0, 0.0), corner(1.0, 1.0), corner(0.0, 4.0)]),
        ("a line", [corner(0.0, 0.0), corner(2.0, 1.0), corner(4.0, 2.0), corner(2.0, 1.0)]),
    ] {
        let region = Footprint::around(corners);
        let boxed = taps(&Jittered::default(), &region, KEY);
        assert_eq!(taps(&InsideQuadReject::default(), &region, KEY), boxed, "{name}, rejecting");
        assert_eq!(taps(&InsideQuadWarp::default(), &region, KEY), boxed, "{name}, warping");
    }
}

#[test]
fn fig_3d_taps_stay_inside_the_quadrilateral_of_v42() {
    let corner = |s: f32, t: f32| Vec2::new(s, t) * 1024.0;
    let (a, b) = (corner(0.610_685_5, 0.331_708_36), corner(0.610_133, 0.335_023_6));
    let (c, d) = (corner(0.611_877_9, 0.334_497), corner(0.612_439_46, 0.331_177_6));
    let region = Footprint::around([a, b, c, d]);
    let region = region.scaled(region.centre, 3.0, 0.0, Vec2::splat(256.0));
    close(f64::from(region.quad_share()), 0.621_014_7, 1e-3);
    let inside = |at: Vec2, slack: f32| {
        (0..4).all(|k| {
            let (from, to) = (region.corners[k], region.corners[(k + 1) % 4]);
            (to - from).normalize().perp_dot(at - from) <= slack
        })
    };
    let (mut accepted, mut offered) = (0, 0);
    for k in 0..5000 {
        let key = KEY.region(k);
        let rejected = taps(&InsideQuadReject::default(), &region, key);
        accepted += rejected.len();
        offered += taps(&Jittered::default(), &region, key).len();
        let warped = taps(&InsideQuadWarp::default(), &region, key);
        assert!(rejected.iter().chain(&warped).all(|tap| inside(tap.at, 1e-3)));
    }
    close(accepted as f64 / offered as f64, f64::from(region.quad_share()), 0.005);
}

#[test]
fn inside_patterns_take_the_middle_of_a_sliver() {
    let thin = 1.0 / 1024.0;
    let corners = [Vec2::ZERO, Vec2::splat(40.0), Vec2::new(40.0 + thin, 40.0), Vec2::new(thin, 0.0)];
    let all = taps(&InsideQuadReject(Jittered::default().with_num_samples(4)), &Footprint::around(corners), KEY);
    assert_eq!(all.len(), 1);
    assert!((all[0].at - Vec2::new(20.0 + 0.5 * thin, 20.0)).length() < 1e-5);
}

#[test]
fn r87_12_every_parameter_changes_the_taps() {
    let (region, base) = (boxed(9.3, 4.1, 5.25, 0.75), Jittered::default());
    let plain = taps(&base, &region, KEY);
    assert_eq!(plain.len(), 22);
    assert_eq!(taps(&base.with_hard_cap(true), &region, KEY).len(), 16);
    assert_eq!(taps(&base.with_num_samples(4), &region, KEY).len(), 4);
    assert_eq!(taps(&base.with_min_samples(3), &region, KEY).len(), 33);
    assert_ne!(taps(&base.with_jitter(0.5), &region, KEY), plain);
    assert_eq!(taps(&Uniform::default().with_num_samples(40), &region, KEY).len(), 40);
    assert_eq!(taps(&Gaussian::default().with_num_samples(41), &region, KEY).len(), 41);
    assert_eq!(taps(&Disc::default().with_num_samples(42), &region, KEY).len(), 42);
}

#[test]
fn the_cost_of_a_region_does_not_grow_with_its_size() {
    for exponent in -10..24 {
        let half = 2f32.powi(exponent);
        assert!(taps(&Jittered::default(), &boxed(0.0, 0.0, half, half), KEY).len() <= 22);
    }
}

#[test]
fn r87_11_d_the_middle_is_the_centroid_of_the_area() {
    // So slender that no sample of the box falls inside, and three times as wide at one end.
    let thin = 1.0 / 1024.0;
    let corners = [Vec2::ZERO, Vec2::splat(36.0), Vec2::new(36.0 + thin, 36.0), Vec2::new(3.0 * thin, 0.0)];
    let pattern = InsideQuadReject(Jittered::default().with_num_samples(4));
    let all = taps(&pattern, &Footprint::around(corners), KEY);
    assert_eq!(all.len(), 1);
    // A trapezium's centroid stands at (a + 2b)/(3(a + b)) of its height from side a: 5/12 of 36 from the wide end.
    assert!((all[0].at.y - 15.0).abs() < 1e-4, "{}", all[0].at);
}

#[test]
fn wm94_6_tents_of_any_extent_weigh_something_and_the_nearest_four_bilinearly() {
    // Half a texel, exactly between two: the one texel in the region lies on its side.
    for half in [0.0, 0.2, 0.3, 0.5, 0.500_001, 0.6, 1.0, 2.0] {
        for centre in [8.0, 8.25, 8.5, 8.75, 300.0, 300.5, 4000.0] {
            let weights: f32 = taps(&Tent, &boxed(centre, centre, half, half), KEY).iter().map(|tap| tap.weight).sum();
            assert!(weights > 0.0, "half {half} at {centre}");
        }
    }
    let found = taps(&Tent, &boxed(8.25, 8.0, 1.0, 1.0), KEY);
    let weights: Vec<(f32, f32, f32)> = found.iter().map(|tap| (tap.at.x, tap.at.y, tap.weight)).collect();
    assert_eq!(weights, [(7.5, 7.5, 0.125), (8.5, 7.5, 0.375), (7.5, 8.5, 0.125), (8.5, 8.5, 0.375)]);
}
