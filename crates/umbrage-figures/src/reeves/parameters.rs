//! Reeves, Salesin & Cook 1987, Figures 7, 8 and 10, the float and pass-1 remarks: what each parameter does.

use crate::figure::{Context, Figure, Paper};
use crate::stage::masks::{of, shadow_grid, value};
use crate::stage::panels::{error_panel, shadow_panel, truth_panel, zoomed, zoomed_error};
use crate::stage::set::{Set, with_kind};
use crate::stage::sphere_plane::{CAST_EDGE, PLANE, false_shadow, penumbra};
use glam::{DVec2, DVec3};
use std::sync::Arc;
use umbrage_depth::Tiled;
use umbrage_oracle::metrics::{self, Band};
use umbrage_plane::{Bias, Kind, Sampling};
use umbrage_render::{Frame, Picture};
use umbrage_report::plot::{Axis, Plot, Series};
use umbrage_report::{Made, Measure, Role};
use umbrage_sample::{Centre, Jittered, Pattern, Uniform};
use umbrage_scene::{Scene, gallery};
use umbrage_shadow::{Biased, OnPlane, Pcf, presets};

/// Percentage-closer filtering with a bias large enough that no acne mixes with what is measured (T-6).
fn soft<P: Pattern>(pattern: P, res_factor: f32) -> Pcf<P> {
    Pcf::default()
        .with_pattern(pattern)
        .with_depth(Biased::world(1.2, 1.6))
        .with_res_factor(res_factor)
        .with_min_size(0.0)
}

fn jittered(num_samples: u32) -> Jittered {
    Jittered::default().with_num_samples(num_samples)
}

/// Where the box scene's zooms look: the straight edge of the box's shadow.
const BOX_EDGE: DVec2 = DVec2::new(0.475, 0.5);

pub const F7: Figure = Figure {
    id: "R87-F7",
    paper: Paper::Reeves87,
    title: "NumSamples 1, 4, 16",
    claim: "Noise falls with the number of samples.",
    look: "the grain in the soft edge, coarse with one sample and gone with sixteen.",
    make: num_samples,
};

fn num_samples(cx: &Context) -> anyhow::Result<Made> {
    let set = Set::new(gallery::box_plane(), cx.pick(512, 192), 1024);
    let limit = set.shoot(cx, soft(jittered(1024), 8.0), &Frame::CENTRES);
    let mask = penumbra(&limit);
    let noise = |picture: &Picture| value(metrics::rms(&picture.shadow[0], &limit.shadow[0], &mask));
    let mut made = Made::default();
    let random_limit = set.shoot(cx, soft(Uniform::default().with_num_samples(1024), 8.0), &Frame::CENTRES);
    let (mut jitter, mut uniform) = (Vec::new(), Vec::new());
    for (n, most) in [(1, 2), (4, 7), (16, 23), (64, 87)] {
        let picture = set.shoot(cx, soft(jittered(n), 8.0), &Frame::CENTRES);
        jitter.push((f64::from(n), noise(&picture)));
        let random = set.shoot(cx, soft(Uniform::default().with_num_samples(n), 8.0), &Frame::CENTRES);
        uniform.push((f64::from(n), value(metrics::rms(&random.shadow[0], &random_limit.shadow[0], &mask))));
        let levels = metrics::levels_per_region(&picture.shadow[0], 86);
        let name = format!("NumSamples {n}: levels per region");
        made.measures.push(Measure::at_most(&name, value(levels.map(f64::from)), "levels", f64::from(most)));
        if n <= 16 {
            let caption = format!("NumSamples {n}");
            let panel = zoomed(&format!("n{n:02}"), &caption, &picture, BOX_EDGE, 8);
            made.panels.push(panel.with("ResFactor", 8).with("map", "1024²").against("limit"));
        }
        if n == 16 {
            made.panels.push(zoomed_error("error", "16 samples minus 1,024", &picture, &limit, BOX_EDGE, 8));
        }
    }
    let panel = zoomed("limit", "1,024 samples: the filter's own limit", &limit, BOX_EDGE, 8);
    made.panels.push(panel.role(Role::Truth));
    let panel = zoomed("truth", "Ray-traced truth (a point light: a sharp edge)", &set.truth(cx), BOX_EDGE, 8);
    made.panels.push(panel.role(Role::Truth));
    let slope = |points: &[(f64, f64)]| value(metrics::log_log_fit(points).map(|fit| fit.slope));
    made.measures.push(Measure::within(
        "jittered: slope of log noise against log N (M6)",
        slope(&jitter),
        "",
        -0.9,
        -0.6,
    ));
    made.measures.push(Measure::within("uniform: the same slope", slope(&uniform), "", -0.6, -0.4));
    let plot = Plot::new("Noise in a soft edge", Axis::log("NumSamples"), Axis::log("rms error"))
        .add(Series::line("jittered", jitter))
        .add(Series::line("uniform", uniform));
    made.plots.push(("noise".into(), plot.svg()));
    made.note = "The enlargements repeat pixels; there is one region per pixel.".into();
    Ok(made)
}

