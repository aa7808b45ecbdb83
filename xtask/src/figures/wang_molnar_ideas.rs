//! Wang & Molnar 1994, Figures 1 to 3: two passes, samples that do not match, and what a bias costs.

use super::slice::{self, Slice, disc, on_plane, rectangle, stored, tilted};
use crate::diagram::{Diagram, Ink, Mark};
use crate::figure::{Context, Figure, Made, Measure, Paper, Table};
use crate::plot::{Axis, Plot, Series};
use glam::{DVec2, DVec3, Vec3};
use umbrage_depth::{DepthMap, First, Tiled};
use umbrage_oracle::predict::{self, Stored};
use umbrage_oracle::{Geometry, RayCast};
use umbrage_plane::{Bias, SurfacePoint};
use umbrage_render::{NOTHING, Picture, bind};
use umbrage_sample::Key;
use umbrage_shadow::presets;

const LIT: Ink = Ink::Series(1);
const DARK: Ink = Ink::Series(0);
const STORED: Ink = Ink::Series(2);

pub const F1: Figure = Figure {
    id: "WM94-F1",
    paper: Paper::WangMolnar94,
    title: "The two passes",
    claim: "The light keeps the nearest depth of each texel; a camera's sample that lies farther is in shadow.",
    make: passes,
};

/// Places of the camera's samples and whether each is dark.
fn samples(picture: &Picture) -> impl Iterator<Item = (DVec2, bool)> + '_ {
    let seen = (0..picture.object.len()).filter(|&i| picture.object[i] != NOTHING);
    seen.map(|i| (picture.position[i].as_dvec3().truncate(), picture.shadow[0][i] >= 0.5))
}

/// Those samples that are dark, or those that are not.
fn those(picture: &Picture, dark: bool) -> Vec<DVec2> {
    samples(picture).filter(|sample| sample.1 == dark).map(|sample| sample.0).collect()
}

fn passes(cx: &Context) -> anyhow::Result<Made> {
    let (light, eye) = (DVec2::new(-34.0, 58.0), DVec2::new(58.0, 44.0));
    let slice = Slice::new(
        "two-passes",
        vec![rectangle([-56.0, -6.0], [60.0, 0.0]), rectangle([-16.0, 0.0], [-6.0, 17.0]), disc([17.0, 11.0], 9.0)],
        slice::lamp(light.into(), [2.0, 4.0], 62.0, 40)?,
        slice::eye(eye.into(), [0.0, 2.0], 50.0, 46)?,
    )?;
    let map = slice.bake(&First);
    let geometry = Geometry::new(&slice.scene, &slice.scene.camera);
    let truth = slice.seen(cx, &RayCast::new(&geometry, slice.light()));
    let by_map = slice.seen(cx, &*bind(presets::ordinary(Bias::Steps(0.5)), &map, cx.storage));
    let kept: Vec<DVec2> = stored(&map).into_iter().filter(|at| at.is_finite()).collect();
    let blocked = kept.iter().filter(|at| geometry.occluded(slice::world(**at), slice::world(light))).count();
    let wrong: Vec<DVec2> =
        samples(&by_map).zip(samples(&truth)).filter(|(ours, exact)| ours.1 != exact.1).map(|pair| pair.0.0).collect();
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
            Measure::at_most("camera's samples answered unlike rays", wrong.len() as f64 / all as f64, "share", 0.05),
            Measure::at_least("camera's samples in shadow", those(&by_map, true).len() as f64 / all as f64, "share", 0.1),
        ],
        note: "A slice: one row of a real map of 41 columns, one row of a real picture, a bias of half a depth step. The few samples that differ from rays stand within a texel of a shadow's edge."
            .into(),
        ..Made::default()
    })
}

pub const F2: Figure = Figure {
    id: "WM94-F2",
    paper: Paper::WangMolnar94,
    title: "Samples that do not match",
    claim: "On a tilted surface half the camera's samples lie behind the depth that their texel keeps.",
    make: mismatch,
};

