//! Reeves, Salesin & Cook 1987: the worked example, the listing as printed and as corrected, ranges and rules.

use glam::{DVec3, UVec2, Vec2, Vec3};
use umbrage_depth::{Raw, Tiled};
use umbrage_plane::{Bias, Footprint, Kind, Place, Receiver, Rules, SurfacePoint, View};
use umbrage_sample::{EveryTexel, Gaussian, InsideQuadReject, InsideQuadWarp, Jittered, Key, Uniform};
use umbrage_shadow::as_printed::{Counts, FootprintConvention, Listing, RandRange, TextureRect, counts, sample_shadow};
use umbrage_shadow::{Biased, Counters, Filter, FilteredDepth, OnPlane, Pcf, Shadow, ShadowMap, Spread, presets};

const KEY: Key = Key::new(7, 0, 0);

/// A lamp at (0, 0, 0) looking down −y, 90° wide: texel (x, y) of an n² map sees the world at ζ from there.
fn lamp(size: u32) -> View {
    let fov = 90f64.to_radians();
    View::perspective(DVec3::ZERO, DVec3::NEG_Y, DVec3::NEG_Z, fov, 0.1, 1000.0, UVec2::splat(size)).unwrap()
}

fn map(size: u32, depth: impl Fn(u32, u32) -> f32) -> Raw {
    let depths = (0..size * size).map(|i| depth(i % size, i / size)).collect();
    Raw::new(lamp(size), depths).unwrap()
}

/// A receiver at depth `zeta` whose image is the box `centre ± half`, facing the lamp.
fn receiver(view: &View, zeta: f32, centre: Vec2, half: Vec2) -> Receiver {
    let world = view.world_at(centre.as_dvec2(), -1.0 / f64::from(zeta));
    let seen = view.receiver(&SurfacePoint::at(world.as_vec3(), Vec3::Y)).unwrap();
    Receiver { footprint: Footprint::boxed(centre, half), depth: zeta, ..seen }
}

fn fraction<F: Filter, M: umbrage_depth::DepthMap>(filter: F, map: M, receiver: &Receiver, key: Key) -> f32 {
    ShadowMap { filter, map }.fraction_of(receiver, key)
}

const FIG2: [f32; 9] = [50.2, 50.0, 50.0, 50.1, 1.2, 1.1, 1.3, 1.4, 1.2];

#[test]
fn v01_figure_2_ordinary_against_percentage_closer_r87_9_r87_10() {
    // The 3 × 3 region in the middle of a 12² map.
    let map = map(12, |x, y| match (x.wrapping_sub(4), y.wrapping_sub(4)) {
        (x @ 0..3, y @ 0..3) => FIG2[(y * 3 + x) as usize],
        _ => f32::INFINITY,
    });
    assert!((FIG2.iter().map(|&z| f64::from(z)).sum::<f64>() / 9.0 - 22.944_444).abs() < 1e-6);
    let region = receiver(&lamp(12), 49.8, Vec2::splat(5.5), Vec2::splat(1.5));
    let exhaustive = Pcf::default()
        .with_pattern(EveryTexel)
        .with_depth(Biased::constant(Bias::ZERO))
        .with_res_factor(1.0)
        .with_min_size(0.0);
    assert!((fraction(exhaustive, map.clone(), &region, KEY) - 5.0 / 9.0).abs() < 1e-6);
    let ordinary = FilteredDepth::default().with_pattern(EveryTexel).with_bias(Bias::ZERO).with_res_factor(1.0);
    assert_eq!(fraction(ordinary, map, &region, KEY), 1.0);
}

/// Half-extents, NumSamples, MinSamples; counts as corrected; counts as printed and whether a guard had to answer.
type Row = (f32, f32, u32, u32, [u32; 2], [u32; 3]);

