use crate::{near, spot, sun};
use umbrage_engines::{Conditions, Engine, WorldBias};
use umbrage_plane::glam::{DVec3, UVec2, Vec3};
use umbrage_plane::{Bias, SurfacePoint, View};

#[test]
fn a_view_gives_the_same_conditions_as_its_numbers() {
    let eye = DVec3::new(3.0, 40.0, -2.0);
    let below = eye - DVec3::Y;
    let lamp = View::perspective(eye, below, DVec3::Z, 1.2, 0.5, 60.0, UVec2::splat(512)).unwrap();
    let told = Conditions::perspective(0.6, 512, 0.5, 60.0, 25.0).unwrap();
    let seen = Conditions::on_axis(&lamp, 25.0).unwrap();
    assert!(near(seen.texel, told.texel) && near(seen.extent(), 50.0 * 0.6f64.tan()));
    assert_eq!(seen.with_texel(told.texel), told);
    let sun = View::orthographic(eye, below, DVec3::Z, 10.0, -5.0, 60.0, UVec2::new(512, 256)).unwrap();
    let seen = Conditions::on_axis(&sun, 25.0).unwrap();
    // 20 units over 256 rows, 40 over 512 columns.
    assert!(near(seen.texel, 20.0 / 256.0) && seen.map_size == 512 && near(seen.extent(), 40.0));
    assert!(!seen.perspective && seen.near == -5.0);
}

#[test]
fn a_receiver_brings_its_slope_its_facing_and_its_ray() {
    let lamp =
        View::perspective(DVec3::new(0.0, 10.0, 0.0), DVec3::ZERO, DVec3::NEG_Z, 2.0, 0.5, 60.0, UVec2::splat(512));
    let lamp = lamp.unwrap();
    // On the floor, 10 below and 10 to the side: 45 degrees to the ray as to the normal.
    let receiver = lamp.receiver(&SurfacePoint::at(Vec3::new(10.0, 0.0, 0.0), Vec3::Y)).unwrap();
    let seen = Conditions::of(&lamp, &receiver).unwrap();
    assert!(near(seen.distance, 10.0) && near(seen.ray, 0.5f64.sqrt()) && near(seen.facing, 0.5f64.sqrt()));
    // The floor is square to the axis: one depth for all of it.
    assert!(seen.slope.abs() < 1e-6);
    let behind = lamp.receiver(&SurfacePoint::at(Vec3::new(1.0, 0.0, 0.0), -Vec3::Y)).unwrap();
    let error = Conditions::of(&lamp, &behind).unwrap_err().to_string();
    assert!(error.starts_with("condition facing = -") && error.ends_with("is not above 0 and at most 1"), "{error}");
}

#[test]
fn a_parallel_receiver_is_on_the_axis_wherever_it_is() {
    let sun =
        View::orthographic(DVec3::new(0.0, 10.0, 0.0), DVec3::ZERO, DVec3::NEG_Z, 20.0, 0.0, 30.0, UVec2::splat(256));
    let sun = sun.unwrap();
    let normal = Vec3::new(0.6, 0.8, 0.0);
    let receiver = sun.receiver(&SurfacePoint::at(Vec3::new(9.0, 4.0, -3.0), normal)).unwrap();
    let seen = Conditions::of(&sun, &receiver).unwrap();
    assert!(near(seen.distance, 6.0) && seen.ray == 1.0);
    assert!(near(seen.facing, 0.8) && near(seen.slope, 0.75), "{seen:?}");
    // As a tilt by its cosine has it.
    let told = Conditions::on_axis(&sun, 6.0).unwrap().with_light_at(0.8);
    assert!(near(told.slope, 0.75));
}

#[test]
fn parts_add_up_along_the_axis() {
    // N·L is ½ and tan θ is √3: 0.1 and 2 steps of 20/1024 · √3 and an offset of 0.03/½.
    let bias = WorldBias { constant: 0.1, slope: 2.0, normal: 0.03 };
    let steps = 2.0 * 20.0 / 1024.0 * 3f64.sqrt();
    assert!(near(bias.along_axis(&sun()).unwrap(), 0.1 + steps + 0.06));
    // Off a spot's axis the same offset is less along it.
    let offset = WorldBias::normal(0.03).along_axis(&spot().with_ray(0.8)).unwrap();
    assert!(near(offset, 0.048));
    assert_eq!(WorldBias::ZERO.along_axis(&sun()), Ok(0.0));
}

/// Godot's offset without its part along the light is a shift across it: what the plane rises over that shift.
#[test]
fn a_shift_across_the_light_is_an_offset_and_a_negative_constant() {
    let conditions = sun();
    let found = Engine::Godot.world(&[("shadow_bias", 0.0), ("shadow_normal_bias", 3.0)], &conditions).unwrap().least;
    let shift = 3.0 * conditions.texel * 0.75f64.sqrt();
    assert!(near(found.along_axis(&conditions).unwrap(), shift * conditions.slope));
}

/// The same setting is a larger bias farther away in perspective, by the square of the distance to first order, and the same for parallel light.
#[test]
fn a_step_of_depth_grows_with_distance_in_perspective_alone() {
    let at = |distance: f64| Conditions::perspective(0.5, 512, 0.5, 50.0, distance).unwrap();
    let bias = |conditions: &Conditions| Engine::Three.world(&[("bias", -1e-6)], conditions).unwrap().least.constant;
    let (nearby, far) = (bias(&at(5.0)), bias(&at(20.0)));
    assert!((far / nearby / 16.0 - 1.0).abs() < 1e-2, "{nearby} {far}");
    let parallel = |distance: f64| Conditions::orthographic(5.0, 512, 0.5, 50.0, distance).unwrap();
    assert_eq!(bias(&parallel(5.0)), bias(&parallel(20.0)));
}

/// The geometry of maps takes the same steps: of screen depth, and of a plane's own from texel to texel.
#[test]
fn steps_are_those_of_the_geometry_of_maps() {
    let eye = DVec3::new(0.0, 10.0, 0.0);
    let lamp = View::perspective(eye, DVec3::ZERO, DVec3::NEG_Z, 1.5, 0.5, 60.0, UVec2::splat(512)).unwrap();
    let sun = View::orthographic(eye, DVec3::ZERO, DVec3::NEG_Z, 20.0, 0.5, 60.0, UVec2::splat(512)).unwrap();
    for view in [lamp, sun] {
        for (at, normal) in
            [(Vec3::ZERO, Vec3::new(0.6, 0.8, 0.0)), (Vec3::new(4.0, 2.0, -3.0), Vec3::new(-0.48, 0.8, 0.36))]
        {
            let receiver = view.receiver(&SurfacePoint::at(at, normal)).unwrap();
            let conditions = Conditions::of(&view, &receiver).unwrap();
            let moved = |bias: Bias| f64::from(receiver.depth) - f64::from(receiver.nearer(&view, bias));
            for step in [1e-4f32, 1e-3, 5e-3] {
                let three = Engine::Three.world(&[("bias", -f64::from(step))], &conditions).unwrap().least;
                assert!((three.constant - moved(Bias::Map(step))).abs() < 4e-6, "{three:?} {receiver:?}");
            }
            let slope = WorldBias::slope(1.5).along_axis(&conditions).unwrap();
            assert!((slope - moved(Bias::Steps(1.5))).abs() < 4e-6, "{slope} {receiver:?}");
        }
    }
}
