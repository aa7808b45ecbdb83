//! Wang & Molnar 1994, Figures 1 and 2: two passes, and samples that do not match.

use crate::figure::{Context, Figure, Paper};
use crate::stage::slices::{self, Slice, disc, rectangle, stored};
use crate::stage::tilted_plane::{on_plane, tilted};
use glam::{DVec2, DVec3};
use std::sync::Arc;
use umbrage_depth::{First, Tiled};
use umbrage_oracle::predict;
use umbrage_oracle::{Geometry, RayCast};
use umbrage_plane::{Bias, SurfacePoint};
use umbrage_recipe::bind;
use umbrage_render::{NOTHING, Picture};
use umbrage_report::diagram::{Diagram, Ink, Mark};
use umbrage_report::plot::{Axis, Plot, Series};
use umbrage_report::{Made, Measure};
use umbrage_sample::Key;
use umbrage_shadow::presets;

/// What lit, dark and stored samples are drawn with.
pub const LIT: Ink = Ink::Series(1);
/// See [`LIT`].
pub const DARK: Ink = Ink::Series(0);
/// See [`LIT`].
pub const STORED: Ink = Ink::Series(2);

pub const F1: Figure = Figure {
    id: "WM94-F1",
    paper: Paper::WangMolnar94,
    title: "The two passes",
    claim: "The light keeps the nearest depth of each texel; a camera's sample that lies farther is in shadow.",
    look: "the second pass: a sample at the depth that its texel keeps is lit, one behind it is not.",
    make: passes,
};

/// Places of the camera's samples and whether each is dark.
fn samples(picture: &Picture) -> impl Iterator<Item = (DVec2, bool)> + '_ {
    let seen = (0..picture.object.len()).filter(|&i| picture.object[i] != NOTHING);
    seen.map(|i| (picture.position[i].truncate(), picture.shadow[0][i] >= 0.5))
}

/// Those samples that are dark, or those that are not.
pub fn those(picture: &Picture, dark: bool) -> Vec<DVec2> {
    samples(picture).filter(|sample| sample.1 == dark).map(|sample| sample.0).collect()
}

