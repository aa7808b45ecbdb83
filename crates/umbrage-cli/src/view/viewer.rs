//! Pictures and explanations for the page.

use super::base::{Base, Setting};
use super::held::{Fault, Held};
use super::truths::Judged;
use super::{command, table};
use crate::args::{Cli, SceneArgs, ViewArgs};
use crate::explain::{Lit, Region};
use crate::paint::{self, FAULTS};
use crate::scores::rounded;
use crate::shell::Shell;
use crate::stage::Stage;
use glam::Vec3;
use serde_json::{Map, Value, json};
use std::sync::{Mutex, MutexGuard, PoisonError};
use std::time::Instant;
use umbrage_io::{encode_png, encode_png_grey};
use umbrage_oracle::heat;
use umbrage_scene::Bearing;
use umbrage_view::{Answers, Ask, Of, Picture, Refusal, Show, State, Stop};

pub struct Viewer {
    base: Base,
    held: Mutex<Held>,
}

impl Viewer {
    /// Reads the scene, once.
    ///
    /// # Errors
    /// One line that names what is wrong with the scene or with the options.
    pub fn new(cli: &Cli, args: &ViewArgs, shell: &mut Shell<'_>) -> anyhow::Result<Self> {
        // The page turns lights from where the scene has them, and changes recipes.
        let plain = SceneArgs { recipe: None, turn_light: Vec::new(), ..args.scene.clone() };
        let stage = Stage::new(&args.source, &plain, cli.max_memory, args.samples, shell)?;
        let base = Base::new(cli, args, &stage)?;
        let viewer = Self { base, held: Mutex::new(Held::new(stage)) };
        // The command line is checked before anybody opens the page.
        let first = viewer.base.setting(&viewer.base.first)?;
        viewer.base.set(&mut viewer.held().stage, &first, false)?;
        Ok(viewer)
    }

    /// Usable even after a panic: no picture relies on the state that the last one left.
    fn held(&self) -> MutexGuard<'_, Held> {
        self.held.lock().unwrap_or_else(PoisonError::into_inner)
    }

    fn drawn(&self, ask: &Ask, stop: &Stop) -> Result<Picture, Fault> {
        let base = &self.base;
        let setting = base.setting(&ask.state)?;
        let mut held = self.held();
        // The request that waited for the scene may have been dropped meanwhile.
        stop.check().map_err(|_| Fault::Stopped)?;
        let start = Instant::now();
        base.set(&mut held.stage, &setting, ask.draft)?;
        let (size, frame) = (held.stage.scene.camera.size(), base.frame(&setting, ask.draft));
        let by_rays = ask.of == Of::Truth || setting.show == Show::Truth;
        let of_light =
            |shadow: &[f32]| encode_png_grey(size, &shadow.iter().map(|dark| 1.0 - dark).collect::<Vec<_>>());
        let mut about = Map::new();
        let png = match setting.show {
            Show::Picture | Show::Truth if by_rays => encode_png(size, &held.truth(base, true, &frame, stop)?.colour),
            Show::Picture | Show::Truth => encode_png(size, &held.lit(&frame, stop)?.colour),
            _ if by_rays => of_light(&held.truth(base, false, &frame, stop)?.shadow[0]),
            // Slow judgements are left out while something moves.
            show if show == Show::Shadow || ask.draft => of_light(&held.dark(&frame, stop)?.shadow[0]),
            show => {
                let judged = held.judged(base, &setting, stop)?;
                about = numbers(&judged);
                encode_png(size, &coloured(show, &judged))
            }
        };
        let png = png.map_err(|fault| anyhow::anyhow!("the picture: {fault:?}"))?;
        about.insert("ms".into(), json!((start.elapsed().as_secs_f64() * 1e4).round() / 10.0));
        about.insert("size".into(), json!(size.to_array()));
        Ok(Picture { png, about: Value::Object(about).to_string() })
    }

    fn explained(&self, setting: &Setting, stop: &Stop) -> Result<String, Fault> {
        let base = &self.base;
        let pixel = setting.pixel.ok_or_else(|| anyhow::anyhow!("pixel: expected X,Y"))?;
        let mut held = self.held();
        stop.check().map_err(|_| Fault::Stopped)?;
        base.set(&mut held.stage, setting, false)?;
        let geometry = held.geometry(base);
        let mut lights = Vec::new();
        for lamp in held.stage.lamps.clone() {
            let recipe = held.stage.recipe_of(&lamp)?;
            let made = held.shadow(&lamp, &recipe)?;
            let frame = base.frame(setting, false);
            let light = Lit::new(&held.stage, &lamp, &recipe, &*made.shadow, frame, &geometry);
            for words in light.explained(&[pixel])? {
                let fault = words.regions.iter().find_map(|region| region.fault.as_ref());
                let (fault, drawn) =
                    (fault.map(crate::explain::Fault::name), words.regions.first().and_then(Region::drawn));
                lights.push(json!({ "light": lamp.name, "words": words.to_string(), "fault": fault, "svg": drawn }));
            }
        }
        Ok(json!({ "pixel": pixel, "lights": lights }).to_string())
    }
}

