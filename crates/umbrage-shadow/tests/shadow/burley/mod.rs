//! Burley 2006: the bias cone and soft shadows from one map (B06-1 to B06-13, D-15, D-16).

use glam::{DVec3, IVec2, UVec2, Vec2, Vec3};
use umbrage_depth::{DepthMap, Raw};
use umbrage_plane::{Bias, Footprint, Kind, Receiver, Rules, SurfacePoint, TexelRect, View};
use umbrage_sample::{Density, Disc, Key, Pattern, each_tap};
use umbrage_shadow::as_printed::{BurleyListing, Sample, sample_blur, sample_depth, soft_radius, soft_shadow};
use umbrage_shadow::{
    BiasCone, Biased, Counters, Filter, MapRadius, OccluderFalloff, Opacity, Pcf, Probe, Radius, ReceiverDepth,
    ShadowMap, Soft, Softness, presets,
};

mod cone;

const KEY: Key = Key::new(6, 0, 0);

/// At the origin, looking down −y, 90° wide, from 1 to 100.
fn lamp(size: u32) -> View {
    let fov = 90f64.to_radians();
    View::perspective(DVec3::ZERO, DVec3::NEG_Y, DVec3::NEG_Z, fov, 1.0, 100.0, UVec2::splat(size)).unwrap()
}

fn map(view: &View, depth: impl Fn(IVec2) -> f32) -> Raw {
    Raw::new(*view, TexelRect::of_size(view.size()).texels().map(depth).collect()).unwrap()
}

/// At an axial distance of `zeta` and a texel position, facing against the view.
fn facing(view: &View, zeta: f64, at: Vec2) -> Receiver {
    let world = view.world_at(at.as_dvec2(), view.key(zeta));
    let seen = view.receiver(&SurfacePoint::at(world.as_vec3(), -view.ahead().as_vec3())).unwrap();
    let eye = view.world_to_eye().transform_point3(world);
    Receiver { footprint: Footprint::point(at), eye, depth: view.depth(eye), ..seen }
}

/// A stored depth of axial distance `zeta`, near the axis.
fn stored(view: &View, zeta: f64) -> f32 {
    view.decode().depth_of_zeta(zeta, view.size().as_dvec2() * 0.5)
}

fn probe<F: Filter>(filter: &F, map: &impl DepthMap, receiver: &Receiver, key: Key, probe: &mut impl Probe) -> f32 {
    ShadowMap { filter, map }.fraction_of_probed(receiver, key, probe)
}

fn ask<F: Filter>(filter: &F, map: &impl DepthMap, receiver: &Receiver) -> f32 {
    probe(filter, map, receiver, KEY, &mut ())
}

/// Texels that differ, without rotation, so that taps are where the vectors say.
fn still(num_samples: u32, density: Density) -> Disc {
    Disc::default().with_num_samples(num_samples).with_density(density).with_rotate(false).with_half_offset(false)
}

fn between(min: f32, max: f32) -> Softness {
    Softness::Between { min: MapRadius::Texels(min), max: MapRadius::Texels(max) }
}

#[test]
fn v62_b06_1_the_cone_corrected_and_as_printed_e_b1_e_b5() {
    let cone = BiasCone::default().with_base(0.1);
    assert_eq!(cone.slope, 2.0);
    let listing = BurleyListing { base: 0.1, slope: 2.0, ..BurleyListing::default() };
    assert_eq!(BurleyListing::default().slope, 1.0);
    let view = lamp(512);
    let tip = facing(&view, 10.0, Vec2::splat(256.5));
    let mut lanes = Vec::new();
    for (radius, corrected, printed) in [(0.0f32, 9.9, 10.1), (0.5, 8.9, 11.1), (1.0, 7.9, 12.1)] {
        assert!((10.0 - cone.bias(radius) - corrected).abs() < 1e-6);
        assert!((listing.compared(10.0, radius) - printed).abs() < 1e-6);
        // World units on the map: τ = 2·10/512 here, so that these radii are 0, 12.8 and 25.6 texels (V31's arithmetic).
        let nominal = cone.with_radius(Radius::Nominal);
        let at = Footprint::point(Vec2::new(256.5 + radius * 25.6, 256.5));
        umbrage_plane::vectorized!(simd => umbrage_sample::Centre.taps(simd, &at, KEY, |taps| {
            lanes.push((nominal.lanes(simd, &view, &tip, taps)[0], corrected));
        }));
    }
    assert!(lanes.iter().all(|(found, wanted)| (found - wanted).abs() < 1e-5), "{lanes:?}");
    assert!((2f64.atan().to_degrees() - 63.434_949).abs() < 1e-6 && (2f64.atan().cos() - 0.447_213_6).abs() < 1e-7);
}

