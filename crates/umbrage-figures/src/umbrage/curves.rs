//! Umbrage's own curves: false shadow against bias (D-9), and noise against the number of samples (D-12).

use crate::figure::{Context, Figure, Paper};
use glam::{DVec3, UVec2, Vec2, Vec3};
use std::sync::Arc;
use umbrage_bake::bake;
use umbrage_depth::{First, Tiled};
use umbrage_oracle::{metrics, predict};
use umbrage_plane::{Bias, Footprint, SurfacePoint, View};
use umbrage_raster::{Cull, Triangle};
use umbrage_recipe::bind;
use umbrage_report::plot::{Axis, Plot, Series};
use umbrage_report::{Made, Measure};
use umbrage_sample::{Gaussian, InsideQuadReject, InsideQuadWarp, Jittered, Key, Pattern, Uniform};
use umbrage_shadow::{presets, weighted_mean};

pub const ACNE: Figure = Figure {
    id: "U-acne",
    paper: Paper::Umbrage,
    title: "False shadow against bias",
    claim: "A tilted plane shadows itself as the closed form of D-9 predicts, whether it is tilted along one axis or two.",
    look: "the measured points on the predicted curve, for one axis and for two.",
    make: acne,
};

/// A parallel light over a plane through the origin with the given unit normal (z toward the light): its map of 256².
fn tilted(normal: DVec3) -> anyhow::Result<(View, Arc<Tiled>)> {
    let view = View::orthographic(DVec3::Z * 200.0, DVec3::ZERO, DVec3::Y, 8.0, 1.0, 400.0, UVec2::splat(256))?;
    let on_plane = |x: f64, y: f64| DVec3::new(x, y, -(normal.x * x + normal.y * y) / normal.z).as_vec3();
    let corners = [on_plane(-20.0, -20.0), on_plane(20.0, -20.0), on_plane(20.0, 20.0), on_plane(-20.0, 20.0)];
    let sheet = |a: usize, b: usize, c: usize| Triangle::new([corners[a], corners[b], corners[c]], 0, true);
    Ok((view, bake(&view, [sheet(0, 1, 2), sheet(0, 2, 3)], &First, Cull::None).map))
}

fn acne(cx: &Context) -> anyhow::Result<Made> {
    let points = cx.pick(200_000u32, 40_000);
    let mut plot = Plot::new(
        "A plane tilted 60°",
        Axis::linear("bias, depth steps along the slope"),
        Axis::linear("fraction in false shadow"),
    );
    let mut worst = 0.0f64;
    for (name, azimuth) in
        [("slope along an axis", 0.0f64), ("slope at 30° to it", 30.0), ("slope along the diagonal", 45.0)]
    {
        let slope = 60f64.to_radians().tan();
        let (sin, cos) = azimuth.to_radians().sin_cos();
        let normal = DVec3::new(-slope * cos, -slope * sin, 1.0).normalize();
        let (view, map) = tilted(normal)?;
        let step = f64::from(view.texel_world(200.0).x as f32) * slope;
        let (mut measured, mut expected) = (Vec::new(), Vec::new());
        for index in 0..=16 {
            let steps = f64::from(index) * 0.05;
            let shadow = bind(presets::ordinary(Bias::World((steps * step) as f32)).filter, &map, cx.storage);
            let key = Key::new(cx.seed, 0, index);
            let receivers: Vec<SurfacePoint> = (0..points)
                .map(|i| {
                    let (x, y) = (key.signed(i, 0) * 7.0, key.signed(i, 1) * 7.0);
                    let z = -(normal.x * f64::from(x) + normal.y * f64::from(y)) / normal.z;
                    SurfacePoint::at(Vec3::new(x, y, z as f32), normal.as_vec3())
                })
                .collect();
            let mut shares = vec![0.0; receivers.len()];
            shadow.fractions(&receivers, key, &mut shares);
            let share = shares.iter().map(|&s| f64::from(s)).sum::<f64>() / f64::from(points);
            let predicted = predict::false_shadow_share(step * cos, step * sin, (steps * step, steps * step));
            // At bias 0 the exact half is decided by the last bit of each depth.
            worst = worst.max((share - predicted).abs());
            measured.push((steps, share));
            expected.push((steps, predicted));
        }
        plot = plot
            .add(Series::line(&format!("{name}, predicted"), expected))
            .add(Series::dots(&format!("{name}, measured"), measured));
    }
    Ok(Made {
        plots: vec![("false-shadow".into(), plot.svg())],
        measures: vec![Measure::at_most("largest difference from D-9", worst, "share", 0.01)],
        ..Made::default()
    })
}

pub const NOISE: Figure = Figure {
    id: "U-noise",
    paper: Paper::Umbrage,
    title: "Noise against the number of samples",
    claim: "Across an oblique edge the noise of jittered samples falls as N^−¾, that of independent samples as N^−½ (D-12).",
    look: "the two slopes: jittered samples fall more steeply than independent ones.",
    make: noise,
};

