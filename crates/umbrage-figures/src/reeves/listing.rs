//! Reeves, Salesin & Cook 1987, Figure 4: the listing as printed beside the listing as it must be.

use crate::figure::{Context, Figure, Paper};
use glam::{DVec2, Vec2};
use umbrage_depth::{DepthMap, Raw};
use umbrage_plane::{Bias, Footprint, Receiver, SurfacePoint, TexelRect, View};
use umbrage_report::plot::{Axis, Plot, Series};
use umbrage_report::{Made, Measure, Table};
use umbrage_sample::{Jittered, Key};
use umbrage_scene::gallery;
use umbrage_shadow::as_printed::{self, Listing, RandRange, TextureRect};
use umbrage_shadow::{Biased, Pcf, Shadow, ShadowMap, presets};

pub const F4: Figure = Figure {
    id: "R87-F4",
    paper: Paper::Reeves87,
    title: "The listing, printed and corrected",
    claim: "SampleShadow as printed has errors, and each is shown beside the corrected listing.",
    look: "the counts of samples by the listing as printed, beside the corrected ones, row by row.",
    make: listing,
};

/// A region's half-extents in texels, NumSamples, MinSamples; its counts corrected and as printed (V02 to V07).
type Row = (f32, f32, u32, u32, [u32; 2], [u32; 2]);

const COUNTS: [Row; 16] = [
    (0.4, 0.4, 16, 1, [1, 1], [1, 1]),
    (0.75, 0.75, 16, 1, [2, 2], [2, 2]),
    (1.5, 1.5, 16, 1, [3, 3], [3, 3]),
    (3.0, 3.0, 16, 1, [4, 4], [4, 4]),
    (3.0, 1.0, 16, 1, [6, 2], [6, 2]),
    (7.9, 0.4, 16, 1, [16, 1], [16, 1]),
    (8.0, 4.0, 16, 1, [5, 3], [5, 3]),
    (4.0, 8.0, 16, 1, [3, 6], [3, 6]),
    (20.0, 1.0, 16, 1, [16, 1], [16, 1]),
    (20.0, 1.0, 16, 2, [8, 2], [16, 2]),
    (1.0, 20.0, 16, 2, [2, 16], [1, 16]),
    (0.5, 40.0, 16, 1, [1, 16], [1, 16]),
    (40.0, 0.5, 16, 1, [16, 1], [16, 1]),
    (5.25, 0.75, 16, 1, [11, 2], [11, 2]),
    (24.0, 24.0, 64, 2, [8, 8], [8, 8]),
    (3.0, 3.0, 4, 1, [2, 2], [2, 2]),
];

/// A map of 256², empty but for what `depth` says.
fn map(depth: impl Fn(i32) -> f32) -> anyhow::Result<Raw> {
    let view = gallery::sphere_plane().lights[0].view.with_size(glam::UVec2::splat(256))?;
    let stored = TexelRect::of_size(view.size()).texels().map(|texel| depth(texel.x)).collect();
    Ok(Raw::new(view, stored)?)
}

/// A receiver at depth `z` whose image is the square `centre` ± `half` texels.
fn receiver(view: &View, z: f32, centre: Vec2, half: f32) -> anyhow::Result<Receiver> {
    let world = view.world_at(centre.as_dvec2(), view.key(f64::from(z)));
    let at = SurfacePoint::at(world.as_vec3(), view.toward_eye(world).as_vec3());
    let seen = view.receiver(&at).map_err(|place| anyhow::anyhow!("the region is {place:?}"))?;
    Ok(Receiver { footprint: Footprint::boxed(centre, Vec2::splat(half)), depth: z, ..seen })
}