#[test]
fn v61_b06_4_weights_of_sixteen_search_taps() {
    let (mut sum, burley) = (0.0, OccluderFalloff::Linear { rim: 0.1 });
    let region = Footprint::boxed(Vec2::splat(50.0), Vec2::splat(8.0));
    each_tap(&still(16, Density::Centred), &region, KEY, |tap| {
        sum += burley.weight((tap.at - region.centre).length() / 8.0);
    });
    assert!((sum - 9.25).abs() < 1e-5, "{sum}");
    for falloff in [burley, OccluderFalloff::Smooth { rim: 0.1 }, OccluderFalloff::Flat] {
        let weights: Vec<f32> = (0..=100).map(|i| falloff.weight(i as f32 * 0.01)).collect();
        assert!(weights.windows(2).all(|pair| pair[1] <= pair[0]) && weights[100] > 0.09, "{falloff:?}");
        assert_eq!(weights[0], 1.0);
    }
    assert!(
        (burley.weight(1.0) - 0.1).abs() < 1e-6
            && (OccluderFalloff::Smooth { rim: 0.1 }.weight(1.0) - 0.1).abs() < 1e-6
    );
}

#[test]
fn v63_sample_depth_as_printed_e_b3() {
    let listing = BurleyListing { base: 0.0, slope: 0.0, samples: 4 };
    let samples = [(0.0, 5.0), (1.0, 20.0), (2.0, 8.0), (4.0, 3.0)].map(|(radius, depth)| Sample { radius, depth });
    assert!((sample_depth(&listing, 10.0, 4.0, samples) - 5.878_788).abs() < 1e-6);
    assert_eq!(sample_depth(&listing, 1.0, 4.0, samples), 0.0);
    assert_eq!(sample_depth(&listing, 10.0, 4.0, []), 0.0);
    assert_eq!(sample_blur(&listing, 10.0, samples), 0.75);
    assert_eq!(sample_blur(&listing, 10.0, []), 0.0);
}

/// The mean distance that a filter finds, read from the opacity that it leads to: dark times 3x² − 2x³, with x = (z_p − z̄)/20.
fn mean_found(filter: Soft<Biased>, map: &Raw, receiver: &Receiver) -> f64 {
    let opacity = Opacity::default().with_near(0.0).with_far(1.0).with_fade(20.0).with_gamma(1.0);
    let filter = filter.with_opacity(opacity).with_blur(still(1, Density::Uniform));
    let found = f64::from(ask(&filter, map, receiver));
    let (mut low, mut high) = (0.0, 1.0);
    for _ in 0..60 {
        let x = 0.5 * (low + high);
        *(if x * x * (3.0 - 2.0 * x) < found { &mut low } else { &mut high }) = x;
    }
    10.0 - 20.0 * low
}

