//! `umbrage bias`.

mod engines;
mod found;

pub use found::short;

use crate::args::{BiasArgs, Cli};
use crate::lights::Lamp;
use crate::names;
use crate::shadow::lit_alone;
use crate::shell::{Shell, Usage};
use crate::stage::Stage;
use anyhow::Context;
use engines::translated;
use found::{Found, Tried};
use serde_json::json;
use umbrage_depth::Map;
use umbrage_io::{create_folder, write_bytes};
use umbrage_oracle::{BiasKind, BiasTrial, Geometry, RayCast, TruePixel, Truth};
use umbrage_recipe::{PresetName, Recipe};
use umbrage_render::{Frame, light_map, picture};
use umbrage_report::plot::{Axis, Plot, Series};
use umbrage_scene::Scene;

/// Amounts of a curve.
const POINTS: u32 = 48;

pub fn run(cli: &Cli, args: &BiasArgs, shell: &mut Shell<'_>) -> anyhow::Result<()> {
    if args.scene.recipe.is_some() {
        return Err(Usage(
            "--recipe: biases are tried over a map of nearest surfaces; --radius is the filter's".into(),
        )
        .into());
    }
    let stage = Stage::new(&args.source, &args.scene, cli.max_memory, 1, shell)?;
    if let Some(lamp) = stage.lamps.iter().find(|lamp| lamp.views.len() > 1) {
        return Err(
            Usage(format!("light {:?} has {} maps: biases are tried over one", lamp.name, lamp.views.len())).into()
        );
    }
    let geometry = Geometry::new(&stage.scene, &stage.scene.camera);
    let (mut lights, mut files) = (Vec::new(), Vec::new());
    for (index, lamp) in stage.lamps.iter().enumerate() {
        let view = lamp.views[0];
        let map = light_map(&Recipe::from(PresetName::Reeves87), &stage.scene, &view);
        let (pixels, width) = truth(&stage.scene, lamp, &geometry);
        let trial = BiasTrial::new(&map, &pixels, width, args.radius);
        let found = found_by(&trial, args.tolerance / 100.0);
        if index > 0 && !cli.json {
            writeln!(shell.out)?;
        }
        let translated = translated(&found, &view, &trial, args.engine).with_context(|| lamp.name.clone())?;
        if cli.json {
            let mut light = found.json();
            light["light"] = json!(lamp.name);
            light["map_size"] = json!(view.size().to_array());
            light["radius_texels"] = json!(args.radius);
            light["engines"] = translated.json();
            lights.push(light);
        } else {
            let size = view.size();
            writeln!(shell.out, "{}: {} x {} texels, filter of {}", lamp.name, size.x, size.y, filter(args.radius))?;
            write!(shell.out, "{found}{translated}")?;
        }
        if let Some(folder) = &args.output {
            create_folder(folder)?;
            let path = names::file(folder, &stage.scene.name, stage.part(lamp), &["bias"], "svg");
            write_bytes(&path, plot(&trial, &found).svg().as_bytes())?;
            files.push(path.display().to_string());
        }
    }
    if cli.json {
        writeln!(shell.out, "{}", json!({ "lights": lights, "files": files }))?;
    }
    Ok(())
}

fn filter(radius: f64) -> String {
    if radius == 0.0 { "one texel".into() } else { format!("{} texels per side", 2.0 * radius) }
}

/// What the camera sees of a light by rays, at the centre of each pixel, and the pixels of a row.
fn truth(scene: &Scene, lamp: &Lamp, geometry: &Geometry) -> (Vec<TruePixel>, usize) {
    let one = lit_alone(scene, lamp, 1);
    let rays = RayCast::new(geometry, &one.lights[0].view).with(Truth { look_everywhere: true, ..Truth::default() });
    let seen = picture(&one, &[&rays], &Frame::CENTRES);
    let pixel = |index: usize| TruePixel {
        position: seen.position[index],
        normal: seen.normal[index],
        facing: seen.facing[0][index],
        one_surface: seen.share[index] == 1.0,
        dark: seen.shadow[0][index],
    };
    ((0..seen.object.len()).map(pixel).collect(), seen.size.x as usize)
}

fn found_by(trial: &BiasTrial<'_, Map>, tolerance: f64) -> Found {
    let (lit, dark) = trial.points();
    let tried = BiasKind::ALL.map(|kind| {
        let most = 2.0 * trial.reach(kind, tolerance);
        let window = trial.window(kind, tolerance, most);
        let amount = window.acne_free.unwrap_or(most);
        Tried { kind, window, most, amount, shares: trial.shares(kind, amount) }
    });
    Found { pixels: [lit.len(), dark.len()], without: trial.shares(BiasKind::Constant, 0.0), tried }
}

/// False shadow against false light, for amounts from none to twice what ends false shadow.
fn plot(trial: &BiasTrial<'_, Map>, found: &Found) -> Plot {
    let title = "What each bias leaves wrong";
    let mut plot = Plot::new(
        title,
        Axis::linear("false light, % of shadowed pixels"),
        Axis::linear("false shadow, % of lit pixels"),
    );
    for tried in &found.tried {
        let curve = (0..=POINTS).map(|point| {
            let shares = trial.shares(tried.kind, 2.0 * tried.amount * f64::from(point) / f64::from(POINTS));
            (100.0 * shares.false_light, 100.0 * shares.false_shadow)
        });
        plot = plot.add(Series::line(&tried.kind.to_string(), curve.collect()));
    }
    plot
}
