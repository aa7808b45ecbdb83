use glam::{DVec2, DVec3, UVec2, Vec3};
use std::collections::BTreeSet;
use umbrage_plane::{Kind, View};
use umbrage_scene::{Scene, Shape, gallery};

fn eye_and_texel(view: &View, at: Vec3) -> (DVec3, DVec2) {
    let eye = view.world_to_eye().transform_point3(at.as_dvec3());
    (eye, view.eye_to_texel(eye))
}

fn framed(view: &View, at: Vec3) -> bool {
    let (eye, texel) = eye_and_texel(view, at);
    let inside = texel.cmpge(DVec2::ZERO).all() && texel.cmple(view.size().as_dvec2()).all();
    inside && (view.near()..=view.far()).contains(&-eye.z)
}

/// Points all over a triangle; many when it is large, but no more than 400 along a side.
fn spread([a, b, c]: [Vec3; 3]) -> impl Iterator<Item = Vec3> {
    let steps = ((b - a).length().max((c - a).length()).ceil() as u32).clamp(1, 400);
    (0..=steps).flat_map(move |i| {
        (0..=steps - i).map(move |j| a + (b - a) * (i as f32 / steps as f32) + (c - a) * (j as f32 / steps as f32))
    })
}

/// World centre of an object's bounds.
fn centre(scene: &Scene, object: usize) -> Vec3 {
    let points: Vec<Vec3> = scene.objects[object].shape.hull().collect();
    let low = points.iter().copied().reduce(Vec3::min).expect("not empty");
    let high = points.iter().copied().reduce(Vec3::max).expect("not empty");
    (low + high) * 0.5
}

#[test]
fn every_scene_is_sound() {
    for (name, make) in gallery::ALL {
        let scene = make();
        assert_eq!(scene.name, *name);
        assert_eq!(scene, make(), "{name} is the same every time");
        assert!(!scene.lights.is_empty());
        let names: BTreeSet<&str> = scene.objects.iter().map(|object| object.name.as_str()).collect();
        assert_eq!(names.len(), scene.objects.len(), "{name}: objects are found by name");
        for object in &scene.objects {
            // Only patches are cut otherwise for another view.
            let views = if matches!(object.shape, Shape::Patches(_)) { scene.lights.len() } else { 0 };
            for view in scene.lights[..views].iter().map(|light| &light.view).chain([&scene.camera]) {
                let small = view.with_size(UVec2::splat(64)).expect("valid");
                let mesh = object.shape.mesh_for(&small);
                assert_eq!(mesh.check(), Ok(()), "{name}, {}", object.name);
                assert_eq!(mesh.is_closed(), object.solid, "{name}, {}", object.name);
            }
            let colour = object.material.diffuse;
            assert!(colour.cmpge(Vec3::ZERO).all() && colour.cmple(Vec3::ONE).all());
        }
    }
}

/// Whether an object may leave a light's map: what shadows fall on, what carries the light itself or stands behind it,
/// and everything in a room that is larger than any map.
fn reaches_beyond(scene: &str, light: &str, object: &str) -> bool {
    match scene {
        "desk-lamps" => match light {
            "big lamp" => object.starts_with("big"),
            "small lamp" => object.starts_with("big") || object.starts_with("small"),
            _ => false,
        },
        "bicycle-shop" => true,
        "bowling" => ["lane", "gutters", "side walls"].contains(&object),
        "spot-room" => object.ends_with("wall") || object == "floor" || object.starts_with("tall"),
        "walkthrough" | "contact-box" | "grazing" => false,
        _ => ["slab", "wall", "floor", "column"].contains(&object),
    }
}

#[test]
fn w78_8_what_throws_the_shadows_is_framed_by_every_light() {
    for (name, make) in gallery::ALL {
        let scene = make();
        for light in &scene.lights {
            let outside = scene.casters_outside(&light.view);
            let view = scene.about_origin(&light.view);
            for (id, object) in scene.objects.iter().enumerate().filter(|(_, object)| object.casts) {
                let all = object.shape.hull().all(|at| framed(&view, at));
                assert_eq!(outside.contains(&(id as u32)), !all, "{name}: {}, {}", light.name, object.name);
                if !light.casts {
                    continue;
                }
                if *name == "box-plane" && object.name == "box" {
                    let edge = object.shape.hull().filter(|at| at.x == 0.0);
                    assert_eq!(edge.filter(|at| framed(&light.view, *at)).count(), 12);
                } else {
                    let spared = reaches_beyond(name, &light.name, &object.name);
                    assert!(all || spared, "{name}: {}, {}", light.name, object.name);
                }
            }
        }
    }
    let mut scene = gallery::four_spheres();
    let view = scene.lights[0].view;
    let aside = scene.objects[2].shape.mesh_for(&view).into_owned();
    let moved = aside.positions.iter().map(|at| *at + Vec3::Y * 5.0).collect();
    scene.objects[2].shape = Shape::Mesh(umbrage_scene::Mesh { positions: moved, ..aside });
    assert_eq!(scene.casters_outside(&view), [2]);
    scene.objects[2].casts = false;
    assert_eq!(scene.casters_outside(&view), Vec::<u32>::new());
}

