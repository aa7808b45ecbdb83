//! Paged maps answer as whole ones do, at any number of pages and threads, and tell by a count what they read (R87-20).

use crate::shadow_maps::foreign;
use crate::{folder, map, spot, sun};
use exr::prelude::{Blocks, Compression, Vec2};
use fearless_simd::{Level, Simd, dispatch, f32x16, prelude::*};
use glam::{IVec2, UVec2};
use std::path::{Path, PathBuf};
use umbrage_depth::{Bbox, DepthMap, Raw, TILE, Tile, Tiled};
use umbrage_io::{Paged, PagedHandle, read_shadow_map, write_bytes, write_shadow_map};
use umbrage_plane::{DepthRange, TexelRect, mix32};

fn opened(path: &Path, pages: usize) -> (Paged, PagedHandle) {
    Paged::open(path, pages).expect("a tiled map")
}

/// Numbers without end from a seed.
struct Draws(u32);

impl Draws {
    fn bits(&mut self) -> u32 {
        self.0 = self.0.wrapping_add(0x9E37_79B9);
        mix32(self.0)
    }

    fn below(&mut self, end: u32) -> u32 {
        ((u64::from(self.bits()) * u64::from(end)) >> 32) as u32
    }

    fn unit(&mut self) -> f32 {
        (self.bits() >> 8) as f32 / 16_777_216.0
    }
}

/// One coordinate: anywhere, at a texel's border and the floats beside it, outside, far outside.
fn coordinate(draws: &mut Draws, size: u32) -> f32 {
    let border = draws.below(size + 1) as f32;
    match draws.below(12) {
        0 => border,
        1 => border.next_down(),
        2 => border.next_up(),
        3 => -draws.unit() * 3.0,
        4 => size as f32 + draws.unit() * 3.0,
        5 => [1e9, -1e9, f32::MAX, f32::MIN, f32::MIN_POSITIVE, -0.0][draws.below(6) as usize],
        _ => draws.unit() * size as f32,
    }
}

#[inline(always)]
fn look<S: Simd>(simd: S, map: &impl DepthMap, within: TexelRect, at: &[[f32; 16]; 2]) -> [f32; 16] {
    map.look(simd, within, f32x16::load_array(simd, at[0]), f32x16::load_array(simd, at[1])).to_array()
}

/// `batches` of sixteen positions, all over the map or close together; a quarter of the batches one by one.
fn looks_alike(map: &impl DepthMap, raw: &Raw, seed: u32, batches: u32) {
    let size = raw.view().size();
    let (level, whole) = (Level::new(), TexelRect::of_size(size));
    let mut draws = Draws(seed);
    for batch in 0..batches {
        let close = draws.below(4) != 0;
        let (left, top) = (draws.unit() * size.x as f32, draws.unit() * size.y as f32);
        let mut along = |start: f32, size: u32| -> [f32; 16] {
            std::array::from_fn(|_| if close { start + draws.unit() * 9.0 } else { coordinate(&mut draws, size) })
        };
        let at = [along(left, size.x), along(top, size.y)];
        let texel = |i: usize| IVec2::new(at[0][i].floor() as i32, at[1][i].floor() as i32);
        let wanted: [f32; 16] = std::array::from_fn(|i| raw.depth(texel(i)));
        let found = if batch % 4 == 0 {
            std::array::from_fn(|i| map.depth(texel(i)))
        } else {
            dispatch!(level, simd => look(simd, map, whole, &at))
        };
        assert_eq!(found.map(f32::to_bits), wanted.map(f32::to_bits), "{at:?}");
    }
}

/// 102,400 look-ups each by one thread, and by four at once.
#[test]
fn r87_20_paged_maps_answer_as_whole_ones_bit_for_bit_at_any_size_and_from_any_thread() {
    let path = folder("paged_alike").join("lamp.exr");
    let raw = map(&spot(UVec2::new(500, 300)));
    write_shadow_map(&path, &raw).expect("written");
    for pages in [1, 2, 7, 1000] {
        let (paged, handle) = opened(&path, pages);
        assert_eq!((paged.view(), paged.bytes(), handle.faults()), (raw.view(), 0, 0));
        looks_alike(&paged, &raw, pages as u32, 6400);
        std::thread::scope(|scope| {
            let (paged, raw) = (&paged, &raw);
            for thread in 0..4 {
                scope.spawn(move || looks_alike(paged, raw, mix32(thread), 1600));
            }
        });
        assert!(handle.error().is_none());
        // Twelve tiles hold the surface's box of 250 x 150 texels.
        assert_eq!(handle.resident_pages(), pages.min(12));
        assert!(paged.bytes() <= pages * 64 * 64 * 4);
        assert!(if pages == 1000 { handle.faults() == 12 } else { handle.faults() > 1000 });
    }
}

