//! Inequalities for moments of depths: they bound what they are said to bound, they are reached where they are sharp, and the filter asks the moments that it says.

use glam::{DVec2, DVec3, UVec2, Vec2, Vec3};
use umbrage_depth::{DepthMap, MomentMap, MomentSource, Moments, Raw};
use umbrage_plane::{Bias, Footprint, Kind, Receiver, SurfacePoint, View, cube_views, mix32};
use umbrage_sample::Key;
use umbrage_shadow::moments::{at_or_beyond, at_or_beyond_by_mean, before};
use umbrage_shadow::{Around, Filter, FromMoments, NormalOffset, Preset, Shadow, ShadowMap, presets};

const KEY: Key = Key::new(15, 0, 0);

const KINDS: [Moments; 5] = [Moments::Variance, Moments::ESM, Moments::EVSM2, Moments::EVSM4, Moments::Four];

/// Numbers in 0..1 from a seed.
struct Draws(u32);

impl Draws {
    fn unit(&mut self) -> f64 {
        self.0 = self.0.wrapping_add(0x9E37_79B9);
        f64::from(mix32(self.0)) / f64::from(1u32 << 31) * 0.5
    }
}

/// Up to nine values of 0..=1 and their shares.
fn distribution(draws: &mut Draws) -> Vec<(f64, f64)> {
    let low = draws.unit() * 0.7;
    let wide = 0.2 + draws.unit() * (0.8 - low);
    let count = 2 + (draws.unit() * 8.0) as usize;
    let values: Vec<(f64, f64)> = (0..count).map(|_| (low + wide * draws.unit(), 0.05 + draws.unit())).collect();
    let sum: f64 = values.iter().map(|(_, share)| share).sum();
    values.into_iter().map(|(value, share)| (value, share / sum)).collect()
}

fn mean(values: &[(f64, f64)], of: impl Fn(f64) -> f64) -> f64 {
    values.iter().map(|(value, share)| of(*value) * share).sum()
}

fn share(values: &[(f64, f64)], of: impl Fn(f64) -> bool) -> f64 {
    mean(values, |value| f64::from(u8::from(of(value))))
}

fn powers(values: &[(f64, f64)]) -> [f64; 4] {
    [1, 2, 3, 4].map(|power| mean(values, |value| value.powi(power)))
}

#[test]
fn each_inequality_bounds_what_it_says_of_every_distribution() {
    let mut draws = Draws(1);
    for _ in 0..20_000 {
        let values = distribution(&mut draws);
        // Anywhere, or just at one of the values.
        let place = if draws.unit() < 0.5 { draws.unit() } else { values[0].0 };
        let beyond = share(&values, |value| value >= place);
        let moments = powers(&values);
        let variance = moments[1] - moments[0] * moments[0];
        let found = at_or_beyond(moments[0], variance, place);
        assert!((0.0..=1.0).contains(&found) && found >= beyond - 1e-9, "{found} of {beyond} beyond {place}");
        let by_mean = at_or_beyond_by_mean(mean(&values, |value| (30.0 * value).exp()), (30.0 * place).exp());
        assert!((0.0..=1.0).contains(&by_mean) && by_mean >= beyond - 1e-12, "{by_mean} of {beyond} beyond {place}");
        let least = before(moments, place);
        assert!((0.0..=1.0).contains(&least) && least <= 1.0 - beyond + 1e-6, "{least} of {} before", 1.0 - beyond);
        // Four moments say more than two, unless roundings are all that there is.
        assert!(1.0 - least <= found + 1e-6 || variance < 1e-4, "{least} by four, {found} by two");
    }
}

