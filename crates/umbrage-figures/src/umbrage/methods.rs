//! Our own: every method beside every other, against map size, under low light, and over all scenes by named fault.

use crate::figure::{Context, Figure, Paper};
use crate::stage::masks::{acne, leak, value};
use crate::stage::panels::{error_panel, shadow_panel, truth_panel};
use crate::stage::set::Set;
use glam::{DVec3, UVec2, Vec3};
use umbrage_oracle::{gap_on_surface, heat, metrics};
use umbrage_plane::SurfacePoint;
use umbrage_render::{Frame, Picture};
use umbrage_report::plot::{Axis, Plot, Series};
use umbrage_report::{Made, Measure, Panel, Role, Table};
use umbrage_sample::Key;
use umbrage_scene::gallery::{self, Make};
use umbrage_shadow::Shadow;

/// A method's name and recipe. Biases are in texels, as worlds differ in size: 3 to 4 are Reeves' .3 to .4 at his world's and his map's size,
/// and Wang & Molnar's 15 in theirs.
type Method = (&'static str, &'static str);

const METHODS: [Method; 10] = [
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
];

/// So many of them, the first, are published as such.
const PUBLISHED: usize = 7;

/// Index of a method by its name.
fn index(name: &str) -> usize {
    METHODS.iter().position(|method| method.0 == name).unwrap_or(METHODS.len())
}

/// What one picture is judged by.
#[derive(Clone, Copy, Default)]
struct Judged {
    acne: f64,
    leak: f64,
    rms: f64,
}

/// One number of a judgement.
type Fault = fn(&Judged) -> f64;

/// Border of the masks about truth's edges, in pixels.
fn border(cx: &Context) -> usize {
    cx.pick(6, 3)
}

fn judge(cx: &Context, picture: &Picture, truth: &Picture) -> Judged {
    let seen: Vec<bool> = truth.share.iter().zip(&truth.facing[0]).map(|(s, f)| *s == 1.0 && *f > 0.05).collect();
    Judged {
        acne: acne(picture, truth, border(cx), |_| true),
        // Beside the soft edges that filters are made for; what contacts leak lies farther in.
        leak: leak(picture, truth, cx.pick(2, 1)),
        rms: value(metrics::rms(&picture.shadow[0], &truth.shadow[0], &seen)),
    }
}

pub const SIZES: Figure = Figure {
    id: "U-sizes",
    paper: Paper::Umbrage,
    title: "Every method on the table, against map size",
    claim: "What each method needs of a map, and what it leaves wrong however large the map is.",
    make: sizes,
};

fn sizes(cx: &Context) -> anyhow::Result<Made> {
    let sizes: &[u32] = if cx.quick { &[128, 512] } else { &[128, 256, 512, 1024, 2048] };
    let pixels = cx.pick(320, 160);
    let mut made = Made::default();
    let mut found = vec![vec![(Judged::default(), 0.0); sizes.len()]; METHODS.len()];
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
                made.panels.push(error_panel(&format!("m{method}-error"), "Less truth", truth.size, own, exact));
            }
        }
        if side == 512 {
            made.panels.push(truth_panel(&truth));
        }
    }
    let curve = |title: &str, axis: &str, of: &dyn Fn(&(Judged, f64)) -> f64| {
        let mut plot = Plot::new(title, Axis::log("texels along a side of the map"), Axis::linear(axis));
        for (method, (name, _)) in METHODS.iter().enumerate() {
            let points = sizes.iter().zip(&found[method]).map(|(side, one)| (f64::from(*side), of(one))).collect();
            plot = plot.add(Series::line(name, points));
        }
        plot.svg()
    };
    made.plots.push(("error".into(), curve("Error against truth", "rms share of shadow", &|one| one.0.rms)));
    made.plots.push(("false-shadow".into(), curve("False shadow (M2)", "share", &|one| one.0.acne)));
    made.plots.push(("leak".into(), curve("Leak (M8)", "share", &|one| one.0.leak)));
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
        Measure::info("second depth, smallest map: error", of("Wang & Molnar 1994", 0).0.rms, "rms share"),
        Measure::info("bias, largest map: error", of("Reeves 1987", last).0.rms, "rms share"),
        Measure::info(
            "tangent plane, filtered, largest map: error",
            of("tangent plane, filtered", last).0.rms,
            "rms share",
        ),
    ];
    made.note = "All biases are 3 to 4 texels, so that they shrink as the map grows. Pictures and truth are asked at the same points, one a pixel.".into();
    Ok(made)
}

/// How far behind the far side of the leg that the close-up shows the floor stays lit, in world units (M7); 60 for a leg that throws no shadow.
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
    claim: "Six degrees above the floor a texel's depth step is ten texels deep: what each method makes of it.",
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
        made.panels.push(error_panel(&format!("m{method}-error"), "Less truth", truth.size, own, exact));
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
    ];
    made.note = "A bias that would end the false shadow of plain comparison here is longer than the things are thick. What is known of the surface \
                 or of what lies behind it helps; a larger bias does not."
        .into();
    Ok(made)
}