#[test]
fn r87_20_every_texel_and_the_ends_of_the_earth() {
    let path = folder("paged_texels").join("sun.exr");
    let raw = map(&sun(UVec2::new(200, 130)));
    write_shadow_map(&path, &raw).expect("written");
    let (paged, _handle) = opened(&path, 2);
    let far = [i32::MIN, -1 << 30, -1, 0, 1 << 30, i32::MAX];
    let far = far.into_iter().flat_map(|x| far.into_iter().map(move |y| IVec2::new(x, y)));
    for texel in TexelRect::new(IVec2::splat(-3), IVec2::new(203, 133)).texels().chain(far) {
        assert_eq!(paged.depth(texel).to_bits(), raw.depth(texel).to_bits(), "{texel}");
    }
    assert_eq!(Raw::copy_of(&paged), raw);
}

#[test]
fn r87_20_tiles_of_other_makers_are_pages_too() {
    let folder = folder("paged_foreign");
    let ways = [
        (Vec2(10, 17), Compression::ZIP16),
        (Vec2(16, 16), Compression::RLE),
        (Vec2(1, 400), Compression::Uncompressed),
        (Vec2(300, 300), Compression::ZIP1),
    ];
    for (index, (tile, compression)) in (0..).zip(ways) {
        let path = folder.join(format!("{index}.exr"));
        let bytes = foreign(&spot(UVec2::new(145, 133)), Blocks::Tiles(tile), compression);
        write_bytes(&path, &bytes).expect("written");
        let raw = read_shadow_map(&path).expect("read");
        let (paged, handle) = opened(&path, 3);
        assert_eq!(paged.view(), raw.view());
        looks_alike(&paged, &raw, index, 400);
        assert!(handle.error().is_none());
        assert_eq!(Raw::copy_of(&paged), raw);
    }
}

/// The paged map asks the file for nothing to answer this, so that it knows the data window only.
#[test]
fn r87_22_ranges_enclose_and_cost_no_page() {
    let path = folder("paged_range").join("lamp.exr");
    let raw = map(&spot(UVec2::new(150, 90)));
    write_shadow_map(&path, &raw).expect("written");
    let (paged, handle) = opened(&path, 1);
    let range = |x: i32, y: i32| paged.range(TexelRect::new(IVec2::new(x, y), IVec2::new(x + 5, y + 5)));
    assert_eq!(
        (range(0, 0), range(-9, 500), range(45, 30)),
        (DepthRange::NOTHING, DepthRange::NOTHING, DepthRange::NOTHING)
    );
    assert_eq!((range(46, 30), range(60, 40)), (DepthRange::UNKNOWN, DepthRange::UNKNOWN));
    assert_eq!(paged.depth(IVec2::ZERO), f32::INFINITY);
    assert_eq!((handle.faults(), handle.resident_pages(), paged.bytes()), (0, 0, 0));
}

#[test]
fn r87_20_a_footprint_reads_each_of_its_tiles_once_and_lanes_that_do_not_matter_none() {
    let (path, raw) = full("paged_footprint");
    // From (60, 60) to (67, 67), across the corner of four tiles, from left to right and back again; two lanes far away.
    let mut at: [[f32; 16]; 2] =
        [std::array::from_fn(|i| 60.5 + (i % 8) as f32), std::array::from_fn(|i| 60.5 + (i / 2) as f32)];
    (at[0][3], at[1][3], at[0][9]) = (400.5, 300.5, f32::NAN);
    let within = TexelRect::new(IVec2::splat(60), IVec2::splat(68));
    for (pages, wanted) in [(1, 4), (4, 4)] {
        let (paged, handle) = opened(&path, pages);
        let found = dispatch!(Level::new(), simd => look(simd, &paged, within, &at));
        let wants = |i: usize| raw.depth(IVec2::new(at[0][i] as i32, at[1][i] as i32));
        assert!((0..16).filter(|i| ![3, 9].contains(i)).all(|i| found[i].to_bits() == wants(i).to_bits()));
        assert_eq!((found[3], handle.faults()), (f32::INFINITY, wanted));
    }
}