#[test]
fn each_inequality_is_reached() {
    let mut draws = Draws(2);
    for _ in 0..5000 {
        let first = draws.unit() * 0.3;
        let values = [first, first + 0.1 + draws.unit() * 0.2, first + 0.4 + draws.unit() * 0.3];
        let [a, b] = [0.1, 0.1].map(|least| least + draws.unit() * 0.35);
        let three = [(values[0], a), (values[1], b), (values[2], 1.0 - a - b)];
        let two = [(values[0], a), (values[2], 1.0 - a)];
        // Three values, asked at each of them; two values, asked at the second.
        for (place, wanted) in [(values[0], 0.0), (values[1], a), (values[2], a + b)] {
            let found = before(powers(&three), place);
            assert!((found - wanted).abs() < 1e-6, "{found} before {place}, not {wanted}: {three:?}");
        }
        let found = before(powers(&two), values[2]);
        assert!((found - a).abs() < 1e-6, "{found} before the second of {two:?}");
        let [mean, square, ..] = powers(&two);
        assert!((at_or_beyond(mean, square - mean * mean, values[2]) - (1.0 - a)).abs() < 1e-9);
        // One value that is positive, and nothing else.
        assert!((at_or_beyond_by_mean(a * values[2], values[2]) - a).abs() < 1e-12);
    }
}

#[test]
fn numbers_that_are_no_moments_give_shares_all_the_same() {
    let hostile = [0.0, 1.0, -1.0, 0.5, 1e-30, 1e30, f64::INFINITY, f64::NEG_INFINITY, f64::NAN];
    for a in hostile {
        for b in hostile {
            for c in hostile {
                for place in [0.0, 0.3, 1.0] {
                    for found in [
                        before([a, b, c, a], place),
                        before([0.5, a, b, c], place),
                        at_or_beyond(a, b.max(0.0), place),
                        at_or_beyond_by_mean(a.abs(), b.abs()),
                    ] {
                        assert!((0.0..=1.0).contains(&found), "{found} of {a}, {b}, {c} at {place}");
                    }
                }
            }
        }
    }
}

fn sun(side: u32) -> View {
    let size = UVec2::splat(side);
    View::orthographic(DVec3::Y * 30.0, DVec3::ZERO, DVec3::NEG_Z, f64::from(side), 1.0, 100.0, size).unwrap()
}

fn map(side: u32, depth: impl Fn(u32, u32) -> f32) -> Raw {
    let depths = (0..side * side).map(|i| depth(i % side, i / side)).collect();
    Raw::new(sun(side), depths).unwrap()
}

/// A receiver that faces the light at a place of the map, with a footprint of `half` texels to each side.
fn receiver(view: &View, at: Vec2, half: f32, depth: f32) -> Receiver {
    let world = view.world_at(at.as_dvec2(), view.key(20.0));
    let seen = view.receiver(&SurfacePoint::at(world, Vec3::Y)).unwrap();
    Receiver { footprint: Footprint::boxed(at, Vec2::splat(half)), texel: at.as_dvec2(), depth, ..seen }
}

fn bare() -> FromMoments {
    FromMoments::default().with_bleeding(0.0)
}

fn ask(filter: FromMoments, map: &impl DepthMap, receiver: &Receiver) -> f32 {
    ask_any(filter, map, receiver)
}

fn ask_any(filter: impl Filter, map: &impl DepthMap, receiver: &Receiver) -> f32 {
    ShadowMap { filter, map }.fraction_of(receiver, KEY)
}

/// Depths of 10 to 20, holes among them; in most blocks of four by four texels only a few different ones.
fn blocks(seed: u32) -> Raw {
    map(32, |x, y| {
        let block = mix32(seed ^ (x / 4) << 8 ^ (y / 4));
        let level = mix32(block ^ x << 16 ^ y) % (2 + block % 6);
        let bits = mix32(block ^ level << 20);
        if bits.is_multiple_of(9) { f32::INFINITY } else { 10.0 + (bits >> 8) as f32 * 10.0 / (1 << 24) as f32 }
    })
}

