use crate::{Soup, alpha_blend, alpha_test, receivers};
use glam::Vec3;
use umbrage_bake::{CasterMesh, Deep, MaskPlace, bake_deep, mix_moments};
use umbrage_depth::{DeepMap, DepthMap, Map, Storage, Tiled};
use umbrage_plane::View;
use umbrage_raster::Stats;
use umbrage_recipe::{LightShadow, LightUse, Recipe, RecipeError};
use umbrage_scene::Scene;

/// Pass 1: the map that a recipe wants of a scene as a light's view sees it.
///
/// # Panics
/// As [`Soup::casters`].
pub fn light_map(recipe: &Recipe, scene: &Scene, view: &View) -> Map {
    exposed_map(recipe, &[scene], view).0
}

/// Pass 1 and what it is for: the shadow of a light by a recipe, over all maps that the recipe wants of a scene at evenly spread times, one of them for a scene
/// at rest. Maps are [fitted](umbrage_plane::View::fitted) to what the first scene's camera sees, where the recipe says so.
///
/// # Errors
/// As [`Recipe::shadow_of`]. Without any scene, nothing casts a shadow.
///
/// # Panics
/// As [`Soup::casters`].
pub fn light_shadow(
    recipe: &Recipe,
    moments: &[&Scene],
    view: &View,
    storage: Storage,
) -> Result<LightShadow, RecipeError> {
    let seen = match moments {
        [first, ..] if recipe.is_fitted() => Some(receivers(first, view)),
        _ => None,
    };
    let with = LightUse { storage, receivers: seen.as_deref(), moments: moments.len() as u32 };
    let covers = covers(moments);
    let casters = |view: &View, moment: u32| {
        let moment = moments.iter().zip(&covers).nth(moment as usize);
        let soup = moment.map(|(scene, covers)| (Soup::casters(scene, view), covers));
        soup.into_iter().flat_map(|(soup, (test, blend))| soup.into_casting(test, blend))
    };
    recipe.shadow_of(std::slice::from_ref(view), &with, casters)
}

/// [`light_map`] over an exposure, `moments` being the scene at evenly spread times: deep maps hold the mean of them; of maps of one
/// surface each texel sees one of them. An empty map of none. Beside it, what became of the triangles of all moments.
///
/// # Panics
/// As [`Soup::casters`].
pub fn exposed_map(recipe: &Recipe, moments: &[&Scene], view: &View) -> (Map, Stats) {
    recipe.bake_counted(view, casting(moments, &covers(moments), view))
}

/// What the covers of each moment say: the alpha test, and what passes.
fn covers<'a>(
    moments: &[&'a Scene],
) -> Vec<(impl Fn(&MaskPlace) -> bool + Sync + use<'a>, impl Fn(&MaskPlace) -> Vec3 + Sync + use<'a>)> {
    moments.iter().map(|scene| (alpha_test(scene), alpha_blend(scene))).collect()
}

/// The casters of each moment.
fn casting<'m>(
    moments: &[&'m Scene],
    covers: &'m [(impl Fn(&MaskPlace) -> bool + Sync, impl Fn(&MaskPlace) -> Vec3 + Sync)],
    view: &View,
) -> impl Iterator<Item = impl Iterator<Item = CasterMesh<'m>>> {
    moments.iter().zip(covers).map(|(scene, (test, blend))| Soup::casters(scene, view).into_casting(test, blend))
}

/// Pass 1 over an exposure: each texel sees the scene at one of its moments, drawn once per texel from `seed`. A filter over such a
/// map blurs what moves, with noise.
///
/// `moments` are the scene at evenly spread times, each made into a map of `view` by `bake`; none gives an empty map.
pub fn expose<M: DepthMap>(view: &View, moments: &[&Scene], seed: u32, bake: impl Fn(&Scene) -> M) -> Tiled {
    let maps: Vec<M> = moments.iter().map(|scene| bake(scene)).collect();
    mix_moments(view, &maps, seed)
}

/// The deep map of an exposure: the mean over its moments of what passes the surfaces of a scene
/// ([`Object::passes`](umbrage_scene::Object::passes)).
///
/// `moments` are the scene at evenly spread times, one of them for a scene at rest; none gives an empty map.
///
/// # Panics
/// As [`Soup::casters`].
pub fn expose_deep(view: &View, moments: &[&Scene], deep: &Deep) -> DeepMap {
    bake_deep(view, casting(moments, &covers(moments), view), deep).map
}
