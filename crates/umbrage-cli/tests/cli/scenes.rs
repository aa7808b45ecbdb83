//! Scenes of files, read and written.

use crate::typed::{files, folder, good, refused, rms, text, values};

/// A file among the fixtures.
fn fixture(name: &str) -> String {
    format!("{}/../../fixtures/{name}", env!("CARGO_MANIFEST_DIR"))
}

#[test]
fn scenes_of_files_are_shadowed_as_rays_say() {
    for name in ["suzi", "bunny"] {
        let scene = fixture(&format!("scenes/{name}.glb"));
        let (own, truth, soft) = (folder("glb-own"), folder("glb-truth"), folder("glb-soft"));
        good(&["shadow", &scene, "-o", text(&own), "--size", "240x180", "--samples", "16"]);
        good(&["shadow", &scene, "-o", text(&truth), "--size", "240x180", "--truth"]);
        let (own, truth) = (values(&own.join(format!("{name}.png"))), values(&truth.join(format!("{name}.png"))));
        assert!(rms(&own, &truth) < 0.03, "{name}: {}", rms(&own, &truth));
        let ran = good(&["shadow", &scene, "-o", text(&soft), "--area", "--size", "80x60", "--map-size", "64"]);
        assert_eq!(files(&soft), [format!("{name}.area.png")]);
        assert!(ran.err.contains("key: auto,light=0.15, "), "{}", ran.err);
    }
}

/// Skin, bones and a lamp that shines all around, as Blender writes them.
#[test]
fn a_scene_of_blender_bends_in_time() {
    let scene = fixture("scenes/bend.glb");
    let picture = |time: &str, more: &[&str]| {
        let into = folder("bend");
        let fixed = ["shadow", &scene, "-o", text(&into), "--time", time, "--size", "120x90", "--samples", "4"];
        good(&[&fixed[..], more].concat());
        values(&into.join("bend.png"))
    };
    let [before, after] = ["0", "1"].map(|time| {
        let (own, truth) = (picture(time, &["--map-size", "256"]), picture(time, &["--truth"]));
        assert!(rms(&own, &truth) < 0.03, "at {time} s: {}", rms(&own, &truth));
        truth
    });
    assert!(rms(&before, &after) > 0.05, "{}", rms(&before, &after));
}

#[test]
fn what_is_exported_has_the_same_shadow() {
    let out = folder("export");
    for scene in ["contact-box", "spot-room", "three-lights", "table"] {
        let glb = out.join(format!("{scene}.glb"));
        let built_in = format!("gallery:{scene}");
        good(&["export", &built_in, "-o", text(&glb)]);
        let size = ["--size", "120x90", "--map-size", "128", "--format", "png", "-q"];
        let (before, after) = (folder("export-before"), folder("export-after"));
        good(&[&["shadow", &built_in, "-o", text(&before)], &size[..]].concat());
        good(&[&["shadow", text(&glb), "-o", text(&after)], &size[..]].concat());
        assert_eq!(files(&before), files(&after), "{scene}");
        for name in files(&before) {
            let (before, after) = (values(&before.join(&name)), values(&after.join(&name)));
            assert!(rms(&before, &after) < 1e-3, "{name}: {}", rms(&before, &after));
        }
    }
    assert!(refused(2, &["export", "gallery:table", "-o", "table.obj"]).contains("table.obj: expected .glb"));
}

#[test]
fn faults_of_scene_files_are_one_line() {
    let out = folder("bad-scenes");
    let file = out.join("scene.glb");
    let missing = refused(1, &["shadow", text(&file), "-o", text(&out)]);
    assert!(missing.starts_with(&format!("error: {}: ", file.display())), "{missing}");
    std::fs::write(&file, b"glTF\x02\0\0\0\xff\xff\xff\xff").expect("a file");
    let error = refused(1, &["render", text(&file), "-o", "a.png"]);
    assert!(error.starts_with(&format!("error: {}: ", file.display())), "{error}");
    let suzi = fixture("scenes/suzi.glb");
    assert!(refused(1, &["shadow", &suzi, "-o", text(&out), "--camera", "nobody"]).contains("nobody"));
    assert!(refused(1, &["shadow", &suzi, "-o", text(&out), "--max-memory", "1MiB"]).contains(" bytes"));
    assert!(refused(2, &["shadow", "gallery:table", "-o", text(&out), "--time", "1"]).contains("--time"));
    assert!(refused(2, &["shadow", "gallery:table", "-o", text(&out), "--area"]).contains("--area=RADIUS"));
}

/// The README's picture of a file is what the command that stands beside it draws.
#[test]
fn the_readme_shows_what_the_command_draws() {
    let out = folder("readme-picture").join("suzi.png");
    good(&["render", &fixture("scenes/suzi.glb"), "-o", text(&out), "--size", "480x320", "-q"]);
    let (drawn, kept) =
        (std::fs::read(&out).expect("a file"), std::fs::read(fixture("readme/suzi.png")).expect("a file"));
    assert!(drawn == kept, "fixtures/readme/suzi.png is not what is drawn; {} is", out.display());
}

#[test]
fn what_reaches_beyond_a_map_is_named_with_its_light() {
    let folder = folder("beyond");
    // A large floor, under a spot that sees part of it and a lamp whose maps see all around.
    let scene = r#"{"asset": {"version": "2.0"}, "scenes": [{"nodes": [0, 1, 2]}],
        "extensionsUsed": ["KHR_lights_punctual"],
        "extensions": {"KHR_lights_punctual": {"lights": [{"name": "spot", "type": "spot", "spot": {}}, {"name": "bulb", "type": "point"}]}},
        "nodes": [{"name": "floor", "mesh": 0},
            {"rotation": [-0.70710678, 0, 0, 0.70710678], "translation": [0, 9, 0], "extensions": {"KHR_lights_punctual": {"light": 0}}},
            {"translation": [0, 9, 0], "extensions": {"KHR_lights_punctual": {"light": 1}}}],
        "meshes": [{"primitives": [{"attributes": {"POSITION": 0}}]}],
        "accessors": [{"bufferView": 0, "componentType": 5126, "count": 3, "type": "VEC3"}],
        "bufferViews": [{"buffer": 0, "byteLength": 36}],
        "buffers": [{"byteLength": 36, "uri": "data:application/octet-stream;base64,AABIwgAAAAAAAEjCAAAAAAAAAAAAAEhCAABIQgAAAAAAAEjC"}]}"#;
    let path = folder.join("floor.gltf");
    std::fs::write(&path, scene).expect("a file");
    let ran = good(&["bake", text(&path), "--map-size", "16", "-v", "-o", text(&folder.join("maps"))]);
    let said: Vec<&str> = ran.err.lines().filter(|line| line.contains("reaches beyond")).collect();
    assert_eq!(said, ["note: \"floor\" reaches beyond the map of the light \"spot\""]);
}
