//! Reeves, Salesin & Cook 1987, Figures 1 to 6: the idea, the placement of samples, the listing, the first example.

use crate::figure::{Context, Figure, Paper};
use crate::stage::masks::{lit as lit_mask, of, shadow_grid, value};
use crate::stage::panels::{colour_panel, error_panel, shadow_panel, truth_panel};
use crate::stage::set::Set;
use crate::stage::sphere_plane::{CAST_EDGE, PLANE, penumbra};
use glam::{DVec2, DVec3, UVec2, Vec2};
use umbrage_depth::{DepthMap, Raw};
use umbrage_oracle::metrics;
use umbrage_plane::{Bias, Footprint, SurfacePoint, TexelRect, View};
use umbrage_render::{Frame, Picture};
use umbrage_report::plot::{Axis, Plot, Series};
use umbrage_report::{Made, Measure, Panel, Role};
use umbrage_sample::{Gaussian, InsideQuadReject, InsideQuadWarp, Jittered, Key, Pattern, Uniform, each_tap};
use umbrage_scene::gallery;
use umbrage_shadow::{Biased, OnPlane, Pcf, presets};

pub const F1: Figure = Figure {
    id: "R87-F1",
    paper: Paper::Reeves87,
    title: "Points of view for a simple scene",
    claim: "The two-pass idea: what the camera sees lit is what the light sees.",
    look: "the three views of one scene: what the light does not see is dark in the camera's view.",
    make: points_of_view,
};

/// Reeves' filter against the tangent plane: with it, even regions as large as those seen from far away need no larger bias (R87-13).
fn on_plane() -> Pcf<Jittered, OnPlane> {
    Pcf::default()
        .with_depth(OnPlane::biased(Bias::World(0.35)))
        .with_pattern(Jittered::default())
        .with_res_factor(3.0)
        .with_min_size(0.0)
}

fn points_of_view(cx: &Context) -> anyhow::Result<Made> {
    let pixels = cx.pick(512, 192);
    // A light that sees all that the camera does.
    let mut scene = gallery::sphere_plane();
    let lamp = &mut scene.lights[0].view;
    let (eye, target) = (lamp.light().truncate(), DVec3::new(0.0, 0.0, 12.0));
    *lamp = View::perspective(eye, target, DVec3::Y, 90f64.to_radians(), lamp.near(), lamp.far(), lamp.size())?;
    let set = Set::new(scene, pixels, 1024).in_colour();
    let light = set.scene.lights[0].view;
    let seen_from = |view: &View| {
        let mut set = Set::new(set.scene.clone(), pixels, 1024).in_colour();
        set.scene.camera = view.with_size(UVec2::splat(pixels)).unwrap_or(*view);
        set.shoot(cx, on_plane(), &Frame::default())
    };
    let high = View::perspective(
        DVec3::new(-95.0, -150.0, 190.0),
        DVec3::new(-15.0, 0.0, 15.0),
        DVec3::Z,
        48f64.to_radians(),
        10.0,
        600.0,
        UVec2::splat(pixels),
    )?;
    let camera = set.shoot(cx, on_plane(), &Frame::default());
    let truth = set.truth_points(cx, &Frame::CENTRES);
    let exact = set.truth(cx);
    let (mut lit, mut hidden, mut beside) = (0u32, 0u32, 0u32);
    for i in lit_mask(&truth, 0, |_| true).into_iter().enumerate().filter(|(_, on)| *on).map(|(i, _)| i) {
        lit += 1;
        let seen = light.receiver(&SurfacePoint::at(truth.position[i], truth.normal[i])).is_ok_and(|receiver| {
            let texel = receiver.footprint.centre.floor().as_ivec2();
            beside += u32::from(!TexelRect::of_size(light.size()).contains(texel));
            let around = TexelRect::new(texel - 1, texel + 2).texels();
            let compared = receiver.nearer(&light, Bias::Steps(1.5));
            around.map(|texel| set.map().depth(texel)).any(|stored| compared <= stored)
        });
        hidden += u32::from(!seen);
    }
    let view = |name, caption, picture: &Picture| colour_panel(name, caption, picture.size, &picture.colour);
    Ok(Made {
        panels: vec![
            view("a-high-above", "View from high above the scene", &seen_from(&high)),
            view("b-light", "View from the light source", &seen_from(&light)),
            view("c-camera", "View from the camera", &camera),
            truth_panel(&exact),
            error_panel("error", "The camera's shadow minus truth", exact.size, &camera.shadow[0], &exact.shadow[0]),
        ],
        measures: vec![
            Measure::at_least("lit points of the picture", f64::from(lit), "points", 1000.0),
            Measure::exactly("of these hidden from the light, to a texel", f64::from(hidden), "points", 0.0),
            Measure::exactly("of these outside the light's view", f64::from(beside), "points", 0.0),
        ],
        ..Made::default()
    })
}

