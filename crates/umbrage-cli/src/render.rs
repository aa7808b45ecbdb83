//! `umbrage render`.

use crate::args::{Cli, RenderArgs};
use crate::lamp;
use crate::shadow::{frame, report};
use crate::shell::{Shell, Usage};
use crate::stage::Stage;
use std::time::Instant;
use umbrage_io::{write_exr, write_png};
use umbrage_render::picture;
use umbrage_shadow::{Shadow, Unshadowed};

pub fn run(cli: &Cli, args: &RenderArgs, shell: &mut Shell<'_>) -> anyhow::Result<()> {
    let extension = args.output.extension().and_then(|extension| extension.to_str()).map(str::to_ascii_lowercase);
    let write = match extension.as_deref() {
        Some("png") => write_png,
        Some("exr") => write_exr,
        _ => return Err(Usage(format!("--output {}: expected .png or .exr", args.output.display())).into()),
    };
    let mut stage = Stage::new(&args.scene, cli.max_memory, args.samples, shell)?;
    // A light that is not wanted is out.
    if !args.scene.light.is_empty() {
        let wanted: Vec<usize> = stage.lamps.iter().map(|lamp| lamp.light).collect();
        let mut index = 0..;
        stage.scene.lights.retain(|_| index.next().is_some_and(|index| wanted.contains(&index)));
        stage.lamps.iter_mut().zip(0..).for_each(|(lamp, light)| lamp.light = light);
    }
    let start = Instant::now();
    let progress = shell.progress(stage.lamps.len() + 1);
    let made = stage.lamps.iter().map(|lamp| {
        progress.set_message(lamp.name.clone());
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
    progress.set_message("picture");
    let start = Instant::now();
    let image = picture(&stage.scene, &shadows, &frame(args.samples, cli.seed, args.scene.frame));
    let drawn = start.elapsed();
    drop(progress);
    write(&args.output, image.size, &image.colour)?;
    let lines = stage.lamps.iter().zip(&made).map(|(lamp, made)| {
        let recipe = stage.recipe_of(lamp).map_or_else(|_| String::new(), |recipe| recipe.to_string());
        (lamp.name.clone(), recipe, made.maps.iter().map(|map| map.bytes).sum(), baked, drawn)
    });
    report(cli, shell, std::slice::from_ref(&args.output), lines)
}