#[test]
fn no_shadow_is_darker_than_the_region_that_it_stands_for() {
    let (mut asked, mut rounded) = (0, 0);
    for seed in 0..8 {
        let raw = blocks(seed);
        let maps = KINDS.map(|kind| MomentMap::of(&raw, kind, 0.0));
        for block in 0..64 {
            let corner = UVec2::new(block % 8, block / 8) * 4;
            let texels = (0..16).map(|i| raw.depths()[((corner.y + i / 4) * 32 + corner.x + i % 4) as usize]);
            let texels: Vec<f32> = texels.collect();
            let depths = (0..24).map(|step| 9.5 + step as f32 * 0.5).chain(texels.iter().copied());
            for depth in depths.filter(|depth| depth.is_finite()) {
                // Four texels wide, at the centre of four by four texels: these alone are looked up.
                let at = receiver(raw.view(), corner.as_vec2() + 2.0, 2.0, depth);
                let exact = texels.iter().filter(|stored| depth > **stored).count() as f32 / 16.0;
                let found = maps.each_ref().map(|map| ask(bare(), map, &at));
                for (kind, found) in KINDS.iter().zip(found) {
                    // Squares of exponentials have lost digits to their mean, and four moments most of them where values lie close together.
                    let rounding = match kind {
                        Moments::Variance | Moments::Deviation { .. } | Moments::Exponential { .. } => 1e-4,
                        Moments::ExponentialVariance { .. } => 5e-4,
                        Moments::Four => 5e-3,
                    };
                    asked += 1;
                    rounded += u32::from(found > exact + 1e-4);
                    assert!((0.0..=exact + rounding).contains(&found), "{kind:?}: {found} of {exact} before {depth}");
                }
                let [_, _, two, four, _] = found;
                assert!(four >= two, "the second exponential lightens: {four}, {two}");
            }
        }
    }
    assert!(rounded * 1000 < asked, "{rounded} of {asked}");
}

#[test]
fn two_depths_are_told_apart_exactly_where_the_receiver_is_at_the_second() {
    for near in 1..16 {
        // Near texels among far ones, block by block alike.
        let raw = map(16, |x, y| if (x % 4) + 4 * (y % 4) < near { 12.0 } else { 17.0 });
        let wanted = near as f32 / 16.0;
        for kind in KINDS {
            let map = MomentMap::of(&raw, kind, 0.0);
            let found = ask(bare(), &map, &receiver(raw.view(), Vec2::new(6.0, 10.0), 2.0, 17.0));
            assert!((found - wanted).abs() < 1e-4, "{kind:?}: {found}, not {wanted}");
        }
    }
    // Three depths: four moments alone know how much lies before the second and the third.
    let raw = map(16, |x, _| [12.0, 14.0, 17.0, 17.0][x as usize % 4]);
    let at = |depth| receiver(raw.view(), Vec2::new(6.0, 10.0), 2.0, depth);
    let found = |kind, depth| ask(bare(), &MomentMap::of(&raw, kind, 0.0), &at(depth));
    assert!((found(Moments::Four, 14.0) - 0.25).abs() < 1e-3 && (found(Moments::Four, 17.0) - 0.5).abs() < 1e-3);
    assert!(found(Moments::Variance, 14.0) == 0.0 && found(Moments::Variance, 17.0) < 0.49, "light bleeds");
}

#[test]
fn shadows_grow_with_the_receiver_s_depth_and_shrink_where_the_light_s_tail_is_kept() {
    let raw = blocks(5);
    for kind in KINDS {
        let map = MomentMap::of(&raw, kind, 1.5);
        for i in 0..40 {
            let mut draws = Draws(i);
            let at = Vec2::new(draws.unit() as f32, draws.unit() as f32) * 32.0;
            let half = draws.unit() as f32 * 4.0;
            let mut last = 0.0;
            for step in 0..200 {
                let seen = receiver(raw.view(), at, half, 9.0 + step as f32 * 0.06);
                let found = ask(bare(), &map, &seen);
                assert!(found >= last - 1e-6 && found <= 1.0, "{kind:?}: {found} after {last} at step {step}");
                last = last.max(found);
                let cut = ask(bare().with_bleeding(0.25), &map, &seen);
                let wanted = (found / 0.75).min(1.0);
                assert!((cut - wanted).abs() < 1e-5, "{kind:?}: {cut} of {found}");
            }
        }
    }
}

