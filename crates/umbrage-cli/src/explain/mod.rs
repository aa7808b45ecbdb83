//! `umbrage explain`.

mod asked;
mod fault;
mod owners;
mod region;
mod svg;
mod words;

use crate::args::{Cli, ExplainArgs};
use crate::lamp;
use crate::lights::Lamp;
use crate::shadow::{self, Turned};
use crate::shell::{Shell, Usage};
use crate::stage::Stage;
use anyhow::Context;
use asked::{Asked, Recorder};
pub use fault::Fault;
use owners::Owners;
pub use region::Region;
use serde_json::json;
use std::cell::OnceCell;
use umbrage_io::write_bytes;
use umbrage_oracle::Geometry;
use umbrage_oracle::judge::Judge;
use umbrage_plane::TexelRect;
use umbrage_recipe::Recipe;
use umbrage_render::{Frame, Picture};
use umbrage_shadow::{Explanation, Shadow};
pub use words::Words;

pub fn run(cli: &Cli, args: &ExplainArgs, shell: &mut Shell<'_>) -> anyhow::Result<()> {
    let stage = Stage::new(&args.source, &args.scene, cli.max_memory, args.samples, shell)?;
    let size = stage.scene.camera.size();
    if let Some([x, y]) = args.pixel.iter().find(|[x, y]| *x >= size.x || *y >= size.y) {
        let problem =
            format!("--pixel {x},{y}: the picture has {} columns and {} rows, counted from 0", size.x, size.y);
        return Err(Usage(problem).into());
    }
    if args.output.is_some() && (stage.lamps.len() > 1 || args.pixel.len() > 1) {
        return Err(Usage("-o: one pixel is drawn under one light; --light NAME chooses it".into()).into());
    }
    let geometry = Geometry::new(&stage.scene, &stage.scene.camera);
    let mut all = Vec::new();
    for lamp in &stage.lamps {
        let recipe = stage.recipe_of(lamp)?;
        let shadow = lamp::shadow_of(&stage, lamp, &recipe)?.shadow;
        let frame = shadow::frame(args.samples, cli.seed, args.scene.frame);
        let light = Lit::new(&stage, lamp, &recipe, &*shadow, frame, &geometry);
        for &at in &args.pixel {
            let words = light.explained(at)?;
            if let Some(path) = &args.output {
                let drawn = words.regions.first().context("-o: the pixel sees nothing")?.drawn();
                write_bytes(path, drawn.context("-o: no texel was read")?.as_bytes())?;
            }
            if cli.json {
                all.push(words.json());
            } else {
                write!(shell.out, "{words}")?;
            }
        }
    }
    if cli.json {
        writeln!(shell.out, "{}", json!({ "pixels": all }))?;
    }
    Ok(())
}

/// A light whose shadow is explained.
pub struct Lit<'a> {
    stage: &'a Stage,
    lamp: &'a Lamp,
    recipe: Recipe,
    shadow: &'a dyn Shadow,
    /// The same without a bias, made when it is needed; `None` for a recipe that has no bias.
    unbiased: OnceCell<Option<Box<dyn Shadow>>>,
    frame: Frame,
    geometry: &'a Geometry,
}

impl<'a> Lit<'a> {
    /// A lamp of a stage under a recipe's shadow, seen by a frame.
    pub fn new(
        stage: &'a Stage,
        lamp: &'a Lamp,
        recipe: &Recipe,
        shadow: &'a dyn Shadow,
        frame: Frame,
        geometry: &'a Geometry,
    ) -> Self {
        Self { stage, lamp, recipe: *recipe, shadow, unbiased: OnceCell::new(), frame, geometry }
    }

    /// The explanation of a pixel inside the picture.
    ///
    /// # Errors
    /// A recipe that cannot be used without its bias.
    pub fn explained(&self, at: [u32; 2]) -> anyhow::Result<Words<'_>> {
        let camera = &self.stage.scene.camera;
        let index = at[1] * camera.size().x + at[0];
        let recorder = Recorder::new(self.shadow);
        let value = self.pixel(&recorder, &self.frame, index).shadow[0][index as usize];
        let rays = self.rays();
        let exact = self.pixel(&*rays, &Frame { every_sample: true, ..self.frame }, index);
        let truth = exact.shadow[0][index as usize];
        let mut regions: Vec<Region> = recorder.asked()?.iter().map(|asked| self.region(asked)).collect();
        let light = &self.stage.scene.lights[self.lamp.light].view;
        let turned = Turned { shadow: &*rays, light };
        let views = self.lamp.whole_views(&self.stage.scene);
        let judge = Judge::new((camera, views), self.geometry, (&turned, &exact.shadow[0]), shadow::seen(&exact));
        let unjudged = judge.unjudged(index as usize);
        if unjudged.is_none() {
            for region in &mut regions {
                let passes = || judge.bias_passes(index as usize, &self.recipe);
                region.fault = fault::of(&region.answers(value, truth), || self.without_bias(index), passes)?;
            }
        }
        Ok(Words { at, light: &self.lamp.name, recipe: self.recipe.to_string(), value, truth, unjudged, regions })
    }

    /// The truth.
    fn rays(&self) -> Box<dyn Shadow + '_> {
        shadow::rays(self.stage, self.lamp, self.geometry, None, &self.frame)
    }

    /// The picture that `umbrage shadow` draws, of one pixel.
    fn pixel(&self, shadow: &dyn Shadow, frame: &Frame, index: u32) -> Picture {
        shadow::drawn_where(&self.stage.scene, self.lamp, &[shadow], frame, |other| other == index)
    }

    fn region(&self, asked: &Asked) -> Region {
        let scene = &self.stage.scene;
        let name =
            |object: u32| scene.objects.get(object as usize).map_or_else(String::new, |object| object.name.clone());
        let owned = |explanation: Explanation| {
            let window = svg::window(&explanation).unwrap_or(TexelRect::EMPTY);
            let owners = Owners::of(scene, &explanation.view, window);
            (explanation, owners)
        };
        let maps = self.shadow.explain(&asked.point, asked.key).into_iter().map(owned).collect();
        let light = &scene.lights[self.lamp.light].view;
        let blockers = asked::blockers(self.geometry, &asked.point, light.light()).into_iter();
        Region {
            asked: *asked,
            object: name(asked.point.object),
            fraction: asked.fraction,
            maps,
            blockers: blockers.map(|(object, distance)| (name(object), distance)).collect(),
            truth: self.rays().fraction(&asked.point, asked.key),
            cosine: asked.point.normal.as_dvec3().dot(light.toward_eye(asked.point.position)),
            fault: None,
        }
    }

    /// A pixel by the same recipe without a bias.
    fn without_bias(&self, index: u32) -> anyhow::Result<Option<f32>> {
        if self.unbiased.get().is_none() {
            let recipe = self.recipe.unbiased();
            let made = recipe.map(|recipe| lamp::shadow_of(self.stage, self.lamp, &recipe)).transpose()?;
            let _ = self.unbiased.set(made.map(|made| made.shadow));
        }
        let unbiased = self.unbiased.get().and_then(Option::as_ref);
        Ok(unbiased.map(|shadow| self.pixel(&**shadow, &self.frame, index).shadow[0][index as usize]))
    }
}
