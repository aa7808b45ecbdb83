//! Pass 1 of as many triangles as one likes, none of which is kept.

use super::quantity::Quantity;
use crate::meshes::{straight, streaming_sheet};
use std::convert::Infallible;
use umbrage_bake::{Streaming, bake_streamed};
use umbrage_depth::First;
use umbrage_raster::Cull;

/// Side of the map, texels.
const SIDE: u32 = 1024;
/// Bytes for map and triangles.
const BUDGET: usize = 512 << 20;

pub(super) fn measure(count: u32) -> Vec<Quantity> {
    let view = straight(SIDE);
    let mut tiles = 0;
    let (taken, baked) = Quantity::timed("bake", || {
        let casters = || streaming_sheet(count, SIDE);
        bake_streamed(&view, casters, &First, Cull::None, Streaming::within(BUDGET), |row| {
            tiles += row.iter().flatten().count();
            Ok::<(), Infallible>(())
        })
    });
    let Ok(baked) = baked;
    assert_eq!(baked.stats.given, u64::from(count), "all triangles");
    assert_eq!(baked.fragments, u64::from(SIDE) * u64::from(SIDE), "a sheet covers each texel once");
    assert_eq!(tiles, (SIDE / 32) as usize * (SIDE / 32) as usize, "all tiles");
    vec![taken]
}
