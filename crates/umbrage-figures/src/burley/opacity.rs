//! Burley 2006, Image 77: the density of a shadow by the distance from its caster.

use super::soft::{CORNER, FLOOR, LIGHT, TAPS, bound};
use crate::figure::{Context, Figure, Paper};
use crate::stage::panels::{colour_panel, shadow_and_error, truth_panel};
use crate::stage::penumbra::{axial, burley_max, mean_shadow};
use crate::stage::set::Set;
use glam::{DVec3, Vec3};
use umbrage_plane::SurfacePoint;
use umbrage_render::{Frame, Picture};
use umbrage_report::plot::{Axis, Plot, Series};
use umbrage_report::{Made, Measure};
use umbrage_scene::gallery;

pub const I77: Figure = Figure {
    id: "B06-I77",
    paper: Paper::Burley06,
    title: "Opacity by the occluder's distance",
    claim: "A shadow can fade with the distance from its occluder; this is off by default.",
    look: "how the shadow fades with the distance to what casts it.",
    make: opacity,
};

const FADE: f64 = 180.0;
const FAR: f64 = 0.25;

/// Density for a gap of `delta` world units (B06-10).
fn density(delta: f64) -> f64 {
    let share = (delta / FADE).clamp(0.0, 1.0);
    1.0 + (FAR - 1.0) * share * share * (3.0 - 2.0 * share)
}

fn opacity(cx: &Context) -> anyhow::Result<Made> {
    let set = Set::new(gallery::contact_box(), cx.pick(320, 128), 1024).in_colour();
    let view = set.scene.lights[0].view;
    let max = burley_max(&view, LIGHT, axial(&view, DVec3::new(CORNER.x, 60.0, CORNER.z)));
    let plain = format!("burley,max={max:.3}t,{TAPS}");
    let faded = format!("{plain},opacity=1..{FAR},fade={FADE}");
    let truth = set.truth_disc(cx, &Frame::CENTRES, LIGHT);
    let (off, on) = (set.by(cx, &plain, &Frame::CENTRES)?, set.by(cx, &faded, &Frame::CENTRES)?);
    let neutral = set.by(cx, &format!("{plain},opacity=1..1,fade={FADE}"), &Frame::CENTRES)?;
    let same = |a: &Picture, b: &Picture| {
        a.shadow[0].iter().zip(&b.shadow[0]).filter(|(a, b)| a.to_bits() != b.to_bits()).count() as f64
    };
    let shadow = bound(cx, &set, &faded)?;
    let light = view.light().truncate();
    let (mut measured, mut predicted, mut worst) = (Vec::new(), Vec::new(), 0.0f64);
    for step in 0..=24 {
        // Floor on the shadow's axis; the box's front is what the light meets first.
        let x = 14.0 + 5.0 * f64::from(step);
        let hit = light.lerp(DVec3::new(x, 0.0, 0.0), (CORNER.x - light.x) / (x - light.x));
        let delta = axial(&view, DVec3::new(x, 0.0, 0.0)) - axial(&view, hit);
        let place = |i: u32| {
            let z = 0.4 * (i as f32 - 15.5);
            SurfacePoint {
                region: step * 32 + i,
                object: FLOOR,
                ..SurfacePoint::at(Vec3::new(x as f32, 0.0, z), Vec3::Y)
            }
        };
        let found = mean_shadow(cx, &*shadow, &(0..32).map(place).collect::<Vec<_>>());
        worst = worst.max((found - density(delta)).abs());
        measured.push((delta, found));
        predicted.push((delta, density(delta)));
    }
    let mut made = Made::default();
    shadow_and_error(&mut made, ("off", "Opacity off, as by default"), ("recipe", &plain), &off, &truth);
    let caption = format!("Opacity 1 to {FAR} over {FADE} world units");
    shadow_and_error(&mut made, ("on", &caption), ("recipe", &faded), &on, &truth);
    made.panels.push(truth_panel(&truth));
    made.panels.push(colour_panel("colour", "The same, shaded", on.size, &on.colour));
    made.measures = vec![
        Measure::at_most("umbra's density: largest difference from o(δ)", worst, "share", 0.02),
        Measure::exactly("pixels that an opacity of 1 everywhere changes", same(&off, &neutral), "pixels", 0.0),
        Measure::at_least("pixels that the fading changes", same(&off, &on), "pixels", 1.0),
    ];
    let plot = Plot::new(
        "Density in the middle of the shadow",
        Axis::linear("δ, distance from occluder to receiver, world units"),
        Axis::linear("shadow"),
    )
    .add(Series::line("o(δ), as set", predicted))
    .add(Series::dots("o(δ), measured", measured));
    made.plots.push(("density".into(), plot.svg()));
    made.note =
        "This is an artistic control: with it on, the shadow is not that of any light; the truth beside it is the light's."
            .into();
    Ok(made)
}
