//! Umbrage's own: the default on kinds of scenes, both common ones and those that are hard for shadow maps.

use super::auto::{MIX, SAMPLED, mean};
use super::judge::{Error, Judge};
use super::methods::row;
use crate::figure::{Context, Figure, Paper};
use crate::stage::panels::{error_panel, shadow_panel};
use umbrage_render::Frame;
use umbrage_report::{Made, Measure, Role, Table};
use umbrage_scene::gallery::{self, Make};

pub const COMMON: Figure = Figure {
    id: "U-auto-common",
    paper: Paper::Umbrage,
    title: "The default on common kinds of scenes",
    claim: "One setting, without rays, serves solids, balls, terrain, leaves, tubes, things that touch and scanned statues.",
    look: "the column of errors beside that of one exact ray and of the papers' best mixture.",
    make: |cx| figure(cx, &EASIER),
};

pub const KINDS: Figure = Figure {
    id: "U-auto-kinds",
    paper: Paper::Umbrage,
    title: "The default on scenes that are hard for shadow maps",
    claim: "One setting, without rays, serves fences, letters, stairs, louvres, cities, gears, hair, wheels, pergolas and rooms.",
    look: "the hair and the fences, in which one pixel holds several shadows.",
    make: |cx| figure(cx, &HARDER),
};

/// A method's name, its recipe and the side of its map.
type Column = (&'static str, &'static str, u32);

/// Kinds of scenes that are reported together, and the bounds on their errors.
struct Group {
    /// A scene of each kind: the second of the gallery's two, with other shapes and another light than the first, which may be looked at while a recipe is
    /// designed.
    stages: &'static [(&'static str, Make)],
    /// One is [`AUTO`].
    columns: &'static [Column],
    /// The largest error that auto may have, by the side of its map.
    auto: &'static [(u32, f64)],
    /// The same for other columns.
    fitted: &'static [(Column, f64)],
    /// The largest fraction that may be wrong, as [`Error::wrong`].
    wrong: f64,
    /// The smallest errors of an exact ray and of the papers' best mixture, which keep the scenes hard.
    ray: f64,
    mix: f64,
}

/// The recipe and the side of the map that the panels show.
const AUTO: (&str, u32) = ("auto", 512);

const EASIER: Group = Group {
    stages: &[
        ("solids", || gallery::solids(1)),
        ("spheres", || gallery::spheres(1)),
        ("terrain", || gallery::terrain(1)),
        ("leaves", || gallery::leaves(1)),
        ("tubes", || gallery::tubes(1)),
        ("contacts", || gallery::contacts(1)),
        ("scan", || gallery::scan(1)),
    ],
    columns: &[
        ("papers' best mixture", MIX, 512),
        ("auto, 128²", "auto", 128),
        ("auto, 256²", "auto", 256),
        ("auto, 512²", "auto", 512),
        FITTED,
        FITTED_LINES,
    ],
    auto: &[(512, 0.009), (256, 0.013), (128, 0.02)],
    fitted: &[(FITTED, 0.007), (FITTED_LINES, 0.0055)],
    wrong: 0.0001,
    ray: 0.02,
    mix: 0.04,
};

const HARDER: Group = Group {
    stages: &[
        ("fence", || gallery::fence(1)),
        ("letters", || gallery::letters(1)),
        ("stairs", || gallery::stairs(1)),
        ("louvres", || gallery::louvres(1)),
        ("city", || gallery::city(1)),
        ("gears", || gallery::gears(1)),
        ("hair", || gallery::hair(1)),
        ("wheels", || gallery::wheels(1)),
        ("pergola", || gallery::pergola(1)),
        ("interior", || gallery::interior(1)),
    ],
    columns: &[
        ("Woo 1992", "woo92", 512),
        ("papers' best mixture", MIX, 512),
        ("auto, 256²", "auto", 256),
        ("auto, 512²", "auto", 512),
        FITTED_LINES,
    ],
    auto: &[(512, 0.012), (256, 0.02)],
    fitted: &[(FITTED_LINES, 0.008)],
    wrong: 0.0005,
    ray: 0.05,
    mix: 0.06,
};

/// Columns of auto over maps that are fitted to the camera, and with more lines across each pixel.
const FITTED: Column = ("auto, 512², fitted", "auto,window=fitted", 512);
const FITTED_LINES: Column = ("auto, 512², fitted, eight lines", "auto,window=fitted,across=8", 512);

/// The last columns of the table.
const SEVERAL: [&str; 3] = [
    "auto, pixels of several surfaces too",
    "the same, the camera with 4 × 4 samples",
    "truth: half of its rays minus the other half",
];

/// What was measured of one scene.
struct Found {
    kind: &'static str,
    ray: f64,
    /// Half of truth's rays minus the other half.
    noise: f64,
    /// Auto's error over pixels of several surfaces too, with one sample of the camera and with 4 × 4.
    several: [f64; 2],
    /// Error and bytes for each texel, for each column.
    columns: Vec<(Error, f64)>,
}

fn figure(cx: &Context, group: &Group) -> anyhow::Result<Made> {
    let mut made = Made::default();
    let mut found = Vec::new();
    for (kind, make) in group.stages {
        found.push(measured(cx, group, kind, *make, &mut made)?);
    }
    made.tables.push(table(group, &found));
    made.measures = measures(cx, group, &found);
    made.note = "Errors are judged as in U-auto-ladder. \"Wrong\" is the fraction of pixels more than three pixels from truth's edges that are off by more than a \
                 half; a bound on the exact ray's own error keeps the scenes as hard as they are meant to be. Each mean is over pixels of one surface, except \
                 in the columns that say otherwise. No number of the recipe was chosen on these scenes."
        .into();
    Ok(made)
}

