//! `umbrage shadow`.

use crate::args::{Area, Cli, Format, ShadowArgs, WindowArg};
use crate::shell::{Shell, Usage};
use crate::stage::{Lamp, Stage};
use crate::{lamp, names};
use glam::{UVec2, Vec3};
use serde_json::json;
use std::fmt::Write as _;
use std::path::{Path, PathBuf};
use std::time::{Duration, Instant};
use umbrage_io::{IoError, create_folder, encode_exr_values, encode_png_values, write_bytes};
use umbrage_oracle::{AreaLight, Geometry, RayCast, Truth};
use umbrage_plane::{SurfacePoint, View};
use umbrage_recipe::Recipe;
use umbrage_render::{Frame, picture};
use umbrage_sample::Key;
use umbrage_scene::Scene;
use umbrage_shadow::Shadow;

/// Rays toward the area of a light, for each sample of a picture with several samples for each pixel, and with one.
const AREA_RAYS: [u32; 2] = [4, 256];

pub fn run(cli: &Cli, args: &ShadowArgs, shell: &mut Shell<'_>) -> anyhow::Result<()> {
    let samples = args.samples.unwrap_or(if args.truth { 64 } else { 1 });
    let stage = Stage::new(&args.scene, cli.max_memory, samples, shell)?;
    create_folder(&args.output)?;
    let geometry = args.truth.then(|| Geometry::new(&stage.scene, &stage.scene.camera));
    let frame = frame(samples, cli.seed, args.scene.frame);
    let (mut files, mut lines) = (Vec::new(), Vec::new());
    let progress = shell.progress(stage.lamps.len());
    for lamp in &stage.lamps {
        progress.set_message(lamp.name.clone());
        let start = Instant::now();
        let (fractions, name, bytes, baked) = if let Some(geometry) = &geometry {
            let frame = Frame { every_sample: true, ..frame };
            (by_rays(&stage, lamp, geometry, area(&stage, lamp, args)?, &frame), "rays".into(), 0, Duration::ZERO)
        } else {
            let recipe = recipe(&stage.recipe_of(lamp)?, area(&stage, lamp, args)?, args.window)?;
            let made = lamp::shadow_of(&stage, lamp, &recipe)?;
            let baked = start.elapsed();
            let bytes = made.maps.iter().map(|map| map.bytes).sum();
            (drawn(&stage.scene, lamp, &*made.shadow, &frame), recipe.to_string(), bytes, baked)
        };
        let looked_up = start.elapsed().saturating_sub(baked);
        let (extension, area) = (if args.format == Format::Png { "png" } else { "exr" }, args.area.map(|_| "area"));
        let path = names::file(&args.output, &stage.scene.name, stage.part(lamp), area.as_slice(), extension);
        write(&path, args.format, stage.scene.camera.size(), &fractions)?;
        files.push(path);
        lines.push((lamp.name.clone(), name, bytes, baked, looked_up));
        progress.inc(1);
    }
    drop(progress);
    report(cli, shell, &files, lines)
}

/// So many samples for each pixel; one is its centre.
pub fn frame(samples: u32, seed: u32, number: u32) -> Frame {
    if samples == 1 {
        return Frame { seed, number, ..Frame::CENTRES };
    }
    Frame { axis: samples.isqrt(), seed, number, ..Frame::default() }
}

/// The radius of a light that is to be filtered for: world units, or the tangent of a sun's angle.
fn area(stage: &Stage, lamp: &Lamp, args: &ShadowArgs) -> anyhow::Result<Option<f64>> {
    let radius = match args.area {
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
fn recipe(recipe: &Recipe, area: Option<f64>, window: WindowArg) -> anyhow::Result<Recipe> {
    let mut text = recipe.to_string();
    if window == WindowArg::Fitted {
        text += ",window=fitted";
    }
    if let Some(radius) = area {
        let _ = write!(text, ",light={radius}");
    }
    text.parse().map_err(|error| Usage(format!("recipe {text}: {error}")).into())
}

/// The fraction in shadow of each pixel, by one light.
fn drawn(scene: &Scene, lamp: &Lamp, shadow: &dyn Shadow, frame: &Frame) -> Vec<f32> {
    let mut one = Scene { lights: vec![scene.lights[lamp.light].clone()], ..scene.clone() };
    one.objects.iter_mut().for_each(|object| object.receives = true);
    let turned = Turned { shadow, light: &one.lights[0].view.clone() };
    picture(&one, &[&turned], frame).shadow.swap_remove(0)
}

fn by_rays(stage: &Stage, lamp: &Lamp, geometry: &Geometry, area: Option<f64>, frame: &Frame) -> Vec<f32> {
    let view = &stage.scene.lights[lamp.light].view;
    let all_around = lamp.views.len() > 1 && view.cone().is_none();
    let ray = if all_around { RayCast::everywhere(geometry, view.light()) } else { RayCast::new(geometry, view) };
    let ray = ray.with(Truth { look_everywhere: true, ..Truth::default() });
    match area {
        None => drawn(&stage.scene, lamp, &ray, frame),
        Some(radius) => {
            let rays = AREA_RAYS[usize::from(frame.axis == 1)];
            drawn(&stage.scene, lamp, &AreaLight::new(ray, radius).with_samples(rays), frame)
        }
    }
}

/// A shadow in which surfaces that face away from the light are dark, whatever maps say of them.
struct Turned<'a> {
    shadow: &'a dyn Shadow,
    light: &'a View,
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

fn write(path: &Path, format: Format, size: UVec2, fractions: &[f32]) -> Result<(), IoError> {
    let bytes = match format {
        Format::Png => encode_png_values(size, fractions),
        Format::Exr => encode_exr_values(size, fractions),
    };
    let bytes = bytes.map_err(|fault| IoError::Content { file: path.display().to_string(), fault })?;
    write_bytes(path, &bytes)
}

/// What was done for one light: its name, the algorithm, bytes of its maps, and how long maps and look-ups took.
type Line = (String, String, usize, Duration, Duration);

/// Says what was written: as JSON on stdout where that is wanted, and one line for each light for people.
pub fn report(
    cli: &Cli,
    shell: &mut Shell<'_>,
    files: &[PathBuf],
    lines: impl IntoIterator<Item = Line>,
) -> anyhow::Result<()> {
    let milliseconds = |time: Duration| (time.as_secs_f64() * 1e5).round() / 1e2;
    let mut lights = Vec::new();
    for (name, recipe, bytes, baked, looked_up) in lines {
        shell.note(&format!(
            "{name}: {recipe}, {bytes} bytes, baked in {} ms, looked up in {} ms",
            milliseconds(baked),
            milliseconds(looked_up)
        ));
        lights.push(json!({
            "light": name, "recipe": recipe, "bytes": bytes,
            "bake_ms": milliseconds(baked), "lookup_ms": milliseconds(looked_up),
        }));
    }
    let files: Vec<String> = files.iter().map(|file| file.display().to_string()).collect();
    if cli.json {
        writeln!(shell.out, "{}", json!({ "files": files, "lights": lights }))?;
    }
    Ok(())
}