pub const F2: Figure = Figure {
    id: "R87-F2",
    paper: Paper::Reeves87,
    title: "Ordinary against percentage-closer filtering",
    claim: "Filtering the depths first gives a mean of 22.9 and full shadow; comparing first gives a shadow of .55.",
    look: "the nine depths under the region, and what each method makes of them: all in shadow, or five of nine.",
    make: two_orders,
};

fn two_orders(cx: &Context) -> anyhow::Result<Made> {
    let depths = [50.2f32, 50.0, 50.0, 50.1, 1.2, 1.1, 1.3, 1.4, 1.2];
    let z = 49.8;
    let view = gallery::sphere_plane().lights[0].view.with_size(UVec2::splat(12))?;
    let inside = |texel: glam::IVec2| {
        let at = texel - 4;
        TexelRect::of_size(UVec2::splat(3)).contains(at).then(|| depths[(at.y * 3 + at.x) as usize])
    };
    let stored = TexelRect::of_size(view.size()).texels().map(|t| inside(t).unwrap_or(f32::INFINITY)).collect();
    let map = umbrage_depth::Map::from(Raw::new(view, stored)?);
    let centre = Vec2::splat(5.5);
    let corners = [(-1.5, -1.5), (1.5, -1.5), (1.5, 1.5), (-1.5, 1.5)]
        .map(|(x, y)| view.world_at((centre + Vec2::new(x, y)).as_dvec2(), -1.0 / f64::from(z)).as_vec3());
    let position = view.world_at(centre.as_dvec2(), -1.0 / f64::from(z)).as_vec3();
    let normal = view.toward_eye(position.as_dvec3()).as_vec3();
    let region = SurfacePoint::at(position, normal).with_corners(corners);
    let ask = |recipe: &str| -> anyhow::Result<f64> {
        let recipe: umbrage_recipe::Recipe = recipe.parse()?;
        Ok(f64::from(recipe.bind(&map, cx.storage)?.fraction(&region, Key::new(cx.seed, 0, 0))))
    };
    let mean = depths.iter().map(|&d| f64::from(d)).sum::<f64>() / 9.0;
    let size = UVec2::splat(3);
    let grey = |name, caption, values: Vec<f32>| Panel::grey(name, caption, size, values).zoom(64).role(Role::Map);
    let nearer = depths.iter().map(|&d| if z > d { 0.0 } else { 1.0 }).collect();
    Ok(Made {
        panels: vec![
            grey("depths", "Depths under the region, nearer darker", depths.iter().map(|d| d / 51.0).collect())
                .with("z", z),
            grey("a-ordinary", "Ordinary: all of it in shadow", vec![0.0; 9]).with("mean depth", format!("{mean:.1}")),
            grey("b-percentage-closer", "Compared first: five of nine nearer", nearer).with("fraction", ".55"),
        ],
        measures: vec![
            Measure::within("mean depth", mean, "", 22.944_44, 22.944_45),
            Measure::exactly("ordinary filtering", ask("ordinary")?, "share in shadow", 1.0),
            Measure::within(
                "percentage-closer filtering",
                ask("reeves87,pattern=every,res-factor=1,bias=0")?,
                "share in shadow",
                0.555_555,
                0.555_557,
            ),
        ],
        note: "The paper's nine depths are reconstructed so that both printed numbers hold.".into(),
        ..Made::default()
    })
}

