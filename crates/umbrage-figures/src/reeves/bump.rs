//! Reeves, Salesin & Cook 1987, §6: the same filter over something other than depths. Highlights of a bumpy surface, transformed before
//! they are filtered (R87-26, EXT-8).

use super::hammered::{self, highlight};
use crate::figure::{Context, Figure, Paper};
use glam::{Vec2, Vec3};
use umbrage_plane::{Footprint, mix32};
use umbrage_report::plot::{Axis, Plot, Series};
use umbrage_report::{Made, Measure};
use umbrage_sample::{EveryTexel, Jittered, Key, Pattern};
use umbrage_shadow::weighted_mean;

pub const BUMP: Figure = Figure {
    id: "R87-bump",
    paper: Paper::Reeves87,
    title: "Highlights before filtering",
    claim: "A distant bumpy surface keeps its highlight when the highlights of its bumps are filtered, and loses it when their normals are.",
    look: "the far end of the surface, where the highlight fades only if normals are averaged before it is computed.",
    make: bump,
};

const SIDE: u32 = 512;

/// A map of unit normals, z outward: bumps of random slope, a few texels wide.
struct Bumps(Vec<Vec3>);

impl Bumps {
    fn new() -> Self {
        let height = |x: u32, y: u32| {
            let cell =
                |i: u32, j: u32| f32::from((mix32(mix32(i & 127).wrapping_add(j & 127)) >> 16) as u16) / 65_535.0;
            let (i, j, u, v) = (x / 4, y / 4, (x % 4) as f32 / 4.0, (y % 4) as f32 / 4.0);
            let smooth = |t: f32| t * t * (3.0 - 2.0 * t);
            let (u, v) = (smooth(u), smooth(v));
            let top = cell(i, j) * (1.0 - u) + cell(i + 1, j) * u;
            let bottom = cell(i, j + 1) * (1.0 - u) + cell(i + 1, j + 1) * u;
            (top * (1.0 - v) + bottom * v) * 9.0
        };
        let normal = |index: u32| {
            let (x, y) = (index % SIDE, index / SIDE);
            let slope = Vec2::new(height(x + 1, y) - height(x, y), height(x, y + 1) - height(x, y));
            Vec3::new(-slope.x, -slope.y, 1.0).normalize()
        };
        Self((0..SIDE * SIDE).map(normal).collect())
    }

    /// Repeats in both directions.
    fn at(&self, texel: Vec2) -> Vec3 {
        let wrap = |at: f32| (at.floor() as i64).rem_euclid(i64::from(SIDE)) as usize;
        self.0[wrap(texel.y) * SIDE as usize + wrap(texel.x)]
    }
}

/// Each normal's own highlight, then the mean.
fn transformed_first(bumps: &Bumps, pattern: &impl Pattern, region: &Footprint, half: Vec3, key: Key) -> f32 {
    weighted_mean(pattern, region, key, |tap| highlight(bumps.at(tap.at), half))
}

/// The highlight of the mean normal, normalised or not.
fn filtered_first(
    bumps: &Bumps,
    pattern: &impl Pattern,
    region: &Footprint,
    half: Vec3,
    key: Key,
    renormalised: bool,
) -> f32 {
    let mean: Vec3 = weighted_mean(pattern, region, key, |tap| bumps.at(tap.at));
    highlight(if renormalised { mean.normalize_or(half) } else { mean }, half)
}

fn bump(cx: &Context) -> anyhow::Result<Made> {
    let bumps = Bumps::new();
    let jittered = Jittered::default();
    let half = Vec3::new(50f32.to_radians().sin(), 0.0, 50f32.to_radians().cos());
    // Energy against the width of the region: what a highlight 50° off the surface keeps.
    let widths: Vec<f32> = (0..=8).map(|step| 2f32.powi(step)).collect();
    let rounds = cx.pick(2000, 400);
    let energy = |f: &dyn Fn(&Footprint, Key) -> f32, width: f32| {
        let one = |round: u32| {
            let key = Key::new(cx.seed, 0, 0).region(round);
            let centre = Vec2::new(key.unit(900, 0), key.unit(900, 1)) * SIDE as f32;
            f64::from(f(&Footprint::boxed(centre, Vec2::splat(0.5 * width)), key))
        };
        (0..rounds).map(one).sum::<f64>() / f64::from(rounds)
    };
    let curve = |f: &dyn Fn(&Footprint, Key) -> f32| -> Vec<(f64, f64)> {
        widths.iter().map(|&width| (f64::from(width), energy(f, width))).collect()
    };
    let ours = curve(&|region, key| transformed_first(&bumps, &jittered, region, half, key));
    let exact = curve(&|region, key| transformed_first(&bumps, &EveryTexel, region, half, key));
    let flat = curve(&|region, key| filtered_first(&bumps, &jittered, region, half, key, false));
    let unit = curve(&|region, key| filtered_first(&bumps, &jittered, region, half, key, true));
    let last = widths.len() - 1;
    let (kept, lost, lost_unit) =
        (ours[last].1 / exact[last].1, flat[last].1 / exact[last].1, unit[last].1 / exact[last].1);
    // V59: two normals, at 0° and 60° to the half vector.
    let two = [Vec3::Z, Vec3::new(60f32.to_radians().sin(), 0.0, 0.5)];
    let region = Footprint::boxed(Vec2::new(1.0, 0.5), Vec2::new(1.0, 0.5));
    let pair = |at: Vec2| two[usize::from(at.x >= 1.0)];
    let key = Key::new(cx.seed, 0, 0);
    let first: f32 = weighted_mean(&EveryTexel, &region, key, |tap| highlight(pair(tap.at), Vec3::Z));
    let mean: Vec3 = weighted_mean(&EveryTexel, &region, key, |tap| pair(tap.at));
    let plot = Plot::new(
        "Mean highlight of a bumpy surface",
        Axis::log("width of the region, texels"),
        Axis::linear("mean highlight"),
    )
    .add(Series::line("every bump's own highlight, supersampled", exact))
    .add(Series::dots("highlights, then filtered: 16 samples", ours))
    .add(Series::line("filtered normals", flat))
    .add(Series::line("filtered normals, normalised", unit));
    Ok(Made {
        panels: hammered::panels(cx),
        plots: vec![("energy".into(), plot.svg())],
        measures: vec![
            Measure::within(
                "two normals: transformed, then filtered (V59)",
                f64::from(first),
                "",
                0.500_487,
                0.500_490,
            ),
            Measure::within(
                "two normals: filtered, then transformed (V59)",
                f64::from(highlight(mean, Vec3::Z)),
                "",
                0.056_312,
                0.056_315,
            ),
            Measure::within(
                "the same, of unit length again (V59)",
                f64::from(highlight(mean.normalize(), Vec3::Z)),
                "",
                0.237_303,
                0.237_307,
            ),
            Measure::within("regions of 256 texels: energy kept", kept, "share of truth", 0.9, 1.1),
            Measure::at_most("filtered normals keep", lost, "share of truth", 0.5),
            Measure::at_most("filtered normals of unit length keep", lost_unit, "share of truth", 0.5),
        ],
        note: "The picture shows a floor of hammered copper, with round dents and domes of equal steepness, lit from behind. Nearby, a dome \
               covers many pixels, and all methods agree. Toward the horizon a pixel covers hundreds: their filtered normals cancel to that of a flat floor, \
               which sends no \
               highlight to the eye, so the copper goes dull; filtered highlights keep its sheen. The numbers are of a map of random bumps \
               seen through regions of growing width."
            .into(),
        ..Made::default()
    })
}
