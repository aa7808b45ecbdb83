//! Laws of places: outside the map, outside the cone, nothing stored, everything stored.

use super::subject::{Found, KEY, Subject, check};
use glam::{DVec3, UVec2, Vec2};
use umbrage_depth::{Map, Raw};
use umbrage_plane::{Rules, SurfacePoint, View};
use umbrage_shadow::Shadow;

/// A lamp at the origin that looks down −y, with a map of 64 × 64 over 30°, so that
/// the widest region that any filter looks at stays within a bias cone's reach of one surface.
pub fn lamp(rules: Rules) -> View {
    let (fov, size) = (30f64.to_radians(), UVec2::splat(64));
    let view = View::perspective(DVec3::ZERO, DVec3::NEG_Y, DVec3::NEG_Z, fov, 0.5, 100.0, size);
    view.expect("a lamp").with_rules(rules)
}

/// The point that faces the light at a texel position and an axial distance, with a footprint of `half` texels to each side.
pub fn point(view: &View, texel: Vec2, zeta: f64, half: f32) -> SurfacePoint {
    let world = |texel: Vec2| view.world_at(texel.as_dvec2(), view.key(zeta)).as_vec3();
    let corner = |x: f32, y: f32| world(texel + Vec2::new(x, y) * half);
    let corners = [corner(-1.0, -1.0), corner(1.0, -1.0), corner(1.0, 1.0), corner(-1.0, 1.0)];
    let toward = (-view.ahead()).as_vec3();
    SurfacePoint::at(world(texel), toward).with_corners(corners)
}

/// A map that stores one depth everywhere.
pub fn flat(view: &View, depth: f32) -> Map {
    let texels = view.size().element_product() as usize;
    Raw::new(*view, vec![depth; texels]).expect("a map").into()
}

fn ask(shadow: &dyn Shadow, at: &SurfacePoint) -> f32 {
    shadow.fraction(at, KEY)
}

/// Sliding a sun's eye along its axis, its near and far plane staying where they are, moves all depths alike. Some are then below 0.
pub fn slid(subject: &Subject) -> Found {
    let answers = |back: f64| -> Vec<f32> {
        let size = UVec2::splat(64);
        let eye = DVec3::Y * (20.0 + back);
        let view = View::orthographic(eye, DVec3::NEG_Y * 100.0, DVec3::NEG_Z, 8.0, 4.0 + back, 40.0 + back, size);
        let view = view.expect("a sun");
        // Plates of several heights, holes between them.
        let height =
            |i: u32| [8.0, 14.0, 16.0, f32::INFINITY][(KEY.bits(i % 64 / 7 + 16 * (i / 64 / 7), 3) % 4) as usize];
        let stored = (0..64 * 64).map(|i| height(i) + back as f32).collect();
        let shadow = subject.over(&Raw::new(view, stored).expect("a map").into());
        let places = (0..200).map(|i| {
            let texel = Vec2::new(KEY.unit(i, 0), KEY.unit(i, 1)) * 48.0 + 8.0;
            let at = SurfacePoint { region: i, ..point(&view, texel, 20.0 + back, KEY.unit(i, 2) * 2.0) };
            ask(&*shadow, &at)
        });
        places.collect()
    };
    let here = answers(0.0);
    for back in [-20.0, -32.0, 64.0, 256.0] {
        let there = answers(back);
        let apart = here.iter().zip(&there).filter(|(a, b)| (*a - *b).abs() > 1e-3).count();
        check(apart == 0, || format!("{apart} of {} answers change {back} units back", here.len()))?;
    }
    check(here.iter().any(|dark| *dark > 0.0), || "nothing is in shadow".into())
}

/// A whole map's width beyond its border no region reaches back inside, whatever its size.
pub fn outside(subject: &Subject) -> Found {
    let cone = |rules| lamp(rules).with_cone(Some(0.2_f64.atan().cos())).expect("a cone");
    for (rules, wanted) in [(Rules::OPEN, 0.0), (Rules::SPOT, 1.0), (Rules::AROUND, 0.0)] {
        for view in [lamp(rules), cone(rules)] {
            for stored in [3.0, f32::INFINITY] {
                let shadow = subject.over(&flat(&view, stored));
                for texel in [(-70.0, 31.0), (140.0, 31.0), (31.0, -70.0), (31.0, 140.0), (-80.0, 150.0)] {
                    for half in [0.0, 0.5, 4.0] {
                        let found = ask(&*shadow, &point(&view, texel.into(), 10.0, half));
                        check(found == wanted, || {
                            format!("{found} instead of {wanted} at texel {texel:?}, stored {stored}, {rules:?}")
                        })?;
                    }
                }
                let behind = SurfacePoint::at(glam::Vec3::new(0.5, 2.0, 0.5), glam::Vec3::NEG_Y);
                let found = ask(&*shadow, &behind);
                check(found == wanted, || format!("{found} instead of {wanted} behind the light, {rules:?}"))?;
            }
        }
    }
    // Inside the map, outside the cone: 16 texels of the map lie to each side of this corner.
    for (rules, wanted) in [(Rules::OPEN, 0.0), (Rules::SPOT, 1.0)] {
        let view = lamp(rules).with_cone(Some(0.1_f64.atan().cos())).expect("a cone");
        let shadow = subject.over(&flat(&view, f32::INFINITY));
        let found = ask(&*shadow, &point(&view, Vec2::splat(4.0), 10.0, 0.5));
        check(found == wanted, || format!("{found} instead of {wanted} outside the cone, {rules:?}"))?;
    }
    Ok(())
}

/// A light whose rules darken what its map does not see gives at least the shadow of one whose rules do not, everywhere.
pub fn dark_rules(subject: &Subject) -> Found {
    for stored in [3.0, 20.0] {
        let over =
            |rules| subject.over(&flat(&lamp(rules).with_cone(Some(0.24_f64.atan().cos())).expect("a cone"), stored));
        let (open, spot) = (over(Rules::OPEN), over(Rules::SPOT));
        for i in 0..400 {
            let texel = Vec2::new(KEY.unit(i, 0), KEY.unit(i, 1)) * 96.0 - 16.0;
            let at = SurfacePoint { region: i, ..point(&lamp(Rules::OPEN), texel, 10.0, KEY.unit(i, 2) * 4.0) };
            let (open, spot) = (ask(&*open, &at), ask(&*spot, &at));
            check(spot >= open - 1e-6, || format!("{spot} under dark rules, {open} under others, at texel {texel}"))?;
        }
    }
    Ok(())
}

/// Well inside the map.
pub fn empty_and_full(subject: &Subject) -> Found {
    let view = lamp(Rules::SPOT);
    for (stored, wanted) in [(f32::INFINITY, 0.0), (50.0, 0.0), (3.0, 1.0)] {
        let shadow = subject.over(&flat(&view, stored));
        for i in 0..100 {
            let texel = Vec2::new(KEY.unit(i, 0), KEY.unit(i, 1)) * 16.0 + 24.0;
            let at = SurfacePoint { region: i, ..point(&view, texel, 10.0, KEY.unit(i, 2) * 2.0) };
            let found = ask(&*shadow, &at);
            check(found == wanted, || format!("{found} instead of {wanted} behind a depth of {stored}"))?;
        }
    }
    Ok(())
}
