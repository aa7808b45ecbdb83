//! Reeves, Salesin & Cook 1987, Figure 9: what a bias removes, and what it moves.

use crate::figure::{Context, Figure, Paper};
use crate::stage::masks::{lit, of, shadow_grid, value};
use crate::stage::panels::{framed, zoomed, zoomed_colour, zoomed_error};
use crate::stage::set::Set;
use crate::stage::sphere_plane::{CAST_EDGE, PLANE, SPHERE, TERMINATOR, false_shadow};
use glam::{DVec2, DVec3};
use umbrage_oracle::{metrics, predict};
use umbrage_plane::{Bias, View};
use umbrage_render::{Frame, Picture};
use umbrage_report::plot::{Axis, Plot, Series};
use umbrage_report::{Made, Measure, Role};
use umbrage_scene::gallery;
use umbrage_shadow::{Biased, presets};

pub const F9: Figure = Figure {
    id: "R87-F9",
    paper: Paper::Reeves87,
    title: "Bias (0, 0), (.2, .3), (.3, .4)",
    claim: "As the bias grows, moiré disappears and the boundary of the self-shadow moves.",
    look: "the stripes of (a) and (d) at bias 0, and how far the line where the sphere shadows itself has moved by (f).",
    make: bias,
};

fn bias(cx: &Context) -> anyhow::Result<Made> {
    let set = Set::new(gallery::sphere_plane(), cx.pick(512, 256), 1024).in_colour();
    let truth = set.truth_points(cx, &Frame::CENTRES);
    let exact = set.truth(cx);
    let mut made = Made::default();
    let (mut plane, mut sphere, mut edges) = (Vec::new(), Vec::new(), Vec::new());
    let mut shaded = Vec::new();
    let mut plot = Plot::new(
        "False shadow on the sphere's lit side",
        Axis::linear("N·L"),
        Axis::linear("fraction in false shadow"),
    );
    for (index, (low, high)) in [(0.0, 0.0), (0.2, 0.3), (0.3, 0.4)].into_iter().enumerate() {
        let filter = presets::reeves87().filter.with_depth(Biased::world(low, high));
        let picture = set.shoot(cx, filter, &Frame::CENTRES);
        plot = plot.add(Series::line(&format!("bias {low} to {high}"), by_facing(&picture, &truth)));
        let (on_plane, on_sphere) = false_shadow(&picture, &truth, 6);
        plane.push(on_plane);
        sphere.push(on_sphere);
        let cast = metrics::both(&metrics::edge_mask(shadow_grid(&exact), 6), &of(&exact, |id| id == PLANE));
        edges.push(value(excess(&picture, &exact, &cast)));
        let label = format!("bias ({low}, {high})");
        let letters = [["a", "d"], ["b", "e"], ["c", "f"]][index];
        for (letter, place, centre) in
            [(letters[0], "edge on the plane", CAST_EDGE), (letters[1], "self-shadow on the sphere", TERMINATOR)]
        {
            let panel = zoomed(letter, &format!("({letter}) {place}"), &picture, centre, 6);
            made.panels.push(panel.with("bias", &label).with("map", "1024²").against(&format!("truth-{place}")));
            let caption = format!("({letter}) minus truth");
            made.panels.push(zoomed_error(&format!("{letter}-error"), &caption, &picture, &exact, centre, 6));
        }
        let (letter, size) = (letters[1], picture.size);
        let (name, caption) = (format!("{letter}-shaded"), format!("({letter}) with its shading"));
        shaded.push(zoomed_colour(&name, &caption, size, &picture.colour, TERMINATOR, 6).with("bias", &label));
        if index == 2 {
            let caption = "The place that (d) to (f) enlarge, bias (0.3, 0.4)";
            shaded.push(framed("where", caption, size, &picture.colour, TERMINATOR, 6));
            let wide = presets::reeves87().filter.with_depth(Biased::world(low, high)).with_min_size(3.0);
            let wide = set.shoot(cx, wide, &Frame::CENTRES);
            let panel = zoomed("f-wide", "(f), no region narrower than 3 texels", &wide, TERMINATOR, 6);
            shaded.push(panel.with("bias", &label).with("MinSize", 3));
        }
    }
    for (place, centre) in [("edge on the plane", CAST_EDGE), ("self-shadow on the sphere", TERMINATOR)] {
        let panel = zoomed(&format!("truth-{place}"), &format!("Ray-traced truth, {place}"), &exact, centre, 6);
        made.panels.push(panel.role(Role::Truth));
    }
    made.panels.extend(shaded);
    made.plots.push(("facing".into(), plot.svg()));
    let (shift, predicted, seen) = terminator(cx)?;
    let falls = |values: &[f64]| f64::from(u8::from(values.windows(2).all(|pair| pair[1] < pair[0])));
    made.measures = vec![
        Measure::within("plane, bias 0: false shadow (M2)", plane[0], "share", 0.40, 0.52),
        Measure::info("plane, (.2, .3)", plane[1], "share"),
        Measure::at_most("plane, (.3, .4)", plane[2], "share", 0.03).full_size(cx.quick),
        Measure::within("sphere, bias 0", sphere[0], "share", 0.40, 0.52),
        Measure::info("sphere, (.2, .3)", sphere[1], "share"),
        Measure::info("sphere, (.3, .4)", sphere[2], "share"),
        Measure::exactly("false shadow falls strictly, plane", falls(&plane), "yes = 1", 1.0).yes_no(),
        Measure::exactly("false shadow falls strictly, sphere", falls(&sphere), "yes = 1", 1.0).yes_no(),
        Measure::within("terminator shift over prediction (D-11)", shift / predicted, "ratio", 0.65, 1.35),
        Measure::info("terminator shift, light fitted to the sphere", shift, "degrees"),
        Measure::at_least("pixels within 6° of the terminator", f64::from(seen), "px", 2000.0).full_size(cx.quick),
        Measure::at_most("cast edge moved from (.2, .3) to (.3, .4)", (edges[2] - edges[1]).abs(), "px", 0.5)
            .full_size(cx.quick),
    ];
    made.note = "On the plane the moiré disappears. On the sphere it disappears where the surface faces the light and retreats toward the terminator as the \
                 bias grows; but there the surface turns edge-on, the change of its depth from texel to texel has no bound, and no constant bias is enough \
                 (D-9): the plot shows what is left against N·L. The rings lie where the sphere's outline runs along a row of the map: the region's box, \
                 the sphere seen edge-on, is narrower there than a texel, so that all its samples read the same few texels and nothing is averaged. \
                 Regions of at least 3 texels turn the rings into even grey (f, last). In the shaded picture moiré and rings both \
                 lie where hardly any light arrives."
        .into();
    Ok(made)
}

