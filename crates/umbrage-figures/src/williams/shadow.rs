//! Williams 1978, Figures 3 to 5: the shadow image stage by stage (W78-18).

use crate::figure::{Context, Figure, Paper};
use crate::stage::four_spheres::{Alone, alone, dithered, faithful, interpolated, post, reduced, spheres};
use crate::stage::masks::{lit, of, shadow_grid, value};
use crate::stage::panels::{error_panel, shadow_image_panel, truth_panel};
use crate::stage::set::Set;
use glam::{DVec2, DVec3, UVec2};
use std::sync::Arc;
use umbrage_depth::{DepthMap, Raw, Tiled, bandlimit};
use umbrage_oracle::metrics::{self, Grid};
use umbrage_oracle::predict;
use umbrage_plane::TexelRect;
use umbrage_render::post::{dequantise_edges, low_pass};
use umbrage_render::{Frame, Picture, rays_where};
use umbrage_report::plot::{Axis, Plot, Series};
use umbrage_report::{Made, Measure};
use umbrage_scene::gallery;

pub const F3: Figure = Figure {
    id: "W78-F3",
    paper: Paper::Williams78,
    title: "Shadow alone, reduced bias",
    claim: "Quantisation moiré is worst where the surface turns edge-on to the light or to the observer.",
    look: "the bands and moiré on the lit sides of the spheres, densest where a surface turns edge-on.",
    make: reduced_bias,
};

/// A window on the lit side of the lone sphere, where moiré shows: its last column is the last one that is lit in truth in every row.
fn window(image: &[f32], width: u32, sphere: &Alone) -> Vec<f32> {
    let side = if sphere.radius > 64.0 { 64 } else { 32 };
    let edge = sphere.centre.x - sphere.radius * predict::terminator_offset(100f64.to_radians()).abs();
    let (x, y) = ((edge + 0.5) as usize - side, sphere.centre.y as usize - side / 2);
    Grid::new(image, width as usize).window(x, y, side, side)
}

fn moire(image: &[f32], width: u32, sphere: &Alone) -> f64 {
    let window = window(image, width, sphere);
    let side = window.len().isqrt();
    metrics::spectrum(Grid::new(&window, side)).power_ratio()
}

