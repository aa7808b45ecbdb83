//! Reeves, Salesin & Cook 1987, §3.2: a light in all directions, by a cube, by latitude and longitude, by sectors.

use crate::figure::{Context, Figure, Paper};
use crate::stage::masks::{of, shadow_grid, value};
use crate::stage::panels::{error_panel, shadow_panel, truth_panel};
use glam::{DVec3, UVec2, Vec3};
use std::sync::Arc;
use umbrage_bake::bake;
use umbrage_depth::{First, Raw, Tiled};
use umbrage_oracle::{Geometry, RayCast, metrics};
use umbrage_plane::{Rules, Sectors, View, cube_face, cube_views, sector_views};
use umbrage_raster::Cull;
use umbrage_render::{Frame, Picture, Soup, picture};
use umbrage_report::{Made, Measure, Panel, Role};
use umbrage_scene::{Light, Material, Mesh, Object, Scene};
use umbrage_shadow::{Around, Biased, Evaluate, LatLong, Pcf, Shadow};

pub const OMNI: Figure = Figure {
    id: "R87-omni",
    paper: Paper::Reeves87,
    title: "A light in all directions",
    claim: "A light inside the scene casts shadows in all directions, and no seam is visible.",
    look: "the lines where the faces of the cube meet: no edge runs along them.",
    make: omni,
};

const LAMP: DVec3 = DVec3::new(0.0, 18.0, 0.0);
const NEAR: f64 = 0.5;
const FAR: f64 = 200.0;

/// Sixteen posts in a ring about a lamp: those that stand over the seams of a cube map see what those between them see.
fn ring(pixels: u32) -> anyhow::Result<Scene> {
    let floor = Mesh::cuboid(Vec3::new(-44.0, -4.0, -44.0), Vec3::new(44.0, 0.0, 44.0));
    let mut objects = vec![Object::solid("floor", floor, Material::matt(Vec3::splat(0.5)))];
    for index in 0..16 {
        let (sin, cos) = (std::f32::consts::TAU * index as f32 / 16.0).sin_cos();
        let centre = Vec3::new(cos, 0.0, sin) * 20.0;
        let half = Vec3::new(1.5, 0.0, 1.5);
        let post = Mesh::cuboid(centre - half, centre + half + Vec3::Y * 8.0);
        objects.push(Object::solid("post", post, Material::plastic(Vec3::new(0.7, 0.45, 0.15))));
    }
    let camera = View::perspective(
        DVec3::new(0.0, 150.0, 0.0),
        DVec3::ZERO,
        DVec3::NEG_Z,
        33f64.to_radians(),
        50.0,
        300.0,
        UVec2::splat(pixels),
    )?;
    let [any, ..] = cube_views(LAMP, NEAR, FAR, 64)?;
    let mut lamp = Light::point("lamp", LAMP, LAMP - DVec3::Y, 90.0, NEAR, FAR, UVec2::splat(64))?;
    lamp.view = any.with_rules(Rules::OPEN);
    let (ambient, background) = (Vec3::splat(0.12), Vec3::splat(0.02));
    Ok(Scene { name: "ring".into(), origin: DVec3::ZERO, objects, lights: vec![lamp], ambient, background, camera })
}

fn maps(scene: &Scene, views: &[View]) -> Vec<Arc<Tiled>> {
    let map = |view: &View| bake(view, Soup::casters(scene, view).triangles(), &First, Cull::None).map;
    views.iter().map(map).collect()
}

/// Pairs of neighbouring floor pixels that two faces of the cube see, and all other pairs.
fn pairs(seen: &Picture) -> [Vec<(usize, usize)>; 2] {
    let face = |i: usize| cube_face(seen.position[i] - LAMP).0;
    let width = seen.size.x as usize;
    let floor = of(seen, |id| id == 0);
    let beside = |i: usize| [i + 1, i + width].into_iter().filter(|&j| j < floor.len() && floor[j]);
    let all = (0..floor.len()).filter(|&i| floor[i]).flat_map(|i| beside(i).map(move |j| (i, j)));
    let (over, within) = all.partition(|&(i, j)| face(i) != face(j));
    [over, within]
}

/// Mean step of a picture's error from one pixel of a pair to the other.
fn step(picture: &Picture, truth: &Picture, pairs: &[(usize, usize)]) -> f64 {
    let error = |i: usize| f64::from(picture.shadow[0][i] - truth.shadow[0][i]);
    pairs.iter().map(|&(i, j)| (error(i) - error(j)).abs()).sum::<f64>() / pairs.len() as f64
}

