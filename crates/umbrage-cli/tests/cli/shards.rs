//! Several scenes and frames, on one machine and in shards.

use crate::typed::{files, folder, good, lamps, refused, text};
use std::path::Path;

/// Small pictures.
const SMALL: [&str; 5] = ["--size", "24x18", "--map-size", "32", "-q"];

/// Names and bytes of all pictures of a folder.
fn pictures(folder: &Path) -> Vec<(String, Vec<u8>)> {
    let is_picture = |name: &String| !name.starts_with('.');
    let bytes = |name: String| {
        let bytes = std::fs::read(folder.join(&name)).expect("a picture");
        (name, bytes)
    };
    files(folder).into_iter().filter(is_picture).map(bytes).collect()
}

fn json(out: &str) -> serde_json::Value {
    serde_json::from_str(out).expect("JSON")
}

/// An animation of two frames, a scene for each.
fn shots(folder: &Path) -> String {
    for (frame, scene) in [("0007", "gallery:table"), ("0008", "gallery:contact-box")] {
        good(&["export", scene, "-o", text(&folder.join(format!("shot.{frame}.glb")))]);
    }
    text(&folder.join("shot.####.glb")).to_owned()
}

#[test]
fn several_scenes_are_drawn_as_each_alone() {
    let out = folder("several");
    let (alone, all) = (out.join("alone.png"), format!("{}/", text(&out.join("all"))));
    let scenes = ["gallery:table", "gallery:three-lights"];
    let ran = good(&[&["render"], &scenes[..], &["-o", &all, "--samples", "4", "--json"], &SMALL].concat());
    assert_eq!(files(Path::new(&all)), ["table.png", "three-lights.png"]);
    for (index, scene) in scenes.into_iter().enumerate() {
        good(&[&["render", scene, "-o", text(&alone), "--samples", "4"], &SMALL[..]].concat());
        assert!(std::fs::read(&alone).expect("a file") == pictures(Path::new(&all))[index].1, "{scene}");
    }
    let json = json(&ran.out);
    let ends = |index: usize, name: &str| json["files"][index].as_str().is_some_and(|file| file.ends_with(name));
    assert!(ends(0, "/table.png") && ends(1, "/three-lights.png"), "{json}");
    let named: Vec<&str> =
        json["lights"].as_array().expect("lights").iter().filter_map(|l| l["picture"].as_str()).collect();
    assert_eq!(named, ["table", "three-lights", "three-lights", "three-lights"]);

    let exr = [&["render"], &scenes[..], &["-o", &all, "--samples", "1", "--format", "exr"], &SMALL].concat();
    good(&exr);
    assert_eq!(files(Path::new(&all)), ["table.exr", "table.png", "three-lights.exr", "three-lights.png"]);
}

#[test]
fn a_frame_is_a_key_of_randomness_and_a_number_in_names() {
    let out = folder("frames");
    let noisy = ["--recipe", "woo92", "--light", "red"];
    let args = ["shadow", "gallery:three-lights", "-o", text(&out), "--frames", "9..11"];
    good(&[&args, &noisy[..], &SMALL].concat());
    let drawn = pictures(&out);
    let names: Vec<&str> = drawn.iter().map(|(name, _)| name.as_str()).collect();
    assert_eq!(names, ["three-lights.0009.red.png", "three-lights.0010.red.png", "three-lights.0011.red.png"]);
    assert!(drawn[0].1 != drawn[1].1 && drawn[1].1 != drawn[2].1, "noise differs");
    let one = folder("frames-one");
    good(&[&["shadow", "gallery:three-lights", "-o", text(&one), "--frame", "10"], &noisy[..], &SMALL].concat());
    assert!(pictures(&one)[0].1 == drawn[1].1, "as --frame draws it");
}