/// Mean of the printed listing over many keys: region `centre` ± `half` texels at depth `z`.
fn printed(cx: &Context, listing: &Listing, map: &Raw, z: f32, centre: DVec2, half: f64, rounds: u32) -> f64 {
    let bbox = TextureRect { umin: 0, umax: 255, vmin: 0, vmax: 255 };
    let at = (centre / 256.0).as_vec2().to_array();
    let size = [(half / 256.0) as f32; 2];
    let one = |round| {
        let (key, mut draw) = (Key::new(cx.seed, 0, 0).region(round), 0);
        let next = || {
            draw += 1;
            key.unit(draw, 0)
        };
        f64::from(as_printed::sample_shadow(listing, map, bbox, at, z, size, next))
    };
    (0..rounds).map(one).sum::<f64>() / f64::from(rounds)
}

/// The same for the corrected filter.
fn corrected(
    cx: &Context,
    filter: Pcf,
    map: &Raw,
    z: f32,
    centre: DVec2,
    half: f64,
    rounds: u32,
) -> anyhow::Result<f64> {
    let region = receiver(map.view(), z, centre.as_vec2(), half as f32)?;
    let shadow = ShadowMap { filter, map: map.clone() };
    let one = |round| f64::from(shadow.fraction_of(&region, Key::new(cx.seed, 0, 0).region(round)));
    Ok((0..rounds).map(one).sum::<f64>() / f64::from(rounds))
}

fn listing(cx: &Context) -> anyhow::Result<Made> {
    let head =
        ["half-extents", "NumSamples", "MinSamples", "corrected", "as printed", "guarded"].map(String::from).to_vec();
    let (mut rows, mut guarded, mut wrong) = (Vec::new(), 0, [0u32; 2]);
    for (a, b, n, m, wanted, wanted_printed) in COUNTS {
        let ours = Jittered::default().with_num_samples(n).with_min_samples(m).counts(Vec2::new(a, b));
        let theirs = as_printed::counts(a, b, n, m);
        guarded += theirs.guarded;
        wrong[0] += u32::from(ours.to_array() != wanted);
        wrong[1] += u32::from([theirs.ns, theirs.nt] != wanted_printed);
        rows.push(vec![
            format!("{a} × {b}"),
            n.to_string(),
            m.to_string(),
            format!("{} × {}", ours.x, ours.y),
            format!("{} × {}", theirs.ns, theirs.nt),
            if theirs.guarded > 0 { "yes" } else { "" }.into(),
        ]);
    }
    // A straight edge at column 100, a quarter texel left of the region's centre: V09.
    let edge = map(|x| if x >= 100 { 1.0 } else { f32::INFINITY })?;
    let rounds = cx.pick(40_000, 10_000);
    let hard = |rand| Listing { rand, res_factor: 1.0, bias0: 0.0, bias1: 0.0, ..Listing::default() };
    let exact = Pcf::default().with_depth(Biased::constant(Bias::ZERO)).with_res_factor(1.0);
    let at = |s: f64| DVec2::new(s, 128.0);
    // The fraction across the edge by position: the printed range moves the whole ramp.
    let places: Vec<f64> = (0..=48).map(|step| 97.0 + f64::from(step) / 8.0).collect();
    let ours = places.iter().map(|&s| Ok((s, corrected(cx, exact, &edge, 10.0, at(s), 2.0, 400)?)));
    let ours = ours.collect::<anyhow::Result<Vec<_>>>()?;
    let theirs = places.iter().map(|&s| (s, printed(cx, &hard(RandRange::Unit), &edge, 10.0, at(s), 2.0, 400)));
    let plot = Plot::new(
        "A straight edge at column 100",
        Axis::linear("centre of the region, texels"),
        Axis::linear("fraction in shadow"),
    )
    .add(Series::line("corrected", ours))
    .add(Series::line("as printed, Rand() in [0, 1)", theirs.collect()));
    let most = |n| {
        let pattern = Jittered::default().with_num_samples(n);
        let steps = (1..400).flat_map(|i| (1..400).map(move |j| Vec2::new(i as f32, j as f32) * 0.05));
        f64::from(steps.map(|half| pattern.counts(half).element_product()).max().unwrap_or(0))
    };
    let v09 = [
        corrected(cx, exact, &edge, 10.0, at(100.25), 2.0, rounds)?,
        printed(cx, &hard(RandRange::Unit), &edge, 10.0, at(100.25), 2.0, rounds),
    ];
    let mut measures = vec![
        Measure::exactly("counts that differ from V02–V07, corrected", f64::from(wrong[0]), "rows", 0.0),
        Measure::exactly("counts that differ from V02–V07, as printed", f64::from(wrong[1]), "rows", 0.0),
        Measure::exactly("divisions by zero that the guards met", f64::from(guarded), "regions", 2.0),
        Measure::exactly("most samples for NumSamples 16 (V07)", most(16), "samples", 22.0),
        Measure::exactly("most samples for NumSamples 4 (V07)", most(4), "samples", 6.0),
        Measure::within("edge, corrected (V09)", v09[0], "share", 0.5605, 0.5645),
        Measure::within("edge, as printed with Rand() in [0, 1) (V09)", v09[1], "share", 0.623, 0.627),
    ];
    places_and_ranges(cx, &mut measures)?;
    Ok(Made {
        tables: vec![Table { name: "counts".into(), head, rows }],
        plots: vec![("edge".into(), plot.svg())],
        measures,
        note: "Jitter drawn from [0, 1) reaches only a quarter of each cell, and shadows move a quarter of a cell toward −s and −t."
            .into(),
        ..Made::default()
    })
}

