//! Woo 1992: the midpoint between the two nearest surfaces, the rule of the cone, whole units first.

use super::sphere_plane::false_shadow;
use super::studio::{Set, acne, error_panel, leak, points_of, shadow_panel, truth_panel, zoomed};
use crate::figure::{Context, Figure, Made, Measure, Panel, Paper};
use crate::plot::{Axis, Plot, Series};
use glam::{DVec2, DVec3, IVec2, UVec2, Vec3};
use std::f64::consts::PI;
use std::time::Instant;
use umbrage_depth::{DepthMap, First, Midpoint, Raw, Tiled};
use umbrage_plane::{Bias, Rules, SurfacePoint, View};
use umbrage_raster::Cull;
use umbrage_render::{Frame, Picture, Soup, bake, bind};
use umbrage_sample::{Jittered, Key};
use umbrage_scene::tree::{Cone, Tree};
use umbrage_scene::{Light, Material, Mesh, Object, Scene, gallery};
use umbrage_shadow::{Counters, IntegerFirst, Pcf, Shadow, ShadowMap, behind, presets};

/// The paper's old algorithm, and its own.
const OLD: &str = "reeves87,bias=0.2..0.4";
const NEW: &str = "woo92";

pub const F1: Figure = Figure {
    id: "W92-F1",
    paper: Paper::Woo92,
    title: "Why a nearest depth shadows itself, and a midpoint does not",
    claim: "A surface between two samples lies behind the nearer one; halfway to the next surface nothing lies.",
    make: profile,
};

/// Columns of the profile and how finely the true surface is drawn between their samples.
const COLUMNS: i32 = 14;
const FINE: u32 = 32;

fn profile(cx: &Context) -> anyhow::Result<Made> {
    let scene = gallery::sphere_plane();
    let view = scene.lights[0].view.with_size(UVec2::splat(64))?;
    let soup = Soup::casters(&scene, &view);
    let first = bake(&view, soup.triangles(), &First, Cull::None).map;
    let middle = bake(&view, soup.triangles(), &Midpoint::default(), Cull::None).map;
    let fine_view = view.with_size(view.size() * UVec2::new(FINE, 1))?;
    let fine = bake(&fine_view, Soup::casters(&scene, &fine_view).triangles(), &First, Cull::None).map;
    // The row of samples through the sphere's middle, about its lit limb and the slab beside it.
    let sphere = view.eye_to_texel(view.world_to_eye().transform_point3(DVec3::new(0.0, 0.0, 25.0)));
    let row = sphere.y.floor() as i32;
    let start = sphere.x.floor() as i32 - COLUMNS + 3;
    let surface = |at: f64| f64::from(fine.depth(IVec2::new((at * f64::from(FINE)) as i32, row)));
    let at_columns = |map: &Tiled| -> Vec<(f64, f64)> {
        let columns = start..start + COLUMNS;
        columns
            .flat_map(|x| {
                let depth = f64::from(map.depth(IVec2::new(x, row)));
                [(f64::from(x), depth), (f64::from(x) + 1.0, depth)]
            })
            .collect()
    };
    let places = (0..COLUMNS * FINE as i32).map(|i| f64::from(start) + (f64::from(i) + 0.5) / f64::from(FINE));
    let true_surface: Vec<(f64, f64)> = places.map(|at| (at, surface(at))).collect();
    // The point (*): where the surface lies deepest behind the depth stored for its own column, on the curved part.
    let behind_stored = |at: f64| surface(at) - f64::from(first.depth(IVec2::new(at.floor() as i32, row)));
    let starred = true_surface
        .iter()
        .map(|&(at, _)| at)
        .filter(|&at| at > f64::from(start + 5) && (1e-4..1.0).contains(&behind_stored(at)))
        .max_by(|a, b| behind_stored(*a).total_cmp(&behind_stored(*b)))
        .ok_or_else(|| anyhow::anyhow!("no point of the profile lies behind its sample"))?;
    let world = view.world_at(DVec2::new(starred, f64::from(row) + 0.5), -1.0 / surface(starred)).as_vec3();
    let point = SurfacePoint::at(world, view.toward_eye(world.as_dvec3()).as_vec3());
    let key = Key::new(cx.seed, 0, 0);
    let ask = |map: &Tiled| f64::from(bind(presets::ordinary(Bias::ZERO), map, cx.storage).fraction(&point, key));
    let plot = Plot::new(
        "One row of a 64² map",
        Axis::linear("texel column"),
        Axis::linear("distance from the light, world units"),
    )
    .add(Series::line("nearest surface", true_surface))
    .add(Series::line("stored by the old rule", at_columns(&first)))
    .add(Series::line("midpoint", at_columns(&middle)))
    .add(Series::dots("the point (*)", vec![(starred, surface(starred))]));
    // E-W1: noted, not reproduced.
    Ok(Made {
        plots: vec![("profile".into(), plot.svg())],
        measures: vec![
            Measure::exactly("(*) under the nearest depth, bias 0", ask(&first), "shadow", 1.0),
            Measure::exactly("(*) under the midpoint, no bias", ask(&middle), "shadow", 0.0),
            Measure::at_least("(*) behind its own stored depth", behind_stored(starred), "world units", 1e-4),
            Measure::info("(*) before the midpoint", f64::from(middle.depth(IVec2::new(starred as i32, row))) - surface(starred), "world units"),
        ],
        note: "Stored values that are too near, not too far, make a surface shadow itself; the paper's prose has it the other way round.".into(),
        ..Made::default()
    })
}

