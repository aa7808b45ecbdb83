//! Every command as a user would type it.

use crate::typed::{facets, files, folder, good, refused, run, run_with, text, values};
use std::io::{self, Write};
use std::path::Path;
use umbrage_io::{decode_png, read_map};

#[test]
fn shadows_are_what_rays_say() {
    for (scene, name) in [("gallery:contact-box", "contact-box.png"), ("gallery:spot-room", "spot-room.png")] {
        let (own, truth) = (folder("shadow-own"), folder("shadow-truth"));
        good(&["shadow", scene, "-o", text(&own), "--size", "160x120", "--map-size", "256", "--samples", "16"]);
        good(&["shadow", scene, "-o", text(&truth), "--size", "160x120", "--truth"]);
        let (own, truth) = (values(&own.join(name)), values(&truth.join(name)));
        let squares: f64 = own.iter().zip(&truth).map(|(a, b)| (a - b).powi(2)).sum();
        let rms = (squares / own.len() as f64).sqrt();
        assert!(rms < 0.03, "{scene}: {rms}");
        assert!(truth.contains(&1.0) && truth.contains(&0.0), "{scene}: both are seen");
    }
}

#[test]
fn what_turns_away_from_the_light_is_dark_and_nothing_is_lit() {
    let out = folder("shadow-turned");
    good(&["shadow", "gallery:spot-room", "-o", text(&out), "--size", "64x48", "--format", "exr"]);
    assert_eq!(files(&out), ["spot-room.exr"]);
    // A recipe that lights everything still leaves the side of each thing that is turned away dark.
    let lit = "reeves87,bias=1000000w";
    good(&["shadow", "gallery:spot-room", "-o", text(&out), "--size", "64x48", "--recipe", lit]);
    let found = values(&out.join("spot-room.png"));
    let dark = found.iter().filter(|fraction| **fraction == 1.0).count();
    assert!(dark > 50 && dark < found.len() / 2, "{dark} of {} pixels", found.len());
}

#[test]
fn each_light_has_its_file() {
    let out = folder("shadow-lights");
    let ran =
        good(&["shadow", "gallery:three-lights", "-o", text(&out), "--size", "40x30", "--map-size", "64", "--json"]);
    assert_eq!(files(&out), ["three-lights.blue.png", "three-lights.green.png", "three-lights.red.png"]);
    let json: serde_json::Value = serde_json::from_str(&ran.out).expect("JSON");
    assert_eq!(json["files"].as_array().map(Vec::len), Some(3));
    assert_eq!(json["lights"][0]["recipe"], "auto");
    assert!(json["lights"][2]["bytes"].as_u64().is_some_and(|bytes| bytes > 100));
    assert!(ran.err.lines().last().is_some_and(|line| line.contains("bytes, baked in")), "{}", ran.err);

    let one = folder("shadow-one-light");
    good(&["shadow", "gallery:three-lights", "-o", text(&one), "--size", "40x30", "--light", "red", "-q"]);
    assert_eq!(files(&one), ["three-lights.red.png"]);
    let error = refused(2, &["shadow", "gallery:three-lights", "-o", text(&one), "--light", "mauve"]);
    assert!(error.starts_with("error: --light \"mauve\": the lights that cast shadows are "), "{error}");
}

#[test]
fn pictures_have_the_size_that_is_asked_for() {
    let out = folder("render");
    for (name, size) in [("a.png", (96, 64)), ("b.png", (33, 77))] {
        let path = out.join(name);
        let size_text = format!("{}x{}", size.0, size.1);
        good(&["render", "gallery:contact-box", "-o", text(&path), "--size", &size_text, "--samples", "4"]);
        let codes = decode_png(&std::fs::read(&path).expect("a file")).expect("a picture");
        assert_eq!((codes.size.x, codes.size.y), size);
    }
    let exr = out.join("c.exr");
    good(&["render", "gallery:table", "-o", text(&exr), "--size", "32x32", "--recipe", "woo92", "--samples", "1"]);
    assert!(std::fs::read(exr).expect("a file").starts_with(&[0x76, 0x2f, 0x31, 0x01]));
}

