//! Umbrage's own: enlargements of where the default is wrong, and what would mend it.

use super::judge::Judge;
use crate::figure::{Context, Figure, Paper};
use crate::stage::panels::{zoomed, zoomed_error};
use glam::DVec2;
use umbrage_render::Frame;
use umbrage_report::{Made, Measure, Role, Table};
use umbrage_scene::gallery::{self, Make};

pub const WHERE: Figure = Figure {
    id: "U-auto-where",
    paper: Paper::Umbrage,
    title: "The default's worst pixels, and why they are wrong",
    claim: "The remaining errors are at edges, gaps and hollows finer than the map's samples; farther than three pixels from any edge nothing is wrong.",
    look: "the enlarged pixels: each is at an edge or a gap that is finer than the map's samples.",
    make: where_wrong,
};

const STAGES: [(&str, Make); 6] = [
    ("stairs", || gallery::stairs(1)),
    ("gears", || gallery::gears(1)),
    ("hair", || gallery::hair(1)),
    ("pergola", || gallery::pergola(1)),
    ("interior", || gallery::interior(1)),
    ("terrain", || gallery::terrain(1)),
];

/// What may be at fault, the recipe that has more of it, and by how much the map's sides are longer.
const CAUSES: [(&str, &str, u32); 4] = [
    ("lines across the pixel: 16", "auto,across=16", 1),
    ("samples in a texel: 8 × 8", "auto,fine=8,slots=8", 1),
    ("texels: a map four times as large", "auto", 2),
    ("the margin by which a sample must be passed: none", "auto,width-term=0,slope-term=0", 1),
];

/// The width of the enlarged part: the picture's width over this.
const PART: u32 = 16;
/// Scenes whose worst pixel is shown.
const SHOWN: usize = 5;
/// A pixel with an error above this is visibly wrong.
const SEEN: f32 = 0.25;

fn where_wrong(cx: &Context) -> anyhow::Result<Made> {
    let (pixels, texels) = (cx.pick(512, 96), cx.pick(512, 256));
    let mut made = Made::default();
    let mut rows = Vec::new();
    // The squared error by cause, last the part that none of them mends, and the number of pixels that are far off.
    let mut total = [0.0; CAUSES.len() + 1];
    let (mut seen, mut judged, mut far) = (0u32, 0u32, 0u32);
    let mut worst = Vec::new();
    for (name, make) in STAGES {
        let judge = Judge::new(cx, make, pixels, texels);
        let exact = &judge.truth().shadow[0];
        let own = judge.by(cx, "auto", &Frame::CENTRES)?.0;
        let others = CAUSES.iter().map(|(_, recipe, larger)| {
            Ok(judge.with_texels(texels * larger).by(cx, recipe, &Frame::CENTRES)?.0.shadow.remove(0))
        });
        let others = others.collect::<anyhow::Result<Vec<Vec<f32>>>>()?;
        let mut shares = [0.0; CAUSES.len() + 1];
        let mut most = (0.0, 0);
        for i in (0..exact.len()).filter(|&i| judge.judged()[i]) {
            let error = (own.shadow[0][i] - exact[i]).abs();
            let (mut cause, mut left) = (CAUSES.len(), 0.5 * error);
            for (index, other) in others.iter().enumerate() {
                if (other[i] - exact[i]).abs() < left {
                    (cause, left) = (index, (other[i] - exact[i]).abs());
                }
            }
            shares[cause] += f64::from(error * error);
            judged += 1;
            seen += u32::from(error > SEEN);
            far += u32::from(error > SEEN && judge.sure()[i]);
            if error > most.0 {
                most = (error, i);
            }
        }
        let all: f64 = shares.iter().sum();
        let cells = shares.iter().map(|share| format!("{:.0} %", 100.0 * share / all.max(f64::MIN_POSITIVE)));
        rows.push(std::iter::once(name.to_string()).chain(cells).chain([format!("{:.2}", most.0)]).collect());
        for (sum, share) in total.iter_mut().zip(shares) {
            *sum += share;
        }
        worst.push((name, judge, own, most));
    }
    let all: f64 = total.iter().sum();
    let share = |cause: usize| total[cause] / all;
    let cells = (0..total.len()).map(|cause| format!("{:.0} %", 100.0 * share(cause)));
    rows.push(std::iter::once("all".to_string()).chain(cells).chain([String::new()]).collect());
    let names = CAUSES.iter().map(|cause| cause.0).chain(["none of these", "largest error"]);
    let head = ["squared error that is halved at least by"].into_iter().chain(names);
    made.tables.push(Table { name: "causes".into(), head: head.map(String::from).collect(), rows });
    worst.sort_by(|a, b| b.3.0.total_cmp(&a.3.0));
    for (name, judge, own, (_, pixel)) in worst.iter().take(SHOWN) {
        let width = own.size.x as usize;
        let at = DVec2::new((pixel % width) as f64 + 0.5, (pixel / width) as f64 + 0.5) / own.size.as_dvec2();
        made.panels.push(zoomed(name, &format!("auto: {name}"), own, at, PART).against(&format!("{name}-truth")));
        made.panels.push(zoomed_error(&format!("{name}-error"), "Minus truth", own, judge.truth(), at, PART));
        made.panels.push(zoomed(&format!("{name}-truth"), "Ray-traced", judge.truth(), at, PART).role(Role::Truth));
    }
    made.measures = vec![
        Measure::at_most("pixels off by more than a quarter", f64::from(seen) / f64::from(judged), "share", 0.001)
            .full_size(cx.quick),
        Measure::at_most("those of them farther than three pixels from any edge", f64::from(far), "pixels", 0.0)
            .full_size(cx.quick),
        Measure::info(
            "squared error that more lines, samples or texels halve",
            share(0) + share(1) + share(2),
            "share",
        ),
        Measure::info("squared error that smaller terms halve", share(3), "share"),
    ];
    made.note = "A pixel's error is attributed to the change that leaves the least of it, if that is less than half. The scenes are those with the largest \
        errors; \
                 in the middle of each part is its worst pixel."
        .into();
    Ok(made)
}
