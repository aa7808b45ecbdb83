//! Slope-scaled biases and normal offsets over planes that stand alone: what they must be for false shadow to end, and what they do.

use glam::{DVec2, DVec3, UVec2, Vec3};
use proptest::prelude::*;
use umbrage_depth::Raw;
use umbrage_plane::{Bias, Kind, Receiver, SurfacePoint, View};
use umbrage_sample::{EveryTexel, Key, Tent};
use umbrage_shadow::{AnyDepth, Biased, Moved, NormalOffset, OffsetGrowth, Pcf, ReceiverDepth, ShadowMap, SlopeScaled};

const KEY: Key = Key::new(5, 0, 0);

/// Parallel light or a spot, of linear or screen depth, texels that are not square.
fn views() -> impl Strategy<Value = View> {
    any::<bool>().prop_flat_map(lights)
}

fn lights(spot: bool) -> impl Strategy<Value = View> {
    (Just(spot), any::<bool>(), 2.0f64..20.0, 20u32..80, 20u32..80).prop_map(|(spot, screen, width, x, y)| {
        let size = UVec2::new(x, y);
        let eye = DVec3::new(1.0, 9.0, 2.0);
        let view = if spot {
            View::perspective(eye, DVec3::ZERO, DVec3::Z, width / 15.0, 0.5, 60.0, size)
        } else {
            View::orthographic(eye, DVec3::ZERO, DVec3::Z, width, 0.5, 60.0, size)
        };
        let view = view.unwrap();
        if screen { view.with_kind(Kind::Screen) } else { view }
    })
}

/// A surface's place in a map, as shares of its sides, and its normal in the light's eye space, up to 88° from the light.
fn surfaces() -> impl Strategy<Value = (DVec2, DVec3)> {
    (0.3f64..0.7, 0.3f64..0.7, 0.0f64..1.54, 0.0f64..std::f64::consts::TAU).prop_map(|(x, y, tilt, around)| {
        let (across, along) = tilt.sin_cos();
        (DVec2::new(x, y), DVec3::new(across * around.cos(), across * around.sin(), along))
    })
}

/// A receiver on a plane that fills the map alone; none where it faces away from the light.
fn plane(view: &View, (place, normal): (DVec2, DVec3)) -> Option<(Raw, Receiver)> {
    let world = view.world_at(place * view.size().as_dvec2(), view.key(9.0));
    let normal = view.world_to_eye().inverse().transform_vector3(normal);
    let seen = view.receiver(&SurfacePoint::at(world, normal.as_vec3())).ok()?;
    let plane = seen.plane(view);
    let size = view.size();
    let depths = (0..size.element_product()).map(|i| plane.at(UVec2::new(i % size.x, i / size.x).as_dvec2() + 0.5));
    let filled = Raw::new(*view, depths.map(|depth| depth.max(-1e30)).collect()).ok()?;
    (seen.facing > 0.02).then_some((filled, seen))
}

/// What of a box of `half` texels to each side a depth darkens.
fn dark(map: &Raw, receiver: &Receiver, half: f32, depth: impl ReceiverDepth) -> f32 {
    let filter = Pcf::default().with_pattern(EveryTexel).with_depth(depth).with_res_factor(0.0).with_min_size(half);
    ShadowMap { filter, map }.fraction_of(receiver, KEY)
}