fn reduced_bias(cx: &Context) -> anyhow::Result<Made> {
    let set = spheres(cx);
    let centres = set.plain(cx, &Frame::CENTRES);
    let snapped: Vec<Picture> = (0..DRAWS).map(|draw| snapped(cx, &set, draw)).collect();
    let truth = set.truth_points(cx, &Frame::CENTRES);
    let exact = set.truth(cx);
    let sphere = alone(&truth, &set).ok_or_else(|| anyhow::anyhow!("no sphere stands alone"))?;
    let width = truth.size.x;
    let mut made = Made::default();
    let lit_all = lit(&truth, 1, |_| true);
    let part = |image: &[f32], near: bool| {
        let band: Vec<bool> = lit_all.iter().zip(&truth.facing[0]).map(|(on, f)| *on && (*f < 0.3) == near).collect();
        value(metrics::false_shadow(image, &band))
    };
    // No false shadow at all counts as a pixel of it, so that there is a ratio.
    let one_pixel = 1.0 / lit_all.iter().filter(|on| **on).count().max(1) as f64;
    for pixels in [1.0, 2.0] {
        let image = post(cx, &set, &centres, reduced(pixels)).shadow;
        let (band, inner) = (part(&image, true), part(&image, false));
        let name = format!("bias {pixels} px: false shadow at N·L < .3 over the rest");
        made.measures.push(Measure::at_least(&name, band / inner.max(one_pixel), "ratio", 3.0));
    }
    let mut curve = Vec::new();
    for pixels in [1.0f32, 2.0, 4.0] {
        let ratio = moire(&post(cx, &set, &centres, reduced(pixels)).shadow, width, &sphere);
        curve.push((f64::from(pixels), ratio));
        let name = format!("bias {pixels} px: spectral peak over median (M3)");
        made.measures.push(Measure::at_least(&name, ratio, "ratio", 100.0).full_size(cx.quick));
    }
    let enough = post(cx, &set, &centres, reduced(4.0)).shadow;
    let on = of(&truth, |id| id == sphere.id);
    let lit_share = 1.0 - value(metrics::mean(&enough, &on));
    made.measures.push(
        Measure::within("lit share of the lone disc, bias 4 px", lit_share, "share", 0.393, 0.433).full_size(cx.quick),
    );
    made.measures.push(Measure::info("the same in truth", 1.0 - value(metrics::mean(&truth.shadow[0], &on)), "share"));
    // A bias small enough to leave the terminator where it is (D-11), and depth exact enough to need no more.
    let exact_depth = set.shoot(cx, interpolated(0.5), &Frame::CENTRES);
    let offset = |shadow: &[f32]| terminator_offset(shadow, width, &sphere);
    made.measures.push(
        Measure::within(
            "terminator left of the disc's centre, float depth, bias ½ px",
            offset(&exact_depth.shadow[0]),
            "R",
            0.1636,
            0.1836,
        )
        .full_size(cx.quick),
    );
    made.measures.push(Measure::info("the terminator in truth", offset(&exact.shadow[0]), "R"));
    // The negative control: depths smoothed before they are looked up.
    let smooth = Arc::new(Tiled::from(&bandlimit(&Raw::copy_of(set.map()), 1)));
    let controlled = set.shoot_map(cx, reduced(1.0), &smooth, &Frame::CENTRES);
    let unfiltered = value(metrics::false_shadow(&set.shoot(cx, reduced(1.0), &Frame::CENTRES).shadow[0], &lit_all));
    let controlled = value(metrics::false_shadow(&controlled.shadow[0], &lit_all));
    made.measures.push(Measure::at_least(
        "light's z bandlimited first (3²): false shadow over that without",
        controlled / unfiltered,
        "ratio",
        0.8,
    ));
    limb(cx, (&set, 100), &snapped, &mut made)?;
    // The paper's wording can be read both ways.
    let set_80 = Set::new(gallery::four_spheres_lit_from(80.0), set.scene.camera.size().x, set.map().view().size().x);
    limb(cx, (&set_80, 80), &snapped, &mut made)?;
    let one = post(cx, &set, &centres, reduced(1.0)).shadow;
    let loose = post(cx, &set, &snapped[0], reduced(1.0)).shadow;
    made.panels = vec![
        shadow_image_panel("reduced", "Reduced bias, points at pixel centres", truth.size, &one)
            .with("bias", "1 px")
            .with("z", "16 bit")
            .against("truth"),
        shadow_image_panel("snapped", "Reduced bias, points snapped to pixels", truth.size, &loose)
            .with("bias", "1 px")
            .against("truth"),
        shadow_image_panel("enough", "Four times the bias", truth.size, &enough).with("bias", "4 px").against("truth"),
        truth_panel(&exact),
        error_panel("error", "Reduced bias minus truth", truth.size, &one, &exact.shadow[0]),
    ];
    made.note = "The second band appears only with points snapped to pixels and the light at 80°, the other reading of the \
                 paper's 100°: with the light at 100° it is lost in the terminator's own band. The paper's text places the band at the right; by geometry it \
                 lies at the lit limb.".into();
    Ok(made)
}

/// How far left of a sphere's centre its shadow begins near the equator, in radii, from the number of lit pixels in each row.
fn terminator_offset(shadow: &[f32], width: u32, sphere: &Alone) -> f64 {
    let (width, half) = (width as usize, (0.1 * sphere.radius) as usize);
    let (left, right) = ((sphere.centre.x - sphere.radius) as usize, sphere.centre.x as usize);
    let rows = sphere.centre.y as usize - half..sphere.centre.y as usize + half;
    let offsets = rows.clone().map(|y| {
        let lit: f64 = (left..right).map(|x| 1.0 - f64::from(shadow[y * width + x])).sum();
        sphere.centre.x - (left as f64 + lit)
    });
    offsets.sum::<f64>() / rows.len() as f64 / sphere.radius
}