#[test]
fn v63_b06_4_b06_9_the_mean_of_a_hand_made_map() {
    // Four search taps of radius 8 texels: at (0, 0), (0, 4), (−2, 0), (0, −6) from the receiver.
    let view = lamp(64);
    let centre = IVec2::splat(32);
    let depths = [((0, 0), 5.0), ((0, 4), 8.0), ((-2, 0), 20.0), ((0, -6), 3.0)];
    let filled = map(&view, |texel| {
        let hit = depths.iter().find(|((x, y), _)| texel - centre == IVec2::new(*x, *y));
        hit.map_or(f32::INFINITY, |(_, depth)| *depth)
    });
    let receiver = facing(&view, 10.0, Vec2::splat(32.5));
    let plain = presets::fernando(Bias::ZERO).filter;
    let filter =
        |density, falloff| plain.with_softness(between(0.5, 8.0)).with_search(still(4, density)).with_falloff(falloff);
    let weighted = mean_found(filter(Density::Centred, OccluderFalloff::Linear { rim: 0.1 }), &filled, &receiver);
    // Weights 1, .55, .325 by the radii 0, 4, 6 of 8.
    let wanted = (5.0 + 8.0 * 0.55 + 3.0 * 0.325) / 1.875;
    assert!((weighted - wanted).abs() < 1e-4, "{weighted}, want {wanted}");
    let mean = mean_found(filter(Density::Centred, OccluderFalloff::Flat), &filled, &receiver);
    assert!((mean - 5.333_333).abs() < 1e-4, "{mean}");
    // The printed search over the same map finds the same.
    let listing = BurleyListing { base: 0.0, slope: 0.0, samples: 4 };
    let samples = [(0.0, 5.0), (4.0, 8.0), (2.0, 20.0), (6.0, 3.0)].map(|(radius, depth)| Sample { radius, depth });
    assert!((f64::from(sample_depth(&listing, 10.0, 8.0, samples)) - wanted).abs() < 1e-5);
    assert_eq!((plain.search.density, plain.falloff), (Density::Uniform, OccluderFalloff::Flat));
}

#[test]
fn v64_b06_6_radii_corrected_and_as_printed_e_b4() {
    for (mean, wanted) in [(6.0, 4.2), (10.0, 1.0), (2.5, 7.0), (12.0, 1.0)] {
        assert!((1.0 + 8.0 * Softness::factor(mean, 10.0) - wanted).abs() < 1e-6);
    }
    assert!(
        (soft_radius(1.0, 9.0, 12.0, 10.0) + 0.6).abs() < 1e-6 && (soft_radius(1.0, 9.0, 6.0, 10.0) - 4.2).abs() < 1e-6
    );
    for (mean, wanted) in [(10.0, 0.1), (9.0, 0.29), (7.5, 0.575), (5.0, 1.05), (2.5, 1.525)] {
        assert!((0.1 + 1.9 * Softness::factor(mean, 10.0) - wanted).abs() < 1e-6);
        assert!((soft_radius(0.1, 2.0, mean, 10.0) - wanted).abs() < 1e-6);
    }
    // A receiver at or behind the light, and one at depth 0 (E-B4).
    assert_eq!(
        (Softness::factor(5.0, 0.0), Softness::factor(5.0, -1.0), soft_radius(1.0, 9.0, 5.0, 0.0)),
        (0.0, 0.0, 1.0)
    );
    let view = lamp(64);
    let receiver = facing(&view, 10.0, Vec2::splat(32.2));
    for nothing in [f32::INFINITY, 12.0, 10.0] {
        let empty = map(&view, |_| nothing);
        assert_eq!(ask(&presets::burley().filter, &empty, &receiver), 0.0);
        assert_eq!(ask(&presets::burley().filter.with_rescue(true), &empty, &receiver), 0.0);
    }
}

#[test]
fn e_b1_e_b9_the_printed_whole_shadows_a_lit_plane_and_a_near_occluder_is_lost() {
    let view = lamp(64);
    let plane = map(&view, |_| 10.0);
    let listing = BurleyListing::default();
    let at = Vec3::new(32.2, 32.2, 10.0);
    assert!(soft_shadow(&listing, &plane, at, 1.0, 9.0) > 0.9);
    assert_eq!(ask(&presets::burley().filter, &plane, &facing(&view, 10.0, Vec2::splat(32.2))), 0.0);
    // With negative parameters it is right.
    assert_eq!(soft_shadow(&BurleyListing { slope: -0.1, ..listing }, &plane, at, 1.0, 9.0), 0.0);
    assert_eq!(soft_shadow(&listing, &map(&view, |_| f32::INFINITY), at, 1.0, 9.0), 0.0);
}

/// The fraction of a disc of radius 1 beyond the distance `x` from its centre.
fn segment(x: f64) -> f64 {
    let x = x.clamp(-1.0, 1.0);
    (x.acos() - x * (1.0 - x * x).sqrt()) / std::f64::consts::PI
}