/// World units that cover the rounding of stored depths and of what is computed with them.
fn rounding(view: &View, receiver: &Receiver) -> f32 {
    let step = 4.0 * (receiver.depth.abs().next_up() - receiver.depth.abs());
    let zeta = view.decode().zeta(receiver.depth + step) - view.decode().zeta(receiver.depth);
    if view.kind() == Kind::Screen { zeta as f32 } else { 1e-5 }
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(2000))]

    /// Twice the filter's half, in texels, at any tilt; and no more than the clamp.
    #[test]
    fn a_slope_scaled_bias_of_twice_the_half_is_free_of_false_shadow(view in views(), surface in surfaces(), half in 0.5f32..4.0) {
        let Some((map, seen)) = plane(&view, surface) else { return Ok(()) };
        let depth = SlopeScaled::default().with_slope(2.0 * half * 1.0001).with_constant(Bias::World(rounding(&view, &seen)));
        prop_assert_eq!(dark(&map, &seen, half, depth), 0.0, "{:?}", seen);
        // Up to the clamp it is the same bias, and from there on the clamp.
        let whole = depth.world(&view, &seen);
        prop_assert_eq!(dark(&map, &seen, half, depth.with_most(whole)), 0.0);
        prop_assert_eq!(depth.with_most(0.5 * whole).world(&view, &seen), 0.5 * whole);
    }

    /// √2 times the filter's half, in texels, in parallel light whatever the tilt: even where it shrinks with the sine.
    #[test]
    fn a_normal_offset_of_the_half_diagonal_is_free_of_false_shadow(view in lights(false), surface in surfaces(), half in 0.5f32..4.0) {
        let Some((map, seen)) = plane(&view, surface) else { return Ok(()) };
        for growth in [OffsetGrowth::Even, OffsetGrowth::Sine] {
            let depth = NormalOffset::default().with_texels(half * std::f32::consts::SQRT_2 * 1.0001).with_growth(growth);
            let depth = depth.with_bias(Bias::World(rounding(&view, &seen) / seen.facing));
            prop_assert_eq!(dark(&map, &seen, half, depth), 0.0, "{:?}, {:?}", growth, seen);
        }
    }

    /// On a plane in parallel light an offset of s is s/cos θ along the light.
    #[test]
    fn an_offset_lifts_what_is_compared_by_its_length_over_the_cosine(surface in surfaces(), offset in 0.0f64..0.5) {
        let view = View::orthographic(DVec3::Y * 9.0, DVec3::ZERO, DVec3::Z, 8.0, 0.5, 60.0, UVec2::splat(64)).unwrap();
        let Some((_, seen)) = plane(&view, surface) else { return Ok(()) };
        let moved = Moved::by(&view, &seen, offset, 0.0);
        let beneath = seen.plane(&view).at(seen.texel + moved.shift.as_dvec2());
        let wanted = offset / f64::from(seen.facing);
        prop_assert!((f64::from(beneath - moved.depth) - wanted).abs() < 1e-4 * (1.0 + wanted), "{:?}, {}", moved, wanted);
    }

    /// The receiver of the surface point that was moved itself.
    #[test]
    fn an_offset_is_where_the_moved_point_is_seen(view in views(), surface in surfaces(), offset in -0.5f64..0.5, toward in 0.0f64..0.3) {
        let Some((_, seen)) = plane(&view, surface) else { return Ok(()) };
        let to_world = view.world_to_eye().inverse();
        let there = to_world.transform_point3(seen.eye + seen.normal * offset);
        let wanted = view.receiver(&SurfacePoint::at(there, Vec3::Y)).unwrap();
        let moved = Moved::by(&view, &seen, offset, toward);
        prop_assert!((seen.texel + moved.shift.as_dvec2()).abs_diff_eq(wanted.texel, 1e-4), "{:?} {:?}", moved, wanted);
        let depth = wanted.nearer(&view, Bias::World(toward as f32));
        prop_assert!((moved.depth - depth).abs() <= 2e-6 * depth.abs().max(1.0), "{:?} {}", moved, depth);
    }

    /// The steeper of a row's and a column's first differences on the plane.
    #[test]
    fn steeper_steps_are_the_change_to_the_next_texel(view in views(), surface in surfaces()) {
        let Some((_, seen)) = plane(&view, surface) else { return Ok(()) };
        // Of a view of linear depth, whose key is what ζ is a function of.
        let linear = view.with_kind(Kind::Axial);
        let plane = linear.affine(seen.eye, seen.normal);
        let Some(plane) = plane else { return Ok(()) };
        let zeta = |shift: DVec2| {
            let key = plane.at(seen.texel + shift);
            if linear.is_perspective() { -1.0 / key } else { key }
        };
        let step = 1e-3;
        let change = |axis: DVec2| ((zeta(axis * step) - zeta(axis * -step)) / (2.0 * step)).abs();
        let wanted = change(DVec2::X).max(change(DVec2::Y));
        let found = f64::from(seen.steeper_steps(&view, 1.0));
        prop_assert!((found - wanted).abs() <= 1e-3 * (1e-3 + wanted), "{} {}", found, wanted);
        prop_assert!(found <= 1.0001 * f64::from(seen.texel_world.max_element() * seen.slope));
    }
}

/// Half of what is needed is not enough, so that the laws above do not hold of themselves.
#[test]
fn half_of_it_shadows_planes() {
    let view = View::orthographic(DVec3::Y * 9.0, DVec3::ZERO, DVec3::Z, 8.0, 0.5, 60.0, UVec2::splat(64)).unwrap();
    let tilt = 1.2f64;
    let along_a_row = DVec3::new(tilt.sin(), 0.0, tilt.cos());
    let along_the_diagonal = DVec3::new(0.5f64.sqrt() * tilt.sin(), 0.5f64.sqrt() * tilt.sin(), tilt.cos());
    for normal in [along_a_row, along_the_diagonal] {
        let places = (0..64).map(|i| DVec2::new(0.5 + f64::from(i % 8) / 512.0, 0.5 + f64::from(i / 8) / 512.0));
        let seen: Vec<_> = places.map(|place| plane(&view, (place, normal)).unwrap()).collect();
        let half = 1.5;
        let depths: [(AnyDepth, bool); 6] = [
            (Biased::constant(Bias::ZERO).into(), true),
            (SlopeScaled::default().with_slope(half * 0.5).into(), true),
            (SlopeScaled::default().with_slope(half * 2.0).into(), false),
            (SlopeScaled::default().with_slope(half * 2.0).with_most(0.01).into(), true),
            (NormalOffset::default().with_texels(half * 0.5).into(), true),
            (NormalOffset::default().with_texels(half * 1.5).into(), false),
        ];
        for (depth, shadowed) in depths {
            let found = seen.iter().any(|(map, seen)| dark(map, seen, half, depth) > 0.0);
            assert_eq!(found, shadowed, "{depth:?}");
        }
    }
}