/// The room and the sphere before its slab, each at 256², with what the old rule and the new make of them.
struct Pair {
    room: Set,
    slab: Set,
}

impl Pair {
    fn new(cx: &Context) -> Self {
        let pixels = cx.pick(512, 256);
        Self { room: Set::new(gallery::spot_room(), pixels, 256), slab: Set::new(gallery::sphere_plane(), pixels, 256) }
    }
}

/// Border of the masks, in pixels: a region of ResFactor 3 and two texels of a 256² map.
fn border(cx: &Context) -> usize {
    cx.pick(12, 6)
}

pub const F2: Figure = Figure {
    id: "W92-F2",
    paper: Paper::Woo92,
    title: "A 256² map under a 75° spot, biases of .2 to .4",
    claim: "The old algorithm leaves surfaces noisy at this size.",
    make: old,
};

fn old(cx: &Context) -> anyhow::Result<Made> {
    let Pair { room, slab } = Pair::new(cx);
    let (by_old, by_new) = (room.by(cx, OLD, &Frame::CENTRES)?, room.by(cx, NEW, &Frame::CENTRES)?);
    let (points, truth) = (room.truth_points(cx, &Frame::CENTRES), room.truth(cx));
    let (old, new) = (acne(&by_old, &points, border(cx), |_| true), acne(&by_new, &points, border(cx), |_| true));
    let slab_points = slab.truth_points(cx, &Frame::CENTRES);
    let on_slab = |recipe: &str| -> anyhow::Result<(f64, f64)> {
        Ok(false_shadow(&slab.by(cx, recipe, &Frame::CENTRES)?, &slab_points, border(cx)))
    };
    let (slab_old, slab_new) = (on_slab(OLD)?, on_slab(NEW)?);
    Ok(Made {
        panels: vec![
            Panel::rgb("full", "Old algorithm", by_old.size, by_old.colour.clone())
                .with("map", "256²")
                .with("bias", "0.2–0.4"),
            shadow_panel("shadow", "Its shadow alone", &by_old).against("truth"),
            truth_panel(&truth),
            error_panel("error", "Less truth", truth.size, &by_old.shadow[0], &truth.shadow[0]),
        ],
        measures: vec![
            Measure::info("room: false shadow (M2)", old, "share"),
            Measure::at_least("the same over that of W92-F3", old / new, "ratio", 5.0),
            Measure::info("slab of SC-B: false shadow", slab_old.0, "share"),
            Measure::info("sphere of SC-B: false shadow", slab_old.1, "share"),
            Measure::at_least(
                "slab: that less five times that of midpoints",
                slab_old.0 - 5.0 * slab_new.0,
                "share",
                1e-4,
            ),
            Measure::at_least(
                "sphere: that less five times that of midpoints",
                slab_old.1 - 5.0 * slab_new.1,
                "share",
                1e-4,
            ),
        ],
        ..Made::default()
    })
}

