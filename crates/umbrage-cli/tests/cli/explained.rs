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

/// The cosine between the one surface that a pixel sees and the light.
fn cosine(said: &Value) -> f64 {
    said["surfaces"][0]["cosine"].as_f64().expect("a number")
}

/// How far what blocks the light is along the ray, texels of the map there.
fn gap(said: &Value) -> f64 {
    let surface = &said["surfaces"][0];
    let texel = surface["maps"][0]["receiver"]["texel_world"].as_array().expect("two numbers");
    let texel = texel.iter().filter_map(Value::as_f64).fold(0.0, f64::max);
    surface["blockers"][0]["distance"].as_f64().map_or(f64::INFINITY, |distance| distance / texel)
}

/// Recipes that are wrong in every way: without a bias, and with two that are far too large.
#[test]
fn a_thousand_wrong_pixels_are_called_what_the_pictures_say() {
    let scenes = ["table", "contact-box", "box-plane", "spot-room", "thin-slab", "contacts", "stairs", "solids"];
    let mut found: BTreeMap<String, usize> = BTreeMap::new();
    let (mut unjudged, mut elsewhere) = (0, 0);
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
            let pixels = some(70, value.len(), |i| acne(i) || lost(i));
            if pixels.is_empty() {
                continue;
            }
            for (&i, said) in pixels.iter().zip(explained(&scene, &pixels, &more)) {
                if let Some(why) = said["not_judged"].as_str() {
                    assert_eq!(name(&said, value[i], truth[i]), None, "{scene}, {recipe}, {said}");
                    // Where the words claim an angle, it is one at which nothing is judged.
                    assert!(!why.contains("N·L") || cosine(&said) <= 0.02, "{scene}, {recipe}, {said}");
                    unjudged += 1;
                    continue;
                }
                assert!(cosine(&said) > 0.02, "{scene}, {recipe}, {said}");
                let expected: &[&str] = if acne(i) {
                    &["acne"]
                } else if unbiased[i] <= 0.5 || bias == "0" {
                    &["leak"]
                } else if gap(&said) <= bias.trim_end_matches('t').parse().expect("texels") {
                    &["detachment"]
                } else {
                    // The blocker may be nearer elsewhere in what the filter looks at.
                    elsewhere += 1;
                    &["detachment", "leak"]
                };
                let name = name(&said, value[i], truth[i]).expect("a fault");
                assert!(expected.contains(&&*name), "{scene}, {recipe}: {name}, not {expected:?}: {said}");
                *found.entry(name).or_default() += 1;
            }
        }
    }
    let judged = found.values().sum::<usize>();
    assert!(judged >= 1000 && found.len() == 3, "{found:?}");
    assert!(unjudged < judged / 10 && elsewhere < judged / 8, "{found:?}, {unjudged}, {elsewhere}");
}

/// A surface that faces away is dark whatever the map says of it, so that nothing there is a fault.
#[test]
fn what_faces_away_has_no_fault_whatever_the_map_says() {
    let (mut turned, mut overruled) = (0, 0);
    for scene in ["solids", "four-spheres", "table", "stairs"] {
        let scene = format!("gallery:{scene}");
        let truth = shadow("away-truth", &scene, &["--truth"]);
        let more = ["--recipe", "reeves87,bias=12t", "--map-size", "128"];
        let value = shadow("away", &scene, &more);
        let pixels = some(80, value.len(), |i| truth[i] == 1.0 && value[i] == 1.0);
        for (&i, said) in pixels.iter().zip(explained(&scene, &pixels, &more)) {
            let surface = &said["surfaces"][0];
            assert_eq!(said["surfaces"].as_array().map(Vec::len), Some(1), "one sample, one surface: {said}");
            assert_eq!((said["value"].as_f64(), said["truth"].as_f64()), (Some(1.0), Some(1.0)), "{said}");
            assert!(surface["fault"].is_null(), "{scene}: pixel {i}: {said}");
            if cosine(&said) <= 0.0 {
                let why = said["not_judged"].as_str().expect("not judged");
                assert!(why.starts_with("it faces away from the light, N·L -") || why.contains("N·L 0.000"), "{said}");
                turned += 1;
                overruled += usize::from(surface["fraction"].as_f64().is_some_and(|fraction| fraction < 0.5));
            }
        }
    }
    assert!(turned >= 40 && overruled >= 20, "{turned} face away, and of {overruled} the map says that they are lit");

    let suzi = concat!(env!("CARGO_MANIFEST_DIR"), "/../../fixtures/scenes/suzi.glb");
    let said = good(&["explain", suzi, "--size", "96x64", "--pixel", "53,29", "--recipe", "reeves87,samples=4"]).out;
    let sentence = "dark, although the map says 0: it faces away from the light, whatever the map stores\n";
    assert!(said.contains(sentence) && said.contains("not judged, so no fault is named: it faces away"), "{said}");
    assert!(["leak", "acne", "detachment", "off by"].iter().all(|word| !said.contains(word)), "{said}");
}

