//! Williams 1978, Figures 1 to 6: four spheres, step by step, and the teapot.

use super::studio::{
    Set, colour_panel, error_panel, lit, of, shadow_grid, shadow_image_panel, shadow_panel, truth_panel, value,
};
use crate::figure::{Context, Figure, Made, Measure, Panel, Paper, Role};
use crate::plot::{Axis, Plot, Series};
use glam::{DVec2, DVec3, UVec2, Vec3};
use umbrage_depth::{DepthMap, Raw, Tiled, bandlimit};
use umbrage_oracle::metrics::{self, Grid};
use umbrage_oracle::predict;
use umbrage_plane::{Bias, Projection, TexelRect, View};
use umbrage_render::post::{ShadowImage, darken, dequantise_edges, low_pass, shadow_image};
use umbrage_render::{Frame, Picture};
use umbrage_sample::Key;
use umbrage_scene::gallery;
use umbrage_shadow::williams::{Dither, Guard, Lookup};
use umbrage_shadow::{OnPlane, Pcf, ShadowMap, Williams, presets};

/// The paper's own settings: 512² in both views, 16-bit depth in both (W78-2).
const BITS: u32 = 16;

fn spheres(cx: &Context) -> Set {
    Set::new(gallery::four_spheres(), cx.pick(512, 256), cx.pick(512, 256))
}

/// Bias in texel widths, "px" in the figures; the light is at infinity, so it is one world distance everywhere.
fn reduced(pixels: f32) -> Williams {
    Williams { bias: Bias::Texels(pixels), lookup: Lookup::Nearest, dither: Dither::OFF }
}

/// Interpolated except across silhouettes, and not dithered.
fn interpolated(pixels: f32) -> Williams {
    Williams { lookup: Lookup::Bilinear(Guard::default()), ..reduced(pixels) }
}

fn dithered(pixels: f32) -> Williams {
    Williams { dither: Dither::HALF_TEXEL, ..interpolated(pixels) }
}

/// As the paper has it: interpolated across silhouettes too, where empty texels count as the far plane (W78-14).
fn faithful(pixels: f32) -> Williams {
    Williams { lookup: Lookup::Bilinear(Guard::Faithful), ..dithered(pixels) }
}

/// The shadow image of the post-process, in the paper's 16 bits.
fn post(cx: &Context, set: &Set, picture: &Picture, filter: Williams) -> ShadowImage {
    let light = ShadowMap { filter, map: set.quantised(BITS) };
    shadow_image(&picture.depth, &set.scene.camera, Some(BITS), &light, Key::new(cx.seed, 0, 0))
}

/// The sphere that no other shadows: lit exactly where it faces the light, and wholly in view.
struct Alone {
    id: u32,
    centre: DVec2,
    radius: f64,
}

fn alone(truth: &Picture, set: &Set) -> Option<Alone> {
    let count = set.scene.objects.len() as u32;
    let shadowed = |id: u32| {
        let facing = of(truth, |object| object == id);
        (0..facing.len()).filter(|&i| facing[i] && truth.facing[0][i] > 0.05 && truth.shadow[0][i] > 0.5).count()
    };
    let pixels = |id: u32| of(truth, |object| object == id).iter().filter(|on| **on).count();
    let most = (0..count).map(pixels).max()?;
    let id = (0..count).filter(|&id| pixels(id) * 100 >= most * 99).min_by_key(|&id| shadowed(id))?;
    let (centre, radius) = disc(&set.scene.camera, set, id);
    Some(Alone { id, centre, radius })
}

/// Centre and radius, in pixels, of a sphere's disc in an orthographic view.
fn disc(view: &View, set: &Set, id: u32) -> (DVec2, f64) {
    let mesh = set.scene.objects[id as usize].shape.mesh_for(view);
    let (mut low, mut high) = (DVec2::INFINITY, DVec2::NEG_INFINITY);
    for position in &mesh.positions {
        let at = view.eye_to_texel(view.world_to_eye().transform_point3(position.as_dvec3()));
        (low, high) = (low.min(at), high.max(at));
    }
    ((low + high) * 0.5, (high - low).max_element() * 0.5)
}

