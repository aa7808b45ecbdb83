//! Animations at a moment.

use crate::build::{Build, corners, near, notes, triangle};
use serde_json::{Value, json};
use umbrage_gltf::ReadOptions;

/// The triangle, moved by one channel.
fn moving(path: &str, interpolation: &str, times: &[f32], make: impl FnOnce(&mut Build) -> usize) -> Build {
    let mut build = triangle();
    build.node(json!({"mesh": 0, "translation": [0, 0, 9]}));
    let times: Vec<[f32; 1]> = times.iter().map(|time| [*time]).collect();
    let (input, output) = (build.floats(&times), make(&mut build));
    build.push(
        "animations",
        json!({
            "name": "first",
            "samplers": [{"input": input, "output": output, "interpolation": interpolation}],
            "channels": [{"sampler": 0, "target": {"node": 0, "path": path}}],
        }),
    );
    build
}

/// The second corner at a moment.
fn second(build: &Build, time: Option<f64>) -> [f64; 3] {
    corners(&build.read_with(&ReadOptions::default().with_time(time)).unwrap(), 0)[0][1]
}

#[test]
fn without_a_time_nodes_stand_as_the_file_has_them() {
    let build = moving("translation", "LINEAR", &[1.0, 3.0], |build| build.floats(&[[0.0; 3], [4.0, 8.0, 0.0]]));
    assert_eq!(second(&build, None), [1.0, 0.0, 9.0]);
}

#[test]
fn linear_translations_are_clamped_to_their_times() {
    let build = moving("translation", "LINEAR", &[1.0, 3.0], |build| build.floats(&[[0.0; 3], [4.0, 8.0, 0.0]]));
    for (time, expected) in [(-5.0, 0.0), (1.0, 0.0), (1.5, 1.0), (3.0, 4.0), (99.0, 4.0)] {
        near(&second(&build, Some(time)), &[1.0 + expected, 2.0 * expected, 0.0]);
    }
}

#[test]
fn steps_keep_the_last_key_and_scales_apply() {
    let build =
        moving("scale", "STEP", &[0.0, 1.0, 2.0], |build| build.floats(&[[1.0; 3], [2.0, 1.0, 1.0], [3.0, 1.0, 1.0]]));
    for (time, expected) in [(0.99, 1.0), (1.0, 2.0), (1.99, 2.0), (2.0, 3.0)] {
        assert_eq!(second(&build, Some(time)), [expected, 0.0, 9.0]);
    }
}

#[test]
fn rotations_go_the_short_way_round_at_one_speed() {
    let half = std::f32::consts::FRAC_1_SQRT_2;
    // The second quaternion is the negative of a quarter turn about z: the same turn.
    let build = moving("rotation", "LINEAR", &[0.0, 1.0], |build| {
        build.floats(&[[0.0, 0.0, 0.0, 1.0], [0.0, 0.0, -half, -half]])
    });
    let (sin, cos) = 30.0_f64.to_radians().sin_cos();
    near(&second(&build, Some(1.0 / 3.0)), &[cos, sin, 9.0]);
}

#[test]
fn cubic_splines_use_tangents_by_the_second() {
    let build = moving("translation", "CUBICSPLINE", &[0.0, 2.0], |build| {
        let tangent = [3.0, 0.0, 0.0];
        build.floats(&[[0.0; 3], [0.0; 3], tangent, [0.0; 3], [0.0, 8.0, 0.0], [0.0; 3]])
    });
    // At the middle: (h10 · 2 s · 3, half of 8).
    near(&second(&build, Some(1.0)), &[1.0 + 0.125 * 2.0 * 3.0, 4.0, 0.0]);
    near(&second(&build, Some(2.0)), &[1.0, 8.0, 0.0]);
}

#[test]
fn rotations_may_be_normalised_integers() {
    let build = moving("rotation", "STEP", &[0.0], |build| {
        let accessor = build.accessor(&[0, 0, 127, 0], 5120, "VEC4", 1);
        build.document["accessors"][accessor]["normalized"] = true.into();
        accessor
    });
    near(&second(&build, Some(0.0)), &[-1.0, 0.0, 9.0]);
}