/// V10 to V15: truncation, regions behind the light, empty maps, the range of the bias.
fn places_and_ranges(cx: &Context, measures: &mut Vec<Measure>) -> anyhow::Result<()> {
    let fig4 = Listing::default();
    let column_0 = map(|x| if x == 0 { 1.0 } else { f32::INFINITY })?;
    let point = Listing { num_samples: 1, res_factor: 1.0, ..fig4 };
    let left = DVec2::new(-0.4, 128.0);
    let ordinary = ShadowMap { filter: presets::ordinary(Bias::ZERO).filter, map: column_0.clone() };
    let beside = receiver(column_0.view(), 10.0, left.as_vec2(), 0.0)?;
    let empty = map(|_| f32::INFINITY)?;
    let middle = DVec2::splat(128.0);
    let behind = column_0.view().light().truncate() * 1.1;
    let behind = SurfacePoint::at(behind.as_vec3(), glam::Vec3::Z);
    let near = ShadowMap { filter: presets::reeves87().filter, map: map(|_| 1.0)? };
    measures.extend([
        Measure::exactly(
            "sample at −.4, as printed: column 0 is read (V10)",
            printed(cx, &point, &column_0, 10.0, left, 0.0, 1),
            "share",
            1.0,
        ),
        Measure::exactly(
            "the same, corrected: outside (V10)",
            f64::from(ordinary.fraction_of(&beside, Key::new(cx.seed, 0, 0))),
            "share",
            0.0,
        ),
        Measure::exactly(
            "behind the light, as printed (V11)",
            printed(cx, &fig4, &near.map, -1.0, middle, 1.0, 1),
            "share",
            0.0,
        ),
        Measure::exactly(
            "the same, corrected (V11)",
            f64::from(near.fraction(&behind, Key::new(cx.seed, 0, 0))),
            "share",
            0.0,
        ),
        Measure::exactly("empty map, as printed (V14)", printed(cx, &fig4, &empty, 1e9, middle, 1.0, 1), "share", 0.0),
        Measure::exactly(
            "the same, corrected (V14)",
            corrected(cx, presets::reeves87().filter, &empty, 1e9, middle, 1.0, 1)?,
            "share",
            0.0,
        ),
    ]);
    for (stored, low, high) in [(9.65, 0.49, 0.51), (9.7, 0.0, 1e-3), (9.59, 1.0, 1.0)] {
        let flat = map(|_| stored)?;
        let share = corrected(cx, presets::reeves87().filter, &flat, 10.0, middle, 1.0, cx.pick(4000, 2000))?;
        measures.push(Measure::within(
            &format!("z = 10 over {stored}, bias (.3, .4) (V15)"),
            share,
            "share",
            low,
            high,
        ));
    }
    Ok(())
}
