//! Woo 1992: the rule of the cone, the listing without bias, and whole units before fractions (W92-5 to W92-10).

use glam::{DVec3, UVec2, Vec2, Vec3};
use proptest::prelude::*;
use umbrage_depth::{DepthMap, Raw};
use umbrage_plane::{Bias, Footprint, Place, Receiver, Rules, SurfacePoint, TexelRect, View};
use umbrage_sample::{EveryTexel, InsideQuadWarp, Jittered, Key, Pattern, Tent};
use umbrage_shadow::as_printed::{Listing, RandRange, TextureRect, sample_shadow};
use umbrage_shadow::integer_first::{behind, whole};
use umbrage_shadow::{Biased, Counters, Filter, IntegerFirst, Pcf, Probe, Shadow, ShadowMap, presets};

const KEY: Key = Key::new(92, 0, 0);

/// At the origin, looking down −y, 90° wide.
fn lamp(size: u32) -> View {
    let fov = 90f64.to_radians();
    View::perspective(DVec3::ZERO, DVec3::NEG_Y, DVec3::NEG_Z, fov, 0.1, 1000.0, UVec2::splat(size)).unwrap()
}

fn map(view: &View, depth: impl Fn(i32, i32) -> f32) -> Raw {
    let texels = TexelRect::of_size(view.size()).texels();
    Raw::new(*view, texels.map(|texel| depth(texel.x, texel.y)).collect()).unwrap()
}

/// At depth 10, facing the lamp, with the image `centre ± half`.
fn receiver(view: &View, centre: Vec2, half: Vec2) -> Receiver {
    let world = view.world_at(centre.as_dvec2(), view.key(10.0));
    let seen = view.receiver(&SurfacePoint::at(world.as_vec3(), Vec3::Y)).unwrap();
    Receiver { footprint: Footprint::boxed(centre, half), depth: 10.0, ..seen }
}

fn ask<F: Filter>(filter: &F, map: &impl DepthMap, receiver: &Receiver, key: Key, probe: &mut impl Probe) -> f32 {
    ShadowMap { filter, map }.fraction_of_probed(receiver, key, probe)
}

fn exhaustive() -> Pcf<EveryTexel, Biased> {
    Pcf::default()
        .with_pattern(EveryTexel)
        .with_depth(Biased::constant(Bias::ZERO))
        .with_res_factor(1.0)
        .with_min_size(0.0)
}

#[test]
fn v32_w92_6_four_of_sixteen_samples_outside_the_square_or_the_circle() {
    // Nothing is stored: all that is dark is dark by the rule.
    let share = |view: &View, rules, centre| {
        let view = view.with_rules(rules);
        ask(&exhaustive(), &map(&view, |_, _| f32::INFINITY), &receiver(&view, centre, Vec2::splat(2.0)), KEY, &mut ())
    };
    let (square, circle) = (lamp(64), lamp(64).with_cone(Some(0.5_f64.atan().cos())).unwrap());
    for (view, centre) in [(&square, Vec2::new(63.0, 32.0)), (&circle, Vec2::new(47.0, 32.0))] {
        assert_eq!(share(view, Rules::OPEN, centre), 0.0, "Reeves'");
        assert_eq!(share(view, Rules::SPOT, centre), 0.25, "Woo's");
        assert_eq!(share(view, Rules::SPOT, centre - Vec2::X), 0.0, "just inside");
    }
}

#[test]
fn v32_w92_6_the_inscribed_cone_is_a_quarter_of_pi_of_the_map() {
    let fov = 75f64.to_radians();
    let tan = 37.5f64.to_radians().tan();
    assert!((tan - 0.767_327).abs() < 1e-6);
    let view = View::perspective(DVec3::ZERO, DVec3::NEG_Y, DVec3::NEG_Z, fov, 1.0, 100.0, UVec2::splat(1024)).unwrap();
    let inside = |view: &View| {
        let texels = TexelRect::of_size(view.size()).texels();
        let found = texels.filter(|texel| view.locate(texel.as_vec2() + 0.5) == Place::Inside).count();
        found as f64 / (1024.0 * 1024.0)
    };
    assert_eq!(inside(&view), 1.0);
    assert!(
        (inside(&view.with_cone(Some(37.5f64.to_radians().cos())).unwrap()) - std::f64::consts::FRAC_PI_4).abs() < 2e-4
    );
}

