//! `umbrage render`.

use crate::args::{Cli, Format, RenderArgs};
use crate::draws::{Draws, Keep};
use crate::lights::Lamp;
use crate::report::Line;
use crate::shadow::{frame, options, rays};
use crate::shell::{Shell, Usage};
use crate::stage::Stage;
use crate::takes::Take;
use crate::{lamp, names, pictures};
use serde_json::{Map, Value, json};
use std::path::{Path, PathBuf};
use std::time::Instant;
use umbrage_io::{encode_exr, encode_png};
use umbrage_oracle::Geometry;
use umbrage_render::{Frame, Picture, picture_where};
use umbrage_shadow::{Shadow, Unshadowed};

pub fn run(cli: &Cli, args: &RenderArgs, shell: &mut Shell<'_>) -> anyhow::Result<()> {
    let format = check(args, args.takes.are_several())?;
    let into = (args.output.as_path(), args.takes.are_several());
    pictures::run(cli, &args.takes, args.scene.frame, into, &Render { cli, args, format }, shell)
}

/// The format of the pictures, one or those of a folder.
///
/// # Errors
/// An output that does not fit what is drawn.
pub fn check(args: &RenderArgs, fills_a_folder: bool) -> anyhow::Result<Format> {
    let output = args.output.display();
    let no = |problem: &str| Err(Usage(format!("--output {output}: {problem}")).into());
    if fills_a_folder {
        let is_written_as_folder = output.to_string().ends_with(std::path::is_separator);
        if !is_written_as_folder && !args.output.is_dir() {
            return no("expected a folder, which exists or ends in /, for several scenes, frames or shards");
        }
        return Ok(args.format.unwrap_or(Format::Png));
    }
    let extension = args.output.extension().and_then(|extension| extension.to_str()).map(str::to_ascii_lowercase);
    let format = match extension.as_deref() {
        Some("png") => Format::Png,
        Some("exr") => Format::Exr,
        _ => return no("expected .png or .exr"),
    };
    if args.format.is_some_and(|wanted| wanted != format) {
        return no("its extension is not that of --format");
    }
    Ok(format)
}

struct Render<'a> {
    cli: &'a Cli,
    args: &'a RenderArgs,
    format: Format,
}

impl Draws for Render<'_> {
    fn options(&self) -> anyhow::Result<Map<String, Value>> {
        let mut all = options(self.cli, &self.args.scene)?;
        all.insert("samples".into(), json!(self.args.samples));
        all.insert("format".into(), json!(self.format.extension()));
        all.insert("truth".into(), json!(self.args.truth));
        Ok(all)
    }

    fn lights(&self, _: &str, _: &mut Shell<'_>) -> anyhow::Result<Vec<Option<String>>> {
        Ok(vec![None])
    }

    fn file(&self, take: &Take, light: Option<&str>) -> PathBuf {
        names::file(Path::new(""), &take.name, light, &[], self.format.extension())
    }

    fn stage(&self, source: &str, shell: &mut Shell<'_>) -> anyhow::Result<Stage> {
        Stage::new(source, &self.args.scene, self.cli.max_memory, self.args.samples, shell)
    }

    fn draw(
        &self,
        mut stage: Stage,
        take: &Take,
        _: &dyn Fn(&Path) -> bool,
        keep: &mut Keep<'_>,
        shell: &mut Shell<'_>,
    ) -> anyhow::Result<Vec<Line>> {
        if !self.args.scene.light.is_empty() {
            keep_wanted(&mut stage);
        }
        let start = Instant::now();
        let progress = shell.progress(stage.lamps.len() + 1);
        let geometry = self.args.truth.then(|| Geometry::new(&stage.scene, &stage.scene.camera));
        let frame = frame(self.args.samples, self.cli.seed, take.frame);
        let frame = Frame { every_sample: self.args.truth, ..frame };
        let made = stage.lamps.iter().map(|lamp| {
            progress.set_message(format!("{}{}", take.label, lamp.name));
            let made = match &geometry {
                Some(geometry) => {
                    Light { recipe: "rays".into(), bytes: 0, shadow: rays(&stage, lamp, geometry, None, &frame) }
                }
                None => Light::new(&stage, lamp)?,
            };
            progress.inc(1);
            Ok(made)
        });
        let made = made.collect::<anyhow::Result<Vec<_>>>()?;
        let baked = start.elapsed();
        progress.set_message(format!("{}picture", take.label));
        let start = Instant::now();
        let shadows: Vec<&dyn Shadow> = made.iter().map(|light| &*light.shadow).collect();
        let image = picture_by(&stage, &shadows, &frame, |_| true);
        let drawn = start.elapsed();
        drop(progress);
        let encode = if self.format == Format::Png { encode_png } else { encode_exr };
        keep(self.file(take, None), encode(image.size, &image.colour))?;
        let lines = stage.lamps.iter().zip(made).map(|(lamp, Light { recipe, bytes, .. })| Line {
            light: lamp.name.clone(),
            recipe,
            bytes,
            baked,
            looked_up: drawn,
        });
        Ok(lines.collect())
    }
}

/// A light's shadow, and what is reported of it.
struct Light<'a> {
    recipe: String,
    bytes: usize,
    shadow: Box<dyn Shadow + 'a>,
}

impl Light<'_> {
    fn new(stage: &Stage, lamp: &Lamp) -> anyhow::Result<Self> {
        let recipe = stage.recipe_of(lamp)?;
        let made = lamp::shadow_of(stage, lamp, &recipe)?;
        let bytes = made.maps.iter().map(|map| map.bytes).sum();
        Ok(Self { recipe: recipe.to_string(), bytes, shadow: made.shadow })
    }
}

/// Switches off all lights that are not wanted.
pub fn keep_wanted(stage: &mut Stage) {
    let wanted: Vec<usize> = stage.lamps.iter().map(|lamp| lamp.light).collect();
    let mut index = 0..;
    stage.scene.lights.retain(|_| index.next().is_some_and(|index| wanted.contains(&index)));
    stage.lamps.iter_mut().zip(0..).for_each(|(lamp, light)| lamp.light = light);
}

/// The lit picture, with a shadow for each of the stage's lamps in their order; only pixels that `wanted` accepts by their index are drawn.
pub fn picture_by(
    stage: &Stage,
    shadows: &[&dyn Shadow],
    frame: &Frame,
    wanted: impl Fn(u32) -> bool + Sync,
) -> Picture {
    let of_lights: Vec<&dyn Shadow> = (0..stage.scene.lights.len())
        .map(|light| match stage.lamps.iter().position(|lamp| lamp.light == light) {
            Some(index) => shadows[index],
            None => &Unshadowed as &dyn Shadow,
        })
        .collect();
    picture_where(&stage.scene, &of_lights, frame, wanted)
}