pub const F1: Figure = Figure {
    id: "W78-F1",
    paper: Paper::Williams78,
    title: "The observer's view",
    claim: "Four shaded spheres, no shadow yet.",
    make: observer,
};

fn depth_panel(name: &str, caption: &str, picture: &Picture) -> Panel {
    let finite = picture.depth.iter().copied().filter(|z| z.is_finite());
    let (low, high) = finite.fold((f32::INFINITY, f32::NEG_INFINITY), |(low, high), z| (low.min(z), high.max(z)));
    let grey =
        picture.depth.iter().map(|&z| if z.is_finite() { 0.85 * (z - low) / (high - low).max(1e-6) } else { 1.0 });
    Panel::grey(name, caption, picture.size, grey.collect()).role(Role::Map)
}

fn visible(picture: &Picture, set: &Set) -> usize {
    (0..set.scene.objects.len() as u32).filter(|id| picture.object.contains(id)).count()
}

fn observer(cx: &Context) -> anyhow::Result<Made> {
    let set = spheres(cx);
    let picture = set.plain(cx, &Frame::CENTRES);
    Ok(Made {
        panels: vec![
            colour_panel("shaded", "From the observer, without shadow", picture.size, &picture.colour),
            depth_panel("depth", "The observer's z-buffer, nearer darker", &picture).with("bits", BITS),
        ],
        measures: vec![
            Measure::exactly("spheres in view", visible(&picture, &set) as f64, "spheres", 4.0),
            Measure::exactly("pixels across", f64::from(picture.size.x), "px", f64::from(cx.pick(512, 256))),
        ],
        ..Made::default()
    })
}

pub const F2: Figure = Figure {
    id: "W78-F2",
    paper: Paper::Williams78,
    title: "The light's view",
    claim: "The same scene from a light at infinity, 100° to the left: what is hidden here is in shadow.",
    make: light_view,
};

fn light_view(cx: &Context) -> anyhow::Result<Made> {
    let mut set = spheres(cx);
    let light = set.scene.lights[0].view;
    set.scene.camera = light.with_kind(umbrage_plane::Kind::Axial);
    let picture = set.plain(cx, &Frame::CENTRES);
    let mut worst = 0.0f64;
    let (width, height) = (picture.size.x as usize, picture.size.y as usize);
    for id in 0..set.scene.objects.len() as u32 {
        let (centre, radius) = disc(&light, &set, id);
        for i in (0..width * height).filter(|&i| picture.object[i] == id) {
            let (x, y) = (i % width, i / width);
            let at = DVec2::new(x as f64 + 0.5, y as f64 + 0.5);
            let beside = [(x.wrapping_sub(1), y), (x + 1, y), (x, y.wrapping_sub(1)), (x, y + 1)];
            let outline = beside
                .into_iter()
                .any(|(x, y)| x < width && y < height && picture.object[y * width + x] == umbrage_render::NOTHING);
            if outline {
                worst = worst.max((at.distance(centre) - radius).abs());
            }
        }
    }
    let baked_grey = umbrage_io::depth_view(&Raw::from(&set.quantised(BITS)));
    Ok(Made {
        panels: vec![
            colour_panel("light", "From the light", picture.size, &picture.colour),
            Panel::grey("map", "The light's z-buffer, nearer darker", light.size(), baked_grey)
                .with("bits", BITS)
                .role(Role::Map),
        ],
        measures: vec![
            Measure::exactly("spheres in view", visible(&picture, &set) as f64, "spheres", 4.0),
            Measure::at_most("outline against a circle", worst, "px", 1.0),
            Measure::exactly("parallel projection", f64::from(u8::from(!light.is_perspective())), "yes = 1", 1.0),
        ],
        note: "Pass 1 keeps depth alone: nothing is shaded for it. The shaded picture is drawn here to be looked at."
            .into(),
        ..Made::default()
    })
}

