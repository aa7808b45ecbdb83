//! Biases that know the surface: one that grows with its slope, and an offset along its normal.

use super::methods::{Judged, judge, row};
use crate::figure::{Context, Figure, Paper};
use crate::stage::panels::{error_panel, shadow_panel, truth_panel};
use crate::stage::set::Set;
use umbrage_render::Frame;
use umbrage_report::plot::{Axis, Plot, Series};
use umbrage_report::{Made, Measure, Table};
use umbrage_scene::gallery::{self, Make};

pub const OFFSETS: Figure = Figure {
    id: "U-offsets",
    paper: Paper::Umbrage,
    title: "Slope-scaled biases and normal offsets, by their amount",
    claim: "On every slope both end false shadow at the same amount, which follows from the filter's width alone; a constant bias has no such amount. Both \
        leave false light at the foot of what stands there.",
    look: "where each curve of false shadow ends: at the same amount on every slope, but for the constant bias.",
    make: offsets,
};

/// Half of the filter's width, texels: nine texels of equal weight.
const HALF: f64 = 1.5;

/// A kind of bias: its name, the recipe but for the amount, the amount's unit, and what ends false shadow by closed form, texels.
type Kind = (&'static str, &'static str, &'static str, f64);

/// A sine is at most 1, so that the last needs what the third does.
const KINDS: [Kind; 4] = [
    ("constant", "depth=constant,bias=", "t", f64::INFINITY),
    ("slope-scaled", "depth=slope-scaled,bias=0.0002,slope-scale=", "", 2.0 * HALF),
    ("normal offset", "depth=normal-offset,bias=0.0002,normal-offset=", "", std::f64::consts::SQRT_2 * HALF),
    (
        "normal offset by the sine",
        "depth=normal-offset,bias=0.0002,offset-growth=sine,normal-offset=",
        "",
        std::f64::consts::SQRT_2 * HALF,
    ),
];

const STAGES: [(&str, Make); 2] = [("room with contacts", || gallery::contacts(0)), ("low sun", gallery::grazing)];

fn recipe((_, text, unit, _): &Kind, amount: f64) -> String {
    format!("reeves87,pattern=every,res-factor=0,min-size={HALF},{text}{amount}{unit}")
}

fn offsets(cx: &Context) -> anyhow::Result<Made> {
    let frame = Frame::CENTRES;
    let amounts: Vec<f64> = (0..=cx.pick(20, 8)).map(|step| f64::from(step) * cx.pick(0.25, 0.625)).collect();
    let mut made = Made::default();
    let mut rows = Vec::new();
    let mut at_formula = Vec::new();
    for (stage, (scene, make)) in STAGES.iter().enumerate() {
        let set = Set::new(make(), cx.pick(256, 96), cx.pick(512, 256));
        let truth = set.truth_points(cx, &frame);
        let mut acne = Plot::new(scene, Axis::linear("amount, texels"), Axis::linear("false shadow, %"));
        let mut trade = Plot::new(scene, Axis::linear("false light, %"), Axis::linear("false shadow, %"));
        for kind in &KINDS {
            let (name, _, _, formula) = *kind;
            let judged = |amount: f64| -> anyhow::Result<Judged> {
                Ok(judge(cx, &set.by(cx, &recipe(kind, amount), &frame)?, &truth))
            };
            let found = amounts.iter().map(|amount| judged(*amount)).collect::<anyhow::Result<Vec<_>>>()?;
            let percent = |of: fn(&Judged) -> f64| found.iter().map(move |one| 100.0 * of(one));
            let dark = || percent(|one| one.acne);
            acne = acne.add(Series::line(name, amounts.iter().copied().zip(dark()).collect()));
            trade = trade.add(Series::line(name, percent(|one| one.leak).zip(dark()).collect()));
            // The constant bias is judged at the amount that suffices for the slope-scaled one.
            let amount = if formula.is_finite() { formula } else { 2.0 * HALF };
            let picture = set.by(cx, &recipe(kind, amount), &frame)?;
            let one = judge(cx, &picture, &truth);
            rows.push(row(&format!("{scene}: {name}, {amount:.2} texels"), [one.acne, one.leak, one.rms]));
            at_formula.push((*scene, name, one));
            if stage == 1 {
                let panel = shadow_panel(name, &format!("{name}, {amount:.2} texels"), &picture);
                made.panels.push(panel.against("truth"));
                let (own, exact) = (&picture.shadow[0], &truth.shadow[0]);
                made.panels.push(error_panel(&format!("{name}-error"), "Minus truth", truth.size, own, exact));
            }
        }
        made.plots.push((format!("false-shadow-{stage}"), acne.svg()));
        made.plots.push((format!("trade-{stage}"), trade.svg()));
        if stage == 1 {
            made.panels.push(truth_panel(&truth));
        }
    }
    let head = ["scene, bias, amount", "false shadow", "leak", "error, rms"].map(String::from).to_vec();
    made.tables.push(Table { name: "at-the-amounts-of-the-formulas".into(), head, rows });
    for (scene, name, one) in &at_formula {
        let measure = format!("{scene}: {name}, false shadow");
        made.measures.push(match *name {
            "constant" => Measure::info(&measure, one.acne, "share"),
            _ => Measure::at_most(&measure, one.acne, "share", 0.002).full_size(cx.quick),
        });
        made.measures.push(Measure::info(&format!("{scene}: {name}, leak"), one.leak, "share"));
    }
    made.note = "The filter is nine texels of equal weight, which lie up to 1.5 texels from its centre on each axis: a slope-scaled bias of 3 texels covers the \
        \
        \
        \
        \
        \
        \
        change of a plane's depth over them, and so does \
                 a normal offset of 1.5 times the square root of 2. The slope is the steeper of the two along a row and a column, as rasterisers take it, but \
                 that of the receiver. A constant bias of 0.0002 covers the rounding \
                 of stored depths. Leaks are measured away from truth's edges, so that the light at casters' feet counts only where it is wide."
        .into();
    Ok(made)
}
