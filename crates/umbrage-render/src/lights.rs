use crate::{Recipe, RecipeError, Soup, Storage, bake};
use umbrage_depth::{First, Tiled};
use umbrage_raster::Cull;
use umbrage_scene::Scene;
use umbrage_shadow::{Shadow, Unshadowed};

/// The depth map of each light, in their order, by the first-surface rule; `None` for lights that do not cast.
pub fn light_maps(scene: &Scene) -> Vec<Option<Tiled>> {
    let map = |light: &umbrage_scene::Light| {
        let triangles = Soup::casters(scene, &light.view);
        light.casts.then(|| bake(&light.view, triangles.triangles(), &First, Cull::None).map)
    };
    scene.lights.iter().map(map).collect()
}

/// What [`picture`](crate::picture) wants of a scene's lights: each casting light's map under the recipe of its own tree, or under
/// `default` where the tree names none (R87-18).
///
/// `maps` are those of [`light_maps`]; a missing one casts no shadow.
///
/// # Errors
/// A light's recipe that cannot be used, with the light's name.
pub fn bind_lights(
    scene: &Scene,
    maps: &[Option<Tiled>],
    default: &Recipe,
    storage: Storage,
) -> Result<Vec<Box<dyn Shadow>>, RecipeError> {
    let one = |(index, light): (usize, &umbrage_scene::Light)| -> Result<Box<dyn Shadow>, RecipeError> {
        let Some(map) = maps.get(index).and_then(Option::as_ref) else { return Ok(Box::new(Unshadowed)) };
        let text = light.tree.as_ref().and_then(|tree| tree.recipe()).unwrap_or_default();
        if text.is_empty() {
            return Ok(default.bind(map, storage));
        }
        let recipe: Recipe = text.parse().map_err(|error: RecipeError| error.of_light(&light.name))?;
        Ok(recipe.bind(map, storage))
    };
    scene.lights.iter().enumerate().map(one).collect()
}