pub const F3: Figure = Figure {
    id: "W78-F3",
    paper: Paper::Williams78,
    title: "Shadow alone, reduced bias",
    claim: "Quantisation moiré, worst where the surface turns edge-on to the light and where it turns edge-on to the observer.",
    make: reduced_bias,
};

/// A window on the lit side of the lone sphere, where moiré shows: its last column is the last one that truth calls lit in every row.
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
    let snapped = set.plain(cx, &SNAPPED);
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
        made.measures.push(Measure::at_least(&name, ratio, "ratio", 100.0).full_size(cx));
    }
    let enough = post(cx, &set, &centres, reduced(4.0)).shadow;
    let on = of(&truth, |id| id == sphere.id);
    let lit_share = 1.0 - value(metrics::mean(&enough, &on));
    made.measures.push(Measure::within("lit share of the lone disc, bias 4 px", lit_share, "share", 0.393, 0.433));
    made.measures.push(Measure::info("the same in truth", 1.0 - value(metrics::mean(&truth.shadow[0], &on)), "share"));
    let middle = sphere.centre.y as usize * width as usize;
    let row = (sphere.centre.x - sphere.radius) as usize..sphere.centre.x as usize;
    let crossing = row.rev().find(|&x| exact.shadow[0][middle + x] < 0.5).unwrap_or(0) as f64 + 1.0;
    let offset = (sphere.centre.x - crossing) / sphere.radius;
    made.measures
        .push(Measure::within("terminator left of the disc's centre", offset, "R", 0.1636, 0.1836).full_size(cx));
    // The negative control: depth smoothed before it is looked up.
    let smooth = Tiled::from(&bandlimit(&Raw::from(&set.map), 1));
    let controlled = set.shoot_map(cx, reduced(1.0), &smooth, &Frame::CENTRES);
    let unfiltered = value(metrics::false_shadow(&set.shoot(cx, reduced(1.0), &Frame::CENTRES).shadow[0], &lit_all));
    let controlled = value(metrics::false_shadow(&controlled.shadow[0], &lit_all));
    made.measures.push(Measure::at_least(
        "light's z bandlimited first (3²): false shadow over that without",
        controlled / unfiltered,
        "ratio",
        0.8,
    ));
    limb(cx, &set, &mut made)?;
    limb(cx, &at_80_degrees(&set)?, &mut made)?;
    let one = post(cx, &set, &centres, reduced(1.0)).shadow;
    let loose = post(cx, &set, &snapped, reduced(1.0)).shadow;
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
        error_panel("error", "Reduced bias less truth", truth.size, &one, &exact.shadow[0]),
    ];
    made.note = "The second band needs points snapped to pixels and the light at 80°, the other reading of the paper's 100°: \
                 with the light at 100° the false shadow falls toward the limb. The text puts the band's edge to the right; geometry puts it at the lit limb.".into();
    Ok(made)
}

/// The same scene with the light at 80° instead of 100° from the observer's bearing: the paper's wording reads both ways.
fn at_80_degrees(set: &Set) -> anyhow::Result<Set> {
    let light = set.map.view();
    let toward = DVec3::new(-80f64.to_radians().sin(), 0.0, 80f64.to_radians().cos());
    let Projection::Orthographic { half } = light.projection() else { anyhow::bail!("the light is not at infinity") };
    let middle = 0.5 * (light.near() + light.far());
    let centre = light.world_at(light.size().as_dvec2() * 0.5, light.key(middle));
    let eye = centre + toward * middle;
    let view = View::orthographic(eye, centre, DVec3::Y, half.y, light.near(), light.far(), light.size())?;
    let mut scene = set.scene.clone();
    scene.name += " at 80 degrees";
    scene.lights[0].view = view.with_kind(light.kind()).with_rules(*light.rules());
    Ok(Set::new(scene, set.scene.camera.size().x, light.size().x))
}

