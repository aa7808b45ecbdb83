//! Umbrage's own: all methods compared, against map size and under low light.

use crate::figure::{Context, Figure, Paper};
use crate::stage::masks::{acne, leak, leak_area, value};
use crate::stage::panels::{error_panel, shadow_panel, truth_panel};
use crate::stage::set::Set;
use glam::{DVec3, Vec3};
use umbrage_oracle::{gap_on_surface, metrics};
use umbrage_plane::SurfacePoint;
use umbrage_render::{Frame, Picture};
use umbrage_report::plot::{Axis, Plot, Series};
use umbrage_report::{Made, Measure, Table};
use umbrage_sample::Key;
use umbrage_scene::gallery;
use umbrage_shadow::Shadow;

/// A method's name and recipe. Biases are in texels, as worlds differ in size: 3 to 4 are Reeves' .3 to .4 at his world's and his map's size,
/// and Wang & Molnar's 15 in theirs.
pub(super) type Method = (&'static str, &'static str);

pub(super) const METHODS: [Method; 11] = [
    ("ordinary z-buffer", "reeves87,pattern=centre,res-factor=0,bias=3.5t"),
    ("Williams 1978", "williams78,lookup=bilinear,dither=1,bias=3.5t"),
    ("Reeves 1987", "reeves87,bias=3..4t"),
    ("Woo 1992", "woo92"),
    ("Wang & Molnar 1994", "wang-molnar94"),
    ("Burley 2006", "burley,max=4"),
    ("Fernando 2005", "fernando,max=4,bias=3.5t"),
    ("tangent plane, filtered", "reeves87,depth=plane,bias=0.5t"),
    ("midpoint in the cone", "woo92,depth=cone"),
    ("second depth, tangent plane, filtered", "reeves87,stored=back-face,depth=plane,slack=1,bias=0"),
    ("auto: facets, two planes", "auto"),
];

/// The number of methods at the head of the list that are published as such.
pub(super) const PUBLISHED: usize = 7;

/// Maps that are filtered before they are looked up.
pub(super) const PREFILTERED: [Method; 5] =
    [("vsm", "vsm"), ("esm", "esm"), ("evsm2", "evsm2"), ("evsm4", "evsm4"), ("msm", "msm")];

/// Engines' default filters.
pub(super) const ENGINES: [Method; 12] = [
    ("three-pcf", "three-pcf"),
    ("three-vsm", "three-vsm"),
    ("babylon-none", "babylon-none"),
    ("babylon-pcf", "babylon-pcf"),
    ("filament-pcf", "filament-pcf"),
    ("bevy-gaussian", "bevy-gaussian"),
    ("godot-pcf", "godot-pcf"),
    ("urp-hard", "urp-hard"),
    ("urp-soft", "urp-soft"),
    ("hdrp-pcf5", "hdrp-pcf5"),
    ("hdrp-pcf7", "hdrp-pcf7"),
    ("hdrp-pcss", "hdrp-pcss"),
];

/// Index of a method by its name.
pub(super) fn index(name: &str) -> usize {
    METHODS.iter().position(|method| method.0 == name).unwrap_or(METHODS.len())
}

/// The errors by which a picture is judged.
#[derive(Clone, Copy, Default)]
pub(super) struct Judged {
    pub acne: f64,
    pub leak: f64,
    /// The fraction of the pixels where leaks are looked for that receive a twentieth of the light or more.
    pub area: f64,
    pub rms: f64,
}

/// Border of the masks about truth's edges, in pixels.
fn border(cx: &Context) -> usize {
    cx.pick(6, 3)
}

pub(super) fn judge(cx: &Context, picture: &Picture, truth: &Picture) -> Judged {
    let seen: Vec<bool> = truth.share.iter().zip(&truth.facing[0]).map(|(s, f)| *s == 1.0 && *f > 0.05).collect();
    Judged {
        acne: acne(picture, truth, border(cx), |_| true),
        // Away from the soft edges that filters are made for; leaks at contacts lie farther in.
        leak: leak(picture, truth, cx.pick(2, 1)),
        area: leak_area(picture, truth, cx.pick(2, 1), 0.05),
        rms: value(metrics::rms(&picture.shadow[0], &truth.shadow[0], &seen)),
    }
}

pub const SIZES: Figure = Figure {
    id: "U-sizes",
    paper: Paper::Umbrage,
    title: "Every method on the table, against map size",
    claim: "Each method needs a map of some size, and leaves some error however large the map is.",
    look: "where each curve levels off: no larger map removes that error.",
    make: sizes,
};