pub const F3: Figure = Figure {
    id: "W92-F3",
    paper: Paper::Woo92,
    title: "The same by midpoints, without a bias",
    claim: "Clean at 256², and cleaner than the old algorithm at 1024².",
    make: midpoints,
};

fn midpoints(cx: &Context) -> anyhow::Result<Made> {
    let Pair { room, slab } = Pair::new(cx);
    let (points, truth) = (room.truth_points(cx, &Frame::CENTRES), room.truth(cx));
    let by_new = room.by(cx, NEW, &Frame::CENTRES)?;
    let by_old = room.by(cx, OLD, &Frame::CENTRES)?;
    let large = Set::new(gallery::spot_room(), cx.pick(512, 256), 1024).by(cx, OLD, &Frame::CENTRES)?;
    let m2 = |picture: &Picture| acne(picture, &points, border(cx), |_| true);
    let m8 = |picture: &Picture| leak(picture, &points, 0);
    let slab_points = slab.truth_points(cx, &Frame::CENTRES);
    let on_slab = false_shadow(&slab.by(cx, NEW, &Frame::CENTRES)?, &slab_points, border(cx));
    let mut made = Made {
        panels: vec![
            Panel::rgb("full", "Midpoints", by_new.size, by_new.colour.clone())
                .with("map", "256²")
                .with("bias", "none"),
            shadow_panel("shadow", "Its shadow alone", &by_new).against("truth"),
            truth_panel(&truth),
            error_panel("error", "Less truth", truth.size, &by_new.shadow[0], &truth.shadow[0]),
        ],
        measures: vec![
            Measure::at_most("room: false shadow away from silhouettes (M2)", m2(&by_new), "share", 0.005),
            Measure::info("room: old algorithm at 256²", m2(&by_old), "share"),
            Measure::at_most("less the old algorithm's at 1024²", m2(&by_new) - m2(&large), "share", -1e-4),
            Measure::at_most("room: leak beyond the old algorithm's (M8)", m8(&by_new) - m8(&by_old), "share", 0.005),
            Measure::at_most("slab of SC-B: false shadow", on_slab.0, "share", 0.005),
            Measure::at_most("sphere of SC-B: false shadow", on_slab.1, "share", 0.005),
        ],
        ..Made::default()
    };
    let (seen, false_new, false_old) = thin(cx)?;
    let caption = "Where it fails: a slab thinner than a texel's depth step";
    made.panels.push(shadow_panel("thin", caption, &seen).with("map", "256²").with("thickness", "0.4"));
    made.measures.push(Measure::at_least("thin slab: false shadow of midpoints", false_new, "share", 0.02));
    made.measures.push(Measure::info("thin slab: the old algorithm with a bias of 3 to 4 texels", false_old, "share"));
    made.note = "The midpoint fails where two surfaces are so near to each other that half their distance is less than a texel's depth step: the \
                 thin slab shadows itself in stripes."
        .into();
    Ok(made)
}

/// A slab .4 thick on which depth changes by more than half of that from texel to texel: the picture, and false shadow on the slab by
/// midpoints and by the old algorithm.
fn thin(cx: &Context) -> anyhow::Result<(Picture, f64, f64)> {
    const SLAB: u32 = 0;
    let set = Set::new(gallery::thin_slab(), cx.pick(512, 256), 256);
    let points = set.truth_points(cx, &Frame::CENTRES);
    let (new, old) = (set.by(cx, NEW, &Frame::CENTRES)?, set.by(cx, "reeves87,bias=3..4t", &Frame::CENTRES)?);
    let on_slab = |picture: &Picture| acne(picture, &points, border(cx), |id| id == SLAB);
    let found = (on_slab(&new), on_slab(&old));
    Ok((new, found.0, found.1))
}