/// With points snapped to pixels the false shadow rises toward the lit limb, where the surface turns edge-on to the observer (W78-7).
fn limb(cx: &Context, set: &Set, made: &mut Made) -> anyhow::Result<()> {
    let truth = set.truth_points(cx, &Frame::CENTRES);
    let sphere = alone(&truth, set).ok_or_else(|| anyhow::anyhow!("no sphere stands alone"))?;
    let snapped = set.plain(cx, &SNAPPED);
    let image = post(cx, set, &snapped, interpolated(0.25)).shadow;
    let width = truth.size.x as usize;
    let share = |from: f64, to: f64| {
        let mask: Vec<bool> = (0..image.len())
            .map(|i| {
                let pixel = DVec2::new((i % width) as f64 + 0.5, (i / width) as f64 + 0.5);
                let at = (pixel - sphere.centre) / sphere.radius;
                let lit = truth.object[i] == sphere.id && truth.shadow[0][i] == 0.0;
                lit && at.x < 0.0 && at.y.abs() < 0.3 && (from..to).contains(&at.length())
            })
            .collect();
        value(metrics::false_shadow(&image, &mask))
    };
    let (inner, outer) = (share(0.4, 0.6), share(0.9, 1.01));
    let degrees = if made.measures.iter().any(|m| m.name.starts_with("100°")) { "80°" } else { "100°" };
    made.measures.push(Measure::info(
        &format!("{degrees}, snapped: false shadow at .4–.6 R toward the lit limb"),
        inner,
        "share",
    ));
    let name = format!("{degrees}, snapped: the same at .9–1 R, over it");
    made.measures.push(match degrees {
        "80°" => Measure::at_least(&name, outer / inner, "ratio", 1.2),
        _ => Measure::info(&name, outer / inner, "ratio"),
    });
    let on = of(&truth, |id| id == sphere.id);
    made.measures.push(Measure::info(
        &format!("{degrees}: lit share of the lone disc in truth"),
        1.0 - value(metrics::mean(&truth.shadow[0], &on)),
        "share",
    ));
    Ok(())
}

/// One sample anywhere inside each pixel.
const SNAPPED: Frame = Frame { axis: 1, stochastic: true, every_sample: true, seed: 0, number: 0 };

pub const F4: Figure = Figure {
    id: "W78-F4",
    paper: Paper::Williams78,
    title: "Increased bias, dither, interpolated depth",
    claim: "The moiré is broken into noise.",
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
            made.measures.push(Measure::at_least(&name, before / after, "ratio", 3.0).full_size(cx));
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
    let rest = value(metrics::false_shadow(&unquantised.shadow[0], &inner));
    made.measures.push(Measure::at_most(
        "float depth, interpolated, no dither, bias ½ px: false shadow",
        rest,
        "share",
        0.001,
    ));
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
        error_panel("error", "Less truth", truth.size, &faithful_4, &exact.shadow[0]),
    ];
    made.note = "Interpolating across silhouettes, where an empty texel counts as the far plane, is what breaks the moiré up: at this bias \
                 all of it lies within two texels of one. The price is light along the terminator; without it (right) there is none, \
                 and the moiré stays."
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
    let light = set.map.view();
    let jump = 0.5 / (light.far() - light.near()) as f32;
    let smooth = |at: Vec3| {
        let eye = light.world_to_eye().transform_point3(at.as_dvec3());
        let texel = light.eye_to_texel(eye).floor().as_ivec2();
        let window = TexelRect::new(texel - 2, texel + 3);
        let (low, high) = window
            .texels()
            .map(|texel| set.map.depth(texel))
            .fold((f32::INFINITY, f32::NEG_INFINITY), |(low, high), z| (low.min(z), high.max(z)));
        high - low < jump
    };
    truth.position.iter().map(|&at| at.is_finite() && smooth(at)).collect()
}

/// The stages after the comparison, on F4's image (W78-18).
fn filtered(size: UVec2, image: &[f32]) -> Vec<f32> {
    low_pass(size, &dequantise_edges(size, image, WINDOW), REPEATS)
}

