//! Why a pixel is lit or dark: the words agree with the pictures.

use crate::typed::{files, folder, good, refused, run, text};
use serde_json::Value;
use std::collections::BTreeMap;
use std::path::Path;
use umbrage_sample::Key;

/// The values of a picture of numbers.
fn values(path: &Path) -> Vec<f32> {
    let image = exr::prelude::read_first_flat_layer_from_file(path).expect("an EXR file");
    image.layer_data.channel_data.list[0].sample_data.values_as_f32().collect()
}

/// A scene's shadow by a recipe, or by rays.
fn shadow(name: &str, scene: &str, more: &[&str]) -> Vec<f32> {
    let out = folder(&format!("explained-{name}"));
    good(
        &[&["shadow", scene, "--size", "64x48", "--samples", "1", "--format", "exr", "-o", text(&out)], more].concat(),
    );
    values(&out.join(&files(&out)[0]))
}

/// What is said of pixels, by their index.
fn explained(scene: &str, pixels: &[usize], more: &[&str]) -> Vec<Value> {
    let at: Vec<String> = pixels.iter().map(|index| format!("{},{}", index % 64, index / 64)).collect();
    let pixels = at.iter().flat_map(|at| ["--pixel", at]);
    let args: Vec<&str> =
        ["explain", scene, "--size", "64x48", "--json"].into_iter().chain(pixels).chain(more.iter().copied()).collect();
    let said: Value = serde_json::from_str(&good(&args).out).expect("JSON");
    said["pixels"].as_array().expect("pixels").clone()
}

/// Some of the pixels that satisfy a condition.
fn some(most: usize, count: usize, wanted: impl Fn(usize) -> bool) -> Vec<usize> {
    let mut all: Vec<usize> = (0..count).filter(|index| wanted(*index)).collect();
    all.sort_by_key(|index| Key::new(5, 0, 0).bits(*index as u32, 0));
    all.truncate(most);
    all
}

/// The name of a pixel's fault, if it has one; every number that was printed of it must fit the pictures.
fn name(said: &Value, value: f32, truth: f32) -> Option<String> {
    assert_eq!((said["value"].as_f64(), said["truth"].as_f64()), (Some(value.into()), Some(truth.into())), "{said}");
    let [surface] = said["surfaces"].as_array().expect("surfaces").as_slice() else {
        panic!("one sample, one surface")
    };
    let map = &surface["maps"][0];
    let questions = map["questions"].as_array().expect("questions");
    if let Some(last) = questions.last() {
        let (mut dark, mut all) = (0.0f32, 0.0f32);
        for tap in last["taps"].as_array().expect("taps") {
            let number = |field: &str| tap[field].as_f64().expect("a number") as f32;
            let stored = tap["stored"].as_f64().map_or(f32::INFINITY, |stored| stored as f32);
            assert!(!tap["ruled"].is_null() || (number("compared") > stored) == (number("dark") == 1.0), "{tap}");
            all += number("weight");
            dark += number("weight") * number("dark");
        }
        assert_eq!((dark / all).to_bits(), value.to_bits(), "{said}");
    }
    surface["fault"]["name"].as_str().map(str::to_owned)
}

/// Recipes that are wrong in every way: without a bias, and with two that are far too large.
#[test]
fn a_thousand_wrong_pixels_are_called_what_the_pictures_say() {
    let scenes = ["table", "contact-box", "box-plane", "spot-room", "thin-slab", "contacts", "stairs", "solids"];
    let mut found: BTreeMap<String, usize> = BTreeMap::new();
    for scene in scenes {
        let scene = format!("gallery:{scene}");
        let truth = shadow("truth", &scene, &["--truth"]);
        let unbiased = shadow("unbiased", &scene, &["--recipe", "reeves87,bias=0", "--map-size", "128"]);
        for bias in ["0", "4t", "12t"] {
            let recipe = format!("reeves87,bias={bias}");
            let more = ["--recipe", &recipe, "--map-size", "128"];
            let value = shadow("value", &scene, &more);
            let acne = |i: usize| truth[i] < 0.05 && value[i] > 0.5;
            let lost = |i: usize| truth[i] > 0.95 && value[i] < 0.5;
            let pixels = some(60, value.len(), |i| acne(i) || lost(i));
            if pixels.is_empty() {
                continue;
            }
            for (&i, said) in pixels.iter().zip(explained(&scene, &pixels, &more)) {
                let expected = if acne(i) {
                    "acne"
                } else if unbiased[i] > 0.5 && bias != "0" {
                    "detachment"
                } else {
                    "leak"
                };
                assert_eq!(name(&said, value[i], truth[i]).as_deref(), Some(expected), "{scene}, {recipe}, {said}");
                *found.entry(expected.into()).or_default() += 1;
            }
        }
    }
    assert!(found.values().sum::<usize>() >= 1000 && found.len() == 3, "{found:?}");
}