/// Nothing visible is cut by the camera's near plane or lies past its far plane, and nothing that casts by a light's.
#[test]
fn ranges_hold_everything_that_is_seen() {
    for (name, make) in gallery::ALL {
        let scene = make();
        let lights = scene.lights.iter().filter(|light| light.casts);
        for (view, by_light) in lights.map(|light| (&light.view, true)).chain([(&scene.camera, false)]) {
            let view = &scene.about_origin(view);
            for object in scene.objects.iter().filter(|object| object.casts || !by_light) {
                let mesh = object.shape.mesh_for(&view.with_size(UVec2::splat(16)).expect("valid"));
                for at in (0..mesh.triangles.len()).flat_map(|triangle| spread(mesh.corners(triangle))) {
                    let (eye, texel) = eye_and_texel(view, at);
                    let in_map = texel.cmpge(DVec2::ZERO).all() && texel.cmple(view.size().as_dvec2()).all();
                    let seen = in_map && eye.z < 0.0;
                    let in_range = (view.near()..=view.far()).contains(&-eye.z);
                    assert!(!seen || in_range, "{name}: {} at {}", object.name, -eye.z);
                }
            }
        }
    }
}

#[test]
fn w78_2_four_spheres_as_the_figures_need_them() {
    let scene = gallery::four_spheres();
    let light = scene.lights[0].view;
    assert_eq!((scene.camera.size(), light.size()), (UVec2::splat(512), UVec2::splat(512)));
    assert_eq!((scene.camera.kind(), light.kind()), (Kind::Screen, Kind::Screen));
    assert!(!light.is_perspective() && !scene.camera.is_perspective());
    let toward = light.toward_eye(DVec3::ZERO);
    let bearing = toward.dot(scene.camera.toward_eye(DVec3::ZERO)).acos().to_degrees();
    assert!((bearing - 100.0).abs() < 1e-9 && toward.x < 0.0, "to the observer's left");
    for object in 0..4 {
        assert!(scene.objects[object].shape.hull().all(|at| framed(&scene.camera, at)));
    }
    let radius = 512.0 / 6.4;
    let apart = |view: &View, a: usize, b: usize| {
        let place = |object| eye_and_texel(view, centre(&scene, object)).1;
        place(a).distance(place(b)) / radius
    };
    let pairs = [(0, 1), (0, 2), (0, 3), (1, 2), (1, 3), (2, 3)];
    for (a, b) in pairs {
        assert!(apart(&scene.camera, a, b) > 2.0, "the observer sees four whole discs");
        assert_eq!(apart(&light, a, b) < 2.0, (a, b) == (0, 1), "{a} and {b} seen from the light");
    }
    let depth = |object| -eye_and_texel(&light, centre(&scene, object)).0.z;
    assert!(depth(0) < depth(1), "sphere 0 shades sphere 1");
}

#[test]
fn v46c_lit_share_of_an_isolated_sphere() {
    assert!((lit_share(&gallery::four_spheres()) - 0.413_176).abs() < 1e-3);
    assert!((lit_share(&gallery::four_spheres_lit_from(80.0)) - 0.586_824).abs() < 1e-3);
}

/// The part of a sphere's disc, as the observer sees it, that faces the light.
fn lit_share(scene: &Scene) -> f64 {
    let toward = scene.lights[0].incident(DVec3::ZERO).0.as_dvec3();
    let steps = 2000;
    let (mut disc, mut lit) = (0u32, 0u32);
    for row in 0..steps {
        for column in 0..steps {
            let at = (DVec2::new(f64::from(column), f64::from(row)) + 0.5) / (f64::from(steps) * 0.5) - 1.0;
            if at.length_squared() < 1.0 {
                disc += 1;
                lit += u32::from(at.extend((1.0 - at.length_squared()).sqrt()).dot(toward) > 0.0);
            }
        }
    }
    f64::from(lit) / f64::from(disc)
}

#[test]
fn sphere_plane_and_box_plane_as_given() {
    let scene = gallery::sphere_plane();
    let bounds = |object: usize| {
        let mesh = scene.objects[object].shape.mesh_for(&scene.camera).into_owned();
        mesh.bounds().expect("not empty")
    };
    assert_eq!(bounds(0), (Vec3::new(-12.0, -12.0, 13.0), Vec3::new(12.0, 12.0, 37.0)));
    let low = Vec3::new(-60.0, -60.0, -gallery::SLAB_THICKNESS);
    assert_eq!(bounds(1), (low, Vec3::new(60.0, 60.0, 0.0)));
    assert!(scene.objects[1].casts, "R87-F9 measures how the plane shadows itself");
    assert_eq!(scene.lights[0].view.light().truncate(), DVec3::new(-70.0, 25.0, 70.0));
    assert_eq!(scene.lights[0].view.size(), UVec2::splat(1024));

    // The shadow's edge from the box's upper right edge: x = −30 + 30·110/86.
    let scene = gallery::box_plane();
    let edge = Vec3::new(-30.0 + 30.0 * 110.0 / 86.0, 0.0, 0.0);
    let (_, texel) = eye_and_texel(&scene.lights[0].view, edge);
    let (_, top) = eye_and_texel(&scene.lights[0].view, Vec3::new(0.0, (24.0 * 5.0) / 110.0, 24.0));
    assert!((texel - top).length() < 1e-3, "one ray from the light");
    assert!(framed(&scene.camera, edge));
}