/// False shadow on the sphere where truth is lit, by how far the surface faces the light: N·L and the mean of each twentieth.
fn by_facing(picture: &Picture, truth: &Picture) -> Vec<(f64, f64)> {
    const BINS: usize = 20;
    let on = lit(truth, 1, |id| id == SPHERE);
    let mut bins = vec![(0.0f64, 0u32); BINS];
    for i in (0..on.len()).filter(|&i| on[i]) {
        let bin = &mut bins[((truth.facing[0][i] * BINS as f32) as usize).min(BINS - 1)];
        bin.0 += f64::from(picture.shadow[0][i]);
        bin.1 += 1;
    }
    let mean = |(index, bin): (usize, &(f64, u32))| ((index as f64 + 0.5) / BINS as f64, bin.0 / f64::from(bin.1));
    bins.iter().enumerate().filter(|(_, bin)| bin.1 > 0).map(mean).collect()
}

/// Mean signed displacement of an edge, in pixels: missing shadow area over the length of truth's contour, both within a mask around it.
fn excess(picture: &Picture, truth: &Picture, mask: &[bool]) -> Option<f64> {
    let inside = |at: DVec2| mask[at.y as usize * truth.size.x as usize + at.x as usize];
    let pieces = metrics::contour(shadow_grid(truth), 0.5);
    let length: f64 = pieces.iter().filter(|[a, b]| inside((*a + *b) * 0.5)).map(|[a, b]| a.distance(*b)).sum();
    if length == 0.0 {
        return None;
    }
    let missing = (0..mask.len()).filter(|&i| mask[i]).map(|i| f64::from(truth.shadow[0][i] - picture.shadow[0][i]));
    Some(missing.sum::<f64>() / length)
}

/// Where the sphere's self-shadow reaches one half past the true terminator, against D-11, in degrees, and over how many pixels.
///
/// The closed form holds for texels that are small against the bias's own chord, b²/2r: the light is fitted to the sphere and point look-ups are used.
fn terminator(cx: &Context) -> anyhow::Result<(f64, f64, u32)> {
    const BIAS: f32 = 0.35;
    let mut scene = gallery::sphere_plane();
    let light = scene.lights[0].view;
    let eye = light.light().truncate();
    let fov = 18f64.to_radians();
    scene.lights[0].view =
        View::perspective(eye, DVec3::new(0.0, 0.0, 25.0), DVec3::Z, fov, light.near(), light.far(), light.size())?;
    let set = Set::new(scene, 512, cx.pick(4096, 2048));
    let picture = set.shoot(cx, presets::ordinary(Bias::World(BIAS)).filter, &Frame { axis: 4, ..Frame::CENTRES });
    let mut bins = vec![(0.0f64, 0u32); 60];
    for i in of(&picture, |id| id == SPHERE).iter().enumerate().filter(|(_, on)| **on).map(|(i, _)| i) {
        let past = (-f64::from(picture.facing[0][i])).asin().to_degrees();
        let bin = ((past + 6.0) * 5.0).floor();
        if (0.0..60.0).contains(&bin) {
            bins[bin as usize].0 += f64::from(picture.shadow[0][i]);
            bins[bin as usize].1 += 1;
        }
    }
    let seen = bins.iter().map(|bin| bin.1).sum();
    let filled = bins.iter().enumerate().filter(|(_, bin)| bin.1 > 0);
    let mean: Vec<(f64, f64)> = filled.map(|(i, bin)| (i as f64 / 5.0 - 5.9, bin.0 / f64::from(bin.1))).collect();
    // Acne darkens the band before the terminator: the boundary is the last crossing, not the first.
    let crossing = mean.windows(2).rev().find(|pair| pair[0].1 < 0.5 && pair[1].1 >= 0.5);
    let at = crossing.map(|pair| pair[0].0 + (0.5 - pair[0].1) / (pair[1].1 - pair[0].1) * (pair[1].0 - pair[0].0));
    Ok((value(at), predict::terminator_shift(12.0, f64::from(BIAS)).to_degrees(), seen))
}
