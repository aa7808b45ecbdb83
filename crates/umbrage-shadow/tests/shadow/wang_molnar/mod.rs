//! Wang & Molnar 1994: the rule of the nearby texels, the virtual samples, and the listing as printed (WM94-4 to WM94-15).

use glam::{DVec2, DVec3, IVec2, UVec2, Vec2, Vec3};
use proptest::prelude::*;
use umbrage_depth::{DepthMap, Raw};
use umbrage_plane::{Bias, Footprint, Kind, Receiver, Rules, SurfacePoint, TexelRect, View};
use umbrage_sample::{EveryTexel, Key, Pattern, Tent};
use umbrage_shadow::as_printed::{Division, percent_illumination};
use umbrage_shadow::{Biased, Conditional, Counters, Filter, OnPlane, Pcf, Probe, ShadowMap, VirtualWhen, presets};

mod planes;

use planes::random_plane;

const KEY: Key = Key::new(94, 0, 0);

/// The light of V35: at (0, 10, 0), looking down −y, 90° wide, from 1 to 100.
fn lamp(size: u32) -> View {
    let fov = 90f64.to_radians();
    View::perspective(DVec3::Y * 10.0, DVec3::ZERO, DVec3::NEG_Z, fov, 1.0, 100.0, UVec2::splat(size)).unwrap()
}

/// Parallel rays down −y from (0, 10, 0); a texel is a world unit wide.
fn sun(size: u32) -> View {
    let half = 0.5 * f64::from(size);
    View::orthographic(DVec3::Y * 10.0, DVec3::ZERO, DVec3::NEG_Z, half, 0.0, 50.0, UVec2::splat(size)).unwrap()
}

fn map(view: &View, depth: impl Fn(IVec2) -> f32) -> Raw {
    Raw::new(*view, TexelRect::of_size(view.size()).texels().map(depth).collect()).unwrap()
}

/// The plane of a receiver, as the map stores it.
fn sheet(view: &View, receiver: &Receiver) -> Raw {
    let plane = receiver.plane(view);
    map(view, |texel| plane.at(view.sampling().position(texel)))
}

/// Under `sun`: at a texel position, of a depth that grows by `gradient` from texel to texel.
fn tilted(view: &View, at: DVec2, depth: f64, gradient: DVec2) -> Receiver {
    let world = view.world_at(at, view.key(depth));
    let seen = view.receiver(&SurfacePoint::at(world.as_vec3(), Vec3::Y)).unwrap();
    let normal = DVec3::new(gradient.x, -gradient.y, 1.0);
    let eye = view.world_to_eye().transform_point3(world);
    Receiver { normal, eye, depth: depth as f32, facing: normal.normalize().z as f32, ..seen }
}

fn probed<F: Filter>(filter: &F, map: &impl DepthMap, receiver: &Receiver) -> (f32, Counters) {
    let mut counters = Counters::default();
    (ask(filter, map, receiver, KEY, &mut counters), counters)
}

fn ask<F: Filter>(filter: &F, map: &impl DepthMap, receiver: &Receiver, key: Key, probe: &mut impl Probe) -> f32 {
    ShadowMap { filter, map }.fraction_of_probed(receiver, key, probe)
}

#[test]
fn v55_as_printed_e_m2_e_m3() {
    let second = [5.0, 5.0, 9.0, 9.0];
    let flat = [4.9, 5.0, 8.9, 9.0];
    assert_eq!(percent_illumination(6.0, &second, &flat, Division::Float), 0.5);
    assert_eq!(percent_illumination(6.0, &second, &flat, Division::Integer), 0.0);
    for division in [Division::Float, Division::Integer] {
        // The first test is ≤, and settles it without a plane.
        assert_eq!(percent_illumination(5.0, &second, &[100.0; 4], division), 1.0);
        assert_eq!(percent_illumination(9.1, &second, &[0.0; 4], division), 0.0);
        assert_eq!(percent_illumination(6.0, &[], &[], division), 0.0);
    }
    assert_eq!(percent_illumination(6.0, &[f32::INFINITY, 5.0], &[7.0, 7.0], Division::Float), 0.5);
}

