//! Lights that find their own view (EXT-9, V66).

use glam::{DVec3, UVec2, Vec3};
use umbrage_plane::{Projection, View};
use umbrage_scene::{Ball, FrameError, Light, Material, Mesh, Object, fit, gallery};

#[test]
fn v66_a_ball_is_framed_by_its_tangent_cone() {
    let ball = Ball { centre: DVec3::new(0.0, 0.0, -10.0), radius: 3.0 };
    let away = View::perspective(DVec3::ZERO, DVec3::X, DVec3::Y, 1.0, 0.1, 9.0, UVec2::splat(64)).unwrap();
    let found = fit(&away, ball).unwrap();
    let Projection::Perspective { k, .. } = found.projection() else { panic!("perspective") };
    assert!((2.0 * (1.0 / k.y).atan().to_degrees() - 34.915_206).abs() < 1e-6);
    assert!((found.near() - 7.0).abs() < 1e-12 && (found.far() - 13.0).abs() < 1e-12);
    assert!(found.ahead().abs_diff_eq(DVec3::NEG_Z, 1e-12));
    let inside = Ball { radius: 11.0, ..ball };
    assert_eq!(fit(&away, inside), Err(FrameError::Inside { distance: 10.0, radius: 11.0 }));
    let sun = View::orthographic(DVec3::ZERO, DVec3::NEG_Y, DVec3::X, 99.0, 0.0, 1.0, UVec2::splat(8)).unwrap();
    let found = fit(&sun, ball).unwrap();
    assert_eq!(found.projection(), Projection::orthographic(glam::DVec2::splat(3.0)));
}

#[test]
fn balls_hold_their_points_and_are_not_much_too_large() {
    let cube = Mesh::cuboid(Vec3::splat(-1.0), Vec3::ONE);
    let points: Vec<DVec3> = cube.positions.iter().map(|at| at.as_dvec3()).collect();
    let ball = Ball::around(&points).unwrap();
    assert!(points.iter().all(|at| at.distance(ball.centre) <= ball.radius * (1.0 + 1e-12)));
    assert!(ball.radius < 1.1 * 3f64.sqrt());
    assert_eq!(Ball::around(&[]), None);
}

#[test]
fn ext_9_a_framed_light_holds_every_relevant_caster_and_wastes_little() {
    let mut scene = gallery::sphere_plane();
    scene.objects[1].casts = false;
    let framed = scene.framed(&scene.lights[0]).unwrap();
    assert!(scene.casters_outside(&framed.view).is_empty());
    // The sphere's disc touches the sides of the map.
    let view = &framed.view;
    let seen = scene.objects[0]
        .shape
        .hull()
        .map(|at| view.eye_to_texel(view.world_to_eye().transform_point3(at.as_dvec3())).x);
    let (low, high) = seen.fold((f64::INFINITY, f64::NEG_INFINITY), |(l, h), x| (l.min(x), h.max(x)));
    assert!(low < 20.0 && high > f64::from(view.size().x) - 20.0, "{low} {high}");
    assert_eq!(
        (view.kind(), view.size(), view.rules()),
        (scene.lights[0].view.kind(), scene.lights[0].view.size(), scene.lights[0].view.rules())
    );
}

#[test]
fn ext_9_what_cannot_shadow_the_picture_is_left_out() {
    let mut scene = gallery::sphere_plane();
    let ball = |at: Vec3| Object::solid("far off", Mesh::sphere(at, 2.0, 16), Material::matt(Vec3::ONE));
    // Behind the slab as the light sees it; beside everything; between light and slab.
    scene.objects.push(ball(Vec3::new(160.0, -60.0, -160.0)));
    scene.objects.push(ball(Vec3::new(-70.0, 400.0, 70.0)));
    scene.objects.push(ball(Vec3::new(-40.0, 15.0, 45.0)));
    let relevant = scene.relevant_casters(&scene.lights[0].view);
    assert_eq!(relevant, [0, 1, 4]);
    for object in &mut scene.objects {
        object.casts = false;
    }
    assert_eq!(scene.framed(&scene.lights[0]).unwrap_err(), FrameError::Nothing);
    let inside =
        Light::point("inside", DVec3::new(0.0, 0.0, 25.0), DVec3::ZERO, 90.0, 0.1, 99.0, UVec2::splat(8)).unwrap();
    scene.objects[0].casts = true;
    assert!(matches!(scene.framed(&inside), Err(FrameError::Inside { .. })));
}
