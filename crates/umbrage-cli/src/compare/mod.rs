//! `umbrage compare`.

mod image;
mod pages;
mod table;
mod timed;

use crate::args::{Cli, SceneArgs, WindowArg};
use crate::compare_args::CompareArgs;
use crate::lamp;
use crate::lights::Lamp;
use crate::memory::Need;
use crate::scores::{Made, Row, limits};
use crate::shadow::{self, Turned};
use crate::shell::{Exceeded, Shell, Usage};
use crate::stage::{self, Stage};
use pages::Truth;
use serde_json::json;
use std::time::Instant;
use timed::Timed;
use umbrage_io::{create_folder, write_bytes};
use umbrage_oracle::Geometry;
use umbrage_oracle::judge::{Drawn, Judge, Where};
use umbrage_recipe::{Field, PresetName, Recipe};
use umbrage_render::Frame;
use umbrage_shadow::Shadow;

/// Pictures under other keys of randomness, by which noise is measured.
const AGAIN: usize = 2;

/// What a command line compares with truth.
struct Plan<'a> {
    args: &'a CompareArgs,
    recipes: Vec<(Recipe, u32)>,
    /// The image of `--against`.
    image: Option<Vec<f32>>,
    frame: Frame,
}

pub fn run(cli: &Cli, args: &CompareArgs, shell: &mut Shell<'_>) -> anyhow::Result<()> {
    let limits = args.fail_above.as_deref().map(limits).transpose();
    let limits = limits.map_err(|problem| Usage(format!("--fail-above: {problem}")))?;
    let recipes = recipes(args)?;
    let mut stage = Stage::unchecked(&args.source, &scene_args(args), cli.max_memory, args.samples, shell)?;
    if stage.lamps.is_empty() {
        return Err(Usage(format!("{}: no light casts shadows", args.source)).into());
    }
    // The maps of a recipe and of the same without bias are there together.
    let largest = args.map_size.iter().copied().max().unwrap_or(1);
    let maps = stage.lamps.iter().map(|lamp| lamp.views.len() as u64).max().unwrap_or(0);
    let texels = 2 * maps * u64::from(largest).pow(2);
    let each = recipes.len() as u64 + u64::from(args.against.is_some());
    let results = if args.output.is_some() { each * stage.lamps.len() as u64 } else { 1 };
    stage.need = Need { texels, results, ..stage.need };
    stage.need.check(cli.max_memory)?;
    let image = args.against.as_deref().map(|path| -> anyhow::Result<Vec<f32>> {
        if let [_, _, ..] = stage.lamps[..] {
            let names: Vec<&str> = stage.lamps.iter().map(|lamp| lamp.name.as_str()).collect();
            return Err(Usage(format!(
                "--against: an image is of one light, --light chooses one of {}",
                names.join(", ")
            ))
            .into());
        }
        image::read(path, args.invert, stage.scene.camera.size(), &stage.need, cli.max_memory)
    });
    let image = image.transpose()?;
    let plan = Plan { args, recipes, image, frame: shadow::frame(args.samples, cli.seed, args.frame) };
    let geometry = Geometry::new(&stage.scene, &stage.scene.camera);
    let (mut rows, mut truths) = (Vec::new(), Vec::new());
    for index in 0..stage.lamps.len() {
        let (own, truth) = plan.of_light(&mut stage, index, &geometry, shell)?;
        rows.extend(own);
        truths.extend(truth);
    }
    let exceeded = limits.as_ref().map(|limits| limits.exceeded(&rows)).unwrap_or_default();
    let size = stage.scene.camera.size();
    let mut report = json!({
        "scene": args.source, "size": size.to_array(), "samples": args.samples,
        "rows": rows.iter().map(Row::json).collect::<Vec<_>>(),
    });
    if limits.is_some() {
        report["exceeded"] = json!(exceeded);
    }
    if let Some(out) = &args.output {
        create_folder(out)?;
        let mut files = pages::write(out, &args.source, size, &truths, &rows, limits.as_ref())?;
        let path = out.join("report.json");
        files.insert(1, path.clone());
        report["files"] = files.iter().map(|file| file.display().to_string()).collect();
        write_bytes(&path, format!("{report}\n").as_bytes())?;
    }
    if cli.json {
        writeln!(shell.out, "{report}")?;
    } else {
        for line in table::aligned(&table::table(&rows)) {
            writeln!(shell.out, "{line}")?;
        }
    }
    if !exceeded.is_empty() {
        // The results are printed in any case.
        shell.out.flush()?;
        return Err(Exceeded(format!("--fail-above: {}", exceeded.join("; "))).into());
    }
    Ok(())
}

/// The recipes with the sides of their maps: all of the first, then all of the second.
fn recipes(args: &CompareArgs) -> anyhow::Result<Vec<(Recipe, u32)>> {
    let mut all = Vec::new();
    if args.recipe.is_empty() && args.against.is_none() {
        // The control is not a method that anybody recommends.
        let presets = PresetName::ALL.into_iter().filter(|preset| *preset != PresetName::Ordinary);
        all.extend(presets.flat_map(|preset| args.map_size.iter().map(move |size| (Recipe::from(preset), *size))));
    }
    for text in &args.recipe {
        for size in &args.map_size {
            all.push((stage::recipe(text, *size)?, *size));
        }
    }
    // A repeated recipe gives nothing new.
    let mut once: Vec<(Recipe, u32)> = Vec::new();
    for one in all {
        if !once.contains(&one) {
            once.push(one);
        }
    }
    Ok(once)
}

