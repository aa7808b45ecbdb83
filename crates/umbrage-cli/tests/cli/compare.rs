//! Recipes and images of one's own beside ray-traced truth.

use crate::typed::{folder, good, refused, run, text};
use serde_json::Value;
use std::path::{Path, PathBuf};
use umbrage_recipe::PresetName;

fn report(args: &[&str]) -> Value {
    let args: Vec<&str> = ["compare"].iter().chain(args).copied().chain(["--json"]).collect();
    serde_json::from_str(&good(&args).out).expect("JSON")
}

fn number(row: &Value, name: &str) -> f64 {
    row[name].as_f64().unwrap_or_else(|| panic!("{name} in {row}"))
}

/// Truth as `umbrage shadow --truth` writes it.
fn truth(name: &str, args: &[&str], file: &str) -> PathBuf {
    let out = folder(name);
    good(&[&["shadow", "--truth", "-q", "-o", text(&out)], args].concat());
    out.join(file)
}

#[test]
fn every_recipe_at_every_map_size_is_a_row_of_one_table() {
    let args = ["gallery:contact-box", "--size", "48x36", "--samples", "4", "--map-size", "64", "128"];
    let chosen = [&args[..], &["--recipe", "auto", "reeves87,bias=0"]].concat();
    let table = good(&[&["compare"], &chosen[..]].concat()).out;
    let lines: Vec<&str> = table.lines().collect();
    assert_eq!(lines.len(), 5, "{table}");
    let words = ["recipe", "map size", "rms", "false shadow %", "false light %", "acne %", "detachment %", "leak %"];
    let mut from = 0;
    for word in words.iter().chain(&["bytes", "bake ms", "ns per look-up"]) {
        from += lines[0][from..].find(word).unwrap_or_else(|| panic!("{word} in {table}"));
    }
    assert!(lines[1].starts_with("auto  ") && lines[4].starts_with("reeves87,bias=0  "), "{table}");
    let ends: Vec<usize> = lines.iter().map(|line| line.chars().count()).collect();
    assert!(ends.iter().all(|end| *end == ends[0]), "columns of numbers end at one place: {table}");

    let json = report(&chosen);
    assert_eq!((&json["size"], &json["samples"]), (&serde_json::json!([48, 36]), &serde_json::json!(4)));
    let rows = json["rows"].as_array().expect("rows");
    let named = |row: &Value| (row["recipe"].as_str().expect("a name").to_owned(), number(row, "map-size"));
    let wanted = [("auto", 64.0), ("auto", 128.0), ("reeves87,bias=0", 64.0), ("reeves87,bias=0", 128.0)];
    assert_eq!(rows.iter().map(named).collect::<Vec<_>>(), wanted.map(|(name, size)| (name.to_owned(), size)));
    assert!(number(&rows[0], "rms") < 0.05 && number(&rows[2], "acne") > 0.02, "{json}");
    assert!(number(&rows[0], "bytes") > 100.0 && number(&rows[0], "look-up-ns") > 1.0, "{json}");
    assert!(rows.iter().all(|row| number(row, "judged-pixels") == number(&rows[0], "judged-pixels")));

    let all = report(&["gallery:contact-box", "--size", "24x18", "--samples", "1", "--map-size", "32"]);
    let names = all["rows"].as_array().expect("rows").iter().map(|row| row["recipe"].as_str().expect("a name"));
    // All but the control.
    let presets = PresetName::ALL.into_iter().filter(|preset| *preset != PresetName::Ordinary).map(PresetName::name);
    assert_eq!(names.collect::<Vec<_>>(), presets.collect::<Vec<_>>());
}

#[test]
fn a_bias_trades_acne_for_detachment() {
    let recipes = ["--recipe", "reeves87,bias=0", "reeves87,bias=15", "reeves87,bias=25", "auto"];
    let args = ["gallery:table-close-up", "--size", "96x96", "--samples", "4"];
    let json = report(&[&args[..], &recipes].concat());
    let of = |row: usize, name: &str| number(&json["rows"][row], name);
    assert!(of(0, "acne") > 0.02 && of(0, "detachment") == 0.0, "{json}");
    assert!(of(1, "acne") < 1e-3 && of(1, "detachment") > 1e-3, "{json}");
    assert!(of(2, "acne") < 1e-3 && of(2, "detachment") > of(1, "detachment"), "{json}");
    assert!(of(3, "acne") < 1e-3 && of(3, "detachment") == 0.0 && of(3, "leak") < 1e-3, "{json}");
    assert!(json["rows"][0]["detached"].is_null() && of(2, "detached") > 1.0, "{json}");
}