/// The straight edge that the box's top casts on the slab, as a band of pixels.
fn straight_edge(scene: &Scene, half_width: f64) -> Band {
    // The edge x = 0 at the top of the box, z = 24, seen from the light at (−30, 5, 110), falls on z = 0.
    let light = DVec3::new(-30.0, 5.0, 110.0);
    let on_slab = |y: f64| {
        let corner = DVec3::new(0.0, y, 24.0);
        light + (corner - light) * (light.z / (light.z - corner.z))
    };
    let pixel = |world: DVec3| scene.camera.eye_to_texel(scene.camera.world_to_eye().transform_point3(world));
    let (a, b) = (on_slab(-16.0), on_slab(16.0));
    Band::between(pixel(a), pixel(b), pixel(a - DVec3::X), half_width)
}

pub const F8: Figure = Figure {
    id: "R87-F8",
    paper: Paper::Reeves87,
    title: "ResFactor 1, 3, 8",
    claim: "A larger ResFactor makes edges softer and wider; when the edge is wide, its quantisation shows.",
    look: "the width of the edge, and the steps that show in the widest.",
    make: res_factor,
};

fn res_factor(cx: &Context) -> anyhow::Result<Made> {
    let set = Set::new(gallery::box_plane(), cx.pick(512, 256), cx.pick(1024, 512));
    let truth = set.truth(cx);
    let band = straight_edge(&set.scene, 14.0);
    let exact = metrics::profile(shadow_grid(&truth), &band);
    let mut made = Made::default();
    let (mut widths, mut shifts) = (Vec::new(), 0.0f64);
    // What the map's own texels show: the ordinary z-buffer.
    let ordinary = set.shoot(cx, presets::ordinary(Bias::World(1.4)).filter, &Frame::CENTRES);
    let edge = metrics::both(&metrics::edge_mask(shadow_grid(&truth), 4), &of(&truth, |_| true));
    let mut unlike_map = Vec::new();
    for factor in [0.25f32, 1.0, 2.0, 3.0, 4.0, 8.0] {
        let picture = set.shoot(cx, soft(jittered(16), factor), &Frame::CENTRES);
        unlike_map.push(value(metrics::rms(&picture.shadow[0], &ordinary.shadow[0], &edge)));
        if factor < 1.0 {
            let panel = zoomed("f0.25", "ResFactor ¼", &picture, BOX_EDGE, 8);
            made.panels.push(panel.with("NumSamples", 16).against("truth"));
            continue;
        }
        let profile = metrics::profile(shadow_grid(&picture), &band);
        widths.push((f64::from(factor), value(profile.width())));
        let shift = value(profile.shift(&exact)).abs();
        // A missing edge is NaN and must stay one.
        shifts = if shift.is_nan() || shift > shifts { shift } else { shifts };
        if [1.0, 3.0, 8.0].contains(&factor) {
            let panel = zoomed(&format!("f{factor}"), &format!("ResFactor {factor}"), &picture, BOX_EDGE, 8);
            made.panels.push(panel.with("NumSamples", 16).with("map", cx.pick("1024²", "512²")).against("truth"));
            let (name, caption) = (format!("f{factor}-error"), format!("ResFactor {factor} minus truth"));
            made.panels.push(zoomed_error(&name, &caption, &picture, &truth, BOX_EDGE, 8));
        }
    }
    let panel = zoomed("truth", "Ray-traced truth (a point light: a sharp edge)", &truth, BOX_EDGE, 8);
    made.panels.push(panel.role(Role::Truth));
    let steps = |n: u32| {
        let picture = set.shoot(cx, soft(jittered(n), 8.0), &Frame::CENTRES);
        let mask = penumbra(&picture);
        metrics::distinct_levels(&picture.shadow[0], &mask) as f64
    };
    let fit = metrics::linear_fit(&widths[1..]);
    made.measures = vec![
        Measure::at_least("edge width against ResFactor on 2..8: R² (M1)", value(fit.map(|f| f.r2)), "", 0.97),
        Measure::within("slope", value(fit.map(|f| f.slope)), "px per unit", 0.8 * 0.85, 0.8 * 1.15),
        Measure::at_most("largest shift of the edge's middle (M4)", shifts, "px", 0.5),
        Measure::info("edge width at ResFactor 1", widths[0].1, "px"),
        Measure::at_most("levels in the soft edge at ResFactor 8, 16 samples", steps(16), "levels", 32.0),
        Measure::at_least("the same, 64 samples, over that", steps(64) / steps(16), "ratio", 2.0),
        Measure::info("ResFactor ¼: difference from the map's own aliases at edges", unlike_map[0], "rms share"),
        Measure::at_most("the same over that of ResFactor 3", unlike_map[0] / unlike_map[3], "ratio", 0.7),
    ];
    // D-13 for an edge along an axis: the region is a pixel wide, times ResFactor, and .8 of its ramp lies between 10 and 90 %.
    let predicted = [0.0, 8.0].map(|f| (f, 0.8 * f)).to_vec();
    let plot = Plot::new("Width of a straight edge", Axis::linear("ResFactor"), Axis::linear("10–90 % width, px"))
        .add(Series::line("predicted ramp", predicted))
        .add(Series::dots("measured", widths));
    made.plots.push(("width".into(), plot.svg()));
    made.note =
        "A bias of 1.2 to 1.6 keeps false shadow out of the measure: a larger region needs a larger bias (D-9).".into();
    Ok(made)
}

