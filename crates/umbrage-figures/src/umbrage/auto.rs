//! Umbrage's own: the parts of the default and its cost, compared with rays.

use super::judge::{Error, Judge};
use super::methods::row;
use crate::figure::{Context, Figure, Paper};
use crate::stage::panels::{error_panel, shadow_panel, truth_panel, zoomed, zoomed_colour};
use crate::stage::set::Set;
use glam::DVec2;
use umbrage_render::Frame;
use umbrage_report::plot::{Axis, Plot, Series};
use umbrage_report::{Made, Measure, Role, Table};
use umbrage_scene::gallery::{self, Make};

/// Scenes with one light and hard shadows whose casters all lie in its map.
const STAGES: [(&str, Make); 14] = [
    ("sphere, slab", gallery::sphere_plane),
    ("box, slab", gallery::box_plane),
    ("spot room", gallery::spot_room),
    ("table", gallery::table),
    ("contact box", gallery::contact_box),
    ("overlapping boxes", gallery::overlapping_boxes),
    ("two heights", gallery::two_heights),
    ("pipes", gallery::pipes),
    ("walk-through", gallery::walkthrough),
    ("bowling", || gallery::bowling(0)),
    ("low sun", gallery::grazing),
    ("thin slab", gallery::thin_slab),
    ("flat sheets", || gallery::sheets(false)),
    ("bent sheets", || gallery::sheets(true)),
];

/// The best mixture of the papers' parts.
pub(super) const MIX: &str = "wang-molnar94,stored=midpoint,pattern=tent";

/// The number of recipes at the head of the ladder that are controls.
const CONTROLS: usize = 2;

/// A camera of 4 × 4 samples per pixel, to see which surfaces the pixel holds. One look-up is made for each of them.
pub(super) const SAMPLED: Frame =
    Frame { axis: 4, stochastic: false, every_sample: false, smooth: false, seed: 0, number: 0 };

/// Further variants of the default: name, recipe, and how the camera samples.
const BESIDE: [(&str, &str, Frame); 4] = [
    ("auto, the camera with 4 × 4 samples", "auto", SAMPLED),
    ("and eight lines", "auto,across=8", SAMPLED),
    ("auto, the map's window fitted to the camera", "auto,window=fitted", Frame::CENTRES),
    ("and eight lines", "auto,window=fitted,across=8", Frame::CENTRES),
];

/// What each part adds, in turn, after the controls.
const LADDER: [(&str, &str); 7] = [
    ("Woo 1992", "woo92"),
    ("midpoints, tangent plane, a tent: the papers' best mixture", MIX),
    ("facets: two planes, one place", "auto,fine=1,across=1"),
    ("and four lines across the pixel, with edges searched for", "auto,fine=1"),
    ("and 4 × 4 samples where one plane is not enough, edges halfway", "auto,slots=2"),
    ("and links of 16 slots: auto", "auto"),
    ("and eight lines", "auto,across=8"),
];

pub(super) fn mean(values: impl Iterator<Item = f64> + Clone) -> f64 {
    values.clone().sum::<f64>() / values.count().max(1) as f64
}

/// Where the box stands on the ground, and the part of the picture's width around there that is enlarged.
const MIDDLE: DVec2 = DVec2::new(0.25, 0.70);
const PART: u32 = 3;

/// The middle of what is enlarged of the furnished room.
const CHAIRS: DVec2 = DVec2::new(0.555, 0.615);

pub const SHOWN: Figure = Figure {
    id: "U-auto",
    paper: Paper::Umbrage,
    title: "The default beside a paper's map, and beside rays",
    claim: "One small map without a bias gives edges, contacts and thin shadows as many rays see them.",
    look: "the enlarged edge and the contact, beside 256 rays per pixel; and every slat of the chairs.",
    make: shown,
};