#[test]
fn seeds_and_frames_are_keys_of_randomness() {
    let out = folder("seeds");
    let drawn = |more: &[&str]| {
        let path = out.join("a.png");
        let mut args = vec!["render", "gallery:contact-box", "-o", text(&path), "--size", "48x48", "--recipe", "woo92"];
        args.extend(more);
        good(&args);
        std::fs::read(&path).expect("a file")
    };
    assert_eq!(drawn(&[]), drawn(&["--seed", "0", "--frame", "0"]));
    assert_ne!(drawn(&[]), drawn(&["--seed", "1"]));
    assert_ne!(drawn(&[]), drawn(&["--frame", "1"]));
}

#[test]
fn maps_are_baked_described_and_looked_up() {
    for (rule, keeps, recipe) in [
        ("facets", "facets, ", "recipe: auto (the map holds facets)"),
        ("first", "first surface", "recipe: reeves87 (the map holds first surfaces)"),
        ("second", "second surface", "recipe: wang-molnar94 (the map holds second surfaces)"),
        ("midpoint", "midpoint surface", "recipe: woo92 (the map holds midpoints)"),
        ("back-face", "back-face surface", "recipe: wang-molnar94 (the map holds second surfaces)"),
        ("deep", "all surfaces", "recipe: reeves87,stored=deep (the map holds all surfaces)"),
    ] {
        let out = folder(&format!("bake-{rule}"));
        good(&["bake", "gallery:contact-box", "-o", text(&out), "--rule", rule, "--map-size", "96"]);
        assert_eq!(files(&out), ["contact-box.exr"], "{rule}");
        let map = out.join("contact-box.exr");
        let told = good(&["info", text(&map)]).out;
        assert!(told.contains("size      96 x 96 texels\n"), "{told}");
        assert!(told.contains(&format!("keeps     {keeps}")), "{rule}: {told}");
        assert!(told.contains("\nlight     "), "{rule}: {told}");
        // Behind the box it is dark, beside its shadow lit.
        let asked = run_with("60 0 0 0 1 0\n150,0,150,0,1,0\n", &["lookup", text(&map)]);
        assert_eq!((asked.code, asked.err.trim_end()), (0, recipe), "{rule}");
        assert_eq!(asked.out, "1.000000000\n0.000000000\n", "{rule}");
    }
}

#[test]
fn a_box_of_texels_is_the_same_map() {
    let (raw, bbox) = (folder("bake-raw"), folder("bake-bbox"));
    let bake = |out: &Path, storage: &str| {
        good(&["bake", "gallery:contact-box", "-o", text(out), "--rule", "second", "--storage", storage, "-q"]);
        out.join("contact-box.exr")
    };
    let (raw, bbox) = (bake(&raw, "raw"), bake(&bbox, "bbox"));
    let depths = |path: &Path| umbrage_depth::Raw::copy_of(&read_map(path, 1 << 20).expect("a map")).depths().to_vec();
    assert_eq!(depths(&raw), depths(&bbox));
    let bytes = |path: &Path| std::fs::metadata(path).expect("a file").len();
    assert!(bytes(&bbox) <= bytes(&raw));
}

#[test]
fn a_map_is_drawn_and_described_as_json() {
    let out = folder("info");
    good(&["bake", "gallery:table", "-o", text(&out), "--map-size", "64", "-q"]);
    let picture = out.join("depths.png");
    let map = out.join("table.exr");
    let ran = good(&["info", text(&map), "--picture", text(&picture), "--json"]);
    let json: serde_json::Value = serde_json::from_str(&ran.out).expect("JSON");
    assert_eq!(json["size"], serde_json::json!([64, 64]));
    assert!(json["bytes"]["raw"].as_u64() > json["bytes"]["bbox"].as_u64());
    assert_eq!(decode_png(&std::fs::read(picture).expect("a file")).expect("a picture").size.x, 64);
}

#[test]
fn what_cannot_be_read_is_one_line() {
    let out = folder("bad-maps");
    let map = out.join("not.exr");
    let missing = refused(1, &["info", text(&map)]);
    assert!(missing.starts_with(&format!("error: {}: cannot open", map.display())), "{missing}");
    std::fs::write(&map, b"no picture at all").expect("a file");
    assert!(refused(1, &["info", text(&map)]).starts_with(&format!("error: {}: ", map.display())));
    assert!(refused(1, &["lookup", text(&map)]).starts_with(&format!("error: {}: ", map.display())));
    let good_map = facets("bad-recipes");
    let error = refused(1, &["lookup", text(&good_map), "--recipe", "woo92", "-q"]);
    assert!(error.contains("map = \"first\": expected midpoint"), "{error}");
}

