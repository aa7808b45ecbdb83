//! `umbrage shadow`.

use crate::args::{Cli, Format, SceneArgs, ShadowArgs, WindowArg};
use crate::draws::{Draws, Keep};
use crate::lights::Lamp;
use crate::report::Line;
use crate::shell::{Shell, Usage};
use crate::stage::{self, Stage};
use crate::takes::Take;
use crate::values::Area;
use crate::{lamp, names, pictures};
use glam::Vec3;
use serde_json::{Map, Value, json};
use std::fmt::Write as _;
use std::path::{Path, PathBuf};
use std::time::{Duration, Instant};
use umbrage_io::{encode_exr_values, encode_png_values};
use umbrage_oracle::judge::Seen;
use umbrage_oracle::{AreaLight, Geometry, RayCast, Truth};
use umbrage_plane::{SurfacePoint, View};
use umbrage_recipe::Recipe;
use umbrage_render::{Frame, Picture, picture_where};
use umbrage_sample::Key;
use umbrage_scene::Scene;
use umbrage_shadow::Shadow;

/// Rays toward the area of a light, for each sample of a picture with several samples for each pixel, and with one.
const AREA_RAYS: [u32; 2] = [4, 256];

pub fn run(cli: &Cli, args: &ShadowArgs, shell: &mut Shell<'_>) -> anyhow::Result<()> {
    let samples = args.samples.unwrap_or(if args.truth { 64 } else { 1 });
    let command = Shadows { cli, args, samples };
    pictures::run(cli, &args.takes, args.scene.frame, (&args.output, true), &command, shell)
}

struct Shadows<'a> {
    cli: &'a Cli,
    args: &'a ShadowArgs,
    samples: u32,
}

impl Draws for Shadows<'_> {
    fn options(&self) -> anyhow::Result<Map<String, Value>> {
        let ShadowArgs { format, window, area, truth, .. } = self.args;
        let area = match area {
            None => Value::Null,
            Some(Area::File) => json!("file"),
            Some(Area::Radius(radius)) => json!(radius),
        };
        let mut all = options(self.cli, &self.args.scene)?;
        for (name, value) in [
            ("samples", json!(self.samples)),
            ("format", json!(format.extension())),
            ("window", json!(if *window == WindowArg::Fitted { "fitted" } else { "file" })),
            ("area", area),
            ("truth", json!(truth)),
        ] {
            all.insert(name.into(), value);
        }
        Ok(all)
    }

    fn lights(&self, source: &str, shell: &mut Shell<'_>) -> anyhow::Result<Vec<Option<String>>> {
        let stage = self.stage(source, shell)?;
        Ok(stage.lamps.iter().map(|lamp| stage.part(lamp).map(str::to_owned)).collect())
    }

    fn file(&self, take: &Take, light: Option<&str>) -> PathBuf {
        let area = self.args.area.map(|_| "area");
        names::file(Path::new(""), &take.name, light, area.as_slice(), self.args.format.extension())
    }

    fn stage(&self, source: &str, shell: &mut Shell<'_>) -> anyhow::Result<Stage> {
        Stage::new(source, &self.args.scene, self.cli.max_memory, self.samples, shell)
    }

    fn draw(
        &self,
        stage: Stage,
        take: &Take,
        wanted: &dyn Fn(&Path) -> bool,
        keep: &mut Keep<'_>,
        shell: &mut Shell<'_>,
    ) -> anyhow::Result<Vec<Line>> {
        let args = self.args;
        let geometry = args.truth.then(|| Geometry::new(&stage.scene, &stage.scene.camera));
        let frame = frame(self.samples, self.cli.seed, take.frame);
        let encode = if args.format == Format::Png { encode_png_values } else { encode_exr_values };
        let of = |lamp| (self.file(take, stage.part(lamp)), lamp);
        let wanted: Vec<(PathBuf, &Lamp)> = stage.lamps.iter().map(of).filter(|(file, _)| wanted(file)).collect();
        let progress = shell.progress(wanted.len());
        let mut lines = Vec::new();
        for (file, lamp) in wanted {
            progress.set_message(format!("{}{}", take.label, lamp.name));
            let start = Instant::now();
            let area = area(&stage, lamp, args.area)?;
            let (mut picture, recipe, bytes, baked) = if let Some(geometry) = &geometry {
                let frame = Frame { every_sample: true, ..frame };
                let rays = rays(&stage, lamp, geometry, area, &frame);
                (drawn(&stage.scene, lamp, &[&*rays], &frame), "rays".into(), 0, Duration::ZERO)
            } else {
                let recipe = recipe(&stage.recipe_of(lamp)?, area, args.window)?;
                let made = lamp::shadow_of(&stage, lamp, &recipe)?;
                let baked = start.elapsed();
                let bytes = made.maps.iter().map(|map| map.bytes).sum();
                (drawn(&stage.scene, lamp, &[&*made.shadow], &frame), recipe.to_string(), bytes, baked)
            };
            let looked_up = start.elapsed().saturating_sub(baked);
            keep(file, encode(stage.scene.camera.size(), &picture.shadow.swap_remove(0)))?;
            lines.push(Line { light: lamp.name.clone(), recipe, bytes, baked, looked_up });
            progress.inc(1);
        }
        Ok(lines)
    }
}

