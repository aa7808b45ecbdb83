//! The scenes of Woo, Wang & Molnar and Burley, as their figures need them.

use super::rays::{before_light, bounds, met, object, on_floor, seen, texel};
use glam::{DVec2, DVec3, UVec2, Vec3};
use umbrage_scene::{Shape, gallery};

#[test]
fn wm94_f4_the_table_as_given() {
    let scene = gallery::table();
    assert_eq!(bounds(&scene, "floor").1, Vec3::new(1000.0, 0.0, 1000.0));
    assert_eq!(bounds(&scene, "floor").0.with_y(0.0), Vec3::new(-1000.0, 0.0, -1000.0));
    assert_eq!(bounds(&scene, "top"), (Vec3::new(-300.0, 400.0, -200.0), Vec3::new(300.0, 420.0, 200.0)));
    for number in 1..=4 {
        let (low, high) = bounds(&scene, &format!("leg {number}"));
        assert_eq!((low.y, high.y), (0.0, 410.0), "on the floor and into the top");
        assert_eq!((high - low).with_y(0.0), Vec3::new(8.0, 0.0, 8.0));
        assert_eq!(low.abs().max(high.abs()).with_y(0.0), Vec3::new(280.0, 0.0, 180.0));
    }
    let light = scene.lights[0].view;
    let eye = light.light().truncate();
    assert!((eye.length() - 3500.0).abs() < 1e-9 && (eye.y / 3500.0 - 25f64.to_radians().sin()).abs() < 1e-12);
    assert!(eye.z.abs() < 1e-9 && eye.x < 0.0, "square to the legs' faces: 8 thick along the light (D-10)");
    assert_eq!(light.size(), UVec2::splat(512));
    assert!((light.texel_world(3500.0) - 3.92).abs().max_element() < 5e-3, "{}", light.texel_world(3500.0));
    // No bias is free of faults here (D-10): what the floor needs is more than the leg leaves.
    assert!(light.texel_world(3500.0).x * 1.5 / 25f64.to_radians().tan() > 8.0 / 25f64.to_radians().cos());
}

#[test]
fn wm94_f4_the_close_up_sees_one_foot_and_its_shadow() {
    let scene = gallery::table_close_up();
    assert_eq!(scene.objects, gallery::table().objects);
    assert_eq!(scene.camera.size(), UVec2::splat(512));
    let legs = [[-276.0, 176.0], [-276.0, -176.0], [276.0, 176.0], [276.0, -176.0]];
    let framed = legs.map(|[x, z]| texel(&scene.camera, DVec3::new(x, 0.0, z)).is_some());
    assert_eq!(framed, [true, false, false, false]);
    let from_leg = |x: f64| DVec3::new(-272.0 + x, 0.0, 176.0);
    for x in [0.5, 5.0, 20.0, 40.0] {
        assert!(seen(&scene, from_leg(x)), "{x} behind the leg");
        let way = scene.lights[0].view.light().truncate();
        assert!(met(&scene, from_leg(x), way).iter().all(|id| *id == 2), "only the leg is in the way");
    }
    let [a, b] = [0.0, 10.0].map(|x| texel(&scene.camera, from_leg(x)).expect("seen"));
    assert!(a.distance(b) > 20.0, "a gap of a few units is many pixels");
}

#[test]
fn w92_8_w92_f2_w92_rim_shadows_reach_the_rim_of_the_spot() {
    // Woo's map of 256² under a full angle of 75°.
    let seen = gallery::spot_room().lights[0].view;
    assert_eq!(seen.size(), UVec2::splat(256));
    assert!((seen.cone().unwrap() - 37.5f64.to_radians().cos()).abs() < 1e-12);
    let scene = gallery::spot_room();
    let light = scene.lights[0].view;
    assert_eq!(light.size(), UVec2::splat(256));
    let tan_half = light.cone().expect("a spot").acos().tan();
    assert!((tan_half - 37.5f64.to_radians().tan()).abs() < 1e-12);
    let mut reaching = Vec::new();
    for object in &scene.objects[3..] {
        let share = |at: Vec3| {
            let eye = light.world_to_eye().transform_point3(at.as_dvec3());
            eye.truncate().length() / -eye.z / tan_half
        };
        let inside = object.shape.hull().filter(|at| share(*at) < 1.0).count();
        if inside > 0 && object.shape.hull().any(|at| share(at) > 1.0) {
            reaching.push(object.name.as_str());
        }
    }
    assert_eq!(reaching, ["tall box", "tall post"]);
    let rim: Vec<DVec3> = on_floor(64.0, 160)
        .filter(|at| {
            let eye = light.world_to_eye().transform_point3(*at);
            ((eye.truncate().length() / -eye.z) / tan_half - 0.99).abs() < 0.01
        })
        .collect();
    let dark = rim.iter().filter(|at| !met(&scene, **at, light.light().truncate()).is_empty()).count();
    assert!(dark >= 4 && 10 * dark < 9 * rim.len(), "{dark} of {} just inside the rim are in shadow", rim.len());
}