#[test]
fn an_empty_map_is_lit_and_one_full_of_a_near_surface_dark() {
    for kind in KINDS {
        for blur in [0.0, 2.0] {
            let of = |depth| MomentMap::of(&map(16, |_, _| depth), kind, blur);
            for half in [0.0, 0.5, 3.0] {
                let at = |depth| receiver(&sun(16), Vec2::new(7.3, 9.0), half, depth);
                for stored in [f32::INFINITY, 15.0, 15.5] {
                    assert_eq!(ask(bare(), &of(stored), &at(15.0)), 0.0, "{kind:?}");
                }
                let dark = ask(bare(), &of(5.0), &at(15.0));
                assert!(dark >= 1.0 - 2e-6, "{kind:?}: {dark}");
                for nothing in [f32::NAN, f32::NEG_INFINITY] {
                    assert_eq!(ask(bare(), &of(5.0), &at(nothing)), 0.0, "{kind:?}");
                }
                for cut in [1.0, 2.0, f32::INFINITY] {
                    assert_eq!(ask(bare().with_bleeding(cut), &of(5.0), &at(15.0)), 1.0, "{kind:?}");
                    assert_eq!(ask(bare().with_bleeding(cut), &of(5.0), &at(5.0)), 0.0, "{kind:?}");
                }
                assert_eq!(ask(bare().with_bleeding(f32::NAN), &of(5.0), &at(15.0)), dark, "{kind:?}");
            }
        }
    }
}

/// Far behind the farthest surface that is stored, where no surface lies and beside it.
#[test]
fn what_is_not_in_the_map_is_behind_its_surfaces_and_not_behind_its_holes() {
    let raw = map(32, |x, _| {
        if x < 8 {
            5.0
        } else if x < 16 {
            6.0
        } else {
            f32::INFINITY
        }
    });
    for kind in KINDS {
        let map = MomentMap::of(&raw, kind, 0.0);
        for (x, wanted) in [(4.0, 1.0), (12.0, 1.0), (20.0, 0.0), (28.0, 0.0)] {
            for depth in [7.0, 20.0, 1e9, f32::INFINITY] {
                let found = ask(bare(), &map, &receiver(raw.view(), Vec2::new(x, 9.0), 1.0, depth));
                assert!((found - wanted).abs() < 2e-4, "{kind:?}: {found} at {x}, {depth}");
            }
        }
    }
}

/// The presets over their own maps.
fn all() -> [(Preset<FromMoments>, Moments); 5] {
    let presets = [presets::vsm(), presets::esm(), presets::evsm2(), presets::evsm4(), presets::msm()];
    std::array::from_fn(|i| (presets[i], KINDS[i]))
}

#[test]
fn a_plane_does_not_shadow_itself() {
    let side = 64;
    let view = sun(side);
    for slope in [0.0, 0.1, 1.0, 4.0] {
        // As the rasteriser has it: the plane's depth at each texel's centre.
        let plane = |at: DVec2| 20.0 + slope * (at.x - 32.0) * 0.8 + slope * (at.y - 32.0) * 0.6;
        let raw = map(side, |x, y| plane(UVec2::new(x, y).as_dvec2() + 0.5) as f32);
        for (preset, kind) in all() {
            for blur in [0.0, 1.0] {
                let map = MomentMap::of(&raw, kind, blur);
                let mut most = 0.0f32;
                for i in 0..200 {
                    let mut draws = Draws(i);
                    let at = DVec2::new(draws.unit(), draws.unit()) * 40.0 + 12.0;
                    let seen = receiver(&view, at.as_vec2(), 0.5 * draws.unit() as f32, plane(at) as f32);
                    let seen = Receiver { slope: slope as f32, ..seen };
                    most = most.max(ask(preset.filter, &map, &seen));
                }
                assert!(most < 0.06, "{}: {most} on a slope of {slope}, blur {blur}", preset.name);
                if blur == 0.0 || kind != Moments::Four {
                    assert!(most < 0.02, "{}: {most} on a slope of {slope}, blur {blur}", preset.name);
                }
            }
        }
    }
}

