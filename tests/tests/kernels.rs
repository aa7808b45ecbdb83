//! SIMD kernels against their scalar twins, and every filter against every storage, bit for bit.

use fearless_simd::{Level, dispatch};
use glam::{UVec2, Vec2};
use umbrage_bake::bake;
use umbrage_depth::{Bbox, DepthMap, First, Raw, Tiled};
use umbrage_plane::{Bias, Footprint, Kind, Receiver, Sampling, SurfacePoint, Verdict, View};
use umbrage_raster::Cull;
use umbrage_render::Soup;
use umbrage_sample::{
    Centre, Disc, EveryTexel, Gaussian, InsideQuadReject, InsideQuadWarp, Jittered, Key, Pattern, Tent, Uniform,
    each_tap,
};
use umbrage_scene::gallery;
use umbrage_shadow::williams::{Dither, Guard, Lookup};
use umbrage_shadow::{
    Biased, Conditional, Cone, Extent, Filter, IntegerFirst, OnPlane, Opacity, Ordinary, Pcf, Radius, ReceiverDepth,
    ShadowMap, Soft, Softness, Williams, presets,
};

const KEY: Key = Key::new(11, 0, 0);

fn baked(kind: Kind, sampling: Sampling) -> Tiled {
    let scene = gallery::sphere_plane();
    let view = scene.lights[0].view.with_size(UVec2::new(211, 157)).unwrap().with_kind(kind).with_sampling(sampling);
    let mut scene = scene;
    scene.objects[1].casts = kind != Kind::Radial;
    bake(&view, Soup::casters(&scene, &view).triangles(), &First, Cull::None).map
}

/// Receivers all over the map and a little beyond, most of them near the stored depth; quadrilateral footprints of all sizes.
fn receivers(map: &Tiled, count: u32) -> Vec<Receiver> {
    let view = map.view();
    let size = view.size().as_vec2();
    (0..count)
        .filter_map(|i| {
            let draw = |dim| KEY.unit(i, dim);
            let at = Vec2::new(draw(0), draw(1)) * (size + 12.0) - 6.0;
            let stored = f64::from(map.depth(at.floor().as_ivec2()));
            let near = if stored.is_finite() && view.kind() == Kind::Axial { stored } else { 105.0 };
            let zeta = near * (1.0 + 0.02 * f64::from(KEY.signed(i, 2)));
            let world = view.world_at(at.as_dvec2(), view.key(zeta));
            let normal = glam::DVec3::new(f64::from(draw(3)) - 0.5, f64::from(draw(4)) - 0.5, 1.0).normalize();
            let seen = view.receiver(&SurfacePoint::at(world.as_vec3(), normal.as_vec3())).ok()?;
            let half = (draw(5) * 7.0).exp2() * 0.25;
            let corners = [(-1.0, -0.3), (0.4, -1.0), (1.0, 0.5), (-0.2, 1.0)];
            let footprint = Footprint::around(corners.map(|(x, y)| seen.footprint.centre + Vec2::new(x, y) * half));
            Some(Receiver { footprint, ..seen })
        })
        .collect()
}

fn ask<F: Filter, M: DepthMap>(filter: &F, map: &M, receiver: &Receiver, key: Key) -> f32 {
    ask_at(Level::new(), filter, map, receiver, key)
}

fn ask_at<F: Filter, M: DepthMap>(level: Level, filter: &F, map: &M, receiver: &Receiver, key: Key) -> f32 {
    dispatch!(level, simd => filter.shadow(simd, map, receiver, key, &mut ()))
}

/// Percentage-closer filtering one tap at a time, without ranges, tiles or lanes.
fn naive<P: Pattern>(filter: &Pcf<P, Biased>, map: &Raw, receiver: &Receiver, key: Key) -> f32 {
    let view: &View = map.view();
    let region = receiver.footprint.scaled(filter.res_factor, filter.min_size, view.size().as_vec2() * 0.25);
    let (low, high) = (receiver.nearer(view, filter.depth.low), receiver.nearer(view, filter.depth.high));
    let (mut hits, mut count) = (0.0f32, 0.0f32);
    each_tap(&filter.pattern, &region, key, |tap| {
        let compared = if low == high { low } else { tap.u * (high - low) + low };
        let dark = match view.rules().verdict(view.locate(tap.at)) {
            Verdict::Lit => false,
            Verdict::Shadowed => true,
            Verdict::Compare => compared > map.depth(tap.at.floor().as_ivec2()),
        };
        count += tap.weight;
        hits += if dark { tap.weight } else { 0.0 };
    });
    hits / count
}