/// The worst difference between a filter's fractions along a half-plane's edge at u = 512 and the shares of a disc of `radius` texels.
fn worst(filter: &Soft<Biased>, view: &View, occluder: f64, radius: f64) -> f64 {
    let blocker = stored(view, occluder);
    let half = map(view, |texel| if texel.x >= 512 { blocker } else { f32::INFINITY });
    (-12..=12).fold(0f64, |worst, step| {
        let offset = 0.08 * f64::from(step);
        let receiver = facing(view, 10.0, Vec2::new((512.0 + offset * radius) as f32, 512.3));
        worst.max((f64::from(ask(filter, &half, &receiver)) - segment(-offset)).abs())
    })
}

#[test]
fn v65_d_16_the_light_s_own_penumbra_and_burley_s_t_12() {
    // A light of diameter 2, an occluder at 5, a receiver at 10: half a penumbra is 1 world unit, .1 in tangents, 51.2 texels of 1024.
    let samples = |density| Disc::default().with_num_samples(4096).with_density(density);
    let base = presets::fernando(Bias::ZERO)
        .filter
        .with_search(samples(Density::Centred))
        .with_blur(samples(Density::Uniform));
    let light = base.with_softness(Softness::Light { radius: 1.0, nearest: 4.0 });
    for kind in [Kind::Axial, Kind::Screen] {
        let view = lamp(1024).with_kind(kind);
        let error = worst(&light, &view, 5.0, 51.2);
        assert!(error < 0.012, "{kind:?}: {error}");
        // Burley's is the same where max is ℓ/(2ζ_o): .2 of 1 in tangents of half the map, 102.4 texels, times the factor .5.
        let burley = base.with_softness(between(0.0, 102.4));
        let error = worst(&burley, &view, 5.0, 51.2);
        assert!(error < 0.012, "{kind:?}: {error}");
        // Depths taken from the near plane would give the factor 5/9 and another radius.
        assert!(worst(&burley, &view, 5.0, 102.4 * 5.0 / 9.0) > 0.02);
        // The gamma shapes the factor.
        assert!(worst(&burley.with_radius_gamma(2.0), &view, 5.0, 25.6) < 0.02);
    }
    // A sun of angular radius ω: half a penumbra is (10 − 5)·tan ω.
    let sun = View::orthographic(DVec3::ZERO, DVec3::NEG_Y, DVec3::NEG_Z, 10.0, 0.0, 50.0, UVec2::splat(1024)).unwrap();
    let light = base.with_softness(Softness::Light { radius: 0.1, nearest: 1.0 });
    let error = worst(&light, &sun, 5.0, 0.5 / (20.0 / 1024.0));
    assert!(error < 0.02, "{error}");
}

#[test]
fn b06_6_units_of_radii_agree_and_wide_blurs_are_cut_off() {
    let view = lamp(256).with_size(UVec2::new(256, 128)).unwrap();
    let caster = map(&view, |texel| if texel.x + texel.y > 190 { 4.0 } else { f32::INFINITY });
    let receiver = facing(&view, 10.0, Vec2::new(128.3, 64.4));
    let answer = |extent: fn(f32) -> MapRadius, size: f32| {
        let softness = Softness::Between { min: extent(0.1 * size), max: extent(size) };
        ask(&presets::burley().filter.with_softness(softness), &caster, &receiver)
    };
    // 1/16 of the map is 16 columns and 8 rows; a texel is 20/256 wide and 20/128 high.
    let (share, world) = (answer(MapRadius::Fraction, 1.0 / 16.0), answer(MapRadius::World, 1.25));
    assert!(share > 0.0 && share < 1.0, "{share}");
    assert_eq!(share, world);
    let square = lamp(256);
    let caster = map(&square, |texel| if texel.x + texel.y > 250 { 4.0 } else { f32::INFINITY });
    let receiver = facing(&square, 10.0, Vec2::splat(128.3));
    let answer = |softness| ask(&presets::burley().filter.with_softness(softness), &caster, &receiver);
    let sized =
        |extent: fn(f32) -> MapRadius, size: f32| Softness::Between { min: extent(0.5 * size), max: extent(size) };
    let texels = answer(sized(MapRadius::Texels, 16.0));
    assert!(texels > 0.0 && texels < 1.0);
    assert_eq!(
        (texels, texels),
        (answer(sized(MapRadius::Fraction, 1.0 / 16.0)), answer(sized(MapRadius::World, 1.25)))
    );
    assert_eq!(answer(between(1e9, 1e9)), answer(between(64.0, 64.0)));
    assert_eq!(answer(between(f32::INFINITY, f32::INFINITY)), answer(between(64.0, 64.0)));
}

