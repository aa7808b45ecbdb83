//! The bias cone over planes that stand alone: where it is free of false shadow, and where it is not (B06-1 to B06-3, D-15).

use super::{KEY, ask, between, map, probe};
use glam::{DVec2, DVec3, UVec2, Vec3};
use umbrage_depth::Raw;
use umbrage_plane::{Kind, Receiver, Sampling, SurfacePoint, View};
use umbrage_sample::Disc;
use umbrage_shadow::{BiasCone, Pcf, Radius, Soft, presets};

/// A random view: parallel or not, of screen or axial depth, stochastic or not, its texels not square.
fn random_view(i: u32) -> View {
    let draw = |dim| f64::from(KEY.unit(i, dim));
    let size = UVec2::new(16 + (draw(0) * 100.0) as u32, 16 + (draw(1) * 100.0) as u32);
    let eye = DVec3::new(draw(2) * 4.0, 3.0 + draw(3), draw(4));
    let view = if i.is_multiple_of(2) {
        View::perspective(eye, DVec3::ZERO, DVec3::Z, 0.4 + 1.4 * draw(5), 0.5, 60.0, size)
    } else {
        View::orthographic(eye, DVec3::ZERO, DVec3::Z, 5.0 + 10.0 * draw(5), 0.5, 60.0, size)
    };
    let view = view.unwrap().with_size(UVec2::new(size.x, 16 + (draw(6) * 150.0) as u32)).unwrap();
    let view = if i % 4 < 2 { view } else { view.with_kind(Kind::Screen) };
    if i % 8 < 4 { view } else { view.with_sampling(Sampling::Jittered { seed: i }) }
}

/// A plane that fills the map alone, and a receiver on it whose effective slope is within `slopes`.
fn random_plane(i: u32, slopes: std::ops::Range<f32>) -> Option<(Raw, Receiver)> {
    let view = random_view(i);
    let draw = |dim| f64::from(KEY.unit(i, dim));
    let at = DVec2::new(draw(7), draw(8)) * view.size().as_dvec2();
    let world = view.world_at(at, view.key(2.0 + 20.0 * draw(9)));
    let normal = DVec3::new(draw(10) - 0.5, draw(11) - 0.5, draw(12) - 0.5).try_normalize()?;
    let seen = view.receiver(&SurfacePoint::at(world.as_vec3(), normal.as_vec3())).ok()?;
    let plane = seen.plane(&view);
    let filled = map(&view, |texel| plane.at(view.sampling().position(texel)).max(-1e30));
    slopes.contains(&seen.slope).then_some((filled, seen))
}

fn soft(depth: BiasCone) -> Soft {
    presets::burley().filter.with_softness(between(1.0, 9.0)).with_depth(depth).with_rescue(true)
}

/// Of planes that stand alone: how many, and how many a cone darkens anywhere.
fn darkened(slopes: std::ops::Range<f32>, cone: impl Fn(&Receiver) -> BiasCone) -> (u32, u32) {
    let (mut all, mut dark) = (0, 0);
    for i in 0..6000 {
        let Some((plane, receiver)) = random_plane(i, slopes.clone()) else { continue };
        let depth = cone(&receiver);
        let filtered =
            Pcf::default().with_pattern(Disc::default()).with_depth(depth).with_res_factor(0.0).with_min_size(5.0);
        let key = KEY.region(i);
        all += 1;
        let found =
            [probe(&filtered, &plane, &receiver, key, &mut ()), probe(&soft(depth), &plane, &receiver, key, &mut ())];
        dark += u32::from(found != [0.0, 0.0]);
    }
    (all, dark)
}