/// Draws of the random place in each pixel.
const DRAWS: u32 = 8;

/// What the observer sees with points snapped to pixels, one sample anywhere inside each: its depths. No light has a part in it.
fn snapped(cx: &Context, set: &Set, draw: u32) -> Picture {
    let frame = Frame { stochastic: true, every_sample: true, seed: cx.seed.wrapping_add(draw), ..Frame::CENTRES };
    rays_where(&set.scene, &[], &frame, |_| true)
}

/// With points `snapped` to pixels the false shadow rises toward the lit limb, where the surface turns edge-on to the observer (W78-7).
fn limb(cx: &Context, (set, degrees): (&Set, u32), snapped: &[Picture], made: &mut Made) -> anyhow::Result<()> {
    let truth = set.truth_points(cx, &Frame::CENTRES);
    let sphere = alone(&truth, set).ok_or_else(|| anyhow::anyhow!("no sphere stands alone"))?;
    let width = truth.size.x as usize;
    let share = |image: &[f32], from: f64, to: f64| {
        let mask: Vec<bool> = (0..image.len())
            .map(|i| {
                let pixel = DVec2::new((i % width) as f64 + 0.5, (i / width) as f64 + 0.5);
                let at = (pixel - sphere.centre) / sphere.radius;
                let lit = truth.object[i] == sphere.id && truth.shadow[0][i] == 0.0;
                lit && at.x < 0.0 && at.y.abs() < 0.3 && (from..to).contains(&at.length())
            })
            .collect();
        value(metrics::false_shadow(image, &mask))
    };
    // Interpolated, so that the light's own texels leave no false shadow there and what is left comes from the observer's.
    let shadow = |seen: &Picture, cx: &Context| post(cx, set, seen, interpolated(0.25)).shadow;
    let (mut inner, mut outer) = (0.0, 0.0);
    for (draw, seen) in (0..DRAWS).zip(snapped) {
        let image = shadow(seen, &Context { seed: cx.seed.wrapping_add(draw), ..cx.clone() });
        inner += share(&image, 0.0, 0.4) / f64::from(DRAWS);
        outer += share(&image, 0.9, 1.01) / f64::from(DRAWS);
    }
    let unsnapped = share(&shadow(&set.plain(cx, &Frame::CENTRES), cx), 0.9, 1.01);
    let name = |what: &str| format!("light at {degrees}°: {what}");
    made.measures.push(Measure::info(&name("false shadow at 0–.4 R toward the lit limb, snapped"), inner, "share"));
    made.measures.push(Measure::info(&name("false shadow at .9–1 R, snapped"), outer, "share"));
    made.measures.push(Measure::info(&name("the same, points at pixel centres"), unsnapped, "share"));
    if degrees == 80 {
        made.measures.push(Measure::at_least(&name("rise toward the limb"), outer / inner, "ratio", 1.2));
    }
    let on = of(&truth, |id| id == sphere.id);
    let lit_share = 1.0 - value(metrics::mean(&truth.shadow[0], &on));
    made.measures.push(Measure::info(&name("lit share of the lone disc in truth"), lit_share, "share"));
    Ok(())
}

pub const F4: Figure = Figure {
    id: "W78-F4",
    paper: Paper::Williams78,
    title: "Increased bias, dither, interpolated depth",
    claim: "The moiré is broken into noise.",
    look: "the same places as in Figure 3: bands have become noise, and the edges have not moved.",
    make: dither,
};

