//! The scene that is drawn, and what was made from it.

use super::base::{Base, Setting, one};
use super::truths::{Judged, JudgedKey, Kept, TruthKey, Truths, Until};
use crate::lamp;
use crate::lights::Lamp;
use crate::render::picture_by;
use crate::shadow::{self, Turned};
use crate::stage::Stage;
use std::sync::Arc;
use umbrage_oracle::Geometry;
use umbrage_oracle::judge::{Drawn, Judge};
use umbrage_plane::View;
use umbrage_recipe::{LightShadow, Recipe};
use umbrage_render::{Frame, Picture};
use umbrage_shadow::Shadow;
use umbrage_view::{Refusal, Stop};

/// Most shadows of each lamp that are kept: a recipe's, the same without its bias, and those before.
const MOST: usize = 3;

/// What a lamp's shadow depends on.
#[derive(PartialEq)]
struct ShadowKey {
    light: View,
    recipe: Recipe,
    /// Maps that are fitted to what the camera sees.
    camera: Option<View>,
}

pub struct Held {
    pub stage: Stage,
    geometry: Option<Arc<Geometry>>,
    shadows: Kept<ShadowKey, Arc<LightShadow>>,
    truths: Truths,
    judged: Kept<JudgedKey, Arc<Judged>>,
}

/// Why nothing was drawn.
pub enum Fault {
    Error(anyhow::Error),
    Stopped,
}

impl<E: Into<anyhow::Error>> From<E> for Fault {
    fn from(error: E) -> Self {
        Self::Error(error.into())
    }
}

impl From<Fault> for Refusal {
    fn from(fault: Fault) -> Self {
        match fault {
            Fault::Stopped => Self::Stopped,
            Fault::Error(error) => Self::Wrong(crate::shell::line(&error)),
        }
    }
}

fn check(stop: &Stop) -> Result<(), Fault> {
    stop.check().map_err(|_| Fault::Stopped)
}

impl Held {
    pub fn new(stage: Stage) -> Self {
        Self { stage, geometry: None, shadows: Kept::new(), truths: Truths::new(), judged: Kept::new() }
    }

    /// The geometry that rays are cast at: it is made once, since objects and camera do not change.
    pub fn geometry(&mut self, base: &Base) -> Arc<Geometry> {
        let scene = &self.stage.scene;
        Arc::clone(self.geometry.get_or_insert_with(|| Arc::new(Geometry::new(scene, &base.camera))))
    }

    /// A lamp's shadow by a recipe.
    pub fn shadow(&mut self, lamp: &Lamp, recipe: &Recipe) -> anyhow::Result<Arc<LightShadow>> {
        let stage = &self.stage;
        let key = ShadowKey {
            light: stage.scene.lights[lamp.light].view,
            recipe: *recipe,
            camera: recipe.is_fitted().then_some(stage.scene.camera),
        };
        let most = MOST * stage.lamps.len().max(1);
        let made = || lamp::shadow_of(stage, lamp, recipe).map(Arc::new);
        self.shadows.or_make(key, most, made).cloned()
    }

    /// The lit picture by maps.
    pub fn lit(&mut self, frame: &Frame, stop: &Stop) -> Result<Picture, Fault> {
        let mut shadows = Vec::new();
        for lamp in self.stage.lamps.clone() {
            check(stop)?;
            let recipe = self.stage.recipe_of(&lamp)?;
            shadows.push(self.shadow(&lamp, &recipe)?);
        }
        let shadows: Vec<&dyn Shadow> = shadows.iter().map(|made| &*made.shadow).collect();
        let picture = picture_by(&self.stage, &shadows, frame, |_| !stop.is_set());
        check(stop).map(|()| picture)
    }