#[test]
fn b06_i76_shadows_of_the_box_end_in_the_picture() {
    let scene = gallery::contact_box();
    assert_eq!(bounds(&scene, "box"), (Vec3::new(-10.0, 0.0, -40.0), Vec3::new(10.0, 120.0, 40.0)));
    let light = scene.lights[0].view.light().truncate();
    let thrown = |at: DVec3| at + (at - light) * (at.y / (light.y - at.y));
    let end = thrown(DVec3::new(10.0, 120.0, 40.0));
    assert!((end.x - 188.0).abs() < 1.0, "{end}");
    for part in 0..=10 {
        let edge = DVec3::new(10.0, 0.0, 40.0).lerp(end, f64::from(part) / 10.0);
        assert!(seen(&scene, edge + DVec3::new(0.0, 0.0, 0.5)), "{edge}");
    }
    let scene = gallery::overlapping_boxes();
    assert_eq!(scene.objects[..2], gallery::contact_box().objects[..]);
    let board = bounds(&scene, "board");
    let [low, high] = [board.0, board.1].map(|at| thrown(at.as_dvec3()));
    let side = |x: f64| 40.0 + (end.z - 40.0) * (x - 10.0) / (end.x - 10.0);
    assert!(low.x > 10.0 && high.x < end.x, "over the box's shadow: {low} to {high}");
    assert!(low.z < side(low.x) - 10.0 && high.z > side(high.x) + 5.0, "across its edge");
    let both = DVec3::new(0.5 * (low.x + high.x), 0.0, 0.5 * (low.z + side(low.x)));
    assert_eq!(met(&scene, both, light), [0, 0, 2, 2], "two occluders one behind the other");
}

#[test]
fn r87_nopen_two_heights_and_a_single_occluder() {
    let scene = gallery::two_heights();
    let [low, high] = ["low board", "high board"].map(|name| bounds(&scene, name));
    assert_eq!((high.0.y, low.1.x, high.1.x), (4.0 * low.0.y, 5.0, 5.0));
    for (height, z) in [(10.0, 26.0), (40.0, -26.0)] {
        let edge = 5.0 * 400.0 / (400.0 - height);
        for offset in [-4.0, 0.1, 4.0] {
            let at = DVec3::new(edge + offset, 0.0, z);
            assert!(seen(&scene, at), "{at}");
            assert_eq!(before_light(&scene, at).is_empty(), offset > 0.0, "{at}");
        }
    }
    let scene = gallery::single_occluder();
    let light = scene.lights[0].view;
    let zeta = |at: DVec3| -light.world_to_eye().transform_point3(at).z;
    for z in [-40.0, 0.0, 30.0] {
        assert!((zeta(DVec3::new(0.0, 50.0, z)) - 350.0).abs() < 1e-9);
        assert!((zeta(DVec3::new(0.0, 0.0, z)) - 400.0).abs() < 1e-9);
        let beside = |x: f64| DVec3::new(x, 0.0, 0.5 * z);
        assert!(seen(&scene, beside(-6.0)) && seen(&scene, beside(6.0)));
        assert!(!before_light(&scene, beside(-0.1)).is_empty() && before_light(&scene, beside(0.1)).is_empty());
    }
}

#[test]
fn wm94_f13_more_than_200_pieces_of_pipe() {
    assert!(gallery::pipe_segments() >= 200, "{}", gallery::pipe_segments());
    let scene = gallery::pipes();
    assert!(scene.objects.iter().all(|object| object.solid && object.passes == Vec3::ZERO));
    for pipe in &scene.objects[2..] {
        let inside = |at: Vec3| at.x.abs() < 60.0 && at.y > 0.0 && at.z.abs() < 24.0;
        assert!(pipe.shape.hull().all(inside), "{} stands free of floor and wall", pipe.name);
    }
    assert_eq!((scene.camera.size(), scene.lights[0].view.size()), (UVec2::splat(1024), UVec2::splat(512)));
}

#[test]
fn wm94_f14_the_sun_shines_into_the_hall() {
    let scene = gallery::walkthrough();
    assert_eq!((scene.camera.size(), scene.lights[0].view.size()), (UVec2::splat(1024), UVec2::splat(2048)));
    assert!(!scene.lights[0].view.is_perspective() && scene.lights[0].casts);
    assert!(scene.objects.iter().filter(|object| !object.solid).count() >= 3, "sheets (WM94-14)");
    assert!(scene.objects.iter().filter(|object| object.solid).count() >= 10);
    let visible: Vec<DVec3> = on_floor(48.0, 40).filter(|at| seen(&scene, *at)).collect();
    let lit = visible.iter().filter(|at| before_light(&scene, **at).is_empty()).count();
    let share = lit as f64 / visible.len() as f64;
    assert!(visible.len() > 300 && (0.04..0.5).contains(&share), "{share} of {}", visible.len());
}

