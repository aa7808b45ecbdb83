//! Our own: the default on kinds of scenes that shadow maps find hard.

use super::auto::{MIX, mean};
use super::judge::{Error, Judge};
use super::methods::row;
use crate::figure::{Context, Figure, Paper};
use crate::stage::panels::{error_panel, shadow_panel};
use umbrage_render::Frame;
use umbrage_report::{Made, Measure, Role, Table};
use umbrage_scene::gallery::{self, Make};

pub const KINDS: Figure = Figure {
    id: "U-auto-kinds",
    paper: Paper::Umbrage,
    title: "The default on what shadow maps find hard",
    claim: "Fences, letters, stairs, louvres, cities, gears, hair, wheels and pergolas, with one setting and no rays.",
    make: kinds,
};

/// Each kind twice: another shape under another light.
const STAGES: [(&str, [Make; 2]); 9] = [
    ("fence", [|| gallery::fence(0), || gallery::fence(1)]),
    ("letters", [|| gallery::letters(0), || gallery::letters(1)]),
    ("stairs", [|| gallery::stairs(0), || gallery::stairs(1)]),
    ("louvres", [|| gallery::louvres(0), || gallery::louvres(1)]),
    ("city", [|| gallery::city(0), || gallery::city(1)]),
    ("gears", [|| gallery::gears(0), || gallery::gears(1)]),
    ("hair", [|| gallery::hair(0), || gallery::hair(1)]),
    ("wheels", [|| gallery::wheels(0), || gallery::wheels(1)]),
    ("pergola", [|| gallery::pergola(0), || gallery::pergola(1)]),
];

/// A method's name, recipe, and the side of its map beside 512.
const COLUMNS: [(&str, &str, u32); 5] = [
    ("Woo 1992", "woo92", 512),
    ("papers' best mixture", MIX, 512),
    ("auto, 256²", "auto", 256),
    ("auto, 512²", "auto", 512),
    ("auto, 512², 8 × 8 places", "auto,across=8", 512),
];
/// Index of auto at 512².
const AUTO: usize = 3;

fn kinds(cx: &Context) -> anyhow::Result<Made> {
    let pixels = cx.pick(512, 96);
    let mut made = Made::default();
    let mut rows = Vec::new();
    let mut exact = Vec::new();
    let mut found: Vec<Vec<(Error, f64)>> = vec![Vec::new(); COLUMNS.len()];
    for (name, variants) in STAGES {
        for (variant, make) in variants.into_iter().enumerate() {
            let judge = Judge::new(cx, make, pixels, 512);
            let small = judge.with_texels(256);
            let ray = judge.error(&judge.set.truth_points(cx, &Frame::CENTRES)).rms;
            let mut numbers = vec![ray];
            for (column, (_, recipe, side)) in COLUMNS.iter().enumerate() {
                let judge = if *side == 256 { &small } else { &judge };
                let (picture, bytes) = judge.by(cx, recipe, &Frame::CENTRES)?;
                let error = judge.error(&picture);
                numbers.push(error.rms);
                found[column].push((error, bytes));
                if column == AUTO {
                    let id = format!("{name}-{variant}");
                    let (own, truth) = (&picture.shadow[0], &judge.truth().shadow[0]);
                    made.panels.push(shadow_panel(&id, name, &picture).with("recipe", recipe));
                    made.panels.push(error_panel(&format!("{id}-error"), "Less truth", picture.size, own, truth));
                    made.panels
                        .push(shadow_panel(&format!("{id}-truth"), "Ray-traced", judge.truth()).role(Role::Truth));
                    numbers.extend([error.wrong, bytes]);
                }
            }
            exact.push(ray);
            // In the table the two numbers of auto at 512² come last.
            let tail: Vec<f64> = numbers.drain(AUTO + 2..AUTO + 4).collect();
            rows.push(row(
                &format!("{name}, {}", if variant == 0 { "first" } else { "second" }),
                numbers.into_iter().chain(tail),
            ));
        }
    }
    let of = |column: usize, second: bool| {
        let picked = found[column].iter().skip(usize::from(second)).step_by(2);
        mean(picked.map(|(error, _)| error.rms))
    };
    for (name, second) in [("mean of the first", false), ("mean of the second", true)] {
        let rays = mean(exact.iter().skip(usize::from(second)).step_by(2).copied());
        rows.push(row(name, std::iter::once(rays).chain((0..COLUMNS.len()).map(|column| of(column, second)))));
    }
    let names = COLUMNS.iter().map(|column| column.0);
    let head = ["error, rms", "one exact ray"].into_iter().chain(names).chain(["wrong", "bytes a texel"]);
    made.tables.push(Table { name: "kinds".into(), head: head.map(String::from).collect(), rows });
    let auto = &found[AUTO];
    let rays = mean(exact.iter().copied());
    let all = mean(auto.iter().map(|(error, _)| error.rms));
    made.measures = vec![
        Measure::at_most("auto, second variants: error", of(AUTO, true), "rms", 0.012).full_size(cx.quick),
        Measure::at_most("auto over one exact ray: error", all / rays, "times", 0.5).full_size(cx.quick),
        Measure::at_most("auto, 256², second variants: error", of(2, true), "rms", 0.02).full_size(cx.quick),
        Measure::at_most(
            "auto: false shadow and false light, mean",
            mean(auto.iter().map(|(error, _)| error.wrong)),
            "share",
            0.0005,
        )
        .full_size(cx.quick),
        Measure::at_most("auto: bytes for each texel, mean", mean(auto.iter().map(|(_, bytes)| *bytes)), "bytes", 2.8),
        Measure::at_most(
            "auto: bytes for each texel, most",
            auto.iter().map(|(_, bytes)| *bytes).fold(0.0, f64::max),
            "bytes",
            9.0,
        ),
        Measure::at_least("one exact ray, second variants: error", of_rays(&exact), "rms", 0.05).full_size(cx.quick),
        Measure::at_least("papers' best mixture, second variants: error", of(1, true), "rms", 0.06).full_size(cx.quick),
        Measure::info("auto, 8 × 8 places, second variants: error", of(4, true), "rms"),
    ];
    made.note = "Judged as in U-auto-ladder. \"Wrong\" is the share of pixels more than three pixels from truth's edges that are off by more than a half; a \
                 bound on the exact ray's own error keeps the scenes as hard as they are meant to be. No number of the recipe was chosen on these scenes."
        .into();
    Ok(made)
}

/// The mean of the second variants.
fn of_rays(exact: &[f64]) -> f64 {
    mean(exact.iter().skip(1).step_by(2).copied())
}