/// 512 × 384 texels, all of them with a surface: 8 × 6 tiles.
fn full(name: &str) -> (PathBuf, Raw) {
    let path = folder(name).join("full.exr");
    let view = spot(UVec2::new(512, 384));
    let depths = (0..512 * 384).map(|index| 30.0 + (mix32(index) >> 20) as f32 / 64.0).collect();
    let raw = Raw::new(view, depths).expect("one depth per texel");
    write_shadow_map(&path, &raw).expect("written");
    (path, raw)
}

/// The tiles read in an order of texels.
fn faults(path: &Path, pages: usize, order: impl IntoIterator<Item = IVec2>) -> u64 {
    let (paged, handle) = opened(path, pages);
    for texel in order {
        assert!(paged.depth(texel).is_finite(), "{texel}");
        assert!(handle.resident_pages() <= pages);
    }
    handle.faults()
}

/// The same by the definition: a list of tiles by when they were read.
fn textbook_faults(pages: usize, order: impl IntoIterator<Item = IVec2>) -> u64 {
    let (mut kept, mut faults) = (Vec::new(), 0);
    for texel in order {
        let tile = texel >> 6;
        match kept.iter().position(|other| *other == tile) {
            Some(at) => drop(kept.remove(at)),
            None => faults += 1,
        }
        kept.insert(0, tile);
        kept.truncate(pages);
    }
    faults
}

/// Squares of 32 pixels, row by row, and their pixels row by row.
fn buckets(size: IVec2) -> impl Iterator<Item = IVec2> {
    let corners = TexelRect::new(IVec2::ZERO, size / 32).texels();
    corners.flat_map(|corner| TexelRect::new(corner * 32, corner * 32 + 32).texels())
}

/// Whole maps, texel by texel: a row of tiles is enough for one read a tile, one page less makes every change of tile a read (the
/// least recently used tile is the very one needed next); buckets need two rows of buckets for a row of tiles.
#[test]
fn r87_20_faults_of_scan_lines_and_buckets_over_a_whole_map_are_as_counted_by_hand() {
    let (path, _raw) = full("paged_count");
    let size = IVec2::new(512, 384);
    let lines = || TexelRect::new(IVec2::ZERO, size).texels();
    let by_lines = [(1, 384 * 8), (7, 384 * 8), (8, 48), (100, 48)];
    for (pages, wanted) in by_lines {
        assert_eq!(faults(&path, pages, lines()), wanted, "scan lines, {pages} pages");
    }
    for (pages, wanted) in [(1, 12 * 8), (7, 12 * 8), (8, 48), (100, 48)] {
        assert_eq!(faults(&path, pages, buckets(size)), wanted, "buckets, {pages} pages");
    }
}

/// A camera that sees the map turned by 30°, every pixel two texels wide, in the order of its scan lines, of its buckets and at
/// random. Reeves' claim of locality: neighbours in the image are neighbours in the map. The tiles under a bucket are few, under
/// a scan line some, under a random order all; with room for these, hardly a tile is read twice. With less, every order pays,
/// and in one page the short rows of a bucket pay more than long ones.
#[test]
fn r87_20_the_pages_that_serve_are_few_by_buckets_more_by_scan_lines_and_all_at_random() {
    let (path, _raw) = full("paged_order");
    let side = IVec2::splat(128);
    let (sin, cos) = 30f32.to_radians().sin_cos();
    let texel = |pixel: IVec2| {
        let at = (pixel - side / 2).as_vec2() * 2.0;
        IVec2::new((256.0 + at.x * cos - at.y * sin).floor() as i32, (192.0 + at.x * sin + at.y * cos).floor() as i32)
    };
    let lines: Vec<IVec2> = TexelRect::new(IVec2::ZERO, side).texels().map(texel).collect();
    let squares: Vec<IVec2> = buckets(side).map(texel).collect();
    let mut random = lines.clone();
    let mut draws = Draws(7);
    for last in (1..random.len()).rev() {
        random.swap(last, draws.below(last as u32 + 1) as usize);
    }
    let orders = [("buckets", &squares), ("scan lines", &lines), ("random", &random)];
    let counts = |pages: usize| {
        orders.map(|(name, order)| {
            let found = faults(&path, pages, order.iter().copied());
            assert_eq!(found, textbook_faults(pages, order.iter().copied()), "{name}, {pages} pages");
            found
        })
    };
    assert_eq!(counts(48), [28; 3], "the tiles that the camera sees");
    let few = counts(4);
    assert!(few[0] * 10 < few[1] && few[1] * 10 < few[2], "{few:?}");
    let some = counts(8);
    assert!(some[0] < 2 * 28 && some[1] < 2 * 28 && some[2] > 100 * 28, "{some:?}");
    let one = counts(1);
    assert!(one[1] < one[0] && one[0] * 10 < one[2], "{one:?}");
}