#[test]
fn w92_6_regions_wholly_outside_and_points_behind_are_dark_under_a_spot() {
    let view = lamp(64).with_cone(Some(0.5_f64.atan().cos())).unwrap();
    let fraction = |rules, at: Vec3| {
        let map = map(&view.with_rules(rules), |_, _| f32::INFINITY);
        ShadowMap { filter: presets::woo92().filter, map }.fraction(&SurfacePoint::at(at, Vec3::Y), KEY)
    };
    for outside in [Vec3::new(6.0, -10.0, 6.0), Vec3::new(30.0, -10.0, 0.0), Vec3::new(0.0, 5.0, 0.0)] {
        assert_eq!(fraction(Rules::SPOT, outside), 1.0, "{outside}");
        assert_eq!(fraction(Rules::OPEN, outside), 0.0, "{outside}");
    }
    assert_eq!(fraction(Rules::SPOT, Vec3::new(4.9, -10.0, 0.0)), 0.0);
}

#[test]
fn w92_3_w92_5_the_preset_has_no_bias_and_draws_none() {
    let view = lamp(64);
    let stored = map(&view, |_, _| 10.0);
    let region = receiver(&view, Vec2::splat(30.3), Vec2::splat(3.0));
    let answer = |depth| ask(&presets::woo92().filter, &stored, &Receiver { depth, ..region }, KEY, &mut ());
    assert_eq!((answer(10.0), answer(10f32.next_up())), (0.0, 1.0));
    // Any bias can be set nevertheless.
    let biased = presets::woo92().filter.with_depth(Biased::constant(Bias::World(0.5)));
    let answer = |depth| ask(&biased, &stored, &Receiver { depth, ..region }, KEY, &mut ());
    assert_eq!((answer(10.5), answer(10.5f32.next_up())), (0.0, 1.0));
    // A midpoint between two surfaces lights the first and darkens the second: 9 and 11 around 10.
    assert_eq!(ask(&presets::woo92().filter, &stored, &Receiver { depth: 9.0, ..region }, KEY, &mut ()), 0.0);
    assert_eq!(ask(&presets::woo92().filter, &stored, &Receiver { depth: 11.0, ..region }, KEY, &mut ()), 1.0);
}

/// The archived listing over a map, its random numbers all in the middle of their range.
fn archived(gg_bbox_rule: bool, map: &Raw, bbox: TextureRect, centre: [f32; 2], z: f32) -> f32 {
    let listing = Listing {
        gg_bbox_rule,
        rand: RandRange::Signed,
        res_factor: 1.0,
        bias0: 0.0,
        bias1: 0.0,
        ..Listing::default()
    };
    sample_shadow(&listing, map, bbox, centre.map(|at| at / 64.0), z, [2.0 / 64.0; 2], || 0.5)
}

#[test]
fn w92_10_t_3_the_archived_rule_is_right_for_the_light_s_box_and_wrong_for_the_finite_one() {
    let whole = TextureRect { umin: 0, umax: 63, vmin: 0, vmax: 63 };
    let finite = TextureRect { umin: 10, umax: 19, vmin: 10, vmax: 19 };
    let patch = map(&lamp(64), |x, y| if (10..20).contains(&x) && (10..20).contains(&y) { 5.0 } else { f32::INFINITY });
    let rim = [63.0, 32.0];
    assert_eq!((archived(true, &patch, whole, rim, 10.0), archived(false, &patch, whole, rim, 10.0)), (0.25, 0.0));
    // The same background under the box of the finite depths: all dark, which is wrong.
    let background = [40.0, 40.0];
    assert_eq!(
        (archived(true, &patch, whole, background, 10.0), archived(true, &patch, finite, background, 10.0)),
        (0.0, 1.0)
    );
    // Places behind the light are not treated separately: inside the box it is compared, and so lit; outside it is dark.
    assert_eq!(
        (archived(true, &patch, whole, background, -1.0), archived(true, &patch, finite, background, -1.0)),
        (0.0, 1.0)
    );
    assert_eq!(archived(false, &patch, finite, background, -1.0), 0.0);
}

#[test]
fn v34_w92_7_pairs_by_whole_units_first() {
    assert_eq!(behind(7.9, 8.1, 1.0), (false, true));
    assert_eq!(behind(8.9, 8.1, 1.0), (true, false));
    assert!(!behind(-0.5, 0.5, 1.0).0 && behind(0.5, -0.5, 1.0).0);
    assert_eq!(behind(5.0, f32::INFINITY, 1.0), (false, true));
    assert_eq!(behind(f32::INFINITY, f32::INFINITY, 1.0), (false, false));
    let mut tied = 0u32;
    for i in 0..1_000_000 {
        let (receiver, stored) = (KEY.unit(i, 0) * 100.0, KEY.unit(i, 1) * 100.0);
        let (dark, conclusive) = behind(receiver, stored, 1.0);
        assert_eq!(dark, receiver > stored);
        tied += u32::from(!conclusive);
    }
    let share = f64::from(tied) / 1e6;
    assert!((share - 0.0100).abs() < 0.001, "inconclusive {share}");
}

