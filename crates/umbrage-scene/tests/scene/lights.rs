use glam::{DVec2, DVec3, UVec2, Vec3};
use umbrage_plane::{Place, Rules, SurfacePoint, Verdict, ViewError};
use umbrage_scene::{Light, gallery};

const SIZE: UVec2 = UVec2::splat(64);

/// Ten units above the floor y = 0, shining straight down, 90° wide.
fn spot() -> Light {
    Light::spot("spot", DVec3::Y * 10.0, DVec3::ZERO, 90.0, 1.0, 20.0, SIZE).expect("valid")
}

fn point() -> Light {
    Light::point("point", DVec3::Y * 10.0, DVec3::ZERO, 90.0, 1.0, 20.0, SIZE).expect("valid")
}

fn sun() -> Light {
    Light::directional("sun", DVec3::Y * 3.0, DVec3::ZERO, 8.0, 0.0, 20.0, SIZE).expect("valid")
}

/// The place of a world point as the light's own answers name it.
fn place(light: &Light, x: f32, y: f32, z: f32) -> Place {
    let view = light.view;
    match view.receiver(&SurfacePoint::at(Vec3::new(x, y, z), Vec3::Y)) {
        Err(place) => place,
        Ok(receiver) => view.locate(receiver.footprint.centre),
    }
}

fn verdict(light: &Light, x: f32, y: f32, z: f32) -> Verdict {
    light.view.rules().verdict(place(light, x, y, z))
}

#[test]
fn c_10_behind_the_light() {
    assert_eq!(place(&spot(), 0.5, 11.0, 0.0), Place::Behind);
    assert_eq!(verdict(&spot(), 0.5, 11.0, 0.0), Verdict::Shadowed);
    assert_eq!(verdict(&point(), 0.5, 11.0, 0.0), Verdict::Lit);
    assert_eq!(place(&sun(), 0.5, 500.0, 0.0), Place::Inside, "nothing is behind a light at infinity");
}

#[test]
fn c_10_outside_the_map() {
    for light in [spot(), point(), sun()] {
        assert_eq!(place(&light, 10.5, 0.0, 0.0), Place::Outside);
    }
    assert_eq!(verdict(&spot(), 10.5, 0.0, 0.0), Verdict::Shadowed);
    assert_eq!(verdict(&point(), 10.5, 0.0, 0.0), Verdict::Lit);
    assert_eq!(verdict(&sun(), 10.5, 0.0, 0.0), Verdict::Lit);
}

#[test]
fn c_10_in_the_map_outside_the_cone() {
    assert_eq!(place(&spot(), 9.0, 0.0, 9.0), Place::BeyondCone);
    assert_eq!(verdict(&spot(), 9.0, 0.0, 9.0), Verdict::Shadowed);
    assert_eq!(verdict(&point(), 9.0, 0.0, 9.0), Verdict::Compare);
    assert_eq!(place(&sun(), 7.9, 0.0, 7.9), Place::Inside);
}

#[test]
fn c_10_inside_the_map_is_compared_whatever_the_map_holds() {
    for light in [spot(), point(), sun()] {
        assert_eq!(verdict(&light, 1.0, 0.0, 2.0), Verdict::Compare);
    }
}

#[test]
fn c_10_nearer_than_near_and_beyond_far_are_compared_but_for_the_strict_volume() {
    for y in [9.5, -30.0] {
        for light in [spot(), point(), sun()] {
            assert_eq!(verdict(&light, 0.1, y, 0.1), Verdict::Compare);
        }
    }
    let mut strict = point();
    strict.view = strict.view.with_rules(Rules::VOLUME);
    assert_eq!(place(&strict, 0.1, 9.5, 0.1), Place::Near);
    assert_eq!(place(&strict, 0.1, -30.0, 0.1), Place::Far);
    assert_eq!(verdict(&strict, 0.1, 9.5, 0.1), Verdict::Lit);
    assert_eq!(verdict(&strict, 0.1, -30.0, 0.1), Verdict::Lit);
}