pub const RIM: Figure = Figure {
    id: "W92-rim",
    paper: Paper::Woo92,
    title: "Shadow that reaches the rim of a spot's cone",
    claim: "Samples outside the cone count as shadow; counted as lit they draw a bright line along the rim.",
    make: rim,
};

/// A floor under a spot that looks straight down, half of its cone covered by a board.
fn covered_spot(rules: Rules) -> anyhow::Result<Scene> {
    let light = Light::spot("spot", DVec3::new(0.0, 60.0, 0.0), DVec3::ZERO, 60.0, 5.0, 120.0, UVec2::splat(256))?;
    let view = light.view.with_rules(rules);
    let grey = Material::matt(Vec3::splat(0.7));
    Ok(Scene {
        name: format!("covered-spot {rules:?}"),
        origin: DVec3::ZERO,
        objects: vec![
            Object::solid("floor", Mesh::cuboid(Vec3::new(-60.0, -4.0, -60.0), Vec3::new(60.0, 0.0, 60.0)), grey),
            Object::solid("board", Mesh::cuboid(Vec3::new(2.0, 20.0, -40.0), Vec3::new(40.0, 22.0, 40.0)), grey),
        ],
        lights: vec![Light { view, ..light }],
        ambient: Vec3::ZERO,
        background: Vec3::ZERO,
        camera: View::perspective(
            DVec3::new(0.0, 15.0, 0.0),
            DVec3::new(20.0, 0.0, 0.0),
            DVec3::Z,
            100f64.to_radians(),
            1.0,
            200.0,
            UVec2::splat(512),
        )?,
    })
}

fn rim(cx: &Context) -> anyhow::Result<Made> {
    let mut made = Made::default();
    let listing = Rules { outside: Rules::OPEN.outside, beyond_cone: Rules::OPEN.beyond_cone, ..Rules::SPOT };
    let mut across = Plot::new(
        "Light along a radius that nothing shadows, outside is dark",
        Axis::linear("texels outward from the rim"),
        Axis::linear("light arriving, share"),
    );
    let mut plot = Plot::new(
        "Light along a radius, in the board's shadow",
        Axis::linear("texels outward from the rim"),
        Axis::linear("light arriving, share"),
    );
    let mut ridges = Vec::new();
    for (name, caption, rules) in
        [("listing", "Outside is lit (Reeves)", listing), ("woo", "Outside is dark (Woo)", Rules::SPOT)]
    {
        let set = Set::new(covered_spot(rules)?, cx.pick(512, 256), 256);
        let picture = set.by(cx, "woo92,res-factor=3,min-size=3,samples=256", &Frame::CENTRES)?;
        made.panels.push(shadow_panel(&format!("{name}-shadow"), &format!("{caption}: shadow alone"), &picture));
        made.panels.push(Panel::rgb(name, caption, picture.size, picture.colour.clone()));
        made.panels.push(zoomed(
            &format!("{name}-zoom"),
            &format!("{caption}, enlarged"),
            &picture,
            DVec2::new(0.40, 0.5),
            8,
        ));
        let light = &set.scene.lights[0];
        let pattern = Jittered { num_samples: 256, ..Jittered::default() };
        let shadow = bind(Pcf { pattern, min_size: 3.0, ..presets::woo92() }, middle_map(&set), cx.storage);
        let profile = radial(cx, light, &*shadow, 0.0);
        let peak = profile.iter().map(|p| p.1).fold(0.0, f64::max);
        let ends = profile[0].1.max(profile[profile.len() - 1].1);
        ridges.push(peak - ends);
        if name == "woo" {
            let rises = |profile: &[(f64, f64)]| profile.windows(2).filter(|pair| pair[1].1 > pair[0].1 + 1e-3).count();
            // On the other side nothing stands in the light: across a hard rim, and across a soft one.
            let soft = Cone { inner_deg: 22.0, outer_deg: 30.0 };
            let tree = Tree::Product(vec![Tree::Cone(soft), Tree::Shadow { recipe: String::new() }]);
            let sides = [
                ("in shadow", profile.clone()),
                ("in light, hard rim", radial(cx, light, &*shadow, PI)),
                ("in light, soft rim", radial(cx, &light.clone().with_tree(tree), &*shadow, PI)),
            ];
            for (side, profile) in sides {
                let name = format!("Woo, {side}: steps at which light rises outward");
                made.measures.push(Measure::exactly(&name, rises(&profile) as f64, "", 0.0));
                if side != "in shadow" {
                    across = across.add(Series::line(side, profile));
                }
            }
        }
        plot = plot.add(Series::line(caption, profile));
    }
    made.measures.insert(0, Measure::at_least("ridge where outside is lit", ridges[0], "share of the light", 0.05));
    made.measures.insert(1, Measure::at_most("ridge where outside is dark", ridges[1], "share of the light", 1e-9));
    made.plots.push(("rim".into(), plot.svg()));
    made.plots.push(("rim-in-light".into(), across.svg()));
    made.note = "The rim is the cone's circle, not the map's square around it, and never the box around the finite depths: with midpoints most \
                 of a lit map is empty."
        .into();
    Ok(made)
}

