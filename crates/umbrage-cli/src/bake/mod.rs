//! `umbrage bake`.

mod bands;

use crate::args::{BakeArgs, Cli, RuleArg};
use crate::lights::Lamp;
use crate::names;
use crate::report::{Line, report};
use crate::shell::{Shell, Usage};
use crate::stage::Stage;
use anyhow::Context;
use bands::Bands;
use std::time::{Duration, Instant};
use umbrage_depth::DepthMap;
use umbrage_io::{CUBE_FACES, FACES_AHEAD, NamedMap, create_folder, write_maps};
use umbrage_recipe::Recipe;
use umbrage_render::light_map;

pub fn run(cli: &Cli, args: &BakeArgs, shell: &mut Shell<'_>) -> anyhow::Result<()> {
    if args.scene.recipe.is_some() {
        return Err(Usage("--recipe: a map is baked by --rule; a recipe is chosen when it is looked up".into()).into());
    }
    let recipe: Recipe = recipe(args.rule).parse().context("--rule")?;
    let stage = Stage::unchecked(&args.source, &args.scene, cli.max_memory, 0, shell)?;
    let bands = match stage.need.check(cli.max_memory) {
        Ok(()) => None,
        Err(error) => Some(Bands::new(cli, args, &stage).ok_or(error)?),
    };
    create_folder(&args.output)?;
    let (mut files, mut lines, mut all) = (Vec::new(), Vec::new(), Vec::new());
    let progress = shell.progress(stage.lamps.len());
    for lamp in &stage.lamps {
        progress.set_message(lamp.name.clone());
        if let Some(bands) = &bands {
            let path = names::file(&args.output, &stage.scene.name, stage.part(lamp), &[], "exr");
            lines.push(bands.write(&path, lamp, recipe.to_string(), shell)?);
            files.push(path);
            progress.inc(1);
            continue;
        }
        let start = Instant::now();
        let bake = |(name, view)| {
            let map = light_map(&recipe, &stage.scene, view).kept(args.storage);
            NamedMap {
                name,
                map,
                light_cone: stage.scene.lights[lamp.light].view.cone().filter(|_| lamp.views.len() > 1),
            }
        };
        let maps: Vec<NamedMap> = parts(lamp).into_iter().zip(&lamp.views).map(bake).collect();
        let (baked, start) = (start.elapsed(), Instant::now());
        let bytes = maps.iter().map(|named| named.map.allocated()).sum();
        let mut written = Duration::ZERO;
        if args.one_file {
            all.extend(maps);
        } else {
            let path = names::file(&args.output, &stage.scene.name, stage.part(lamp), &[], "exr");
            write_maps(&path, &maps)?;
            written = start.elapsed();
            files.push(path);
        }
        lines.push(Line { light: lamp.name.clone(), recipe: recipe.to_string(), bytes, baked, looked_up: written });
        progress.inc(1);
    }
    drop(progress);
    if !all.is_empty() {
        let path = names::file(&args.output, &stage.scene.name, None, &[], "exr");
        write_maps(&path, &all)?;
        files.push(path);
    }
    report(cli, shell, &files, &lines)
}

/// What the maps of a light are called.
fn parts(lamp: &Lamp) -> Vec<String> {
    let faces: &[&str] = match lamp.views.len() {
        1 => return vec![lamp.name.clone()],
        6 => &CUBE_FACES,
        _ => &FACES_AHEAD,
    };
    faces.iter().map(|face| format!("{}.{face}", lamp.name)).collect()
}

/// The recipe that bakes by a rule.
fn recipe(rule: RuleArg) -> &'static str {
    match rule {
        RuleArg::Facets => "auto",
        RuleArg::First => "reeves87",
        RuleArg::Second => "wang-molnar94,stored=second",
        RuleArg::BackFace => "wang-molnar94,stored=back-face",
        RuleArg::Midpoint => "woo92",
        RuleArg::Deep => "reeves87,stored=deep",
    }
}