/// Chain vertices to either side (W78-16), and repeats of the low-pass (W78-17).
const WINDOW: u32 = 8;
const REPEATS: u32 = 2;

pub const F5: Figure = Figure {
    id: "W78-F5",
    paper: Paper::Williams78,
    title: "Edges dequantised, image low-passed",
    claim: "Smooth contours; the dither merges into grey.",
    make: smoothing,
};

fn smoothing(cx: &Context) -> anyhow::Result<Made> {
    let set = spheres(cx);
    let centres = set.plain(cx, &Frame::CENTRES);
    let exact = set.truth(cx);
    let before = post(cx, &set, &centres, dithered(4.0)).shadow;
    let after = filtered(exact.size, &before);
    let blended = post(cx, &set, &centres, faithful(4.0)).shadow;
    let blended_after = filtered(exact.size, &blended);
    let width = exact.size.x as usize;
    let deviation = |image: &[f32]| {
        value(metrics::contour_deviation(Grid::new(image, width), shadow_grid(&exact), f64::INFINITY).map(|d| d.rms))
    };
    let everywhere = of(&exact, |_| true);
    let lone = |image: &[f32]| metrics::lone_pixels(Grid::new(image, width), &everywhere) as f64;
    let (rough, smooth) = (deviation(&before), deviation(&after));
    Ok(Made {
        panels: vec![
            shadow_image_panel("before", "Before", exact.size, &before).with("bias", "4 px").against("truth"),
            shadow_image_panel("filtered", "Edges dequantised, low-passed", exact.size, &after)
                .with("window", format!("{WINDOW} chain vertices"))
                .with("low-pass", format!("[1 2 1]/4 × {REPEATS}"))
                .against("truth"),
            shadow_image_panel("blended", "The same, interpolated across silhouettes", exact.size, &blended_after)
                .against("truth"),
            truth_panel(&exact),
            error_panel("error", "Less truth", exact.size, &after, &exact.shadow[0]),
        ],
        measures: vec![
            Measure::info("½ contour against truth before", rough, "px rms"),
            Measure::at_most("after, over before", smooth / rough, "ratio", 0.5),
            Measure::info(
                "the same, interpolated across silhouettes",
                deviation(&blended_after) / deviation(&blended),
                "ratio",
            ),
            Measure::at_most("lone pixels after, over before", lone(&after) / lone(&before).max(1.0), "ratio", 0.1),
            Measure::at_least(
                "distinct levels after",
                metrics::distinct_levels(&after, &everywhere) as f64,
                "levels",
                16.0,
            ),
        ],
        note: "Judged on the picture that is not interpolated across silhouettes: where it is, the terminator itself moves by some pixels, \
               which no filter on the picture can take back."
            .into(),
        ..Made::default()
    })
}

pub const F6: Figure = Figure {
    id: "W78-F6",
    paper: Paper::Williams78,
    title: "The shadow on the shaded picture",
    claim: "Shaded by the same light, the cosine hides what is left of the artefacts.",
    make: applied,
};

