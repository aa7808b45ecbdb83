//! Our own: every method on every scene, fault by named fault.

use super::methods::{self, Judged, METHODS, Method, PUBLISHED, index, judge};
use super::sheet::Sheet;
use crate::figure::{Context, Figure, Paper};
use crate::stage::set::Set;
use umbrage_oracle::heat;
use umbrage_render::Frame;
use umbrage_report::{Made, Measure, Panel, Role, Table};
use umbrage_scene::gallery::{self, Make};

/// One number of a judgement.
type Fault = fn(&Judged) -> f64;

pub const PRESETS: Figure = Figure {
    id: "U-presets",
    paper: Paper::Umbrage,
    title: "All methods, all scenes, every fault by name",
    claim: "No published method is free of false shadow and leaks on every scene; which fault each one has is a property of the method.",
    look: "the columns of the picture: a method has no fault only where all of its column is grey.",
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
    let mut found = vec![[Judged::default(); STAGES.len()]; METHODS.len()];
    let mut sheet = Sheet::new(METHODS.len() as u32 + 1, STAGES.len() as u32, cell);
    sheet.legend();
    for (method, (name, _)) in METHODS.iter().enumerate() {
        sheet.head(method as u32 + 1, name);
    }
    for (stage, (name, make, _)) in STAGES.iter().enumerate() {
        let set = Set::new(make(), pixels, texels);
        let truth = set.truth_points(cx, &Frame::CENTRES);
        sheet.place(0, stage as u32, truth.size, &truth.colour);
        sheet.side(stage as u32, name);
        for (method, (_, recipe)) in METHODS.iter().enumerate() {
            let picture = set.by(cx, recipe, &Frame::CENTRES)?;
            let judged = judge(cx, &picture, &truth);
            found[method][stage] = judged;
            // Of surfaces turned away from the light no shading asks.
            let asked = |i: usize| truth.facing[0][i] > 0.05;
            let (own, exact) = (&picture.shadow[0], &truth.shadow[0]);
            let apart = (0..own.len()).map(|i| heat(if asked(i) { own[i] - exact[i] } else { 0.0 }));
            let (column, line) = (method as u32 + 1, stage as u32);
            sheet.place(column, line, truth.size, &apart.collect::<Vec<_>>());
            let above = |fault: f64, most: f64| (fault > most).then_some(fault);
            sheet.faults(column, line, above(judged.acne, MOST_ACNE), above(judged.leak, MOST_LEAK));
        }
    }
    let mut made = Made::default();
    let faults: [(&str, Fault); 3] =
        [("false shadow", |one| one.acne), ("leak", |one| one.leak), ("error, rms", |one| one.rms)];
    for (name, of) in faults {
        let line = |(method, row): (&Method, &[Judged; STAGES.len()])| {
            let values: Vec<f64> = row.iter().map(of).collect();
            let known: Vec<f64> = values.iter().copied().filter(|value| value.is_finite()).collect();
            let mean = known.iter().sum::<f64>() / known.len() as f64;
            methods::row(method.0, values.into_iter().chain([mean]))
        };
        let rows = METHODS.iter().zip(&found).map(line).collect();
        let head = std::iter::once(name).chain(STAGES.iter().map(|stage| stage.0)).chain(["mean"]);
        made.tables.push(Table { name: name.into(), head: head.map(String::from).collect(), rows });
    }
    let caption = "Every scene (rows) by every method (columns), less truth";
    made.panels.push(Panel::rgb("matrix", caption, sheet.size, sheet.pixels).role(Role::Error));
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
    let counts = found.iter().map(|row| row.iter().filter(|one| clean(one)).count());
    for (method, ((name, _), count)) in METHODS.iter().zip(counts).enumerate() {
        let name = format!("{name}: scenes without false shadow above .5 % and leaks above 2 %");
        let all = STAGES.len() as f64;
        let measure = if method < PUBLISHED {
            Measure::at_most(&name, count as f64, "of 12", all - 1.0)
        } else {
            Measure::info(&name, count as f64, "of 12")
        };
        measures.push(measure);
    }
    made.measures = measures;
    made.note = "In the picture orange is too dark, false shadow, and blue too light, a leak; a number is written where it is more than counts as none. \
                 Surfaces turned away from the light are left grey. False shadow is looked for on lit surfaces that face the light, leaks on shadowed ones, both off truth's edges; the error is \
                 that of every wholly covered pixel. Midpoints in Burley's cone are a mix that nobody published. Soft methods are judged against the hard truth of a point light. Maps are 512², a pixel is asked once."
        .into();
    Ok(made)
}
