//! Williams 1978, Figure 6: the shadow image in its place in the picture.

use super::shadow::filtered;
use crate::figure::{Context, Figure, Paper};
use crate::stage::four_spheres::{Alone, alone, faithful, post, spheres};
use crate::stage::masks::{of, shadow_grid, value};
use crate::stage::panels::{colour_panel, error_panel, shadow_image_panel, zoomed_colour};
use crate::stage::set::Set;
use glam::{DVec2, UVec2, Vec3};
use umbrage_oracle::{metrics, predict};
use umbrage_render::post::darken;
use umbrage_render::{Frame, Picture};
use umbrage_report::plot::{Axis, Plot, Series};
use umbrage_report::{Made, Measure, Role};

pub const F6: Figure = Figure {
    id: "W78-F6",
    paper: Paper::Williams78,
    title: "The shadow on the shaded picture",
    claim: "Shaded by the same light, the cosine term hides what is left of the artefacts.",
    look: "the lit sides: artefacts that the shadow alone shows plainly are hardly seen once the picture is shaded.",
    make: applied,
};

fn applied(cx: &Context) -> anyhow::Result<Made> {
    const DENSITY: f32 = 0.7;
    let set = spheres(cx).in_colour();
    let shaded = set.plain(cx, &Frame::CENTRES);
    let truth = set.truth_points(cx, &Frame::CENTRES);
    let sphere = alone(&truth, &set).ok_or_else(|| anyhow::anyhow!("no sphere stands alone"))?;
    let image = filtered(shaded.size, &post(cx, &set, &shaded, faithful(4.0)).shadow);
    let ours = darken(&shaded.colour, &image, DENSITY);
    let exact = darken(&shaded.colour, &truth.shadow[0], DENSITY);
    let band: Vec<bool> = of(&truth, |_| true).iter().zip(&truth.facing[0]).map(|(on, f)| *on && *f < 0.3).collect();
    let brightest = shaded.colour.iter().map(|c| c.max_element()).fold(0.0, f32::max);
    let grey = |colours: &[Vec3]| -> Vec<f32> { colours.iter().map(|c| c.element_sum() / (3.0 * brightest)).collect() };
    let loud = |colours: &[Vec3]| -> Vec<f32> { grey(colours).iter().map(|v| 4.0 * v).collect() };
    let shadow_error = value(metrics::rms(&image, &truth.shadow[0], &band));
    let error_over =
        |ours: &[Vec3], exact: &[Vec3]| value(metrics::rms(&grey(ours), &grey(exact), &band)) / shadow_error;
    let (kept, dimmed, inside) = highlights(cx, &set, &shaded, &truth, &image, DENSITY);
    // The ambient term serves as the shadows' translucency: only the light's own contribution is darkened, down to nothing.
    let ambient = ambient(&set, &shaded);
    let direct: Vec<Vec3> = shaded.colour.iter().zip(&ambient).map(|(all, ambient)| *all - *ambient).collect();
    let lit = |shadow: &[f32]| -> Vec<Vec3> {
        darken(&direct, shadow, 1.0).iter().zip(&ambient).map(|(direct, ambient)| *direct + *ambient).collect()
    };
    let (hidden, hidden_exact) = (lit(&image), lit(&truth.shadow[0]));
    let size = shaded.size;
    let (terminator, part) = (terminator_window(&sphere, size), 6);
    let bare = shadow_image_panel("shadow", "The shadow alone", size, &image);
    let bare_zoom =
        zoomed_colour("shadow-zoom", "The shadow alone, at a terminator", size, &bare.pixels, terminator, part);
    Ok(Made {
        panels: vec![
            colour_panel("applied", "Shadow applied to the light's contribution only", size, &hidden)
                .with("density", 1)
                .against("truth"),
            bare.against("shadow-truth"),
            zoomed_colour("applied-zoom", "Applied, at the same terminator", size, &hidden, terminator, part),
            bare_zoom,
            zoomed_colour("whole-zoom", "Applied to the whole picture, at the same place", size, &ours, terminator, part),
            colour_panel("shaded", "Without shadow", size, &shaded.colour),
            colour_panel("truth", "Ray-traced truth, applied in the same way", size, &hidden_exact).role(Role::Truth),
            shadow_image_panel("shadow-truth", "Ray-traced shadow alone", size, &truth.shadow[0]).role(Role::Truth),
            colour_panel("whole", "Shadow applied to the whole picture", size, &ours)
                .with("density", DENSITY)
                .against("whole-truth"),
            colour_panel("whole-truth", "Ray-traced truth, applied to the whole picture", size, &exact)
                .role(Role::Truth),
            error_panel("error", "Applied to the whole picture: darkness minus truth's, four times as strong", size, &loud(&exact), &loud(&ours)),
            error_panel("applied-error", "Applied to the light's contribution: the same", size, &loud(&hidden_exact), &loud(&hidden)),
        ],
        plots: vec![("terminator".into(), across_terminator(&sphere, size.x, [&image, &grey(&hidden), &grey(&hidden_exact)]))],
        note: "The terminator of the shadow itself is ragged and lies some pixels too far into the dark. Where only the light's contribution is \
               darkened, as with the paper's translucent shadows, the cosine has already made that contribution almost nothing there, and neither fault is \
               visible. Where the \
               whole picture is darkened, ambient light included, the ragged edge comes back: the cosine hides only what it multiplies."
            .into(),
        measures: vec![
            Measure::info("shadow alone: error at N·L < .3", shadow_error, "rms share"),
            Measure::at_most("shaded picture: error over it", error_over(&ours, &exact), "ratio", 1.0 / 3.0),
            Measure::at_most(
                "the same, the light's part alone darkened",
                error_over(&hidden, &hidden_exact),
                "ratio",
                1.0 / 3.0,
            ),
            Measure::info("highlight pixels inside shadow", inside, "px"),
            Measure::exactly("point by point: brightest highlight left there", kept, "", 0.0),
            Measure::at_least("post-process: brightest highlight left there", dimmed, "", 1e-6),
        ],
        ..Made::default()
    })
}

