//! Woo 1992, Figure 1: a row of a map, and the midpoint between the two nearest surfaces.

use crate::figure::{Context, Figure, Paper};
use glam::{DVec2, DVec3, IVec2, UVec2};
use std::sync::Arc;
use umbrage_bake::bake;
use umbrage_depth::{DepthMap, First, Midpoint, Tiled};
use umbrage_plane::{Bias, SurfacePoint};
use umbrage_raster::Cull;
use umbrage_recipe::bind;
use umbrage_render::Soup;
use umbrage_report::plot::{Axis, Plot, Series};
use umbrage_report::{Made, Measure};
use umbrage_sample::Key;
use umbrage_scene::gallery;
use umbrage_shadow::presets;

pub const F1: Figure = Figure {
    id: "W92-F1",
    paper: Paper::Woo92,
    title: "Why a nearest depth shadows its own surface, and a midpoint does not",
    claim: "Between two samples a surface lies behind the nearer one; halfway to the next surface there is nothing to shadow.",
    look: "the stretches where the surface lies behind the nearest depths; it nowhere lies behind the midpoints.",
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
    let at_columns = |map: &Arc<Tiled>| -> Vec<(f64, f64)> {
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
    let ask =
        |map: &Arc<Tiled>| f64::from(bind(presets::ordinary(Bias::ZERO).filter, map, cx.storage).fraction(&point, key));
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
        note: "Stored values that are too near, not too far, make a surface shadow itself; the paper's text says the opposite.".into(),
        ..Made::default()
    })
}
