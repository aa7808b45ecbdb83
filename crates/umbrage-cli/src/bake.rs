//! `umbrage bake`.

use crate::args::{BakeArgs, Cli, RuleArg};
use crate::names;
use crate::shadow::report;
use crate::shell::{Shell, Usage};
use crate::stage::Stage;
use anyhow::Context;
use std::path::Path;
use std::time::{Duration, Instant};
use umbrage_depth::{DepthMap, Map};
use umbrage_io::{IoError, create_folder, write_deep_map, write_facet_map, write_shadow_map};
use umbrage_recipe::Recipe;
use umbrage_render::light_map;

/// Names of the views of a light that shines all around.
const FACES: [&str; 6] = ["+x", "-x", "+y", "-y", "+z", "-z"];

/// And of one that shines into a half space.
const AHEAD: [&str; 5] = ["ahead", "right", "left", "up", "down"];

pub fn run(cli: &Cli, args: &BakeArgs, shell: &mut Shell<'_>) -> anyhow::Result<()> {
    if args.scene.recipe.is_some() {
        return Err(Usage("--recipe: a map is baked by --rule; a recipe is chosen when it is looked up".into()).into());
    }
    let recipe: Recipe = recipe(args.rule).parse().context("--rule")?;
    let stage = Stage::new(&args.scene, cli.max_memory, 0, shell)?;
    create_folder(&args.output)?;
    let (mut files, mut lines) = (Vec::new(), Vec::new());
    for lamp in &stage.lamps {
        let (mut bytes, mut baked, mut written) = (0, Duration::ZERO, Duration::ZERO);
        for (index, view) in lamp.views.iter().enumerate() {
            let start = Instant::now();
            let map = light_map(&recipe, &stage.scene, view).kept(args.storage);
            baked += start.elapsed();
            bytes += map.allocated();
            let face: &[&str] = match lamp.views.len() {
                1 => &[],
                6 => &FACES[index..=index],
                _ => &AHEAD[index..=index],
            };
            let path = names::file(&args.output, &stage.scene.name, stage.part(lamp), face, "exr");
            let start = Instant::now();
            write(&path, &map)?;
            written += start.elapsed();
            files.push(path);
        }
        lines.push((lamp.name.clone(), recipe.to_string(), bytes, baked, written));
    }
    report(cli, shell, &files, lines)
}

/// The recipe that bakes by a rule.
fn recipe(rule: RuleArg) -> &'static str {
    match rule {
        RuleArg::Facets => "auto",
        RuleArg::First => "reeves87",
        RuleArg::Second => "wang-molnar94",
        RuleArg::BackFace => "wang-molnar94,stored=back-face",
        RuleArg::Midpoint => "woo92",
        RuleArg::Deep => "reeves87,stored=deep",
    }
}

fn write(path: &Path, map: &Map) -> Result<(), IoError> {
    match map {
        Map::Facets(map) => write_facet_map(path, map),
        Map::Deep(map) => write_deep_map(path, map),
        Map::Raw(map) => write_shadow_map(path, map),
        Map::Bbox(map) => write_shadow_map(path, map),
        Map::Tiled(map) => write_shadow_map(path, map),
    }
}