/// Nobody reads what another thread is reading.
#[test]
fn r87_20_four_threads_read_every_tile_once_and_never_hold_more_than_the_pages() {
    let (path, raw) = full("paged_threads");
    let sweep = |paged: &Paged, handle: &PagedHandle, pages: usize| {
        for texel in TexelRect::of_size(raw.view().size()).texels().step_by(16) {
            assert_eq!(paged.depth(texel).to_bits(), raw.depth(texel).to_bits());
            assert!(handle.resident_pages() <= pages);
        }
    };
    for pages in [48, 3] {
        let (paged, handle) = opened(&path, pages);
        std::thread::scope(|scope| {
            for _ in 0..4 {
                scope.spawn(|| sweep(&paged, &handle, pages));
            }
        });
        assert!(if pages == 48 { handle.faults() == 48 } else { handle.faults() > 48 });
        assert!(handle.error().is_none());
    }
}

/// Two maps in turn on one thread: the page that the thread keeps is never taken for the other map's, not even when one goes and
/// another may get its place in memory.
#[test]
fn r87_20_maps_are_not_confused() {
    let folder = folder("paged_two");
    let depths = |depth: f32| Raw::new(sun(UVec2::new(70, 70)), vec![depth; 4900]).expect("valid");
    let path = |index: u32| folder.join(format!("{index}.exr"));
    for index in 0..5u32 {
        write_shadow_map(&path(index), &depths(index as f32)).expect("written");
    }
    let (first, first_handle) = opened(&path(0), 1);
    for round in 0..40 {
        let index = 1 + round % 4;
        let (other, _handle) = opened(&path(index), 1);
        for x in 0..3 {
            assert_eq!(other.depth(IVec2::new(x, 3)), index as f32);
            assert_eq!(first.depth(IVec2::new(x, 3)), 0.0);
        }
    }
    assert_eq!(first_handle.faults(), 1);
}

/// 16,384 × 16,384 texels, of which tiles along a diagonal band hold a surface: 1 GiB as a whole, 1 MiB in 64 pages.
#[test]
fn r87_20_a_map_of_16384_squared_in_one_megabyte() {
    let path = folder("paged_large").join("large.exr");
    let view = sun(UVec2::splat(16_384));
    let grid = 16_384 / TILE;
    let tile = |index: u32| {
        let at = UVec2::new(index % grid, index / grid);
        let filled = (300..340).contains(&at.x) && at.x.abs_diff(at.y + 100) < 4;
        let depth = |i: usize| (mix32(index << 10 | i as u32) >> 20) as f32 / 128.0;
        filled.then(|| Tile::new(Box::new(std::array::from_fn(depth)), UVec2::splat(TILE))).flatten()
    };
    let tiled = Tiled::from_tiles(view, (0..grid * grid).map(tile).collect());
    write_shadow_map(&path, &Bbox::from(&tiled)).expect("written");
    let (paged, handle) = opened(&path, 64);
    assert_eq!(paged.view().size(), UVec2::splat(16_384));
    let mut draws = Draws(16);
    for _ in 0..20_000 {
        let at = if draws.below(4) == 0 { UVec2::ZERO } else { UVec2::new(9_400, 6_200) };
        let size = if at == UVec2::ZERO { 16_384 } else { 1_700 };
        let texel = (at + UVec2::new(draws.below(size) & !1, draws.below(size) >> 3 << 3)).as_ivec2();
        assert_eq!(paged.depth(texel).to_bits(), tiled.depth(texel).to_bits(), "{texel}");
        if draws.below(50) != 0 {
            let beside = texel + IVec2::X;
            assert_eq!(paged.depth(beside).to_bits(), tiled.depth(beside).to_bits(), "{beside}");
        }
    }
    assert!(handle.error().is_none());
    assert_eq!(handle.resident_pages(), 64);
    assert!(paged.bytes() <= 1 << 20);
}
