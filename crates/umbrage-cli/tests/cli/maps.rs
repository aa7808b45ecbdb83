//! Files of several maps: baked, described, and looked up.

use crate::typed::{files, folder, good, lamps, refused, run_with, text};
use glam::UVec2;
use serde_json::Value;
use std::path::Path;
use umbrage_depth::{DepthMap, Storage};
use umbrage_gltf::ReadOptions;
use umbrage_io::{CUBE_FACES, FACES_AHEAD, MapOptions, decode_png, encode_maps, read_maps};
use umbrage_plane::SurfacePoint;
use umbrage_recipe::{LightUse, Recipe};
use umbrage_render::{Soup, alpha_blend, alpha_test};
use umbrage_sample::Key;

/// Points on the floor, on the wall and between them, with footprints that cross from one face to the next.
fn points() -> (String, Vec<SurfacePoint>) {
    let (mut lines, mut points) = (String::new(), Vec::new());
    for k in 0u32..600 {
        let step = |modulus: u32| f64::from(k * 7919 % modulus) / f64::from(modulus) * 9.6 - 4.8;
        let (a, b, foot) = (step(599), step(211), f64::from(k % 4) * 0.05);
        let (at, normal) = match k % 3 {
            0 => ([a, 0.0, b], [0.0, 1.0, 0.0]),
            1 => ([a, b + 5.0, -5.0], [0.0, 0.0, 1.0]),
            _ => ([a, 2.0 + b, 4.0 - a.abs()], [0.0, 0.6, -0.8]),
        };
        let (u, v) = ([foot, 0.0, 0.0], if k % 3 == 0 { [0.0, 0.0, foot] } else { [0.0, foot, 0.0] });
        let numbers: Vec<String> = [at, normal, u, v].concat().iter().map(|number| format!("{number:?}")).collect();
        lines += &(numbers.join(" ") + "\n");
        let [at, normal, u, v] = [at, normal, u, v].map(glam::DVec3::from_array);
        let (u, v) = (0.5 * u, 0.5 * v);
        let corners = [at - u - v, at + u - v, at + u + v, at - u + v];
        let normal = normal.normalize_or_zero().as_vec3();
        points.push(SurfacePoint { region: k + 1, ..SurfacePoint::at(at, normal).with_corners(corners) });
    }
    (lines, points)
}

/// What the library answers of a light of the scene.
fn by_the_library(scene: &Path, light: usize, points: &[SurfacePoint]) -> Vec<f32> {
    let import = umbrage_gltf::read(scene, &ReadOptions::default().with_map_size(64)).expect("a scene");
    let own = &import.scene.lights[light].view;
    let views = if own.cone().is_some() { std::slice::from_ref(own) } else { &import.lamps[light].views };
    let (test, blend) = (alpha_test(&import.scene), alpha_blend(&import.scene));
    let with = LightUse { storage: Storage::Tiled, ..LightUse::default() };
    let casters = |view: &_, _| Soup::casters(&import.scene, view).into_casting(&test, &blend);
    let shadow = Recipe::default().shadow_of(views, &with, casters).expect("a shadow").shadow;
    let mut fractions = vec![0.0; points.len()];
    shadow.fractions(points, Key::new(0, 0, 0), &mut fractions);
    fractions
}

fn looked_up(input: &str, args: &[&str]) -> Vec<f32> {
    let ran = run_with(input, &[&["lookup"], args, &["-q"]].concat());
    assert_eq!((ran.code, ran.err.as_str()), (0, ""), "{args:?}");
    ran.out.lines().map(|line| line.parse().expect("a number")).collect()
}