#[test]
fn v55_wm94_5_mixed_texels_ask_the_plane_and_equality_is_lit_there() {
    let view = sun(16);
    let second = |texel: IVec2| if texel.y < 8 { 5.0 } else { 9.0 };
    // Exact in binary, so that nothing but equality is tested: 4.75, 5, 8.75, 9.
    let exact = tilted(&view, DVec2::new(8.0, 7.78125), 6.0, DVec2::new(0.25, 4.0));
    let plane = exact.plane(&view);
    let at = |x, y| plane.at(view.sampling().position(IVec2::new(x, y)));
    assert_eq!([at(7, 7), at(8, 7), at(7, 8), at(8, 8)], [4.75, 5.0, 8.75, 9.0]);
    let strictly = presets::wang_molnar94().filter.with_plane(OnPlane::default());
    for filter in [strictly, presets::wang_molnar94().filter] {
        let (fraction, counters) = probed(&filter, &map(&view, second), &exact);
        assert_eq!((fraction, counters.virtual_sampled), (0.0, 1));
    }
    // The paper's numbers with .1, whose rounding the slack covers. Plain comparison says a half.
    let tenth = tilted(&view, DVec2::new(8.0, 7.7625), 6.0, DVec2::new(0.1, 4.0));
    assert_eq!(probed(&presets::wang_molnar94().filter, &map(&view, second), &tenth).0, 0.0);
    let never = presets::wang_molnar94().filter.with_when(VirtualWhen::Never);
    assert_eq!(probed(&never, &map(&view, second), &tenth).0, 0.5);
    // A quarter of the texels really hide it.
    let hidden = |texel| if texel == IVec2::new(7, 7) { 3.0 } else { second(texel) };
    assert_eq!(probed(&presets::wang_molnar94().filter, &map(&view, hidden), &tenth).0, 0.25);
    // All agree: no plane is fitted.
    for (depth, wanted) in [(5.0, 0.0), (9.5, 1.0)] {
        let (fraction, counters) =
            probed(&presets::wang_molnar94().filter, &map(&view, second), &Receiver { depth, ..tenth });
        assert_eq!((fraction, counters.virtual_sampled), (wanted, 0), "{depth}");
    }
}

fn depths() -> impl Strategy<Value = f32> {
    prop_oneof![
        Just(f32::INFINITY),
        Just(6.0f32),
        Just(6f32.next_up()),
        Just(6f32.next_down()),
        0.5f32..12.0,
        (5.9999f32..6.0001)
    ]
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(4000))]

    /// The texels disagree exactly when the receiver lies behind the nearest and not behind the farthest.
    #[test]
    fn wm94_5_planes_are_asked_between_the_nearest_and_the_farthest_only(
        stored in prop::array::uniform4(depths()), depth in depths(), x in -0.49f64..0.49, y in -0.49f64..0.49, bias in 0.0f32..0.1,
    ) {
        prop_assume!(depth.is_finite());
        let view = sun(16);
        let filled = map(&view, |texel| match (texel - 7).to_array() {
            [x @ 0..=1, y @ 0..=1] => stored[(y * 2 + x) as usize],
            _ => 0.01,
        });
        let receiver = tilted(&view, DVec2::new(8.0 + x, 8.0 + y), f64::from(depth), DVec2::new(0.3, -0.2));
        let plane = OnPlane::default().with_bias(Bias::World(bias)).with_slack(1.0);
        let (fraction, counters) = probed(&presets::wang_molnar94().filter.with_plane(plane), &filled, &receiver);
        let compared = receiver.nearer(&view, Bias::World(bias));
        let (min, max) = (stored.into_iter().fold(f32::INFINITY, f32::min), stored.into_iter().fold(0.0, f32::max));
        prop_assert_eq!(counters.virtual_sampled == 1, min < compared && compared <= max);
        prop_assert!((0.0..=1.0).contains(&fraction));
        if counters.virtual_sampled == 0 {
            prop_assert_eq!(fraction, if compared > max { 1.0 } else { 0.0 });
        }
    }
}

/// The weight of each texel: what the fraction is when it alone is dark.
fn weights<P: Pattern>(filter: &Conditional<P>, centre: Vec2, half: Vec2) -> Vec<(IVec2, f32)> {
    let view = sun(48);
    let at = tilted(&view, centre.as_dvec2(), 6.0, DVec2::ZERO);
    let receiver = Receiver { footprint: Footprint::boxed(centre, half), ..at };
    let around = TexelRect::around(centre, Vec2::splat(7.0));
    let alone = |dark: IVec2| probed(filter, &map(&view, |texel| if texel == dark { 1.0 } else { 9.0 }), &receiver).0;
    around.texels().map(|texel| (texel, alone(texel))).filter(|(_, weight)| *weight > 0.0).collect()
}

