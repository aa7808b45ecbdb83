//! Umbrage's own: every method on every scene, with each fault by name.

use super::methods::{self, ENGINES, Judged, METHODS, Method, PREFILTERED, PUBLISHED, index, judge};
use super::sheet::Sheet;
use crate::figure::{Context, Figure, Paper};
use crate::stage::set::Set;
use umbrage_oracle::heat;
use umbrage_render::Frame;
use umbrage_report::{Made, Measure, Panel, Role, Table};
use umbrage_scene::gallery::{self, Make};

/// One number of a judgement.
type Fault = fn(&Judged) -> f64;

/// The methods that are judged on each scene: the papers' and Umbrage's own, then prefiltered maps, then engines.
const ALL: usize = METHODS.len() + PREFILTERED.len() + ENGINES.len();

fn all() -> impl Iterator<Item = &'static Method> {
    METHODS.iter().chain(&PREFILTERED).chain(&ENGINES)
}

pub const PRESETS: Figure = Figure {
    id: "U-presets",
    paper: Paper::Umbrage,
    title: "All presets, all scenes, every fault by name",
    claim: "No published comparison of depths and no engine's default is free of false shadow and leaks on every scene; which fault each one has is a property \
        of the method.",
    look: "the columns of the picture: a method is free of faults only if its whole column is grey.",
    make: presets,
};

