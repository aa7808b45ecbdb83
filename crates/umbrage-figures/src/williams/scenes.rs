//! Williams 1978, Figures 7 and 8 and the text: sculpted surfaces, the robot, what the method costs, and the cheaper one.

use crate::figure::{Context, Figure, Paper};
use crate::stage::lights::Stage;
use crate::stage::masks::{of, shadow_grid, value};
use crate::stage::panels::{colour_panel, error_panel, shadow_panel};
use glam::{DVec3, UVec2, Vec3};
use std::time::Instant;
use umbrage_bake::bake;
use umbrage_depth::First;
use umbrage_oracle::metrics::{self, Grid};
use umbrage_plane::{Kind, View};
use umbrage_raster::Cull;
use umbrage_render::post::shadow_image;
use umbrage_render::{Frame, Ground, Picture, Planar, Soup, picture};
use umbrage_report::plot::{Axis, Plot, Series};
use umbrage_report::{Made, Measure, Role};
use umbrage_sample::Key;
use umbrage_scene::{Light, Material, Mesh, Object, Scene, Shape, gallery};
use umbrage_shadow::{ShadowMap, Unshadowed, presets};

/// Reeves' filter against the tangent plane: the pictures are about surfaces, not about bias.
const RECIPE: &str = "reeves87-recommended,samples=32,depth=plane,bias=0.25";

pub const F7: Figure = Figure {
    id: "W78-F7",
    paper: Paper::Williams78,
    title: "A sculpted smile",
    claim: "Curved surfaces cast curved shadows on flat and curved surfaces alike.",
    look: "the smile's shadow, on the flat surface and on the curved one.",
    make: smile,
};

fn patches(scene: &Scene) -> usize {
    let count = |object: &Object| match &object.shape {
        Shape::Patches(patches) => patches.len(),
        Shape::Mesh(_) => 0,
    };
    scene.objects.iter().map(count).sum()
}

/// Overlap of two shadows within a mask.
fn overlap(ours: &Picture, truth: &Picture, mask: &[bool]) -> f64 {
    let dark = |shadow: &[f32]| -> Vec<bool> { shadow.iter().zip(mask).map(|(s, on)| *on && *s > 0.5).collect() };
    value(metrics::iou(&dark(&ours.shadow[0]), &dark(&truth.shadow[0])))
}

/// Ids of the objects whose names contain a word.
fn named(scene: &Scene, word: &str) -> Vec<u32> {
    let found = scene.objects.iter().enumerate().filter(|(_, object)| object.name.contains(word));
    found.map(|(id, _)| id as u32).collect()
}

fn smile(cx: &Context) -> anyhow::Result<Made> {
    let stage = Stage::new(gallery::smile(), cx.pick(768, 256), 1)?;
    let picture = stage.shoot(cx, RECIPE, &Frame::default())?;
    let truth = stage.truth(cx, &Frame::default());
    let is_patches = |id: u32| matches!(stage.scene.objects[id as usize].shape, Shape::Patches(_));
    let receivers = of(&truth, |id| !is_patches(id));
    let open =
        stage.scene.objects.iter().filter(|object| matches!(object.shape, Shape::Patches(_)) && !object.solid).count();
    let dark = |id: u32| value(metrics::mean(&truth.shadow[0], &of(&truth, |object| object == id)));
    let shadowed = (0..stage.scene.objects.len() as u32).filter(|&id| !is_patches(id) && dark(id) > 0.02).count();
    Ok(Made {
        panels: vec![
            colour_panel("a-smile", "The smile and its shadow", picture.size, &picture.colour).against("truth"),
            shadow_panel("b-shadow", "The shadow alone", &picture),
            colour_panel("truth", "Ray-traced truth", truth.size, &truth.colour).role(Role::Truth),
            error_panel("error", "Shadow minus truth", picture.size, &picture.shadow[0], &truth.shadow[0]),
        ],
        measures: vec![
            Measure::at_least("objects of open patches", open as f64, "objects", 1.0),
            Measure::info("patches", patches(&stage.scene) as f64, "patches"),
            Measure::at_least(
                "receivers in shadow on more than a fiftieth of their pixels",
                shadowed as f64,
                "objects",
                2.0,
            ),
            Measure::at_least("overlap with truth's shadow", overlap(&picture, &truth, &receivers), "IoU", 0.95),
        ],
        note: stage.warnings(),
        ..Made::default()
    })
}

pub const F8: Figure = Figure {
    id: "W78-F8",
    paper: Paper::Williams78,
    title: "The robot",
    claim: "More than 350 bicubic patches cast one continuous shadow over floor and wall.",
    look: "the one shadow that runs without a break from the floor up the wall.",
    make: robot,
};