fn passes(cx: &Context) -> anyhow::Result<Made> {
    let (light, eye) = (DVec2::new(-34.0, 58.0), DVec2::new(56.0, 40.0));
    let slice = Slice::new(
        "two-passes",
        vec![rectangle([-56.0, -6.0], [60.0, 0.0]), rectangle([-16.0, 0.0], [-6.0, 17.0]), disc([17.0, 11.0], 9.0)],
        &slices::lamp(light.into(), [2.0, 4.0], 62.0, 40)?,
        &slices::eye(eye.into(), [20.0, 0.0], 76.0, 72)?,
    )?;
    let map = slice.bake(&First);
    let geometry = Geometry::new(&slice.scene, &slice.scene.camera);
    let truth = slice.seen(cx, &RayCast::new(&geometry, slice.light()));
    let by_map = slice.seen(cx, &*bind(presets::ordinary(Bias::Steps(0.75)).filter, &map, cx.storage));
    // The same with a map of many more columns.
    let mut fine = Slice { scene: slice.scene.clone(), outlines: slice.outlines.clone() };
    fine.scene.lights[0].view = slices::lamp(light.into(), [2.0, 4.0], 62.0, 640)?;
    let by_fine = fine.seen(cx, &*bind(presets::ordinary(Bias::Steps(0.75)).filter, fine.bake(&First), cx.storage));
    let unlike = |picture: &Picture| {
        let both = samples(picture).zip(samples(&truth));
        both.filter(|(ours, exact)| ours.1 != exact.1).map(|pair| pair.0.0).collect::<Vec<DVec2>>()
    };
    let kept: Vec<DVec2> = stored(&map).into_iter().filter(|at| at.is_finite()).collect();
    // A depth that was rounded to f32 may lie behind its surface by that much.
    let before = |at: &DVec2| slices::world(at.lerp(light, f64::from(f32::EPSILON)));
    let blocked = kept.iter().filter(|at| geometry.occluded(before(at), slices::world(light))).count();
    let wrong = unlike(&by_map);
    let facing: Vec<usize> = (0..truth.object.len()).filter(|&i| truth.facing[0][i] > 0.2).collect();
    let dark = |picture: &Picture, i: usize| picture.shadow[0][i] >= 0.5;
    let turned = facing.iter().filter(|&&i| dark(&by_fine, i) != dark(&truth, i)).count();
    let all = samples(&truth).count();
    let frame = |title: &str| {
        let diagram = Diagram::new(title, DVec2::new(-50.0, -8.0), DVec2::new(62.0, 62.0));
        slice.outlined(diagram)
    };
    let from_light = frame("Pass 1: the light's view")
        .pieces(0.8, Ink::Faint, kept.iter().map(|&at| [light, at]))
        .named(Mark::Dots(4.0), STORED, &kept, "depths that the map keeps")
        .named(Mark::Dots(6.0), Ink::Plain, &[light], "light")
        .text_from(Ink::Plain, light + DVec2::new(3.0, 1.0), "light");
    let from_eye = frame("Pass 2: the camera's view")
        .pieces(0.8, Ink::Faint, samples(&by_map).map(|sample| [eye, sample.0]))
        .named(Mark::Dots(3.5), LIT, &those(&by_map, false), "camera's samples, lit")
        .named(Mark::Dots(3.5), DARK, &those(&by_map, true), "camera's samples, in shadow")
        .named(Mark::Rings(7.0), Ink::Plain, &wrong, "rays say otherwise")
        .draw(Mark::Dots(6.0), Ink::Plain, &[eye])
        .text_to(Ink::Plain, eye + DVec2::new(-3.0, 3.0), "camera");
    let by_rays = frame("The same by rays")
        .named(Mark::Dots(3.5), LIT, &those(&truth, false), "lit")
        .named(Mark::Dots(3.5), DARK, &those(&truth, true), "in shadow")
        .named(Mark::Rings(7.0), Ink::Plain, &unlike(&by_fine), "differs under a map of 641 columns")
        .draw(Mark::Dots(6.0), Ink::Plain, &[light, eye]);
    Ok(Made {
        plots: vec![
            ("pass-1".into(), from_light.svg()),
            ("pass-2".into(), from_eye.svg()),
            ("truth".into(), by_rays.svg()),
        ],
        measures: vec![
            Measure::exactly("kept depths that something hides from the light", blocked as f64, "texels", 0.0),
            Measure::info("kept depths", kept.len() as f64, "texels"),
            Measure::info("camera's samples answered unlike rays, 41 columns", wrong.len() as f64 / all as f64, "share"),
            Measure::info("the same, 641 columns", unlike(&by_fine).len() as f64 / all as f64, "share"),
            Measure::at_most(
                "the same of what is turned to the light by more than 0.2",
                turned as f64 / facing.len() as f64,
                "share",
                0.05,
            ),
            Measure::at_least("camera's samples in shadow", those(&by_map, true).len() as f64 / all as f64, "share", 0.1),
        ],
        note: "The slice shows one row of a real map of 41 columns and one row of a real picture, with a bias of ¾ of a depth step. Samples that differ from \
            rays lie at a shadow's edge or where a surface is nearly edge-on, where the depth step, and with it the bias, is large."
            .into(),
        ..Made::default()
    })
}

pub const F2: Figure = Figure {
    id: "WM94-F2",
    paper: Paper::WangMolnar94,
    title: "Samples that do not match",
    claim: "On a tilted surface half the camera's samples lie behind the depth that their texel stores.",
    look: "the camera's samples, half of which lie behind the depth that their texel stores.",
    make: mismatch,
};