/// A scene's name, what makes it, and whether every caster is a closed solid of more than a few texels.
type Stage = (&'static str, Make, bool);

const STAGES: [Stage; 12] = [
    ("sphere, slab", gallery::sphere_plane, true),
    ("box, slab", gallery::box_plane, true),
    ("spot room", gallery::spot_room, true),
    ("table", gallery::table, false),
    ("contact box", gallery::contact_box, true),
    ("pipes", gallery::pipes, false),
    ("walk-through", gallery::walkthrough, false),
    ("bowling", || gallery::bowling(0), false),
    ("low sun", gallery::grazing, true),
    ("thin slab", gallery::thin_slab, false),
    ("flat sheets", || gallery::sheets(false), false),
    ("bent sheets", || gallery::sheets(true), false),
];

/// The false shadow and the leak up to which a scene counts as free of them.
const MOST_ACNE: f64 = 0.005;
const MOST_LEAK: f64 = 0.02;

fn presets(cx: &Context) -> anyhow::Result<Made> {
    let (pixels, texels, cell) = (cx.pick(256, 96), cx.pick(512, 256), 96);
    let mut found = vec![[Judged::default(); STAGES.len()]; ALL];
    // Two sheets: the papers' and Umbrage's own methods; prefiltered maps and engines.
    let sheet = |methods: &[&Method]| {
        let mut sheet = Sheet::new(methods.len() as u32 + 1, STAGES.len() as u32, cell);
        sheet.legend();
        for (method, (name, _)) in methods.iter().enumerate() {
            sheet.head(method as u32 + 1, name);
        }
        for (stage, (name, ..)) in STAGES.iter().enumerate() {
            sheet.side(stage as u32, name);
        }
        sheet
    };
    let names: Vec<&Method> = all().collect();
    let (papers, others) = names.split_at(METHODS.len());
    let mut sheets = [sheet(papers), sheet(others)];
    for (stage, (_, make, _)) in STAGES.iter().enumerate() {
        let set = Set::new(make(), pixels, texels).with_coloured_truths();
        let truth = set.truth_points(cx, &Frame::CENTRES);
        for sheet in &mut sheets {
            sheet.place(0, stage as u32, truth.size, &truth.colour);
        }
        for (method, (_, recipe)) in all().enumerate() {
            let picture = set.by(cx, recipe, &Frame::CENTRES)?;
            let judged = judge(cx, &picture, &truth);
            found[method][stage] = judged;
            // Shading never looks up surfaces turned away from the light.
            let asked = |i: usize| truth.facing[0][i] > 0.05;
            let (own, exact) = (&picture.shadow[0], &truth.shadow[0]);
            let apart = (0..own.len()).map(|i| heat(if asked(i) { own[i] - exact[i] } else { 0.0 }));
            let (sheet, place) = if method < METHODS.len() { (0, method) } else { (1, method - METHODS.len()) };
            let (column, line) = (place as u32 + 1, stage as u32);
            sheets[sheet].place(column, line, truth.size, &apart.collect::<Vec<_>>());
            let above = |fault: f64, most: f64| (fault > most).then_some(fault);
            sheets[sheet].faults(column, line, above(judged.acne, MOST_ACNE), above(judged.leak, MOST_LEAK));
        }
    }
    let mut made = Made::default();
    let faults: [(&str, Fault); 4] = [
        ("false shadow", |one| one.acne),
        ("leak", |one| one.leak),
        ("leak area", |one| one.area),
        ("error, rms", |one| one.rms),
    ];
    for (name, of) in faults {
        let line = |(method, row): (&Method, &[Judged; STAGES.len()])| {
            let values: Vec<f64> = row.iter().map(of).collect();
            let known: Vec<f64> = values.iter().copied().filter(|value| value.is_finite()).collect();
            let mean = known.iter().sum::<f64>() / known.len() as f64;
            methods::row(method.0, values.into_iter().chain([mean]))
        };
        let rows = all().zip(&found).map(line).collect();
        let head = std::iter::once(name).chain(STAGES.iter().map(|stage| stage.0)).chain(["mean"]);
        made.tables.push(Table { name: name.into(), head: head.map(String::from).collect(), rows });
    }
    for (sheet, (name, whose)) in sheets
        .into_iter()
        .zip([("matrix", "every method"), ("matrix-others", "prefiltered maps and engines' defaults")])
    {
        let caption = format!("Every scene (rows) by {whose} (columns), minus truth");
        made.panels.push(Panel::rgb(name, &caption, sheet.size, sheet.pixels).role(Role::Error));
    }
    let worst = |name: &str, of: Fault, solids: bool| {
        let among = STAGES.iter().zip(&found[index(name)]).filter(|(stage, _)| stage.2 || !solids);
        among.map(|(_, one)| of(one)).filter(|value| value.is_finite()).fold(0.0, f64::max)
    };
    let mut measures = vec![
        Measure::at_most(
            "second depth: worst false shadow on closed solids",
            worst("Wang & Molnar 1994", |one| one.acne, true),
            "share",
            0.005,
        ),
        Measure::at_least(
            "second depth: worst false shadow of all",
            worst("Wang & Molnar 1994", |one| one.acne, false),
            "share",
            0.02,
        ),
        Measure::at_most(
            "midpoints: worst false shadow on closed solids",
            worst("Woo 1992", |one| one.acne, true),
            "share",
            0.02,
        )
        .full_size(cx.quick),
        Measure::at_least(
            "midpoints: worst false shadow of all",
            worst("Woo 1992", |one| one.acne, false),
            "share",
            0.02,
        ),
    ];
    let sum = |name: &str| found[index(name)].iter().map(|one| one.acne).sum::<f64>();
    let own = ["midpoint in the cone", "auto: facets, two planes"];
    let others = METHODS.iter().filter(|method| !own.contains(&method.0)).map(|method| sum(method.0));
    measures.push(Measure::at_most(
        "midpoints in the cone: false shadow on all scenes less the least of the others but auto",
        sum("midpoint in the cone") - others.fold(f64::INFINITY, f64::min),
        "sum of shares",
        0.0,
    ));
    for (fault, of) in [("false shadow", faults[0].1), ("leak", faults[1].1)] {
        let name = format!("auto: worst {fault} of all");
        let worst = worst("auto: facets, two planes", of, false);
        measures.push(Measure::at_most(&name, worst, "share", 0.002).full_size(cx.quick));
    }
    let clean = |one: &Judged| !(one.acne > MOST_ACNE || one.leak > MOST_LEAK || one.rms.is_nan());
    let counts: Vec<usize> = found.iter().map(|row| row.iter().filter(|one| clean(one)).count()).collect();
    let stages = STAGES.len() as f64;
    for (method, (name, _)) in all().enumerate() {
        let name = format!("{name}: scenes without false shadow above .5 % and leaks above 2 %");
        let count = counts[method] as f64;
        let measure = if method < PUBLISHED {
            Measure::at_most(&name, count, "of 12", stages - 1.0)
        } else {
            Measure::info(&name, count, "of 12")
        };
        measures.push(measure);
    }
    let engines = METHODS.len() + PREFILTERED.len();
    let through = counts[engines..].iter().filter(|count| **count == STAGES.len()).count() as f64;
    let name = "engines whose default is without such faults on every scene";
    measures.push(Measure::at_most(name, through, "engines", 0.0).full_size(cx.quick));
    for (method, (name, _)) in all().enumerate().take(engines).skip(METHODS.len()) {
        let areas = found[method].iter().map(|one| one.area).filter(|area| area.is_finite());
        measures.push(Measure::info(
            &format!("{name}: worst leak area, of shadowed pixels"),
            areas.fold(0.0, f64::max),
            "share",
        ));
    }
    made.measures = measures;
    made.note = "In the pictures orange is too dark, which is false shadow, and blue too light, which is a leak; numbers are written where a fault exceeds the \
        bound below which a scene counts as free of it. \
                 Surfaces turned away from the light are left grey. False shadow is measured on lit surfaces that face the light, leaks on shadowed ones, both \
                 away from truth's edges; the error is \
                 that of every wholly covered pixel. Leak area is the fraction of those shadowed pixels that receive a twentieth of the light or more: the \
                 light that variance shadow maps let through is too faint to count as a leak, but wide. Midpoints in Burley's cone are an unpublished \
                 combination. \
                 Engines' defaults use their own kernels and biases, but the same maps as the other methods; three.js casts with back faces, and sheets with \
                 both sides. One unit of a scene is taken for one of the \
                 engine's, and the light's near and far planes for those that the engine would choose. Soft methods are judged against the hard truth of a \
                 point light. Maps are 512², with one look-up per pixel."
        .into();
    Ok(made)
}
