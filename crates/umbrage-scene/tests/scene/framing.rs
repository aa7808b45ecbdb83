//! Lights that find their own view (EXT-9, V66).

use glam::{DVec2, DVec3, UVec2, Vec3};
use umbrage_plane::{Kind, Projection, Rules, Verdict, View};
use umbrage_scene::tree::{Cone, Tree};
use umbrage_scene::{Ball, FrameError, Light, Material, Mesh, Object, Scene, fit, gallery};

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
    assert_eq!(found.projection(), Projection::orthographic(DVec2::splat(3.0)));
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

/// A bar 12 wide, 1 high and 1 deep over a wide floor that only receives, seen from above.
fn bar() -> Scene {
    let mut floor = Object::solid(
        "floor",
        Mesh::cuboid(Vec3::new(-30.0, -1.0, -30.0), Vec3::new(30.0, 0.0, 30.0)),
        Material::matt(Vec3::ONE),
    );
    floor.casts = false;
    let bar = Mesh::cuboid(Vec3::new(-6.0, 0.0, -0.5), Vec3::new(6.0, 1.0, 0.5));
    let camera =
        View::perspective(DVec3::new(0.0, 40.0, 40.0), DVec3::ZERO, DVec3::Y, 1.2, 1.0, 200.0, UVec2::splat(64));
    Scene {
        name: "bar".into(),
        origin: DVec3::ZERO,
        objects: vec![floor, Object::solid("bar", bar, Material::matt(Vec3::ONE))],
        lights: vec![],
        ambient: Vec3::ZERO,
        background: Vec3::ZERO,
        camera: camera.unwrap(),
    }
}

/// Lights of every kind over the bar: which of them have an axis of their own.
fn lights(size: UVec2) -> Vec<(Light, bool)> {
    let above = DVec3::new(2.0, 9.0, 3.0);
    let aside = DVec3::new(1.0, 0.0, -1.0);
    let point = Light::point("point", above, aside, 100.0, 0.5, 60.0, size).unwrap();
    let spot = Light::spot("spot", above, aside, 80.0, 0.5, 60.0, size).unwrap();
    let tree = Tree::Product(vec![
        Tree::Cone(Cone { inner_deg: 10.0, outer_deg: 70.0 }),
        Tree::Shadow { recipe: String::new() },
    ]);
    let mut sun = point.clone();
    sun.view = View::orthographic(DVec3::Y * 20.0, DVec3::ZERO, DVec3::X, 8.0, 1.0, 40.0, size).unwrap();
    let mut leaning = sun.clone();
    leaning.view = View::orthographic(DVec3::new(9.0, 20.0, 4.0), DVec3::ZERO, DVec3::Y, 3.0, 1.0, 40.0, size).unwrap();
    let lamp = point.clone().with_tree(tree);
    vec![(point, false), (spot, true), (lamp, true), (sun, true), (leaning, true)]
}

#[test]
fn every_light_and_aspect_holds_its_casters_and_wastes_little() {
    let scene = bar();
    for size in [UVec2::new(256, 512), UVec2::new(512, 256), UVec2::splat(256), UVec2::new(1024, 32)] {
        for (light, _) in lights(size) {
            let view = scene.framed(&light).unwrap().view;
            assert_eq!(view.size(), size);
            assert!(scene.casters_outside(&view).is_empty(), "{} {size}", light.name);
            let seen: Vec<DVec3> = scene.objects[1]
                .shape
                .hull()
                .map(|at| {
                    let eye = view.world_to_eye().transform_point3(at.as_dvec3());
                    assert!(-eye.z > view.near() && -eye.z < view.far(), "{} {size}", light.name);
                    view.eye_to_texel(eye).extend(-eye.z)
                })
                .collect();
            let low = seen.iter().fold(DVec3::INFINITY, |low, at| low.min(*at));
            let high = seen.iter().fold(DVec3::NEG_INFINITY, |high, at| high.max(*at));
            let used = (high - low).truncate() / size.as_dvec2();
            // A spot sees no more of it than its cone holds.
            assert!(
                used.cmpgt(DVec2::splat(0.99)).all() && used.cmplt(DVec2::splat(1.0)).all(),
                "{} {size}: {used}",
                light.name
            );
            assert!((high.z - low.z) / (view.far() - view.near()) > 0.9, "{} {size}", light.name);
        }
    }
}