fn shown(cx: &Context) -> anyhow::Result<Made> {
    let judge = Judge::new(cx, gallery::contact_box, cx.pick(256, 128), cx.pick(512, 256));
    let mut made = Made::default();
    let mut found = Vec::new();
    for (id, caption, recipe) in [("woo", "Woo 1992", "woo92"), ("auto", "auto", "auto")] {
        let (picture, bytes) = judge.by(cx, recipe, &Frame::CENTRES)?;
        found.push((judge.error(&picture), bytes));
        made.panels.push(shadow_panel(id, caption, &picture).with("recipe", recipe).against("truth"));
        let (own, truth) = (&picture.shadow[0], &judge.truth().shadow[0]);
        made.panels.push(error_panel(&format!("{id}-error"), "Minus truth", picture.size, own, truth));
        made.panels.push(zoomed(&format!("{id}-zoom"), "Enlarged", &picture, MIDDLE, PART));
    }
    made.panels.push(truth_panel(judge.truth()));
    made.panels.push(zoomed("truth-zoom", "Enlarged", judge.truth(), MIDDLE, PART).role(Role::Truth));
    let room = Set::new(gallery::contacts(0), cx.pick(1440, 480), cx.pick(512, 256)).in_colour();
    for (id, caption, recipe) in [
        ("chairs-engine", "An engine's default, urp-hard", "urp-hard"),
        ("chairs-auto", "auto, a map of the same size", "auto"),
    ] {
        let picture = room.by(cx, recipe, &SAMPLED)?;
        let panel = zoomed_colour(id, caption, picture.size, &picture.colour, CHAIRS, PART);
        made.panels.push(panel.with("recipe", recipe).with("map", room.scene.lights[0].view.size().x));
    }
    let texels = f64::from(judge.set.scene.lights[0].view.size().element_product());
    made.measures = vec![
        Measure::at_most("auto: error", found[1].0.rms, "rms", 0.012),
        Measure::at_most("auto over Woo: error", found[1].0.rms / found[0].0.rms, "times", 0.25),
        Measure::at_most("auto: false shadow and false light", found[1].0.wrong, "share", 0.0),
        Measure::info("auto: kilobytes", found[1].1 * texels / 1024.0, "KB"),
        Measure::info("Woo: kilobytes", found[0].1 * texels / 1024.0, "KB"),
    ];
    made.note = "There is one look-up per pixel; truth is the mean of 256 rays.".into();
    Ok(made)
}

pub const LADDER_OF_PARTS: Figure = Figure {
    id: "U-auto-ladder",
    paper: Paper::Umbrage,
    title: "What each part of the default adds",
    claim: "Without a bias, one small map of facets comes closer to truth than sixteen exact rays per pixel.",
    look: "the error falling from part to part, in the end below that of sixteen rays.",
    make: ladder,
};