/// The triangle with two morph targets: up, and along x.
fn morphing() -> Build {
    let mut build = triangle();
    let (up, along) = (build.floats(&[[0.0, 0.0, 1.0]; 3]), build.floats(&[[2.0, 0.0, 0.0]; 3]));
    build.document["meshes"][0]["primitives"][0]["targets"] = json!([{"POSITION": up}, {"POSITION": along}]);
    build.document["meshes"][0]["weights"] = json!([0.5, 0.0]);
    build.node(json!({"mesh": 0}));
    build
}

#[test]
fn morph_targets_take_the_nodes_weights_else_the_meshs() {
    let mut build = morphing();
    assert_eq!(second(&build, None), [1.0, 0.0, 0.5]);
    build.document["nodes"][0]["weights"] = json!([0.0, 2.0]);
    assert_eq!(second(&build, None), [5.0, 0.0, 0.0]);
}

#[test]
fn weights_are_animated_all_at_once() {
    let mut build = morphing();
    let (input, output) = (build.floats(&[[0.0], [1.0]]), build.floats(&[[0.0], [1.0], [1.0], [0.0]]));
    build.push(
        "animations",
        json!({
            "samplers": [{"input": input, "output": output}],
            "channels": [{"sampler": 0, "target": {"node": 0, "path": "weights"}}],
        }),
    );
    near(&second(&build, Some(0.25)), &[1.0 + 2.0 * 0.75, 0.0, 0.25]);
}

#[test]
fn an_animation_is_found_by_its_name() {
    let mut build = moving("translation", "STEP", &[0.0], |build| build.floats(&[[5.0, 0.0, 0.0]]));
    let output = build.floats(&[[6.0, 0.0, 0.0]]);
    build.push(
        "animations",
        json!({
            "name": "second\n",
            "samplers": [{"input": 1, "output": output}],
            "channels": [{"sampler": 0, "target": {"node": 0, "path": "translation"}},
                         {"sampler": 0, "target": {"path": "pointer"}}],
        }),
    );
    let options = ReadOptions::default().with_time(Some(0.0));
    let at = |name: &str| build.read_with(&options.clone().with_animation(Some(name.into())));
    assert_eq!(corners(&at("first").unwrap(), 0)[0][0], [5.0, 0.0, 0.0]);
    assert_eq!(corners(&at("second\n").unwrap(), 0)[0][0], [6.0, 0.0, 0.0]);
    assert_eq!(at("third").unwrap_err().to_string(), r#"animations: "third", expected one of "first", "second\n""#);
}

#[test]
fn faults_of_samplers_are_named() {
    let mut build = moving("translation", "LINEAR", &[0.0, 1.0], |build| build.floats(&[[0.0; 3]]));
    let line = |build: &Build| build.read_with(&ReadOptions::default().with_time(Some(0.5))).unwrap_err().to_string();
    assert_eq!(
        line(&build),
        "animations[0].samplers[0].output: accessors[2] has 1 elements, expected 2, what its times and targets need"
    );
    let output = build.floats(&[[0.0; 3], [f32::NAN, 0.0, 0.0]]);
    build.document["animations"][0]["samplers"][0]["output"] = output.into();
    assert!(line(&build).starts_with("animations[0].samplers[0].output: [NaN, 0.0, 0.0]"), "{}", line(&build));
    let input = build.floats(&[[f32::NAN], [1.0]]);
    build.document["animations"][0]["samplers"][0]["input"] = input.into();
    assert!(line(&build).ends_with("expected finite times that ascend"), "{}", line(&build));
    build.document["animations"][0]["samplers"][0]["interpolation"] = Value::from("SPLINE");
    assert!(line(&build).ends_with("\"SPLINE\", expected LINEAR, STEP or CUBICSPLINE"), "{}", line(&build));
    // Without a time nobody asks.
    build.read().unwrap();
}

#[test]
fn a_time_without_an_animation_is_noted() {
    let mut build = triangle();
    build.node(json!({"mesh": 0}));
    let import = build.read_with(&ReadOptions::default().with_time(Some(1.0))).unwrap();
    assert!(notes(&import)[0].starts_with("there is no animation"), "{:?}", notes(&import));
}
