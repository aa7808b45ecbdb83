//! Traps where two choices meet (T-1 to T-20) that concern Williams' and Reeves' filters, one test each. T-4 and T-20 are among Reeves' tests, T-14 with the
//! listing, T-15 with the post-process, T-16 with lights in all directions.

use glam::{DVec3, IVec2, UVec2, Vec2, Vec3};
use umbrage_depth::{Bbox, DepthMap, Raw};
use umbrage_plane::{Bias, Footprint, Kind, Receiver, Rules, SurfacePoint, TexelRect, View};
use umbrage_sample::{EveryTexel, Key, Uniform};
use umbrage_shadow::williams::{Guard, bilinear};
use umbrage_shadow::{Biased, Filter, Pcf, Shadow, ShadowMap, presets, weighted_mean};

const KEY: Key = Key::new(19, 0, 0);

/// Looking down −y from the origin, 90° wide.
fn lamp(size: u32) -> View {
    let fov = 90f64.to_radians();
    View::perspective(DVec3::ZERO, DVec3::NEG_Y, DVec3::NEG_Z, fov, 1.0, 100.0, UVec2::splat(size)).unwrap()
}

/// The plane through (0, −`height`, 0) with a normal, as a map sees it.
fn plane(view: &View, height: f64, normal: DVec3) -> Raw {
    let eye = view.world_to_eye().transform_point3(DVec3::NEG_Y * height);
    let key = view.affine(eye, view.world_to_eye().transform_vector3(normal)).unwrap();
    let decode = view.decode();
    let depth = |texel: IVec2| {
        let at = view.sampling().position(texel);
        decode.depth(key.at(at) as f32, at)
    };
    Raw::new(*view, TexelRect::of_size(view.size()).texels().map(depth).collect()).unwrap()
}

fn ask<F: Filter>(filter: &F, map: &impl DepthMap, receiver: &Receiver, key: Key) -> f32 {
    ShadowMap { filter, map }.fraction_of_probed(receiver, key, &mut ())
}

#[test]
fn t_3_the_background_around_the_finite_box_is_lit_inside_a_spot_s_cone() {
    // One caster in a corner of the cone: the box around it is no rim of light (W92-6), whatever the storage and the cull.
    let view = lamp(64).with_rules(Rules::SPOT).with_cone(Some(0.9_f64.atan().cos())).unwrap();
    let caster = |texel: IVec2| texel.cmpge(IVec2::splat(20)).all() && texel.cmplt(IVec2::splat(24)).all();
    let depths = TexelRect::of_size(view.size()).texels().map(|texel| if caster(texel) { 4.0 } else { f32::INFINITY });
    let raw = Raw::new(view, depths.collect()).unwrap();
    let boxed = Bbox::from(&raw);
    for cull in [true, false] {
        let filter = presets::woo92().filter.with_cull(cull);
        for step in 0..400 {
            let at = Vec3::new(KEY.signed(step, 0) * 12.0, -10.0, KEY.signed(step, 1) * 12.0);
            let point = SurfacePoint { region: step, ..SurfacePoint::at(at, Vec3::Y) };
            let texel = (view.receiver(&point).unwrap().footprint.centre).floor().as_ivec2();
            let beyond = Vec2::new(at.x, at.z).length() > 9.0 || at.abs().max_element() > 10.0;
            let wanted = if beyond || caster(texel) { 1.0 } else { 0.0 };
            for found in [
                ShadowMap { filter, map: raw.clone() }.fraction(&point, KEY),
                ShadowMap { filter, map: boxed.clone() }.fraction(&point, KEY),
            ] {
                assert_eq!(found, wanted, "{at}");
            }
        }
    }
}

#[test]
fn t_5_an_empty_box_does_not_light_what_lies_outside_the_cone() {
    // Nothing in the map at all: the cull would say lit, the cone says dark.
    let view = lamp(64).with_rules(Rules::SPOT).with_cone(Some(0.5_f64.atan().cos())).unwrap();
    let map = Bbox::from(&Raw::new(view, vec![f32::INFINITY; 64 * 64]).unwrap());
    let shadow = ShadowMap { filter: presets::reeves87().filter, map };
    let at = |x: f32| shadow.fraction(&SurfacePoint::at(Vec3::new(x, -10.0, 0.0), Vec3::Y), KEY);
    assert_eq!((at(0.0), at(4.0), at(6.0), at(15.0)), (0.0, 0.0, 1.0, 1.0));
}