#[test]
fn truth_as_the_tool_writes_it_has_no_fault() {
    let args = ["gallery:contact-box", "--size", "64x48"];
    let of = |path: &Path, more: &[&str]| {
        let json = report(&[&args[..], &["--against", text(path)], more].concat());
        assert_eq!(json["rows"].as_array().map(Vec::len), Some(1), "{json}");
        json["rows"][0].clone()
    };
    let exr = truth("compare-exr", &[&args[..], &["--format", "exr"]].concat(), "contact-box.exr");
    let row = of(&exr, &[]);
    for name in ["rms", "false-shadow", "false-light", "acne", "displacement"] {
        assert_eq!(number(&row, name), 0.0, "{name}");
    }
    // A point of a line is as near to it as f64 can tell.
    assert!(number(&row, "edge-shift") < 1e-12, "{row}");
    assert!(row["leak"].is_null() && row.get("leak").is_none() && row["image"] == text(&exr), "{row}");
    let rounded = number(&of(&truth("compare-png", &args, "contact-box.png"), &[]), "rms");
    assert!(rounded > 0.0 && rounded <= 1e-5, "{rounded}");

    // What arrives is the complement of what is in shadow.
    let image = umbrage_io::read_values(&exr, u64::MAX).expect("an image");
    let light: Vec<f32> = image.values.iter().map(|dark| 1.0 - dark).collect();
    let path = exr.with_file_name("light.exr");
    std::fs::write(&path, umbrage_io::encode_exr_values(image.size, &light).expect("a picture")).expect("a file");
    assert!(number(&of(&path, &["--invert"]), "rms") < 1e-7 && number(&of(&path, &[]), "rms") > 0.3);

    let area = [&args[..], &["--area=12", "--samples", "4", "--format", "exr"]].concat();
    let soft = truth("compare-area", &area, "contact-box.area.exr");
    assert_eq!(number(&of(&soft, &["--area=12", "--samples", "4"]), "rms"), 0.0);
    assert!(number(&of(&exr, &["--area=12", "--samples", "4"]), "rms") > 0.0);
}

#[test]
fn an_image_is_of_one_light_and_of_the_size_of_the_pictures() {
    let args = ["--size", "40x30", "--samples", "1"];
    let lights = [&["gallery:three-lights", "--format", "exr"], &args[..]].concat();
    let red = truth("compare-lights", &lights, "three-lights.red.exr");
    let compare = [&["compare", "gallery:three-lights", "--against", text(&red)], &args[..]].concat();
    let error = refused(2, &compare);
    let wanted = "error: --against: an image is of one light, --light chooses one of ";
    assert!(error.starts_with(wanted) && error.contains("red") && error.contains("blue"), "{error}");
    let json = report(&[&compare[1..], &["--light", "red", "--recipe", "auto", "--map-size", "64"]].concat());
    let rows = json["rows"].as_array().expect("rows");
    assert_eq!((rows.len(), &rows[0]["recipe"], number(&rows[1], "rms")), (2, &"auto".into(), 0.0), "{json}");

    let error =
        refused(2, &["compare", "gallery:three-lights", "--light", "red", "--against", text(&red), "--size", "41x30"]);
    let wanted = "the image has 40 x 30 pixels, truth has 41 x 30 (--size 40x30 makes them equal)";
    assert_eq!(error, format!("error: {}: {wanted}", text(&red)));

    let broken = red.with_file_name("broken.png");
    std::fs::write(&broken, b"no picture").expect("a file");
    let args = ["compare", "gallery:contact-box", "--size", "8x8", "--samples", "1", "--against"];
    let error = refused(1, &[&args[..], &[text(&broken)]].concat());
    assert!(error.starts_with(&format!("error: {}: PNG data is ", text(&broken))), "{error}");
    let nan = red.with_file_name("nan.exr");
    let pixels = umbrage_io::encode_exr_values(glam::UVec2::splat(8), &[f32::NAN; 64]).expect("a picture");
    std::fs::write(&nan, pixels).expect("a file");
    let error = refused(1, &[&args[..], &[text(&nan)]].concat());
    assert_eq!(error, format!("error: {}: the pixel in column 0, row 0 is NaN", text(&nan)));
    refused(1, &[&args[..], &[text(&red.with_file_name("none.png"))]].concat());
}