const COUNTS: [Row; 28] = [
    (0.0, 0.0, 16, 1, [1, 1], [1, 1, 0]),
    (0.4, 0.4, 16, 1, [1, 1], [1, 1, 0]),
    (0.75, 0.75, 16, 1, [2, 2], [2, 2, 0]),
    (1.0, 1.0, 16, 1, [2, 2], [2, 2, 0]),
    (1.5, 1.5, 16, 1, [3, 3], [3, 3, 0]),
    (2.0, 2.0, 16, 1, [4, 4], [4, 4, 0]),
    (3.0, 3.0, 16, 1, [4, 4], [4, 4, 0]),
    (3.0, 1.0, 16, 1, [6, 2], [6, 2, 0]),
    (7.9, 0.4, 16, 1, [16, 1], [16, 1, 0]),
    (39.0, 0.1, 16, 1, [16, 1], [16, 1, 0]),
    (8.0, 4.0, 16, 1, [5, 3], [5, 3, 0]),
    (4.0, 8.0, 16, 1, [3, 6], [3, 6, 0]),
    (6.0, 2.0, 16, 1, [8, 2], [8, 2, 0]),
    (2.0, 6.0, 16, 1, [2, 7], [2, 7, 0]),
    (20.0, 1.0, 16, 1, [16, 1], [16, 1, 0]),
    (1.0, 20.0, 16, 1, [1, 16], [1, 16, 0]),
    (20.0, 1.0, 16, 2, [8, 2], [16, 2, 0]),
    (1.0, 20.0, 16, 2, [2, 16], [1, 16, 0]),
    (0.5, 40.0, 16, 1, [1, 16], [1, 16, 1]),
    (40.0, 0.5, 16, 1, [16, 1], [16, 1, 1]),
    (1.0, 66.0, 16, 1, [1, 16], [1, 16, 0]),
    (66.0, 1.0, 16, 1, [16, 1], [16, 1, 1]),
    (70.0, 1.0, 16, 1, [16, 1], [16, 1, 1]),
    (1.0, 67.0, 16, 1, [1, 16], [1, 16, 1]),
    (24.0, 24.0, 64, 2, [8, 8], [8, 8, 0]),
    (3.0, 3.0, 4, 1, [2, 2], [2, 2, 0]),
    (3.0, 3.0, 1, 1, [1, 1], [1, 1, 0]),
    (5.25, 0.75, 16, 1, [11, 2], [11, 2, 0]),
];

#[test]
fn v02_to_v07_counts_corrected_and_as_printed_e_r5_e_r6_e_r7_e_r8() {
    for (a, b, n, m, corrected, [ns, nt, guarded]) in COUNTS {
        let ours = Jittered::default().with_num_samples(n).with_min_samples(m).counts(Vec2::new(a, b));
        assert_eq!(ours.to_array(), corrected, "({a}, {b}, {n}, {m})");
        assert_eq!(counts(a, b, n, m), Counts { ns, nt, guarded }, "({a}, {b}, {n}, {m})");
    }
}

#[test]
fn the_listing_is_total_whatever_its_parameters() {
    let map = map(16, |x, _| if x < 8 { 1.0 } else { f32::INFINITY });
    for (n, m) in [(0, 0), (0, 5), (16, 0), (4, 9), (1, 1)] {
        for half in [[0.0, 0.0], [0.001, 0.9], [0.9, 0.001], [0.2, 0.2], [1e9, 0.0]] {
            let listing = Listing { num_samples: n, min_samples: m, ..Listing::default() };
            let share = mean_printed(&listing, &map, [0.5; 2], 10.0, half, 3);
            assert!((0.0..=1.0).contains(&share), "{n}, {m}, {half:?}: {share}");
        }
    }
}

fn whole(size: i32) -> TextureRect {
    TextureRect { umin: 0, umax: size - 1, vmin: 0, vmax: size - 1 }
}

/// The listing over a map, averaged over many keys.
fn mean_printed(listing: &Listing, map: &Raw, at: [f32; 2], z: f32, size: [f32; 2], rounds: u32) -> f32 {
    let n = map.depths().len().isqrt() as i32;
    let sum: f32 = (0..rounds)
        .map(|round| {
            let (key, mut draw) = (KEY.region(round), 0);
            sample_shadow(listing, map, whole(n), at, z, size, || {
                draw += 1;
                key.unit(draw, 0)
            })
        })
        .sum();
    sum / rounds as f32
}

#[test]
fn v09_t_14_jitter_range_moves_the_shadow_e_r9() {
    // Everything at u ≥ 100 is shadowed; s = 100.25 texels, half-extent 2: four cells.
    let step = map(256, |x, _| if x >= 100 { 1.0 } else { f32::INFINITY });
    let listing = Listing { res_factor: 1.0, ..Listing::default() };
    let at = [100.25 / 256.0, 128.0 / 256.0];
    let mean = |rand| mean_printed(&Listing { rand, ..listing }, &step, at, 10.0, [2.0 / 256.0; 2], 40_000);
    assert!((mean(RandRange::Signed) - 0.5625).abs() < 1.5e-3);
    assert!((mean(RandRange::Unit) - 0.625).abs() < 1.5e-3);
    let corrected = Pcf::default().with_depth(Biased::constant(Bias::ZERO)).with_res_factor(1.0);
    let region = receiver(&lamp(256), 10.0, Vec2::new(100.25, 128.0), Vec2::splat(2.0));
    let shadow = ShadowMap { filter: corrected, map: step };
    // The standard error is 2.7e-4: four rows jittered in the one column that the edge crosses.
    let mean = (0..40_000).map(|i| shadow.fraction_of(&region, KEY.region(i))).sum::<f32>() / 40_000.0;
    assert!((mean - 0.5625).abs() < 1.5e-3, "{mean}");
}