#[test]
fn d_15_b06_3_planes_within_the_slope_are_free_of_false_shadow() {
    for slope in [0.5, 1.0, 2.0] {
        let (all, dark) = darkened(0.0..0.999 * slope, |_| BiasCone::default().with_slope(slope));
        assert!(all > 400, "{all}");
        assert_eq!(dark, 0, "slope {slope}: of {all} planes");
    }
    // The printed radius needs a base of τ·tanθ/√2 besides.
    let nominal = |base| BiasCone::default().with_base(base).with_radius(Radius::Nominal);
    let (all, dark) = darkened(1.0..1.998, |_| nominal(0.0));
    println!("nominal radius, no base: {dark} of {all} planes");
    assert!(dark > all / 20, "{dark} of {all}");
    // The map's samples are up to half a diagonal away, a whole one where they are stochastic.
    let (all, dark) = darkened(0.0..1.998, |at| nominal(at.texel_world.length() * at.slope));
    assert_eq!(dark, 0, "of {all} planes");
}

/// A tap exactly on the receiver has no bias but the base: rounding may put the receiver a last bit behind its own surface.
#[test]
fn d_15_b06_1_a_tiny_base_covers_rounding_at_the_tip() {
    let (mut all, mut dark) = (0, [0; 2]);
    for i in 0..4000 {
        let view = random_view(i);
        let draw = |dim| f64::from(KEY.unit(i, dim));
        let texel = (DVec2::new(draw(7), draw(8)) * view.size().as_dvec2()).floor().as_ivec2();
        let world = view.world_at(view.sampling().position(texel), view.key(2.0 + 20.0 * draw(9)));
        let normal = DVec3::new(draw(10) - 0.5, 4.0, draw(12) - 0.5).normalize();
        let seen = view.receiver(&SurfacePoint::at(world.as_vec3(), normal.as_vec3())).unwrap();
        if seen.slope > 1.9 {
            continue;
        }
        all += 1;
        let plane = seen.plane(&view);
        let filled = map(&view, |texel| plane.at(view.sampling().position(texel)));
        // Three roundings of the stored number, in world units.
        let rounding =
            view.decode().zeta(seen.depth + 3.0 * (seen.depth.next_up() - seen.depth)) - view.decode().zeta(seen.depth);
        let rounding = if view.kind() == Kind::Screen { rounding as f32 } else { 1e-6 * seen.depth };
        for (count, base) in dark.iter_mut().zip([0.0, rounding]) {
            *count += u32::from(ask(&soft(BiasCone::default().with_base(base)), &filled, &seen) > 0.0);
        }
    }
    println!("receivers on the map's own samples: {} dark of {all}, {} with a base", dark[0], dark[1]);
    assert!(all > 2000 && dark[0] > 0, "{all}");
    assert_eq!(dark[1], 0);
}

#[test]
fn v62_d_15_steeper_planes_shadow_themselves() {
    let slope = |slope| BiasCone::default().with_slope(slope);
    let (all, dark) = darkened(1.2..1.9, |_| slope(1.0));
    println!("slope 1 beyond 45°: {dark} of {all} planes");
    assert!(dark > all / 2, "{dark} of {all}");
    assert_eq!(darkened(1.2..1.9, |_| slope(2.0)).1, 0);
    let (all, dark) = darkened(2.5..6.0, |_| slope(2.0));
    assert!(dark > all / 2, "{dark} of {all}");
}

#[test]
fn v67_b06_2_the_effective_slope_bounds_the_drop() {
    let view =
        View::perspective(DVec3::Y * 10.0, DVec3::ZERO, DVec3::NEG_Z, 90f64.to_radians(), 1.0, 100.0, UVec2::splat(64))
            .unwrap();
    let normal = Vec3::new(0.2, 1.0, 0.3).normalize();
    let at = view.receiver(&SurfacePoint::at(Vec3::new(2.0, 1.0, -3.0), normal)).unwrap();
    assert!((at.slope - 0.341_578_5).abs() < 1e-6, "{}", at.slope);
    let (plane, tip) = (at.plane(&view), view.eye_to_texel(at.eye));
    for step in 0..2000 {
        let away = DVec2::from_angle(f64::from(step)) * 3.0 * f64::from(KEY.unit(step, 0));
        let depth = f64::from(plane.at(tip + away / at.texel_world.as_dvec2()));
        assert!(9.0 - depth <= f64::from(at.slope) * away.length() + 1e-6, "{away}");
    }
}