fn twin<P: Pattern + Copy>(pattern: P, maps: &[Tiled]) {
    for map in maps {
        let raw = Raw::from(map);
        let filter = Pcf { pattern, depth: Biased::default(), res_factor: 1.5, min_size: 0.0, cull: true };
        for (i, receiver) in receivers(map, 3000).iter().enumerate() {
            let key = KEY.region(i as u32);
            let (ours, plain) = (ask(&filter, map, receiver, key), naive(&filter, &raw, receiver, key));
            assert_eq!(ours.to_bits(), plain.to_bits(), "receiver {i}: {ours} {plain}");
        }
    }
}

#[test]
fn r87_13_r87_22_simd_and_culling_agree_with_one_tap_at_a_time() {
    let maps = [
        baked(Kind::Axial, Sampling::Centre),
        baked(Kind::Axial, Sampling::Jittered { seed: 4 }),
        baked(Kind::Radial, Sampling::Centre),
    ];
    twin(Centre, &maps);
    twin(EveryTexel, &maps);
    twin(Uniform { num_samples: 23 }, &maps);
    twin(Gaussian::default(), &maps);
    twin(Jittered::default(), &maps);
    twin(Jittered { num_samples: 64, min_samples: 3, ..Jittered::default() }, &maps);
    twin(InsideQuadReject::default(), &maps);
    twin(InsideQuadWarp::default(), &maps);
    twin(Disc::default(), &maps);
    twin(Tent, &maps);
}

/// A filter over every storage of a map, and with the least instructions that every machine has.
fn storages_agree<F: Filter>(name: &str, filter: &F, map: &Tiled) {
    let (raw, boxed) = (Raw::from(map), Bbox::from(map));
    for (i, receiver) in receivers(map, 4000).iter().enumerate() {
        let key = KEY.region(i as u32);
        let answers = [
            ask(filter, &raw, receiver, key),
            ask(filter, &boxed, receiver, key),
            ask(filter, map, receiver, key),
            ask_at(Level::baseline(), filter, map, receiver, key),
        ];
        assert!(answers.iter().all(|answer| answer.to_bits() == answers[0].to_bits()), "{name}, {i}: {answers:?}");
        assert!((0.0..=1.0).contains(&answers[0]), "{name}, {i}: {answers:?}");
    }
}

#[test]
fn r87_19_r87_21_every_filter_answers_alike_over_every_storage() {
    for (kind, sampling) in [
        (Kind::Axial, Sampling::Centre),
        (Kind::Axial, Sampling::Jittered { seed: 9 }),
        (Kind::Screen, Sampling::Centre),
        (Kind::Radial, Sampling::Centre),
    ] {
        let map = baked(kind, sampling);
        storages_agree("pcf", &Pcf::default(), &map);
        storages_agree("pcf, uncut", &Pcf { cull: false, ..Pcf::default() }, &map);
        storages_agree("every texel", &on_plane(EveryTexel), &map);
        storages_agree("warped", &on_plane(InsideQuadWarp::default()), &map);
        storages_agree("disc", &on_plane(Disc::default()), &map);
        storages_agree("ordinary", &Ordinary { pattern: EveryTexel, bias: Bias::World(0.3), res_factor: 2.0 }, &map);
        let bilinear = Lookup::Bilinear(Guard::default());
        storages_agree("williams", &Williams { bias: Bias::ZERO, lookup: bilinear, dither: Dither::HALF_TEXEL }, &map);
        let faithful = Lookup::Bilinear(Guard::Faithful);
        storages_agree("faithful", &Williams { bias: Bias::Steps(1.0), lookup: faithful, dither: Dither::OFF }, &map);
    }
}

fn on_plane<P: Pattern>(pattern: P) -> Pcf<P, OnPlane> {
    Pcf { pattern, depth: OnPlane::biased(Bias::Texels(0.5)), res_factor: 1.0, min_size: 1.0, cull: true }
}