#[test]
fn what_is_above_a_limit_fails() {
    let args = ["compare", "gallery:contact-box", "--size", "48x36", "--samples", "4", "--map-size", "128", "--recipe"];
    let with = |recipe: &str, limits: &str| run(&[&args[..], &[recipe, "--fail-above", limits]].concat());
    assert_eq!(with("auto", "rms=0.05,acne=0.1%,leak=1%").code, 0);
    let failed = with("reeves87,bias=0", "rms=0.9, acne=0.1%,edge-shift=1000");
    assert_eq!((failed.code, failed.err.lines().count()), (3, 1), "{}", failed.err);
    let wanted = "error: --fail-above: reeves87,bias=0 at 128 texels under ";
    assert!(failed.err.starts_with(wanted) && failed.err.trim_end().ends_with("%, above 0.1%"), "{}", failed.err);
    assert_eq!(failed.out.lines().count(), 2, "the table is there all the same");
    // A share is one with and without its sign.
    assert_eq!((with("reeves87,bias=0", "acne=0.99").code, with("reeves87,bias=0", "acne=0.001").code), (0, 3));
    for (limits, problem) in [
        ("shade=1", "\"shade\" is not known: expected rms, false-shadow, false-light, acne, detachment, leak, "),
        ("rms", "expected NAME=NUMBER, as in rms=0.02,acne=0.1%"),
        ("rms=1%", "rms is not a fraction: 1% cannot be in per cent"),
        ("rms=much", "rms is \"much\": expected a finite number"),
        ("rms=1,rms=2", "rms is given twice"),
    ] {
        let error = refused(2, &[&args[..], &["auto", "--fail-above", limits]].concat());
        assert!(error.starts_with(&format!("error: --fail-above: {problem}")), "{error}");
    }
    let error = refused(2, &[&args[..], &["reeves88"]].concat());
    assert!(error.starts_with("error: --recipe: recipe = \"reeves88\""), "{error}");
    let error = refused(1, &["compare", "gallery:contact-box", "--max-memory", "80MiB"]);
    assert!(error.starts_with("error: memory: ") && error.contains("more than --max-memory 80 MiB"), "{error}");
}

#[test]
fn the_page_shows_what_the_report_says() {
    let out = folder("compare-page");
    let image =
        truth("compare-page-truth", &["gallery:contact-box", "--size", "48x36", "--samples", "4"], "contact-box.png");
    let args = [
        "gallery:contact-box",
        "--size",
        "48x36",
        "--samples",
        "4",
        "--map-size",
        "64",
        "--recipe",
        "auto",
        "reeves87,bias=0",
    ];
    let more = ["--against", text(&image), "-o", text(&out), "--fail-above", "rms=0.9"];
    let json = report(&[&args[..], &more].concat());
    let written: Value =
        serde_json::from_slice(&std::fs::read(out.join("report.json")).expect("a file")).expect("JSON");
    assert_eq!(written, json);
    assert_eq!(json["exceeded"], serde_json::json!([]));
    let files: Vec<&str> =
        json["files"].as_array().expect("files").iter().map(|file| file.as_str().expect("a name")).collect();
    // Result, faults and difference of each of three, and truth; the page and the report.
    assert_eq!(files.len(), 3 * 3 + 1 + 2, "{files:?}");
    let page = std::fs::read_to_string(out.join("index.html")).expect("a page");
    for file in files.iter().filter(|file| Path::new(file).extension().is_some_and(|it| it == "png")) {
        let codes = umbrage_io::decode_png(&std::fs::read(file).expect("a file")).expect("a picture");
        assert_eq!(codes.size.to_array(), [48, 36]);
        let name = Path::new(file).strip_prefix(&out).expect("inside").display().to_string();
        assert!(page.contains(&format!("src=\"{name}\"")), "{name}");
    }
    assert!(page.contains("Wipe between result and truth") && page.contains("reeves87,bias=0, 64 texels: faults"));
    // Where acne is, the map of faults is orange.
    let map = files.iter().find(|file| file.ends_with("2-reeves87-bias-0-64-faults.png")).expect("a map of faults");
    let codes = umbrage_io::decode_png(&std::fs::read(map).expect("a file")).expect("a picture");
    let orange = codes.rgb.iter().filter(|rgb| rgb[0] == 255 && rgb[2] == 0).count() as f64;
    let row = &json["rows"][1];
    assert_eq!(orange, (number(row, "acne") * number(row, "judged-pixels")).round(), "{row}");
}