#[test]
fn look_ups_through_several_maps_are_those_of_the_library() {
    let out = folder("maps-lamps");
    let scene = lamps(&out);
    let maps = out.join("maps");
    good(&["bake", text(&scene), "-o", text(&maps), "--map-size", "64", "-q"]);
    assert_eq!(files(&maps), ["lamps.bulb.exr", "lamps.wide.exr"]);
    good(&["bake", text(&scene), "-o", text(&maps), "--map-size", "64", "--one-file", "-q"]);
    assert_eq!(files(&maps), ["lamps.bulb.exr", "lamps.exr", "lamps.wide.exr"]);
    let all = maps.join("lamps.exr");
    let (input, points) = points();
    for (light, name, faces) in [(0, "bulb", &CUBE_FACES[..]), (1, "wide", &FACES_AHEAD[..])] {
        let own = maps.join(format!("lamps.{name}.exr"));
        let read = read_maps(&own, &MapOptions::default()).expect("maps");
        let names: Vec<String> = faces.iter().map(|face| format!("{name}.{face}")).collect();
        assert!(read.maps.iter().map(|named| &named.name).eq(&names), "{name}");
        let found = looked_up(&input, &[text(&own)]);
        assert_eq!(found, looked_up(&input, &[text(&all), "--part", name]), "{name}");
        // Nine digits are what a fraction is printed with.
        let expected = by_the_library(&scene, light, &points);
        let printed: Vec<f32> = expected.iter().map(|f| format!("{f:.9}").parse().expect("a number")).collect();
        assert_eq!(found, printed, "{name}");
        let kinds = [0.0..=0.0f32, 1.0..=1.0, 1e-6..=0.999_999];
        let kinds = kinds.map(|kind| expected.iter().filter(|fraction| kind.contains(*fraction)).count());
        assert!(kinds.iter().all(|count| *count > 0), "{name}: {kinds:?} lit, dark and between");
    }
    let several = refused(2, &["lookup", text(&all), "-q"]);
    assert!(several.ends_with("there are maps of several lights, --part NAME chooses one: bulb, wide"), "{several}");
    let unknown = refused(1, &["lookup", text(&all), "--part", "lamp", "-q"]);
    assert!(unknown.contains("part is lamp: the file has bulb.+x, bulb.-x, "), "{unknown}");
    assert_eq!(looked_up("0 0 0 0 1 0\n", &[text(&all), "--part", "bulb.-y"]), [1.0]);
    // Five of six do not see everything.
    let mut five = read_maps(&maps.join("lamps.bulb.exr"), &MapOptions::default()).expect("maps").maps;
    five.remove(2);
    let path = out.join("five.exr");
    std::fs::write(&path, encode_maps(&five).expect("a file")).expect("written");
    let missing = refused(1, &["lookup", text(&path), "-q"]);
    assert!(missing.ends_with("part bulb.+y is missing: light bulb has 6 maps"), "{missing}");
}

#[test]
fn maps_of_every_rule_stand_around_a_lamp() {
    let out = folder("maps-rules");
    let scene = lamps(&out);
    for rule in ["first", "midpoint", "deep"] {
        good(&["bake", text(&scene), "-o", text(&out), "--map-size", "128", "--rule", rule, "--light", "bulb", "-q"]);
        // Under the board, and beside its shadow.
        let found = looked_up("0 0 0 0 1 0\n-3.5 0 3 0 1 0\n", &[text(&out.join("lamps.bulb.exr"))]);
        assert_eq!(found, [1.0, 0.0], "{rule}");
    }
}

#[test]
fn every_part_is_described_and_drawn() {
    let out = folder("maps-info");
    good(&["bake", "gallery:three-lights", "-o", text(&out), "--map-size", "48", "--one-file", "-q"]);
    assert_eq!(files(&out), ["three-lights.exr"]);
    let (map, picture) = (out.join("three-lights.exr"), out.join("depths.png"));
    let ran = good(&["info", text(&map), "--picture", text(&picture)]);
    for part in ["red", "green", "blue"] {
        assert!(
            ran.out.contains(&format!("part      {part}\nsize      48 x 48 texels\nkeeps     facets, ")),
            "{}",
            ran.out
        );
    }
    assert_eq!(decode_png(&std::fs::read(&picture).expect("a file")).expect("a picture").size, UVec2::new(144, 48));
    let json: Value = serde_json::from_str(&good(&["info", text(&map), "--json"]).out).expect("JSON");
    assert_eq!(json["parts"].as_array().map(Vec::len), Some(3));
    let one: Value = serde_json::from_str(&good(&["info", text(&map), "--json", "--part", "red"]).out).expect("JSON");
    assert_eq!((&one["part"], &one["size"]), (&Value::from("red"), &serde_json::json!([48, 48])));
}

