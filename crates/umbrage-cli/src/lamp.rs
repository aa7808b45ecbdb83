//! A light's shadow.

use crate::lights::Lamp;
use crate::memory::Need;
use crate::stage::Stage;
use anyhow::Context;
use umbrage_depth::Storage;
use umbrage_recipe::{LightShadow, LightUse, Recipe};
use umbrage_render::{Soup, alpha_blend, alpha_test, receivers};

/// All of pass 1 of a light, and the algorithm over it.
///
/// # Errors
/// A recipe that cannot be used for the light, or too little memory, with the light's name.
pub fn shadow_of(stage: &Stage, lamp: &Lamp, recipe: &Recipe) -> anyhow::Result<LightShadow> {
    let scene = &stage.scene;
    let light = &scene.lights[lamp.light];
    let seen = recipe.is_fitted().then(|| receivers(scene, &light.view));
    let with = LightUse { storage: Storage::Tiled, receivers: seen.as_deref(), moments: 1 };
    let views = lamp.whole_views(scene);
    let points = u64::from(recipe.most_points());
    if points > 1 {
        let texels: u64 = views.iter().map(|view| u64::from(view.size().element_product())).sum();
        let need = Need { texels, kept_texels: points * texels, ..Need::default() };
        need.check(stage.max_memory).with_context(|| format!("light {:?}", light.name))?;
    }
    let (test, blend) = (alpha_test(scene), alpha_blend(scene));
    let shadow = recipe.shadow_of(views, &with, |view, _| Soup::casters(scene, view).into_casting(&test, &blend));
    shadow.with_context(|| format!("light {:?}", light.name))
}
