//! Scenes that are written and read back.

use crate::build::mesh;
use glam::DVec3;
use umbrage_gltf::{Import, ReadOptions, decode, encode};
use umbrage_plane::View;
use umbrage_scene::{Scene, Shape, gallery};

fn back(scene: &Scene) -> Import {
    let map = scene.lights[0].view.size();
    let options = ReadOptions::default().with_size(Some(scene.camera.size())).with_map_size(map.x);
    decode(&encode(scene).unwrap(), None, &scene.name, &options).unwrap()
}

#[track_caller]
fn same_view(found: &View, expected: &View) {
    assert_eq!((found.near(), found.far(), found.size()), (expected.near(), expected.far(), expected.size()));
    assert_eq!(
        (found.kind(), found.rules(), found.sampling()),
        (expected.kind(), expected.rules(), expected.sampling())
    );
    let tolerance = 1e-12 * (1.0 + expected.eye_to_world().w_axis.truncate().length());
    assert!(found.eye_to_world().abs_diff_eq(expected.eye_to_world(), tolerance));
    assert!(found.world_to_screen().abs_diff_eq(expected.world_to_screen(), tolerance));
    match (found.cone(), expected.cone()) {
        (Some(a), Some(b)) => assert!((a - b).abs() < 1e-14),
        (a, b) => assert_eq!(a, b),
    }
}

#[test]
fn scenes_of_the_gallery_come_back_as_they_were() {
    for make in [gallery::spot_room, gallery::three_lights, gallery::table, gallery::contact_box] {
        let scene = make();
        let import = back(&scene);
        assert_eq!((import.scene.objects.len(), import.scene.lights.len()), (scene.objects.len(), scene.lights.len()));
        for (at, object) in scene.objects.iter().enumerate() {
            let Shape::Mesh(expected) = &object.shape else { panic!("{} has patches", scene.name) };
            let (found, other) = (mesh(&import, at), &import.scene.objects[at]);
            assert_eq!((&found.positions, &found.triangles), (&expected.positions, &expected.triangles));
            let close = |(a, b): (&glam::Vec3, &glam::Vec3)| a.abs_diff_eq(*b, 1e-6);
            assert!(found.normals.iter().zip(&expected.normals).all(close));
            assert_eq!(found.surfaces, expected.surfaces, "{}", object.name);
            assert_eq!((&other.name, other.solid, other.passes), (&object.name, object.solid, object.passes));
            assert_eq!(other.material.diffuse, object.material.diffuse);
        }
        same_view(&import.scene.camera, &scene.camera);
        for (found, expected) in import.scene.lights.iter().zip(&scene.lights) {
            assert_eq!((&found.name, found.casts), (&expected.name, expected.casts));
            same_view(&found.view, &expected.view);
        }
        assert!(import.notes.is_empty(), "{:?}", import.notes);
    }
}

#[test]
fn every_scene_of_the_gallery_is_written_and_read() {
    for (name, make) in gallery::ALL {
        // Patches are diced to pieces of a texel: a small picture does.
        let mut scene = make();
        scene.camera = scene.camera.with_size(glam::UVec2::splat(32)).unwrap();
        let import = back(&scene);
        assert_eq!(import.lamps.len(), scene.lights.len(), "{name}");
        let flags =
            |scene: &Scene| scene.objects.iter().map(|object| (object.casts, object.receives)).collect::<Vec<_>>();
        assert_eq!(flags(&import.scene), flags(&scene), "{name}");
    }
}

#[test]
fn a_scene_far_away_is_written_about_its_origin() {
    let by = DVec3::new(3e6, -1e6, 2e6);
    let scene = gallery::spot_room().moved(by).unwrap();
    let import = back(&scene);
    assert_ne!(import.scene.origin, DVec3::ZERO);
    for at in 0..scene.objects.len() {
        let Shape::Mesh(expected) = &scene.objects[at].shape else { panic!("spot-room has no patches") };
        for (found, expected) in mesh(&import, at).positions.iter().zip(&expected.positions) {
            let (found, expected) = (import.scene.origin + found.as_dvec3(), scene.origin + expected.as_dvec3());
            assert!(found.distance(expected) < 1e-4, "{found} is not {expected}");
        }
    }
    let view = import.scene.lights[0].view;
    assert!(view.eye_to_world().abs_diff_eq(scene.lights[0].view.eye_to_world(), 1e-8));
}

#[test]
fn a_broken_mesh_is_not_written() {
    let mut scene = gallery::table();
    let Shape::Mesh(broken) = &mut scene.objects[1].shape else { panic!("the table has no patches") };
    broken.normals.pop();
    assert_eq!(
        encode(&scene).unwrap_err().to_string(),
        "objects[1]: mesh has 24 positions but 23 normals, expected a mesh without faults"
    );
}