/// A tilted surface under a light from above; what half a depth step moves is drawn moved.
fn slope(cx: &Context, title: &str, steps: f32) -> anyhow::Result<(Diagram, usize)> {
    let wedge = [[-12.0, -9.0], [12.0, -9.0], [12.0, 6.6], [-12.0, -6.6]].map(DVec2::from).to_vec();
    let light = slice::sun(DVec2::Y, DVec2::ZERO, 9.0, 8)?;
    let slice = Slice::new("slope", vec![wedge], light, slice::eye([-15.0, 17.0], [1.0, 0.0], 44.0, 37)?)?;
    let map = slice.bake(&First);
    let picture = slice.seen(cx, &*bind(presets::ordinary(Bias::Steps(steps)), &map, cx.storage));
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
        .key(Mark::Line(2.4), STORED, if steps > 0.0 { "kept depth plus the bias" } else { "kept depth of a texel" })
        .named(Mark::Dots(4.5), STORED, &kept, "light's samples")
        .named(Mark::Dots(3.5), LIT, &lit, "camera's samples, lit")
        .named(Mark::Dots(3.5), DARK, &dark, "camera's samples, shadowed by their own surface")
        .arrow(Ink::Plain, DVec2::new(-6.5, 7.4), DVec2::new(-6.5, 4.4))
        .text_from(Ink::Plain, DVec2::new(-6.0, 6.4), "light");
    Ok((diagram, dark.len()))
}

/// Share in false shadow of a plane whose depth changes along one axis only, bias in depth steps.
fn false_share(cx: &Context, map: &Tiled, normal: DVec3, step: f64, steps: f64, points: u32) -> f64 {
    let shadow = bind(presets::ordinary(Bias::World((steps * step) as f32)), map, cx.storage);
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
        Axis::linear("share in false shadow"),
    )
    .add(Series::line("false shadow, D-9", predicted))
    .add(Series::dots("false shadow, measured", measured));
    Ok(Made {
        plots: vec![("mismatch".into(), diagram.svg()), ("false-shadow".into(), plot.svg())],
        measures,
        note: "The same holds whatever the map's size: at bias 0 it is exactly a half of what is lit.".into(),
        ..Made::default()
    })
}

pub const F3: Figure = Figure {
    id: "WM94-F3",
    paper: Paper::WangMolnar94,
    title: "The bias and its cost",
    claim: "A bias of half a depth step ends false shadow; it also moves every shadow away from its caster.",
    make: bias,
};

/// A leg of `THICK` upright on a floor, the sun at `degrees` above the horizon in direction −x.
const THICK: f64 = 4.0;

fn leg(degrees: f64, columns: u32, phase: f64) -> anyhow::Result<Slice> {
    let to_light = DVec2::from_angle(std::f64::consts::PI - degrees.to_radians());
    let across = DVec2::new(to_light.y, -to_light.x) * (120.0 / f64::from(columns | 1));
    Slice::new(
        "leg",
        vec![rectangle([-200.0, -20.0], [260.0, 0.0]), rectangle([0.0, 0.0], [THICK, 60.0])],
        slice::sun(to_light, DVec2::new(10.0, 12.0) + across * phase, 60.0, columns)?,
        slice::eye([90.0, 55.0], [14.0, 6.0], 44.0, 400)?,
    )
}

/// Points of the floor between two places.
fn floor(from: f64, to: f64, count: u32) -> Vec<SurfacePoint> {
    let at = |i| from + (to - from) * (f64::from(i) + 0.5) / f64::from(count);
    (0..count).map(|i| SurfacePoint::at(Vec3::new(at(i) as f32, 0.0, 0.0), Vec3::Y)).collect()
}

