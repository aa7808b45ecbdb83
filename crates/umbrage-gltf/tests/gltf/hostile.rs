//! Files that lie. Each ends in one line, and none takes memory or time that it does not have.

use crate::build::{Build, container, notes, triangle};
use serde_json::{Value, json};
use umbrage_gltf::{ReadOptions, decode};

fn shown() -> Build {
    let mut build = triangle();
    build.node(json!({"mesh": 0}));
    build
}

fn line(bytes: &[u8]) -> String {
    let line = decode(bytes, None, "test", &ReadOptions::default()).unwrap_err().to_string();
    assert!(!line.contains('\n'), "{line:?}");
    line
}

/// The line for the triangle with one value replaced.
fn with(pointer: &str, value: Value) -> String {
    let mut build = shown();
    build.document["buffers"] = json!([{"byteLength": 36}]);
    let (holder, name) = pointer.rsplit_once('/').unwrap();
    build.document.pointer_mut(holder).unwrap()[name] = value;
    line(&build.glb())
}

#[test]
fn containers_say_their_own_length() {
    let whole = shown().glb();
    assert_eq!(
        line(&whole[..whole.len() - 1]),
        format!("glb.length: {}, expected the file's {} bytes", whole.len(), whole.len() - 1)
    );
    assert_eq!(line(b"glTF"), "glb: 4 bytes, expected a header of 12 bytes");
    let changed = |at: usize, word: u32| {
        let mut bytes = whole.clone();
        bytes[at..at + 4].copy_from_slice(&word.to_le_bytes());
        line(&bytes)
    };
    assert_eq!(changed(4, 1), "glb.version: 1, expected 2");
    assert_eq!(changed(8, u32::MAX), format!("glb.length: 4294967295, expected the file's {} bytes", whole.len()));
    assert_eq!(
        changed(12, u32::MAX),
        format!("glb.chunks[0].length: 4294967295, expected at most {} bytes", whole.len() - 20)
    );
    assert_eq!(changed(16, 7), "glb.chunks[0].type: 0x00000007, expected JSON");
    let mut stub = b"glTF\x02\0\0\0\x0c\0\0\0".to_vec();
    assert_eq!(line(&stub), "glb.chunks[0]: 0 bytes, expected a header of 8 bytes");
    stub[8] = 16;
    stub.extend([255; 4]);
    assert_eq!(line(&stub), "glb.chunks[0]: 4 bytes, expected a header of 8 bytes");
}