pub const F10: Figure = Figure {
    id: "R87-F10",
    paper: Paper::Reeves87,
    title: "Maps of 256², 512², 1024²",
    claim: "Small maps give blurry and noisy shadows.",
    look: "fine shadows: they blur into one another as the map shrinks.",
    make: map_size,
};

fn map_size(cx: &Context) -> anyhow::Result<Made> {
    let pixels = cx.pick(512, 256);
    let mut made = Made::default();
    let (mut errors, mut acne) = (Vec::new(), Vec::new());
    for texels in [256, 512, 1024] {
        let set = Set::new(gallery::sphere_plane(), pixels, texels);
        let (truth, points) = (set.truth(cx), set.truth_points(cx, &Frame::CENTRES));
        let picture = set.shoot(cx, presets::reeves87().filter, &Frame::CENTRES);
        let edge = metrics::both(&metrics::edge_mask(shadow_grid(&truth), 6), &of(&truth, |id| id == PLANE));
        errors.push(value(metrics::rms(&picture.shadow[0], &truth.shadow[0], &edge)));
        acne.push(false_shadow(&picture, &points, 8).0);
        let panel = zoomed(&format!("m{texels:04}"), &format!("Map {texels}²"), &picture, CAST_EDGE, 6);
        made.panels.push(panel.with("ResFactor", 3).with("bias", "0.3–0.4").against("truth"));
        let (name, caption) = (format!("m{texels:04}-error"), format!("Map {texels}² minus truth"));
        made.panels.push(zoomed_error(&name, &caption, &picture, &truth, CAST_EDGE, 6));
        if texels == 1024 {
            let panel = zoomed("truth", "Ray-traced truth", &truth, CAST_EDGE, 6);
            made.panels.push(panel.role(Role::Truth));
        }
    }
    let falls = |values: &[f64]| f64::from(u8::from(values.windows(2).all(|pair| pair[1] < pair[0])));
    for (i, texels) in ["256²", "512²", "1024²"].into_iter().enumerate() {
        made.measures.push(Measure::info(&format!("{texels}: edge error"), errors[i], "rms share"));
        made.measures.push(Measure::info(&format!("{texels}: false shadow on the plane (M2)"), acne[i], "share"));
    }
    made.measures.push(Measure::exactly("edge error falls strictly", falls(&errors), "yes = 1", 1.0).yes_no());
    made.measures.push(Measure::exactly("false shadow falls strictly", falls(&acne), "yes = 1", 1.0).yes_no());
    Ok(made)
}

