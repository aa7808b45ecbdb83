//! Woo 1992, the cost of comparing whole units first.

use super::room::{Pair, middle_map};
use crate::figure::{Context, Figure, Paper};
use crate::stage::masks::points_of;
use std::time::Instant;
use umbrage_depth::Raw;
use umbrage_render::Frame;
use umbrage_report::{Made, Measure};
use umbrage_sample::Key;
use umbrage_shadow::{Counters, IntegerFirst, Shadow, ShadowMap, integer_first::behind, presets};

pub const COST: Figure = Figure {
    id: "W92-cost",
    paper: Paper::Woo92,
    title: "Whole units first",
    claim: "Comparing whole units first settles most comparisons, with the same results.",
    look: "the measures: the fraction of comparisons that whole numbers settle, and how many results differ.",
    make: cost,
};

fn cost(cx: &Context) -> anyhow::Result<Made> {
    let Pair { room, .. } = Pair::new(cx);
    let map = middle_map(&room);
    let seen = room.truth_points(cx, &Frame::CENTRES);
    let points = points_of(&seen);
    let key = Key::new(cx.seed, 0, 0);
    let (mut by_float, mut by_whole) = (vec![0.0; points.len()], vec![0.0; points.len()]);
    let floats = ShadowMap { filter: presets::woo92().filter, map: map.clone() };
    let wholes = ShadowMap { filter: IntegerFirst::default(), map: map.clone() };
    let listing = ShadowMap { filter: presets::reeves87().filter, map: Raw::copy_of(&map) };
    let mut counters = Counters::default();
    wholes.fractions_probed(&points, key, &mut by_whole, &mut counters);
    let mut timings = Vec::new();
    let mut time = |name: &str, shadow: &dyn Shadow, out: &mut [f32]| {
        let start = Instant::now();
        shadow.fractions(&points, key, out);
        timings.push((name.to_string(), start.elapsed().as_secs_f64()));
    };
    let mut unused = vec![0.0; points.len()];
    time("woo92, floats", &floats, &mut by_float);
    time("woo92, whole units first", &wholes, &mut unused);
    time("reeves87, with its bias", &listing, &mut unused);
    let differing = by_float.iter().zip(&by_whole).filter(|(a, b)| a != b).count();
    let all = counters.conclusive + counters.inconclusive;
    // V34: two random depths below 100 share their whole unit once in a hundred times.
    let draws = cx.pick(4_000_000u32, 400_000);
    let ties = (0..draws).filter(|&i| !behind(key.unit(i, 0) * 100.0, key.unit(i, 1) * 100.0, 1.0).1).count();
    Ok(Made {
        measures: vec![
            Measure::exactly("answers that differ from floating point", differing as f64, "receivers", 0.0),
            Measure::info("receivers", points.len() as f64, ""),
            Measure::info("comparisons settled by whole units", counters.conclusive as f64 / all as f64, "share"),
            Measure::within(
                "random depths below 100: not settled",
                ties as f64 / f64::from(draws),
                "share",
                0.009,
                0.011,
            ),
        ],
        note: "On today's processors floating point costs nothing extra; the times are in timings.json.".into(),
        timings,
        ..Made::default()
    })
}