    /// The fraction of one light in shadow, by maps.
    pub fn dark(&mut self, frame: &Frame, stop: &Stop) -> Result<Picture, Fault> {
        let lamp = one(&self.stage.scene, &self.stage.lamps)?.clone();
        let recipe = self.stage.recipe_of(&lamp)?;
        let made = self.shadow(&lamp, &recipe)?;
        let picture = shadow::drawn_where(&self.stage.scene, &lamp, &[&*made.shadow], frame, |_| !stop.is_set());
        check(stop).map(|()| picture)
    }

    /// The lit picture, or the fraction of one light in shadow, by rays.
    pub fn truth(&mut self, base: &Base, lit: bool, frame: &Frame, stop: &Stop) -> Result<&Picture, Fault> {
        let geometry = self.geometry(base);
        let frame = Frame { every_sample: true, ..*frame };
        let (stage, wanted) = (&self.stage, |_| !stop.is_set());
        let key = TruthKey::new(stage, lit, frame.axis * frame.axis);
        self.truths.get(key, || {
            let picture = if lit {
                let rays = stage.lamps.iter().map(|lamp| shadow::rays(stage, lamp, &geometry, None, &frame));
                let rays: Vec<Box<dyn Shadow + '_>> = rays.collect();
                let rays: Vec<&dyn Shadow> = rays.iter().map(|rays| &**rays).collect();
                picture_by(stage, &rays, &frame, wanted)
            } else {
                let lamp = one(&stage.scene, &stage.lamps)?;
                let rays = shadow::rays(stage, lamp, &geometry, None, &frame);
                shadow::drawn_where(&stage.scene, lamp, &[&*rays], &frame, wanted)
            };
            check(stop).map(|()| picture)
        })
    }

    /// One light's shadow against truth, as `umbrage compare` judges it.
    pub fn judged(&mut self, base: &Base, setting: &Setting, stop: &Stop) -> Result<Arc<Judged>, Fault> {
        let frame = base.frame(setting, false);
        let lamp = one(&self.stage.scene, &self.stage.lamps)?.clone();
        let recipe = self.stage.recipe_of(&lamp)?;
        let key = (TruthKey::new(&self.stage, false, setting.samples), recipe, setting.map_size);
        if let Ok(known) = self.judged.or_make(key.clone(), MOST, || Err(())) {
            return Ok(Arc::clone(known));
        }
        let truth = self.truth(base, false, &frame, stop)?.clone();
        let made = self.shadow(&lamp, &recipe)?;
        let unbiased = recipe.unbiased().map(|recipe| self.shadow(&lamp, &recipe)).transpose()?;
        check(stop)?;
        let mut shadows: Vec<&dyn Shadow> = vec![&*made.shadow];
        shadows.extend(unbiased.as_ref().map(|unbiased| &*unbiased.shadow));
        let scene = &self.stage.scene;
        let mut results = shadow::drawn_where(scene, &lamp, &shadows, &frame, |_| !stop.is_set()).shadow;
        check(stop)?;
        let geometry = self.geometry(base);
        let scene = &self.stage.scene;
        let rays = shadow::rays(&self.stage, &lamp, &geometry, None, &Frame { every_sample: true, ..frame });
        let view = &scene.lights[lamp.light].view;
        let rays = Until { shadow: &*rays, stop };
        let turned = Turned { shadow: &rays, light: view };
        let views = lamp.whole_views(scene);
        let judge = Judge::new((&scene.camera, views), &geometry, (&turned, &truth.shadow[0]), shadow::seen(&truth));
        let without = results.get(1).map(Vec::as_slice);
        let score = judge.score(&Drawn { result: &results[0], recipe: Some(&recipe), unbiased: without, again: &[] });
        check(stop)?;
        let pixels = judge.judged().to_vec();
        let judged = Judged { score, pixels, result: results.swap_remove(0), truth: truth.shadow[0].clone() };
        let judged = self.judged.or_make(key, MOST, || Ok::<_, Fault>(Arc::new(judged)))?;
        Ok(Arc::clone(judged))
    }
}
