//! What the figures need of their scenes.

use glam::{DVec2, DVec3, UVec2, Vec3};
use umbrage_plane::View;
use umbrage_scene::{Object, Scene, Shape, gallery};

fn object<'a>(scene: &'a Scene, name: &str) -> &'a Object {
    scene.objects.iter().find(|object| object.name == name).expect("an object of that name")
}

fn pictured(camera: &View, at: DVec3) -> bool {
    let eye = camera.world_to_eye().transform_point3(at);
    let texel = camera.eye_to_texel(eye);
    eye.z < 0.0 && texel.cmpge(DVec2::ZERO).all() && texel.cmple(camera.size().as_dvec2()).all()
}

/// Points all over an object of patches.
fn points(object: &Object) -> Vec<DVec3> {
    let Shape::Patches(patches) = &object.shape else { panic!("{} is no patches", object.name) };
    let steps = || (0..=4u8).map(|step| f64::from(step) / 4.0);
    let all = |patch: &umbrage_scene::Patch| {
        let patch = *patch;
        steps().flat_map(move |u| steps().map(move |v| patch.position(u, v)))
    };
    patches.iter().flat_map(all).collect()
}

fn share(hits: usize, all: usize) -> f64 {
    hits as f64 / all as f64
}

#[test]
fn w78_f7_the_smile_shades_a_flat_wall_and_a_round_column() {
    let scene = gallery::smile();
    assert_eq!(scene.lights.iter().filter(|light| light.casts).count(), 1);
    let toward = scene.lights[0].view.toward_eye(DVec3::ZERO);
    let column = object(&scene, "column").shape.mesh_for(&scene.camera).bounds().expect("not empty");
    let (low, high) = (column.0.as_dvec3(), column.1.as_dvec3());
    let (middle, radius) = ((low + high) * 0.5, (high.x - low.x) * 0.5);
    let lips = points(object(&scene, "lips"));
    let (mut on_column, mut on_wall) = (0, 0);
    for at in &lips {
        assert!(at.z > radius + middle.z, "before the column");
        // Walk the ray from the light until it meets one of the two.
        let along = |distance: f64| *at - toward * distance;
        let to_wall = at.z / toward.z;
        let in_column = |distance: &f64| {
            let from_axis = along(*distance) - middle;
            from_axis.x.hypot(from_axis.z) < radius
        };
        match (0..2000).map(|step| to_wall * f64::from(step) / 2000.0).find(in_column) {
            Some(distance) => on_column += usize::from(pictured(&scene.camera, along(distance))),
            None => on_wall += usize::from(pictured(&scene.camera, along(to_wall))),
        }
    }
    assert_eq!(on_column + on_wall, lips.len(), "all of the shadow is in the picture");
    assert!(share(on_column, lips.len()) > 0.3 && share(on_wall, lips.len()) > 0.3, "{on_column} and {on_wall}");
    assert!(scene.objects[..3].iter().all(|object| !object.solid), "its patches are open");
}

#[test]
fn w78_f8_the_robot_has_over_350_patches_and_stands() {
    let scene = gallery::robot();
    assert!(gallery::patch_count(&scene) >= 351, "{}", gallery::patch_count(&scene));
    let robot: Vec<DVec3> = scene.objects[..4].iter().flat_map(points).collect();
    let lowest = robot.iter().map(|at| at.y).fold(f64::INFINITY, f64::min);
    assert!((0.0..0.1).contains(&lowest), "{lowest}");
    assert!(robot.iter().all(|at| pictured(&scene.camera, *at)));
}

#[test]
fn w78_f8_the_robots_shadow_runs_over_the_floor_and_up_the_wall() {
    let scene = gallery::robot();
    let toward = scene.lights[0].view.toward_eye(DVec3::ZERO);
    let wall = object(&scene, "wall").shape.mesh_for(&scene.camera).bounds().expect("not empty").1.z;
    let robot: Vec<DVec3> = scene.objects[..4].iter().flat_map(points).collect();
    let (mut floor, mut upright) = (0, 0);
    for at in &robot {
        let (to_floor, to_wall) = (at.y / toward.y, (at.z - f64::from(wall)) / toward.z);
        let landed = *at - toward * to_floor.min(to_wall);
        assert!(pictured(&scene.camera, landed), "{landed}");
        *(if to_floor < to_wall { &mut floor } else { &mut upright }) += 1;
    }
    assert!(share(floor, robot.len()) > 0.1 && share(upright, robot.len()) > 0.3, "{floor} and {upright}");
}