fn dither(cx: &Context) -> anyhow::Result<Made> {
    let set = spheres(cx);
    let centres = set.plain(cx, &Frame::CENTRES);
    let truth = set.truth_points(cx, &Frame::CENTRES);
    let exact = set.truth(cx);
    let sphere = alone(&truth, &set).ok_or_else(|| anyhow::anyhow!("no sphere stands alone"))?;
    let mask = lit(&truth, 1, |_| true);
    let mut made = Made::default();
    let (mut plain, mut broken) = (Vec::new(), Vec::new());
    for pixels in [1.0f32, 2.0, 3.0, 4.0] {
        let (a, b) =
            (post(cx, &set, &centres, reduced(pixels)).shadow, post(cx, &set, &centres, faithful(pixels)).shadow);
        let (before, after) = (moire(&a, truth.size.x, &sphere), moire(&b, truth.size.x, &sphere));
        plain.push((f64::from(pixels), before));
        broken.push((f64::from(pixels), after));
        if pixels >= 2.0 {
            let name = format!("bias {pixels} px: spectral peak, plain over dithered (M3)");
            made.measures.push(Measure::at_least(&name, before / after, "ratio", 3.0).full_size(cx.quick));
        }
    }
    let [reduced_1, faithful_4, guarded_4] =
        [reduced(1.0), faithful(4.0), dithered(4.0)].map(|filter| post(cx, &set, &centres, filter).shadow);
    let (before, after) =
        (value(metrics::false_shadow(&reduced_1, &mask)), value(metrics::false_shadow(&faithful_4, &mask)));
    made.measures.push(Measure::info("false shadow, reduced bias (M2)", before, "share"));
    made.measures.push(Measure::at_most(
        "false shadow, increased bias and dither, over it",
        after / before,
        "ratio",
        1.0,
    ));
    let unquantised = set.shoot(cx, interpolated(0.5), &Frame::CENTRES);
    let inner = metrics::both(&mask, &away_from_silhouettes(&set, &truth));
    let false_share = |mask: &[bool]| value(metrics::false_shadow(&unquantised.shadow[0], mask));
    made.measures.push(Measure::at_most(
        "float depth, interpolated, no dither, bias ½ px, two texels away from the light's silhouettes: false shadow",
        false_share(&inner),
        "share",
        0.001,
    ));
    made.measures.push(Measure::info("the same beside silhouettes too", false_share(&mask), "share"));
    let dark = of(&truth, |_| true).iter().zip(&truth.shadow[0]).map(|(on, s)| *on && *s == 1.0).collect::<Vec<bool>>();
    let leak = |image: &[f32]| 1.0 - value(metrics::mean(image, &dark));
    made.measures.push(Measure::info(
        "light where truth is dark, interpolated across silhouettes",
        leak(&faithful_4),
        "share",
    ));
    made.measures.push(Measure::info("the same, kept from silhouettes", leak(&guarded_4), "share"));
    made.panels = vec![
        shadow_image_panel("dithered", "Increased bias, interpolated, dithered", truth.size, &faithful_4)
            .with("bias", "4 px")
            .with("dither", "±½ px")
            .against("truth"),
        shadow_image_panel("guarded", "The same, not interpolated across silhouettes", truth.size, &guarded_4)
            .with("bias", "4 px")
            .with("dither", "±½ px")
            .against("truth"),
        truth_panel(&exact),
        error_panel("error", "Minus truth", truth.size, &faithful_4, &exact.shadow[0]),
    ];
    made.note = "What breaks up the moiré is interpolation across silhouettes, where an empty texel counts as the far plane: at this bias \
                 all of the moiré lies within two texels of a silhouette. The price is false light along the terminator; without such interpolation \
                 (right) there is none, and the moiré stays."
        .into();
    let plot =
        Plot::new("Regularity of the false shadow", Axis::linear("bias, px"), Axis::log("spectral peak over median"))
            .add(Series::line("nearest", plain))
            .add(Series::line("interpolated and dithered", broken));
    made.plots.push(("moire".into(), plot.svg()));
    Ok(made)
}

/// Pixels more than two texels, the width of the interpolation, from a silhouette in the light's view.
fn away_from_silhouettes(set: &Set, truth: &Picture) -> Vec<bool> {
    let light = set.map().view();
    let jump = 0.5 / (light.far() - light.near()) as f32;
    let smooth = |at: DVec3| {
        let eye = light.world_to_eye().transform_point3(at);
        let texel = light.eye_to_texel(eye).floor().as_ivec2();
        let window = TexelRect::new(texel - 2, texel + 3);
        let (low, high) = window
            .texels()
            .map(|texel| set.map().depth(texel))
            .fold((f32::INFINITY, f32::NEG_INFINITY), |(low, high), z| (low.min(z), high.max(z)));
        high - low < jump
    };
    truth.position.iter().map(|&at| at.is_finite() && smooth(at)).collect()
}

