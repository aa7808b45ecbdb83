use crate::{light_map, light_shadow};
use umbrage_depth::{Map, Storage};
use umbrage_recipe::{LightShadow, Recipe, RecipeError};
use umbrage_scene::{Light, Scene};
use umbrage_shadow::{Shadow, Unshadowed};

/// The map of each light, in their order, as the recipe of its own tree wants it, or `default` where the tree names none (Reeves 1987);
/// `None` for lights that do not cast.
///
/// # Errors
/// A light's recipe that cannot be used, with the light's name.
pub fn light_maps(scene: &Scene, default: &Recipe) -> Result<Vec<Option<Map>>, RecipeError> {
    let map = |light: &Light| {
        let bake = |recipe: Recipe| light_map(&recipe, scene, &light.view);
        light.casts.then(|| own(light, default).map(bake)).transpose()
    };
    scene.lights.iter().map(map).collect()
}

/// What [`picture`](crate::picture) wants of a scene's lights: each casting light's map under its own recipe, or `default`.
///
/// `maps` are those of [`light_maps`]; a missing one casts no shadow.
///
/// # Errors
/// As [`light_maps`], and for a map that records another surface than its light's recipe expects.
pub fn bind_lights(
    scene: &Scene,
    maps: &[Option<Map>],
    default: &Recipe,
    storage: Storage,
) -> Result<Vec<Box<dyn Shadow>>, RecipeError> {
    let one = |(index, light): (usize, &Light)| -> Result<Box<dyn Shadow>, RecipeError> {
        match maps.get(index).and_then(Option::as_ref) {
            Some(map) => own(light, default)?.bind(map, storage).map_err(|error| of_light(error, light)),
            None => Ok(Box::new(Unshadowed)),
        }
    };
    scene.lights.iter().enumerate().map(one).collect()
}

/// All of pass 1 of a scene at evenly spread times, one of them for a scene at rest: the shadow of each light, in their order, by the recipe of its own tree, or by `default`;
/// `None` for lights that do not cast. Each light has all maps that its recipe wants of it ([`light_shadow`]).
///
/// # Errors
/// A light's recipe that cannot be used, with the light's name.
///
/// # Panics
/// As [`Soup::casters`](crate::Soup::casters).
pub fn light_shadows(
    moments: &[&Scene],
    default: &Recipe,
    storage: Storage,
) -> Result<Vec<Option<LightShadow>>, RecipeError> {
    let one = |light: &Light| {
        let shadow = |recipe: Recipe| {
            light_shadow(&recipe, moments, &light.view, storage).map_err(|error| of_light(error, light))
        };
        light.casts.then(|| own(light, default).and_then(shadow)).transpose()
    };
    moments.first().map_or(Ok(Vec::new()), |scene| scene.lights.iter().map(one).collect())
}

/// The recipe of a light's tree, or `default`.
fn own(light: &Light, default: &Recipe) -> Result<Recipe, RecipeError> {
    match light.tree.as_ref().and_then(|tree| tree.recipe()) {
        Some(text) if !text.is_empty() => text.parse().map_err(|error| of_light(error, light)),
        _ => Ok(*default),
    }
}

/// An error that says whose recipe it is of.
fn of_light(error: RecipeError, light: &Light) -> RecipeError {
    error.of(&format!("light {:?}", light.name))
}