#[test]
fn numbers_take_the_place_of_signs_in_scenes() {
    let out = folder("signs");
    let scene = shots(&out);
    let into = out.join("drawn");
    good(&[&["shadow", &scene, "-o", text(&into), "--frames", "7..8"], &SMALL[..]].concat());
    assert_eq!(files(&into), ["shot.0007.png", "shot.0008.png"]);
    for frame in ["7", "8"] {
        let alone = out.join("alone");
        let scene = scene.replace("####", &format!("000{frame}"));
        good(&[&["shadow", &scene, "-o", text(&alone), "--frame", frame], &SMALL[..]].concat());
        let name = format!("shot.000{frame}.png");
        let [one, other] = [&alone, &into].map(|folder| std::fs::read(folder.join(&name)).expect("a picture"));
        assert!(one == other, "{name}");
    }
    // Numbers are as long as the run in the scene's name, and have four digits in the picture's.
    std::fs::copy(out.join("shot.0007.glb"), out.join("7.glb")).expect("a file");
    std::fs::create_dir(out.join("07")).expect("a folder");
    std::fs::copy(out.join("shot.0007.glb"), out.join("07/a.glb")).expect("a file");
    let short = folder("signs-short");
    let [first, second] = ["#.glb", "##/a.glb"].map(|name| out.join(name));
    good(&[&["shadow", text(&first), text(&second), "-o", text(&short), "--frames", "7..7"], &SMALL[..]].concat());
    assert_eq!(files(&short), ["0007.png", "a.0007.png"]);
    let missing = refused(1, &["shadow", &scene, "-o", text(&into), "--frames", "9..9"]);
    assert!(missing.contains("shot.0009.glb"), "{missing}");
    // A run that is longer than a name may be is a file that is not there.
    let long = format!("{}.glb", "#".repeat(70_000));
    assert!(refused(1, &["shadow", &long, "-o", text(&into), "--frames", "1..1"]).contains("0001.glb"));
}

#[test]
fn what_cannot_be_several_pictures_ends_with_two() {
    let out = folder("several-refused");
    let folder_text = format!("{}/", text(&out));
    let error = refused(2, &["render", "gallery:table", "a/table.glb", "-o", &folder_text]);
    assert_eq!(error, "error: scenes gallery:table and a/table.glb are both called table");
    let error = refused(2, &["shadow", "b/shot.glb", "a/Shot.#.glb", "-o", &folder_text, "--frames", "1..1"]);
    assert_eq!(error, "error: scenes b/shot.glb and a/Shot.1.glb are both called Shot.0001");
    let file = text(&out.join("a.png")).to_owned();
    for more in [&["gallery:bust"][..], &["--frames", "1..2"], &["--shard", "1/1"]] {
        let error = refused(2, &[&["render", "gallery:table", "-o", &file], more].concat());
        assert!(error.starts_with(&format!("error: --output {file}: expected a folder")), "{error}");
    }
    let error = refused(2, &["render", "gallery:table", "-o", &file, "--format", "exr"]);
    assert!(error.ends_with("its extension is not that of --format"), "{error}");
    let error = refused(2, &["shadow", "gallery:table", "-o", &folder_text, "--frames", "0..4294967295"]);
    assert!(error.contains("4294967296 scenes and frames are more than 100000"), "{error}");
    for wrong in [
        ["--frames", "2..1"],
        ["--frames", "1"],
        ["--frames", "1..x"],
        ["--shard", "0/2"],
        ["--shard", "3/2"],
        ["--shard", "1"],
    ] {
        let ran = crate::typed::run(&[&["shadow", "gallery:table", "-o", &folder_text], &wrong[..]].concat());
        assert!(ran.code == 2 && ran.err.contains(wrong[1]), "{wrong:?}: {}", ran.err);
    }
    let both = ["shadow", "gallery:table", "-o", &folder_text, "--frames", "1..2", "--frame", "1"];
    assert_eq!(crate::typed::run(&both).code, 2);
    assert_eq!(files(&out), [""; 0], "nothing was written");
}

/// The light of one scene and the name of another may give one name, which is not seen before the scenes are read.
#[test]
fn no_picture_is_written_over_another() {
    let out = folder("one-name");
    let [several, one] = ["x.glb", "x.red.glb"].map(|name| text(&out.join(name)).to_owned());
    good(&["export", "gallery:three-lights", "-o", &several]);
    good(&["export", "gallery:contact-box", "-o", &one]);
    let expected = format!("error: pictures of {several} and of {one} would both be called x.red.png");
    let into = out.join("drawn");
    let args = ["shadow", &several, &one, "-o", text(&into)];
    assert_eq!(refused(2, &[&args[..], &["--shard", "1/9"], &SMALL].concat()), expected);
    assert!(!into.exists(), "shards are refused before anything is drawn");
    assert_eq!(refused(2, &[&args, &SMALL[..]].concat()), expected);
}