/// Measures one scene, and adds its panels.
fn measured(cx: &Context, group: &Group, kind: &'static str, make: Make, made: &mut Made) -> anyhow::Result<Found> {
    let pixels = cx.pick(512, 96);
    let judge = Judge::new(cx, make, pixels, AUTO.1);
    let mut columns = Vec::new();
    for &(_, recipe, side) in group.columns {
        let judge = judge.with_texels(side);
        let (picture, bytes) = judge.by(cx, recipe, &Frame::CENTRES)?;
        columns.push((judge.error(&picture), bytes));
        if (recipe, side) == AUTO {
            let (own, truth) = (&picture.shadow[0], &judge.truth().shadow[0]);
            made.panels.push(shadow_panel(kind, kind, &picture).with("recipe", recipe));
            made.panels.push(error_panel(&format!("{kind}-error"), "Minus truth", picture.size, own, truth));
            made.panels.push(shadow_panel(&format!("{kind}-truth"), "Ray-traced", judge.truth()).role(Role::Truth));
        }
    }
    // The ray-traced truth is the same for every size of map.
    let ray = judge.error(&judge.set.truth_points(cx, &Frame::CENTRES)).rms;
    let sampled = judge.error(&judge.by(cx, AUTO.0, &SAMPLED)?.0);
    let several = [columns[group.column(AUTO)].0.several, sampled.several];
    Ok(Found { kind, ray, noise: judge.noise(), several, columns })
}

/// The errors scene by scene and their means; of [`AUTO`] what is wrong and the bytes come last.
fn table(group: &Group, found: &[Found]) -> Table {
    let auto = group.column(AUTO);
    let mut rows: Vec<Vec<String>> = found
        .iter()
        .map(|one| {
            let (error, bytes) = one.columns[auto];
            let errors = one.columns.iter().map(|(error, _)| error.rms);
            row(
                one.kind,
                std::iter::once(one.ray)
                    .chain(errors)
                    .chain([error.wrong, bytes])
                    .chain(one.several)
                    .chain([one.noise]),
            )
        })
        .collect();
    let errors = (0..group.columns.len()).map(|column| mean_error(found, column));
    rows.push(row("mean", std::iter::once(mean_ray(found)).chain(errors)));
    let names = group.columns.iter().map(|column| column.0);
    let head =
        ["error, rms", "one exact ray"].into_iter().chain(names).chain(["wrong", "bytes per texel"]).chain(SEVERAL);
    Table { name: "kinds".into(), head: head.map(String::from).collect(), rows }
}

fn measures(cx: &Context, group: &Group, found: &[Found]) -> Vec<Measure> {
    let auto = group.column(AUTO);
    let bytes = || found.iter().map(|one| one.columns[auto].1);
    let of_ray = mean(found.iter().map(|one| one.columns[auto].0.rms)) / mean(found.iter().map(|one| one.ray));
    let mut measures = Vec::new();
    for (side, most) in group.auto {
        let size = if *side == AUTO.1 { String::new() } else { format!(", {side}²") };
        let error = mean_error(found, group.column((AUTO.0, *side)));
        let name = format!("auto{size}: error");
        measures.push(Measure::at_most(&name, error, "rms", *most).full_size(cx.quick));
    }
    let name = "auto over one exact ray: error";
    measures.insert(1, Measure::at_most(name, of_ray, "times", 0.5).full_size(cx.quick));
    let wrong = mean(found.iter().map(|one| one.columns[auto].0.wrong));
    let name = "auto: false shadow and false light, mean";
    measures.push(Measure::at_most(name, wrong, "share", group.wrong).full_size(cx.quick));
    // A map's bytes are the same for a picture of any size.
    let name = "auto: bytes for each texel, mean";
    measures.push(Measure::at_most(name, mean(bytes()), "bytes", 2.8));
    let name = "auto: bytes for each texel, most";
    measures.push(Measure::at_most(name, bytes().fold(0.0, f64::max), "bytes", 9.0));
    let (ray, mix) = (mean_ray(found), mean_error(found, group.column((MIX, 512))));
    measures.extend([
        Measure::at_least("one exact ray: error", ray, "rms", group.ray).full_size(cx.quick),
        Measure::at_least("papers' best mixture: error", mix, "rms", group.mix).full_size(cx.quick),
    ]);
    let least = group.auto.iter().map(|(_, most)| *most).fold(f64::INFINITY, f64::min);
    let noise = mean(found.iter().map(|one| one.noise));
    let name = "truth: half of its rays less the other half, mean";
    measures.push(Measure::at_most(name, noise, "rms", least / 3.0).full_size(cx.quick));
    for (which, name) in SEVERAL.iter().take(2).enumerate() {
        let error = mean(found.iter().map(|one| one.several[which]));
        measures.push(Measure::info(&format!("{name}: error"), error, "rms"));
    }
    for ((name, recipe, side), most) in group.fitted {
        let error = mean_error(found, group.column((recipe, *side)));
        let name = format!("{name}: error");
        measures.push(Measure::at_most(&name, error, "rms", *most).full_size(cx.quick));
    }
    measures
}

impl Group {
    /// The index of the column of a recipe over maps of a side.
    fn column(&self, (recipe, side): (&str, u32)) -> usize {
        self.columns.iter().position(|column| (column.1, column.2) == (recipe, side)).unwrap_or(0)
    }
}

/// A column's mean error.
fn mean_error(found: &[Found], column: usize) -> f64 {
    mean(found.iter().map(|one| one.columns[column].0.rms))
}

/// The mean error of exact rays.
fn mean_ray(found: &[Found]) -> f64 {
    mean(found.iter().map(|one| one.ray))
}