pub const F3: Figure = Figure {
    id: "R87-F3",
    paper: Paper::Reeves87,
    title: "Where samples fall",
    claim: "Samples are placed uniformly, by a Gaussian, jittered within cells, or only inside the region's boundary.",
    look: "how the dots fill the same footprint: evenly, bunched at the middle, scattered within cells, or kept inside its outline.",
    make: placements,
};

/// A pixel's image whose quadrilateral is .62 of its bounding box (V42).
fn slanted_region() -> Footprint {
    let corners = [
        (0.610_685_5, 0.331_708_4),
        (0.612_439_5, 0.331_177_6),
        (0.611_877_9, 0.334_497_0),
        (0.610_133_0, 0.335_023_6),
    ];
    let region = Footprint::around(corners.map(|(s, t)| (DVec2::new(s, t) * 1024.0).as_vec2()));
    region.scaled(region.centre, 3.0, 0.0, Vec2::splat(256.0))
}

/// Calls back with every tap of a pattern in the figure's region.
type TapsOf<'a> = dyn Fn(Key, &mut dyn FnMut(Vec2)) + 'a;

fn placements(cx: &Context) -> anyhow::Result<Made> {
    let region = slanted_region();
    let keys = cx.pick(4000, 1000);
    let jittered = Jittered::default();
    let mut made = Made::default();
    let mut shares = Vec::new();
    let mut draw = |name: &str, title: &str, taps: &TapsOf| {
        let (mut dots, mut inner, mut inside, mut all) = (Vec::new(), 0u32, 0u32, 0u32);
        for round in 0..keys {
            taps(Key::new(cx.seed, 0, 0).region(round), &mut |at| {
                all += 1;
                inner += u32::from(((at - region.centre) / region.half).abs().max_element() < 0.5);
                inside += u32::from(in_quad(&region, at));
                if round < 12 {
                    dots.push((f64::from(at.x), f64::from(at.y)));
                }
            });
        }
        made.plots.push((name.into(), region_plot(title, &region, dots)));
        shares.push((4.0 * f64::from(inner) / f64::from(all), f64::from(inside) / f64::from(all)));
    };
    draw("a-uniform", "(a) uniform", &|key, each| {
        each_tap(&Uniform::default().with_num_samples(16), &region, key, |tap| each(tap.at));
    });
    draw("b-gaussian", "(b) Gaussian", &|key, each| {
        each_tap(&Gaussian::default().with_num_samples(16), &region, key, |tap| each(tap.at));
    });
    draw("c-jittered", "(c) jittered", &|key, each| each_tap(&jittered, &region, key, |tap| each(tap.at)));
    draw("d1-inside", "(d) inside, by rejection", &|key, each| {
        each_tap(&InsideQuadReject(jittered), &region, key, |tap| each(tap.at));
    });
    draw("d2-warped", "(d) inside, warped", &|key, each| {
        each_tap(&InsideQuadWarp(jittered), &region, key, |tap| each(tap.at));
    });
    let counts = jittered.counts(region.half);
    let mut worst = 0;
    for round in 0..200 {
        let mut cells = vec![0u32; counts.element_product() as usize];
        each_tap(&jittered, &region, Key::new(cx.seed, 0, 0).region(round), |tap| {
            let cell = ((tap.at - region.centre + region.half) / (region.half * 2.0) * counts.as_vec2()).as_uvec2();
            let cell = cell.min(counts - 1);
            cells[(cell.y * counts.x + cell.x) as usize] += 1;
        });
        worst = worst.max(cells.iter().map(|&n| n.abs_diff(1)).max().unwrap_or(0));
    }
    made.measures = vec![
        Measure::within("quadrilateral over bounding box", f64::from(region.quad_share()), "share", 0.61, 0.63),
        Measure::exactly("(c) cells without exactly one sample", f64::from(worst), "cells", 0.0),
        Measure::at_least("(b) density in the central quarter", shares[1].0, "× mean", 1.5),
        Measure::exactly("(d1) samples inside the quadrilateral", shares[3].1, "share", 1.0),
        Measure::exactly("(d2) samples inside the quadrilateral", shares[4].1, "share", 1.0),
    ];
    rendered_noise(cx, &mut made);
    Ok(made)
}