/// Every number of shards, in any order, gives the bytes of one machine.
#[test]
fn shards_gathered_are_what_one_machine_draws() {
    let out = folder("shards");
    let scene = shots(&out);
    for (command, samples) in [("shadow", "1"), ("render", "4")] {
        let args = [command, &scene, "gallery:three-lights", "--frames", "7..8", "--recipe", "woo92"];
        let args = [&args[..], &["--samples", samples], &SMALL].concat();
        let whole = format!("{}/", text(&out.join(format!("{command}-whole"))));
        good(&[&args[..], &["-o", &whole]].concat());
        let expected = pictures(Path::new(&whole));
        assert_eq!(expected.len(), if command == "shadow" { 8 } else { 4 });
        for count in [1, 3, 16] {
            let shared = format!("{}/", text(&out.join(format!("{command}-{count}"))));
            for number in (1..=count).rev() {
                good(&[&args[..], &["-o", &shared, "--shard", &format!("{number}/{count}")]].concat());
            }
            assert_eq!(files(Path::new(&shared)), [".parts"], "pictures have no names yet");
            good(&["gather", &shared, "-q"]);
            assert_eq!(files(Path::new(&shared)).len(), expected.len(), "no parts are left");
            assert!(pictures(Path::new(&shared)) == expected, "{command} in {count} shards");
        }
    }
}

#[test]
fn what_is_missing_is_named_and_what_is_there_is_left_alone() {
    let out = folder("resumed");
    let args = ["shadow", "gallery:three-lights", "-o", text(&out), "--frames", "1..2", "--json"];
    let shard = |shard: &str| json(&good(&[&args[..], &["--shard", shard], &SMALL].concat()).out);
    let first = shard("1/2");
    assert_eq!(first["pictures"], serde_json::json!({ "all": 6, "shard": 3, "there": 0 }));
    assert_eq!(first["files"].as_array().map(Vec::len), Some(3));
    let names = ["0001.green", "0002.red", "0002.blue"].map(|name| format!("three-lights.{name}.png"));
    let error = refused(1, &["gather", text(&out)]);
    let missing = format!("{}: 3 of 6 pictures are not drawn yet: ", out.display());
    let found = error.strip_prefix("error: ").and_then(|line| line.strip_prefix(&missing)).expect("what is missing");
    let mut found: Vec<&str> = found.split(", ").collect();
    found.sort_unstable();
    let mut expected = names.each_ref().map(String::as_str);
    expected.sort_unstable();
    assert_eq!(found, expected);
    assert_eq!(files(&out), [".parts"]);

    // A part that is there is not drawn again, whatever it holds.
    let part = first["files"][0].as_str().expect("a part").to_owned();
    std::fs::write(&part, b"drawn before").expect("a file");
    let again = shard("1/2");
    assert_eq!((&again["pictures"]["there"], &again["files"]), (&3.into(), &serde_json::json!([])));
    assert_eq!(std::fs::read(&part).expect("a file"), b"drawn before");
    std::fs::remove_file(&part).expect("a part");
    assert_eq!(shard("1/2")["files"], serde_json::json!([part]));

    // Machines may be fewer for the rest.
    assert_eq!(shard("1/1")["pictures"], serde_json::json!({ "all": 6, "shard": 6, "there": 3 }));
    std::fs::write(out.join("other.png"), b"mine").expect("a file");
    let gathered = json(&good(&["gather", text(&out), "--json", "-q"]).out);
    assert_eq!((gathered["files"].as_array().map(Vec::len), &gathered["there"]), (Some(6), &0.into()));
    assert_eq!(std::fs::read(out.join("other.png")).expect("a file"), b"mine");
    let times =
        || names.each_ref().map(|name| out.join(name).metadata().and_then(|facts| facts.modified()).expect("a time"));
    let before = times();
    let gather = || json(&good(&["gather", text(&out), "--json", "-q"]).out);
    assert_eq!(gather(), serde_json::json!({ "files": [], "there": 0 }), "nothing is left to gather");
    shard("1/1");
    assert_eq!(gather(), serde_json::json!({ "files": [], "there": 6 }));
    assert_eq!(times(), before, "finished pictures are not written again");
}

