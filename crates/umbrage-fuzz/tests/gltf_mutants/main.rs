//! Scenes of ours with something broken: each is read, or refused by one line, and none takes more memory than was allowed.

#[path = "../../../umbrage-gltf/tests/gltf/build.rs"]
#[expect(dead_code, reason = "other tests use the rest of it")]
mod build;

use build::{Build, container};
use cap::Cap;
use glam::Vec3;
use serde_json::json;
use umbrage_fuzz::{Mutants, gltf, most_bytes};
use umbrage_gltf::encode;
use umbrage_scene::{Material, Mesh, Object, gallery};

/// Counts what is allocated. It counts for the whole program, which is why all is one test.
#[global_allocator]
static ALLOCATOR: Cap<std::alloc::System> = Cap::new(std::alloc::System, usize::MAX);

fn survives(file: &[u8], count: usize, seed: u32) {
    let before = ALLOCATOR.allocated();
    assert!(gltf(file), "the whole file");
    // Most in the JSON alone, which is then as long as its header says.
    let json = u32::from_le_bytes([file[12], file[13], file[14], file[15]]) as usize;
    let (json, bin) = (&file[20..20 + json], &file[28 + json..]);
    let of_json = Mutants::of(json, seed).take(count - count / 4).map(|json| container(&json, bin));
    let of_all = Mutants::of(file, seed).take(count / 4);
    let read = of_json.chain(of_all).filter(|mutant| gltf(mutant)).count();
    // A mutant's own bytes, its JSON's among them, are not the reader's.
    let most = (ALLOCATOR.max_allocated() - before).saturating_sub(2 * file.len());
    assert!(most as u64 <= most_bytes(file), "{most} bytes are more than {}", most_bytes(file));
    assert!(read > count / 20 && read < count, "{read} of {count} were read");
}

/// A scene of everything that is read, of few triangles.
fn everything() -> Vec<u8> {
    let mut build = Build::new();
    let at = [[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];
    let (positions, normals) = (build.floats(&at), build.floats(&[[0.0, 0.0, 1.0]; 4]));
    let (target, indices) = (build.floats(&[[0.0, 0.5, 0.0]; 4]), build.indices(&[0, 2, 1, 0, 1, 3, 0, 3, 2, 1, 2, 3]));
    let joints = build.accessor(&[0, 1, 0, 0].repeat(4), 5121, "VEC4", 4);
    let weights = build.floats(&[[0.5, 0.5, 0.0, 0.0]; 4]);
    let identity = [1.0, 0.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 0.0, 1.0];
    let binds = build.floats(&[identity; 2]);
    let (numbers, values) = (build.view(&[1, 3]), build.view(&[0; 24]));
    build.document["accessors"][target]["sparse"] = json!({
        "count": 2, "indices": {"bufferView": numbers, "componentType": 5121}, "values": {"bufferView": values},
    });
    let (times, shares) = (build.floats(&[[0.0], [1.0]]), build.floats(&[[0.0], [1.0]]));
    let turns = build.floats(&[[0.0, 0.0, 0.0, 1.0], [0.0, 1.0, 0.0, 0.0]]);
    let spline = build.floats(&[[0.0, 0.5, 0.0]; 6]);
    let copies = build.floats(&[[0.0, 0.0, 3.0], [0.0, 0.0, -3.0]]);
    build.push(
        "materials",
        json!({"alphaMode": "BLEND", "pbrMetallicRoughness": {"baseColorFactor": [0.5, 0.5, 0.5, 0.5]}}),
    );
    build.push(
        "meshes",
        json!({"weights": [0.25], "primitives": [{
            "attributes": {"POSITION": positions, "NORMAL": normals, "JOINTS_0": joints, "WEIGHTS_0": weights},
            "indices": indices, "targets": [{"POSITION": target}], "material": 0,
        }]}),
    );
    build.push(
        "meshes",
        json!({"primitives": [
            {"attributes": {"POSITION": positions}, "mode": 5}, {"attributes": {"POSITION": positions}, "mode": 6},
        ]}),
    );
    build.push("skins", json!({"joints": [1, 2], "inverseBindMatrices": binds}));
    build.node(json!({"mesh": 0, "skin": 0}));
    build.node(json!({"children": [2], "translation": [0, 0, 1]}));
    build.node(json!({"rotation": [0, 0, 0, 1], "scale": [1, -1, 1]}));
    build.node(json!({"mesh": 1, "matrix": identity, "extensions": {"EXT_mesh_gpu_instancing": {"attributes": {"TRANSLATION": copies}}}}));
    build.node(json!({"camera": 0, "translation": [0, 1, 9]}));
    build.push(
        "cameras",
        json!({"type": "orthographic", "orthographic": {"xmag": 4, "ymag": 3, "znear": 1, "zfar": 20}}),
    );
    for light in 0..3 {
        build.node(json!({"translation": [1, 5, 2], "extensions": {"KHR_lights_punctual": {"light": light}}}));
    }
    build.document["nodes"][5]["extras"] =
        json!({"radius": 0.5, "shadow": {"type": "perspective", "near": 1, "far": 20}});
    build.document["extensions"] = json!({"KHR_lights_punctual": {"lights": [
        {"type": "spot", "spot": {"innerConeAngle": 0.25, "outerConeAngle": 0.5}, "intensity": 100},
        {"type": "point", "range": 30}, {"type": "directional", "extras": {"angle": 0.01}},
    ]}});
    build.push(
        "animations",
        json!({
            "samplers": [
                {"input": times, "output": turns}, {"input": times, "output": spline, "interpolation": "CUBICSPLINE"},
                {"input": times, "output": shares, "interpolation": "STEP"},
            ],
            "channels": [
                {"sampler": 0, "target": {"node": 2, "path": "rotation"}},
                {"sampler": 1, "target": {"node": 1, "path": "translation"}},
                {"sampler": 2, "target": {"node": 0, "path": "weights"}},
            ],
        }),
    );
    build.push("scenes", json!({"nodes": [0, 1, 3, 4, 5, 6, 7]}));
    build.glb()
}

#[test]
fn mutants_end_in_a_scene_or_a_line_within_their_memory() {
    survives(&everything(), 20_000, 1);
    survives(&encode(&gallery::table()).unwrap(), 4_000, 2);
    // A hundred thousand triangles are read within what is promised too.
    let ball = Mesh::sphere(Vec3::ZERO, 1.0, 316);
    let mut scene = gallery::table();
    scene.objects.push(Object::solid("ball", ball, Material::matt(Vec3::ONE)));
    survives(&encode(&scene).unwrap(), 30, 3);
}
