//! Burley 2006, Image 76: soft shadows from one map.

use crate::figure::{Context, Figure, Paper};
use crate::stage::masks::{acne, of, value};
use crate::stage::panels::{as_shaded, colour_panel, error_panel, shadow_and_error, shadow_panel, truth_panel};
use crate::stage::penumbra::{Edge, axial, burley_max, depth_step, mean_shadow};
use crate::stage::set::Set;
use glam::{DVec3, Vec3};
use umbrage_oracle::{metrics, predict};
use umbrage_plane::SurfacePoint;
use umbrage_recipe::Recipe;
use umbrage_render::{Frame, light_map};
use umbrage_report::plot::{Axis, Plot, Series};
use umbrage_report::text::short;
use umbrage_report::{Made, Measure, Role, Table};
use umbrage_scene::gallery;
use umbrage_shadow::Shadow;

/// Radius of the disc-shaped light, world units.
pub const LIGHT: f64 = 25.0;
/// Id of the floor in the gallery's contact-box.
pub const FLOOR: u32 = 1;
/// The silhouette of the box, seen from its light, is its upright corner here and at −z.
pub const CORNER: DVec3 = DVec3::new(-10.0, 0.0, 40.0);
/// Where widths are taken: x on the floor; the box ends at 10, the light passes over its top beyond 163.
const PLACES: [f64; 8] = [20.0, 35.0, 50.0, 70.0, 90.0, 110.0, 130.0, 150.0];
/// Taps of every soft recipe here.
pub const TAPS: &str = "search=64,blur=64";

pub const I76: Figure = Figure {
    id: "B06-I76",
    paper: Paper::Burley06,
    title: "Soft shadows from one map",
    claim: "A shadow is sharp where things touch and grows softer with distance, without acne at the contact.",
    look: "the shadow from foot to tip: sharp at the contact, softer farther away.",
    make: soft,
};

/// The shadow's edge on the floor at some x, in +z or −z, and where on the box it comes from.
fn edge(set: &Set, x: f64, side: f64) -> (Edge, DVec3) {
    let light = set.scene.lights[0].view.light().truncate();
    let corner = DVec3::new(CORNER.x, 0.0, CORNER.z * side);
    let share = (x - light.x) / (corner.x - light.x);
    let middle = DVec3::new(x, 0.0, light.z + (corner.z - light.z) * share);
    let along = DVec3::new(corner.x - light.x, 0.0, corner.z - light.z).normalize();
    let across = along.cross(DVec3::Y) * -side;
    let width = 2.0 * LIGHT * (share - 1.0);
    let into_shadow = (if across.z * side > 0.0 { -across } else { across }).as_vec3();
    let edge = Edge {
        middle: middle.as_vec3(),
        normal: Vec3::Y,
        into_shadow,
        half_width: (0.9 * width) as f32 + 1.5,
        half_length: 1.5,
    };
    (edge, light + (middle - light) / share)
}

/// D-16's 10–90 % width there, world units.
fn predicted(set: &Set, x: f64) -> f64 {
    let (edge, occluder) = edge(set, x, 1.0);
    let view = &set.scene.lights[0].view;
    predict::DISC_EDGE_10_90
        * predict::expected_penumbra_width(2.0 * LIGHT, axial(view, occluder), axial(view, edge.middle.as_dvec3()))
}

/// The recipes that are compared: names and texts.
fn recipes(set: &Set) -> [(&'static str, &'static str, String); 4] {
    let view = &set.scene.lights[0].view;
    let max = burley_max(view, LIGHT, axial(view, DVec3::new(CORNER.x, 60.0, CORNER.z)));
    let step = depth_step(view, DVec3::new(90.0, 0.0, 45.0), DVec3::Y);
    let bias = |radius: f64| predict::acne_free_bias(step, 0.0, radius);
    [
        ("burley", "Burley", format!("burley,max={max:.3}t,{TAPS}")),
        ("light", "Burley, radius by the light's size", format!("burley,light={LIGHT},nearest=760,{TAPS}")),
        (
            "fernando",
            "Fernando, the bias that D-9 asks for",
            format!("fernando,max={max:.3}t,bias={:.3},{TAPS}", bias(max)),
        ),
        (
            "before",
            "Constant radius, constant bias",
            format!("reeves87,pattern=disc,samples=64,res-factor=0,min-size=16,bias={:.3}", bias(16.0)),
        ),
    ]
}

/// A recipe over its own map of light 0.
pub fn bound(cx: &Context, set: &Set, recipe: &str) -> anyhow::Result<Box<dyn Shadow>> {
    let recipe: Recipe = recipe.parse()?;
    Ok(recipe.bind(light_map(&recipe, &set.scene, &set.scene.lights[0].view), cx.storage)?)
}