#[test]
fn command_lines_that_make_no_sense_end_with_two() {
    let out = folder("usage");
    assert!(refused(2, &["shadow", "gallery:nowhere", "-o", text(&out)]).contains("gallery:nowhere is not known"));
    assert!(refused(2, &["shadow", "scene.obj", "-o", text(&out)]).contains("\"scene.obj\""));
    assert!(refused(2, &["render", "gallery:table", "-o", "table.jpg"]).contains("table.jpg: expected .png or .exr"));
    let error = refused(2, &["shadow", "gallery:table", "-o", text(&out), "--recipe", "woo92,samples=0"]);
    assert_eq!(error, "error: --recipe: samples = \"0\": expected a whole number from 1 to 65536");
    assert!(refused(2, &["recipes", "nobody"]).contains("expected one of auto, "));
    for args in [&["shadow"][..], &["draw"], &["render", "gallery:table", "-o", "a.png", "--samples", "5"]] {
        assert_eq!(run(args).code, 2, "{args:?}");
    }
    assert_eq!(files(&out), [""; 0], "nothing was written");
}

#[test]
fn recipes_come_from_files_too() {
    let out = folder("recipes");
    let file = out.join("mine.toml");
    std::fs::write(&file, "preset = \"reeves87\"\nsamples = 4\n").expect("a file");
    let shadow = |recipe: &str| {
        good(&["shadow", "gallery:contact-box", "-o", text(&out), "--size", "48x48", "--recipe", recipe, "-q"]);
        std::fs::read(out.join("contact-box.png")).expect("a file")
    };
    assert_eq!(shadow(text(&file)), shadow("reeves87,samples=4"));
    assert_eq!(shadow("rsl,samples=4,blur=0.01"), shadow("reeves87,samples=4,res-factor=1,min-size=2.56"));
    std::fs::write(&file, "preset = \"reeves87\"\nsamples = \"many\"\n").expect("a file");
    let error = refused(1, &["shadow", "gallery:table", "-o", text(&out), "--recipe", text(&file)]);
    assert!(error.contains("mine.toml: samples = \"many\": expected a whole number"), "{error}");
}

#[test]
fn memory_is_asked_for_before_it_is_taken() {
    let out = folder("memory");
    let args = ["shadow", "gallery:table", "-o", text(&out), "--map-size", "16384", "--max-memory", "100MiB"];
    let error = refused(1, &args);
    assert!(error.starts_with("error: memory: ") && error.ends_with("more than --max-memory 100 MiB"), "{error}");
    let args = ["render", "gallery:table", "-o", "a.png", "--size", "16384x16384"];
    assert!(refused(1, &args).contains("more than --max-memory"));
    assert_eq!(run(&["scenes", "--max-memory", "much"]).code, 2);
}

#[test]
fn lists_are_complete() {
    let scenes = good(&["scenes"]).out;
    assert!(scenes.lines().any(|line| line == "gallery:spot-room") && scenes.lines().count() > 50);
    let recipes = good(&["recipes"]).out;
    assert!(recipes.starts_with("auto "), "{recipes}");
    // Engines stand under a heading of their own.
    let (papers, engines) = recipes.split_once("\n\nEngines' defaults").expect("a heading");
    assert_eq!((papers.lines().count(), engines.lines().count()), (14, 1 + 12), "{recipes}");
    assert!(engines.lines().nth(1).is_some_and(|line| line.starts_with("three-pcf ")), "{recipes}");
    let woo = good(&["recipes", "woo92"]).out;
    assert!(woo.contains("samples= [16]: a whole number from 1 to 65536"), "{woo}");
    let urp = good(&["recipes", "urp-hard"]).out;
    assert!(
        urp.contains("\ndepth bias= [1]: a finite number (texels times the filter's radius, along the ray); "),
        "{urp}"
    );
    let json: serde_json::Value = serde_json::from_str(&good(&["recipes", "--json"]).out).expect("JSON");
    assert_eq!((&json[0]["name"], &json[0]["engine"]), (&"auto".into(), &serde_json::Value::Null));
    assert_eq!((&json[14]["name"], &json[14]["engine"]), (&"three-pcf".into(), &"three".into()));
    assert_eq!(
        (&json[14]["settings"][1]["name"], &json[0]["settings"]),
        (&"normalBias".into(), &serde_json::json!([]))
    );
    assert!(good(&["help"]).out.contains("Usage: umbrage"));
    assert!(good(&["--version"]).out.starts_with("umbrage "));
}