#[test]
fn framing_a_light_does_not_change_what_it_lights() {
    let scene = bar();
    for (light, aimed) in lights(UVec2::new(256, 128)) {
        let framed = scene.framed(&light).unwrap();
        assert_eq!(framed.view.ahead() == light.view.ahead(), aimed, "{}", light.name);
        for i in 0..400 {
            let at = DVec3::new(f64::from(i % 20) - 9.7, 0.0, f64::from(i / 20) - 9.7) * 2.0;
            let [before, after] = [&light, &framed].map(|light| light.incident(at).1);
            assert_eq!(before, after, "{} at {at}", light.name);
            // What is lit is not called dark because the map is smaller now.
            if after != Vec3::ZERO && framed.view.is_perspective() {
                let eye = framed.view.world_to_eye().transform_point3(at);
                let place = framed.view.locate(framed.view.eye_to_texel(eye).as_vec2());
                assert_ne!(framed.view.rules().verdict(place), Verdict::Shadowed, "{} at {at}", light.name);
            }
        }
    }
}

#[test]
fn a_light_that_only_its_map_limits_keeps_the_sides_of_its_map() {
    let scene = bar();
    for (mut light, _) in lights(UVec2::new(128, 64)) {
        light.view = light.view.with_cone(None).unwrap().with_rules(Rules::SPOT);
        let framed = scene.framed(&light).unwrap().view;
        assert_eq!((framed.projection(), framed.rules()), (light.view.projection(), &Rules::SPOT), "{}", light.name);
    }
    let spot = Light::spot("spot", DVec3::Y * 9.0, DVec3::ZERO, 80.0, 0.5, 60.0, UVec2::ONE).unwrap();
    let ball = Ball { centre: DVec3::ZERO, radius: 1.0 };
    assert_eq!(fit(&spot.view, ball), Err(FrameError::Aimed));
}

/// What a framed map stores suits what it frames; a sheet at one distance has a range, however small or far it is.
#[test]
fn a_framed_light_stores_the_kind_of_depth_that_suits_what_it_frames() {
    for size in [1e-3f64, 1.0, 1e3] {
        for away in [0.5, 20.0, 1e8] {
            let corners = [(-1.0, 1.0), (1.0, 1.0), (1.0, -1.0), (-1.0, -1.0)];
            let corners = corners.map(|(x, z)| (DVec3::new(x, 0.0, z) * size).as_vec3());
            let mut scene = gallery::sphere_plane();
            scene.objects = vec![Object::solid("sheet", Mesh::sheet(corners, 1), Material::matt(Vec3::ONE))];
            let eye = DVec3::Y * size * away;
            let view = View::orthographic(eye, DVec3::NEG_Y * 1e9, DVec3::X, size, 0.0, 2e9, UVec2::splat(64)).unwrap();
            scene.camera = View::perspective(
                DVec3::splat(3.0 * size),
                DVec3::ZERO,
                DVec3::Y,
                1.0,
                0.1 * size,
                9.0 * size,
                UVec2::splat(8),
            )
            .unwrap();
            scene.lights[0].view = view;
            let found = scene.framed(&scene.lights[0]).unwrap().view;
            assert!(found.near() < size * away && size * away < found.far(), "{size} {away}: {found:?}");
            assert_eq!(found.kind(), Kind::of_range(found.near(), found.far()));
            scene.lights[0].view = view.with_kind(Kind::Radial);
            assert_eq!(scene.framed(&scene.lights[0]).unwrap().view.kind(), Kind::Radial, "as the caller has it");
        }
    }
}
