//! Nodes: transforms, mirrors, copies, and scenes far away.

use crate::build::{Build, TRIANGLE, corners, mesh, near, notes, triangle};
use glam::{DVec3, Vec3};
use serde_json::json;

fn placed(node: serde_json::Value) -> Build {
    let mut build = triangle();
    let mut node = node;
    node["mesh"] = 0.into();
    build.node(node);
    build
}

fn flat(corners: &[[[f64; 3]; 3]]) -> Vec<f64> {
    corners.as_flattened().as_flattened().to_vec()
}

#[test]
fn translation_rotation_and_scale_apply_from_the_right() {
    // A quarter turn about z, given by a quaternion that is not of unit length.
    let build = placed(json!({"translation": [10, 20, 30], "rotation": [0, 0, 5, 5], "scale": [2, 3, 4]}));
    let found = corners(&build.read().unwrap(), 0);
    near(&flat(&found), &[10.0, 20.0, 30.0, 10.0, 22.0, 30.0, 7.0, 20.0, 30.0]);
    assert!(placed(json!({"rotation": [0, 0, 0, 0]})).refused().ends_with("expected a quaternion that is not 0"));
}

#[test]
fn a_matrix_is_given_by_columns_and_parents_apply_last() {
    let mut build = placed(json!({"matrix": [0, 1, 0, 0, -1, 0, 0, 0, 0, 0, 1, 0, 5, 0, 0, 1]}));
    build.node(json!({"children": [0], "scale": [2, 2, 2]}));
    let found = corners(&build.read().unwrap(), 0);
    near(&flat(&found), &[10.0, 0.0, 0.0, 10.0, 2.0, 0.0, 8.0, 0.0, 0.0]);
    assert_eq!(
        placed(json!({"matrix": [1, 0, 0, 0.5, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1]})).refused(),
        "nodes[0].matrix: a fourth row of [0.5, 0.0, 0.0, 1.0], expected 0, 0, 0, 1"
    );
}

#[test]
fn a_mirror_turns_winding_round_and_normals_stay_outward() {
    let mut build = placed(json!({"scale": [-1, 2, 1]}));
    let normals = build.floats(&[[0.0, 0.0, 1.0]; 3]);
    let find = |build: &Build| {
        let import = build.read().unwrap();
        let [a, b, c] = corners(&import, 0)[0].map(DVec3::from_array);
        ((b - a).cross(c - a), mesh(&import, 0).normals[0])
    };
    // Seen from +z it is still counter-clockwise: (0, 0), (0, 2), (−1, 0).
    assert_eq!(find(&build), (DVec3::Z * 2.0, Vec3::Z));
    build.document["meshes"][0]["primitives"][0]["attributes"]["NORMAL"] = normals.into();
    assert_eq!(find(&build), (DVec3::Z * 2.0, Vec3::Z));
    build.document["nodes"][0]["scale"] = json!([1, 1, -1]);
    assert_eq!(find(&build), (DVec3::NEG_Z, Vec3::NEG_Z));
}

#[test]
fn normals_stay_square_to_surfaces_that_are_stretched() {
    let mut build = placed(json!({"scale": [2, 1, 1]}));
    let normals = build.floats(&[[0.6, 0.8, 0.0]; 3]);
    build.document["meshes"][0]["primitives"][0]["attributes"]["NORMAL"] = normals.into();
    let expected = Vec3::new(0.3, 0.8, 0.0).normalize();
    assert!(mesh(&build.read().unwrap(), 0).normals[0].abs_diff_eq(expected, 1e-6));
}

#[test]
fn a_mesh_stands_wherever_nodes_show_it_and_nowhere_else() {
    let mut build = placed(json!({"name": "one"}));
    build.node(json!({"mesh": 0, "translation": [0, 0, 7]}));
    build.node(json!({"mesh": 0, "name": "hidden"}));
    build.push("scenes", json!({"nodes": [2]}));
    build.push("scenes", json!({"nodes": [0, 1, 1]}));
    build.document["scene"] = 1.into();
    let import = build.read().unwrap();
    let names: Vec<_> = import.scene.objects.iter().map(|object| object.name.as_str()).collect();
    assert_eq!(names, ["one", "mesh0"]);
    assert_eq!(corners(&import, 1)[0][0], [0.0, 0.0, 7.0]);
    assert!(notes(&import).contains(&"of 2 scenes only scenes[1] is shown".into()));
}

#[test]
fn copies_stand_in_the_space_of_their_node() {
    let mut build = placed(json!({"translation": [100, 0, 0]}));
    let translations = build.floats(&[[1.0, 0.0, 0.0], [0.0, 2.0, 0.0]]);
    let rotations = build.floats(&[[0.0, 0.0, 0.0, 1.0], [0.0, 0.0, 1.0, 0.0]]);
    let scales = build.floats(&[[1.0, 1.0, 1.0], [1.0, 1.0, -1.0]]);
    build.document["nodes"][0]["extensions"] = json!({"EXT_mesh_gpu_instancing": {"attributes": {
        "TRANSLATION": translations, "ROTATION": rotations, "SCALE": scales, "_ID": 0,
    }}});
    build.document["extensionsRequired"] = json!(["EXT_mesh_gpu_instancing"]);
    let import = build.read().unwrap();
    assert_eq!(import.scene.objects.len(), 2);
    near(&flat(&corners(&import, 0)), &[101.0, 0.0, 0.0, 102.0, 0.0, 0.0, 101.0, 1.0, 0.0]);
    // Turned by half a turn about z and mirrored: x and y negated, the last two corners exchanged.
    near(&flat(&corners(&import, 1)), &[100.0, 2.0, 0.0, 100.0, 1.0, 0.0, 99.0, 2.0, 0.0]);
    let one = build.floats(&[[1.0, 0.0, 0.0]]);
    build.document["nodes"][0]["extensions"]["EXT_mesh_gpu_instancing"]["attributes"]["SCALE"] = one.into();
    let line = build.refused();
    assert!(
        line.starts_with("nodes[0].extensions.EXT_mesh_gpu_instancing.attributes.SCALE: accessors[4] has 1 elements"),
        "{line}"
    );
}

#[test]
fn a_scene_far_away_keeps_its_small_numbers() {
    let import = placed(json!({"translation": [4e6, -3e6, 0.125]})).read().unwrap();
    assert_ne!(import.scene.origin, DVec3::ZERO);
    let expected = TRIANGLE.map(|[x, y, _]| [f64::from(x) + 4e6, f64::from(y) - 3e6, 0.125]);
    assert_eq!(corners(&import, 0), [expected]);
    assert!(mesh(&import, 0).positions.iter().all(|at| at.abs().max_element() < 4.0));
    // Beside the origin nothing is moved.
    assert_eq!(placed(json!({"translation": [3, 0, 0]})).read().unwrap().scene.origin, DVec3::ZERO);
}