fn omni(cx: &Context) -> anyhow::Result<Made> {
    let scene = ring(cx.pick(512, 256))?;
    let side = cx.pick(1024, 512);
    let filter = Pcf::default().with_depth(Biased::world(0.8, 1.0)).with_res_factor(2.0);
    let faces = maps(&scene, &cube_views(LAMP, NEAR, FAR, side)?);
    let flat: Vec<Raw> = faces.iter().map(Raw::copy_of).collect();
    let lat_long = LatLong::from_maps(filter, &flat, UVec2::new(4 * side, 2 * side))?;
    let cut = Sectors { count: 6, margin: 0.03, tan_elevation: 1.6, size: UVec2::new(side, 2 * side) };
    let mut sectors = Around::new(filter, maps(&scene, &sector_views(LAMP, NEAR, FAR, &cut)?))?;
    let cube = Around::new(filter, faces)?;
    let frame = Frame { axis: 1, seed: cx.seed, ..Frame::CENTRES };
    let shoot = |shadow: &dyn Shadow, frame: &Frame| picture(&scene, &[shadow], frame);
    let by_cube = shoot(&cube, &frame);
    let by_lat_long = shoot(&lat_long, &frame);
    let by_own = shoot(&sectors, &frame);
    sectors.evaluate = Evaluate::Every;
    let by_every = shoot(&sectors, &frame);
    let geometry = Geometry::new(&scene, &scene.camera);
    let truth = shoot(&RayCast::everywhere(&geometry, LAMP.extend(1.0)), &Frame { axis: 4, ..frame });
    let [over, within] = pairs(&truth);
    let floor = of(&truth, |id| id == 0);
    // Belts end where the sectors' views end: beyond 1.6 of elevation, right under the lamp.
    let belt: Vec<bool> = (0..floor.len())
        .map(|i| {
            let at = truth.position[i] - LAMP;
            floor[i] && -at.y < 1.5 * at.x.hypot(at.z)
        })
        .collect();
    let differ = |a: &Picture, b: &Picture, mask: &[bool]| {
        (0..mask.len()).filter(|&i| mask[i] && (a.shadow[0][i] - b.shadow[0][i]).abs() > 0.5).count() as f64
    };
    // A texel of the cube at the ring's distance, in pixels of the floor.
    let pixel = scene.camera.texel_world(150.0).x;
    let texel = 2.0 * LAMP.y.hypot(20.0) / f64::from(side);
    let apart = |a: &Picture| {
        let found = metrics::contour_deviation(shadow_grid(a), shadow_grid(&by_cube), 4.0);
        value(found.map(|found| found.rms)) * pixel / texel.max(pixel)
    };
    Ok(Made {
        panels: vec![
            Panel::rgb("shaded", "Six faces of a cube, shaded", by_cube.size, by_cube.colour.clone())
                .with("maps", format!("6 × {side}²")),
            shadow_panel("cube", "Cube", &by_cube).with("MB", megabytes(cube.bytes())).against("truth"),
            shadow_panel("lat-long", "Latitude and longitude", &by_lat_long)
                .with("map", format!("{} × {}", 4 * side, 2 * side))
                .with("MB", megabytes(lat_long.bytes()))
                .against("truth"),
            shadow_panel("sectors", "Six sectors", &by_own).with("MB", megabytes(sectors.bytes())).against("truth"),
            truth_panel(&truth),
            error_panel("error", "Cube minus truth", truth.size, &by_cube.shadow[0], &truth.shadow[0]),
            Panel::grey("seams", "Where the cube's faces meet", truth.size, seam_picture(&by_cube)).role(Role::Map),
        ],
        measures: vec![
            Measure::info("step of the error between neighbouring pixels", step(&by_cube, &truth, &within), "share"),
            Measure::at_most(
                "the same across the cube's seams, over that",
                step(&by_cube, &truth, &over) / step(&by_cube, &truth, &within),
                "ratio",
                1.0,
            ),
            Measure::at_least("pairs of pixels across a seam", over.len() as f64, "pairs", 100.0),
            Measure::at_most("latitude and longitude: edges against the cube's", apart(&by_lat_long), "texels", 1.0),
            Measure::at_most("sectors: edges against the cube's", apart(&by_own), "texels", 1.0),
            Measure::exactly(
                "own sector against every sector: pixels that differ by more than ½",
                differ(&by_own, &by_every, &belt),
                "px",
                0.0,
            ),
        ],
        ..Made::default()
    })
}

fn megabytes(bytes: usize) -> String {
    format!("{:.1}", bytes as f64 / f64::from(1 << 20))
}

fn seam_picture(seen: &Picture) -> Vec<f32> {
    let mut grey: Vec<f32> = seen.shadow[0].iter().map(|shadow| 1.0 - 0.3 * shadow).collect();
    for (i, j) in &pairs(seen)[0] {
        (grey[*i], grey[*j]) = (0.0, 0.0);
    }
    grey
}