#[test]
fn the_table_has_acne_without_a_bias_detachment_with_one_and_nothing_wrong_by_default() {
    let scene = "gallery:table";
    let truth = shadow("table-truth", scene, &["--truth"]);
    let shadow = |recipe: &str| shadow("table", scene, &["--recipe", recipe]);
    let names = |recipe: &str, wanted: &dyn Fn(usize, &[f32]) -> bool| {
        let value = shadow(recipe);
        let pixels = some(4, value.len(), |i| wanted(i, &value));
        assert!(!pixels.is_empty(), "{recipe}");
        let said = explained(scene, &pixels, &["--recipe", recipe]);
        pixels.iter().zip(said).map(|(&i, said)| name(&said, value[i], truth[i])).collect::<Vec<_>>()
    };
    let all = |names: Vec<Option<String>>, wanted: Option<&str>| {
        assert!(names.iter().all(|name| name.as_deref() == wanted), "{names:?}");
    };
    let false_shadow = |i: usize, value: &[f32]| truth[i] == 0.0 && value[i] > 0.5;
    let false_light = |i: usize, value: &[f32]| truth[i] == 1.0 && value[i] < 0.5;
    let bare = shadow("reeves87,bias=0");
    all(names("reeves87", &false_shadow), Some("acne"));
    for recipe in ["reeves87,bias=15", "reeves87,bias=25"] {
        all(names(recipe, &|i, value| false_light(i, value) && bare[i] > 0.5), Some("detachment"));
    }
    all(names("auto", &|i, _| truth[i] == 0.0 && bare[i] > 0.5), None);
    all(names("auto", &|i, _| truth[i] == 1.0 && bare[i] > 0.5), None);
}

#[test]
fn the_words_are_for_people() {
    let said =
        good(&["explain", "gallery:table", "--size", "64x48", "--pixel", "32,30", "--recipe", "reeves87,bias=0"]).out;
    for part in ["pixel 32,30 under ", "sees ", "in the map of 512 x 512", "question 1: ", "whose", "by rays"] {
        assert!(said.contains(part), "{part}: {said}");
    }
    let auto = good(&["explain", "gallery:table", "--size", "64x48", "--pixel", "32,30"]).out;
    assert!(auto.contains("places of the region"), "{auto}");
    let nothing = good(&["explain", "gallery:four-spheres", "--size", "64x48", "--pixel", "0,0"]).out;
    assert!(nothing.contains("nothing is seen there"), "{nothing}");
}

#[test]
fn the_texels_are_drawn() {
    let path = folder("explained-svg").join("texels.svg");
    good(&[
        "explain",
        "gallery:table",
        "--size",
        "64x48",
        "--pixel",
        "32,30",
        "--recipe",
        "reeves87",
        "-o",
        text(&path),
    ]);
    let svg = std::fs::read_to_string(path).expect("a picture");
    assert!(svg.matches("<circle").count() == 16 && svg.contains("floor") && !svg.contains("NaN"), "{svg}");
}

#[test]
fn what_cannot_be_explained_is_refused() {
    let line = refused(2, &["explain", "gallery:table", "--size", "64x48", "--pixel", "64,0"]);
    assert!(line.contains("--pixel 64,0: the picture has 64 columns and 48 rows"), "{line}");
    let ran = run(&["explain", "gallery:table", "--pixel", "1"]);
    assert!(ran.code == 2 && ran.err.contains("X,Y"), "{}", ran.err);
    let two = ["explain", "gallery:table", "--pixel", "1,1", "--pixel", "2,2", "-o", "x.svg"];
    assert!(refused(2, &two).contains("-o: one pixel"));
}