#[test]
fn a_pixel_that_sees_several_surfaces_or_what_the_light_does_not_reach_has_no_fault() {
    let all = |scene: &str, samples: &str| {
        let pixels: Vec<usize> = (0..64 * 48).step_by(29).collect();
        let of = |said: &Value| {
            let surfaces = said["surfaces"].as_array().expect("surfaces");
            let is_named = surfaces.iter().any(|surface| !surface["fault"].is_null());
            (said["not_judged"].as_str().map(str::to_owned), surfaces.len(), is_named)
        };
        explained(scene, &pixels, &["--samples", samples]).iter().map(of).collect::<Vec<_>>()
    };
    let table = all("gallery:table", "16");
    let several: Vec<_> = table.iter().filter(|(_, surfaces, _)| *surfaces > 1).collect();
    assert!(!several.is_empty() && several.len() < table.len(), "{table:?}");
    assert!(table.iter().all(|(why, _, is_named)| why.is_none() || !is_named), "{table:?}");
    let spot = all("gallery:spot-room", "1");
    let beyond = spot.iter().filter(|(why, ..)| why.as_deref().is_some_and(|why| why.contains("cone and map")));
    assert!(beyond.count() > 3 && spot.iter().any(|(why, ..)| why.is_none()), "{spot:?}");
    assert!(spot.iter().all(|(why, _, is_named)| why.is_none() || !is_named), "{spot:?}");
}

#[test]
fn the_table_has_acne_without_a_bias_detachment_at_a_foot_with_one_and_nothing_wrong_by_default() {
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
    // The legs' narrow shadows, some hundreds of units from the legs: no bias of 25 passes these.
    for recipe in ["reeves87,bias=15", "reeves87,bias=25"] {
        all(names(recipe, &|i, value| false_light(i, value) && bare[i] > 0.5), Some("leak"));
    }
    // At the foot of a leg it does.
    for recipe in ["reeves87,bias=15", "reeves87,bias=25"] {
        let said = good(&["explain", scene, "--pixel", "244,310", "--recipe", recipe]).out;
        assert!(said.contains("\n  detachment: what blocks the light is 8.23 world units away"), "{said}");
    }
    all(names("auto", &|i, _| truth[i] == 0.0 && bare[i] > 0.5), None);
    all(names("auto", &|i, _| truth[i] == 1.0 && bare[i] > 0.5), None);
}

/// A leg's shadow that is narrower than the filter, far from the leg. Without a bias the floor would be dark by its own depths.
#[test]
fn a_bias_is_not_blamed_for_what_it_does_not_reach() {
    let args = ["explain", "gallery:table", "--map-size", "256", "--recipe", "filament-pcf"];
    let said = good(&[&args[..], &["--pixel", "363,321"]].concat()).out;
    assert!(
        said.contains("964 world units away, farther than the bias reaches") && said.contains("  leak: "),
        "{said}"
    );
    assert!(!said.contains("detachment"), "{said}");
}

#[test]
fn a_bias_detaches_shadows_near_what_throws_them() {
    let scene = "gallery:table-close-up";
    let truth = shadow("close-truth", scene, &["--truth"]);
    let bare = shadow("close-bare", scene, &["--recipe", "reeves87,bias=0"]);
    for bias in [15.0, 25.0] {
        let recipe = format!("reeves87,bias={bias}");
        let value = shadow("close", scene, &["--recipe", &recipe]);
        let pixels = some(12, value.len(), |i| truth[i] == 1.0 && value[i] < 0.5 && bare[i] > 0.5);
        let mut near = 0;
        for (&i, said) in pixels.iter().zip(explained(scene, &pixels, &["--recipe", &recipe])) {
            let distance = said["surfaces"][0]["blockers"][0]["distance"].as_f64().expect("a blocker");
            let name = name(&said, value[i], truth[i]);
            assert!(distance > bias || name.as_deref() == Some("detachment"), "{name:?}: {said}");
            near += usize::from(distance <= bias);
        }
        assert!(near >= 5, "{recipe}: {near} of {}", pixels.len());
    }
}

#[test]
fn the_words_are_for_people() {
    let said =
        good(&["explain", "gallery:table", "--size", "64x48", "--pixel", "32,30", "--recipe", "reeves87,bias=0"]).out;
    for part in ["pixel 32,30 under ", "sees ", "in the map of 512 x 512", "look-up 1: ", "whose", "by rays"] {
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
