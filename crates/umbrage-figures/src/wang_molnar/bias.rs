//! Wang & Molnar 1994, Figure 3: what a bias cures and what it costs.

use super::ideas::{DARK, LIT, STORED, slope, those};
use crate::figure::{Context, Figure, Paper};
use crate::stage::slices::{self, Slice, rectangle, stored};
use glam::{DVec2, DVec3, Vec3};
use std::sync::Arc;
use umbrage_depth::{DepthMap, First, Stored, Tiled};
use umbrage_oracle::predict;
use umbrage_oracle::{Geometry, RayCast};
use umbrage_plane::{Bias, SurfacePoint};
use umbrage_recipe::bind;
use umbrage_report::diagram::{Diagram, Ink, Mark};
use umbrage_report::plot::{Axis, Plot, Series};
use umbrage_report::{Made, Measure, Table};
use umbrage_sample::Key;
use umbrage_shadow::presets;

pub const F3: Figure = Figure {
    id: "WM94-F3",
    paper: Paper::WangMolnar94,
    title: "The bias and its cost",
    claim: "A bias of half a depth step ends false shadow; it also moves every shadow away from its caster.",
    look: "the gap between caster and shadow in the second plot, which is as wide as the bias makes it.",
    make: bias,
};

/// Thickness of the leg, world units.
const THICK: f64 = 4.0;

/// A leg upright on a floor, the sun at `degrees` above the horizon in direction −x; `phase` texels move the map's grid.
fn leg(degrees: f64, columns: u32, phase: f64) -> anyhow::Result<Slice> {
    let to_light = DVec2::from_angle(std::f64::consts::PI - degrees.to_radians());
    let across = DVec2::new(to_light.y, -to_light.x) * (120.0 / f64::from(columns | 1));
    Slice::new(
        "leg",
        vec![rectangle([-200.0, -20.0], [260.0, 0.0]), rectangle([0.0, 0.0], [THICK, 60.0])],
        &slices::sun(to_light, DVec2::new(10.0, 12.0) + across * phase, 60.0, columns)?,
        &slices::eye([90.0, 55.0], [14.0, 6.0], 44.0, 400)?,
    )
}

/// Points of the floor between two places.
fn floor(from: f64, to: f64, count: u32) -> Vec<SurfacePoint> {
    let at = |i| from + (to - from) * (f64::from(i) + 0.5) / f64::from(count);
    (0..count).map(|i| SurfacePoint::at(Vec3::new(at(i) as f32, 0.0, 0.0), Vec3::Y)).collect()
}

/// The fraction of the floor in front of a leg that is in false shadow, and the lit gap behind it in world units, by one map.
fn fault(cx: &Context, map: &Arc<Tiled>, bias: f64) -> (f64, f64) {
    let shadow = bind(presets::ordinary(Bias::World(bias as f32)).filter, map, cx.storage);
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
fn faults(cx: &Context, maps: &[Arc<Tiled>], bias: f64) -> (f64, f64) {
    let all: Vec<(f64, f64)> = maps.iter().map(|map| fault(cx, map, bias)).collect();
    let mean = |of: fn(&(f64, f64)) -> f64| all.iter().map(of).sum::<f64>() / all.len() as f64;
    (mean(|one| one.0), mean(|one| one.1))
}

fn maps(degrees: f64, columns: u32) -> anyhow::Result<Vec<Arc<Tiled>>> {
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
        let wanted = predict::expected_contact_gap(least.0, THICK, elevation, Stored::First);
        measures.push(Measure::within(
            &format!("{name}: gap under that bias (D-10: {wanted:.2})"),
            least.1.1,
            "world units",
            (wanted - 0.5 * texel).max(0.0),
            wanted + 0.5 * texel,
        ));
        let found = u8::from(least.1.1 > 0.5);
        measures.push(
            Measure::exactly(
                &format!("{name}: no bias serves both floor and foot (D-10)"),
                f64::from(found),
                "",
                f64::from(u8::from(hopeless)),
            )
            .yes_no(),
        );
        rows.push(vec![
            columns.to_string(),
            format!("{texel:.2}"),
            format!("{needed:.2}"),
            format!("{:.2}", THICK / elevation.cos()),
            if hopeless { "none" } else { "yes" }.into(),
        ]);
    }
    let predicted = (0..=48).map(|i| f64::from(i) * 0.25);
    let predicted =
        predicted.map(|bias| (bias, predict::expected_contact_gap(bias, THICK, elevation, Stored::First))).collect();
    let plot = |title, y| Plot::new(title, Axis::linear("bias, world units"), Axis::linear(y));
    let acne = acne.into_iter().fold(plot("False shadow on the floor", "fraction in false shadow"), Plot::add);
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
        note: "Gaps and false shadow are means over eight offsets of the texel grid. Where texels are too wide for the leg, the smallest bias that clears the \
            floor of false shadow already detaches the shadow from the foot."
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
    let by_map = slice.seen(cx, &*bind(presets::ordinary(Bias::World(15.0)).filter, &map, cx.storage));
    let floor = |points: Vec<DVec2>| points.into_iter().filter(|at| at.y.abs() < 0.01).collect::<Vec<_>>();
    let below = |points: Vec<DVec2>| floor(points).into_iter().map(|at| at - DVec2::Y * 1.6).collect::<Vec<_>>();
    let kept: Vec<DVec2> = stored(&map).into_iter().filter(|at| at.is_finite()).collect();
    let toward = map.view().toward_eye(DVec3::ZERO).truncate();
    let moved: Vec<DVec2> = kept.iter().map(|at| *at - toward * 15.0).collect();
    let diagram = slice
        .outlined(Diagram::new(
            "A leg of thickness 4, light at 45°, bias 15",
            DVec2::new(-14.0, -8.0),
            DVec2::new(40.0, 22.0),
        ))
        .named(Mark::Dots(2.2), STORED, &kept, "stored depths")
        .named(Mark::Dots(2.2), Ink::Series(3), &moved, "stored depths plus the bias")
        .named(Mark::Dots(2.6), LIT, &floor(those(&by_map, false)), "floor, lit")
        .named(Mark::Dots(2.6), DARK, &floor(those(&by_map, true)), "floor, in shadow")
        .draw(Mark::Dots(2.6), LIT, &below(those(&rays, false)))
        .draw(Mark::Dots(2.6), DARK, &below(those(&rays, true)))
        .text_from(Ink::Plain, DVec2::new(13.0, -4.6), "upper row by the map, lower by rays")
        .arrow(Ink::Plain, DVec2::new(-12.0, 20.0), DVec2::new(-7.0, 15.0))
        .text_from(Ink::Plain, DVec2::new(-8.0, 19.0), "light");
    Ok(diagram.svg())
}