/// Floor close behind the box, where its shadow begins.
fn strip() -> Vec<SurfacePoint> {
    let place = |i: u32| {
        let (x, z) = (10.3 + 0.3 * (i % 20) as f32, (i / 20) as f32 - 30.0);
        SurfacePoint { region: i, object: FLOOR, ..SurfacePoint::at(Vec3::new(x, 0.0, z), Vec3::Y) }
    };
    (0..20 * 61).map(place).collect()
}

fn soft(cx: &Context) -> anyhow::Result<Made> {
    let set = Set::new(gallery::contact_box(), cx.pick(320, 128), 1024).in_colour().with_coloured_truths();
    let recipes = recipes(&set);
    let mut made = Made::default();
    let truth = set.truth_disc(cx, &Frame::CENTRES, LIGHT);
    let shown = as_shaded(&truth);
    let (mut widths, mut contact, mut false_shadow) = (Vec::new(), Vec::new(), Vec::new());
    let at = |shadow: &dyn Shadow| -> Vec<(f64, f64)> {
        let at = |x: f64, side: f64| edge(&set, x, side).0.width(cx, shadow);
        let mean = |x: f64| f64::midpoint(at(x, 1.0), at(x, -1.0));
        PLACES.iter().map(|&x| (x, mean(x))).collect()
    };
    let geometry = set.geometry();
    let light = set.disc_light(cx, &geometry, LIGHT);
    let exact = at(&light);
    for (name, caption, recipe) in &recipes {
        let shadow = bound(cx, &set, recipe)?;
        widths.push(at(&*shadow));
        contact.push(mean_shadow(cx, &*shadow, &strip()));
        let picture = set.draw(cx, &*shadow, &Frame::CENTRES);
        false_shadow.push(acne(&picture, &truth, 6, |_| true));
        shadow_and_error(&mut made, (name, caption), ("recipe", recipe), &as_shaded(&picture), &shown);
        if *name == "burley" {
            let panel = colour_panel("burley-colour", "Burley, shaded", picture.size, &picture.colour);
            made.panels.insert(0, panel.against("truth-colour"));
        }
    }
    let panel = colour_panel("truth-colour", "Ray-traced truth, shaded", truth.size, &truth.colour);
    made.panels.insert(1, panel.role(Role::Truth));
    made.panels.push(truth_panel(&shown).with("light's radius", LIGHT).with("samples", cx.pick(256, 64)));
    let expected: Vec<(f64, f64)> = PLACES.iter().map(|&x| (x, predicted(&set, x))).collect();
    judge(cx, &mut made, (&widths, &exact, &expected), &contact, &false_shadow);
    made.measures.push(Measure::info(
        "truth: shadow of the strip behind the box",
        mean_shadow(cx, &light, &strip()),
        "share",
    ));
    overlapping(cx, &mut made)?;
    made.note = format!(
        "The light is a disc of radius {LIGHT}; {:.3} of its penumbra lies between 10 and 90 %. \
        Burley's largest radius is that of D-16 for occluders halfway up the box, and the constant biases are \
        those of D-9 for the floor halfway along the shadow. Fernando's search of the same radius needs so \
        large a bias that the box's shadow goes missing near its foot. Faces turned away from the light are drawn \
        in shadow, as shading makes them: the map is never looked up for them.",
        predict::DISC_EDGE_10_90
    );
    Ok(made)
}

type Widths = Vec<(f64, f64)>;