#[test]
fn t_6_a_larger_region_needs_a_larger_bias() {
    // D-9: free of false shadow from (R + ½)·g on; a bias that serves a region of half-extent 1 fails one of 4.
    let view = lamp(256);
    let normal = DVec3::new(0.6, 0.8, 0.0);
    let map = plane(&view, 10.0, normal);
    let at = SurfacePoint::at(Vec3::new(0.0, -10.0, 0.0), normal.as_vec3());
    let seen = view.receiver(&at).unwrap();
    let share = |half: f32, bias: f32| {
        let region = Receiver { footprint: Footprint::boxed(seen.footprint.centre, Vec2::splat(half)), ..seen };
        let pattern = Uniform::default().with_num_samples(4096);
        let depth = Biased::constant(Bias::Steps(bias));
        ask(
            &Pcf::default()
                .with_pattern(pattern)
                .with_depth(depth)
                .with_res_factor(1.0)
                .with_min_size(0.0)
                .with_cull(false),
            &map,
            &region,
            KEY,
        )
    };
    assert_eq!(share(1.0, 1.6), 0.0);
    assert!(share(4.0, 1.6) > 0.1, "{}", share(4.0, 1.6));
    assert_eq!(share(4.0, 4.7), 0.0);
}

#[test]
fn t_7_depths_of_two_kinds_are_interpolated_each_in_its_own_space() {
    // On a slanted plane −1/ζ and z_s are linear over texels, ζ is not: blending it as it is would be wrong by this much.
    let normal = DVec3::new(0.8, 0.6, 0.0);
    for kind in [Kind::Axial, Kind::Screen] {
        let view = lamp(32).with_kind(kind);
        let map = plane(&view, 10.0, normal);
        let receiver = view.receiver(&SurfacePoint::at(Vec3::new(0.0, -10.0, 0.0), normal.as_vec3())).unwrap();
        let at = Vec2::new(20.0, 16.25);
        let exact = receiver.plane(&view).at(at.as_dvec2());
        let blended = bilinear(&map, at, Guard::Faithful, &receiver);
        assert!((blended - exact).abs() / exact < 1e-6, "{kind:?}: {blended} {exact}");
        let naive = 0.5 * (map.depth(IVec2::new(19, 16)) + map.depth(IVec2::new(20, 16)));
        assert_eq!(kind == Kind::Axial, (naive - exact).abs() / exact > 1e-4, "{kind:?}: {naive} {exact}");
    }
    // A bias of world units is the same distance in both kinds; one of map units is not (D-8).
    let world = |kind, zeta: f64, bias| {
        let view = lamp(32).with_kind(kind);
        let at = view.receiver(&SurfacePoint::at(Vec3::new(0.0, -zeta as f32, 0.0), Vec3::Y)).unwrap();
        let moved = at.nearer(&view, bias);
        if kind == Kind::Axial { zeta - f64::from(moved) } else { zeta - view.decode().zeta(moved) }
    };
    for zeta in [5.0, 50.0] {
        assert!((world(Kind::Screen, zeta, Bias::World(0.5)) - 0.5).abs() < 1e-3);
        assert!((world(Kind::Axial, zeta, Bias::World(0.5)) - 0.5).abs() < 1e-5);
    }
    let near_and_far = [5.0, 50.0].map(|zeta| world(Kind::Screen, zeta, Bias::Map(1e-4)));
    assert!(near_and_far[1] > 50.0 * near_and_far[0], "{near_and_far:?}");
}

#[test]
fn t_10_equal_depths_are_lit_everywhere() {
    let view = lamp(16);
    let map = Raw::new(view, vec![10.0; 256]).unwrap();
    let at = view.receiver(&SurfacePoint::at(Vec3::new(0.0, -10.0, 0.0), Vec3::Y)).unwrap();
    let region = |depth: f32| Receiver { footprint: Footprint::boxed(Vec2::splat(8.0), Vec2::splat(2.0)), depth, ..at };
    let exact = Pcf::default().with_depth(Biased::constant(Bias::ZERO));
    for cull in [true, false] {
        assert_eq!(ask(&exact.with_cull(cull), &map, &region(10.0), KEY), 0.0);
        assert_eq!(ask(&exact.with_cull(cull), &map, &region(10f32.next_up()), KEY), 1.0);
    }
    let williams = presets::williams78().filter.with_bias(Bias::ZERO);
    assert_eq!(ask(&williams, &map, &region(10.0), KEY), 0.0);
    assert_eq!(ask(&williams, &map, &region(10f32.next_up()), KEY), 1.0);
}

