//! The named faults of one scene under several methods: what a bias cures and what it costs.

use crate::figure::{Context, Figure, Paper};
use crate::stage::masks::{shadow_grid, value};
use crate::stage::panels::{shadow_panel, truth_panel};
use crate::stage::set::Set;
use glam::{DVec3, UVec2, Vec3};
use umbrage_oracle::{Contact, Evidence, Fault, Faults, faults, heat};
use umbrage_plane::Bias;
use umbrage_render::{Frame, Picture};
use umbrage_report::{Made, Measure, Panel, Role, Table};
use umbrage_sample::Jittered;
use umbrage_scene::{Light, Mesh, Scene, Shape, gallery};
use umbrage_shadow::{Biased, OnPlane, Pcf, presets};

pub const FAULTS: Figure = Figure {
    id: "U-faults",
    paper: Paper::Umbrage,
    title: "One board, every fault by name",
    claim: "A larger bias trades acne for detachment; comparison with the tangent plane has neither.",
    look: "the percentage-closer pictures: as the bias grows, acne disappears and detachment appears.",
    make: table,
};

/// The slab with a thin board standing on it and the light low beside it, so that biases of any use are longer than the board is thick.
fn standing_board() -> anyhow::Result<Scene> {
    let mut scene = gallery::box_plane();
    scene.name = "standing-board".into();
    scene.objects[0].shape = Shape::Mesh(Mesh::cuboid(Vec3::new(-2.6, -12.0, 0.0), Vec3::new(-2.0, 12.0, 18.0)));
    let (eye, target) = (DVec3::new(-80.0, 12.0, 60.0), DVec3::new(0.0, 0.0, 5.0));
    scene.lights = vec![Light::point("low lamp", eye, target, 62.0, 20.0, 260.0, UVec2::splat(1024))?];
    Ok(scene)
}

/// Where the board meets the slab on its shadow's side.
fn contacts(set: &Set) -> Vec<Contact> {
    let camera = &set.scene.camera;
    let pixel = |world: DVec3| camera.eye_to_texel(camera.world_to_eye().transform_point3(world));
    let light = &set.scene.lights[0].view;
    (-8..=8)
        .map(|step| {
            let foot = DVec3::new(-2.0, f64::from(step), 0.0);
            let away = foot - light.light().truncate();
            let toward = DVec3::new(away.x, away.y, 0.0).normalize();
            let pixels = pixel(foot + toward) - pixel(foot);
            let depth = -light.world_to_eye().transform_point3(foot).z;
            Contact {
                // A pixel beyond the edge, so that the board's own side does not count as its shadow.
                foot: pixel(foot) + pixels.normalize(),
                toward: pixels,
                world_per_pixel: 1.0 / pixels.length(),
                world_per_texel: light.texel_world(depth).max_element(),
            }
        })
        .collect()
}

const NAMES: [(&str, &str); 7] = [
    ("acne", "share"),
    ("leak", "share"),
    ("detachment", "world"),
    ("detachment", "texels"),
    ("edge shift", "px"),
    ("penumbra", "px"),
    ("noise", "share"),
];

fn numbers(found: &Faults) -> [f64; 7] {
    [
        value(found.acne.value),
        value(found.leak.value),
        value(found.detachment.value),
        value(found.detachment_texels),
        value(found.edge_shift.value),
        value(found.penumbra_width.value),
        value(found.noise.value),
    ]
}

/// A fault's map as colours; `scale` is the value drawn in the strongest colour.
fn map(name: &str, fault: &Fault, scale: f32, size: UVec2) -> Panel {
    let pixels = fault.map.iter().map(|v| heat(v / scale)).collect();
    Panel::rgb(name, name, size, pixels).with("strongest", scale).role(Role::Error)
}