#[test]
fn shards_of_another_command_line_are_refused_with_what_differs() {
    let out = folder("shards-differ");
    let scene = lamps(&out);
    let into = out.join("drawn");
    let args = ["shadow", text(&scene), "--light", "bulb", "-o", text(&into), "--shard", "1/2"];
    good(&[&args, &SMALL[..]].concat());
    let list = into.join(".parts/manifest.json");
    let before = std::fs::read(&list).expect("a list");
    let refusal = |code: u8, args: &[&str], expected: &str| {
        let error = refused(code, args);
        assert!(error.starts_with(&format!("error: {}: {expected}", list.display())), "{error}");
    };
    let differs = |more: &[&str], expected: &str| refusal(2, &[&args, &SMALL[..], more].concat(), expected);
    differs(&["--seed", "3"], "seed is 0, but 3 here: ");
    differs(&["--frames", "1..2"], "frames is null, but \"1..2\" here: ");
    differs(&["--truth"], "samples is 1, but 64 here: ");
    differs(&["--recipe", "woo92"], "recipe is null, but \"woo92\" here: ");
    let render = ["render", text(&scene), "-o", text(&into), "--shard", "2/2"];
    refusal(2, &[&render, &SMALL[..]].concat(), "command is \"shadow\", but \"render\" here: ");
    // Neither of these changes a picture.
    good(&[&args, &SMALL[..], &["--threads", "1", "--max-memory", "3GiB"]].concat());
    // A file beside the scene is part of it.
    let beside = out.join("lamps.bin");
    let mut bytes = std::fs::read(&beside).expect("a file");
    bytes[0] ^= 1;
    std::fs::write(&beside, &bytes).expect("a file");
    refusal(1, &[&args, &SMALL[..]].concat(), "digest of \"lamps.bulb.png\" is ");
    assert!(std::fs::read(&list).expect("a list") == before, "the list stays");
    assert_eq!(files(&into.join(".parts")).len(), 2, "nothing else was drawn");
}

#[test]
fn lists_that_are_damaged_are_one_line() {
    let out = folder("shards-damaged");
    let error = refused(1, &["gather", text(&out.join("nowhere"))]);
    assert!(error.starts_with(&format!("error: {}: cannot open: ", out.join("nowhere").display())), "{error}");
    assert_eq!(good(&["gather", text(&out)]).err, format!("{}: nothing to gather\n", out.display()));
    std::fs::create_dir(out.join(".parts")).expect("a folder");
    let list = out.join(".parts/manifest.json");
    // Of a removal that was stopped.
    std::fs::write(&list, r#"{"jobs": []}"#).expect("a file");
    good(&["gather", text(&out)]);
    assert_eq!(files(&out), [""; 0]);
    std::fs::create_dir(out.join(".parts")).expect("a folder");
    for (text_of_list, expected) in [
        ("", "EOF while parsing"),
        ("{}", "jobs: expected a list"),
        (r#"{"jobs": [{}]}"#, "jobs[0].picture is null: expected a file's name"),
        (
            r#"{"jobs": [{"picture": "a.png", "part": "../b.png"}]}"#,
            "jobs[0].part is \"../b.png\": expected a file's name",
        ),
    ] {
        std::fs::write(&list, text_of_list).expect("a file");
        let error = refused(1, &["gather", text(&out)]);
        assert!(error.starts_with(&format!("error: {}: {expected}", list.display())), "{error}");
    }
    let args = ["shadow", "gallery:table", "-o", text(&out), "--shard", "1/1"];
    std::fs::write(&list, "[]").expect("a file");
    assert!(refused(2, &[&args, &SMALL[..]].concat()).contains("manifest.json: version is null, but \""));
}