#[test]
fn a_step_s_edge_is_soft_and_a_blur_makes_it_softer() {
    let raw = map(64, |x, _| if x < 32 { 5.0 } else { 20.0 });
    for (preset, kind) in all() {
        let width = |blur: f32| {
            let map = MomentMap::of(&raw, kind, blur);
            let row = (0..640)
                .map(|i| ask(preset.filter, &map, &receiver(raw.view(), Vec2::new(i as f32 * 0.1, 30.0), 0.5, 20.0)));
            let row: Vec<f32> = row.collect();
            assert!(row.windows(2).all(|pair| pair[1] <= pair[0] + 1e-6), "{}: darker away from it", preset.name);
            assert_eq!((row[0], row[639]), (1.0, 0.0), "{}", preset.name);
            row.iter().filter(|dark| **dark > 0.1 && **dark < 0.9).count()
        };
        let [sharp, soft] = [0.0, 3.0].map(width);
        assert!(sharp <= 10 && soft > 2 * sharp, "{}: {sharp} and {soft} tenths of a texel", preset.name);
    }
}

#[test]
fn without_moments_the_four_nearest_texels_are_compared() {
    let raw = map(16, |x, y| if x < 8 && y < 8 { 5.0 } else { 20.0 });
    let at = |x, y| ask(bare(), &raw, &receiver(raw.view(), Vec2::new(x, y), 6.0, 15.0));
    assert_eq!((at(4.0, 4.0), at(8.0, 8.0), at(8.0, 4.0), at(8.5, 8.5)), (1.0, 0.25, 0.5, 0.0));
    assert_eq!(at(7.75, 4.0), 0.75);
    assert_eq!(ask(bare(), &raw, &receiver(raw.view(), Vec2::splat(4.0), 1.0, f32::NAN)), 0.0);
    let biased = FromMoments::default().with_bias(Bias::World(11.0));
    assert_eq!(ask(biased, &raw, &receiver(raw.view(), Vec2::splat(4.0), 1.0, 15.0)), 0.0);
}

#[test]
fn maps_around_a_light_have_moments_each_its_own() {
    let views = cube_views(DVec3::ZERO, 0.5, 100.0, 32).unwrap().map(|view| view.with_kind(Kind::Axial));
    let maps = views.map(|view| {
        let depths = (0..32 * 32).map(|i| if i % 32 < 16 { 3.0 } else { 9.0 }).collect();
        MomentMap::of(&Raw::new(view, depths).unwrap(), Moments::Four, 2.0)
    });
    let around = Around::new(presets::msm().filter, maps.to_vec()).unwrap();
    let mut soft = 0;
    for (view, map) in views.iter().zip(&maps) {
        let alone = ShadowMap { filter: presets::msm().filter, map };
        for i in 0..33 {
            let place = DVec2::new(f64::from(i) * 0.97, 11.0);
            let point = SurfacePoint::at(view.world_at(place, view.key(9.0)), (-view.ahead()).as_vec3());
            let found = around.fraction(&point, KEY);
            assert_eq!(found.to_bits(), alone.fraction(&point, KEY).to_bits(), "at {place}");
            soft += u32::from(found > 0.1 && found < 0.9);
        }
    }
    assert!(soft > 6, "blurred on each face: {soft}");
}