fn ladder(cx: &Context) -> anyhow::Result<Made> {
    let (pixels, texels) = (cx.pick(512, 128), cx.pick(512, 256));
    let mut made = Made::default();
    let mut found = vec![Vec::new(); LADDER.len()];
    let mut smaller = [Vec::new(), Vec::new()];
    let mut beside = vec![Vec::new(); BESIDE.len()];
    let (mut exact, mut many, mut bytes, mut noise) = (Vec::new(), Vec::new(), Vec::new(), Vec::new());
    for (_, make) in STAGES {
        let judge = Judge::new(cx, make, pixels, texels);
        exact.push(judge.error(&judge.set.truth_points(cx, &Frame::CENTRES)));
        noise.push(judge.noise());
        many.push(judge.error(&judge.rays(cx, 4)));
        for (step, (_, recipe)) in LADDER.iter().enumerate() {
            let (picture, kept) = judge.by(cx, recipe, &Frame::CENTRES)?;
            found[step].push(judge.error(&picture));
            if *recipe == "auto" {
                bytes.push(kept);
            }
        }
        for ((_, recipe, frame), errors) in BESIDE.iter().zip(&mut beside) {
            errors.push(judge.error(&judge.by(cx, recipe, frame)?.0));
        }
        for (divisor, errors) in [2, 4].into_iter().zip(&mut smaller) {
            let judge = judge.with_texels(texels / divisor);
            errors.push(judge.error(&judge.by(cx, "auto", &Frame::CENTRES)?.0));
        }
    }
    let head = || ["error, rms"].into_iter().chain(STAGES.iter().map(|stage| stage.0)).chain(["mean"]);
    let head = head().map(String::from).collect();
    let with_mean = |name: &str, all: Vec<f64>| row(name, all.iter().copied().chain([mean(all.iter().copied())]));
    let line = |name: &str, errors: &[Error]| with_mean(name, errors.iter().map(|error| error.rms).collect());
    let several = |name: &str, errors: &[Error]| with_mean(name, errors.iter().map(|error| error.several).collect());
    let auto = LADDER.iter().position(|(_, recipe)| *recipe == "auto").unwrap_or(0);
    let mut rows = vec![line("one exact ray at the centre", &exact), line("16 exact rays", &many)];
    rows.extend(LADDER.iter().zip(&found).map(|((name, _), errors)| line(name, errors)));
    rows.extend(BESIDE.iter().zip(&beside).map(|((name, ..), errors)| line(name, errors)));
    for (size, errors) in ["half the size", "a quarter of the size"].into_iter().zip(&smaller) {
        rows.push(line(&format!("auto over maps of {size}"), errors));
    }
    rows.push(several("pixels of several surfaces too: one exact ray", &exact));
    rows.push(several("pixels of several surfaces too: auto", &found[auto]));
    rows.push(several("pixels of several surfaces too: auto, the camera with 4 × 4 samples", &beside[0]));
    rows.push(several("and eight lines", &beside[1]));
    rows.push(with_mean("truth: half of its rays minus the other half", noise.clone()));
    rows.push(with_mean("auto: bytes per texel", bytes.clone()));
    made.tables.push(Table { name: "errors".into(), head, rows });
    let rms = |step: usize| mean(found[step].iter().map(|error| error.rms));
    let ray = mean(exact.iter().map(|error| error.rms));
    let sixteen = mean(many.iter().map(|error: &Error| error.rms));
    let mut plot = Plot::new(
        "Error, mean of all scenes, as each part is added",
        Axis::linear("parts"),
        Axis::linear("rms of the fraction in shadow"),
    );
    let parts = (CONTROLS..LADDER.len()).map(|step| ((step - CONTROLS + 1) as f64, rms(step))).collect();
    plot = plot.add(Series::line("auto part by part", parts));
    let level = |rms: f64| vec![(1.0, rms), ((LADDER.len() - CONTROLS) as f64, rms)];
    for (name, rms) in [
        ("Woo 1992", rms(0)),
        ("papers' best mixture", rms(1)),
        ("one exact ray at the centre", ray),
        ("16 exact rays", sixteen),
    ] {
        plot = plot.add(Series::line(name, level(rms)));
    }
    made.plots.push(("ladder".into(), plot.svg()));
    let small = |which: usize| mean(smaller[which].iter().map(|error| error.rms));
    let beside_mean = |which: usize| mean(beside[which].iter().map(|error: &Error| error.rms));
    let beside_several = |which: usize| mean(beside[which].iter().map(|error| error.several));
    let wrong = |step: usize| mean(found[step].iter().map(|error| error.wrong));
    made.measures = vec![
        Measure::at_most("auto, 512²: error, mean of all scenes", rms(auto), "rms", 0.009).full_size(cx.quick),
        Measure::at_most("auto, 256²: error, mean of all scenes", small(0), "rms", 0.013).full_size(cx.quick),
        Measure::at_most("auto, 128²: error, mean of all scenes", small(1), "rms", 0.02).full_size(cx.quick),
        Measure::at_most("auto: false shadow and false light, mean", wrong(auto), "share", 0.0001),
        Measure::at_most("auto over one exact ray: error", rms(auto) / ray, "times", 0.5).full_size(cx.quick),
        Measure::at_most("auto over the papers' best mixture: error", rms(auto) / rms(1), "times", 0.5)
            .full_size(cx.quick),
        Measure::at_most("auto: bytes for each texel, mean", mean(bytes.iter().copied()), "bytes", 2.8)
            .full_size(cx.quick),
        Measure::at_most("auto: bytes for each texel, most", bytes.iter().copied().fold(0.0, f64::max), "bytes", 9.0)
            .full_size(cx.quick),
        Measure::at_most(
            "truth: half of its rays less the other half, mean",
            mean(noise.iter().copied()),
            "rms",
            0.003,
        )
        .full_size(cx.quick),
        Measure::at_most("camera with 4 × 4 samples: error, mean of all scenes", beside_mean(0), "rms", 0.009)
            .full_size(cx.quick),
        Measure::info("camera with 4 × 4 samples, several surfaces too: error, mean", beside_several(0), "rms"),
        Measure::at_most("fitted window: error, mean of all scenes", beside_mean(2), "rms", 0.007).full_size(cx.quick),
        Measure::at_most("fitted window, eight lines: error, mean of all scenes", beside_mean(3), "rms", 0.0055)
            .full_size(cx.quick),
        Measure::info("eight lines: error, mean of all scenes", rms(LADDER.len() - 1), "rms"),
        Measure::at_most("auto over 16 exact rays a pixel: error", rms(auto) / sixteen, "times", 1.0)
            .full_size(cx.quick),
        Measure::info("16 exact rays a pixel: error, mean of all scenes", sixteen, "rms"),
        Measure::info("papers' best mixture: error, mean of all scenes", rms(1), "rms"),
        Measure::info("one exact ray: error, mean of all scenes", ray, "rms"),
    ];
    made.note = "Errors are those of pixels all of whose samples see one surface that faces the light; lines that say so include pixels that see several. \
                 Truth is the mean of 256 rays, and no parameter is set for a scene. One look-up is made for each pixel, or for each surface that a camera of \
                 4 × 4 samples sees in it."
        .into();
    Ok(made)
}