/// The share in false shadow of the floor before a leg, and the lit gap behind it in world units, by one map.
fn fault(cx: &Context, map: &Tiled, bias: f64) -> (f64, f64) {
    let shadow = bind(presets::ordinary(Bias::World(bias as f32)), map, cx.storage);
    let ask = |points: &[SurfacePoint]| {
        let mut shares = vec![0.0; points.len()];
        shadow.fractions(points, Key::new(cx.seed, 0, 0), &mut shares);
        shares
    };
    let before = ask(&floor(-60.0, -20.0, 1600));
    let behind = ask(&floor(THICK, THICK + 40.0, 1600));
    let gap = behind.iter().position(|&share| share >= 0.5).map_or(40.0, |index| index as f64 * 40.0 / 1600.0);
    (before.iter().map(|&share| f64::from(share)).sum::<f64>() / before.len() as f64, gap)
}

/// Means of both over where the texels' borders fall.
fn faults(cx: &Context, maps: &[Tiled], bias: f64) -> (f64, f64) {
    let all: Vec<(f64, f64)> = maps.iter().map(|map| fault(cx, map, bias)).collect();
    let mean = |of: fn(&(f64, f64)) -> f64| all.iter().map(of).sum::<f64>() / all.len() as f64;
    (mean(|one| one.0), mean(|one| one.1))
}

fn maps(degrees: f64, columns: u32) -> anyhow::Result<Vec<Tiled>> {
    const PHASES: u32 = 8;
    let map = |phase| Ok(leg(degrees, columns, f64::from(phase) / f64::from(PHASES))?.bake(&First));
    (0..PHASES).map(map).collect()
}

fn bias(cx: &Context) -> anyhow::Result<Made> {
    let (cured, dark) = slope(cx, "The same row, bias of half a depth step", 0.5)?;
    let mut measures = vec![Measure::exactly("samples of the slope in false shadow", dark as f64, "samples", 0.0)];
    // V57, on a map whose texels are .23 wide.
    let fine = maps(45.0, 513)?;
    for (bias, wanted) in [(15.0, 6.606_602), (5.0, 0.0)] {
        let name = format!("gap behind a leg, bias {bias}, light at 45° (V57: {wanted:.3})");
        let gap = faults(cx, &fine, bias).1;
        measures.push(Measure::within(&name, gap, "world units", (wanted - 0.17_f64).max(0.0), wanted + 0.17));
    }
    let elevation = 25f64.to_radians();
    let (mut rows, mut acne, mut gaps) = (Vec::new(), Vec::new(), Vec::new());
    for columns in [17u32, 129] {
        let texel = 120.0 / f64::from(columns);
        let maps = maps(25.0, columns)?;
        let name = format!("{columns} columns");
        let sweep: Vec<(f64, (f64, f64))> =
            (0..=48).map(|i| f64::from(i) * 0.25).map(|bias| (bias, faults(cx, &maps, bias))).collect();
        acne.push(Series::line(&name, sweep.iter().map(|one| (one.0, one.1.0)).collect()));
        gaps.push(Series::dots(&format!("{name}, measured"), sweep.iter().map(|one| (one.0, one.1.1)).collect()));
        let least = sweep.iter().find(|one| one.1.0 == 0.0).map_or((f64::NAN, (f64::NAN, f64::NAN)), |one| *one);
        let hopeless = predict::no_bias_works(texel, 0.0, THICK, elevation);
        let needed = predict::acne_free_bias(texel / elevation.tan(), 0.0, 0.0);
        measures.push(Measure::within(
            &format!("{name}: smallest bias without false shadow (D-9: {needed:.2})"),
            least.0,
            "world units",
            needed - 0.25,
            needed + 0.25,
        ));
        let wanted = predict::contact_gap(least.0, THICK, elevation, Stored::First);
        measures.push(Measure::within(
            &format!("{name}: gap under that bias (D-10: {wanted:.2})"),
            least.1.1,
            "world units",
            (wanted - 0.5 * texel).max(0.0),
            wanted + 0.5 * texel,
        ));
        let found = u8::from(least.1.1 > 0.5 * texel.min(1.0));
        measures.push(Measure::exactly(
            &format!("{name}: no bias serves both floor and foot (1 yes; D-10)"),
            f64::from(found),
            "",
            f64::from(u8::from(hopeless)),
        ));
        rows.push(vec![
            columns.to_string(),
            format!("{texel:.2}"),
            format!("{needed:.2}"),
            format!("{:.2}", THICK / elevation.cos()),
            if hopeless { "none" } else { "yes" }.into(),
        ]);
    }
    let predicted = (0..=48).map(|i| f64::from(i) * 0.25);
    let predicted = predicted.map(|bias| (bias, predict::contact_gap(bias, THICK, elevation, Stored::First))).collect();
    let plot = |title, y| Plot::new(title, Axis::linear("bias, world units"), Axis::linear(y));
    let acne = acne.into_iter().fold(plot("False shadow on the floor", "share in false shadow"), Plot::add);
    let gaps = gaps.into_iter().fold(
        plot("The gap behind the leg", "lit gap, world units").add(Series::line("any map, D-10", predicted)),
        Plot::add,
    );
    let head = ["columns", "texel", "bias needed", "bias allowed", "a bias that serves"].map(String::from).to_vec();
    Ok(Made {
        plots: vec![
            ("bias".into(), cured.svg()),
            ("gap".into(), detached(cx)?),
            ("false-shadow".into(), acne.svg()),
            ("contact".into(), gaps.svg()),
        ],
        tables: vec![Table { name: "bias".into(), head, rows }],
        measures,
        note: "Gaps and false shadow are means over eight places of the texels' borders. Where texels are too wide for the leg, the least bias that cleans the floor already parts the shadow from the foot."
            .into(),
        ..Made::default()
    })
}

