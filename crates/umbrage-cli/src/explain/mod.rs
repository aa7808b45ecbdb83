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
        for words in light.explained(&args.pixel)? {
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
        Self { stage, lamp, recipe: *recipe, shadow, frame, geometry }
    }

    /// The explanations of pixels inside the picture, in their order. All of them are drawn at once.
    ///
    /// # Errors
    /// A recipe that cannot be used without its bias.
    pub fn explained(&self, pixels: &[[u32; 2]]) -> anyhow::Result<Vec<Words<'_>>> {
        let camera = &self.stage.scene.camera;
        let indices: Vec<u32> = pixels.iter().map(|at| at[1] * camera.size().x + at[0]).collect();
        let recorder = Recorder::new(self.shadow);
        let values = self.drawn(&recorder, &self.frame, &indices);
        let asked = recorder.asked()?;
        let rays = self.rays();
        let exact = self.drawn(&*rays, &Frame { every_sample: true, ..self.frame }, &indices);
        let light = &self.stage.scene.lights[self.lamp.light].view;
        let turned = Turned { shadow: &*rays, light };
        let views = self.lamp.whole_views(&self.stage.scene);
        let judge = Judge::new((camera, views), self.geometry, (&turned, &exact.shadow[0]), shadow::seen(&exact));
        let unbiased = OnceCell::new();
        let words = |(at, index): (&[u32; 2], &u32)| {
            let pixel = *index as usize;
            let (value, truth) = (values.shadow[0][pixel], exact.shadow[0][pixel]);
            let own = |asked: &&Asked| asked.is_of(*index);
            let mut regions: Vec<Region> = asked.iter().filter(own).map(|asked| self.region(asked)).collect();
            let unjudged = judge.unjudged(pixel);
            if unjudged.is_none() {
                let without_bias = || {
                    if unbiased.get().is_none() {
                        let _ = unbiased.set(self.without_bias(&indices)?);
                    }
                    let picture: Option<&Picture> = unbiased.get().and_then(Option::as_ref);
                    Ok(picture.map(|picture| picture.shadow[0][pixel]))
                };
                for region in &mut regions {
                    let passes = || judge.bias_passes(pixel, &self.recipe);
                    region.fault = fault::of(&region.answers(value, truth), without_bias, passes)?;
                }
            }
            let (light, recipe) = (&*self.lamp.name, self.recipe.to_string());
            Ok(Words { at: *at, light, recipe, value, truth, unjudged, regions })
        };
        pixels.iter().zip(&indices).map(words).collect()
    }

    /// The truth.
    fn rays(&self) -> Box<dyn Shadow + '_> {
        shadow::rays(self.stage, self.lamp, self.geometry, None, &self.frame)
    }

    /// The picture that `umbrage shadow` draws, of some pixels.
    fn drawn(&self, shadow: &dyn Shadow, frame: &Frame, indices: &[u32]) -> Picture {
        shadow::drawn_where(&self.stage.scene, self.lamp, &[shadow], frame, |index| indices.contains(&index))
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

    /// Some pixels by the same recipe without a bias; `None` for a recipe that has no bias.
    fn without_bias(&self, indices: &[u32]) -> anyhow::Result<Option<Picture>> {
        let Some(recipe) = self.recipe.unbiased() else { return Ok(None) };
        let made = lamp::shadow_of(self.stage, self.lamp, &recipe)?;
        Ok(Some(self.drawn(&*made.shadow, &self.frame, indices)))
    }
}