/// Light on the floor along a radius about the direction `angle`, from within the rim outward: texels from the rim and light, averaged over a
/// fan of directions.
fn radial(cx: &Context, light: &Light, shadow: &dyn Shadow, angle: f64) -> Vec<(f64, f64)> {
    let radius = 60.0 * 30f64.to_radians().tan();
    let texel = light.view.texel_world(60.0).x;
    let key = Key::new(cx.seed, 0, 0);
    let at_step = |step: i32| {
        let from_rim = f64::from(step) * 0.5;
        let fan = -40..=40;
        let count = f64::from(fan.clone().count() as u32);
        let sum: f64 = fan
            .map(|spoke| {
                let way = DVec2::from_angle(angle + f64::from(spoke) * 0.01);
                let at = way * (radius + from_rim * texel);
                let place = DVec3::new(at.x, 0.0, at.y);
                let region = (step + 100) as u32 * 100 + (spoke + 50) as u32;
                let point = SurfacePoint { region, ..SurfacePoint::at(place.as_vec3(), Vec3::Y) };
                let passes = 1.0 - shadow.fraction(&point, key);
                f64::from(light.arriving(place, Vec3::splat(passes)).1.x)
            })
            .sum();
        (from_rim, sum / count)
    };
    (-24..=16).map(at_step).collect()
}

fn middle_map(set: &Set) -> Tiled {
    let view = set.scene.lights[0].view;
    bake(&view, Soup::casters(&set.scene, &view).triangles(), &Midpoint::default(), Cull::None).map
}

pub const COST: Figure = Figure {
    id: "W92-cost",
    paper: Paper::Woo92,
    title: "Whole units first",
    claim: "Whole numbers settle most comparisons, with the same answers.",
    make: cost,
};

fn cost(cx: &Context) -> anyhow::Result<Made> {
    let Pair { room, .. } = Pair::new(cx);
    let map = middle_map(&room);
    let seen = room.truth_points(cx, &Frame::CENTRES);
    let points = points_of(&seen);
    let key = Key::new(cx.seed, 0, 0);
    let (mut by_float, mut by_whole) = (vec![0.0; points.len()], vec![0.0; points.len()]);
    let floats = ShadowMap { filter: presets::woo92(), map: map.clone() };
    let wholes = ShadowMap { filter: IntegerFirst::default(), map: map.clone() };
    let listing = ShadowMap { filter: presets::reeves87(), map: Raw::from(&map) };
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
        note: "On a processor of today floating point costs nothing more: times are in timings.json.".into(),
        timings,
        ..Made::default()
    })
}