#[test]
fn text_is_json_of_version_2() {
    assert_eq!(line(b""), "json: EOF while parsing a value at line 1 column 0");
    assert_eq!(line(b"[]"), "json: not an object");
    assert_eq!(line(b"{}"), "asset: nothing, expected an object with a version");
    assert_eq!(line(br#"{"asset": {"version": "1.0"}}"#), "asset.version: \"1.0\", expected 2.0");
    assert!(line(&b"[".repeat(10_000)).starts_with("json: recursion limit exceeded"));
    let empty = decode(b"\xEF\xBB\xBF{\"asset\": {\"version\": \"2.0\"}}", None, "", &ReadOptions::default()).unwrap();
    assert!(notes(&empty).contains(&"the scene has no triangles".into()));
}

#[test]
fn numbers_of_things_that_do_not_exist_are_named() {
    let faults = [
        ("/nodes/0/mesh", json!(1), "nodes[0].mesh: 1, expected the number of one of 1 meshes"),
        ("/nodes/0/mesh", json!(-1), "nodes[0].mesh: -1, expected the number of one of 1 meshes"),
        ("/nodes/0/mesh", json!(0.5), "nodes[0].mesh: 0.5, expected the number of one of 1 meshes"),
        (
            "/meshes/0/primitives/0/attributes/POSITION",
            json!(7),
            "meshes[0].primitives[0].attributes.POSITION: 7, expected the number of one of 1 accessors",
        ),
        (
            "/accessors/0/bufferView",
            json!(2),
            "accessors[0].bufferView: 2, expected the number of one of 1 bufferViews",
        ),
        (
            "/bufferViews/0/buffer",
            json!(4_294_967_296_u64),
            "bufferViews[0].buffer: 4294967296, expected the number of one of 1 buffers",
        ),
        (
            "/meshes/0/primitives/0/material",
            json!(0),
            "meshes[0].primitives[0].material: 0, expected the number of one of 0 materials",
        ),
        ("/scene", json!(3), "scene: 3, expected the number of one of 0 scenes"),
        ("/nodes", json!({"a": 1}), "nodes: an object of 1, expected an array"),
        ("/nodes/0/skin", json!("x\ny"), "nodes[0].skin: \"x\\ny\", expected the number of one of 0 skins"),
        ("/nodes/0/scale", json!([1, 2]), "nodes[0].scale: an array of 2, expected 3 numbers"),
        ("/nodes/0/scale", json!([1, 2, null]), "nodes[0].scale: null, expected 3 numbers"),
    ];
    for (pointer, value, expected) in faults {
        assert_eq!(with(pointer, value), expected);
    }
}

#[test]
fn rows_lie_within_their_views_and_views_within_their_buffers() {
    let huge = u64::MAX;
    let faults = [
        (
            "/accessors/0/count",
            json!(4),
            "accessors[0]: 4 elements of 12 bytes, 12 apart, from byte 0, expected the 36 bytes of bufferViews[0]",
        ),
        ("/accessors/0/count", json!(0), "accessors[0].count: 0, expected a number from 1 to 4294967295"),
        (
            "/accessors/0/count",
            json!(huge),
            "accessors[0].count: 18446744073709551615, expected a number from 1 to 4294967295",
        ),
        (
            "/accessors/0/byteOffset",
            json!(huge),
            "accessors[0]: 3 elements of 12 bytes, 12 apart, from byte 18446744073709551615, expected the 36 bytes of bufferViews[0]",
        ),
        (
            "/accessors/0/componentType",
            json!(5124),
            "accessors[0].componentType: 5124, expected 5120, 5121, 5122, 5123, 5125 or 5126",
        ),
        (
            "/accessors/0/type",
            json!("VEC2"),
            "meshes[0].primitives[0].attributes.POSITION: accessors[0] has \"VEC2\" of F32, expected VEC3 of [F32]",
        ),
        (
            "/bufferViews/0/byteOffset",
            json!(huge),
            "bufferViews[0].byteLength: 36, expected at most the bytes of buffers[0], 36, behind 18446744073709551615",
        ),
        (
            "/bufferViews/0/byteLength",
            json!(huge),
            "bufferViews[0].byteLength: 18446744073709551615, expected at most the bytes of buffers[0], 36, behind 0",
        ),
        (
            "/bufferViews/0/byteStride",
            json!(8),
            "bufferViews[0].byteStride: 8, expected 12 or more, the bytes of an element of accessors[0]",
        ),
        (
            "/buffers/0/byteLength",
            json!(huge),
            "buffers[0].byteLength: 18446744073709551615, expected at most the 36 bytes that there are",
        ),
        (
            "/buffers/0/byteLength",
            json!(35),
            "bufferViews[0].byteLength: 36, expected at most the bytes of buffers[0], 35, behind 0",
        ),
    ];
    for (pointer, value, expected) in faults {
        assert_eq!(with(pointer, value), expected);
    }
}

#[test]
fn an_index_out_of_range_is_named_with_its_accessor_and_count() {
    let mut build = shown();
    let indices = build.indices(&[0, 1, 9]);
    build.document["meshes"][0]["primitives"][0]["indices"] = indices.into();
    assert_eq!(
        build.refused(),
        "meshes[0].primitives[0].indices: 9 at place 2 of accessors[1], expected a vertex below 3, the count of accessors[0]"
    );
    build.document["accessors"][1]["componentType"] = 5126.into();
    build.document["accessors"][1]["count"] = 1.into();
    assert!(build.refused().ends_with("accessors[1] has \"SCALAR\" of F32, expected SCALAR of [U8, U16, U32]"));
}

#[test]
fn attributes_have_one_element_per_position() {
    let mut build = shown();
    let normals = build.floats(&[[0.0, 0.0, 1.0]; 2]);
    build.document["meshes"][0]["primitives"][0]["attributes"]["NORMAL"] = normals.into();
    assert_eq!(
        build.refused(),
        "meshes[0].primitives[0].attributes.NORMAL: accessors[1] has 2 elements, expected 3, one per position"
    );
}

#[test]
fn circles_and_shared_children_are_refused() {
    let mut build = shown();
    build.node(json!({"children": [2]}));
    build.node(json!({"children": [1]}));
    assert_eq!(build.refused(), "nodes[1]: its own ancestor, expected a tree of nodes");
    build.document["nodes"][2]["children"] = json!([2]);
    assert_eq!(build.refused(), "nodes[2].children[0]: 2, expected a node without another parent");
    build.document["nodes"][2]["children"] = json!([0, 0]);
    assert_eq!(build.refused(), "nodes[2].children[1]: 0, expected a node without another parent");
    build.document["nodes"][2]["children"] = json!([5]);
    assert_eq!(build.refused(), "nodes[2].children[0]: 5, expected the number of one of 3 nodes");
}

#[test]
fn a_hundred_thousand_levels_are_walked() {
    let mut build = triangle();
    let last = 100_000;
    let nodes = (0..last).map(|node| json!({"children": [node + 1], "translation": [0, 0, 1]}));
    build.document["nodes"] = nodes.chain([json!({"mesh": 0})]).collect();
    let import = build.read().unwrap();
    let corner = import.scene.hull(&import.scene.objects[0]).next().unwrap();
    assert_eq!(corner.z, f64::from(last));
}

#[test]
fn what_is_promised_is_counted_before_it_is_allocated() {
    // No buffer holds these positions: all are 0, four thousand million of them.
    let mut build = shown();
    build.document["accessors"][0] = json!({"componentType": 5126, "type": "VEC3", "count": 4_294_967_295_u64});
    let line = build.refused();
    assert_eq!(line.split(", ").next(), Some("meshes[0].primitives[0]: 160345445680 bytes are needed"), "{line}");
    let mut build = shown();
    let copies = build.push("accessors", json!({"componentType": 5126, "type": "VEC3", "count": 40_000_000}));
    build.document["nodes"][0]["extensions"] =
        json!({"EXT_mesh_gpu_instancing": {"attributes": {"TRANSLATION": copies}}});
    let line = build.refused();
    assert!(line.starts_with("nodes[0].extensions.EXT_mesh_gpu_instancing.attributes: 5120000000 bytes"), "{line}");
    // Fewer copies fit by themselves, but not with a mesh each.
    build.document["accessors"][copies]["count"] = 10_000_000.into();
    let small = ReadOptions::default().with_max_bytes(1 << 28);
    let line = build.read_with(&small).unwrap_err().to_string();
    assert!(line.contains("bytes are needed"), "{line}");
    let text = format!("{{\"asset\": {{\"version\": \"2.0\"}}, \"extras\": [{}0]}}", "{},".repeat(1_000_000));
    let line = decode(text.as_bytes(), None, "", &small).unwrap_err().to_string();
    assert!(line.starts_with("json: "), "{line}");
}

#[test]
fn targets_that_share_an_accessor_are_work_that_is_counted() {
    let mut build = shown();
    build.document["accessors"][0] = json!({"componentType": 5126, "type": "VEC3", "count": 100_000});
    let numbers = build.view(&(0..100_000_u32).flat_map(u32::to_le_bytes).collect::<Vec<_>>());
    let values = build.view(&(0..300_000_u32).flat_map(|n| (n as f32 * 1.7).sin().to_le_bytes()).collect::<Vec<_>>());
    build.document["accessors"][0]["sparse"] = json!({
        "count": 100_000, "indices": {"bufferView": numbers, "componentType": 5125}, "values": {"bufferView": values},
    });
    build.document["meshes"][0]["primitives"][0]["targets"] = vec![json!({"POSITION": 0}); 2000].into();
    build.document["meshes"][0]["weights"] = vec![1.0; 2000].into();
    let line = build.read_with(&ReadOptions::default().with_max_bytes(1 << 30)).unwrap_err().to_string();
    assert!(line.contains("bytes are needed"), "{line}");
}

#[test]
fn places_beyond_floats_are_named() {
    let mut build = shown();
    build.document["nodes"][0]["scale"] = json!([1e200, 1e200, 1e200]);
    let line = build.refused();
    assert!(line.starts_with("meshes[0].primitives[0]: vertex 1 stands at ["), "{line}");
    build.node(json!({"children": [0], "scale": [1e200, 1e200, 1e200]}));
    assert!(build.refused().ends_with("expected a place within the range of floats"));
}

#[test]
fn compressed_meshes_are_shown_by_their_fallback_or_refused() {
    let mut build = shown();
    let draco = json!({"KHR_draco_mesh_compression": {"bufferView": 0, "attributes": {}}});
    build.document["meshes"][0]["primitives"][0]["extensions"] = draco;
    assert_eq!(build.read().unwrap().scene.objects.len(), 1);
    build.document["accessors"][0].as_object_mut().unwrap().remove("bufferView");
    assert!(build.refused().ends_with("no positions but compressed ones, expected positions in a buffer"));
    let mut build = shown();
    build.document["buffers"] = json!([{"byteLength": 36}, {"byteLength": 36}]);
    build.document["bufferViews"][0]["buffer"] = 1.into();
    build.document["bufferViews"][0]["extensions"] = json!({"EXT_meshopt_compression": {"buffer": 0}});
    assert_eq!(
        build.refused(),
        "bufferViews[0].buffer: buffers[1] has no bytes but for EXT_meshopt_compression, which is not supported, \
         expected a buffer with a uri, or the container's"
    );
}

#[test]
fn notes_are_bounded() {
    let mut build = shown();
    build.document["extensionsUsed"] = (0..10_000).map(|number| json!(format!("X_{number}"))).collect();
    let import =
        decode(&container(build.document.to_string().as_bytes(), &build.bytes), None, "", &ReadOptions::default());
    assert!(import.is_err(), "the document names no buffer");
    assert!(build.read().unwrap().notes.len() <= 101);
}