fn in_quad(region: &Footprint, at: Vec2) -> bool {
    let mut signs = (0..4).map(|i| {
        let (a, b) = (region.corners[i], region.corners[(i + 1) % 4]);
        (b - a).perp_dot(at - a)
    });
    let tolerance = region.half.element_product() * 1e-4;
    let first = signs.clone().fold(0.0f32, |sum, sign| sum + sign);
    signs.all(|sign| sign * first.signum() >= -tolerance)
}

fn region_plot(title: &str, region: &Footprint, dots: Vec<(f64, f64)>) -> String {
    let closed = |corners: &[Vec2]| -> Vec<(f64, f64)> {
        (0..=4).map(|i| corners[i % 4]).map(|c| (f64::from(c.x), f64::from(c.y))).collect()
    };
    let boxed = Footprint::boxed(region.centre, region.half);
    Plot::new(title, Axis::linear("column, texels"), Axis::linear("row, texels"))
        .equal()
        .add(Series::line("bounding box", closed(&boxed.corners)))
        .add(Series::line("region", closed(&region.corners)))
        .add(Series::dots("samples of 12 regions", dots))
        .svg()
}

/// The box's soft edge by a pattern.
fn soft_edge<P: Pattern + 'static>(set: &Set, cx: &Context, pattern: P) -> Picture {
    let depth = Biased::world(1.2, 1.6);
    set.shoot(
        cx,
        Pcf::default().with_pattern(pattern).with_depth(depth).with_res_factor(8.0).with_min_size(0.0),
        &Frame::CENTRES,
    )
}

/// Noise of each placement in a rendered soft edge, against the same placement's own limit of 1,024 samples.
fn rendered_noise(cx: &Context, made: &mut Made) {
    let set = Set::new(gallery::box_plane(), cx.pick(384, 128), 1024);
    let noise = |few: &dyn Fn(u32) -> Picture| {
        let (picture, limit) = (few(16), few(1024));
        value(metrics::rms(&picture.shadow[0], &limit.shadow[0], &penumbra(&limit)))
    };
    let jittered = |n| Jittered::default().with_num_samples(n);
    let uniform = noise(&|n| soft_edge(&set, cx, Uniform::default().with_num_samples(n)));
    let gaussian = noise(&|n| soft_edge(&set, cx, Gaussian::default().with_num_samples(n)));
    let jitter = noise(&|n| soft_edge(&set, cx, jittered(n)));
    let inside = noise(&|n| soft_edge(&set, cx, InsideQuadReject(jittered(n))));
    let warped = noise(&|n| soft_edge(&set, cx, InsideQuadWarp(jittered(n))));
    made.measures.extend([
        Measure::info("noise of (a) uniform, 16 samples (M6)", uniform, "rms share"),
        Measure::within("noise of (b) over (a)", gaussian / uniform, "ratio", 0.7, 1.3),
        Measure::at_most("noise of (c) over (a)", jitter / uniform, "ratio", 1.0),
        Measure::info("noise of (d1) over (a)", inside / uniform, "ratio"),
        Measure::info("noise of (d2) over (a)", warped / uniform, "ratio"),
    ]);
}

pub const F5: Figure = Figure {
    id: "R87-F5",
    paper: Paper::Reeves87,
    title: "Sphere and plane",
    claim: "A red sphere casts its shadow on an upright green plane.",
    look: "where the sphere meets its shadow on the plane.",
    make: example,
};