#[test]
fn v10_e_r10_truncation_reads_column_0_for_samples_left_of_the_map() {
    let dark_edge = map(16, |x, _| if x == 0 { 1.0 } else { f32::INFINITY });
    let listing = Listing { num_samples: 1, res_factor: 1.0, bias0: 0.0, bias1: 0.0, ..Listing::default() };
    let printed = mean_printed(&listing, &dark_edge, [-0.4 / 16.0, 0.5], 10.0, [0.0, 0.0], 1);
    assert_eq!(printed, 1.0);
    let point = receiver(&lamp(16), 10.0, Vec2::new(-0.4, 8.0), Vec2::ZERO);
    assert_eq!(fraction(presets::ordinary(Bias::ZERO).filter, dark_edge, &point, KEY), 0.0);
}

#[test]
fn v11_v12_v13_v14_behind_and_empty_maps_are_lit_e_r11_e_r12_e_r14() {
    let near = map(16, |_, _| 1.0);
    let listing = Listing::default();
    assert_eq!(mean_printed(&listing, &near, [0.5; 2], -1.0, [0.1; 2], 1), 0.0);
    let behind = SurfacePoint::at(Vec3::new(0.0, 1.0, 0.0), Vec3::Y);
    assert_eq!(ShadowMap { filter: presets::reeves87().filter, map: near }.fraction(&behind, KEY), 0.0);
    let empty = map(16, |_, _| f32::INFINITY);
    let region = receiver(&lamp(16), 1e9, Vec2::splat(8.0), Vec2::splat(1.0));
    assert_eq!(fraction(presets::reeves87().filter, Tiled::from(&empty), &region, KEY), 0.0);
    // The listing: an empty rectangle, a region outside it, and nothing but empty texels.
    let nothing = TextureRect { umin: 16, umax: -1, vmin: 16, vmax: -1 };
    let two = TextureRect { umin: 0, umax: 1, vmin: 0, vmax: 1 };
    for (bbox, at) in [(nothing, 0.5), (two, 0.75), (whole(16), 0.5)] {
        assert_eq!(sample_shadow(&listing, &empty, bbox, [at; 2], 1e9, [0.05; 2], || 0.5), 0.0);
    }
    let corner = map(16, |x, y| if x < 2 && y < 2 { 1.0 } else { f32::INFINITY });
    assert_eq!(sample_shadow(&listing, &corner, two, [0.75; 2], 10.0, [0.02; 2], || 0.5), 0.0);
    assert_eq!(sample_shadow(&listing, &corner, two, [0.06; 2], 10.0, [0.001; 2], || 0.5), 1.0);
    let mut probe = Counters::default();
    let shadow = ShadowMap { filter: presets::reeves87().filter, map: umbrage_depth::Bbox::from(&corner) };
    let at = SurfacePoint::at(Vec3::new(4.0, -10.0, 4.0), Vec3::Y);
    let mut out = [f32::NAN];
    shadow.fractions_probed(&[at], KEY, &mut out, &mut probe);
    assert_eq!((out, probe.culled_lit, probe.lookups), ([0.0], 1, 0));
}

#[test]
fn v15_v23_bias_range_r87_14_e_r9() {
    let share = |stored: f32| {
        let flat = map(16, |_, _| stored);
        let region = receiver(&lamp(16), 10.0, Vec2::splat(8.0), Vec2::splat(1.0));
        let shadow = ShadowMap { filter: presets::reeves87().filter, map: flat };
        (0..4000).map(|i| shadow.fraction_of(&region, KEY.region(i))).sum::<f32>() / 4000.0
    };
    assert!((share(9.65) - 0.5).abs() < 0.01);
    assert!(share(9.7) < 1e-3);
    assert_eq!(share(9.59), 1.0);
    // With [−1, 1) for the bias as well the printed formula spans [.2, .4]: three quarters below .35.
    let flat = map(16, |_, _| 9.65);
    let listing = Listing { rand: RandRange::Signed, ..Listing::default() };
    let signed = mean_printed(&listing, &flat, [0.5; 2], 10.0, [1.0 / 16.0; 2], 2000);
    assert!((signed - 0.75).abs() < 0.01, "{signed}");
}