#[test]
fn r87_f12_three_lights_cast_and_the_ground_only_receives() {
    let scene = gallery::desk_lamps();
    let sizes: Vec<(bool, UVec2)> = scene.lights.iter().map(|light| (light.casts, light.view.size())).collect();
    assert_eq!(sizes, [2048, 1024, 1024].map(|side| (true, UVec2::splat(side))));
    for object in &scene.objects {
        let ground = object.name.starts_with("ground");
        let glows = object.name.ends_with("bulb") || object.name.ends_with("lining");
        assert_eq!((object.casts, object.receives), if glows { (false, false) } else { (!ground, true) });
        let solid = object.shape.mesh_for(&scene.camera);
        let (low, high) = solid.bounds().expect("not empty");
        assert!(if ground { high.y == 0.0 } else { low.y > -1e-4 }, "{} stands on the table", object.name);
    }
}

/// Distance along a ray to a triangle; `None` when it is missed.
fn meets(from: DVec3, along: DVec3, [a, b, c]: [Vec3; 3]) -> Option<f64> {
    let [a, b, c] = [a, b, c].map(|at| at.as_dvec3() - from);
    let sides = [a.cross(b), b.cross(c), c.cross(a)].map(|side| side.dot(along));
    let within = sides.iter().all(|side| *side >= 0.0) || sides.iter().all(|side| *side <= 0.0);
    let normal = (b - a).cross(c - a);
    let distance = a.dot(normal) / along.dot(normal);
    (within && distance > 0.0).then_some(distance)
}

#[test]
fn r87_f12_a_lamps_own_shade_bounds_its_light_and_nothing_else_does() {
    let scene = gallery::desk_lamps();
    for (light, own) in scene.lights.iter().zip(["big", "small"]) {
        let filament = light.view.light().truncate();
        let eye_to_world = light.view.world_to_eye().inverse();
        let lamp: Vec<_> = ["shade", "lamp"]
            .iter()
            .map(|part| object(&scene, &format!("{own} {part}")).shape.mesh_for(&light.view))
            .collect();
        let blocked = |from_axis: f64, around: f64| {
            let (sin, cos) = from_axis.to_radians().sin_cos();
            let along = DVec3::new(sin * around.cos(), sin * around.sin(), -cos);
            let along = eye_to_world.transform_vector3(along);
            let nearest = lamp.iter().flat_map(|mesh| {
                (0..mesh.triangles.len()).filter_map(|triangle| meets(filament, along, mesh.corners(triangle)))
            });
            nearest.fold(f64::INFINITY, f64::min) < 30.0
        };
        for step in 0..12u8 {
            let around = f64::from(step) * std::f64::consts::TAU / 12.0;
            for free in [0.0, 15.0, 30.0, 38.0] {
                assert!(!blocked(free, around), "{own} lamp at {free} degrees");
            }
            for shaded in [40.5, 54.0, 70.0] {
                assert!(blocked(shaded, around), "{own} lamp at {shaded} degrees");
            }
        }
    }
}

#[test]
fn r87_f14_the_shop_is_complex_and_two_of_its_seven_lights_cast() {
    let scene = gallery::bicycle_shop();
    let casting: Vec<bool> = scene.lights.iter().map(|light| light.casts).collect();
    assert_eq!(casting, [true, true, false, false, false, false, false]);
    assert!(scene.lights[..2].iter().all(|light| light.view.size() == UVec2::splat(1024)));
    assert!(scene.lights[2..].iter().all(|light| light.colour.max_element() < 0.06), "dim");
    let triangles: usize =
        scene.objects.iter().map(|object| object.shape.mesh_for(&scene.camera).triangles.len()).sum();
    assert!((200_000..500_000).contains(&triangles), "{triangles}");
    for room in ["floor", "back wall", "window wall", "right wall", "ceiling"] {
        assert!(object(&scene, room).receives);
        assert_eq!(object(&scene, room).casts, room == "window wall", "{room}");
    }
}

#[test]
fn r87_f14_every_bicycle_stands_or_hangs_in_the_room() {
    let scene = gallery::bicycle_shop();
    let mut lowest = std::collections::BTreeMap::<&str, f32>::new();
    let room = object(&scene, "ceiling").shape.mesh_for(&scene.camera).bounds().expect("not empty");
    for object in scene.objects.iter().filter(|object| object.name.starts_with("bicycle")) {
        let (low, high) = object.shape.mesh_for(&scene.camera).bounds().expect("not empty");
        let bicycle = &object.name[.."bicycle 0".len()];
        let so_far = lowest.entry(bicycle).or_insert(f32::INFINITY);
        *so_far = so_far.min(low.y);
        assert!(low.x > room.0.x && high.x < room.1.x && low.z > room.0.z && high.z < room.1.z, "{}", object.name);
    }
    assert_eq!(lowest.len(), 7);
    let grounded = lowest.values().filter(|low| (-0.05..0.15).contains(*low)).count();
    assert_eq!(grounded, 6, "{lowest:?}; the seventh hangs on the wall");
}