fn row(name: &str, values: impl IntoIterator<Item = f64>) -> Vec<String> {
    std::iter::once(name.to_string()).chain(values.into_iter().map(|value| format!("{value:.4}"))).collect()
}

pub const PRESETS: Figure = Figure {
    id: "U-presets",
    paper: Paper::Umbrage,
    title: "All methods, all scenes, every fault by name",
    claim: "No published method is free of false shadow and leaks on every scene; which fault each one has is a property of the method.",
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

fn presets(cx: &Context) -> anyhow::Result<Made> {
    let (pixels, texels, cell) = (cx.pick(256, 96), cx.pick(512, 256), cx.pick(128, 96));
    let mut found = vec![[Judged::default(); STAGES.len()]; METHODS.len()];
    let mut sheet = Sheet::new(STAGES.len() as u32, METHODS.len() as u32 + 1, cell);
    for (column, (_, make, _)) in STAGES.iter().enumerate() {
        let set = Set::new(make(), pixels, texels);
        let truth = set.truth_points(cx, &Frame::CENTRES);
        let grey: Vec<Vec3> = truth.colour.clone();
        sheet.place(column as u32, 0, truth.size, &grey);
        for (method, (_, recipe)) in METHODS.iter().enumerate() {
            let picture = set.by(cx, recipe, &Frame::CENTRES)?;
            found[method][column] = judge(cx, &picture, &truth);
            let apart = picture.shadow[0].iter().zip(&truth.shadow[0]).map(|(own, exact)| heat(own - exact));
            sheet.place(column as u32, method as u32 + 1, truth.size, &apart.collect::<Vec<_>>());
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
            self::row(method.0, values.into_iter().chain([mean]))
        };
        let rows = METHODS.iter().zip(&found).map(line).collect();
        let head = std::iter::once(name).chain(STAGES.iter().map(|stage| stage.0)).chain(["mean"]);
        made.tables.push(Table { name: name.into(), head: head.map(String::from).collect(), rows });
    }
    let names = STAGES.map(|stage| stage.0).join(", ");
    let methods = METHODS.map(|method| method.0).join(", ");
    let panel =
        Panel::rgb("matrix", "Every method (rows) on every scene (columns), less truth", sheet.size, sheet.pixels);
    made.panels.push(panel.with("columns", names).with("rows", format!("the scene, {methods}")).role(Role::Error));
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
    let others = METHODS.iter().filter(|method| method.0 != "midpoint in the cone").map(|method| sum(method.0));
    measures.push(Measure::at_most(
        "midpoints in the cone: false shadow on all scenes less the least of the others",
        sum("midpoint in the cone") - others.fold(f64::INFINITY, f64::min),
        "sum of shares",
        0.0,
    ));
    let clean = |one: &Judged| !(one.acne > 0.005 || one.leak > 0.02 || one.rms.is_nan());
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
    made.note = "False shadow is looked for on lit surfaces that face the light, leaks on shadowed ones, both off truth's edges; the error is \
                 that of every wholly covered pixel. Midpoints in Burley's cone are a mix that nobody published. Soft methods are judged against the hard truth of a point light. Maps are 512², a pixel is asked once."
        .into();
    Ok(made)
}

/// Pictures made small and laid out in rows and columns.
struct Sheet {
    size: UVec2,
    cell: u32,
    pixels: Vec<Vec3>,
}

impl Sheet {
    fn new(columns: u32, rows: u32, cell: u32) -> Self {
        let size = UVec2::new(columns, rows) * cell;
        Self { size, cell, pixels: vec![Vec3::ZERO; (size.x * size.y) as usize] }
    }

    /// Each pixel of a cell is the mean of the picture's pixels under it; a picture of other proportions leaves a bar below.
    fn place(&mut self, column: u32, row: u32, size: UVec2, picture: &[Vec3]) {
        let scale = f64::from(size.max_element()) / f64::from(self.cell);
        let span = |at: u32, most: u32| {
            let from = (f64::from(at) * scale) as u32;
            from..(((f64::from(at) + 1.0) * scale) as u32).max(from + 1).min(most)
        };
        for y in 0..self.cell {
            for x in 0..self.cell {
                let (columns, rows) = (span(x, size.x), span(y, size.y));
                let all: Vec<Vec3> = rows
                    .flat_map(|row| columns.clone().map(move |column| picture[(row * size.x + column) as usize]))
                    .collect();
                if !all.is_empty() {
                    let at = (row * self.cell + y) * self.size.x + column * self.cell + x;
                    self.pixels[at as usize] = all.iter().sum::<Vec3>() / all.len() as f32;
                }
            }
        }
    }
}
