//! Umbrage's own: filters for lights of several sizes, against the light itself (EXT-1, EXT-4).

use crate::figure::{Context, Figure, Paper};
use crate::stage::panels::{error_panel, shadow_panel, truth_panel};
use crate::stage::penumbra::{Edge, axial, burley_max};
use crate::stage::set::Set;
use glam::{DVec3, UVec2, Vec3};
use umbrage_oracle::metrics::Profile;
use umbrage_oracle::predict;
use umbrage_render::Frame;
use umbrage_report::plot::{Axis, Plot, Series};
use umbrage_report::{Made, Measure};
use umbrage_scene::{Light, gallery};
use umbrage_shadow::Shadow;

pub const SOFTNESS: Figure = Figure {
    id: "U-softness",
    paper: Paper::Umbrage,
    title: "Soft shadows against the size of the light",
    claim: "A radius computed from the light's size gives an area light's own penumbra where a single caster casts it.",
    look: "the widths of the penumbrae in the plot, beside the ray-traced ones.",
    make: softness,
};

/// Radii of the disc, world units; tangents of the sky's disc.
const RADII: [f64; 6] = [3.0, 6.0, 9.0, 12.0, 18.0, 24.0];
const TANGENTS: [f64; 4] = [0.01, 0.02, 0.04, 0.08];
/// The size that Burley's largest radius and the constant one are set to.
const SET: f64 = 12.0;
/// Height of the edge that casts the shadow; the floor is at 0.
const HEIGHT: f64 = 51.0;

/// The shadow's edge on the floor, for a penumbra of a whole width.
fn edge(width: f64) -> Edge {
    let half_width = (0.75 * width + 1.0) as f32;
    Edge { middle: Vec3::ZERO, normal: Vec3::Y, into_shadow: Vec3::NEG_X, half_width, half_length: 12.0 }
}

/// Root mean square distance between two profiles of one edge.
fn rms(a: &Profile, b: &Profile) -> f64 {
    let squares: f64 = a.points.iter().zip(&b.points).map(|(a, b)| (a.1 - b.1).powi(2)).sum();
    (squares / a.points.len().max(1) as f64).sqrt()
}

/// A size of the light under one recipe: widths and error against rays.
struct Found {
    width: f64,
    exact: f64,
    error: f64,
}

fn measure(cx: &Context, shadow: &dyn Shadow, edge: &Edge, exact: &Profile) -> Found {
    let found = edge.profile(cx, shadow);
    let width = |profile: &Profile| profile.width().unwrap_or(f64::NAN);
    Found { width: width(&found), exact: width(exact), error: rms(&found, exact) }
}

/// An edge as rays to the whole light see it.
fn by_rays(cx: &Context, set: &Set, edge: &Edge, light: f64) -> Profile {
    edge.profile(cx, &set.disc_light(cx, &set.geometry(), light))
}