fn sizes(cx: &Context) -> anyhow::Result<Made> {
    let sizes: &[u32] = if cx.quick { &[128, 512] } else { &[128, 256, 512, 1024, 2048] };
    let pixels = cx.pick(320, 160);
    let mut made = Made::default();
    let mut found = vec![vec![(Judged::default(), 0.0); sizes.len()]; METHODS.len()];
    let mut constant = Vec::new();
    for (at, &side) in sizes.iter().enumerate() {
        let set = Set::new(gallery::table(), pixels, side);
        let truth = set.truth_points(cx, &Frame::CENTRES);
        let close = Set::new(gallery::table_close_up(), pixels, side);
        for (method, (name, recipe)) in METHODS.iter().enumerate() {
            let picture = set.by(cx, recipe, &Frame::CENTRES)?;
            let shadow = close.shadow(cx, recipe)?;
            found[method][at] = (judge(cx, &picture, &truth), gap(cx, &close, &*shadow));
            if side == 512 && method >= index("Reeves 1987") && method <= index("Burley 2006") {
                made.panels
                    .push(shadow_panel(&format!("m{method}"), name, &picture).with("map", "512²").against("truth"));
                let (own, exact) = (&picture.shadow[0], &truth.shadow[0]);
                made.panels.push(error_panel(&format!("m{method}-error"), "Minus truth", truth.size, own, exact));
            }
        }
        if side == 512 {
            made.panels.push(truth_panel(&truth));
        }
        // As many world units as 3 to 4 texels are of a map of 512².
        let [low, high] = [3.0, 4.0].map(|texels| texels * f64::from(side) / 512.0);
        let in_world = set.by(cx, &format!("reeves87,bias={low}..{high}t"), &Frame::CENTRES)?;
        constant.push(judge(cx, &in_world, &truth));
        if side == sizes[sizes.len() - 1] {
            let reeves = METHODS[index("Reeves 1987")];
            let shrinking = set.by(cx, reeves.1, &Frame::CENTRES)?;
            for (name, caption, picture) in [
                ("shrinking", "Reeves 1987 on the largest map, bias of 3 to 4 texels", &shrinking),
                ("constant", "The same, bias in world units as on 512²", &in_world),
            ] {
                let panel = shadow_panel(name, caption, picture).with("map", format!("{side}²")).against("truth");
                made.panels.push(panel);
            }
        }
    }
    made.plots.push(("bias".into(), two_biases(sizes, &found[index("Reeves 1987")], &constant)));
    let curve = |title: &str, axis: &str, of: &dyn Fn(&(Judged, f64)) -> f64| {
        let mut plot = Plot::new(title, Axis::log("texels along a side of the map"), Axis::linear(axis));
        for (method, (name, _)) in METHODS.iter().enumerate() {
            let points = sizes.iter().zip(&found[method]).map(|(side, one)| (f64::from(*side), of(one))).collect();
            plot = plot.add(Series::line(name, points));
        }
        plot.svg()
    };
    made.plots.push(("error".into(), curve("Error against truth", "rms of the fraction in shadow", &|one| one.0.rms)));
    made.plots.push(("false-shadow".into(), curve("False shadow (M2)", "fraction", &|one| one.0.acne)));
    made.plots.push(("leak".into(), curve("Leak (M8)", "fraction", &|one| one.0.leak)));
    made.plots.push(("gap".into(), curve("Lit gap behind a leg (M7)", "world units", &|one| one.1)));
    let head = ["method", "map", "error, rms", "false shadow", "leak", "gap, world"].map(String::from).to_vec();
    let rows = METHODS.iter().zip(&found).flat_map(|((name, _), row)| {
        row.iter().zip(sizes).map(|((judged, gap), side)| {
            let numbers = [judged.rms, judged.acne, judged.leak].map(|v| format!("{v:.4}"));
            let [rms, acne, leak] = numbers;
            vec![(*name).to_string(), format!("{side}²"), rms, acne, leak, format!("{gap:.2}")]
        })
    });
    made.tables.push(Table { name: "methods".into(), head, rows: rows.collect() });
    let last = sizes.len() - 1;
    let of = |name: &str, at: usize| found[index(name)][at];
    let at_512 = sizes.iter().position(|side| *side == 512).unwrap_or(last);
    made.measures = vec![
        Measure::at_most("second depth, 512²: false shadow", of("Wang & Molnar 1994", at_512).0.acne, "share", 0.02),
        Measure::at_most(
            "second depth, 512²: gap behind the leg",
            of("Wang & Molnar 1994", at_512).1,
            "world units",
            1.0,
        ),
        Measure::at_least(
            "bias of 3 to 4 texels, 512²: gap behind the leg",
            of("Reeves 1987", at_512).1,
            "world units",
            3.0,
        ),
        Measure::info("midpoints, 512²: gap behind the leg", of("Woo 1992", at_512).1, "world units"),
        Measure::at_most(
            "auto, smallest map: gap behind the leg",
            of("auto: facets, two planes", 0).1,
            "world units",
            1.0,
        ),
        Measure::info("auto, smallest map: error", of("auto: facets, two planes", 0).0.rms, "rms share"),
        Measure::info("second depth, smallest map: error", of("Wang & Molnar 1994", 0).0.rms, "rms share"),
        Measure::info("bias, largest map: error", of("Reeves 1987", last).0.rms, "rms share"),
        Measure::info(
            "tangent plane, filtered, largest map: error",
            of("tangent plane, filtered", last).0.rms,
            "rms share",
        ),
    ];
    made.note = "All biases are 3 to 4 texels, so that they shrink in the world as the map grows. Reeves' regions are as wide as three pixels of the \
                 picture and do not shrink with them: on large maps they reach farther over the floor than so small a bias allows for (D-9), and \
                 false shadow rises. With the bias held at the world units that it has on 512², false shadow does not rise, as the first plot shows; but \
                 that bias detaches shadows equally far on every map. Pictures and truth are sampled at the same points, one per pixel."
        .into();
    Ok(made)
}

