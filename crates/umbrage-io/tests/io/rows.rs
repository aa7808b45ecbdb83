//! Files that are written row of tiles by row of tiles are those of the whole map.

use crate::{folder, map, spot, sun};
use glam::{IVec2, UVec2};
use std::fs::read;
use std::path::Path;
use umbrage_depth::{DepthMap, Raw, Stored, Tile, Tiled};
use umbrage_io::{IoError, Paged, TileRows, read_shadow_map, write_shadow_map, write_shadow_map_by_rows};
use umbrage_plane::TexelRect;

fn rows(map: &Raw) -> Vec<Vec<Option<Tile>>> {
    let tiled = Tiled::copy_of(map);
    let row = |y| (0..tiled.grid().x).map(|x| tiled.tile(UVec2::new(x, y)).cloned()).collect();
    (0..tiled.grid().y).map(row).collect()
}

fn write(path: &Path, map: &Raw) -> Result<(), IoError> {
    write_shadow_map_by_rows(path, "shadow", map.view(), map.stored(), |file| {
        rows(map).iter().try_for_each(|row| file.push(row))
    })
}

/// A map with a surface in every texel but those of `holes`.
fn full(size: UVec2, holes: TexelRect) -> Raw {
    let depth = |texel: IVec2| 2.0 + (texel.x * 31 + texel.y * 17) as f32 / 64.0;
    let depths = TexelRect::of_size(size).texels().map(|at| if holes.contains(at) { f32::INFINITY } else { depth(at) });
    Raw::new(sun(size), depths.collect()).expect("depths").with_stored(Stored::Second)
}

#[test]
fn r87_4_maps_that_fill_their_rectangle_have_the_same_bytes_either_way() {
    let folder = folder("rows_bytes");
    for (x, y) in [(1, 1), (32, 32), (33, 1), (64, 96), (65, 64), (200, 130), (31, 129), (500, 300)] {
        let size = UVec2::new(x, y);
        let holes = TexelRect::new(IVec2::splat(1), size.as_ivec2() - 1);
        for map in [full(size, TexelRect::EMPTY), full(size, holes)] {
            let (whole, by_rows) = (folder.join("whole.exr"), folder.join("rows.exr"));
            write_shadow_map(&whole, &map).expect("written");
            write(&by_rows, &map).expect("written");
            assert!(read(whole).expect("a file") == read(&by_rows).expect("a file"), "{size}");
        }
    }
}

#[test]
fn r87_4_maps_with_bare_edges_are_read_again_bit_for_bit() {
    let path = folder("rows_edges").join("map.exr");
    for map in [map(&spot(UVec2::new(500, 300))), map(&sun(UVec2::new(131, 66)))] {
        write(&path, &map).expect("written");
        assert!(read_shadow_map(&path).expect("a map") == map);
        let (paged, handle) = Paged::open(&path, 3).expect("a map");
        assert!(TexelRect::of_size(map.view().size()).texels().all(|at| paged.depth(at) == map.depth(at)));
        assert!(handle.error().is_none());
    }
}

#[test]
fn rows_that_are_not_given_have_no_surface() {
    let path = folder("rows_few").join("map.exr");
    let map = full(UVec2::new(70, 150), TexelRect::EMPTY);
    let first = |file: &mut TileRows<'_>| rows(&map).iter().take(3).try_for_each(|row| file.push(row));
    write_shadow_map_by_rows(&path, "shadow", map.view(), Stored::Second, first).expect("written");
    assert!(
        read_shadow_map(&path).expect("a map")
            == full(UVec2::new(70, 150), TexelRect::new(IVec2::new(0, 96), IVec2::new(70, 150)))
    );
}

#[test]
fn what_cannot_be_written_is_one_line_and_leaves_the_old_file() {
    let path = folder("rows_bad").join("map.exr");
    std::fs::write(&path, "old").expect("written");
    let map = full(UVec2::new(70, 40), TexelRect::EMPTY);
    let tiles = rows(&map);
    let refused = |fill: &dyn Fn(&mut TileRows<'_>) -> Result<(), IoError>| {
        let error = write_shadow_map_by_rows(&path, "shadow", map.view(), Stored::First, fill)
            .expect_err("refused")
            .to_string();
        assert_eq!(read(&path).expect("a file"), b"old");
        assert_eq!(std::fs::read_dir(path.parent().expect("a folder")).expect("a folder").count(), 1);
        error.rsplit_once("map.exr: ").expect("the file's name").1.to_owned()
    };
    let many = refused(&|file| tiles.iter().chain(&tiles).try_for_each(|row| file.push(row)));
    assert_eq!(many, "rows of tiles is 3: the map has 2");
    assert_eq!(refused(&|file| file.push(&tiles[0][..2])), "tiles of a row is 2: the map has 3");
    let named = write_shadow_map_by_rows(&path, "\n", map.view(), Stored::First, |_| Ok(()));
    let line = named.expect_err("refused").to_string();
    assert!(
        line.ends_with("map.exr: name is \\n: not a name of 1 to 255 bytes, printable and of Latin letters"),
        "{line}"
    );
}