/// Pixels of `upper` and `lower` on both sides of the line where they meet, column by column.
fn seam(seen: &Picture, upper: &[u32], lower: &[u32]) -> Vec<(usize, usize)> {
    let (width, height) = (seen.size.x as usize, seen.size.y as usize);
    let whole = |i: usize, ids: &[u32]| seen.share[i] == 1.0 && ids.contains(&seen.object[i]);
    let column = |x: usize| {
        let above = (0..height - 3).map(|y| y * width + x).filter(|&i| whole(i, upper));
        above.map(|i| (i, (1..4).map(|dy| i + dy * width).find(|&j| whole(j, lower)))).find_map(|(i, j)| Some((i, j?)))
    };
    (0..width).filter_map(column).collect()
}

/// How far the shadow's edges stand from truth's within six rows of a seam, rms pixels. A shadow that broke off there would be off on one
/// side.
fn off_at_seam(ours: &Picture, truth: &Picture, seam: &[(usize, usize)]) -> Option<f64> {
    const ROWS: usize = 6;
    let width = ours.size.x as usize;
    let (first, last) = (seam.iter().map(|pair| pair.0 / width).min()?, seam.iter().map(|pair| pair.1 / width).max()?);
    let from = first.saturating_sub(ROWS);
    let rows = (last + ROWS).min(ours.size.y as usize) - from;
    let strip = |picture: &Picture| shadow_grid(picture).window(0, from, width, rows);
    let (ours, exact) = (strip(ours), strip(truth));
    metrics::contour_deviation(Grid::new(&ours, width), Grid::new(&exact, width), ROWS as f64).map(|found| found.rms)
}

fn robot(cx: &Context) -> anyhow::Result<Made> {
    let stage = Stage::new(gallery::robot(), cx.pick(768, 256), 1)?;
    let scene = &stage.scene;
    let picture = stage.shoot(cx, RECIPE, &Frame::default())?;
    let truth = stage.truth(cx, &Frame::default());
    let (wall, floor) = (named(scene, "wall"), named(scene, "floor"));
    let on = |ids: &[u32]| of(&truth, |id| ids.contains(&id));
    let share = |ids: &[u32]| value(metrics::mean(&picture.shadow[0], &on(ids)));
    let receivers: Vec<u32> = wall.iter().chain(&floor).copied().collect();
    let (post, fragments, complexity) = transforms(cx, &stage)?;
    Ok(Made {
        panels: vec![
            colour_panel("robot", "The robot before a wall", picture.size, &picture.colour)
                .with("patches", patches(scene))
                .against("truth"),
            shadow_panel("shadow", "The shadow alone", &picture),
            colour_panel("truth", "Ray-traced truth", truth.size, &truth.colour).role(Role::Truth),
            error_panel("error", "Shadow minus truth", picture.size, &picture.shadow[0], &truth.shadow[0]),
        ],
        measures: vec![
            Measure::at_least("bicubic patches", patches(scene) as f64, "patches", 351.0),
            Measure::at_least("wall in shadow", share(&wall), "share of its pixels", 0.02),
            Measure::at_least("floor in shadow", share(&floor), "share of its pixels", 0.02),
            Measure::at_least(
                "overlap with truth's shadow on both",
                overlap(&picture, &truth, &on(&receivers)),
                "IoU",
                0.95,
            ),
            Measure::at_most(
                "edges against truth's about the seam between wall and floor",
                value(off_at_seam(&picture, &truth, &seam(&truth, &wall, &floor))),
                "px rms",
                1.5,
            ),
            Measure::exactly("post-process: transforms less visible pixels", post, "points", 0.0),
            Measure::within(
                "transforms point by point over those afterwards, over the depth complexity",
                fragments / complexity,
                "ratio",
                0.99,
                1.01,
            ),
        ],
        note: stage.warnings(),
        ..Made::default()
    })
}

/// Transforms of the post-process less visible pixels; transforms point by point over those; layers over a visible pixel, counted by
/// a depth pass from the camera.
fn transforms(cx: &Context, stage: &Stage) -> anyhow::Result<(f64, f64, f64)> {
    let scene = &stage.scene;
    let seen = picture(scene, &[&Unshadowed], &Frame::CENTRES);
    let visible = seen.depth.iter().filter(|zeta| zeta.is_finite()).count() as f64;
    let map = stage.maps[0].clone().ok_or_else(|| anyhow::anyhow!("the light has no map"))?;
    let light = ShadowMap { filter: presets::williams78().filter, map };
    let afterwards = shadow_image(&seen.depth, &scene.camera, Some(16), &light, Key::new(cx.seed, 0, 0));
    let camera = scene.camera.with_kind(Kind::Axial);
    let layers = bake(&camera, Soup::all(scene, &camera).triangles(), &First, Cull::None).fragments as f64;
    let after = afterwards.transforms as f64;
    Ok((after - visible, seen.fragments as f64 / after, layers / visible))
}