#[test]
fn b06_10_opacity_by_distance_is_monotone_and_off_by_default() {
    assert_eq!(presets::burley().filter.opacity, Opacity::FULL);
    for (near, far, gamma) in [(1.0, 0.2, 1.0), (0.1, 0.9, 1.0), (1.0, 0.0, 2.5), (0.3, 1.0, 0.4)] {
        let opacity = Opacity::default().with_near(near).with_far(far).with_fade(8.0).with_gamma(gamma);
        let shares: Vec<f32> = (-4..40).map(|step| opacity.at(step as f32 * 0.5)).collect();
        let forward = shares.windows(2).all(|pair| if far > near { pair[1] >= pair[0] } else { pair[1] <= pair[0] });
        assert!(forward, "{opacity:?}: {shares:?}");
        assert_eq!(
            (opacity.at(0.0), opacity.at(8.0), opacity.at(f32::INFINITY)),
            (near, near + (far - near), near + (far - near))
        );
    }
    assert_eq!(Opacity::FULL.at(1e30), 1.0);
    // Through the filter: an occluder 3 world units away, over half a fade of 6, and no more of it inside the cone than its tip.
    let view = lamp(64);
    let opacity = Opacity::default().with_near(1.0).with_far(0.0).with_fade(6.0).with_gamma(1.0);
    let filter = presets::burley().filter.with_opacity(opacity).with_softness(between(0.5, 2.0));
    let found = ask(&filter, &map(&view, |_| 7.0), &facing(&view, 10.0, Vec2::splat(32.2)));
    assert!((found - 0.5).abs() < 1e-5, "{found}");
}

#[test]
fn b06_5_b06_8_b06_13_sample_counts_are_their_own_and_contact_is_a_constant_radius() {
    let view = lamp(128);
    let caster = map(&view, |texel| if texel.x > 60 { 4.0 } else { f32::INFINITY });
    let receiver = facing(&view, 10.0, Vec2::splat(62.3));
    let counted = |search, blur| {
        let mut counters = Counters::default();
        let filter = presets::burley()
            .filter
            .with_search(presets::burley().filter.search.with_num_samples(search))
            .with_blur(presets::burley().filter.blur.with_num_samples(blur));
        probe(&filter, &caster, &receiver, KEY, &mut counters);
        counters.lookups
    };
    assert_eq!([(32, 32), (5, 64), (100, 1), (0, 0)].map(|(search, blur)| counted(search, blur)), [64, 69, 101, 2]);
    assert_eq!((presets::burley().filter.search.num_samples, presets::burley().filter.blur.num_samples), (32, 32));
    // The picture of before: a constant radius, a constant bias. Soft with min = max is the same share wherever it finds an occluder.
    let depth = Biased::constant(Bias::World(0.1));
    let before = Pcf::default().with_pattern(Disc::default()).with_depth(depth).with_res_factor(0.0).with_min_size(8.0);
    let after = presets::fernando(Bias::World(0.1)).filter.with_softness(between(8.0, 8.0));
    for i in 0..200 {
        let receiver = facing(&view, 10.0, Vec2::new(50.0 + 0.1 * i as f32, 64.0));
        let key = KEY.region(i);
        let [before, after] =
            [probe(&before, &caster, &receiver, key, &mut ()), probe(&after, &caster, &receiver, key, &mut ())];
        assert!(before == after || after == 0.0, "{i}: {before} {after}");
    }
}