#[test]
fn a_ramp_spreads_the_bias_without_noise() {
    let flat = map(16, |_, _| 9.65);
    let depth = Biased::default().with_spread(Spread::Ramp);
    let region = receiver(&lamp(16), 10.0, Vec2::splat(8.0), Vec2::splat(1.0));
    let shadow = ShadowMap { filter: Pcf::default().with_depth(depth), map: flat };
    for round in 0..50 {
        assert_eq!(shadow.fraction_of(&region, KEY.region(round)), 0.5);
    }
}

#[test]
fn v24_r87_13_levels_are_multiples_of_the_region_s_own_count_t_20() {
    let edge = map(64, |x, _| if x < 32 { 1.0 } else { f32::INFINITY });
    for half in [Vec2::splat(2.0), Vec2::new(5.25, 0.75), Vec2::new(1.5, 9.0)] {
        let filter = Pcf::default().with_res_factor(1.0);
        let count = filter.pattern.counts(half).element_product() as f32;
        for step in 0..40 {
            let region = receiver(&lamp(64), 10.0, Vec2::new(30.0 + step as f32 * 0.1, 32.0), half);
            let levels = fraction(filter, edge.clone(), &region, KEY.region(step)) * count;
            assert!((levels - levels.round()).abs() < 1e-4, "{levels} of {count}");
        }
    }
}

#[test]
fn v21_d_13_a_straight_edge_becomes_a_ramp_of_the_region_s_width() {
    let edge = map(64, |x, _| if x < 32 { 1.0 } else { f32::INFINITY });
    let pattern = Uniform::default().with_num_samples(65_536);
    let filter =
        Pcf::default().with_pattern(pattern).with_depth(Biased::default()).with_res_factor(1.0).with_min_size(0.0);
    let share = |x: f32| {
        let region = receiver(&lamp(64), 10.0, Vec2::new(x, 32.0), Vec2::new(1.0, 1.0));
        fraction(filter, edge.clone(), &region, KEY)
    };
    // 2 texels wide in all, 1.6 from 90 to 10 %.
    for (x, want) in [(30.9, 1.0), (31.2, 0.9), (32.0, 0.5), (32.8, 0.1), (33.1, 0.0)] {
        assert!((share(x) - want).abs() < 0.01, "{x}: {}", share(x));
    }
}

#[test]
fn v32_samples_outside_a_cone_are_dark_for_a_spot_w92_6_e_r13() {
    // A lit map; the region's left quarter lies outside the map, or outside the cone inside it.
    let lit = |view: View| Raw::new(view, vec![f32::INFINITY; 64 * 64]).unwrap();
    let filter = Pcf::default().with_res_factor(1.0);
    let outside = receiver(&lamp(64), 10.0, Vec2::new(2.0, 32.0), Vec2::splat(4.0));
    assert_eq!(fraction(filter, lit(lamp(64).with_rules(Rules::OPEN)), &outside, KEY), 0.0);
    assert_eq!(fraction(filter, lit(lamp(64).with_rules(Rules::SPOT)), &outside, KEY), 0.25);
    // The cone of 75° in a map of 90°: its rim crosses the middle row at 32 − 32 · tan 37.5° = 7.4455.
    let tan_half = 37.5f64.to_radians().tan();
    assert!((tan_half - 0.767_327).abs() < 1e-6);
    let cone = lamp(64).with_cone(Some(37.5f64.to_radians().cos())).unwrap();
    let rim = receiver(&lamp(64), 10.0, Vec2::new(7.4455 + 0.1, 32.0), Vec2::new(0.2, 0.01));
    let mean = |rules| {
        (0..400).map(|i| fraction(filter, lit(cone.with_rules(rules)), &rim, KEY.region(i))).sum::<f32>() / 400.0
    };
    assert_eq!(mean(Rules::OPEN), 0.0);
    assert!((mean(Rules::SPOT) - 0.25).abs() < 0.08, "{}", mean(Rules::SPOT));
    let beyond = receiver(&lamp(64), 10.0, Vec2::new(5.0, 32.0), Vec2::splat(0.5));
    assert_eq!(fraction(filter, lit(cone.with_rules(Rules::SPOT)), &beyond, KEY), 1.0);
}