pub const FLOAT: Figure = Figure {
    id: "R87-float",
    paper: Paper::Reeves87,
    title: "Float depths against 16-bit integers",
    claim: "Floating point reduces the aliasing of depth; it does not cure it.",
    look: "the first two pictures: floating point has fewer stripes, not none.",
    make: float,
};

fn float(cx: &Context) -> anyhow::Result<Made> {
    let set = Set::new(with_kind(gallery::sphere_plane(), Kind::Screen), cx.pick(512, 192), 1024);
    let truth = set.truth_points(cx, &Frame::CENTRES);
    let exact = set.truth(cx);
    let whole = set.quantised(16);
    let shots = |bias: Bias| {
        let shoot = |map: &Arc<Tiled>| set.shoot_map(cx, presets::ordinary(bias).filter, map, &Frame::CENTRES);
        (shoot(&whole), shoot(set.map()))
    };
    let edge = metrics::both(&metrics::edge_mask(shadow_grid(&exact), 4), &of(&exact, |id| id == PLANE));
    let jagged = |picture: &Picture| value(metrics::rms(&picture.shadow[0], &exact.shadow[0], &edge));
    let (whole_0, float_0) = shots(Bias::ZERO);
    let (whole_b, float_b) = shots(Bias::World(0.35));
    // Against the tangent plane at the very texel that is read no look-up error is left: what remains is the depth's own step.
    let on_plane = |map: &Arc<Tiled>| {
        let quarter = OnPlane::biased(Bias::Map(0.25 / 65_535.0));
        let filter = Pcf::default().with_pattern(Centre).with_depth(quarter).with_res_factor(0.0).with_min_size(0.0);
        set.shoot_map(cx, filter, map, &Frame::CENTRES)
    };
    let (whole_s, float_s) = (on_plane(&whole), on_plane(set.map()));
    let (at_0, float_at_0) = (false_shadow(&whole_0, &truth, 3).0, false_shadow(&float_0, &truth, 3).0);
    let (stepped, smooth) = (false_shadow(&whole_s, &truth, 3).0, false_shadow(&float_s, &truth, 3).0);
    Ok(Made {
        panels: vec![
            shadow_panel("integer", "16-bit integers, bias 0", &whole_0).against("truth"),
            shadow_panel("float", "32-bit floats, bias 0", &float_0).against("truth"),
            shadow_panel("integer-steps", "16-bit integers, compared with the tangent plane", &whole_s)
                .with("bias", "¼ quantum")
                .against("truth"),
            shadow_panel("float-steps", "32-bit floats, compared with the tangent plane", &float_s)
                .with("bias", "¼ quantum")
                .against("truth"),
            truth_panel(&exact),
            error_panel(
                "error",
                "32-bit floats, bias 0, minus truth",
                exact.size,
                &float_0.shadow[0],
                &exact.shadow[0],
            ),
        ],
        measures: vec![
            Measure::info("16-bit: false shadow on the plane, bias 0 (M2)", at_0, "share"),
            Measure::info("float: the same at bias 0", float_at_0, "share"),
            Measure::at_most("relative change", (float_at_0 / at_0 - 1.0).abs(), "", 0.05),
            Measure::within(
                "jaggedness of the edge, float over 16-bit",
                jagged(&float_b) / jagged(&whole_b),
                "ratio",
                0.95,
                1.05,
            ),
            Measure::at_least("16-bit: false shadow by the steps of z alone", stepped, "share", 0.1),
            Measure::at_most("float: false shadow by the steps of z alone", smooth, "share", 1e-3),
        ],
        ..Made::default()
    })
}

