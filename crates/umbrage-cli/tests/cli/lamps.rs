//! Lamps that shine all around.

use crate::typed::{folder, good, lamps, rms, text, values};
use std::path::Path;

/// The shadow of the lamp of a scene, written into a folder under a name.
fn picture(scene: &Path, name: &str, folder: &Path, more: &[&str]) -> Vec<f64> {
    let into = folder.join(more.join("_"));
    let fixed = ["shadow", text(scene), "-o", text(&into), "--light", "bulb", "--size", "96x72", "--samples", "4"];
    good(&[&fixed[..], more].concat());
    values(&into.join(name))
}

/// By the papers' filters as by the default, whose six maps join where a filter crosses from one to the next.
#[test]
fn a_lamp_is_shadowed_by_any_recipe_as_rays_say() {
    let folder = folder("lamps-recipes");
    let scene = lamps(&folder);
    let picture = |more: &[&str]| picture(&scene, "lamps.bulb.png", &folder, more);
    let truth = picture(&["--truth"]);
    for (recipe, most) in [("auto", 0.03), ("reeves87,bias=0.5w", 0.08), ("woo92", 0.08), ("wang-molnar94", 0.08)] {
        let off = rms(&picture(&["--recipe", recipe, "--map-size", "256"]), &truth);
        assert!(off < most, "{recipe}: {off}");
    }
}

/// A lamp with a size is a sphere to maps and to rays.
#[test]
fn a_lamp_of_a_size_is_as_soft_as_rays_say() {
    let folder = folder("lamps-sizes");
    let scene = lamps(&folder);
    let picture = |more: &[&str]| picture(&scene, "lamps.bulb.area.png", &folder, more);
    let truth = picture(&["--area=0.5", "--truth"]);
    let soft = truth.iter().filter(|value| (0.1..0.9).contains(*value)).count();
    let off = rms(&picture(&["--area=0.5", "--map-size", "64", "--recipe", "auto,maps=32"]), &truth);
    assert!(soft * 40 > truth.len() && off < 0.03, "{off}, {soft} of {} pixels are in penumbrae", truth.len());
}