/// The stages after the comparison at their defaults: two chain vertices to either side, one low-pass (W78-16..W78-18).
pub(super) fn filtered(size: UVec2, image: &[f32]) -> Vec<f32> {
    low_pass(size, &dequantise_edges(size, image, 2), 1)
}

pub const F5: Figure = Figure {
    id: "W78-F5",
    paper: Paper::Williams78,
    title: "Edges dequantised, image low-passed",
    claim: "Smooth contours; the dither merges into grey.",
    look: "the shadow's outline before and after, pixel by pixel in the enlargement.",
    make: smoothing,
};

fn smoothing(cx: &Context) -> anyhow::Result<Made> {
    let set = spheres(cx);
    let centres = set.plain(cx, &Frame::CENTRES);
    let exact = set.truth(cx);
    let width = exact.size.x as usize;
    let [before, guarded] = [faithful(4.0), dithered(4.0)].map(|filter| post(cx, &set, &centres, filter).shadow);
    let after = filtered(exact.size, &before);
    let contour =
        |image: &[f32]| metrics::contour_deviation(Grid::new(image, width), shadow_grid(&exact), f64::INFINITY);
    let rms = |image: &[f32]| value(contour(image).map(|d| d.rms));
    let mean = |image: &[f32]| value(contour(image).map(|d| d.mean));
    let everywhere = of(&exact, |_| true);
    let lone = |image: &[f32]| metrics::lone_pixels(Grid::new(image, width), &everywhere) as f64;
    let most = low_pass(exact.size, &dequantise_edges(exact.size, &guarded, 8), 2);
    let ratio = rms(&after) / rms(&before);
    Ok(Made {
        panels: vec![
            shadow_image_panel("before", "Before: Figure 4's image", exact.size, &before)
                .with("bias", "4 px")
                .against("truth"),
            shadow_image_panel("filtered", "Edges dequantised, low-passed", exact.size, &after)
                .with("window", "2 chain vertices")
                .with("low-pass", "[1 2 1]/4")
                .against("truth"),
            shadow_image_panel(
                "guarded",
                "Not interpolated across silhouettes, the longest windows",
                exact.size,
                &most,
            )
            .with("window", "8 chain vertices")
            .with("low-pass", "[1 2 1]/4 × 2")
            .against("truth"),
            truth_panel(&exact),
            error_panel("error", "Minus truth", exact.size, &after, &exact.shadow[0]),
        ],
        measures: vec![
            Measure::info("½ contour against truth before", rms(&before), "px rms"),
            Measure::at_most("after, over before", ratio, "ratio", 0.5),
            Measure::info("mean displacement of the contour before", mean(&before), "px"),
            Measure::info("the same after", mean(&after), "px"),
            Measure::info(
                "not interpolated across silhouettes: after, over before",
                rms(&filtered(exact.size, &guarded)) / rms(&guarded),
                "ratio",
            ),
            Measure::info("the same with the longest windows", rms(&most) / rms(&guarded), "ratio"),
            Measure::at_least("lone pixels before", lone(&before), "px", 20.0),
            Measure::at_most("lone pixels after, over before", lone(&after) / lone(&before), "ratio", 0.1),
            Measure::at_least(
                "distinct levels after",
                metrics::distinct_levels(&after, &everywhere) as f64,
                "levels",
                16.0,
            ),
        ],
        caveat: Some(format!(
            "The contour's distance from truth falls by {:.0} %, not by half: interpolation across silhouettes, which Figure 4 needs, \
             moves the terminator itself, by {:.1} px on average before and {:.1} px after, and no filter on the picture can undo that. \
             Without interpolation across silhouettes, and with the longest windows, the ratio is near one half. Proposed bound: 0.9.",
            100.0 * (1.0 - ratio),
            mean(&before),
            mean(&after)
        )),
        ..Made::default()
    })
}