fn scene_args(args: &CompareArgs) -> SceneArgs {
    SceneArgs {
        size: args.size,
        map_size: args.map_size[0],
        recipe: None,
        light: args.light.clone(),
        turn_light: args.turn_light.clone(),
        camera: args.camera.clone(),
        time: args.time,
        animation: args.animation.clone(),
        frame: args.frame,
    }
}

impl Plan<'_> {
    /// All rows of a light, and its truth where pages show it.
    fn of_light(
        &self,
        stage: &mut Stage,
        index: usize,
        geometry: &Geometry,
        shell: &mut Shell<'_>,
    ) -> anyhow::Result<(Vec<Row>, Option<Truth>)> {
        stage.resize(self.args.map_size[0])?;
        let progress = shell.progress(1 + self.recipes.len());
        let lamp = &stage.lamps[index];
        let (name, view) = (lamp.name.clone(), stage.scene.lights[lamp.light].view);
        progress.set_message(format!("{name}: truth"));
        let area = shadow::area(stage, lamp, self.args.area)?;
        let frame = Frame { every_sample: true, ..self.frame };
        let rays = shadow::rays(stage, lamp, geometry, area, &frame);
        let mut truth = shadow::drawn(&stage.scene, lamp, &[&*rays], &frame);
        let turned = Turned { shadow: &*rays, light: &view };
        let views = lamp.whole_views(&stage.scene).to_vec();
        let seen = shadow::seen(&truth);
        let judge = Judge::new((&stage.scene.camera, &views), geometry, (&turned, &truth.shadow[0]), seen);
        progress.inc(1);
        let mut rows = Vec::new();
        for (recipe, map_size) in &self.recipes {
            progress.set_message(format!("{name}: {recipe}, {map_size} texels"));
            stage.resize(*map_size)?;
            rows.push(self.of_recipe(stage, &stage.lamps[index], recipe, *map_size, area, &judge)?);
            progress.inc(1);
        }
        if let (Some(image), Some(path)) = (&self.image, &self.args.against) {
            let (light, what, score) = (name.clone(), path.display().to_string(), judge.score(&Drawn::foreign(image)));
            rows.push(self.kept(Row { light, what, made: None, score, shadow: image.clone() }));
        }
        let shown = self.args.output.is_some();
        let judged = judge.judged().to_vec();
        let truth = shown.then(|| Truth { light: name, shadow: truth.shadow.swap_remove(0), judged });
        Ok((rows, truth))
    }

    /// A row without its pictures where they are not shown.
    fn kept(&self, mut row: Row) -> Row {
        if self.args.output.is_none() {
            row.shadow = Vec::new();
            row.score.places = Where::default();
        }
        row
    }

    fn of_recipe(
        &self,
        stage: &Stage,
        lamp: &Lamp,
        recipe: &Recipe,
        map_size: u32,
        area: Option<f64>,
        judge: &Judge<'_>,
    ) -> anyhow::Result<Row> {
        // Filters without a field for the light's size are judged as they are.
        let knows = Field::of(recipe.preset()).any(|field| field.name == "light");
        let recipe = shadow::recipe(recipe, area.filter(|_| knows), WindowArg::File)?;
        let start = Instant::now();
        let made = lamp::shadow_of(stage, lamp, &recipe)?;
        let bake_ms = (start.elapsed().as_secs_f64() * 1e5).round() / 1e2;
        let unbiased = recipe.unbiased().map(|recipe| lamp::shadow_of(stage, lamp, &recipe)).transpose()?;
        let timed = Timed::new(&*made.shadow);
        // The key of a picture's light is its place among them: the first is what `umbrage shadow` draws.
        let mut shadows: Vec<&dyn Shadow> = vec![&timed];
        shadows.extend([&*made.shadow; AGAIN]);
        shadows.extend(unbiased.as_ref().map(|unbiased| &*unbiased.shadow));
        let mut pictures = shadow::drawn(&stage.scene, lamp, &shadows, &self.frame).shadow;
        let again: Vec<&[f32]> = pictures[1..=AGAIN].iter().map(Vec::as_slice).collect();
        let without = pictures.get(1 + AGAIN).map(Vec::as_slice);
        let drawn = Drawn { result: &pictures[0], recipe: Some(&recipe), unbiased: without, again: &again };
        let score = judge.score(&drawn);
        let bytes = made.maps.iter().map(|map| map.bytes).sum();
        let made = Some(Made { map_size, bytes, bake_ms, look_up_ns: timed.mean() });
        let (light, what, shadow) = (lamp.name.clone(), recipe.to_string(), pictures.swap_remove(0));
        Ok(self.kept(Row { light, what, made, score, shadow }))
    }
}