/// Reeves' false shadow against the map's size, by a bias that shrinks with the texels and by one that does not.
fn two_biases(sizes: &[u32], shrinking: &[(Judged, f64)], constant: &[Judged]) -> String {
    let line = |of: &dyn Fn(usize) -> f64| (0..sizes.len()).map(|at| (f64::from(sizes[at]), of(at))).collect();
    Plot::new(
        "Why Reeves' filter gets worse with larger maps",
        Axis::log("texels along a side of the map"),
        Axis::linear("false shadow, fraction (M2)"),
    )
    .add(Series::line("bias 3 to 4 texels: it shrinks as the map grows", line(&|at| shrinking[at].0.acne)))
    .add(Series::line("bias in world units, as on 512²", line(&|at| constant[at].acne)))
    .svg()
}

/// How far the floor stays lit behind the far side of the leg in the close-up, in world units (M7); 60 for a leg that casts no shadow.
fn gap(cx: &Context, close: &Set, shadow: &dyn Shadow) -> f64 {
    const FAR: f32 = 60.0;
    let foot = DVec3::new(-272.0, 0.0, 176.0);
    let away = foot - close.scene.lights[0].view.light().truncate();
    let point = SurfacePoint::at(foot.as_vec3(), Vec3::Y);
    let along = Vec3::new(away.x as f32, 0.0, away.z as f32);
    // A little off the leg's own face.
    let beside = SurfacePoint::at(point.position + (along.normalize() * 0.05).as_dvec3(), Vec3::Y);
    f64::from(gap_on_surface(shadow, &beside, along, 0.25, FAR, Key::new(cx.seed, 0, 0)).unwrap_or(FAR))
}

pub const GRAZING: Figure = Figure {
    id: "U-grazing",
    paper: Paper::Umbrage,
    title: "Every method under a low sun",
    claim: "With the sun six degrees above the floor, a texel's depth step is ten texels deep, and most methods fail.",
    look: "the floor under the low sun, where most methods leave stripes or nothing.",
    make: grazing,
};

fn grazing(cx: &Context) -> anyhow::Result<Made> {
    let set = Set::new(gallery::grazing(), cx.pick(384, 192), cx.pick(1024, 512));
    let truth = set.truth_points(cx, &Frame::CENTRES);
    let mut made = Made::default();
    let mut rows = Vec::new();
    let mut all = Vec::new();
    for (method, (name, recipe)) in METHODS.iter().enumerate() {
        let picture = set.by(cx, recipe, &Frame::CENTRES)?;
        let found = judge(cx, &picture, &truth);
        made.panels.push(shadow_panel(&format!("m{method}"), name, &picture).with("recipe", recipe).against("truth"));
        let (own, exact) = (&picture.shadow[0], &truth.shadow[0]);
        made.panels.push(error_panel(&format!("m{method}-error"), "Minus truth", truth.size, own, exact));
        rows.push(row(name, [found.rms, found.acne, found.leak]));
        all.push(found);
    }
    made.panels.push(truth_panel(&truth));
    let head = ["method", "error, rms", "false shadow", "leak"].map(String::from).to_vec();
    made.tables.push(Table { name: "faults".into(), head, rows });
    let of = |name: &str| all[index(name)];
    made.measures = vec![
        Measure::at_least("ordinary z-buffer, 3.5 texels: false shadow", of("ordinary z-buffer").acne, "share", 0.05),
        Measure::at_least("Reeves, 3 to 4 texels: false shadow", of("Reeves 1987").acne, "share", 0.05),
        Measure::at_most("second depth: false shadow", of("Wang & Molnar 1994").acne, "share", 0.005),
        Measure::at_least("cone of slope 2, far beyond its 63.4°: false shadow", of("Burley 2006").acne, "share", 0.05),
        Measure::at_most("tangent plane, filtered: false shadow", of("tangent plane, filtered").acne, "share", 0.005),
        Measure::info("midpoints: false shadow", of("Woo 1992").acne, "share"),
        Measure::at_most("auto: false shadow", of("auto: facets, two planes").acne, "share", 0.0005),
        Measure::at_most("auto: leak", of("auto: facets, two planes").leak, "share", 0.0005),
    ];
    made.note = "A bias that would end the false shadow of plain comparison here is larger than the casters are thick. Knowing the surface or what \
                 lies behind it helps; a larger bias does not."
        .into();
    Ok(made)
}

pub(super) fn row(name: &str, values: impl IntoIterator<Item = f64>) -> Vec<String> {
    std::iter::once(name.to_string()).chain(values.into_iter().map(|value| format!("{value:.4}"))).collect()
}