fn table(cx: &Context) -> anyhow::Result<Made> {
    let set = Set::new(standing_board()?, cx.pick(512, 256), cx.pick(1024, 512));
    let truth = set.truth(cx);
    let contacts = contacts(&set);
    let pattern = Jittered::default();
    let many = pattern.with_num_samples(1024);
    let judge = |result: &Picture, smooth: Option<&Picture>| {
        faults(&Evidence {
            result: shadow_grid(result),
            truth: shadow_grid(&truth),
            smooth: smooth.map(shadow_grid),
            facing: &truth.facing[0],
            border: 6,
            contacts: &contacts,
        })
    };
    let frame = Frame { axis: 2, ..Frame::default() };
    let biased = |low, high| {
        let filter = |pattern| Pcf::default().with_pattern(pattern).with_depth(Biased::world(low, high));
        (set.shoot(cx, filter(pattern), &frame), set.shoot(cx, filter(many), &frame))
    };
    let on_plane = |pattern| {
        Pcf::default()
            .with_pattern(pattern)
            .with_depth(OnPlane::biased(Bias::World(0.02)))
            .with_res_factor(3.0)
            .with_min_size(0.0)
    };
    let ordinary = set.shoot(cx, presets::ordinary(Bias::World(0.35)).filter, &frame);
    let methods = [
        ("ordinary z-buffer, bias 0.35", (ordinary.clone(), ordinary)),
        ("percentage closer, bias 0", biased(0.0, 0.0)),
        ("percentage closer, bias .3–.4", biased(0.3, 0.4)),
        ("percentage closer, bias 3–4", biased(3.0, 4.0)),
        ("percentage closer on the tangent plane, bias .02", {
            (set.shoot(cx, on_plane(pattern), &frame), set.shoot(cx, on_plane(many), &frame))
        }),
    ];
    let mut made = Made::default();
    let mut rows = Vec::new();
    let mut all = Vec::new();
    for (name, (result, smooth)) in &methods {
        let found = judge(result, Some(smooth));
        let found_numbers = numbers(&found);
        rows.push(
            std::iter::once((*name).to_string()).chain(found_numbers.iter().map(|v| format!("{v:.4}"))).collect(),
        );
        all.push((found, found_numbers));
    }
    let head =
        std::iter::once("method".to_string()).chain(NAMES.map(|(name, unit)| format!("{name}, {unit}"))).collect();
    made.tables.push(Table { name: "faults".into(), head, rows });
    let size = truth.size;
    for (index, name) in [(1, "bias-0"), (2, "bias-0.3"), (3, "bias-3"), (4, "tangent-plane")] {
        made.panels.push(shadow_panel(name, methods[index].0, &methods[index].1.0).against("truth"));
    }
    made.panels.push(truth_panel(&truth));
    made.panels.push(map("acne", &all[1].0.acne, 1.0, size).with("of", methods[1].0));
    made.panels.push(map("leak", &all[3].0.leak, 1.0, size).with("of", methods[3].0));
    made.panels.push(map("detachment", &all[3].0.detachment, 4.0, size).with("of", methods[3].0));
    made.panels.push(map("edge shift", &all[2].0.edge_shift, 2.0, size).with("of", methods[2].0));
    made.panels.push(map("penumbra width", &all[2].0.penumbra_width, 1.0, size).with("of", methods[2].0));
    made.panels.push(map("noise", &all[2].0.noise, 0.5, size).with("of", methods[2].0));
    let [ordinary, none, listing, large, plane] = std::array::from_fn(|index| all[index].1);
    made.measures = vec![
        Measure::within("bias 0: acne", none[0], "share", 0.3, 0.55),
        Measure::at_most("bias .3–.4: acne over that", listing[0] / none[0], "ratio", 0.2).full_size(cx.quick),
        Measure::at_most("bias 3–4: acne over that", large[0] / none[0], "ratio", 1e-3),
        Measure::at_least("bias 3–4: detachment", large[2], "world units", 0.5),
        Measure::info("the same", large[3], "texels"),
        Measure::at_most("tangent plane: acne", plane[0], "share", 1e-3),
        Measure::at_most("tangent plane: detachment", plane[3], "texels", 3.0),
        Measure::at_least("bias 3–4 detaches more than the tangent plane by", large[2] - plane[2], "world units", 0.5),
        Measure::at_most("edge shift of percentage closer, bias .3–.4", listing[4].abs(), "px", 0.5),
        Measure::at_most(
            "edge width of the ordinary z-buffer less its filtered one",
            ordinary[5] - listing[5],
            "px",
            0.0,
        ),
    ];
    made.note =
        "Acne and leaks are measured away from truth's edges; detachment is the lit gap behind the board's foot."
            .into();
    Ok(made)
}
