//! Files of our own with something broken: each is read, or refused by one line, and none takes more memory than was allowed.

#[path = "../gltf/build.rs"]
#[expect(dead_code, reason = "other tests use the rest of it")]
mod build;

use build::Build;
use cap::Cap;
use glam::Vec3;
use serde_json::json;
use umbrage_gltf::{ReadOptions, decode, encode};
use umbrage_plane::mix32;
use umbrage_scene::{Material, Mesh, Object, gallery};

/// Counts what is allocated. It counts for the whole program, which is why all is one test.
#[global_allocator]
static ALLOCATOR: Cap<std::alloc::System> = Cap::new(std::alloc::System, usize::MAX);

/// A stream of numbers.
struct Dice(u32);

impl Dice {
    fn below(&mut self, most: usize) -> usize {
        self.0 = self.0.wrapping_add(0x9E37_79B9);
        mix32(self.0) as usize % most.max(1)
    }
}

/// What takes the place of numbers in the JSON.
const NUMBERS: [&str; 16] = [
    "0",
    "1",
    "2",
    "7",
    "-1",
    "0.5",
    "255",
    "65536",
    "4294967295",
    "4294967296",
    "18446744073709551615",
    "1e38",
    "-1e300",
    "1e-300",
    "null",
    "5126",
];

/// Where numbers stand in the bytes, each with where it ends.
fn numbers(bytes: &[u8]) -> Vec<(usize, usize)> {
    let part = |byte: &u8| byte.is_ascii_digit() || matches!(byte, b'-' | b'.' | b'e' | b'E' | b'+');
    let mut found = Vec::new();
    let mut at = 0;
    while at < bytes.len() {
        let end = at + bytes[at..].iter().take_while(|byte| part(byte)).count();
        if end > at && matches!(bytes[at - 1], b':' | b',' | b'[') {
            found.push((at, end));
        }
        at = end + 1;
    }
    found
}

/// One of many files near a file, and what was done to it.
fn mutant(file: &[u8], json: usize, places: &[(usize, usize)], dice: &mut Dice) -> Vec<u8> {
    let mut bytes = file.to_vec();
    match dice.below(8) {
        0 => bytes.truncate(dice.below(file.len())),
        1 | 2 => {
            for _ in 0..=dice.below(4) {
                let at = dice.below(file.len());
                bytes[at] ^= 1 << dice.below(8);
            }
        }
        3 => {
            for _ in 0..=dice.below(3) {
                bytes[20 + dice.below(json)] = b"0123456789{}[],:\"-.e "[dice.below(21)];
            }
        }
        _ => {
            // From the back, so that the places before stay where they are.
            let mut chosen: Vec<usize> = (0..=dice.below(3)).map(|_| dice.below(places.len())).collect();
            chosen.sort_unstable();
            chosen.dedup();
            let before = bytes.len();
            for place in chosen.into_iter().rev() {
                let (from, to) = places[place];
                bytes.splice(from..to, NUMBERS[dice.below(NUMBERS.len())].bytes());
            }
            let grown = |at: usize| u32::from_le_bytes([file[at], file[at + 1], file[at + 2], file[at + 3]]);
            for at in [8, 12] {
                let length = (grown(at) as usize + bytes.len() - before) as u32;
                bytes[at..at + 4].copy_from_slice(&length.to_le_bytes());
            }
        }
    }
    bytes
}

fn survives(file: &[u8], count: u32, seed: u32) {
    let json = u32::from_le_bytes([file[12], file[13], file[14], file[15]]) as usize;
    let places = numbers(&file[..20 + json]);
    let options = ReadOptions::default().with_max_bytes((64 << 20) + 8 * file.len() as u64).with_time(Some(0.4));
    let before = ALLOCATOR.allocated();
    let whole = decode(file, None, "whole", &options).unwrap();
    assert!(!whole.scene.objects.is_empty());
    drop(whole);
    let (mut read, mut dice) = (0, Dice(seed));
    for _ in 0..count {
        match decode(&mutant(file, json, &places, &mut dice), None, "mutant", &options) {
            Ok(import) => {
                read += 1;
                for object in &import.scene.objects {
                    let umbrage_scene::Shape::Mesh(mesh) = &object.shape else { panic!("no patches are read") };
                    mesh.check().unwrap();
                }
                assert_eq!(import.lamps.len(), import.scene.lights.len());
            }
            Err(error) => {
                let line = error.to_string();
                assert!(!line.is_empty() && line.len() < 1000 && !line.contains('\n'), "{line:?}");
            }
        }
    }
    // A mutant's own bytes are not the reader's.
    let most = ALLOCATOR.max_allocated() - before.min(ALLOCATOR.max_allocated()) - file.len();
    assert!(most as u64 <= options.max_bytes, "{most} bytes are more than {}", options.max_bytes);
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
