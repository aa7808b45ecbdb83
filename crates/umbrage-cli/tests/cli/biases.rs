//! The bias that ends false shadow, the one that keeps contacts, and both in engines' words.

use crate::typed::{files, folder, good, refused, run, text};
use serde_json::Value;

fn found(scene: &str, more: &[&str]) -> Value {
    let args = ["bias", scene, "--size", "128x96", "--json"];
    serde_json::from_str(&good(&[&args[..], more].concat()).out).expect("JSON")
}

#[test]
fn wm94_18_no_bias_works_for_a_table_and_one_does_for_a_box() {
    let kinds = |scene: &str| {
        let found = found(scene, &[]);
        let kinds = found["lights"][0]["biases"].as_array().expect("kinds").clone();
        kinds
            .iter()
            .map(|kind| (kind["works"] == true, kind["acne_free"].as_f64(), kind["keeps_contact"].as_f64()))
            .collect::<Vec<_>>()
    };
    // Thin legs under a slanting lamp: the paper's own counter-example (D-10).
    for (works, low, high) in kinds("gallery:table") {
        assert!(!works && low > high, "{low:?} {high:?}");
    }
    for (works, low, high) in kinds("gallery:box-plane") {
        assert!(works && low.is_some() && low <= high, "{low:?} {high:?}");
    }
    // D-9: three texels of a filter reach one and a half from its middle.
    let steps = kinds("gallery:box-plane")[1].1.expect("an amount");
    assert!((1.3..1.8).contains(&steps), "{steps}");
}

#[test]
fn a_wider_filter_needs_a_larger_bias() {
    let amount = |radius: &str| {
        let found = found("gallery:box-plane", &["--radius", radius]);
        found["lights"][0]["biases"][1]["acne_free"].as_f64().expect("an amount")
    };
    let amounts = ["0", "1.5", "3"].map(amount);
    assert!(amounts.is_sorted_by(|a, b| a < b), "{amounts:?}");
}

#[test]
fn engines_are_given_settings_or_say_why_not() {
    let found = found("gallery:box-plane", &[]);
    let engines = found["lights"][0]["engines"]["settings"].as_object().expect("engines").clone();
    assert_eq!(engines.len(), 12);
    assert!(engines["unreal"]["error"].is_string());
    assert!(engines["three"]["settings"]["normalBias"].is_array());
    let one = good(&["bias", "gallery:box-plane", "--size", "64x48", "--engine", "godot"]).out;
    assert!(
        one.contains("\n  godot ") && one.contains("source: godotengine/godot") && !one.contains("\n  three "),
        "{one}"
    );
}

#[test]
fn the_trade_off_is_drawn_for_each_light() {
    let out = folder("bias-plots");
    good(&["bias", "gallery:three-lights", "--size", "48x36", "--map-size", "64", "-o", text(&out)]);
    let files = files(&out);
    assert!(files.len() > 1 && files.iter().all(|file| file.ends_with(".bias.svg")), "{files:?}");
    let svg = std::fs::read_to_string(out.join(&files[0])).expect("a plot");
    assert!(svg.contains("normal offset") && !svg.contains("NaN"));
}

#[test]
fn what_makes_no_sense_is_refused() {
    let said = |more: &[&str]| {
        let ran = run(&[&["bias", "gallery:box-plane"], more].concat());
        assert_eq!((ran.code, ran.out.as_str()), (2, ""), "{more:?}");
        ran.err
    };
    let engines = said(&["--engine", "quake"]);
    assert!(engines.contains("quake") && engines.contains("webgpu"), "{engines}");
    assert!(said(&["--radius", "65"]).contains("from 0 to 64"));
    assert!(said(&["--tolerance", "NaN"]).contains("from 0 to 100"));
    assert!(refused(2, &["bias", "gallery:box-plane", "--recipe", "woo92"]).contains("--recipe"));
}