#[test]
fn a_spot_cone_touches_the_sides_of_its_map() {
    assert_eq!(spot().view.cone().map(|cos| (cos * cos * 1e9).round()), Some(0.5e9));
    let share = (0..64 * 64).filter(|index| {
        let texel = glam::Vec2::new((index % 64) as f32, (index / 64) as f32) + 0.5;
        spot().view.locate(texel) == Place::Inside
    });
    let share = share.count() as f64 / 4096.0;
    assert!((share - std::f64::consts::FRAC_PI_4).abs() < 0.01, "{share}");
}

#[test]
fn incident_light() {
    let tint = Vec3::new(0.9, 0.5, 0.1);
    let spot = spot().coloured(tint);
    assert_eq!(spot.incident(DVec3::ZERO), (Vec3::Y, tint));
    let (toward, arriving) = spot.incident(DVec3::new(6.0, 0.0, 6.0));
    assert!((toward - Vec3::new(-6.0, 10.0, -6.0).normalize()).length() < 1e-6);
    assert_eq!(arriving, tint);
    assert_eq!(spot.incident(DVec3::new(9.0, 0.0, 9.0)).1, Vec3::ZERO, "outside the cone");
    assert_eq!(spot.incident(DVec3::Y * 11.0).1, Vec3::ZERO, "behind");
    assert_eq!(spot.incident(DVec3::Y * 10.0), (Vec3::ZERO, Vec3::ZERO), "at the light");
    assert_eq!(point().coloured(tint).incident(DVec3::Y * 11.0), (Vec3::NEG_Y, tint));
    for at in [DVec3::ZERO, DVec3::new(1e4, -3.0, 2.0), DVec3::Y * 1e5] {
        assert_eq!(sun().coloured(tint).incident(at), (Vec3::Y, tint));
    }
}

#[test]
fn r87_23_three_lights_have_a_colour_each() {
    let colours: Vec<Vec3> = gallery::three_lights().lights.iter().map(|light| light.colour).collect();
    assert_eq!(colours, [Vec3::X, Vec3::Y, Vec3::Z]);
}

#[test]
fn a_directional_target_is_midway_in_its_range_and_in_the_middle_of_its_map() {
    let target = DVec3::new(4.0, -2.0, 1.0);
    let ranges = [(2.0, 10.0), (0.0, 5.0), (-5.0, 5.0), (-9.0, 2.0)];
    for (near, far) in ranges {
        let light = Light::directional("sun", DVec3::new(1.0, 2.0, 3.0), target, 5.0, near, far, SIZE).expect("valid");
        let eye = light.view.world_to_eye().transform_point3(target);
        assert!((-eye.z - 0.5 * (near + far)).abs() < 1e-12);
        assert!((light.view.eye_to_texel(eye) - DVec2::splat(32.0)).length() < 1e-9);
        assert!((light.incident(target).0 - Vec3::new(1.0, 2.0, 3.0).normalize()).length() < 1e-6);
    }
}

#[test]
fn lights_that_cannot_be() {
    assert!(matches!(
        Light::directional("sun", DVec3::ZERO, DVec3::ZERO, 1.0, 0.0, 1.0, SIZE),
        Err(ViewError::NoDirection { .. })
    ));
    assert!(matches!(
        Light::spot("spot", DVec3::Y, DVec3::ZERO, 180.0, 1.0, 2.0, SIZE),
        Err(ViewError::FieldOfView { .. })
    ));
    assert!(matches!(
        Light::point("point", DVec3::Y, DVec3::Y, 60.0, 1.0, 2.0, SIZE),
        Err(ViewError::NoDirection { .. })
    ));
    assert!(matches!(Light::point("point", DVec3::Y, DVec3::ZERO, 60.0, 0.0, 2.0, SIZE), Err(ViewError::NearAtEye(_))));
}
