//! Skins.

use crate::build::{Build, corners, near, triangle};
use serde_json::json;

/// The triangle bound to two joints: the first corner to one, the second to the other, the third to both.
fn bound() -> Build {
    let mut build = triangle();
    let joints = build.accessor(&[0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0], 5121, "VEC4", 3);
    let weights = build.floats(&[[1.0, 0.0, 0.0, 0.0], [1.0, 0.0, 0.0, 0.0], [0.5, 0.5, 0.0, 0.0]]);
    let attributes = &mut build.document["meshes"][0]["primitives"][0]["attributes"];
    attributes["JOINTS_0"] = joints.into();
    attributes["WEIGHTS_0"] = weights.into();
    let identity = [1.0, 0.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 0.0, 1.0];
    let mut back = identity;
    back[12] = -1.0;
    let matrices = build.floats(&[identity, back]);
    // The node of the mesh stands elsewhere, which does not matter.
    build.node(json!({"mesh": 0, "skin": 0, "translation": [500, 0, 0]}));
    build.node(json!({"children": [2], "translation": [0, 0, 10]}));
    build.node(json!({"translation": [1, 0, 0], "scale": [1, 1, 1]}));
    build.push("skins", json!({"joints": [1, 2], "inverseBindMatrices": matrices}));
    build
}

#[test]
fn joints_carry_vertices_by_their_weights() {
    let mut build = bound();
    let found = corners(&build.read().unwrap(), 0);
    near(found[0].as_flattened(), &[0.0, 0.0, 10.0, 1.0, 0.0, 10.0, 0.0, 1.0, 10.0]);
    build.document["nodes"][2]["translation"] = json!([1, 0, 6]);
    let found = corners(&build.read().unwrap(), 0);
    near(found[0].as_flattened(), &[0.0, 0.0, 10.0, 1.0, 0.0, 16.0, 0.0, 1.0, 13.0]);
}

#[test]
fn mirrored_joints_turn_winding_round() {
    let mut build = bound();
    build.document["nodes"][1]["scale"] = json!([1, 1, -1]);
    let [a, b, c] = corners(&build.read().unwrap(), 0)[0];
    near(&[a, b, c].concat(), &[0.0, 0.0, 10.0, 0.0, 1.0, 10.0, 1.0, 0.0, 10.0]);
}

#[test]
fn joints_that_do_not_exist_are_named() {
    let mut build = bound();
    build.document["skins"][0]["joints"] = json!([1]);
    assert_eq!(build.refused(), "meshes[0].primitives[0].attributes.JOINTS_0: 1, expected a joint below 1");
    build.document["skins"][0]["joints"] = json!([1, 9]);
    assert_eq!(build.refused(), "skins[0].joints[1]: 9, expected the number of one of 3 nodes");
    build.document["skins"][0]["joints"] = json!([1, 2, 2]);
    assert_eq!(
        build.refused(),
        "skins[0].inverseBindMatrices: accessors[3] has 2 elements, expected one for each of 3 joints"
    );
}