/// What the pictures of any command depend on, by the names of the options.
///
/// # Errors
/// A recipe that cannot be read.
pub fn options(cli: &Cli, args: &SceneArgs) -> anyhow::Result<Map<String, Value>> {
    let SceneArgs { size, map_size, recipe, light, turn_light, camera, time, animation, frame: _ } = args;
    // A recipe's file may change, and its text may be written in several ways.
    let recipe = recipe.as_deref().map(|text| stage::recipe(text, *map_size)).transpose()?;
    let options = [
        ("seed", json!(cli.seed)),
        ("size", json!(size.map(|size| size.to_array()))),
        ("map-size", json!(map_size)),
        ("recipe", json!(recipe.map(|recipe| recipe.to_string()))),
        ("light", json!(light)),
        ("turn-light", json!(turn_light.iter().map(ToString::to_string).collect::<Vec<_>>())),
        ("camera", json!(camera)),
        ("time", json!(time)),
        ("animation", json!(animation)),
    ];
    Ok(options.map(|(name, value)| (name.to_owned(), value)).into_iter().collect())
}

/// This many samples for each pixel; one is its centre.
pub fn frame(samples: u32, seed: u32, number: u32) -> Frame {
    if samples == 1 {
        return Frame { seed, number, ..Frame::CENTRES };
    }
    Frame { axis: samples.isqrt(), seed, number, ..Frame::default() }
}

/// The radius of a light to filter for: world units, or the tangent of a sun's angle.
///
/// # Errors
/// A light without a radius where the scene's is needed.
pub fn area(stage: &Stage, lamp: &Lamp, area: Option<Area>) -> anyhow::Result<Option<f64>> {
    let radius = match area {
        None => return Ok(None),
        Some(Area::File) => lamp.radius,
        Some(Area::Radius(radius)) => radius,
    };
    if radius <= 0.0 {
        let problem = "the scene gives it no radius: --area=RADIUS does";
        return Err(Usage(format!("--area: light {:?}: {problem}", lamp.name)).into());
    }
    let is_sun = !stage.scene.lights[lamp.light].view.is_perspective();
    Ok(Some(if is_sun { radius.tan() } else { radius }))
}

/// A recipe with the window and the size of the light that the command line names.
///
/// # Errors
/// A recipe without fields for them.
pub fn recipe(recipe: &Recipe, area: Option<f64>, window: WindowArg) -> anyhow::Result<Recipe> {
    let mut text = recipe.to_string();
    if window == WindowArg::Fitted {
        text += ",window=fitted";
    }
    if let Some(radius) = area {
        let _ = write!(text, ",light={radius}");
    }
    text.parse().map_err(|error| Usage(format!("recipe {text}: {error}")).into())
}

/// The scene under this many copies of one of its lights, with all objects receiving the shadow.
pub fn lit_alone(scene: &Scene, lamp: &Lamp, copies: usize) -> Scene {
    let mut one = Scene { lights: vec![scene.lights[lamp.light].clone(); copies], ..scene.clone() };
    one.objects.iter_mut().for_each(|object| object.receives = true);
    one
}

/// The picture under one light: the fraction in shadow of each pixel, once by each of several shadows of it.
pub fn drawn(scene: &Scene, lamp: &Lamp, shadows: &[&dyn Shadow], frame: &Frame) -> Picture {
    drawn_where(scene, lamp, shadows, frame, |_| true)
}

/// The same of the pixels that `wanted` accepts by their index.
pub fn drawn_where(
    scene: &Scene,
    lamp: &Lamp,
    shadows: &[&dyn Shadow],
    frame: &Frame,
    wanted: impl Fn(u32) -> bool + Sync,
) -> Picture {
    let one = lit_alone(scene, lamp, shadows.len());
    let light = &scene.lights[lamp.light];
    let turned: Vec<Turned<'_>> = shadows.iter().map(|shadow| Turned { shadow: *shadow, light: &light.view }).collect();
    let turned: Vec<&dyn Shadow> = turned.iter().map(|turned| turned as &dyn Shadow).collect();
    picture_where(&one, &turned, frame, wanted)
}

/// What a judge knows of a picture under one light.
pub fn seen(picture: &Picture) -> Seen<'_> {
    Seen {
        position: &picture.position,
        normal: &picture.normal,
        object: &picture.object,
        share: &picture.share,
        facing: &picture.facing[0],
    }
}

/// Rays toward a light, all of its area where it is given one.
pub fn rays<'a>(
    stage: &Stage,
    lamp: &Lamp,
    geometry: &'a Geometry,
    area: Option<f64>,
    frame: &Frame,
) -> Box<dyn Shadow + 'a> {
    let view = &stage.scene.lights[lamp.light].view;
    let all_around = lamp.views.len() > 1 && view.cone().is_none();
    let ray = if all_around { RayCast::everywhere(geometry, view.light()) } else { RayCast::new(geometry, view) };
    let ray = ray.with(Truth { look_everywhere: true, ..Truth::default() });
    match area {
        None => Box::new(ray),
        Some(radius) => {
            let rays = AREA_RAYS[usize::from(frame.axis == 1)];
            Box::new(AreaLight::new(ray, radius).with_samples(rays))
        }
    }
}

/// A shadow in which surfaces that face away from the light are dark, whatever maps hold for them.
pub struct Turned<'a> {
    pub shadow: &'a dyn Shadow,
    pub light: &'a View,
}

impl Shadow for Turned<'_> {
    fn fractions(&self, at: &[SurfacePoint], key: Key, out: &mut [f32]) {
        self.shadow.fractions(at, key, out);
        for (point, fraction) in at.iter().zip(out) {
            if point.normal.as_dvec3().dot(self.light.toward_eye(point.position)) <= 0.0 {
                *fraction = 1.0;
            }
        }
    }

    fn transmittances(&self, at: &[SurfacePoint], key: Key, fractions: &[f32], out: &mut [Vec3]) {
        self.shadow.transmittances(at, key, fractions, out);
    }
}
