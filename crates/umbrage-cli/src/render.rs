//! `umbrage render`.

use crate::args::{Cli, Format, RenderArgs};
use crate::draws::{Draws, Keep};
use crate::report::Line;
use crate::shadow::{frame, options};
use crate::shell::{Shell, Usage};
use crate::stage::Stage;
use crate::takes::Take;
use crate::{lamp, names, pictures};
use serde_json::{Map, Value, json};
use std::path::{Path, PathBuf};
use std::time::Instant;
use umbrage_io::{encode_exr, encode_png};
use umbrage_render::picture;
use umbrage_shadow::{Shadow, Unshadowed};

pub fn run(cli: &Cli, args: &RenderArgs, shell: &mut Shell<'_>) -> anyhow::Result<()> {
    let format = check(args, args.takes.are_several())?;
    let into = (args.output.as_path(), args.takes.are_several());
    pictures::run(cli, &args.takes, args.scene.frame, into, &Render { cli, args, format }, shell)
}

/// The format of the pictures, one or those of a folder.
///
/// # Errors
/// An output that does not go with what is drawn.
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
        // A light that is not wanted is out.
        if !self.args.scene.light.is_empty() {
            let wanted: Vec<usize> = stage.lamps.iter().map(|lamp| lamp.light).collect();
            let mut index = 0..;
            stage.scene.lights.retain(|_| index.next().is_some_and(|index| wanted.contains(&index)));
            stage.lamps.iter_mut().zip(0..).for_each(|(lamp, light)| lamp.light = light);
        }
        let start = Instant::now();
        let progress = shell.progress(stage.lamps.len() + 1);
        let made = stage.lamps.iter().map(|lamp| {
            progress.set_message(format!("{}{}", take.label, lamp.name));
            let made = lamp::shadow_of(&stage, lamp, &stage.recipe_of(lamp)?)?;
            progress.inc(1);
            Ok(made)
        });
        let made = made.collect::<anyhow::Result<Vec<_>>>()?;
        let baked = start.elapsed();
        let shadows: Vec<&dyn Shadow> = (0..stage.scene.lights.len())
            .map(|light| match stage.lamps.iter().position(|lamp| lamp.light == light) {
                Some(index) => &*made[index].shadow,
                None => &Unshadowed as &dyn Shadow,
            })
            .collect();
        progress.set_message(format!("{}picture", take.label));
        let start = Instant::now();
        let image = picture(&stage.scene, &shadows, &frame(self.args.samples, self.cli.seed, take.frame));
        let drawn = start.elapsed();
        drop(progress);
        let encode = if self.format == Format::Png { encode_png } else { encode_exr };
        keep(self.file(take, None), encode(image.size, &image.colour))?;
        let lines = stage.lamps.iter().zip(&made).map(|(lamp, made)| {
            let recipe = stage.recipe_of(lamp).map_or_else(|_| String::new(), |recipe| recipe.to_string());
            let bytes = made.maps.iter().map(|map| map.bytes).sum();
            Line { light: lamp.name.clone(), recipe, bytes, baked, looked_up: drawn }
        });
        Ok(lines.collect())
    }
}