/// Rms error of a pattern's estimate of a half-plane, over many places of an oblique edge.
fn error<P: Pattern>(cx: &Context, pattern: &P, region: &Footprint, exact: &dyn Fn(f32) -> f64, rounds: u32) -> f64 {
    let direction = Vec2::from_angle(0.41);
    let sum: f64 = (0..rounds)
        .map(|round| {
            let key = Key::new(cx.seed, 2, 0).region(round);
            let offset = Key::new(cx.seed, 3, 0).region(round).signed(0, 0) * 2.0;
            let share: f32 = weighted_mean(pattern, region, key, |tap| {
                f32::from(u8::from((tap.at - region.centre).dot(direction) < offset))
            });
            (f64::from(share) - exact(offset)).powi(2)
        })
        .sum();
    (sum / f64::from(rounds)).sqrt()
}

fn noise(cx: &Context) -> anyhow::Result<Made> {
    let rounds = cx.pick(20_000, 4000);
    // A slanted quadrilateral inside a square box, so that (d) differs from the box.
    let square = Footprint::boxed(Vec2::splat(32.0), Vec2::splat(10.0));
    let slanted =
        Footprint::around([Vec2::new(28.0, 22.0), Vec2::new(42.0, 24.0), Vec2::new(36.0, 42.0), Vec2::new(22.0, 38.0)]);
    let counts: Vec<u32> = vec![4, 16, 64, 256];
    let jittered = |n| Jittered::default().with_num_samples(n);
    // Each pattern's own limit by very many samples at the same edge.
    let exact_box = |offset: f32| limit(&jittered(65_536), &square, offset);
    let exact_quad = |offset: f32| limit(&InsideQuadReject(jittered(65_536)), &slanted, offset);
    let exact_gauss = |offset: f32| limit(&Gaussian::default().with_num_samples(65_536), &square, offset);
    let table = |exact: &dyn Fn(f32) -> f64| -> Vec<f64> { (0..=256).map(|i| exact(-2.0 + i as f32 / 64.0)).collect() };
    let (in_box, in_quad, in_gauss) = (table(&exact_box), table(&exact_quad), table(&exact_gauss));
    let read = |table: &[f64], offset: f32| {
        let at = f64::from((offset + 2.0) * 64.0).clamp(0.0, 255.999);
        table[at as usize] + (table[at as usize + 1] - table[at as usize]) * at.fract()
    };
    let mut series: Vec<(&str, Vec<(f64, f64)>)> =
        ["(a) uniform", "(b) Gaussian", "(c) jittered", "(d1) inside, rejected", "(d2) inside, warped"]
            .map(|n| (n, Vec::new()))
            .to_vec();
    for &n in &counts {
        let values = [
            error(cx, &Uniform::default().with_num_samples(n), &square, &|o| read(&in_box, o), rounds),
            error(cx, &Gaussian::default().with_num_samples(n), &square, &|o| read(&in_gauss, o), rounds),
            error(cx, &jittered(n), &square, &|o| read(&in_box, o), rounds),
            error(cx, &InsideQuadReject(jittered(n)), &slanted, &|o| read(&in_quad, o), rounds),
            error(cx, &InsideQuadWarp(jittered(n)), &slanted, &|o| read(&in_quad, o), rounds),
        ];
        for (line, value) in series.iter_mut().zip(values) {
            line.1.push((f64::from(n), value));
        }
    }
    let slope = |index: usize| metrics::log_log_fit(&series[index].1).map_or(f64::NAN, |fit| fit.slope);
    let measures = vec![
        Measure::within("(a) uniform: slope", slope(0), "", -0.55, -0.45),
        Measure::within("(b) Gaussian: slope", slope(1), "", -0.55, -0.45),
        Measure::within("(c) jittered: slope", slope(2), "", -0.85, -0.65),
        Measure::info("(d1) inside, rejected: slope", slope(3), ""),
        Measure::info("(d2) inside, warped: slope", slope(4), ""),
        Measure::at_most("16 samples: (c) over (a)", series[2].1[1].1 / series[0].1[1].1, "ratio", 1.0),
    ];
    let mut plot =
        Plot::new("Error of the fraction across an oblique edge", Axis::log("samples"), Axis::log("rms error"));
    for (name, points) in series {
        plot = plot.add(Series::line(name, points));
    }
    Ok(Made { plots: vec![("noise".into(), plot.svg())], measures, ..Made::default() })
}

fn limit<P: Pattern>(pattern: &P, region: &Footprint, offset: f32) -> f64 {
    let direction = Vec2::from_angle(0.41);
    let inside = |at: Vec2| f32::from(u8::from((at - region.centre).dot(direction) < offset));
    f64::from(weighted_mean::<f32>(pattern, region, Key::new(0, 4, 0), |tap| inside(tap.at)))
}
