//! What mutants and libFuzzer have found, kept.

use std::ffi::OsString;
use umbrage_fuzz::{ExrFile, flat, foreign, recipe, values};
use umbrage_recipe::Recipe;

/// What a command says on stderr, and its code.
fn refused(args: &[&str]) -> (u8, String) {
    let words = std::iter::once("umbrage").chain(args.iter().copied()).map(OsString::from);
    let (mut out, mut err) = (Vec::new(), Vec::new());
    let code = umbrage_cli::run(words, &mut std::io::empty(), &mut out, &mut err, false);
    (code, String::from_utf8(err).expect("text"))
}

/// A file of a few hundred bytes whose map would take a gibibyte.
#[test]
fn a_map_s_texels_are_counted_against_max_memory() {
    let mut file = ExrFile::parse(&foreign(&flat())).expect("sound");
    file.parts[0].set("displayWindow", "box2i", &[0, 0, 16_383, 16_383].map(i32::to_le_bytes).concat());
    let path = std::path::Path::new(env!("CARGO_TARGET_TMPDIR")).join("texels.exr");
    std::fs::write(&path, file.to_bytes(&[0])).expect("a file");
    let path = path.to_str().expect("text");
    for command in ["info", "lookup"] {
        let (code, line) = refused(&[command, path, "--max-memory", "65MiB"]);
        assert_eq!(code, 1);
        assert!(
            line.starts_with(&format!("error: {path}: displayWindow is 16384 x 16384: more than the allowed ")),
            "{line}"
        );
        assert!(line.ends_with(" texels\n") && line.lines().count() == 1, "{line}");
    }
}

/// An unknown word was once repeated in the error verbatim, terminal control characters included, whatever its length.
#[test]
fn an_invalid_recipe_is_refused_by_one_short_line_without_control_characters() {
    let refusal = |text: &str| text.parse::<Recipe>().unwrap_err().to_string();
    assert_eq!(refusal("auto,a\0\u{1b}[31m\nb"), "a\\0\\u{1b}[31m\\nb = \"\": expected field=value");
    assert_eq!(refusal("woo92,samples=\u{1b}"), "samples = \"\\u{1b}\": expected a whole number from 1 to 65536");
    let long = "x".repeat(100_000);
    for text in [&long, &format!("auto,{long}"), &format!("auto,{long}={long}"), &format!("woo92,samples={long}")] {
        assert!(!recipe(text.as_bytes()), "holds the line's length too");
    }
}

/// Damaged B44 once stopped the program in builds that check sums.
#[test]
fn an_image_packed_by_b44_is_refused_by_one_line() {
    let size = glam::UVec2::new(8, 8);
    let good = umbrage_io::encode_exr_values(size, &[0.25; 64]).expect("an image");
    assert!(values(&good));
    for coder in [6, 7] {
        let mut file = ExrFile::parse(&good).expect("sound");
        file.parts[0].set("compression", "compression", &[coder]);
        let file = file.to_bytes(&[0]);
        assert!(!values(&file));
        let line = umbrage_io::decode_values(&file, 64).unwrap_err().to_string();
        assert!(line.starts_with("compression is b44") && line.contains("are read from none, RLE"), "{line}");
    }
}