impl Answers for Viewer {
    fn about(&self) -> String {
        let Base { source, args, samples, first, camera, lamps, .. } = &self.base;
        let lights = lamps.iter().map(|lamp| {
            let light = &self.base.lights[lamp.light];
            let kind = match (light.view.is_perspective(), lamp.views.len()) {
                (false, _) => "sun",
                (true, 1) => "lamp",
                (true, _) => "lamp all around",
            };
            let Bearing { azimuth_deg, elevation_deg } = Bearing::of(-light.view.ahead());
            let name = self.base.light_name(lamp);
            json!({ "name": lamp.name, "own": name, "kind": kind, "azimuth": azimuth_deg, "elevation": elevation_deg })
        });
        let own = |light: &umbrage_scene::Light| {
            light.tree.as_ref().and_then(|tree| tree.recipe()).is_some_and(|text| !text.is_empty())
        };
        json!({
            "version": env!("CARGO_PKG_VERSION"),
            "scene": source,
            "size": camera.size().to_array(),
            "mapSize": args.map_size,
            "samples": samples,
            "lights": lights.collect::<Vec<_>>(),
            "ownRecipes": self.base.lights.iter().any(own),
            "first": first.query(),
            "recipes": table::recipes(),
        })
        .to_string()
    }

    fn lines(&self, state: &State) -> Result<String, Refusal> {
        let lines = self.base.setting(state).map(|setting| command::lines(&self.base, &setting));
        let lines = lines.map_err(|error| Refusal::Wrong(crate::shell::line(&error)))?;
        let lines: Vec<Value> = lines.into_iter().map(|(what, line)| json!({ "what": what, "line": line })).collect();
        Ok(json!({ "lines": lines }).to_string())
    }

    fn picture(&self, ask: &Ask, stop: &Stop) -> Result<Picture, Refusal> {
        Ok(self.drawn(ask, stop)?)
    }

    fn explanation(&self, state: &State, stop: &Stop) -> Result<String, Refusal> {
        let setting = self.base.setting(state).map_err(Fault::Error)?;
        Ok(self.explained(&setting, stop)?)
    }
}

/// The faults in colours, or how much lighter and darker than truth each pixel is.
fn coloured(show: Show, judged: &Judged) -> Vec<Vec3> {
    let Judged { score, pixels, result, truth } = judged;
    let places = &score.places;
    let none = || vec![false; truth.len()];
    let one = |fault: &[bool], colour: usize| paint::one(fault, FAULTS[colour].2, pixels, truth);
    match show {
        Show::Acne => one(&places.acne, 0),
        Show::Detachment => one(&places.detachment.clone().unwrap_or_else(none), 1),
        Show::Leak => one(&places.leak.clone().unwrap_or_else(none), 2),
        Show::FalseShadow => paint::one(&places.false_shadow, FAULTS[0].2, pixels, truth),
        Show::FalseLight => paint::one(&places.false_light, FAULTS[1].2, pixels, truth),
        Show::Difference => result.iter().zip(truth).map(|(own, truth)| heat(own - truth)).collect(),
        _ => paint::all(places, pixels, truth),
    }
}

/// The percentages of the faults, as text for people.
fn numbers(judged: &Judged) -> Map<String, Value> {
    let score = &judged.score;
    let share = |share: Option<f64>| share.map(|share| format!("{}%", rounded(100.0 * share)));
    let rows = [
        ("false shadow", share(score.false_shadow)),
        ("false light", share(score.false_light)),
        ("acne", share(score.acne)),
        ("detachment", share(score.detachment)),
        ("leak", share(score.leak)),
        ("rms", score.rms.map(rounded)),
    ];
    let rows: Vec<Value> = rows.into_iter().map(|(name, value)| json!([name, value])).collect();
    let mut about = Map::new();
    about.insert("faults".into(), json!(rows));
    about.insert("judged".into(), json!(score.judged));
    about
}
