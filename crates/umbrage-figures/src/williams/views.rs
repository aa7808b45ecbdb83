//! Williams 1978, Figures 1 and 2, and the teapot: the two views and a curved shadow on a curved surface.

use crate::figure::{Context, Figure, Paper};
use crate::stage::four_spheres::{BITS, disc, spheres};
use crate::stage::masks::{of, value};
use crate::stage::panels::{colour_panel, error_panel, shadow_panel};
use crate::stage::set::Set;
use glam::DVec2;
use umbrage_depth::{Raw, quantum};
use umbrage_oracle::metrics;
use umbrage_plane::{Bias, Kind, View};
use umbrage_render::{Frame, NOTHING, Picture};
use umbrage_report::{Made, Measure, Panel, Role};
use umbrage_scene::gallery;
use umbrage_shadow::{OnPlane, Pcf, presets};

pub const F1: Figure = Figure {
    id: "W78-F1",
    paper: Paper::Williams78,
    title: "The observer's view",
    claim: "Four shaded spheres, no shadow yet.",
    look: "the four spheres as the observer sees them, and the z-buffer, which holds their distances from the observer.",
    make: observer,
};

/// The observer's z-buffer in the paper's 16 bits.
fn depth_panel(picture: &Picture, camera: &View) -> Panel {
    let screen = camera.with_kind(Kind::Screen);
    let codes: Vec<Option<u32>> = picture
        .depth
        .iter()
        .map(|&zeta| zeta.is_finite().then(|| quantum(screen.key(f64::from(zeta)), BITS)))
        .collect();
    let seen = codes.iter().flatten();
    let (low, high) = seen.fold((u32::MAX, 0), |(low, high), &code| (low.min(code), high.max(code)));
    let grey = |code: u32| 0.85 * (code - low) as f32 / (high - low).max(1) as f32;
    let greys = codes.iter().map(|code| code.map_or(1.0, grey)).collect();
    Panel::grey("depth", "The observer's z-buffer, nearer darker", picture.size, greys)
        .with("bits", BITS)
        .with("codes", format!("{low}–{high}"))
        .role(Role::Map)
}

/// How many spheres show a whole disc of their own area (within one percent), and the greatest distance, in pixels, between a
/// circle and the outlines of those that border on background.
fn discs(picture: &Picture, view: &View, set: &Set) -> (u32, f64) {
    let (width, height) = (picture.size.x as usize, picture.size.y as usize);
    let (mut whole, mut worst) = (0, 0.0f64);
    for id in 0..set.scene.objects.len() as u32 {
        let (centre, radius) = disc(view, set, id);
        let area = picture.object.iter().filter(|object| **object == id).count() as f64;
        whole += u32::from((area / (std::f64::consts::PI * radius * radius) - 1.0).abs() < 0.01);
        for i in (0..width * height).filter(|&i| picture.object[i] == id) {
            let (x, y) = (i % width, i / width);
            let beside = [(x.wrapping_sub(1), y), (x + 1, y), (x, y.wrapping_sub(1)), (x, y + 1)];
            let background =
                |(x, y): (usize, usize)| x < width && y < height && picture.object[y * width + x] == NOTHING;
            if beside.into_iter().any(background) {
                let at = DVec2::new(x as f64 + 0.5, y as f64 + 0.5);
                worst = worst.max((at.distance(centre) - radius).abs());
            }
        }
    }
    (whole, worst)
}

fn observer(cx: &Context) -> anyhow::Result<Made> {
    let set = spheres(cx).in_colour();
    let picture = set.plain(cx, &Frame::CENTRES);
    let (whole, worst) = discs(&picture, &set.scene.camera, &set);
    Ok(Made {
        panels: vec![
            colour_panel("shaded", "From the observer, without shadow", picture.size, &picture.colour),
            depth_panel(&picture, &set.scene.camera),
        ],
        measures: vec![
            Measure::exactly("whole discs", f64::from(whole), "discs", 4.0),
            Measure::at_most("outline against a circle", worst, "px", 1.0),
        ],
        ..Made::default()
    })
}

pub const F2: Figure = Figure {
    id: "W78-F2",
    paper: Paper::Williams78,
    title: "The light's view",
    claim: "The same scene from a light at infinity, 100° to the left: what is hidden here is in shadow.",
    look: "which parts of the spheres the light sees, and which parts of Figure 1 it does not.",
    make: light_view,
};