pub const PASS1: Figure = Figure {
    id: "R87-pass1",
    paper: Paper::Reeves87,
    title: "Regular against stochastic sampling of the map",
    claim: "At low resolution slight aliasing is less objectionable than noise.",
    look: "the two enlargements: regular steps in one, grain in the other.",
    make: pass1,
};

fn pass1(cx: &Context) -> anyhow::Result<Made> {
    let pixels = cx.pick(512, 256);
    let mut made = Made::default();
    let mut errors = Vec::new();
    for (name, caption, sampling) in
        [("regular", "Regular", Sampling::Centre), ("stochastic", "Stochastic", Sampling::Jittered { seed: cx.seed })]
    {
        let set = Set::sampled(gallery::sphere_plane(), pixels, 256, sampling);
        let (truth, points) = (set.truth(cx), set.truth_points(cx, &Frame::CENTRES));
        let picture = set.shoot(cx, presets::reeves87().filter, &Frame::CENTRES);
        let limit = set.shoot(cx, presets::reeves87().filter.with_pattern(jittered(1024)), &Frame::CENTRES);
        let edge = metrics::both(&metrics::edge_mask(shadow_grid(&truth), 8), &of(&truth, |id| id == PLANE));
        let noise = metrics::rms(&limit.shadow[0], &truth.shadow[0], &edge);
        let contour = metrics::contour_deviation(shadow_grid(&limit), shadow_grid(&truth), 6.0);
        errors.push(value(contour.map(|c| c.rms)));
        let soft = penumbra(&limit);
        made.measures.push(Measure::info(
            &format!("{caption}: noise of 16 samples in soft edges (M6)"),
            value(metrics::rms(&picture.shadow[0], &limit.shadow[0], &soft)),
            "rms share",
        ));
        made.measures.push(Measure::info(
            &format!("{caption}: edge error at 1,024 samples"),
            value(noise),
            "rms share",
        ));
        made.measures.push(Measure::info(
            &format!("{caption}: jaggedness of the ½ contour"),
            errors[errors.len() - 1],
            "px rms",
        ));
        made.measures.push(Measure::info(
            &format!("{caption}: false shadow on the plane (M2)"),
            false_shadow(&picture, &points, 10).0,
            "share",
        ));
        made.panels.push(shadow_panel(name, &format!("{caption} map"), &picture).with("map", "256²").against("truth"));
        made.panels.push(zoomed(&format!("{name}-zoom"), &format!("{caption} map, enlarged"), &picture, CAST_EDGE, 6));
        if name == "stochastic" {
            made.panels.push(truth_panel(&truth));
            made.panels.push(error_panel(
                "error",
                "Stochastic minus truth",
                picture.size,
                &picture.shadow[0],
                &truth.shadow[0],
            ));
        }
    }
    made.measures.push(Measure::at_least("jaggedness, stochastic over regular", errors[1] / errors[0], "ratio", 1.0));
    Ok(made)
}