#[test]
fn e_b9_what_only_the_blur_meets_is_kept_by_the_rescue() {
    // Blur taps 8 at radius 4 (min): (.5, .5)·4 = (2, 2) is one. The search of radius 4 has its taps elsewhere.
    let view = lamp(64);
    let lone = map(&view, |texel| if texel == IVec2::new(34, 34) { 4.0 } else { f32::INFINITY });
    let receiver = facing(&view, 10.0, Vec2::splat(32.5));
    let filter = presets::burley()
        .filter
        .with_softness(between(4.0, 4.0))
        .with_search(still(8, Density::Centred))
        .with_blur(still(8, Density::Uniform));
    assert_eq!(ask(&filter, &lone, &receiver), 0.0);
    assert_eq!(ask(&filter.with_rescue(true), &lone, &receiver), 0.125);
    // The map's edge makes no difference to that under rules that light what lies outside, nor does a seam between maps.
    let corner = facing(&view, 10.0, Vec2::splat(2.5));
    for rules in [Rules::OPEN, Rules::AROUND] {
        let lone = map(&view.with_rules(rules), |texel| if texel == IVec2::new(4, 4) { 4.0 } else { f32::INFINITY });
        assert_eq!(ask(&filter, &lone, &corner), 0.0);
        assert_eq!(ask(&filter.with_rescue(true), &lone, &corner), 0.125);
    }
}

#[test]
fn w92_6_e_b7_the_edge_of_a_spot_is_dark_whatever_the_opacity() {
    let faint = Opacity::default().with_near(0.25).with_far(0.25).with_fade(1.0).with_gamma(1.0);
    for rescue in [false, true] {
        let filter = presets::burley().filter.with_softness(between(2.0, 4.0)).with_opacity(faint).with_rescue(rescue);
        let answer = |rules, x: f32, depth: f32| {
            let view = lamp(64).with_rules(rules);
            ask(&filter, &map(&view, |_| depth), &facing(&view, 10.0, Vec2::new(x, 32.5)))
        };
        // Empty, with an occluder, far outside, half outside.
        assert_eq!((answer(Rules::SPOT, 32.5, f32::INFINITY), answer(Rules::SPOT, 32.5, 4.0)), (0.0, 0.25));
        assert_eq!((answer(Rules::SPOT, 80.5, f32::INFINITY), answer(Rules::OPEN, 80.5, 4.0)), (1.0, 0.0));
        let (empty, open) = (answer(Rules::SPOT, 64.0, f32::INFINITY), answer(Rules::OPEN, 64.0, 4.0));
        assert!((empty - 0.5).abs() < 0.1 && (open - 0.125).abs() < 0.04, "{empty} {open}");
        let both = answer(Rules::SPOT, 64.0, 4.0);
        assert!((both - 0.625).abs() < 0.1, "{both}");
    }
}

#[test]
fn t_13_rotation_differs_by_region_and_is_still_between_frames() {
    let view = lamp(128);
    let caster = map(&view, |texel| if (texel.x * 7 + texel.y * 3) % 5 < 2 { 4.0 } else { f32::INFINITY });
    let receiver = facing(&view, 10.0, Vec2::splat(64.2));
    let turned = presets::burley().filter;
    let unturned = turned.with_search(turned.search.with_rotate(false)).with_blur(turned.blur.with_rotate(false));
    let all =
        |filter: &Soft| (0..64).map(|i| probe(filter, &caster, &receiver, KEY.region(i), &mut ())).collect::<Vec<_>>();
    let (still, noisy) = (all(&unturned), all(&turned));
    assert!(still.iter().all(|&found| found == still[0]));
    assert!(noisy.iter().any(|&found| found != noisy[0]));
    assert_eq!(noisy, all(&turned));
}

#[test]
fn b06_12_any_store_feeds_it() {
    // Midpoints of a box of thickness 2 over a floor at 10: the floor is their receiver, the lid is not.
    let view = lamp(128);
    let midpoints = map(&view, |texel| if texel.x < 64 { 5.0 } else { f32::INFINITY });
    for filter in [
        presets::burley().filter,
        presets::burley()
            .filter
            .with_depth(BiasCone::default().with_base(0.1).with_slope(0.5).with_radius(Radius::Nominal)),
    ] {
        assert_eq!(ask(&filter, &midpoints, &facing(&view, 10.0, Vec2::new(30.3, 64.0))), 1.0);
        assert_eq!(ask(&filter, &midpoints, &facing(&view, 4.0, Vec2::new(30.3, 64.0))), 0.0);
        assert_eq!(ask(&filter, &midpoints, &facing(&view, 10.0, Vec2::new(100.3, 64.0))), 0.0);
    }
}