fn judge(
    cx: &Context,
    made: &mut Made,
    (widths, exact, expected): (&[Widths], &Widths, &Widths),
    contact: &[f64],
    false_shadow: &[f64],
) {
    let off = |line: &Widths, from: &Widths| -> Vec<f64> {
        line.iter().zip(from).map(|(a, b)| (a.1 / b.1 - 1.0).abs()).collect()
    };
    let most = |errors: &[f64]| errors.iter().fold(0.0, |most: f64, &e| if e.is_nan() || e > most { e } else { most });
    for (line, name) in ["Burley", "by the light's size"].iter().enumerate() {
        let line_widths = &widths[line];
        let falls = line_widths.windows(2).filter(|pair| pair[1].1 <= pair[0].1 || pair[1].1.is_nan()).count();
        let fit = metrics::linear_fit(line_widths).map(|fit| fit.r2);
        made.measures.extend([
            Measure::exactly(
                &format!("{name}: places where the edge is not wider than before (M1)"),
                falls as f64,
                "places",
                0.0,
            )
            .full_size(cx.quick),
            Measure::at_least(&format!("{name}: straight line through the widths, R²"), value(fit), "", 0.9),
            Measure::at_most(
                &format!("{name}: largest deviation of a width from D-16"),
                most(&off(line_widths, expected)),
                "ratio",
                0.35,
            )
            .full_size(cx.quick),
            Measure::info(
                &format!("{name}: largest deviation of a width from the area light's"),
                most(&off(line_widths, exact)),
                "ratio",
            ),
            Measure::at_least(&format!("{name}: shadow of the strip behind the box"), contact[line], "share", 0.95),
            Measure::at_most(&format!("{name}: false shadow (M2)"), false_shadow[line], "share", 0.005),
        ]);
    }
    let near = |line: usize| off(&widths[line], exact)[0];
    made.measures.extend([
        Measure::at_least(
            "Fernando: width error at x = 20, near the contact, over Burley's",
            near(2) / near(0),
            "ratio",
            1.0,
        ),
        Measure::info("Fernando: shadow of the strip behind the box", contact[2], "share"),
        Measure::info("constant radius and bias: shadow of the strip behind the box", contact[3], "share"),
    ]);
    let names = ["Burley", "Burley by the light's size", "Fernando", "constant radius"];
    let mut plot = Plot::new(
        "Width of the shadow's edge",
        Axis::linear("x on the floor, world units"),
        Axis::linear("10–90 % width, world units"),
    )
    .add(Series::line("area light, predicted (D-16)", expected.clone()))
    .add(Series::dots("area light, by rays", exact.clone()));
    for (name, line) in names.iter().zip(widths) {
        plot = plot.add(Series::line(name, line.clone()));
    }
    made.plots.push(("width".into(), plot.svg()));
    let head = ["x", "D-16", "area light"].iter().chain(&names).map(ToString::to_string).collect();
    let row = |i: usize| {
        let numbers = [expected[i].0, expected[i].1, exact[i].1].into_iter().chain(widths.iter().map(|line| line[i].1));
        numbers.map(|number| short(number, 3)).collect()
    };
    made.tables.push(Table { name: "widths".into(), head, rows: (0..PLACES.len()).map(row).collect() });
}

/// A board high above: one search meets occluders at two depths.
fn overlapping(cx: &Context, made: &mut Made) -> anyhow::Result<()> {
    let set = Set::new(gallery::overlapping_boxes(), cx.pick(256, 128), 1024);
    let truth = set.truth_disc(cx, &Frame::CENTRES, LIGHT);
    let shown = as_shaded(&truth);
    let geometry = set.geometry();
    let light = set.disc_light(cx, &geometry, LIGHT);
    // The box's edge just before the board's penumbra begins.
    let edges = [76.0, 80.0, 84.0].map(|x| edge(&set, x, 1.0).0);
    let exact: Vec<f64> = edges.iter().map(|edge| edge.width(cx, &light)).collect();
    let mut errors = Vec::new();
    for (name, caption, recipe) in &recipes(&set)[..3] {
        let shadow = bound(cx, &set, recipe)?;
        let off = edges.iter().zip(&exact).map(|(edge, exact)| (edge.width(cx, &*shadow) / exact - 1.0).abs());
        errors.push(off.sum::<f64>() / exact.len() as f64);
        let picture = set.draw(cx, &*shadow, &Frame::CENTRES);
        let mask = metrics::both(&metrics::penumbra_mask(&truth.shadow[0]), &of(&truth, |id| id == FLOOR));
        let rms = value(metrics::rms(&picture.shadow[0], &truth.shadow[0], &mask));
        made.measures.push(Measure::info(&format!("overlapping, {caption}: rms error in the penumbra"), rms, "share"));
        let drawn = as_shaded(&picture);
        made.panels.push(error_panel(
            &format!("overlapping-{name}-error"),
            &format!("Overlapping occluders, {caption}: minus truth"),
            picture.size,
            &drawn.shadow[0],
            &shown.shadow[0],
        ));
        if *name == "burley" {
            made.panels.push(
                shadow_panel("overlapping-burley", "Overlapping occluders, Burley", &drawn)
                    .against("overlapping-truth"),
            );
        }
    }
    let mut panel = shadow_panel("overlapping-truth", "Overlapping occluders, ray-traced area light", &shown);
    panel.role = Role::Truth;
    made.panels.push(panel);
    made.measures.push(Measure::info(
        "overlapping, Burley: mean width error beside the board's shadow",
        errors[0],
        "ratio",
    ));
    made.measures.push(Measure::at_least(
        "overlapping: Fernando's width error beside the board's shadow over Burley's",
        errors[2] / errors[0],
        "ratio",
        1.0,
    ));
    Ok(())
}