#[test]
fn pages_and_completions_are_written() {
    let out = folder("generate");
    good(&["generate", "man", text(&out)]);
    good(&["generate", "completions", text(&out)]);
    let names = files(&out);
    for name in [
        "umbrage.1",
        "umbrage-shadow.1",
        "umbrage-lookup.1",
        "umbrage-gather.1",
        "umbrage-jobs.1",
        "umbrage.bash",
        "_umbrage",
        "umbrage.fish",
    ] {
        assert!(names.iter().any(|known| known == name), "{name} is not among {names:?}");
    }
    assert!(!names.iter().any(|name| name.contains("generate")));
}

/// A reader that has gone away.
struct Gone;

impl Write for Gone {
    fn write(&mut self, _: &[u8]) -> io::Result<usize> {
        Err(io::ErrorKind::BrokenPipe.into())
    }

    fn flush(&mut self) -> io::Result<()> {
        Err(io::ErrorKind::BrokenPipe.into())
    }
}

/// A disk without room.
struct Full;

impl Write for Full {
    fn write(&mut self, _: &[u8]) -> io::Result<usize> {
        Err(io::ErrorKind::StorageFull.into())
    }

    fn flush(&mut self) -> io::Result<()> {
        Ok(())
    }
}

#[test]
fn a_reader_that_goes_away_is_no_failure_but_a_full_disk_is() {
    let map = facets("gone");
    for args in [&["scenes"][..], &["recipes"], &["recipes", "woo92"], &["info", text(&map)], &["lookup", text(&map)]] {
        let run = |out: &mut dyn Write| {
            let args = std::iter::once("umbrage").chain(args.iter().copied()).map(Into::into);
            let (mut input, mut err) = ("0 0 0 0 1 0\n".as_bytes(), Vec::new());
            (umbrage_cli::run(args, &mut input, out, &mut err, false), String::from_utf8(err).expect("text"))
        };
        assert_eq!(run(&mut Gone).0, 0, "{args:?}");
        let (code, err) = run(&mut Full);
        assert_eq!(code, 1, "{args:?}");
        assert_eq!(err.lines().filter(|line| line.starts_with("error: ")).count(), 1, "{err}");
    }
}

#[test]
fn folders_that_cannot_be_made_are_named() {
    let out = folder("taken");
    let file = out.join("file");
    std::fs::write(&file, b"in the way").expect("a file");
    let error = refused(1, &["shadow", "gallery:table", "-o", text(&file), "--size", "16x16", "--map-size", "16"]);
    assert!(error.starts_with(&format!("error: {}: cannot create", file.display())), "{error}");
    let inside = file.join("a.png");
    let error =
        refused(1, &["render", "gallery:table", "-o", text(&inside), "--size", "16x16", "--map-size", "16", "-q"]);
    assert!(error.starts_with(&format!("error: {}: cannot ", inside.display())), "{error}");
}

#[test]
fn errors_are_coloured_where_that_is_wanted() {
    let plain = refused(1, &["info", "nowhere.exr"]);
    assert_eq!(plain, "error: nowhere.exr: cannot open: No such file or directory (os error 2)");
    for colour in [&["--color", "always"][..], &["--color=always"]] {
        let coloured = refused(1, &[&["info", "nowhere.exr"], colour].concat());
        assert_eq!(coloured, plain.replacen("error:", "\u{1b}[1;31merror:\u{1b}[0m", 1));
    }
    let usage = |colour: &str| run(&["info", "--color", colour]).err;
    assert!(usage("always").contains("\u{1b}[") && !usage("never").contains("\u{1b}["), "{}", usage("always"));
    assert!(usage("pink").contains("pink"));
}