/// A file of ours with what only Umbrage writes misspelt, and no view that any tool understands.
fn foreign(folder: &Path) -> (std::path::PathBuf, String) {
    let eye = glam::DVec3::new(0.0, 10.0, 0.0);
    let view =
        umbrage_plane::View::perspective(eye, glam::DVec3::ZERO, glam::DVec3::NEG_Z, 1.0, 1.0, 20.0, UVec2::splat(32));
    let map = umbrage_depth::Raw::new(view.expect("a view"), vec![5.0; 1024]).expect("depths");
    let mut bytes = umbrage_io::encode_shadow_map(&map).expect("a file");
    let position = |bytes: &[u8], mark: &str| {
        bytes.windows(mark.len()).position(|window| window == mark.as_bytes()).expect("a mark of our own")
    };
    for mark in ["umbrage view", "digest=", "worldToCamera\0", "worldToNDC\0"] {
        let at = position(&bytes, mark);
        bytes[at] = b'x';
    }
    let software = position(&bytes, "software\0string\0") + "software\0string\0".len() + 4;
    bytes[software] = b'x';
    let path = folder.join("foreign.exr");
    std::fs::write(&path, bytes).expect("written");
    let flipped = glam::DMat4::from_scale(glam::DVec3::new(1.0, 1.0, -1.0)) * map.view().world_to_eye();
    let (camera, screen) = (flipped.to_cols_array(), map.view().world_to_screen().to_cols_array());
    let json = serde_json::json!({"worldtocamera": camera, "worldtoscreen": screen, "near": 1, "far": 20});
    (path, json.to_string())
}

#[test]
fn a_view_is_given_to_files_that_have_none() {
    let out = folder("maps-foreign");
    let (map, view) = foreign(&out);
    let missing = refused(1, &["lookup", text(&map), "-q"]);
    assert!(missing.ends_with("worldToCamera is missing: a shadow map needs it, or a view that is given"), "{missing}");
    let file = out.join("view.json");
    std::fs::write(&file, &view).expect("a file");
    for given in [view.as_str(), text(&file)] {
        // Half a unit behind what is stored, and half before it.
        let args = [text(&map), "--view", given, "--recipe", "reeves87,bias=0.01w"];
        assert_eq!(looked_up("0 4.5 0 0 1 0\n0 5.5 0 0 1 0\n", &args), [1.0, 0.0]);
    }
    let told = good(&["info", text(&map), "--view", &view]).out;
    assert!(told.contains("light     at 0 10 0\n") || told.contains("light     at -0 10 -0\n"), "{told}");
    for (given, problem) in [
        ("{", "--view: not JSON: "),
        ("{}", "--view: worldtocamera: expected an array of 16 numbers"),
        (r#"{"fov": 1}"#, "--view: \"fov\" is not known: expected worldtocamera, "),
        (&view.replace("\"far\":20", "\"far\":20,\"depth\":\"deep\""), "depth is \"deep\": expected axial"),
        (&view.replace("\"near\":1", "\"near\":\"1\""), "--view: near is \"1\": expected a number"),
    ] {
        let line = refused(2, &["info", text(&map), "--view", given]);
        assert!(line.contains(problem), "{line}");
    }
    let channel = refused(1, &["info", text(&map), "--channel", "depth", "--view", &view]);
    assert!(channel.contains("channels is Z: no channel depth among them"), "{channel}");
    good(&["bake", "gallery:contact-box", "-o", text(&out), "--map-size", "32", "-q"]);
    let ours = refused(1, &["info", text(&out.join("contact-box.exr")), "--view", &view]);
    assert!(ours.ends_with("view is given: a map that Umbrage wrote has its own"), "{ours}");
}

#[test]
fn maps_that_do_not_fit_in_memory_are_baked_in_bands_to_the_same_depths() {
    let (whole, bands) = (folder("fits"), folder("bands"));
    let scene = ["bake", "gallery:contact-box", "--map-size", "1200"];
    for rule in ["first", "second", "back-face", "midpoint"] {
        let with =
            |folder: &Path, more: &[&str]| good(&[&scene[..], &["--rule", rule, "-o", text(folder)], more].concat());
        with(&whole, &[]);
        let ran = with(&bands, &["--max-memory", "140MiB"]);
        assert!(ran.err.contains("1200 x 1200 texels do not fit in memory: baked in "), "{}", ran.err);
        let read = |folder: &Path| umbrage_io::read_shadow_map(&folder.join("contact-box.exr")).expect("a map");
        assert!(read(&whole) == read(&bands), "{rule}");
    }
    // What keeps more than a depth, or goes into a file with others, is held as a whole.
    let out = text(&bands).to_owned();
    for more in [&["--rule", "facets"][..], &["--rule", "first", "--one-file"]] {
        let ran = run_with("", &[&scene[..], &["-o", &out, "--max-memory", "140MiB"], more].concat());
        assert_eq!((ran.code, ran.err.contains("more than --max-memory 140 MiB")), (1, true), "{}", ran.err);
    }
}