fn softness(cx: &Context) -> anyhow::Result<Made> {
    let set = Set::new(gallery::single_occluder(), cx.pick(320, 128), 1024);
    let view = set.scene.lights[0].view;
    let (floor, occluder) = (axial(&view, DVec3::ZERO), axial(&view, DVec3::Y * HEIGHT));
    let whole = |radius: f64| predict::expected_penumbra_width(2.0 * radius, occluder, floor);
    let max = burley_max(&view, SET, occluder);
    let constant = whole(SET) / 2.0 / view.texel_world(floor).x;
    let recipes: [(&str, &dyn Fn(f64) -> String); 5] = [
        ("Burley by the light's size", &|radius| format!("burley,light={radius},nearest=320,search=64,blur=64")),
        ("Burley, radius set for 12", &|_| format!("burley,max={max:.3}t,search=64,blur=64")),
        ("Fernando, radius set for 12", &|_| format!("fernando,max={max:.3}t,bias=1,search=64,blur=64")),
        ("constant radius, set for 12", &|_| {
            format!("reeves87,pattern=disc,samples=64,res-factor=0,min-size={constant:.3},bias=1")
        }),
        ("auto, maps by the light's size", &|radius| format!("auto,light={radius}")),
    ];
    let mut widths = Plot::new(
        "Width of the edge",
        Axis::linear("radius of the light, world units"),
        Axis::linear("10–90 % width, world units"),
    )
    .add(Series::line(
        "area light, predicted (D-16)",
        RADII.map(|r| (r, predict::DISC_EDGE_10_90 * whole(r))).to_vec(),
    ));
    let mut errors =
        Plot::new("Error across the edge", Axis::linear("radius of the light, world units"), Axis::linear("rms error"));
    // Wide enough for the filters that are set for one size, too.
    let lamps = RADII.map(|radius| {
        let edge = edge(whole(radius.max(SET)));
        let exact = by_rays(cx, &set, &edge, radius);
        (edge, exact)
    });
    let (mut made, mut shown) = (Made::default(), Vec::new());
    for (index, (name, recipe)) in recipes.iter().enumerate() {
        let mut found = Vec::new();
        for (&radius, (edge, exact)) in RADII.iter().zip(&lamps) {
            let shadow = set.shadow(cx, &recipe(radius))?;
            found.push(measure(cx, &*shadow, edge, exact));
            if radius == SET {
                shown.push(shadow);
            }
        }
        let line = |value: &dyn Fn(&Found) -> f64| {
            RADII.iter().zip(&found).map(|(&radius, found)| (radius, value(found))).collect::<Vec<_>>()
        };
        if index == 0 {
            widths = widths.add(Series::dots("area light, by rays", line(&|found| found.exact)));
            for (radius, found) in RADII.iter().zip(&found) {
                made.measures.push(near(&format!("lamp of radius {radius}: width over the area light's"), found));
            }
            // The recipe as one first types it, which searches from the light's near plane.
            let (edge, exact) = &lamps[3];
            let plain = set.shadow(cx, &format!("burley,light={}", RADII[3]))?;
            let plain = measure(cx, &*plain, edge, exact);
            let name = format!("lamp of radius {}, nothing else told: width over the area light's", RADII[3]);
            made.measures.push(near(&name, &plain));
            made.measures.push(Measure::info(
                "lamp: largest rms error across the edge",
                found.iter().map(|f| f.error).fold(0.0, f64::max),
                "share",
            ));
        }
        if recipe(SET).starts_with("auto") {
            for (radius, found) in RADII.iter().zip(&found) {
                let ratio = found.width / found.exact;
                let name = format!("auto, lamp of radius {radius}: width over the area light's");
                made.measures.push(Measure::within(&name, ratio, "ratio", 0.95, 1.05));
            }
            let most = found.iter().map(|found| found.error).fold(0.0, f64::max);
            made.measures.push(Measure::at_most("auto: largest rms error across the edge", most, "share", 0.03));
        }
        widths = widths.add(Series::line(name, line(&|found| found.width)));
        errors = errors.add(Series::line(name, line(&|found| found.error)));
    }
    sky(cx, &mut made)?;
    made.plots = vec![("width".into(), widths.svg()), ("error".into(), errors.svg())];
    let truth = set.truth_disc(cx, &Frame::CENTRES, SET);
    for ((name, recipe), (stem, shadow)) in
        recipes.iter().zip(["light", "burley", "fernando", "constant", "auto"].into_iter().zip(&shown))
    {
        let recipe = recipe(SET);
        let picture = set.draw(cx, &**shadow, &Frame::CENTRES);
        made.panels.push(shadow_panel(stem, name, &picture).with("recipe", recipe).against("truth"));
        made.panels.push(error_panel(
            &format!("{stem}-error"),
            &format!("{name}: minus truth"),
            picture.size,
            &picture.shadow[0],
            &truth.shadow[0],
        ));
    }
    made.panels.push(truth_panel(&truth).with("light's radius", SET));
    made.note = "Widths are measured on the floor under the board's straight edge, for the light itself with \
    256 rays per point. All the filters agree at the one size and height that they are set for; only the radius by the light's size follows other sizes."
        .into();
    Ok(made)
}

fn near(name: &str, found: &Found) -> Measure {
    Measure::within(name, found.width / found.exact, "ratio", 0.9, 1.1)
}

/// The same board under a directional light.
fn sky(cx: &Context, made: &mut Made) -> anyhow::Result<()> {
    let mut scene = gallery::single_occluder();
    scene.name = "single-occluder under the sky".into();
    scene.lights = vec![Light::directional("sun", DVec3::Y, DVec3::ZERO, 72.0, 50.0, 250.0, UVec2::splat(1024))?];
    let set = Set::new(scene, cx.pick(320, 128), 1024);
    for tangent in TANGENTS {
        let whole = 2.0 * predict::sky_penumbra_half_width(tangent.atan(), HEIGHT);
        let recipe = format!("burley,light={tangent},nearest=90,search=64,blur=64");
        let edge = edge(whole);
        let found = measure(cx, &*set.shadow(cx, &recipe)?, &edge, &by_rays(cx, &set, &edge, tangent));
        made.measures.push(near(&format!("sky of tangent {tangent}: width over the area light's"), &found));
    }
    Ok(())
}
