//! Cameras.

use crate::build::{Build, near, notes, triangle};
use glam::{DVec2, DVec3, UVec2};
use serde_json::json;
use umbrage_gltf::ReadOptions;
use umbrage_plane::Projection;

/// The triangle, seen by a camera at (0, 0, 5).
fn seen(camera: serde_json::Value) -> Build {
    let mut build = triangle();
    build.node(json!({"mesh": 0}));
    build.push("cameras", camera);
    build.node(json!({"camera": 0, "translation": [0, 0, 5], "name": "main"}));
    build
}

fn lens() -> serde_json::Value {
    json!({"type": "perspective", "perspective": {"yfov": 1.0, "aspectRatio": 1.5, "znear": 0.5, "zfar": 20.0}})
}

#[test]
fn perspective_cameras_keep_their_vertical_field() {
    let build = seen(lens());
    let view = build.read().unwrap().scene.camera;
    assert_eq!((view.size(), view.near(), view.far()), (UVec2::new(768, 512), 0.5, 20.0));
    let k = 1.0 / 0.5_f64.tan();
    assert_eq!(view.projection(), Projection::perspective(DVec2::new(k / 1.5, k)));
    assert_eq!((view.light().truncate(), view.ahead()), (DVec3::Z * 5.0, DVec3::NEG_Z));
    let square = build.read_with(&ReadOptions::default().with_size(Some(UVec2::new(64, 32)))).unwrap().scene.camera;
    assert_eq!(square.size(), UVec2::new(64, 32));
    assert_eq!(square.projection(), Projection::perspective(DVec2::new(k / 2.0, k)));
}

#[test]
fn a_camera_without_a_far_plane_sees_as_far_as_there_is_anything() {
    let mut build = seen(lens());
    build.document["cameras"][0]["perspective"].as_object_mut().unwrap().remove("zfar");
    let view = build.read().unwrap().scene.camera;
    assert!(view.far() > 5.0 && view.far() < 5.1, "{}", view.far());
}

#[test]
fn orthographic_cameras_keep_their_height() {
    let build = seen(json!({"type": "orthographic", "orthographic": {"xmag": 4, "ymag": 2, "znear": 0, "zfar": 9}}));
    let view = build.read().unwrap().scene.camera;
    assert_eq!((view.size(), view.near(), view.far()), (UVec2::new(1024, 512), 0.0, 9.0));
    assert_eq!(view.projection(), Projection::orthographic(DVec2::new(4.0, 2.0)));
    let square = build.read_with(&ReadOptions::default().with_size(Some(UVec2::splat(16)))).unwrap().scene.camera;
    assert_eq!(square.projection(), Projection::orthographic(DVec2::splat(2.0)));
}

#[test]
fn mirrors_and_shears_of_parents_leave_the_world_direction() {
    let mut build = seen(lens());
    // A shear that tilts z toward x, over a mirror.
    build.node(json!({"children": [1], "matrix": [-1, 0, 0, 0, 0, 1, 0, 0, 3, 0, 4, 0, 0, 0, 0, 1]}));
    let view = build.read().unwrap().scene.camera;
    near(&view.ahead().to_array(), &[-0.6, 0.0, -0.8]);
    near(&view.light().truncate().to_array(), &[15.0, 0.0, 20.0]);
    near(&view.eye_to_world().y_axis.truncate().to_array(), &[0.0, 1.0, 0.0]);
}

#[test]
fn cameras_are_found_by_name() {
    let mut build = seen(lens());
    build.push(
        "cameras",
        json!({"name": "lens", "type": "orthographic",
        "orthographic": {"xmag": 1, "ymag": 1, "znear": 0, "zfar": 9}}),
    );
    build.node(json!({"camera": 1}));
    let read = |name: &str| build.read_with(&ReadOptions::default().with_camera(Some(name.into())));
    assert!(read("main").unwrap().scene.camera.is_perspective());
    assert!(!read("lens").unwrap().scene.camera.is_perspective());
    assert_eq!(read("x").unwrap_err().to_string(), r#"cameras: "x", expected one of "main", "lens""#);
}

#[test]
fn a_scene_without_a_camera_is_seen_whole() {
    let mut build = triangle();
    build.node(json!({"mesh": 0, "translation": [7e5, 0, 0]}));
    for size in [None, Some(UVec2::new(100, 400)), Some(UVec2::new(400, 100))] {
        let import = build.read_with(&ReadOptions::default().with_size(size)).unwrap();
        let view = import.scene.camera;
        let everything: Vec<DVec3> = import.scene.hull(&import.scene.objects[0]).collect();
        for at in everything {
            let eye = view.world_to_eye().transform_point3(at);
            assert!((view.near()..view.far()).contains(&-eye.z));
            let texel = view.eye_to_texel(eye);
            assert!(texel.cmpge(DVec2::ZERO).all() && texel.cmple(view.size().as_dvec2()).all(), "{texel}");
        }
        assert!(notes(&import)[0].starts_with("the scene has no camera"), "{:?}", notes(&import));
    }
}

#[test]
fn faults_of_cameras_are_named() {
    let faults = [
        (
            json!({"type": "perspective", "perspective": {"yfov": 60, "znear": 1}}),
            "cameras[0].perspective.yfov: 60, expected radians above 0 and below pi",
        ),
        (
            json!({"type": "perspective", "perspective": {"yfov": 1, "znear": 0}}),
            "cameras[0].perspective.znear: 0, expected a number above 0",
        ),
        (
            json!({"type": "perspective", "perspective": {"yfov": 1, "znear": 2, "zfar": 1}}),
            "cameras[0].perspective.zfar: 1, expected a number above znear",
        ),
        (
            json!({"type": "perspective", "perspective": {"znear": 2}}),
            "cameras[0].perspective.yfov: nothing, expected radians above 0 and below pi",
        ),
        (json!({"type": "fisheye"}), "cameras[0].type: \"fisheye\", expected perspective or orthographic"),
        (json!({"type": "orthographic"}), "cameras[0].orthographic: nothing, expected an object"),
    ];
    for (camera, line) in faults {
        assert_eq!(seen(camera).refused(), line);
    }
    let mut build = seen(lens());
    build.document["nodes"][1]["scale"] = json!([1, 1, 0]);
    assert_eq!(
        build.refused(),
        "nodes[1]: a transform without a z axis, expected a place and a direction in the world"
    );
}