pub const COST: Figure = Figure {
    id: "W78-cost",
    paper: Paper::Williams78,
    title: "What it costs",
    claim: "The work grows linearly with the scene's complexity; the post-process transforms a fixed number of points.",
    look: "the lines of the plot: the work in the two views rises with the scene, the work in the post-process does not.",
    make: cost,
};

/// `count` balls of one size at random before a wall that fills the picture.
fn balls(count: u32, pixels: u32) -> anyhow::Result<Scene> {
    let key = Key::new(78, 0, 0);
    let wall = Mesh::cuboid(Vec3::new(-90.0, -90.0, -24.0), Vec3::new(90.0, 90.0, -20.0));
    let mut objects = vec![Object::solid("wall", wall, Material::matt(Vec3::splat(0.5)))];
    for ball in 0..count {
        let at = Vec3::new(key.signed(ball, 0) * 30.0, key.signed(ball, 1) * 30.0, key.signed(ball, 2) * 12.0);
        objects.push(Object::solid("ball", Mesh::sphere(at, 4.0, 48), Material::plastic(Vec3::new(0.7, 0.3, 0.2))));
    }
    let size = UVec2::splat(pixels);
    let camera = View::perspective(DVec3::Z * 110.0, DVec3::ZERO, DVec3::Y, 0.6, 20.0, 250.0, size)?;
    let mut sun = Light::directional("sun", DVec3::new(-0.5, 0.4, 1.0), DVec3::ZERO, 60.0, 10.0, 260.0, size)?;
    sun.view = sun.view.with_kind(Kind::Screen);
    let (ambient, background) = (Vec3::splat(0.1), Vec3::ZERO);
    Ok(Scene { name: "balls".into(), origin: DVec3::ZERO, objects, lights: vec![sun], ambient, background, camera })
}

fn cost(cx: &Context) -> anyhow::Result<Made> {
    let pixels = cx.pick(512, 192);
    let counts: Vec<u32> = (0..=cx.pick(6, 4)).map(|step| 8 << step).collect();
    let (mut work, mut transforms, mut triangles) = (Vec::new(), Vec::new(), Vec::new());
    let (mut plain_times, mut pass1_times, mut post_times) = (Vec::new(), Vec::new(), Vec::new());
    let mut made = Made::default();
    for &count in &counts {
        let scene = balls(count, pixels)?;
        let start = Instant::now();
        let seen = picture(&scene, &[&Unshadowed], &Frame::CENTRES);
        let plain = start.elapsed().as_secs_f64();
        let view = &scene.lights[0].view;
        let start = Instant::now();
        let soup = Soup::casters(&scene, view);
        let baked = bake(view, soup.triangles(), &First, Cull::None);
        let pass1 = start.elapsed().as_secs_f64();
        let light = ShadowMap { filter: presets::williams78().filter, map: baked.map };
        let start = Instant::now();
        let image = shadow_image(&seen.depth, &scene.camera, Some(16), &light, Key::new(cx.seed, 0, 0));
        let post = start.elapsed().as_secs_f64();
        let primitives = soup.len() as f64;
        triangles.push(primitives);
        work.push((f64::from(count), (seen.fragments + baked.fragments) as f64));
        transforms.push(image.transforms);
        for (name, times, seconds) in [
            ("plain", &mut plain_times, plain),
            ("pass 1", &mut pass1_times, pass1),
            ("post-process", &mut post_times, post),
        ] {
            made.timings.push((format!("{name}, {count} balls"), seconds));
            times.push((primitives, 1e3 * seconds));
        }
    }
    // The wall's own fragments are the same for all.
    let bare = balls(0, pixels)?;
    let view = &bare.lights[0].view;
    let wall = bake(view, Soup::casters(&bare, view).triangles(), &First, Cull::None).fragments;
    let base = (picture(&bare, &[&Unshadowed], &Frame::CENTRES).fragments + wall) as f64;
    let grown: Vec<(f64, f64)> = work.iter().map(|&(count, fragments)| (count, fragments - base)).collect();
    let slope = value(metrics::log_log_fit(&grown).map(|fit| fit.slope));
    let spread =
        transforms.iter().max().zip(transforms.iter().min()).map_or(f64::NAN, |(most, least)| (most - least) as f64);
    made.measures = vec![
        Measure::within("fragments of both views against the number of balls: log-log slope", slope, "", 0.8, 1.2),
        Measure::info("triangles of the largest scene", triangles[triangles.len() - 1], "triangles"),
        Measure::exactly("post-process: transforms, most less least", spread, "points", 0.0),
        Measure::exactly(
            "the same for each pixel of the picture",
            transforms[0] as f64 / f64::from(pixels * pixels),
            "points",
            1.0,
        ),
    ];
    let power = metrics::log_log_fit(&pass1_times).map_or(f64::NAN, |fit| fit.slope);
    let cheaper = pass1_times.iter().zip(&plain_times).all(|(pass1, plain)| pass1.1 < plain.1);
    let sums: Vec<(f64, f64)> = plain_times.iter().zip(&pass1_times).map(|(a, b)| (a.0, a.1 + b.1)).collect();
    let whole = metrics::log_log_fit(&sums).map_or(f64::NAN, |fit| fit.slope);
    // Seconds stay out of the report, and yes or no out of quick runs, where they are a matter of chance.
    if !cx.quick {
        for (what, yes) in [
            ("time of pass 1 grows by a power from .8 to 1.2", (0.8..=1.2).contains(&power)),
            ("time of picture and pass 1 does", (0.8..=1.2).contains(&whole)),
            ("pass 1 takes less than the picture", cheaper),
        ] {
            made.measures.push(Measure::yes(what, yes));
        }
        made.caveat = Some(
            "Pass 1 and the fragments of both views grow linearly; the time of the picture itself does not yet, because shading its \
             pixels costs the same for 8 balls as for 512 and takes most of it."
                .into(),
        );
    }
    let plot =
        Plot::new("Time against complexity (this run, all cores)", Axis::log("triangles"), Axis::log("milliseconds"))
            .add(Series::line("picture without shadow", plain_times))
            .add(Series::line("pass 1", pass1_times))
            .add(Series::line("post-process", post_times));
    made.plots.push(("cost".into(), plot.svg()));
    made.note = "The times of this run are in the plot and in timings.json. The time of the picture itself grows more slowly at first, \
                 because shading its pixels costs the same however many balls there are."
        .into();
    Ok(made)
}