#[test]
fn v33_t_4_ranges_settle_a_region_only_when_they_may_r87_22() {
    let tile = Tiled::from(&map(32, |x, _| if x % 2 == 0 { 40.0 } else { 50.0 }));
    let holed = Tiled::from(&map(32, |x, _| if x == 31 { f32::INFINITY } else { 45.0 }));
    let empty = Tiled::from(&map(32, |_, _| f32::INFINITY));
    let settled = |map: &Tiled, z: f32| {
        let region = receiver(&lamp(32), z, Vec2::splat(16.0), Vec2::splat(2.0));
        let mut probe = Counters::default();
        let ask = |filter: Pcf, probe: &mut Counters| ShadowMap { filter, map }.fraction_of_probed(&region, KEY, probe);
        let answer = ask(presets::reeves87().filter, &mut probe);
        assert_eq!(answer, ask(presets::reeves87().filter.with_cull(false), &mut Counters::default()), "z = {z}");
        (probe.lookups == 0).then_some(answer)
    };
    let expected = [
        (60.0, Some(1.0)),
        (50.41, Some(1.0)),
        (50.40, None),
        (50.35, None),
        (40.30, Some(0.0)),
        (40.31, None),
        (45.0, None),
    ];
    for (z, want) in expected {
        assert_eq!(settled(&tile, z), want, "z = {z}");
    }
    assert_eq!(settled(&empty, 60.0), Some(0.0));
    // One empty texel forbids the dark shortcut, not the lit one.
    assert_eq!(settled(&holed, 60.0), None);
    assert_eq!(settled(&holed, 45.0), Some(0.0));
}

#[test]
fn r87_22_culling_changes_no_bit() {
    // Full tiles on the left, tiles with holes on the right: both shortcuts are taken.
    let bumpy = |x: u32, y: u32| match (x / 7 + y / 5) % 4 {
        0 if x >= 64 => f32::INFINITY,
        n => 9.0 + n as f32 * 0.4 + (x % 3) as f32 * 0.05,
    };
    let tiled = Tiled::from(&map(128, bumpy));
    let mut probe = Counters::default();
    for (index, half) in [0.3, 2.0, 7.0, 20.0].into_iter().enumerate() {
        for step in 0..500u32 {
            let key = KEY.region(step);
            let centre = Vec2::new(key.unit(0, 0), key.unit(0, 1)) * 140.0 - 6.0;
            let region = receiver(&lamp(128), 8.8 + 2.5 * key.unit(0, 2), centre, Vec2::splat(half));
            let constant = Pcf::default().with_res_factor(1.0);
            let depth = OnPlane::biased(Bias::World(0.1));
            let plane =
                Pcf::default().with_pattern(constant.pattern).with_depth(depth).with_res_factor(1.0).with_min_size(0.0);
            let pairs = [
                (
                    asked(&constant, &tiled, &region, key, &mut probe),
                    fraction(constant.with_cull(false), tiled.clone(), &region, key),
                ),
                (
                    asked(&plane, &tiled, &region, key, &mut probe),
                    fraction(plane.with_cull(false), tiled.clone(), &region, key),
                ),
            ];
            for (cut, uncut) in pairs {
                assert_eq!(cut.to_bits(), uncut.to_bits(), "set {index}, step {step}");
            }
        }
    }
    assert!(probe.culled_lit > 300 && probe.culled_dark > 300 && probe.sampled > 300, "{probe:?}");
}

fn asked<F: Filter>(filter: &F, map: &Tiled, receiver: &Receiver, key: Key, probe: &mut Counters) -> f32 {
    ShadowMap { filter, map }.fraction_of_probed(receiver, key, probe)
}

#[test]
#[should_panic(expected = "kinds of a receiver's depth and of the map's")]
fn c_4_a_receiver_of_another_kind_is_refused() {
    let screen = lamp(16).with_kind(Kind::Screen);
    let region = receiver(&screen, 10.0, Vec2::splat(8.0), Vec2::splat(1.0));
    fraction(presets::reeves87().filter, map(16, |_, _| 1.0), &region, KEY);
}