/// `getShadow` of three.js for `VSMShadowMap` (r187, `shadowmap_pars_fragment.glsl.js`): how much light there is, by a mean, a deviation and the depth that is compared.
fn light_of_three(mean: f64, deviation: f64, z: f64) -> f64 {
    if z <= mean {
        return 1.0;
    }
    let variance = (deviation * deviation).max(0.000_000_1);
    let d = z - mean;
    let p_max = variance / (variance + d * d);
    ((p_max - 0.3) / 0.65).clamp(0.0, 1.0)
}

#[test]
fn deviations_shadow_as_three_s_variance_shadow_maps() {
    let three = bare().with_bleeding(0.3).with_lit_from(0.95).with_least_variance(1e-7);
    let raw = blocks(11);
    let map = MomentMap::of(&raw, Moments::Deviation { samples: 8 }, 1.0);
    let mut draws = Draws(3);
    let (mut partly, mut cut) = (0, 0);
    for _ in 0..5000 {
        let at = Vec2::new(draws.unit() as f32, draws.unit() as f32) * 32.0;
        // However large the footprint is: there are no coarser levels. The range of the view is 1 to 100.
        let depth = 9.0 + 14.0 * draws.unit() as f32;
        let seen = receiver(raw.view(), at, 6.0 * draws.unit() as f32, depth);
        let [mean, deviation, ..] = map.at(at, 0.0);
        let light = light_of_three(mean, deviation, (f64::from(depth) - 1.0) / 99.0);
        let found = ask(three, &map, &seen);
        assert!((f64::from(found) - (1.0 - light)).abs() < 2e-6, "{found}, not {} at {at}", 1.0 - light);
        partly += u32::from(light > 0.0 && light < 1.0);
        // Lit by the upper end alone, and dark by the lower.
        cut += u32::from(ask(three.with_lit_from(1.0), &map, &seen) != found);
    }
    assert!(partly > 500 && cut > 500, "{partly} partly lit, {cut} by the upper end");
    // An end at which nothing is left but what is wholly lit.
    for end in [0.3, 0.0, -1.0] {
        let found = |depth| ask(three.with_lit_from(end), &map, &receiver(raw.view(), Vec2::splat(9.3), 0.5, depth));
        assert_eq!((found(99.0), found(2.0)), (1.0, 0.0), "{end}");
    }
    let seen = receiver(raw.view(), Vec2::splat(9.3), 0.5, 15.0);
    let unchanged = [1.0, 2.0, f32::NAN].map(|end| ask(three.with_lit_from(end), &map, &seen).to_bits());
    assert!(unchanged.iter().all(|bits| *bits == unchanged[0]));
}

#[test]
fn a_receiver_that_is_moved_is_looked_up_where_it_was_moved_to() {
    let raw = map(32, |x, _| if x < 16 { 5.0 } else { 20.0 });
    let map = MomentMap::of(&raw, Moments::Variance, 0.0);
    let offset = NormalOffset::default().with_texels(2.0);
    // Tilted, so that its normal leads aside.
    let normal = raw.view().direction_to_world(DVec3::new(0.8, 0.0, 0.6));
    let (mut apart, mut partly) = (0, 0);
    for i in 0..40 {
        let world = raw.view().world_at(DVec2::new(13.0 + 0.1 * f64::from(i), 9.0), raw.view().key(20.0));
        let seen = raw.view().receiver(&SurfacePoint::at(world, normal.as_vec3())).unwrap();
        let found = ask_any(bare().with_depth(offset), &map, &seen);
        let moved = seen.offset(raw.view(), offset.world(raw.view(), &seen)).unwrap();
        assert!((moved.texel.x - seen.texel.x - 1.6).abs() < 1e-5, "{} from {}", moved.texel, seen.texel);
        let wanted = ask(bare(), &map, &moved);
        assert!((found - wanted).abs() < 1e-5, "{found}, not {wanted}");
        apart += u32::from((found - ask(bare(), &map, &seen)).abs() > 0.1);
        partly += u32::from(found > 0.1 && found < 0.9);
    }
    assert!(apart > 10 && partly > 3, "{apart} elsewhere, {partly} partly lit");
}
