//! A map that is too large to keep in memory, looked up through a few pages (Reeves 1987, §3.3; R87-20).

use crate::figure::{Context, Figure, Paper};
use crate::stage::masks::value;
use crate::stage::panels::shadow_panel;
use glam::UVec2;
use std::sync::Arc;
use umbrage_bake::bake;
use umbrage_depth::{DepthMap, First, Tiled};
use umbrage_io::{Paged, write_shadow_map};
use umbrage_oracle::metrics;
use umbrage_plane::View;
use umbrage_raster::Cull;
use umbrage_render::{Frame, Picture, Soup, picture};
use umbrage_report::{Made, Measure, Table};
use umbrage_sample::Key;
use umbrage_scene::{Scene, gallery};
use umbrage_shadow::{Shadow, ShadowMap, presets};

pub const PAGING: Figure = Figure {
    id: "U-paging",
    paper: Paper::Umbrage,
    title: "A depth map of 16,384² through a few pages",
    claim: "The order in which a camera looks texels up is local: a few pages of a map on disk serve a whole picture, and change no bit of it.",
    look: "the table of pages read, by the order in which the picture is drawn.",
    make: paging,
};

/// A file that is removed when it is no longer needed.
struct Temporary(std::path::PathBuf);

impl Drop for Temporary {
    fn drop(&mut self) {
        // A file left behind in the system's temporary folder does not make the figure wrong.
        let _ = std::fs::remove_file(&self.0);
    }
}

/// The sphere before the plane, which is left out of the map.
fn scene(pixels: u32) -> anyhow::Result<Scene> {
    let mut scene = gallery::sphere_plane();
    scene.objects[1].casts = false;
    scene.camera = scene.camera.with_size(UVec2::splat(pixels))?;
    Ok(scene)
}

/// A map of light 0 on disk, and as it was in memory.
fn written(scene: &Scene, view: &View) -> anyhow::Result<(Temporary, Arc<Tiled>)> {
    let map = bake(view, Soup::casters(scene, view).triangles(), &First, Cull::None).map;
    let name = format!("umbrage-paging-{}-{}.exr", std::process::id(), view.size().x);
    let file = Temporary(std::env::temp_dir().join(name));
    write_shadow_map(&file.0, &map)?;
    Ok((file, map))
}

/// Tiles read for look-ups at the given texel positions in this order, through so many pages.
fn faults(path: &std::path::Path, pages: usize, order: &[glam::IVec2]) -> anyhow::Result<u64> {
    let (map, handle) = Paged::open(path, pages)?;
    for texel in order {
        map.depth(*texel);
    }
    anyhow::ensure!(handle.error().is_none(), "{}", handle.error().map(ToString::to_string).unwrap_or_default());
    Ok(handle.faults())
}

/// The texels that the camera's pixels look up: by scan lines, by buckets of 16 × 16, at random.
fn orders(seen: &Picture, view: &View, key: Key) -> [Vec<glam::IVec2>; 3] {
    let width = seen.size.x as usize;
    let texel = |i: usize| {
        let eye = view.world_to_eye().transform_point3(seen.position[i]);
        view.eye_to_texel(eye).floor().as_ivec2()
    };
    let lines: Vec<usize> = (0..seen.depth.len()).filter(|&i| seen.depth[i].is_finite()).collect();
    let mut buckets = lines.clone();
    buckets.sort_by_key(|&i| (i / width / 16, i % width / 16, i));
    let mut random = lines.clone();
    random.sort_by_key(|&i| key.bits(i as u32, 0));
    [lines, buckets, random].map(|order| order.into_iter().map(texel).collect())
}

fn paging(cx: &Context) -> anyhow::Result<Made> {
    let (pixels, texels) = (cx.pick(512, 192), cx.pick(16_384, 2048));
    let scene = scene(pixels)?;
    let (file, map) = written(&scene, &scene.lights[0].view.with_size(UVec2::splat(texels))?)?;
    let filter = presets::reeves87().filter.with_cull(false);
    let frame = Frame { seed: cx.seed, ..Frame::CENTRES };
    let draw = |shadow: &dyn Shadow| picture(&scene, &[shadow], &frame);
    let whole = draw(&ShadowMap { filter, map: map.clone() });
    let (paged, handle) = Paged::open(&file.0, 64)?;
    let through = draw(&ShadowMap { filter, map: paged });
    anyhow::ensure!(handle.error().is_none(), "{}", handle.error().map(ToString::to_string).unwrap_or_default());
    let differing =
        (0..whole.depth.len()).filter(|&i| whole.shadow[0][i].to_bits() != through.shadow[0][i].to_bits()).count();
    // Locality is a matter of a map as fine as the picture (R87-6), all of it in use.
    let near = scene.framed(&scene.lights[0])?.view.with_size(UVec2::splat(2 * pixels))?;
    let (near_file, _) = written(&scene, &near)?;
    let orders = orders(&whole, &near, Key::new(cx.seed, 9, 0));
    let mut rows = Vec::new();
    let mut counted = Vec::new();
    for pages in [1, 4, 16, 64, 256] {
        let found = [
            faults(&near_file.0, pages, &orders[0])?,
            faults(&near_file.0, pages, &orders[1])?,
            faults(&near_file.0, pages, &orders[2])?,
        ];
        rows.push(std::iter::once(pages.to_string()).chain(found.iter().map(ToString::to_string)).collect());
        counted.push(found);
    }
    let head = ["pages of 64²", "scan lines", "buckets of 16²", "random"].map(String::from).to_vec();
    let dark = value(metrics::mean(&whole.shadow[0], &vec![true; whole.depth.len()]));
    let resident = handle.resident_pages() as f64 * 16.0 / 1024.0;
    Ok(Made {
        panels: vec![
            shadow_panel("paged", "Through 64 pages", &through).with("map", format!("{texels}²")),
            shadow_panel("whole", "The whole map in memory", &whole),
        ],
        tables: vec![Table { name: "faults".into(), head, rows }],
        measures: vec![
            Measure::exactly("pixels that differ by a bit", differing as f64, "px", 0.0),
            Measure::at_least("shadow in the picture", dark, "share", 0.05),
            Measure::at_most("pages in memory", resident, "MB", 1.0),
            Measure::info("the map as it would be raw", f64::from(texels).powi(2) * 4.0 / f64::from(1 << 20), "MB"),
            Measure::info("its tiles that hold a surface", map.bytes() as f64 / f64::from(1 << 20), "MB"),
            Measure::at_most(
                "4 pages: faults by buckets over those at random",
                counted[1][1] as f64 / counted[1][2] as f64,
                "ratio",
                0.5,
            ),
            Measure::at_most(
                "4 pages: faults by buckets over those by scan lines",
                counted[1][1] as f64 / counted[1][0] as f64,
                "ratio",
                1.0,
            ),
        ],
        ..Made::default()
    })
}