/// The part of the picture that comes from no light.
fn ambient(set: &Set, shaded: &Picture) -> Vec<Vec3> {
    let of = |object: &u32| {
        set.scene.objects.get(*object as usize).map_or(Vec3::ZERO, |object| set.scene.ambient * object.material.diffuse)
    };
    shaded.object.iter().map(of).collect()
}

/// Where the lone sphere's terminator is looked at, as a fraction of the picture.
fn terminator_window(sphere: &Alone, size: UVec2) -> DVec2 {
    let left = sphere.radius * predict::terminator_offset(100f64.to_radians()).abs();
    (sphere.centre - DVec2::new(left, 0.0)) / size.as_dvec2()
}

/// A row of pixels across the lone sphere's terminator: the light that the shadow image lets through, and the brightness of the pictures.
fn across_terminator(sphere: &Alone, width: u32, [image, ours, exact]: [&[f32]; 3]) -> String {
    let row = sphere.centre.y as u32;
    let columns = (sphere.centre.x - sphere.radius) as u32 + 1..(sphere.centre.x + 0.4 * sphere.radius) as u32;
    let line = |value: &dyn Fn(usize) -> f32| -> Vec<(f64, f64)> {
        let at = |x: u32| {
            ((f64::from(x) + 0.5 - sphere.centre.x) / sphere.radius, f64::from(value((row * width + x) as usize)))
        };
        columns.clone().map(at).collect()
    };
    Plot::new(
        "A row across the terminator",
        Axis::linear("position on the sphere, radii"),
        Axis::linear("fraction of the brightest"),
    )
    .add(Series::line("light passed by the shadow alone", line(&|i| 1.0 - image[i])))
    .add(Series::line("shaded picture", line(&|i| ours[i])))
    .add(Series::dots("shaded truth", line(&|i| exact[i])))
    .svg()
}

/// The brightest specular light left well inside truth's shadow on surfaces that face the light, point by point and after the
/// post-process with `image` (W78-4, W78-5), and the number of such pixels that have any without shadow.
fn highlights(
    cx: &Context,
    set: &Set,
    shaded: &Picture,
    truth: &Picture,
    image: &[f32],
    density: f32,
) -> (f64, f64, f64) {
    let mut scene = set.scene.clone();
    for object in &mut scene.objects {
        object.material.specular = Vec3::ZERO;
    }
    let matt = Set::of(scene).in_colour();
    let per_sample = [set, &matt].map(|set| set.shoot(cx, faithful(4.0), &Frame::CENTRES).colour);
    let plain = matt.plain(cx, &Frame::CENTRES).colour;
    let afterwards = [&shaded.colour, &plain].map(|colour| darken(colour, image, density));
    let inside =
        metrics::both(&metrics::dark_mask(shadow_grid(truth), &truth.facing[0], 8, 0.05), &of(truth, |_| true));
    let left = |[glossy, matt]: &[Vec<Vec3>; 2], i: usize| f64::from((glossy[i] - matt[i]).max_element());
    let (mut kept, mut dimmed, mut count) = (0.0f64, 0.0f64, 0u32);
    for i in (0..inside.len()).filter(|&i| inside[i] && (shaded.colour[i] - plain[i]).max_element() > 1e-3) {
        count += 1;
        kept = kept.max(left(&per_sample, i));
        dimmed = dimmed.max(left(&afterwards, i));
    }
    (kept, dimmed, f64::from(count))
}