#[test]
fn wm94_6_nearby_texels_which_and_how_many() {
    let nearest = presets::wang_molnar94().filter;
    let centre = Vec2::new(20.3, 21.6);
    let boxed = |n: u32| nearest.with_min_size(0.5 * n as f32);
    let region = nearest.with_res_factor(1.0);
    for (name, filter, half, min, columns, rows) in [
        ("nearest four", nearest, Vec2::ZERO, IVec2::new(19, 21), 2, 2),
        ("nearest four of a large region", nearest, Vec2::splat(5.0), IVec2::new(19, 21), 2, 2),
        ("box 3", boxed(3), Vec2::ZERO, IVec2::new(19, 20), 3, 3),
        ("box 4", boxed(4), Vec2::ZERO, IVec2::new(18, 20), 4, 4),
        ("box 9", boxed(9), Vec2::ZERO, IVec2::new(16, 17), 9, 9),
        ("region", region, Vec2::new(2.5, 1.5), IVec2::new(18, 20), 5, 3),
        ("small region", region, Vec2::splat(0.1), IVec2::new(19, 21), 2, 2),
    ] {
        let found = weights(&filter, centre, half);
        let wanted = TexelRect::new(min, min + IVec2::new(columns, rows));
        let equal = 1.0 / (columns * rows) as f32;
        assert_eq!(found, wanted.texels().map(|texel| (texel, equal)).collect::<Vec<_>>(), "{name}");
    }
}

#[test]
fn wm94_6_tent_weighs_the_nearest_four_as_bilinear_interpolation_does() {
    let Conditional { res_factor, min_size, plane, min_cos, when, dark_backs, .. } = presets::wang_molnar94().filter;
    let filter = Conditional::default()
        .with_pattern(Tent)
        .with_res_factor(res_factor)
        .with_min_size(min_size)
        .with_plane(plane)
        .with_min_cos(min_cos)
        .with_when(when)
        .with_dark_backs(dark_backs);
    for step in 0..50 {
        let centre = Vec2::new(20.0 + KEY.unit(step, 0), 21.0 + KEY.unit(step, 1));
        let corner = (centre - 0.5).floor();
        let share = centre - 0.5 - corner;
        let found = weights(&filter, centre, Vec2::ZERO);
        assert_eq!(found.len(), 4);
        for (texel, weight) in found {
            let far = (texel - corner.as_ivec2()).as_vec2();
            let side = |far: f32, share: f32| if far == 1.0 { share } else { 1.0 - share };
            let wanted = side(far.x, share.x) * side(far.y, share.y);
            assert!((weight - wanted).abs() < 4e-6, "{texel} of {centre}: {weight}, want {wanted}");
        }
    }
}

#[test]
fn wm94_13_one_bias_serves_both_tests() {
    let view = sun(16);
    let at = tilted(&view, DVec2::new(8.2, 8.1), 6.0, DVec2::new(0.5, 0.25));
    let own = sheet(&view, &at);
    let pushed = Receiver { depth: 6.5, eye: at.eye - DVec3::Z * 0.5, ..at };
    let with = |bias| presets::wang_molnar94().filter.with_plane(OnPlane::default().with_bias(bias).with_slack(1.0));
    assert_eq!(probed(&with(Bias::World(0.4)), &own, &pushed).0, 1.0);
    assert_eq!(probed(&with(Bias::World(0.6)), &own, &pushed).0, 0.0);
    assert_eq!(presets::wang_molnar94().filter.plane.bias, Bias::ZERO);
}