#[test]
fn w92_7_wm94_5_b06_6_woo_s_wang_and_molnar_s_and_burley_s_filters_answer_alike_over_every_storage() {
    for (kind, sampling) in [
        (Kind::Axial, Sampling::Jittered { seed: 9 }),
        (Kind::Screen, Sampling::Centre),
        (Kind::Radial, Sampling::Centre),
    ] {
        let map = baked(kind, sampling);
        storages_agree("woo", &presets::woo92(), &map);
        storages_agree("integer first", &IntegerFirst::default(), &map);
        let nearest = presets::wang_molnar94();
        storages_agree("wang and molnar", &nearest, &map);
        let Conditional { plane, min_cos, when, dark_backs, .. } = nearest;
        let tent = Conditional { pattern: Tent, res_factor: 1.0, min_size: 1.0, plane, min_cos, when, dark_backs };
        storages_agree("weighted", &tent, &map);
        let burley = presets::burley();
        storages_agree("burley", &burley, &map);
        storages_agree("rescued", &Soft { rescue: true, ..burley }, &map);
        let softness = Softness::Between { min: Extent::Share(0.01), max: Extent::World(9.0) };
        let opacity = Opacity { near: 0.9, far: 0.2, fade: 20.0, gamma: 0.7 };
        storages_agree("faint", &Soft { softness, opacity, radius_gamma: 0.5, ..burley }, &map);
        storages_agree("light", &Soft { softness: Softness::Light { radius: 4.0, nearest: 20.0 }, ..burley }, &map);
        storages_agree("fernando", &presets::fernando(Bias::World(0.5)), &map);
    }
}

/// Depth ranges settle regions under a cone and on planes of any reach, and change no answer.
#[test]
fn r87_22_culling_changes_no_answer_whatever_depth_is_compared() {
    fn both_ways<D: ReceiverDepth + Copy>(name: &str, depth: D, map: &Tiled) {
        let filter = |cull| Pcf { pattern: Disc::default(), depth, res_factor: 1.0, min_size: 1.0, cull };
        for (i, receiver) in receivers(map, 3000).iter().enumerate() {
            let key = KEY.region(i as u32);
            let (with, without) = (ask(&filter(true), map, receiver, key), ask(&filter(false), map, receiver, key));
            assert_eq!(with, without, "{name} {i}");
        }
    }
    for kind in [Kind::Axial, Kind::Screen, Kind::Radial] {
        let map = baked(kind, Sampling::Jittered { seed: 5 });
        both_ways("cone", Cone::default(), &map);
        both_ways("nominal", Cone { radius: Radius::Nominal, base: 0.1, slope: 0.5 }, &map);
        both_ways("near plane", OnPlane { slack: 1.0, reach: 0.5, ..OnPlane::default() }, &map);
    }
}

#[test]
fn bounds_enclose_every_compared_depth() {
    for kind in [Kind::Axial, Kind::Screen, Kind::Radial] {
        let map = baked(kind, Sampling::Jittered { seed: 2 });
        encloses("plane", &OnPlane::biased(Bias::World(0.2)), &map);
        encloses("near plane", &OnPlane { slack: 1.0, reach: 0.25, bias: Bias::Texels(0.5) }, &map);
        encloses("biased", &Biased::default(), &map);
        encloses("cone", &Cone::default(), &map);
        encloses("nominal cone", &Cone { base: 0.3, slope: 1.0, radius: Radius::Nominal }, &map);
    }
}

fn encloses<D: ReceiverDepth>(name: &str, depth: &D, map: &Tiled) {
    let view = map.view();
    for (i, receiver) in receivers(map, 2000).iter().enumerate() {
        let rect = umbrage_plane::TexelRect::around(receiver.footprint.centre, receiver.footprint.half);
        let bounds = depth.bounds(view, receiver, rect);
        dispatch!(Level::new(), simd => Jittered::default().taps(simd, &receiver.footprint, KEY.region(i as u32), |taps| {
            let compared = depth.lanes(simd, view, receiver, taps);
            for lane in (0..16).filter(|lane| taps.mask >> lane & 1 == 1) {
                let compared = compared[lane];
                assert!((bounds.min..=bounds.max).contains(&compared), "{name} {i}: {compared} not in {bounds:?}");
            }
        }));
    }
}

#[test]
fn shadow_maps_are_asked_in_batches_or_one_by_one_alike() {
    use umbrage_shadow::Shadow;
    let map = baked(Kind::Axial, Sampling::Centre);
    let points: Vec<SurfacePoint> = (0..500)
        .map(|i| {
            let at = glam::Vec3::new(KEY.signed(i, 0) * 70.0, KEY.signed(i, 1) * 70.0, KEY.unit(i, 2) * 30.0);
            SurfacePoint { region: i, ..SurfacePoint::at(at, glam::Vec3::Z) }
        })
        .collect();
    let shadow = ShadowMap { filter: presets::reeves87(), map };
    let mut all = vec![f32::NAN; points.len()];
    shadow.fractions(&points, KEY, &mut all);
    for (point, batched) in points.iter().zip(all) {
        assert_eq!(shadow.fraction(point, KEY), batched);
    }
}