/// The foot of a leg under a bias that is larger than the leg is thick, map and rays.
fn detached(cx: &Context) -> anyhow::Result<String> {
    let slice = leg(45.0, 129, 0.0)?;
    let map = slice.bake(&First);
    let geometry = Geometry::new(&slice.scene, &slice.scene.camera);
    let rays = slice.seen(cx, &RayCast::new(&geometry, slice.light()));
    let by_map = slice.seen(cx, &*bind(presets::ordinary(Bias::World(15.0)), &map, cx.storage));
    let floor = |points: Vec<DVec2>| points.into_iter().filter(|at| at.y.abs() < 0.01).collect::<Vec<_>>();
    let below = |points: Vec<DVec2>| floor(points).into_iter().map(|at| at - DVec2::Y * 1.6).collect::<Vec<_>>();
    let kept: Vec<DVec2> = stored(&map).into_iter().filter(|at| at.is_finite()).collect();
    let toward = map.view().toward_eye(DVec3::ZERO).truncate();
    let moved: Vec<DVec2> = kept.iter().map(|at| *at - toward * 15.0).collect();
    let diagram = slice
        .outlined(Diagram::new("A leg 4 thick, light at 45°, bias 15", DVec2::new(-14.0, -8.0), DVec2::new(40.0, 22.0)))
        .named(Mark::Dots(2.2), STORED, &kept, "kept depths")
        .named(Mark::Dots(2.2), Ink::Series(3), &moved, "kept depths plus the bias")
        .named(Mark::Dots(2.6), LIT, &floor(those(&by_map, false)), "floor, lit")
        .named(Mark::Dots(2.6), DARK, &floor(those(&by_map, true)), "floor, in shadow")
        .draw(Mark::Dots(2.6), LIT, &below(those(&rays, false)))
        .draw(Mark::Dots(2.6), DARK, &below(those(&rays, true)))
        .text_from(Ink::Plain, DVec2::new(-13.0, -4.2), "upper row: by the map. Lower row: by rays.")
        .arrow(Ink::Plain, DVec2::new(-12.0, 20.0), DVec2::new(-7.0, 15.0))
        .text_from(Ink::Plain, DVec2::new(-8.0, 19.0), "light");
    Ok(diagram.svg())
}