/// Any depth has the bits of its own type, and a filter over an offset is the filter over the receiver that was moved.
#[test]
fn an_offset_moves_the_place_that_is_asked() {
    let view = View::perspective(DVec3::Y * 9.0, DVec3::ZERO, DVec3::Z, 0.8, 0.5, 60.0, UVec2::splat(64)).unwrap();
    let texels = (0..64 * 64).map(|i| if (i % 64 / 5 + i / 64 / 7) % 2 == 0 { 6.0 } else { 12.0 }).collect();
    let map = Raw::new(view, texels).unwrap();
    let depth = NormalOffset::default().with_texels(2.5);
    let mut moved_answers = 0;
    let mut apart = 0;
    for i in 0..500 {
        let draw = |dim| f64::from(KEY.unit(i, dim));
        let at = view.world_at(DVec2::new(8.0 + 48.0 * draw(0), 8.0 + 48.0 * draw(1)), view.key(9.0));
        let normal = DVec3::new(draw(2) - 0.5, 0.6, draw(3) - 0.5).normalize();
        let seen = view.receiver(&SurfacePoint::at(at, normal.as_vec3())).unwrap();
        let tent = Pcf::default().with_pattern(Tent).with_res_factor(0.0).with_min_size(1.0);
        let ask = |receiver: &Receiver, depth: AnyDepth| {
            ShadowMap { filter: tent.with_depth(depth), map: &map }.fraction_of(receiver, KEY)
        };
        let own = ShadowMap { filter: tent.with_depth(depth), map: &map }.fraction_of(&seen, KEY);
        assert_eq!(own, ask(&seen, depth.into()));
        let there = seen.offset(&view, depth.world(&view, &seen)).unwrap();
        let plain = AnyDepth::from(Biased::constant(Bias::ZERO));
        apart += u32::from((own - ask(&there, plain)).abs() > 1e-4);
        moved_answers += u32::from((own - ask(&seen, plain)).abs() > 1e-2);
    }
    assert_eq!(apart, 0);
    assert!(moved_answers > 100, "{moved_answers}");
}

/// What an offset moves behind the light is lit; edge-on, where no step is finite, a slope-scaled bias lights all and no slope changes nothing.
#[test]
fn what_has_no_place_is_lit() {
    let view = View::perspective(DVec3::Y * 9.0, DVec3::ZERO, DVec3::Z, 0.8, 0.5, 60.0, UVec2::splat(64)).unwrap();
    let seen = view.receiver(&SurfacePoint::at(Vec3::ZERO, Vec3::Y)).unwrap();
    assert_eq!(seen.offset(&view, 9.5), None);
    assert_eq!(seen.offset(&view, f64::NAN), None);
    assert_eq!(Moved::by(&view, &seen, 9.5, 0.0).depth, f32::NEG_INFINITY);
    let edge_on = Receiver { facing: 0.0, slope: f32::INFINITY, normal: DVec3::X, ..seen };
    assert_eq!(SlopeScaled::default().world(&view, &edge_on), f32::INFINITY);
    assert_eq!(SlopeScaled::default().with_slope(0.0).world(&view, &edge_on), 0.0);
    assert_eq!(SlopeScaled::default().with_most(0.25).world(&view, &edge_on), 0.25);
}

/// Where the cosine is 1 in single precision the sine is not 0 yet, and the depth still changes from texel to texel.
#[test]
fn an_offset_by_the_sine_lasts_to_surfaces_that_all_but_face_the_light() {
    let view = View::orthographic(DVec3::Y * 9.0, DVec3::ZERO, DVec3::Z, 20.0, 0.5, 60.0, UVec2::splat(20)).unwrap();
    let tilt = 1.3e-4f64;
    let (map, seen) = plane(&view, (DVec2::splat(0.3), DVec3::new(tilt.sin(), 0.0, tilt.cos()))).unwrap();
    assert_eq!(seen.facing, 1.0);
    let depth = NormalOffset::default().with_texels(0.8).with_growth(OffsetGrowth::Sine);
    let wanted = 0.8 * f64::from(seen.texel_world.max_element()) * tilt;
    assert!((depth.world(&view, &seen) / wanted - 1.0).abs() < 1e-3, "{}", depth.world(&view, &seen));
    assert_eq!(dark(&map, &seen, 0.5, depth.with_bias(Bias::World(rounding(&view, &seen)))), 0.0);
}
