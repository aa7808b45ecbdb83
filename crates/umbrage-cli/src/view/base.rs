//! The scene as given on the command line, and how a state of the page changes it.

use crate::args::{Cli, SceneArgs, ViewArgs};
use crate::lights::{self, Lamp};
use crate::memory::Need;
use crate::render;
use crate::shadow;
use crate::shell::Usage;
use crate::stage::{self, Stage};
use crate::turns;
use crate::values::{TurnLight, turn_light};
use anyhow::anyhow;
use glam::UVec2;
use umbrage_plane::View;
use umbrage_recipe::Recipe;
use umbrage_render::Frame;
use umbrage_scene::{Light, Scene};
use umbrage_view::{Show, State};

/// Most columns and rows of a picture that is drawn while something moves.
const DRAFT: u32 = 256;

/// What does not change while the page is open.
pub struct Base {
    pub source: String,
    /// The options of the command line, except the recipe, the lights and their turns, which the page changes.
    pub args: SceneArgs,
    pub samples: u32,
    pub seed: u32,
    pub max_memory: Option<u64>,
    /// The state that the command line gives.
    pub first: State,
    pub camera: View,
    pub lights: Vec<Light>,
    pub lamps: Vec<Lamp>,
    need: Need,
}

/// A valid state.
pub struct Setting {
    pub show: Show,
    pub recipe: Option<Recipe>,
    pub map_size: u32,
    pub lights: Vec<String>,
    pub turns: Vec<TurnLight>,
    pub samples: u32,
    pub wipe: bool,
    pub pixel: Option<[u32; 2]>,
}

impl Base {
    /// What a command line gives, over its scene before any light is turned.
    pub fn new(cli: &Cli, args: &ViewArgs, stage: &Stage) -> anyhow::Result<Self> {
        let recipe = args.scene.recipe.as_deref().map(|text| stage::recipe(text, args.scene.map_size)).transpose()?;
        let first = State {
            recipe: recipe.map(|recipe| recipe.to_string()),
            turns: args.scene.turn_light.iter().map(ToString::to_string).collect(),
            ..State::default()
        };
        let base = Self {
            source: args.source.clone(),
            args: args.scene.clone(),
            samples: args.samples,
            seed: cli.seed,
            max_memory: cli.max_memory,
            first,
            camera: stage.scene.camera,
            lights: stage.scene.lights.clone(),
            lamps: stage.lamps.clone(),
            need: stage.need,
        };
        for turn in &args.scene.turn_light {
            lights::check_name("--turn-light", &stage.scene, &base.lamps, &turn.name)?;
        }
        Ok(base)
    }

    /// Reads a state.
    ///
    /// # Errors
    /// One line that names what is invalid.
    pub fn setting(&self, state: &State) -> anyhow::Result<Setting> {
        let map_size = state.map_size.unwrap_or(self.args.map_size);
        let recipe = state.recipe.as_deref().map(|text| stage::recipe_text(text, map_size)).transpose()?;
        let turns =
            state.turns.iter().map(|text| turn_light(text).map_err(|problem| anyhow!("turn = {text:?}: {problem}")));
        let setting = Setting {
            show: state.show,
            recipe,
            map_size,
            lights: state.light.as_ref().map_or_else(|| self.args.light.clone(), |name| vec![name.clone()]),
            turns: turns.collect::<anyhow::Result<_>>()?,
            samples: state.samples.unwrap_or(self.samples),
            wipe: state.wipe.is_some(),
            pixel: state.pixel,
        };
        let names = setting.lights.iter().chain(setting.turns.iter().map(|turn| &turn.name));
        for name in names {
            if !self.lamps.iter().any(|lamp| lamp.name == *name || self.lights[lamp.light].name == *name) {
                let known: Vec<&str> = self.lamps.iter().map(|lamp| lamp.name.as_str()).collect();
                return Err(anyhow!("light {name:?}: the lights that cast shadows are {}", known.join(", ")));
            }
        }
        let size = self.camera.size();
        if let Some([x, y]) = setting.pixel.filter(|[x, y]| *x >= size.x || *y >= size.y) {
            return Err(anyhow!(
                "pixel = {x},{y}: the picture has {} columns and {} rows, counted from 0",
                size.x,
                size.y
            ));
        }
        Ok(setting)
    }

    /// Makes a stage show a setting: its objects are those of the command line's scene, all else is made anew.
    ///
    /// # Errors
    /// One line that names what is impossible.
    pub fn set(&self, stage: &mut Stage, setting: &Setting, draft: bool) -> anyhow::Result<()> {
        let mut lamps = self.lamps.clone();
        stage.scene.lights.clone_from(&self.lights);
        stage.scene.camera = if draft { stage::sized(&self.camera, small(self.camera.size()))? } else { self.camera };
        turns::turn(&mut stage.scene, &mut lamps, &setting.turns)?;
        stage.lamps = lights::wanted(&stage.scene, lamps, &setting.lights)?;
        stage.recipe = setting.recipe;
        stage.resize(setting.map_size)?;
        let maps: u64 = stage.lamps.iter().map(|lamp| lamp.views.len() as u64).sum();
        // A recipe's maps and the same without its bias, and pictures by maps and by rays.
        let texels = 2 * maps * u64::from(setting.map_size).pow(2);
        stage.need = Need { texels, samples: setting.samples, results: 3, ..self.need };
        stage.need.check(self.max_memory)?;
        if !setting.lights.is_empty() {
            render::keep_wanted(stage);
        }
        Ok(())
    }

    /// How a picture is sampled.
    pub fn frame(&self, setting: &Setting, draft: bool) -> Frame {
        let samples = if draft { 1 } else { setting.samples };
        shadow::frame(samples, self.seed, self.args.frame)
    }

    /// The recipe of the first light that is wanted, where the page names none.
    pub fn recipe_of_first(&self, wanted: &[String]) -> String {
        let is_wanted = |lamp: &&Lamp| {
            wanted.is_empty() || wanted.iter().any(|name| lamp.name == *name || self.light_name(lamp) == name)
        };
        let lamp = self.lamps.iter().find(is_wanted);
        let own = lamp.and_then(|lamp| self.lights[lamp.light].tree.as_ref()?.recipe());
        own.filter(|text| !text.is_empty()).map_or_else(|| Recipe::default().to_string(), str::to_owned)
    }

    /// The scene's own names.
    pub fn light_name<'a>(&'a self, lamp: &Lamp) -> &'a str {
        &self.lights[lamp.light].name
    }
}

/// The one lamp that a picture of one light is of.
///
/// # Errors
/// A scene that has several, or none.
pub fn one<'a>(scene: &Scene, lamps: &'a [Lamp]) -> anyhow::Result<&'a Lamp> {
    match lamps {
        [lamp] => Ok(lamp),
        [] => Err(Usage(format!("{}: no light casts shadows", scene.name)).into()),
        _ => {
            let names: Vec<&str> = lamps.iter().map(|lamp| lamp.name.as_str()).collect();
            Err(Usage(format!("light: this picture is of one light, choose one of {}", names.join(", "))).into())
        }
    }
}

/// A size of the same proportions that is drawn fast.
fn small(size: UVec2) -> UVec2 {
    let most = size.max_element();
    if most <= DRAFT {
        return size;
    }
    (size.as_dvec2() * (f64::from(DRAFT) / f64::from(most))).round().as_uvec2().max(UVec2::ONE)
}