/// Depths of every sort, those next to whole numbers and each other among them.
fn depths() -> impl Strategy<Value = f32> {
    prop_oneof![
        any::<u32>().prop_map(f32::from_bits),
        -100.0f32..100.0,
        (-20i32..20, -2i32..=2).prop_map(|(whole, steps)| {
            let whole = whole as f32;
            (0..steps.abs()).fold(whole, |at, _| if steps > 0 { at.next_up() } else { at.next_down() })
        }),
        prop_oneof![
            Just(f32::INFINITY),
            Just(f32::NEG_INFINITY),
            Just(f32::NAN),
            Just(-0.0),
            Just(f32::MAX),
            Just(f32::MIN)
        ],
    ]
}

fn units() -> impl Strategy<Value = f32> {
    prop_oneof![Just(1.0f32), Just(f32::MIN_POSITIVE), Just(1e-45), Just(f32::MAX), Just(f32::INFINITY), 1e-6f32..1e6]
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(20_000))]

    #[test]
    fn w92_7_whole_units_first_equals_fractions_for_all_inputs(receiver in depths(), stored in depths(), unit in units()) {
        prop_assert_eq!(behind(receiver, stored, unit).0, receiver > stored);
    }

    #[test]
    fn w92_7_whole_units_never_decrease(a in depths(), b in depths(), unit in units()) {
        let (low, high) = (a.min(b), a.max(b));
        prop_assert!(low.is_nan() || whole(low, unit) <= whole(high, unit));
    }
}

fn agrees<P: Pattern + Copy>(pattern: P, unit: f32) {
    let close =
        |i: u32| [9.5, 10.0, 10f32.next_up(), 10f32.next_down(), 10.4, 40.0, 2.0, f32::INFINITY][i as usize % 8];
    let view = lamp(64).with_rules(Rules::SPOT).with_cone(Some(0.8_f64.atan().cos())).unwrap();
    let stored = map(&view, |x, y| close(KEY.bits((x * 64 + y) as u32, 5)));
    let integer = IntegerFirst::default().with_pattern(pattern).with_res_factor(1.5).with_min_size(0.5).with_unit(unit);
    let float = Pcf::default()
        .with_pattern(pattern)
        .with_depth(Biased::constant(Bias::ZERO))
        .with_res_factor(1.5)
        .with_min_size(0.5);
    let mut counters = Counters::default();
    for i in 0..3000 {
        let at = Vec2::new(KEY.unit(i, 0), KEY.unit(i, 1)) * 80.0 - 8.0;
        let seen = receiver(&view, at, Vec2::splat(KEY.unit(i, 2) * 4.0));
        let corners = [(-1.0, -0.3), (0.4, -1.0), (1.0, 0.5), (-0.2, 1.0)].map(|(x, y)| at + Vec2::new(x, y) * 3.0);
        let seen = if i % 2 == 0 { seen } else { Receiver { footprint: Footprint::around(corners), ..seen } };
        let found = ask(&integer, &stored, &seen, KEY.region(i), &mut counters);
        let wanted = ask(&float, &stored, &seen, KEY.region(i), &mut ());
        assert_eq!(found.to_bits(), wanted.to_bits(), "{i}: {found} {wanted}");
    }
    assert_eq!(counters.conclusive + counters.inconclusive, counters.lookups);
    assert!(unit != 1.0 || (counters.conclusive > 0 && counters.inconclusive > 0));
}

#[test]
fn w92_7_as_a_filter_it_is_pcf_without_bias_bit_for_bit() {
    for unit in [1.0, 1e-3, 1e30] {
        agrees(Jittered::default(), unit);
        agrees(EveryTexel, unit);
        agrees(Tent, unit);
        agrees(InsideQuadWarp::default(), unit);
    }
}

#[test]
fn w92_7_the_printed_preset_and_its_defaults() {
    let woo = presets::woo92().filter;
    assert_eq!(woo.depth, Biased::constant(Bias::ZERO));
    let integer = IntegerFirst::default();
    assert_eq!((integer.pattern, integer.res_factor, integer.min_size), (woo.pattern, woo.res_factor, woo.min_size));
    assert_eq!(integer.unit, 1.0);
}
