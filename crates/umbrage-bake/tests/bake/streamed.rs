//! Maps drawn in bands, from triangles that come in chunks, are those of one walk.

use crate::pass1::{triangles, views};
use crate::shapes::ball;
use glam::{DVec3, UVec2, Vec3};
use std::convert::Infallible;
use umbrage_bake::{Caster, MaskPlace, Streaming, bake, bake_streamed};
use umbrage_depth::{BackFace, DepthMap, DepthRule, First, Midpoint, Second, Tiled};
use umbrage_plane::View;
use umbrage_raster::{Cull, Triangle};

/// Bands of one row of tiles and of all, with few triangles at a time and with all.
const PIECES: [Streaming; 4] = [
    Streaming { map_bytes: 0, triangles: 5 },
    Streaming { map_bytes: 0, triangles: 1 << 12 },
    Streaming { map_bytes: 1 << 30, triangles: 50 },
    Streaming { map_bytes: 1 << 30, triangles: 1 << 12 },
];

#[track_caller]
fn law<R: DepthRule>(rule: &R, cull: Cull) {
    // Solids, a sheet that fills the map, and holes in every third triangle.
    let holes = |at: &MaskPlace| at.triangle.is_multiple_of(3) && (at.weights.x * 7.0).fract() < 0.5;
    let casters: Vec<Caster<'_>> = (0..)
        .zip(triangles())
        .map(|(index, triangle)| {
            let caster = Caster::from(triangle);
            if index % 3 == 0 { caster.with_mask(&holes) } else { caster }
        })
        .collect();
    for view in views() {
        for streaming in PIECES {
            law_of_one_walk(&view, || casters.iter().copied(), streaming, rule, cull);
        }
    }
}

#[track_caller]
fn law_of_one_walk<'a, R: DepthRule, I>(
    view: &View,
    casters: impl Fn() -> I,
    streaming: Streaming,
    rule: &R,
    cull: Cull,
) where
    I: Iterator<Item = Caster<'a>>,
{
    let whole = bake(view, casters(), rule, cull);
    let (mut tiles, mut rows) = (Vec::new(), 0);
    let streamed = bake_streamed(view, &casters, rule, cull, streaming, |row| {
        rows += 1;
        tiles.extend(row);
        Ok::<(), Infallible>(())
    });
    let Ok(streamed) = streamed;
    let shown = format!("{:?}, {:?}, {streaming:?}", rule.stored(), view.size());
    assert_eq!(rows, whole.map.grid().y, "{shown}");
    assert_eq!(streamed.bands, if streaming.map_bytes == 0 { rows } else { 1 }, "{shown}");
    let chunks = casters().count().div_ceil(streaming.triangles) as u64;
    assert_eq!(streamed.chunks, chunks * u64::from(streamed.bands), "{shown}");
    assert_eq!((streamed.stats, streamed.fragments), (whole.stats, whole.fragments), "{shown}");
    let map = Tiled::from_tiles(*view, tiles).with_stored(whole.map.stored());
    assert!(map == *whole.map, "{shown}");
}

#[test]
fn x3_bands_and_chunks_store_what_one_walk_stores() {
    law(&First, Cull::None);
    law(&First, Cull::Front);
    law(&Second, Cull::None);
    law(&BackFace, Cull::Front);
    law(&Midpoint::default(), Cull::None);
}

/// More triangles than [`bake`] draws at once, with holes in some of the first and the last, on a map that all of them reach.
#[test]
fn x3_more_triangles_than_are_drawn_at_once_make_the_map_of_one_walk() {
    let triangles: Vec<_> = ball(Vec3::ZERO, 5.0, 190, 3).into_iter().map(|(triangle, _)| triangle).collect();
    assert!(triangles.len() > 2 * 65_536, "{} triangles", triangles.len());
    let holes = |at: &MaskPlace| at.triangle.is_multiple_of(500);
    let casters = || {
        (0_u32..).zip(&triangles).map(|(index, triangle)| {
            let caster = Caster::from(*triangle);
            if index.is_multiple_of(100) { caster.with_mask(&holes) } else { caster }
        })
    };
    let view = View::perspective(DVec3::Z * 20.0, DVec3::ZERO, DVec3::Y, 0.6, 1.0, 50.0, UVec2::new(300, 200)).unwrap();
    let at_once = Streaming { map_bytes: usize::MAX, triangles: usize::MAX };
    law_of_one_walk(&view, casters, at_once, &First, Cull::None);
    law_of_one_walk(&view, casters, at_once, &Second, Cull::None);
    law_of_one_walk(&view, casters, at_once, &BackFace, Cull::Front);
    law_of_one_walk(&view, casters, at_once, &Midpoint::default(), Cull::None);
}

#[test]
fn no_triangles_are_an_empty_map() {
    let none = || std::iter::empty::<Triangle>();
    for view in views() {
        let mut tiles = Vec::new();
        let streamed = bake_streamed(&view, none, &Midpoint::default(), Cull::None, Streaming::within(0), |row| {
            tiles.extend(row);
            Ok::<(), Infallible>(())
        });
        assert_eq!(streamed.map(|streamed| (streamed.stats.given, streamed.fragments)), Ok((0, 0)));
        assert_eq!(Tiled::from_tiles(view, tiles).tile_count(), 0);
    }
}

#[test]
fn the_first_error_of_a_row_ends_the_bake() {
    let view = views().pop().unwrap();
    let mut rows = 0;
    let baked = bake_streamed(&view, triangles, &First, Cull::None, PIECES[0], |_| {
        rows += 1;
        if rows == 2 { Err("the disk is full") } else { Ok(()) }
    });
    assert_eq!((baked, rows), (Err("the disk is full"), 2));
}