pub const PLANE: Figure = Figure {
    id: "W78-plane",
    paper: Paper::Williams78,
    title: "Projection onto the ground",
    claim: "The cheaper method casts the same shadow on its one plane, and none on anything else.",
    look: "the ground, where projection and depth map agree, and the other surfaces, on which projection casts nothing.",
    make: plane,
};

fn plane(cx: &Context) -> anyhow::Result<Made> {
    let stage = Stage::new(gallery::teapot(), cx.pick(512, 192), 1)?;
    let scene = &stage.scene;
    let slab = named(scene, "slab")[0];
    let light = scene.lights[0].view;
    let ground = Ground { centre: DVec3::ZERO, normal: DVec3::Y, half_side: 165.0 };
    let planar = Planar::new(scene, &light, ground, slab, cx.pick(4096, 2048))?;
    let flat = stage.draw(cx, &[Box::new(planar)], &Frame::default());
    let mapped = stage.shoot(cx, RECIPE, &Frame::default())?;
    let truth = stage.truth(cx, &Frame::default());
    // Outside the lamp's cone it is dark anyway, and the projection takes no account of cones.
    let lit = |i: usize| scene.lights[0].incident(truth.position[i]).1 != Vec3::ZERO;
    let on_slab = of(&truth, |id| id == slab);
    let mask: Vec<bool> = (0..on_slab.len()).map(|i| on_slab[i] && lit(i)).collect();
    let elsewhere = of(&truth, |id| id != slab);
    Ok(Made {
        panels: vec![
            colour_panel("planar", "Projected onto the ground", flat.size, &flat.colour).against("truth"),
            colour_panel("mapped", "By a depth map", mapped.size, &mapped.colour).against("truth"),
            colour_panel("truth", "Ray-traced truth", truth.size, &truth.colour).role(Role::Truth),
            error_panel("error", "Projection minus truth", truth.size, &flat.shadow[0], &truth.shadow[0]),
        ],
        measures: vec![
            Measure::at_least(
                "overlap with the depth map's shadow on the ground",
                overlap(&flat, &mapped, &mask),
                "IoU",
                0.97,
            ),
            Measure::at_least("overlap with truth's", overlap(&flat, &truth, &mask), "IoU", 0.97),
            Measure::exactly("shadow elsewhere", value(metrics::mean(&flat.shadow[0], &elsewhere)), "share", 0.0),
            Measure::at_least(
                "the depth map's shadow there",
                value(metrics::mean(&mapped.shadow[0], &elsewhere)),
                "share",
                0.05,
            ),
        ],
        note: stage.warnings(),
        ..Made::default()
    })
}
