//! Pictures of the bicycle shop under its lamp, with the default recipe.

use super::quantity::Quantity;
use glam::UVec2;
use umbrage_depth::Storage;
use umbrage_recipe::Recipe;
use umbrage_render::{Frame, light_shadow, picture};
use umbrage_scene::gallery::bicycle_shop;

/// Side of the lamp's map, texels.
const MAP: u32 = 1024;

pub(super) fn measure(side: u32) -> Vec<Quantity> {
    let mut scene = bicycle_shop();
    scene.camera = scene.camera.with_size(UVec2::splat(side)).expect("a size of a picture");
    let lamp = scene.lights[0].view.with_size(UVec2::splat(MAP)).expect("a size of a map");
    let shadow =
        light_shadow(&Recipe::default(), &[&scene], &lamp, Storage::Tiled).expect("the default takes any scene");
    let (taken, seen) = Quantity::timed("picture", || picture(&scene, &[&*shadow.shadow], &Frame::CENTRES));
    let dark = seen.shadow[0].iter().map(|dark| f64::from(*dark)).sum::<f64>() / seen.shadow[0].len() as f64;
    assert!((0.02..0.9).contains(&dark), "{dark} of the picture is in shadow");
    vec![taken]
}