fn applied(cx: &Context) -> anyhow::Result<Made> {
    const DENSITY: f32 = 0.7;
    let set = spheres(cx);
    let shaded = set.plain(cx, &Frame::CENTRES);
    let truth = set.truth_points(cx, &Frame::CENTRES);
    let image = filtered(shaded.size, &post(cx, &set, &shaded, dithered(4.0)).shadow);
    let ours = darken(&shaded.colour, &image, DENSITY);
    let exact = darken(&shaded.colour, &truth.shadow[0], DENSITY);
    let band: Vec<bool> = of(&truth, |_| true).iter().zip(&truth.facing[0]).map(|(on, f)| *on && *f < 0.3).collect();
    let brightest = shaded.colour.iter().map(|c| c.max_element()).fold(0.0, f32::max);
    let grey = |colours: &[Vec3]| -> Vec<f32> { colours.iter().map(|c| c.element_sum() / (3.0 * brightest)).collect() };
    let loud = |colours: &[Vec3]| -> Vec<f32> { grey(colours).iter().map(|v| 4.0 * v).collect() };
    let shadow_error = value(metrics::rms(&image, &truth.shadow[0], &band));
    let image_error = value(metrics::rms(&grey(&ours), &grey(&exact), &band));
    let (kept, dimmed, inside) = highlights(cx, &set, &shaded, &truth, DENSITY);
    Ok(Made {
        panels: vec![
            colour_panel("shaded", "Without shadow", shaded.size, &shaded.colour),
            colour_panel("applied", "Shadow applied", shaded.size, &ours).with("density", DENSITY).against("truth"),
            colour_panel("truth", "Ray-traced truth, applied alike", shaded.size, &exact).role(Role::Truth),
            error_panel("error", "Darkness less truth's, four times", shaded.size, &loud(&exact), &loud(&ours)),
        ],
        measures: vec![
            Measure::info("shadow alone: error at N·L < .3", shadow_error, "rms share"),
            Measure::at_most("shaded picture: error over it", image_error / shadow_error, "ratio", 1.0 / 3.0),
            Measure::info("highlight pixels inside shadow", inside, "px"),
            Measure::exactly("point by point: brightest highlight left there", kept, "", 0.0),
            Measure::at_least("post-process: brightest highlight left there", dimmed, "", 1e-6),
        ],
        ..Made::default()
    })
}

/// The specular light left in pixels that truth calls dark although they face the light: per-sample mode against post-process (W78-4, W78-5).
fn highlights(cx: &Context, set: &Set, shaded: &Picture, truth: &Picture, density: f32) -> (f64, f64, f64) {
    let mut matt = Set { scene: set.scene.clone(), map: set.map.clone() };
    for object in &mut matt.scene.objects {
        object.material.specular = Vec3::ZERO;
    }
    let filter = dithered(4.0);
    let (glossy, plain) = (set.shoot(cx, filter, &Frame::CENTRES), matt.shoot(cx, filter, &Frame::CENTRES));
    let unshadowed = matt.plain(cx, &Frame::CENTRES);
    let (mut kept, mut dimmed, mut inside) = (0.0f32, 0.0f32, 0u32);
    for i in 0..truth.object.len() {
        let specular = (shaded.colour[i] - unshadowed.colour[i]).max_element();
        if truth.shadow[0][i] == 1.0 && glossy.shadow[0][i] == 1.0 && truth.share[i] == 1.0 && specular > 1e-3 {
            inside += 1;
            kept = kept.max((glossy.colour[i] - plain.colour[i]).max_element());
            dimmed = dimmed.max(specular * (1.0 - density));
        }
    }
    (f64::from(kept), f64::from(dimmed), f64::from(inside))
}

pub const TEAPOT: Figure = Figure {
    id: "U-teapot",
    paper: Paper::Williams78,
    title: "The teapot's curved shadow",
    claim: "A body of bicubic patches throws its shadow on a plane and on itself.",
    make: teapot,
};

fn teapot(cx: &Context) -> anyhow::Result<Made> {
    let set = Set::new(gallery::teapot(), cx.pick(768, 256), 1024);
    let depth = OnPlane { bias: Bias::World(0.3) };
    let Pcf { pattern, res_factor, min_size, cull, .. } = presets::reeves87_recommended();
    let picture = set.shoot(cx, Pcf { pattern, depth, res_factor, min_size, cull }, &Frame::default());
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
                .with("samples a pixel", 16)
                .with("bias", "0.3 before the tangent plane")
                .against("truth"),
            colour_panel("truth", "Ray-traced truth", truth.size, &truth.colour).role(Role::Truth),
            shadow_panel("shadow", "Shadow component", &picture),
            error_panel("error", "Shadow less truth", picture.size, &picture.shadow[0], &truth.shadow[0]),
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
