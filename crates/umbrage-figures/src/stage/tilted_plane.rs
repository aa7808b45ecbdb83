//! An endless plane under a parallel light, tilted at will: where self-shadowing by a slope is measured.

use glam::{DVec3, UVec2, Vec3};
use std::sync::Arc;
use umbrage_bake::bake;
use umbrage_depth::{First, Tiled};
use umbrage_plane::View;
use umbrage_raster::{Cull, Triangle};

/// A parallel light along −z over an endless plane through the origin of the given unit normal, and its map of nearest depths. A texel is
/// 1/16 world units wide; places within ±7 of the axis are safe.
pub fn tilted(normal: DVec3) -> anyhow::Result<(View, Arc<Tiled>)> {
    let view = View::orthographic(DVec3::Z * 200.0, DVec3::ZERO, DVec3::Y, 8.0, 1.0, 400.0, UVec2::splat(256))?;
    let corners = [[-20.0, -20.0], [20.0, -20.0], [20.0, 20.0], [-20.0, 20.0]].map(|[x, y]| on_plane(normal, x, y));
    let sheet = |a: usize, b: usize, c: usize| Triangle::new([corners[a], corners[b], corners[c]], 0, true);
    Ok((view, bake(&view, [sheet(0, 1, 2), sheet(0, 2, 3)], &First, Cull::None).map))
}

/// The point of that plane at (x, y).
pub fn on_plane(normal: DVec3, x: f64, y: f64) -> Vec3 {
    DVec3::new(x, y, -(normal.x * x + normal.y * y) / normal.z).as_vec3()
}