#[test]
fn b06_deep_leaves_and_grass_let_light_through() {
    let scene = gallery::plant();
    let [leaves, grass] = ["leaves", "grass"].map(|name| object(&scene, name));
    assert!(!leaves.solid && leaves.passes.y > leaves.passes.x && leaves.passes.x > leaves.passes.z);
    assert!(!grass.solid && grass.passes.max_element() < 0.1);
    let Shape::Mesh(blades) = &grass.shape else { panic!("triangles") };
    assert_eq!((gallery::BLADES, blades.triangles.len()), (1800, 1800 * 5));
    assert!(grass.shape.hull().chain(leaves.shape.hull()).all(|at| at.y >= 0.0), "above the floor");
}

#[test]
fn b06_deep_every_pane_colours_floor_that_is_seen() {
    let scene = gallery::glass_pane();
    let floor: Vec<Vec<usize>> =
        on_floor(78.0, 120).filter(|at| at.z > -49.0 && seen(&scene, *at)).map(|at| before_light(&scene, at)).collect();
    let count = |ids: &[usize]| floor.iter().filter(|met| met.as_slice() == ids).count();
    for pane in 2..=7 {
        assert!(count(&[pane]) >= 20, "{}: {}", scene.objects[pane].name, count(&[pane]));
    }
    assert!(count(&[6, 7]) >= 5, "yellow over cyan: {}", count(&[6, 7]));
    for pane in &scene.objects[2..] {
        assert!(!pane.solid && pane.passes != Vec3::ZERO);
    }
}

#[test]
fn b06_deep_only_the_ball_moves() {
    let scenes = [0.0, 0.5, 1.0, f32::NAN, 7.0].map(gallery::moving_ball);
    assert_eq!((&scenes[3], &scenes[4]), (&scenes[0], &scenes[2]));
    for scene in &scenes {
        assert_eq!(scene.objects[1..], scenes[0].objects[1..]);
        assert!(bounds(scene, "ball").0.y > 0.0);
        assert!(!scene.casters_outside(&scene.lights[0].view).contains(&0));
    }
    let middles = [0, 1, 2].map(|time| bounds(&scenes[time], "ball").0.x + 6.0);
    assert!(middles.iter().zip([-16.0, 0.0, 16.0]).all(|(x, expected)| (x - expected).abs() < 1e-4), "{middles:?}");
}

#[test]
fn wm94_f7_the_slab_is_thinner_than_a_step_of_depth() {
    let scene = gallery::thin_slab();
    let (low, high) = bounds(&scene, "slab");
    assert!((high.y - low.y - gallery::THIN).abs() < 1e-5);
    let along = f64::from(gallery::THIN) / 45f64.to_radians().sin();
    for side in [64, 128, 256] {
        let light = scene.lights[0].view.with_size(UVec2::splat(side)).expect("valid");
        assert!(light.toward_eye(DVec3::ZERO).y - 45f64.to_radians().sin() < 1e-12);
        assert!(light.texel_world(1.0).x > along, "depth grows by a texel's width a texel at 45°");
    }
}

#[test]
fn wm94_sheets_nothing_is_solid() {
    for bent in [false, true] {
        let scene = gallery::sheets(bent);
        assert!(scene.objects.len() >= 3 && scene.objects.iter().all(|object| !object.solid));
        for object in &scene.objects {
            let Shape::Mesh(mesh) = &object.shape else { panic!("triangles") };
            let plane = mesh.normals.iter().all(|normal| normal.distance(mesh.normals[0]) < 1e-5);
            assert_eq!(plane, !bent, "{}", object.name);
        }
    }
}

#[test]
fn wm94_f9_umbra_where_the_sphere_turns_away() {
    let scene = gallery::occluder_sphere();
    let (mut umbra, mut grazing) = (0, 0);
    for step in 0..200 * 200 {
        let at = DVec2::new(f64::from(step % 200), f64::from(step / 200)) / 100.0 - 0.995;
        if at.length_squared() > 0.98 || at.x > 0.0 {
            continue;
        }
        let normal = at.extend((1.0 - at.length_squared()).sqrt());
        // The small balls' own test: their distance from the ray in direction −x.
        let dark = scene.objects[1..].iter().any(|ball| {
            let (low, high) = bounds(&scene, &ball.name);
            let offset = ((low + high) * 0.5).as_dvec3() - normal * 20.0;
            offset.x < 0.0 && offset.y.hypot(offset.z) < f64::from(high.y - low.y) * 0.5
        });
        umbra += u32::from(dark);
        grazing += u32::from(dark && -normal.x < 0.25);
    }
    assert!(umbra > 300 && 2 * grazing > umbra, "{grazing} of {umbra}");
}

#[test]
fn grazing_sun_stands_6_degrees_high() {
    let scene = gallery::grazing();
    let toward = scene.lights[0].view.toward_eye(DVec3::ZERO);
    assert!((toward.y.asin().to_degrees() - 6.0).abs() < 1e-9);
    assert_eq!(scene.casters_outside(&scene.lights[0].view), Vec::<u32>::new());
}
