//! Primitives: modes, indices, normals, and every form of accessor.

use crate::build::{Build, TRIANGLE, corners, mesh, near, notes, triangle};
use glam::Vec3;
use serde_json::json;

const SQUARE: [[f32; 3]; 4] = [[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [1.0, 1.0, 0.0]];

fn square(mode: u32, order: Option<&[u16]>) -> Build {
    let mut build = Build::new();
    let positions = build.floats(&SQUARE);
    let mut primitive = json!({"attributes": {"POSITION": positions}, "mode": mode});
    if let Some(order) = order {
        primitive["indices"] = build.indices(order).into();
    }
    let mesh = build.mesh(primitive);
    build.node(json!({"mesh": mesh}));
    build
}

/// Places of [`SQUARE`] that the triangles name.
fn named(build: &Build) -> Vec<[usize; 3]> {
    let import = build.read().unwrap();
    let place = |at: [f64; 3]| SQUARE.iter().position(|known| known.map(f64::from) == at).unwrap();
    corners(&import, 0).into_iter().map(|triangle| triangle.map(place)).collect()
}

#[test]
fn triangles_strips_and_fans_run_counter_clockwise() {
    assert_eq!(named(&square(4, Some(&[0, 1, 2, 1, 3, 2]))), [[0, 1, 2], [1, 3, 2]]);
    assert_eq!(named(&square(5, None)), [[0, 1, 2], [1, 3, 2]]);
    assert_eq!(named(&square(6, Some(&[0, 1, 3, 2]))), [[1, 3, 0], [3, 2, 0]]);
    // A strip goes on over triangles of two equal corners, which are not kept.
    assert_eq!(named(&square(5, Some(&[0, 1, 2, 2, 1, 1, 1, 3, 2]))), [[0, 1, 2], [1, 3, 2]]);
}

#[test]
fn points_and_lines_are_skipped_by_name() {
    for (mode, what) in [(0, "points"), (1, "lines"), (3, "lines")] {
        let import = square(mode, None).read().unwrap();
        assert!(import.scene.objects.is_empty());
        let note = format!("meshes[0].primitives[0] is skipped: it has {what}, not triangles");
        assert!(notes(&import).contains(&note), "{:?}", notes(&import));
    }
    assert_eq!(square(7, None).refused(), "meshes[0].primitives[0].mode: 7, expected a number from 0 to 6");
}

#[test]
fn indices_of_one_two_and_four_bytes_say_the_same() {
    for (code, bytes) in
        [(5121, vec![2, 0, 1]), (5123, vec![2, 0, 0, 0, 1, 0]), (5125, vec![2, 0, 0, 0, 0, 0, 0, 0, 1, 0, 0, 0])]
    {
        let mut build = Build::new();
        let positions = build.floats(&SQUARE);
        let indices = build.accessor(&bytes, code, "SCALAR", 3);
        let mesh = build.mesh(json!({"attributes": {"POSITION": positions}, "indices": indices}));
        build.node(json!({"mesh": mesh}));
        assert_eq!(named(&build), [[2, 0, 1]]);
    }
}

#[test]
fn without_normals_triangles_are_flat_and_with_them_vertices_are_shared() {
    let mut build = square(4, Some(&[0, 1, 2, 1, 3, 2]));
    let flat = build.read().unwrap();
    assert_eq!(mesh(&flat, 0).positions.len(), 6);
    assert_eq!(mesh(&flat, 0).normals, [Vec3::Z; 6]);
    assert_eq!(mesh(&flat, 0).surfaces, [0, 1]);
    let normals = build.floats(&[[0.0, 0.0, 2.0], [3.0, 0.0, 4.0], [0.0; 3], [f32::NAN, 0.0, 0.0]]);
    build.document["meshes"][0]["primitives"][0]["attributes"]["NORMAL"] = normals.into();
    let smooth = build.read().unwrap();
    assert_eq!(mesh(&smooth, 0).positions.len(), 4);
    // A normal without a direction becomes that of its facet.
    assert_eq!(mesh(&smooth, 0).normals, [Vec3::Z, Vec3::new(0.6, 0.0, 0.8), Vec3::Z, Vec3::Z]);
    assert_eq!(mesh(&smooth, 0).surfaces, [0, 0]);
}

#[test]
fn interleaved_accessors_are_read_by_their_stride() {
    let mut build = Build::new();
    let row = |at: [f32; 3]| [at, [0.0, 0.0, 1.0]].concat().into_iter().flat_map(f32::to_le_bytes).collect::<Vec<_>>();
    let bytes: Vec<u8> = TRIANGLE.iter().flat_map(|&at| row(at)).collect();
    let view = build.view(&bytes);
    build.document["bufferViews"][view]["byteStride"] = 24.into();
    let of = |offset: usize| json!({"bufferView": view, "byteOffset": offset, "componentType": 5126, "type": "VEC3", "count": 3});
    let (positions, normals) = (build.push("accessors", of(0)), build.push("accessors", of(12)));
    let shape = build.mesh(json!({"attributes": {"POSITION": positions, "NORMAL": normals}}));
    build.node(json!({"mesh": shape}));
    let import = build.read().unwrap();
    assert_eq!(corners(&import, 0), [TRIANGLE.map(|at| at.map(f64::from))]);
    assert_eq!(mesh(&import, 0).normals, [Vec3::Z; 3]);
}

#[test]
fn sparse_accessors_replace_elements_with_or_without_a_base() {
    let mut build = triangle();
    let (numbers, values) = (build.view(&[1, 0, 2, 0]), {
        let bytes: Vec<u8> =
            [[5.0_f32, 0.0, 0.0], [0.0, 7.0, 0.0]].iter().flatten().flat_map(|n| n.to_le_bytes()).collect();
        build.view(&bytes)
    });
    build.document["accessors"][0]["sparse"] = json!({
        "count": 2,
        "indices": {"bufferView": numbers, "componentType": 5123},
        "values": {"bufferView": values},
    });
    build.node(json!({"mesh": 0}));
    let expected = [[[0.0, 0.0, 0.0], [5.0, 0.0, 0.0], [0.0, 7.0, 0.0]]];
    assert_eq!(corners(&build.read().unwrap(), 0), expected);
    build.document["accessors"][0].as_object_mut().unwrap().remove("bufferView");
    assert_eq!(corners(&build.read().unwrap(), 0), expected);
    build.bytes[38] = 1;
    assert_eq!(build.refused(), "accessors[0].sparse.indices[1]: 1, expected ascending numbers below 3");
}

#[test]
fn quantised_positions_and_normals_need_the_extension() {
    let mut build = Build::new();
    let numbers: [i16; 12] = [0, 0, 0, 0, 32_767, 0, 0, 0, -32_768, 16_384, 0, 0];
    let bytes: Vec<u8> = numbers.iter().flat_map(|number| number.to_le_bytes()).collect();
    let positions = build.accessor(&bytes, 5122, "VEC3", 3);
    build.document["bufferViews"][0]["byteStride"] = 8.into();
    let normals = build.accessor(&[0, 0, 127, 0, 0, 0, 127, 0, 0, 0, 127, 0], 5120, "VEC3", 3);
    build.document["bufferViews"][1]["byteStride"] = 4.into();
    build.document["accessors"][normals]["normalized"] = true.into();
    let shape = build.mesh(json!({"attributes": {"POSITION": positions, "NORMAL": normals}}));
    build.node(json!({"mesh": shape, "scale": [2.0, 2.0, 2.0]}));
    assert_eq!(
        build.refused(),
        "meshes[0].primitives[0].attributes.POSITION: accessors[0] has \"VEC3\" of I16, expected VEC3 of [F32]"
    );
    build.document["extensionsUsed"] = json!(["KHR_mesh_quantization"]);
    build.document["extensionsRequired"] = json!(["KHR_mesh_quantization"]);
    let plain = build.read().unwrap();
    assert_eq!(corners(&plain, 0), [[[0.0, 0.0, 0.0], [65_534.0, 0.0, 0.0], [-65_536.0, 32_768.0, 0.0]]]);
    assert_eq!(mesh(&plain, 0).normals, [Vec3::Z; 3]);
    build.document["accessors"][positions]["normalized"] = true.into();
    let [_, b, c] = corners(&build.read().unwrap(), 0)[0];
    near(&[b, c].concat(), &[2.0, 0.0, 0.0, -2.0, 2.0 * 16_384.0 / 32_767.0, 0.0]);
}

#[test]
fn a_mesh_is_closed_by_position_over_all_its_primitives() {
    // A tetrahedron, one side in a primitive of its own with vertices of its own.
    let at = [[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];
    let mut build = Build::new();
    let (first, second) = (build.floats(&at), build.floats(&at));
    let (three, one) = (build.indices(&[0, 2, 1, 0, 1, 3, 0, 3, 2]), build.indices(&[1, 2, 3]));
    build.push(
        "meshes",
        json!({"primitives": [
            {"attributes": {"POSITION": first}, "indices": three}, {"attributes": {"POSITION": second}, "indices": one},
        ]}),
    );
    build.node(json!({"mesh": 0, "name": "pyramid", "scale": [1.0, 3.0, -1.0]}));
    let import = build.read().unwrap();
    assert!(import.scene.objects.iter().all(|object| object.solid && object.casts && object.receives));
    let names: Vec<_> = import.scene.objects.iter().map(|object| object.name.as_str()).collect();
    assert_eq!(names, ["pyramid.0", "pyramid.1"]);
    build.document["meshes"][0]["primitives"].as_array_mut().unwrap().pop();
    assert!(!build.read().unwrap().scene.objects[0].solid);
    build.document["nodes"][0]["extras"] = json!({"casts": false, "receives": false});
    let still = build.read().unwrap();
    assert!(!still.scene.objects[0].casts && !still.scene.objects[0].receives);
}

#[test]
fn triangles_with_positions_that_are_not_finite_are_skipped_and_counted() {
    let mut build = Build::new();
    let mut at = SQUARE.to_vec();
    at.extend([[f32::NAN, 0.0, 0.0], [f32::INFINITY, 0.0, 0.0]]);
    let positions = build.floats(&at);
    let indices = build.indices(&[0, 1, 2, 0, 1, 4, 5, 1, 2, 1, 3, 2]);
    let shape = build.mesh(json!({"attributes": {"POSITION": positions}, "indices": indices}));
    build.node(json!({"mesh": shape}));
    let import = build.read().unwrap();
    assert_eq!(corners(&import, 0).len(), 2);
    let note = "triangles of meshes[0].primitives[0] are skipped: a position is not a finite number (2 times)";
    assert!(notes(&import).contains(&note.to_owned()), "{:?}", notes(&import));
}

#[test]
fn vertices_that_no_triangle_names_are_left_out() {
    let mut build = Build::new();
    let mut at = vec![[1e9_f32, 0.0, 0.0]; 100];
    at.extend(SQUARE);
    let positions = build.floats(&at);
    let indices = build.indices(&[100, 101, 103]);
    let shape = build.mesh(json!({"attributes": {"POSITION": positions}, "indices": indices}));
    build.node(json!({"mesh": shape}));
    let import = build.read().unwrap();
    assert_eq!(mesh(&import, 0).bounds(), Some((Vec3::ZERO, Vec3::new(1.0, 1.0, 0.0))));
}