#[test]
fn wm94_13_only_sheets_and_no_planes_is_percentage_closer_filtering() {
    for kind in [Kind::Axial, Kind::Screen] {
        let view = lamp(64).with_kind(kind);
        for i in 0..500 {
            let Some((exact, receiver)) = random_plane(&view, i, 0.05, 1.0) else { continue };
            let stored = sheet(&view, &exact);
            let bias = [Bias::ZERO, Bias::World(0.05), Bias::Steps(0.5), Bias::Map(1e-3)][i as usize % 4];
            let half = Vec2::new(KEY.unit(i, 7), KEY.unit(i, 8)) * 4.0;
            let receiver = Receiver { footprint: Footprint::boxed(receiver.footprint.centre, half), ..receiver };
            let plane = OnPlane::default().with_bias(bias);
            let when = VirtualWhen::Never;
            let ours = presets::wang_molnar94().filter.with_res_factor(1.5).with_plane(plane).with_when(when);
            let depth = Biased::constant(bias);
            let theirs =
                Pcf::default().with_pattern(EveryTexel).with_depth(depth).with_res_factor(1.5).with_min_size(1.0);
            let (ours, theirs) = (probed(&ours, &stored, &receiver).0, probed(&theirs, &stored, &receiver).0);
            assert_eq!(ours.to_bits(), theirs.to_bits(), "{kind:?} {i}");
        }
    }
    // Sheets square to the rays need no plane to be the same: their own is the receiver's depth everywhere.
    let view = sun(16);
    let steps = map(&view, |texel| if (texel.x + texel.y) % 3 == 0 { 5.0 } else { 6.0 });
    for depth in [5.0, 5.5, 6.0, 6.25] {
        let at = tilted(&view, DVec2::new(8.2, 8.1), depth, DVec2::ZERO);
        let plane = OnPlane::default().with_bias(Bias::World(0.25));
        let depth = Biased::constant(Bias::World(0.25));
        let theirs = Pcf::default().with_pattern(EveryTexel).with_depth(depth).with_res_factor(0.0).with_min_size(1.0);
        let ours = presets::wang_molnar94().filter.with_plane(plane);
        assert_eq!(probed(&ours, &steps, &at).0, probed(&theirs, &steps, &at).0);
    }
}

#[test]
fn wm94_15_always_fails_where_the_tangent_plane_climbs_past_its_occluders() {
    // A curved surface, steep here: the plane passes the second surface one texel on, which the surface itself does not reach.
    let view = sun(16);
    let second = map(&view, |_| 8.0);
    let at = tilted(&view, DVec2::new(8.0, 8.0), 7.0, DVec2::new(4.0, 0.0));
    assert!(at.facing > presets::wang_molnar94().filter.min_cos);
    for (when, wanted, asked) in
        [(VirtualWhen::Mixed, 0.0, 0), (VirtualWhen::Always, 0.5, 1), (VirtualWhen::Never, 0.0, 0)]
    {
        let (fraction, counters) = probed(&presets::wang_molnar94().filter.with_when(when), &second, &at);
        assert_eq!((fraction, counters.virtual_sampled), (wanted, asked), "{when:?}");
    }
}

#[test]
fn wm94_4_t_8_backs_are_shading_s_business_unless_they_are_dark_at_once() {
    let view = sun(16);
    let second = map(&view, |_| 6.0);
    let front = tilted(&view, DVec2::new(8.0, 8.0), 6.0, DVec2::new(0.5, 0.0));
    let back = Receiver { facing: -front.facing, normal: -front.normal, ..front };
    let dark_backs = presets::wang_molnar94().filter.with_dark_backs(true);
    // On its own second surface a back is lit by depth: shading with max(N·L, 0) must darken it, and |N·L| would not.
    assert_eq!(probed(&presets::wang_molnar94().filter, &second, &back).0, 0.0);
    assert_eq!(probed(&dark_backs, &second, &back).0, 1.0);
    assert_eq!(probed(&dark_backs, &second, &Receiver { facing: 0.0, ..back }).0, 1.0);
    assert_eq!(probed(&dark_backs, &second, &front).0, 0.0);
    // A plane is the same from both sides.
    let mixed = map(&view, |texel| if texel.x < 8 { 5.0 } else { 9.0 });
    for filter in
        [presets::wang_molnar94().filter, presets::wang_molnar94().filter.with_res_factor(0.0).with_min_size(2.5)]
    {
        assert_eq!(probed(&filter, &mixed, &front), probed(&filter, &mixed, &back));
    }
}

#[test]
fn c_10_e_m6_texels_outside_the_map_answer_by_its_rules() {
    let share = |rules, depth: f32, stored: f32| {
        let view = sun(16).with_rules(rules);
        let at = tilted(&view, DVec2::new(16.0, 8.0), f64::from(depth), DVec2::ZERO);
        probed(&presets::wang_molnar94().filter, &map(&view, |_| stored), &at).0
    };
    // Two of the nearest four are outside.
    assert_eq!(
        (share(Rules::OPEN, 6.0, 5.0), share(Rules::SPOT, 6.0, 5.0), share(Rules::AROUND, 6.0, 5.0)),
        (0.5, 1.0, 0.5)
    );
    assert_eq!(
        (share(Rules::OPEN, 6.0, 7.0), share(Rules::SPOT, 6.0, 7.0), share(Rules::AROUND, 6.0, 7.0)),
        (0.0, 0.5, 0.0)
    );
}