pub const BYTES: Figure = Figure {
    id: "U-auto-bytes",
    paper: Paper::Umbrage,
    title: "Error against memory",
    claim: "A map of facets is more exact than a depth map of many times its bytes.",
    look: "how many bytes a depth map needs to reach the error of a map of facets.",
    make: bytes,
};

/// Facet maps by the samples along a refined texel's side.
const FINE: [u32; 4] = [1, 2, 4, 8];

fn bytes(cx: &Context) -> anyhow::Result<Made> {
    let pixels = cx.pick(256, 96);
    let sizes: &[u32] = if cx.quick { &[128, 512] } else { &[64, 128, 256, 512, 1024, 2048] };
    let stages: &[usize] = &[3, 4, 7, 8, 10];
    // Means over the scenes: kilobytes and error, by recipe and size.
    let recipes: Vec<(String, String)> =
        std::iter::once(("depths under the papers' best mixture".to_string(), MIX.to_string()))
            .chain(FINE.iter().map(|fine| {
                let slots = 16.min(64 / fine);
                (format!("facets with {fine} × {fine} samples"), format!("auto,fine={fine},slots={slots}"))
            }))
            .collect();
    let mut found = vec![vec![(0.0, 0.0); sizes.len()]; recipes.len()];
    for (at, &texels) in sizes.iter().enumerate() {
        for &stage in stages {
            let judge = Judge::new(cx, STAGES[stage].1, pixels, texels);
            for (which, (_, recipe)) in recipes.iter().enumerate() {
                let (picture, each) = judge.by(cx, recipe, &Frame::CENTRES)?;
                let area = f64::from(judge.set.scene.lights[0].view.size().element_product());
                let one = &mut found[which][at];
                one.0 += each * area / 1024.0 / stages.len() as f64;
                one.1 += judge.error(&picture).rms / stages.len() as f64;
            }
        }
    }
    let mut made = Made::default();
    let mut plot = Plot::new(
        "Error against memory, mean of five scenes",
        Axis::log("kilobytes of the map"),
        Axis::log("rms of the fraction in shadow"),
    );
    let mut rows = Vec::new();
    for ((name, _), points) in recipes.iter().zip(&found) {
        plot = plot.add(Series::line(name, points.clone()));
        let cells = points.iter().map(|(kilobytes, rms)| format!("{rms:.4} in {kilobytes:.0} KB"));
        rows.push(std::iter::once(name.clone()).chain(cells).collect());
    }
    made.plots.push(("bytes".into(), plot.svg()));
    let head = std::iter::once("map".to_string()).chain(sizes.iter().map(|side| format!("{side}²"))).collect();
    made.tables.push(Table { name: "error and memory".into(), head, rows });
    let at_512 = sizes.iter().position(|side| *side == 512).unwrap_or(0);
    let (auto, last) = (found[3][at_512], sizes.len() - 1);
    made.measures = vec![
        Measure::at_most("4 × 4 at 512² over the largest depth map: error", auto.1 / found[0][last].1, "times", 1.0),
        Measure::at_most("4 × 4 at 512² over the largest depth map: bytes", auto.0 / found[0][last].0, "times", 0.5)
            .full_size(cx.quick),
        Measure::at_most("4 × 4 over 1 × 1 at 512²: error", auto.1 / found[1][at_512].1, "times", 0.8)
            .full_size(cx.quick),
    ];
    made.note = "Bytes count all that a map holds, tables and directories included.".into();
    Ok(made)
}
