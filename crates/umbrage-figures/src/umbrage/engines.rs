//! The effect of each engine's default bias on one scene, in one unit.

use crate::figure::{Context, Figure, Paper};
use crate::stage::panels::{error_panel, shadow_panel, truth_panel};
use crate::stage::set::Set;
use umbrage_depth::Tiled;
use umbrage_engines::{Conditions, Engine, EngineError, WorldBias};
use umbrage_oracle::{BiasKind, BiasTrial, TriedBias, TruePixel, biased_fraction};
use umbrage_plane::{Receiver, SurfacePoint, View};
use umbrage_render::Frame;
use umbrage_report::plot::{Axis, Plot, Series};
use umbrage_report::{Made, Measure, Table};
use umbrage_sample::Key;
use umbrage_scene::gallery;
use umbrage_shadow::{Shadow, same_length};

pub const BIAS: Figure = Figure {
    id: "U-bias",
    paper: Paper::Umbrage,
    title: "Every engine's default bias on one scene",
    claim: "Each default is a different bias in world units, and none of them is right for a scene that it was not made for.",
    look: "the engines' dots beside the curve of slope-scaled biases: higher dots have more false shadow, dots farther right more detached shadows.",
    make: bias,
};

/// Half of the filter's width, texels: nine texels that count alike, whatever filter an engine has, so that the biases are compared and nothing else.
const RADIUS: f64 = 1.5;

/// A map of nearest depths under an engine's default bias.
struct ByEngine<'a> {
    map: &'a Tiled,
    engine: Engine,
}

impl Shadow for ByEngine<'_> {
    fn fractions(&self, at: &[SurfacePoint], _key: Key, out: &mut [f32]) {
        same_length(at, out);
        for (point, fraction) in at.iter().zip(out) {
            *fraction =
                biased_fraction(self.map, point, RADIUS, |receiver| default_of(self.engine, self.map, receiver));
        }
    }
}

/// An engine's default bias for a receiver, at its smallest. None for a surface that faces away.
fn default_of(engine: Engine, map: &Tiled, receiver: &Receiver) -> TriedBias {
    let given = in_world(engine, umbrage_depth::DepthMap::view(map), receiver).unwrap_or(WorldBias::ZERO);
    TriedBias { constant: given.constant, slope: given.slope, normal: given.normal }
}

fn in_world(engine: Engine, view: &View, receiver: &Receiver) -> Result<WorldBias, EngineError> {
    Ok(engine.world(&[], &Conditions::of(view, receiver)?)?.least)
}

fn bias(cx: &Context) -> anyhow::Result<Made> {
    let set = Set::new(gallery::contacts(0), cx.pick(320, 96), cx.pick(1024, 256));
    let frame = Frame::CENTRES;
    let truth = set.truth_points(cx, &frame);
    let pixel = |index: usize| TruePixel {
        position: truth.position[index],
        normal: truth.normal[index],
        facing: truth.facing[0][index],
        one_surface: truth.share[index] == 1.0,
        dark: truth.shadow[0][index],
    };
    let pixels: Vec<TruePixel> = (0..truth.object.len()).map(pixel).collect();
    let trial = BiasTrial::new(&**set.map(), &pixels, truth.size.x as usize, RADIUS);
    let middle = trial.median().ok_or_else(|| anyhow::anyhow!("no pixel is judged"))?;
    let view = set.scene.lights[0].view;
    let conditions = Conditions::of(&view, &middle)?;
    let mut made = Made::default();
    made.panels.push(truth_panel(&truth));
    let number = |value: f64| format!("{value:.4}");
    let percent = |share: f64| format!("{:.2}", 100.0 * share);
    let (mut rows, mut found) = (Vec::new(), Vec::new());
    for engine in Engine::ALL {
        let about = engine.about();
        let Ok(given) = in_world(engine, &view, &middle) else {
            let unknown =
                std::iter::repeat_n("no public formula".to_string(), 1).chain(std::iter::repeat_n(String::new(), 5));
            rows.push([about.title.to_string(), about.version.to_string()].into_iter().chain(unknown).collect());
            continue;
        };
        let shares = trial.shares_by(|receiver| default_of(engine, set.map(), receiver));
        let all = given.along_axis(&conditions)?;
        let numbers = [given.constant, given.slope, given.normal, all].map(number);
        let shares_of = [shares.false_shadow, shares.false_light].map(percent);
        rows.push([about.title.into(), about.version.into()].into_iter().chain(numbers).chain(shares_of).collect());
        found.push((engine, shares));
        let picture = set.draw(cx, &ByEngine { map: set.map(), engine }, &frame);
        let name = engine.name();
        made.panels.push(shadow_panel(name, about.title, &picture).against("truth"));
        let (own, exact) = (&picture.shadow[0], &truth.shadow[0]);
        made.panels.push(error_panel(&format!("{name}-error"), "Minus truth", truth.size, own, exact));
    }
    let head = [
        "default of",
        "version",
        "constant, world",
        "slope, texels",
        "normal, world",
        "total, world along the axis",
        "false shadow, %",
        "false light, %",
    ];
    made.tables.push(Table { name: "defaults".into(), head: head.map(String::from).to_vec(), rows });
    let mut plot =
        Plot::new("What each default leaves wrong", Axis::linear("false light, %"), Axis::linear("false shadow, %"));
    for (engine, shares) in &found {
        let at = vec![(100.0 * shares.false_light, 100.0 * shares.false_shadow)];
        plot = plot.add(Series::dots(engine.name(), at));
    }
    let best = trial.shares(BiasKind::Slope, RADIUS);
    let curve = (0..=48).map(|step| {
        let shares = trial.shares(BiasKind::Slope, f64::from(step) / 16.0);
        (100.0 * shares.false_light, 100.0 * shares.false_shadow)
    });
    made.plots.push(("trade".into(), plot.add(Series::line("slope-scaled, 0 to 3 texels", curve.collect())).svg()));
    // None is right: each leaves false shadow, or more false light than the filter does by itself.
    let bare = trial.shares(BiasKind::Constant, 0.0);
    let right =
        found.iter().filter(|(_, shares)| shares.false_shadow < 0.005 && shares.false_light - bare.false_light < 0.005);
    let auto = set.by(cx, "auto", &frame)?;
    let pairs = || auto.shadow[0].iter().zip(&truth.shadow[0]);
    let wrong = pairs().filter(|(own, exact)| (*own - *exact).abs() > 0.5).count() as f64 / pairs().count() as f64;
    made.measures = vec![
        Measure::info("engines whose default is known", found.len() as f64, "engines"),
        Measure::at_most("engines whose default is right here", right.count() as f64, "engines", 0.0)
            .full_size(cx.quick),
        Measure::info("no bias: false shadow", bare.false_shadow, "share"),
        Measure::info("slope-scaled bias of the filter's half: false shadow", best.false_shadow, "share"),
        Measure::info("slope-scaled bias of the filter's half: false light", best.false_light, "share"),
        Measure::at_most("auto: pixels that are wrong by more than a half", wrong, "share", 0.01).full_size(cx.quick),
    ];
    made.note = "Every engine's default bias is applied over one map, under one filter of nine texels: engines' own filters differ. One unit of the scene is \
        taken for \
                 one of the engine's, which is a metre in most; the room is 24 units across. The biases in the table are those of the receiver in the middle; \
                 each pixel has its own."
        .into();
    Ok(made)
}