fn light_view(cx: &Context) -> anyhow::Result<Made> {
    let mut set = spheres(cx).in_colour();
    let light = set.scene.lights[0].view;
    set.scene.camera = light;
    let picture = set.plain(cx, &Frame::CENTRES);
    let (whole, worst) = discs(&picture, &light, &set);
    let grey = umbrage_io::depth_view(&Raw::copy_of(&set.quantised(BITS)));
    Ok(Made {
        panels: vec![
            colour_panel("light", "From the light", picture.size, &picture.colour),
            Panel::grey("map", "The light's z-buffer, nearer darker", light.size(), grey)
                .with("bits", BITS)
                .role(Role::Map),
        ],
        measures: vec![
            Measure::exactly("whole discs, one being partly covered", f64::from(whole), "discs", 3.0),
            Measure::at_most("outline against a circle", worst, "px", 1.0),
        ],
        note: "Pass 1 stores depths only and shades nothing. The shaded picture is here to show what the light sees."
            .into(),
        ..Made::default()
    })
}

pub const TEAPOT: Figure = Figure {
    id: "U-teapot",
    paper: Paper::Williams78,
    title: "The teapot's curved shadow",
    claim: "A body of bicubic patches casts its shadow on a plane and on itself.",
    look: "the spout's shadow on the body, and the handle's on the ground.",
    make: teapot,
};

fn teapot(cx: &Context) -> anyhow::Result<Made> {
    let set = Set::new(gallery::teapot(), cx.pick(768, 256), 1024).in_colour().with_coloured_truths();
    let depth = OnPlane::biased(Bias::World(0.3));
    let Pcf { pattern, res_factor, min_size, cull, .. } = presets::reeves87_recommended().filter;
    let pattern = pattern.with_num_samples(64);
    let picture = set.shoot(
        cx,
        Pcf::default()
            .with_pattern(pattern)
            .with_depth(depth)
            .with_res_factor(res_factor)
            .with_min_size(min_size)
            .with_cull(cull),
        &Frame::default(),
    );
    let truth = set.truth(cx);
    let body =
        set.scene.objects.iter().position(|o| matches!(o.shape, umbrage_scene::Shape::Patches(_))).unwrap_or(0) as u32;
    let on_itself = of(&truth, |id| id == body);
    let own: Vec<bool> = (0..on_itself.len()).map(|i| on_itself[i] && truth.facing[0][i] > 0.2).collect();

    let self_shadow = value(metrics::mean(&truth.shadow[0], &own));
    let plane = of(&truth, |id| id != body);
    let cast = value(metrics::mean(&truth.shadow[0], &plane));
    let mut made = Made {
        panels: vec![
            colour_panel("shaded", "Percentage-closer filtering over a 1024² map", picture.size, &picture.colour)
                .with("map", "1024²")
                .with("NumSamples", 64)
                .with("samples per pixel", 16)
                .with("bias", "0.3 in front of the tangent plane")
                .against("truth"),
            colour_panel("truth", "Ray-traced truth", truth.size, &truth.colour).role(Role::Truth),
            shadow_panel("shadow", "Shadow component", &picture),
            error_panel("error", "Shadow minus truth", picture.size, &picture.shadow[0], &truth.shadow[0]),
        ],
        measures: vec![
            Measure::at_least("shadow on the plane", cast, "share of its pixels", 0.01),
            Measure::at_least("shadow on itself where it faces the light", self_shadow, "share of its pixels", 0.01),
        ],
        ..Made::default()
    };
    for (name, mask) in [("plane", &plane), ("teapot", &own)] {
        let error = value(metrics::rms(&picture.shadow[0], &truth.shadow[0], mask));
        made.measures.push(Measure::info(&format!("{name}: error of the shadow"), error, "rms share"));
    }
    let overlap = |shadow: &[f32]| -> Vec<bool> { shadow.iter().zip(&plane).map(|(s, on)| *on && *s > 0.5).collect() };
    let iou = metrics::iou(&overlap(&picture.shadow[0]), &overlap(&truth.shadow[0]));
    made.measures.push(Measure::at_least("shadow on the plane, overlap with truth", value(iou), "IoU", 0.95));
    Ok(made)
}