/// A tilted surface under a light from above; what half a depth step moves is drawn moved.
pub fn slope(cx: &Context, title: &str, steps: f32) -> anyhow::Result<(Diagram, usize)> {
    let wedge = [[-12.0, -9.0], [12.0, -9.0], [12.0, 6.6], [-12.0, -6.6]].map(DVec2::from).to_vec();
    let light = slices::sun(DVec2::Y, DVec2::ZERO, 9.0, 8)?;
    let slice = Slice::new("slope", vec![wedge], &light, &slices::eye([-15.0, 17.0], [0.0, 0.0], 58.0, 51)?)?;
    let map = slice.bake(&First);
    let picture = slice.seen(cx, &*bind(presets::ordinary(Bias::Steps(steps)).filter, &map, cx.storage));
    let inside = |points: Vec<DVec2>| points.into_iter().filter(|at| at.x.abs() < 9.0).collect::<Vec<_>>();
    let (lit, dark) = (inside(those(&picture, false)), inside(those(&picture, true)));
    let kept = stored(&map);
    let texel = 18.0 / kept.len() as f64;
    let moved = DVec2::NEG_Y * f64::from(steps) * texel * 0.55;
    let tread = |at: &DVec2| [*at + moved - DVec2::X * 0.5 * texel, *at + moved + DVec2::X * 0.5 * texel];
    let columns = (0..=kept.len()).map(|i| -9.0 + i as f64 * texel);
    let diagram = slice
        .outlined(Diagram::new(title, DVec2::new(-10.0, -7.5), DVec2::new(10.0, 8.0)))
        .pieces(0.8, Ink::Faint, columns.map(|x| [DVec2::new(x, -7.5), DVec2::new(x, 8.0)]))
        .pieces(2.4, STORED, kept.iter().map(tread))
        .key(
            Mark::Line(2.4),
            STORED,
            if steps > 0.0 { "stored depth plus the bias" } else { "stored depth of a texel" },
        )
        .named(Mark::Dots(4.5), STORED, &kept, "light's samples")
        .named(Mark::Dots(3.5), LIT, &lit, "camera's samples, lit")
        .named(Mark::Dots(3.5), DARK, &dark, "camera's samples, shadowed by their own surface")
        .arrow(Ink::Plain, DVec2::new(-6.5, 7.4), DVec2::new(-6.5, 4.4))
        .text_from(Ink::Plain, DVec2::new(-6.0, 6.4), "light");
    Ok((diagram, dark.len()))
}

/// Fraction in false shadow of a plane whose depth changes along one axis only, bias in depth steps.
fn false_share(cx: &Context, map: &Arc<Tiled>, normal: DVec3, step: f64, steps: f64, points: u32) -> f64 {
    let shadow = bind(presets::ordinary(Bias::World((steps * step) as f32)).filter, map, cx.storage);
    let key = Key::new(cx.seed, 0, 0);
    let place = |i, axis| f64::from(key.signed(i, axis)) * 7.0;
    let receivers: Vec<SurfacePoint> =
        (0..points).map(|i| SurfacePoint::at(on_plane(normal, place(i, 0), place(i, 1)), normal.as_vec3())).collect();
    let mut shares = vec![0.0; receivers.len()];
    shadow.fractions(&receivers, key, &mut shares);
    shares.iter().map(|&share| f64::from(share)).sum::<f64>() / f64::from(points)
}

fn mismatch(cx: &Context) -> anyhow::Result<Made> {
    let (diagram, dark) = slope(cx, "One row of a real map, bias 0", 0.0)?;
    let points = cx.pick(100_000, 20_000);
    let tan = 60f64.to_radians().tan();
    let normal = DVec3::new(-tan, 0.0, 1.0).normalize();
    let (view, map) = tilted(normal)?;
    let step = view.texel_world(200.0).x * tan;
    let mut measures =
        vec![Measure::at_least("camera's samples in false shadow, as drawn", dark as f64, "samples", 1.0)];
    let (mut measured, mut predicted) = (Vec::new(), Vec::new());
    for index in 0..=12 {
        let steps = f64::from(index) * 0.05;
        let share = false_share(cx, &map, normal, step, steps, points);
        let expected = predict::false_shadow_share(step, 0.0, (steps * step, steps * step));
        measured.push((steps, share));
        predicted.push((steps, expected));
        if [0, 4, 8, 10].contains(&index) {
            let name = format!("false shadow at a bias of {steps:.1} depth steps (D-9: {expected:.2})");
            measures.push(Measure::within(&name, share, "share", expected - 0.01, expected + 0.01));
        }
    }
    let plot = Plot::new(
        "A plane tilted 60° along one axis",
        Axis::linear("bias, depth steps from texel to texel"),
        Axis::linear("fraction in false shadow"),
    )
    .add(Series::line("false shadow, D-9", predicted))
    .add(Series::dots("false shadow, measured", measured));
    Ok(Made {
        plots: vec![("mismatch".into(), diagram.svg()), ("false-shadow".into(), plot.svg())],
        measures,
        note: "The same holds whatever the map's size: at bias 0 exactly half of what is lit is in false shadow."
            .into(),
        ..Made::default()
    })
}