#[test]
fn r87_2_light_space_is_a_signed_axial_distance() {
    let view = lamp(16);
    // Off the axis the distance along it counts, not the distance from the light; behind it there is no receiver.
    let receiver = view.receiver(&SurfacePoint::at(Vec3::new(6.0, -8.0, 3.0), Vec3::Y)).unwrap();
    assert_eq!((receiver.kind, receiver.depth), (Kind::Axial, 8.0));
    assert_eq!(view.receiver(&SurfacePoint::at(Vec3::new(6.0, 8.0, 3.0), Vec3::Y)), Err(Place::Behind));
}

fn mean(pattern: impl umbrage_sample::Pattern, map: &Raw, region: &Receiver) -> f32 {
    let filter = Pcf::default()
        .with_pattern(pattern)
        .with_depth(Biased::default())
        .with_res_factor(1.0)
        .with_min_size(0.0)
        .with_cull(false);
    let shadow = ShadowMap { filter, map: map.clone() };
    (0..4000).map(|i| shadow.fraction_of(region, KEY.region(i))).sum::<f32>() / 4000.0
}

#[test]
fn r87_11_every_pattern_agrees_with_the_exhaustive_share_in_the_mean() {
    let checks = map(64, |x, y| if (x / 4 + y / 4) % 2 == 0 { 1.0 } else { f32::INFINITY });
    let region = receiver(&lamp(64), 10.0, Vec2::splat(32.0), Vec2::splat(8.0));
    let jittered = Jittered::default();
    let means = [
        mean(EveryTexel, &checks, &region),
        mean(jittered, &checks, &region),
        mean(Uniform::default().with_num_samples(16), &checks, &region),
        mean(Gaussian::default().with_num_samples(16), &checks, &region),
        mean(InsideQuadReject(jittered), &checks, &region),
        mean(InsideQuadWarp(jittered), &checks, &region),
    ];
    for (index, mean) in means.into_iter().enumerate() {
        assert!((mean - 0.5).abs() < 0.01, "pattern {index}: {mean}");
    }
}

#[test]
fn e_r3_full_sizes_halve_the_window_and_e_r4_is_a_no_op_when_read_as_printed() {
    let edge = map(64, |x, _| if x >= 32 { 1.0 } else { f32::INFINITY });
    let listing = Listing { res_factor: 1.0, rand: RandRange::Signed, num_samples: 64, ..Listing::default() };
    let at = [34.0 / 64.0, 0.5];
    let half = mean_printed(&listing, &edge, at, 10.0, [4.0 / 64.0; 2], 2000);
    let full = Listing { footprint: FootprintConvention::FullSize, ..listing };
    let full = mean_printed(&full, &edge, at, 10.0, [4.0 / 64.0; 2], 2000);
    assert!((half - 0.75).abs() < 0.01 && full > 0.99, "{half} {full}");
    let tall = map(64, |_, y| if y >= 32 { 1.0 } else { f32::INFINITY });
    let sized = Listing { min_size: 4.0, ..listing };
    let at = [0.5, 33.0 / 64.0];
    let assigned = mean_printed(&sized, &tall, at, 10.0, [0.0; 2], 2000);
    let noop = mean_printed(&Listing { e_r4_noop: true, ..sized }, &tall, at, 10.0, [0.0; 2], 2000);
    assert!((assigned - 0.625).abs() < 0.02 && noop == 1.0, "{assigned} {noop}");
}

#[test]
fn r87_26_anything_can_be_filtered_after_its_transform() {
    // V59's order of operations in small: the mean of a square is not the square of the mean.
    let region = Footprint::boxed(Vec2::splat(8.0), Vec2::splat(4.0));
    let square: f32 = umbrage_shadow::weighted_mean(&EveryTexel, &region, KEY, |tap| tap.at.x * tap.at.x);
    let mean: f32 = umbrage_shadow::weighted_mean(&EveryTexel, &region, KEY, |tap| tap.at.x);
    assert!((square - mean * mean - 5.25).abs() < 1e-3, "{square} {mean}");
}

#[test]
fn scaling_the_world_and_the_bias_alike_changes_nothing() {
    for scale in [0.25f32, 4.0, 1024.0] {
        let make = |scale: f32| {
            let map = map(64, |x, y| (8.0 + ((x * 7 + y * 3) % 11) as f32 * 0.1) * scale);
            let filter = Pcf::default().with_depth(Biased::world(0.25 * scale, 0.5 * scale));
            let region = receiver(&lamp(64), 9.0 * scale, Vec2::splat(30.3), Vec2::splat(1.7));
            fraction(filter, map, &region, KEY)
        };
        assert_eq!(make(1.0), make(scale));
    }
}