fn example(cx: &Context) -> anyhow::Result<Made> {
    let set = Set::new(gallery::sphere_plane(), cx.pick(1024, 256), 1024).in_colour().with_coloured_truths();
    let picture = set.shoot(cx, presets::reeves87().filter, &Frame::default());
    let truth = set.truth(cx);
    let centroid = |picture: &Picture| metrics::centroid(shadow_grid(picture), &of(picture, |id| id == PLANE));
    let shift = centroid(&picture).zip(centroid(&truth)).map(|(ours, exact)| ours.distance(exact));
    Ok(Made {
        panels: vec![
            colour_panel("shaded", "Full shading", picture.size, &picture.colour)
                .with("map", "1024²")
                .with("samples per pixel", 16)
                .with("ResFactor", 3)
                .with("bias", "0.3–0.4")
                .against("truth"),
            colour_panel("truth", "Ray-traced truth", truth.size, &truth.colour).role(Role::Truth),
            error_panel("error", "Shadow minus truth", picture.size, &picture.shadow[0], &truth.shadow[0]),
        ],
        measures: vec![
            Measure::at_most("shift of the cast shadow's centroid", value(shift), "px", 1.0).full_size(cx.quick),
        ],
        ..Made::default()
    })
}

pub const F6: Figure = Figure {
    id: "R87-F6",
    paper: Paper::Reeves87,
    title: "Shadow component: ordinary z-buffer against percentage-closer filtering",
    claim: "From the same map, an ordinary z-buffer gives jagged, binary edges and percentage-closer filtering antialiased ones.",
    look: "the two enlargements: squares of the map in (a), a ramp of many greys in (b).",
    make: component,
};

fn component(cx: &Context) -> anyhow::Result<Made> {
    let set = Set::new(gallery::sphere_plane(), cx.pick(512, 192), cx.pick(2048, 768));
    let ordinary = set.shoot(cx, presets::ordinary(Bias::World(0.35)).filter, &Frame::CENTRES);
    let filtered = set.shoot(cx, presets::reeves87().filter.with_res_factor(1.0), &Frame::CENTRES);
    let softened = set.shoot(cx, presets::reeves87().filter, &Frame::CENTRES);
    let truth = set.truth(cx);
    let edge = metrics::both(&metrics::edge_mask(shadow_grid(&truth), 4), &of(&truth, |id| id == PLANE));
    let error = |picture: &Picture| value(metrics::rms(&picture.shadow[0], &truth.shadow[0], &edge));
    let (a, b) = (error(&ordinary), error(&filtered));
    let everywhere = of(&ordinary, |_| true);
    let levels = metrics::levels_per_region(&filtered.shadow[0], 22);
    let map = cx.pick("2048²", "768²");
    let zoomed = |name, caption, picture: &Picture| crate::stage::panels::zoomed(name, caption, picture, CAST_EDGE, 8);
    Ok(Made {
        panels: vec![
            shadow_panel("a-ordinary", "(a) Ordinary z-buffer", &ordinary).with("map", map).with("bias", "0.35").against("truth"),
            shadow_panel("b-filtered", "(b) Percentage-closer filtering", &filtered)
                .with("map", map)
                .with("ResFactor", 1)
                .with("bias", "0.3–0.4")
                .against("truth"),
            truth_panel(&truth),
            error_panel("a-error", "(a) minus truth", truth.size, &ordinary.shadow[0], &truth.shadow[0]),
            error_panel("b-error", "(b) minus truth", truth.size, &filtered.shadow[0], &truth.shadow[0]),
            zoomed("a-zoom", "(a) enlarged", &ordinary),
            zoomed("b-zoom", "(b) enlarged", &filtered),
            zoomed("b-soft", "The same with ResFactor 3", &softened),
        ],
        measures: vec![
            Measure::exactly("(a) distinct levels (M5)", metrics::distinct_levels(&ordinary.shadow[0], &everywhere) as f64, "levels", 2.0),
            Measure::at_most("(b) levels per region: every value is k/(ns·nt)", value(levels.map(f64::from)), "levels", 23.0),
            Measure::info("(a) edge error", a, "rms share"),
            Measure::info("(b) edge error", b, "rms share"),
            Measure::at_most("(b) edge error over (a)", b / a, "ratio", 0.5),
            Measure::info("ResFactor 3: edge error over (a)", error(&softened) / a, "ratio"),
        ],
        note: "Errors are judged at ResFactor 1, where a region is a pixel; ResFactor 3 deliberately makes the edge softer than a point light's.".into(),
        ..Made::default()
    })
}