#[test]
fn t_17_regions_that_reach_behind_the_light_get_footprints_of_their_front() {
    let view = lamp(64);
    let map = Raw::new(view, vec![3.0; 64 * 64]).unwrap();
    let shadow = ShadowMap { filter: presets::reeves87().filter, map };
    // A board from below the light to far above it.
    let corners = [(-1.0, -8.0), (1.0, -8.0), (1.0, 30.0), (-1.0, 30.0)].map(|(x, y)| Vec3::new(x, y, -2.0));
    let region = SurfacePoint::at(Vec3::new(0.0, -5.0, -2.0), Vec3::Z).with_corners(corners);
    let footprint = view.receiver(&region).unwrap().footprint;
    assert!(footprint.centre.is_finite() && footprint.half.max_element() <= 16.0);
    assert!((footprint.centre - Vec2::new(32.0, 19.2)).abs().max_element() <= 16.0, "{footprint:?}");
    assert!((0.0..=1.0).contains(&shadow.fraction(&region, KEY)));
}

#[test]
fn t_18_what_lies_beyond_the_far_plane_is_compared_unless_the_volume_is_strict() {
    let lit_or_dark = |rules| {
        let map = Raw::new(lamp(16).with_rules(rules), vec![50.0; 256]).unwrap();
        let shadow = ShadowMap { filter: presets::reeves87().filter, map };
        shadow.fraction(&SurfacePoint::at(Vec3::new(0.0, -1000.0, 0.0), Vec3::Y), KEY)
    };
    assert_eq!((lit_or_dark(Rules::OPEN), lit_or_dark(Rules::SPOT), lit_or_dark(Rules::VOLUME)), (1.0, 1.0, 0.0));
}

#[test]
fn v59_r87_26_highlights_transformed_before_and_after_filtering() {
    let normals = [Vec3::Z, Vec3::new(60f32.to_radians().sin(), 0.0, 0.5)];
    let region = Footprint::boxed(Vec2::new(1.0, 0.5), Vec2::new(1.0, 0.5));
    let normal = |at: Vec2| normals[usize::from(at.x >= 1.0)];
    let highlight = |normal: Vec3| normal.z.powi(10);
    let first: f32 = weighted_mean(&EveryTexel, &region, KEY, |tap| highlight(normal(tap.at)));
    let mean: Vec3 = weighted_mean(&EveryTexel, &region, KEY, |tap| normal(tap.at));
    assert!((first - 0.500_488_3).abs() < 1e-6);
    assert!((highlight(mean) - 0.056_313_5).abs() < 1e-6);
    assert!((highlight(mean.normalize()) - 0.237_304_7).abs() < 1e-6);
}

#[test]
fn shadows_and_maps_are_shared_between_threads() {
    fn sent<T: Send + Sync + 'static>(_: &T) {}
    let map = std::sync::Arc::new(Raw::new(lamp(16), vec![5.0; 256]).unwrap());
    // One map under two filters, neither of which copies it.
    let one = ShadowMap { filter: presets::reeves87().filter, map: std::sync::Arc::clone(&map) };
    let two = ShadowMap { filter: presets::ordinary(Bias::ZERO).filter, map: std::sync::Arc::clone(&map) };
    let shadows: Vec<Box<dyn Shadow>> = vec![Box::new(one), Box::new(two)];
    sent(&shadows);
    let below = SurfacePoint::at(Vec3::new(0.0, -10.0, 0.0), Vec3::Y);
    let dark =
        std::thread::spawn(move || shadows.iter().map(|shadow| shadow.fraction(&below, KEY)).collect::<Vec<_>>());
    assert_eq!(dark.join().unwrap(), [1.0, 1.0]);
    assert_eq!(std::sync::Arc::strong_count(&map), 1, "both went with their thread");
}
