//! The laws that every storage obeys, each over every storage, and the published sizes: V26 to V28, V33, V68 (R87-4, R87-19, R87-21, R87-22).

use fearless_simd::{Level, Simd, dispatch, f32x16, prelude::*};
use glam::{DVec3, IVec2, UVec2};
use proptest::prelude::*;
use std::sync::Arc;
use umbrage_depth::{Bbox, DepthMap, Map, MapError, MomentMap, Moments, Raw, TILE, Tile, Tiled};
use umbrage_plane::{DepthRange, TexelRect, View, mix32};

/// The one list: every storage of a map, made directly and by way of each other storage.
macro_rules! every_storage {
    ($raw:expr, $law:ident $(, $more:expr)*) => {
        let raw: &Raw = $raw;
        let (bbox, tiled) = (Bbox::from(raw), Tiled::from(raw));
        $law("raw", raw $(, $more)*);
        $law("raw from bbox", &Raw::from(&bbox) $(, $more)*);
        $law("raw from tiled", &Raw::from(&tiled) $(, $more)*);
        $law("bbox", &bbox $(, $more)*);
        $law("bbox from tiled", &Bbox::from(&tiled) $(, $more)*);
        $law("tiled", &tiled $(, $more)*);
        $law("tiled from bbox", &Tiled::from(&bbox) $(, $more)*);
        $law("any raw", &Map::from(Arc::new(raw.clone())) $(, $more)*);
        $law("any bbox", &Map::from(Arc::new(bbox.clone())) $(, $more)*);
        $law("any tiled", &Map::from(Arc::new(tiled.clone())) $(, $more)*);
        $law("moments of tiled", &MomentMap::of(&tiled, Moments::Four, 1.0) $(, $more)*);
    };
}

fn view(width: u32, height: u32) -> View {
    View::orthographic(DVec3::Y, DVec3::ZERO, DVec3::X, 1.0, 0.0, 100.0, UVec2::new(width, height)).unwrap()
}

fn map(width: u32, height: u32, depth: impl Fn(u32, u32) -> f32) -> Raw {
    let texels = (0..height).flat_map(|y| (0..width).map(move |x| (x, y)));
    Raw::new(view(width, height), texels.map(|(x, y)| depth(x, y)).collect()).unwrap()
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

/// Maps of all fillings: none, one texel, some rectangles, dust, all; depths of either sign.
fn any_map() -> impl Strategy<Value = Raw> {
    (1u32..140, 1u32..80, 0u32..5, any::<u32>()).prop_map(|(width, height, filling, seed)| {
        let mut draws = Draws(seed);
        let (x, y) = (draws.below(width), draws.below(height));
        let (right, lower) = (x + draws.below(60), y + draws.below(60));
        map(width, height, |i, j| {
            let depth = (mix32(seed ^ (j << 16 | i)) >> 12) as f32 / 1024.0 - 40.0;
            let filled = match filling {
                0 => false,
                1 => (i, j) == (x, y),
                2 => (x..=right).contains(&i) && (y..=lower).contains(&j),
                3 => mix32(seed ^ (i << 16 | j)).is_multiple_of(400),
                _ => true,
            };
            if filled { depth } else { f32::INFINITY }
        })
    })
}

/// The definition of a look-up, from the plain array.
fn stored(raw: &Raw, texel: IVec2) -> f32 {
    let size = DepthMap::view(raw).size();
    if texel.x < 0 || texel.y < 0 || texel.x >= size.x as i32 || texel.y >= size.y as i32 {
        return f32::INFINITY;
    }
    raw.depths()[texel.y as usize * size.x as usize + texel.x as usize]
}

fn answers_every_texel(name: &str, storage: &impl DepthMap, raw: &Raw) {
    let size = DepthMap::view(raw).size().as_ivec2();
    let around = TexelRect::new(IVec2::splat(-3), size + 3).texels();
    let far = [i32::MIN, -1 << 30, -1, 0, 1 << 30, i32::MAX];
    let far = far.into_iter().flat_map(|x| far.into_iter().map(move |y| IVec2::new(x, y)));
    for texel in around.chain(far) {
        let (found, want) = (storage.depth(texel), stored(raw, texel));
        assert_eq!(found.to_bits(), want.to_bits(), "{name}: {found} at {texel}, not {want}");
    }
    assert_eq!(storage.view(), raw.view(), "{name}");
}

#[inline(always)]
fn look<S: Simd>(simd: S, storage: &impl DepthMap, within: TexelRect, at: &[[f32; 16]; 2]) -> [f32; 16] {
    storage.look(simd, within, f32x16::load_array(simd, at[0]), f32x16::load_array(simd, at[1])).to_array()
}

/// One coordinate: anywhere, at a texel's border and the floats beside it, outside, huge.
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

/// `batches` of sixteen positions, in the whole map or a small window; one lane in sixteen is NaN and must do no harm.
fn looks_alike(name: &str, storage: &impl DepthMap, raw: &Raw, seed: u32, batches: u32) {
    let size = DepthMap::view(raw).size();
    let mut draws = Draws(seed);
    for _ in 0..batches {
        let window = draws.below(2) == 0;
        let (left, top) = (draws.unit() * size.x as f32, draws.unit() * size.y as f32);
        let mut along = |start: f32, size: u32| -> [f32; 16] {
            std::array::from_fn(|_| if window { start + draws.unit() * 9.0 } else { coordinate(&mut draws, size) })
        };
        let mut at = [along(left, size.x), along(top, size.y)];
        at[draws.below(2) as usize][draws.below(16) as usize] = f32::NAN;
        let lanes = || (0..16).filter(|&i| !at[0][i].is_nan() && !at[1][i].is_nan());
        let texel = |i: usize| IVec2::new(at[0][i].floor() as i32, at[1][i].floor() as i32);
        let within = lanes().map(texel).fold(TexelRect::EMPTY, |all, texel| {
            let low = texel.clamp(IVec2::splat(-1 << 30), IVec2::splat(1 << 30));
            all.union(TexelRect::new(low, low + 1))
        });
        for level in [Level::new(), Level::baseline()] {
            let found = dispatch!(level, simd => look(simd, storage, within, &at));
            for i in lanes() {
                let want = stored(raw, texel(i));
                let place = (at[0][i], at[1][i]);
                assert_eq!(found[i].to_bits(), want.to_bits(), "{name}: {} at {place:?}, not {want}", found[i]);
            }
        }
    }
}

#[inline(always)]
fn in_row<S: Simd>(simd: S, storage: &impl DepthMap, texel: IVec2, count: u32) -> [f32; 16] {
    storage.in_row(simd, texel, count).to_array()
}

/// Rows of one to sixteen texels: on the map, across its sides and those of its tiles, and beside it.
fn reads_rows_alike(name: &str, storage: &impl DepthMap, raw: &Raw, seed: u32, rows: u32) {
    let size = DepthMap::view(raw).size();
    let mut draws = Draws(seed);
    for _ in 0..rows {
        let mut along = |size: u32| draws.below(size + 24) as i32 - 20;
        let texel = IVec2::new(along(size.x), along(size.y).min(size.y as i32 + 1));
        let count = 1 + draws.below(16);
        for level in [Level::new(), Level::baseline()] {
            let found = dispatch!(level, simd => in_row(simd, storage, texel, count));
            for (found, x) in found[..count as usize].iter().zip(texel.x..) {
                let want = stored(raw, IVec2::new(x, texel.y));
                assert_eq!(
                    found.to_bits(),
                    want.to_bits(),
                    "{name}: {found} at {x} of {count} from {texel}, not {want}"
                );
            }
        }
    }
}

fn encloses_its_range(name: &str, storage: &impl DepthMap, raw: &Raw, seed: u32) {
    let mut draws = Draws(seed);
    let size = DepthMap::view(raw).size();
    for _ in 0..20 {
        let corner =
            |draws: &mut Draws| IVec2::new(draws.below(size.x + 40) as i32 - 20, draws.below(size.y + 40) as i32 - 20);
        let (a, b) = (corner(&mut draws), corner(&mut draws));
        let rect = TexelRect::new(a.min(b), a.max(b) + 1);
        let range = storage.range(rect);
        assert!(range.min <= range.max, "{name}: {range:?}");
        for texel in rect.texels() {
            let depth = stored(raw, texel);
            assert!(
                range.min <= depth && depth <= range.max,
                "{name}: {depth} at {texel} not in {range:?} of {rect:?}"
            );
        }
    }
}

proptest! {
    #[test]
    fn every_storage_answers_every_texel_alike(raw in any_map()) {
        every_storage!(&raw, answers_every_texel, &raw);
    }

    #[test]
    fn every_storage_encloses_its_range(raw in any_map(), seed: u32) {
        every_storage!(&raw, encloses_its_range, &raw, seed);
    }

    #[test]
    fn r87_19_every_storage_is_the_same_whichever_way_it_was_made(raw in any_map()) {
        let (bbox, tiled) = (Bbox::from(&raw), Tiled::from(&raw));
        prop_assert_eq!(&Raw::from(&bbox), &raw);
        prop_assert_eq!(&Raw::from(&tiled), &raw);
        prop_assert_eq!(&Bbox::from(&tiled), &bbox);
        prop_assert_eq!(&Tiled::from(&bbox), &tiled);
        prop_assert_eq!(raw.finite(), bbox.finite());
    }

    #[test]
    fn d_18_bytes_are_those_of_the_depths(raw in any_map()) {
        let (bbox, tiled) = (Bbox::from(&raw), Tiled::from(&raw));
        let full = |corner: IVec2| TexelRect::new(corner, corner + TILE as i32).texels().any(|t| stored(&raw, t) < f32::INFINITY);
        let grid = TexelRect::of_size(tiled.grid()).texels();
        let tiles = grid.filter(|&at| full(at * TILE as i32)).count();
        prop_assert_eq!(raw.bytes(), 4 * raw.depths().len());
        prop_assert_eq!(bbox.bytes(), 4 * raw.finite().area());
        prop_assert_eq!(tiled.bytes(), 4096 * tiles);
        prop_assert_eq!(tiled.tile_count(), tiles);
    }
}

/// 64,000 look-ups a filling, 1,024,000 a storage, over fillings and sizes on both sides of whole tiles.
#[test]
fn every_storage_looks_alike_a_million_times() {
    let dust = |x: u32, y: u32| if mix32(x << 16 | y).is_multiple_of(50) { (x + y) as f32 } else { f32::INFINITY };
    for (width, height, seed) in [(64, 64, 1), (100, 33, 2), (1, 1, 3), (250, 200, 4)] {
        let full = map(width, height, |x, y| (x * 1000 + y) as f32);
        let blob =
            map(width, height, |x, y| if (20..45).contains(&x) && y > 9 { y as f32 - 15.5 } else { f32::INFINITY });
        let empty = map(width, height, |_, _| f32::INFINITY);
        for (filling, raw) in (0..).zip([full, blob, empty, map(width, height, dust)]) {
            every_storage!(&raw, looks_alike, &raw, seed * 4 + filling, 4000);
            every_storage!(&raw, reads_rows_alike, &raw, seed * 4 + filling, 1000);
        }
    }
}

/// Whole tiles without a surface, and the last tiles cut by the map's edge, whose missing texels are no ∞ (R87-22, T-4).
#[test]
fn r87_22_a_tile_s_largest_depth_counts_texels_without_a_surface_but_none_beyond_the_map() {
    let raw = map(70, 40, |x, y| if x < 64 && (x, y) == (5, 5) { f32::INFINITY } else { 40.0 + (x % 11) as f32 });
    let tiled = Tiled::from(&raw);
    let range = |x, y| tiled.tile(UVec2::new(x, y)).map(Tile::range);
    assert_eq!(range(0, 0), Some(DepthRange { min: 40.0, max: f32::INFINITY }));
    assert_eq!(range(1, 0), Some(DepthRange { min: 40.0, max: 50.0 }));
    assert_eq!(range(2, 1), Some(DepthRange { min: 49.0, max: 50.0 }.union(DepthRange { min: 40.0, max: 40.0 })));
    assert_eq!((range(3, 0), range(0, 2)), (None, None));
    let edge = TexelRect::new(IVec2::new(64, 32), IVec2::new(70, 40));
    assert_eq!(tiled.range(edge), DepthRange { min: 40.0, max: 50.0 });
    let beyond = TexelRect::new(IVec2::new(64, 32), IVec2::new(71, 40));
    assert_eq!(tiled.range(beyond), DepthRange { min: 40.0, max: f32::INFINITY });
}

#[test]
fn v33_ranges_of_the_three_tiles() {
    let rect = TexelRect::new(IVec2::new(3, 3), IVec2::new(9, 9));
    let tile = Tiled::from(&map(32, 32, |x, _| if x % 2 == 0 { 40.0 } else { 50.0 }));
    assert_eq!(tile.range(rect), DepthRange { min: 40.0, max: 50.0 });
    let holed = Tiled::from(&map(32, 32, |x, _| if x == 31 { f32::INFINITY } else { 45.0 }));
    assert_eq!(holed.range(rect), DepthRange { min: 45.0, max: f32::INFINITY });
    let empty = Tiled::from(&map(32, 32, |_, _| 1e30));
    assert_eq!(empty.range(rect), DepthRange::NOTHING);
    assert_eq!(
        Bbox::from(&map(64, 64, |x, _| if x == 60 { 1.0 } else { f32::INFINITY })).range(rect),
        DepthRange::NOTHING
    );
    // Work is bounded: more than 64 tiles are not asked.
    let wide = Tiled::from(&map(32 * 9, 32 * 8, |_, _| 1.0));
    let columns = |n| TexelRect::new(IVec2::ZERO, IVec2::new(32 * n, 32 * 8));
    assert_eq!(wide.range(columns(8)), DepthRange { min: 1.0, max: 1.0 });
    assert_eq!(wide.range(columns(9)), DepthRange::UNKNOWN);
}

#[test]
fn v26_bytes_of_whole_maps() {
    let megabytes = |side: u32| map(side, side, |_, _| f32::INFINITY).bytes() as f64 / f64::from(1 << 20);
    assert_eq!((megabytes(1024), megabytes(2048)), (4.0, 16.0));
    assert_eq!(3.0 * megabytes(1024), 12.0);
    assert_eq!(megabytes(2048) + 2.0 * megabytes(1024), 24.0);
    assert_eq!(2.0 * megabytes(1024), 8.0);
}

/// The paper's first table: minutes without shadows, pass 1, pass 2 and total; lights; per cent more.
#[test]
fn v30_the_paper_s_times_recomputed() {
    let table: [([f64; 4], f64, f64); 4] = [
        ([42.0, 9.7, 48.0, 57.7], 1.0, 37.381),
        ([64.4, 14.2, 80.8, 95.0], 3.0, 47.516),
        ([58.8, 14.6, 74.2, 88.8], 3.0, 51.020),
        ([261.3, 55.3, 332.1, 387.4], 2.0, 48.259),
    ];
    let wanted = [(84.0f64, 0.618f64), (257.6, 0.464), (235.2, 0.487), (783.9, 0.439)];
    let mut mean = 0.0;
    for (([plain, pass_1, pass_2, total], lights, percent), (naive, share)) in table.into_iter().zip(wanted) {
        let close = |a: f64, b: f64| assert!((a - b).abs() < 6e-4, "{a} {b}");
        close(pass_1 + pass_2, total);
        close(100.0 * (total - plain) / plain, percent);
        close((1.0 + lights) * plain, naive);
        close(pass_1 / (total - plain), share);
        assert!(total < naive);
        mean += 0.25 * percent;
    }
    assert!((mean - 46.05).abs() < 0.01, "the printed mean");
}

/// The paper's second table: raw, box and tiles in MB, and the ratios that it amounts to.
#[test]
fn v29_the_paper_s_ratios_of_storage() {
    let table = [(4.0f64, 0.4, 0.4), (12.0, 2.6, 2.9), (24.0, 13.0, 3.7), (8.0, 5.6, 4.2)];
    let wanted = [(0.10f64, 0.10, 1.0), (0.2167, 0.2417, 1.115), (0.5417, 0.1542, 0.285), (0.70, 0.525, 0.75)];
    for ((raw, bbox, tile), (box_raw, tile_raw, tile_box)) in table.into_iter().zip(wanted) {
        let close = |a: f64, b: f64| assert!((a - b).abs() < 5e-4, "{a} {b}");
        close(bbox / raw, box_raw);
        close(tile / raw, tile_raw);
        close(tile / bbox, tile_box);
    }
}

#[test]
fn v27_bytes_of_a_rectangle_across_four_tiles() {
    let raw =
        map(512, 512, |x, y| if (100..132).contains(&x) && (200..232).contains(&y) { 7.0 } else { f32::INFINITY });
    assert_eq!(raw.finite(), TexelRect::new(IVec2::new(100, 200), IVec2::new(132, 232)));
    let tiled = Tiled::from(&raw);
    assert_eq!((Bbox::from(&raw).bytes(), tiled.tile_count(), tiled.bytes()), (4096, 4, 16_384));
    assert!(tiled.directory_bytes() >= 256 * size_of::<usize>(), "one entry a tile");
}

/// The depths of a disc: texels whose centre it covers.
fn disc(side: u32, x: f64, y: f64, radius: f64) -> Raw {
    let covered = |i: u32, j: u32| (f64::from(i) + 0.5 - x).hypot(f64::from(j) + 0.5 - y) <= radius;
    map(side, side, |i, j| if covered(i, j) { 1.0 } else { f32::INFINITY })
}

#[test]
fn v28_bytes_of_a_disc() {
    let raw = disc(1024, 512.0, 512.0, 160.0);
    let (bbox, tiled) = (Bbox::from(&raw), Tiled::from(&raw));
    assert_eq!(bbox.finite().size(), UVec2::splat(320));
    assert_eq!((bbox.bytes(), tiled.tile_count()), (4 * 320 * 320, 88));
    assert_eq!(tiled.bytes() as f64 / f64::from(1 << 20), 0.343_75);
}

/// Over offsets that fill a tile evenly; in steps of 1.6 texels, so that the disc's place within a texel varies too.
#[test]
fn v68_mean_number_of_tiles_of_a_disc_d_18() {
    let area = std::f64::consts::PI * 160.0 * 160.0;
    let want = (area + 31.0 * 640.0 + 31.0 * 31.0) / 1024.0;
    assert!((want - 98.85).abs() < 0.005);
    let steps = 20;
    let offset = |i: u32| 176.0 + (f64::from(i) + 0.37) * 32.0 / f64::from(steps);
    let tiles = |i: u32, j: u32| Tiled::from(&disc(384, offset(i), offset(j), 160.0)).tile_count();
    let sum: usize = (0..steps).flat_map(|i| (0..steps).map(move |j| tiles(i, j))).sum();
    let mean = sum as f64 / f64::from(steps * steps);
    assert!((mean - want).abs() < 0.1, "mean {mean}, want {want}");
}

#[test]
fn c_5_what_is_no_depth_is_rejected_by_name_and_what_is_far_is_nothing() {
    let new = |depths: &[f32]| Raw::new(view(3, 2), depths.to_vec());
    assert_eq!(new(&[0.0; 5]), Err(MapError::Length { width: 3, height: 2, found: 5 }));
    let error = new(&[0.0, 0.0, 0.0, 0.0, f32::NEG_INFINITY, 0.0]).unwrap_err();
    assert_eq!(error, MapError::NotADepth { texel: IVec2::new(1, 1), value: f32::NEG_INFINITY });
    assert_eq!(error.to_string(), "texel (1, 1) holds -inf, which is not a depth");
    assert!(matches!(
        new(&[0.0, 0.0, f32::NAN, 0.0, 0.0, 0.0]),
        Err(MapError::NotADepth { texel: IVec2 { x: 2, y: 0 }, .. })
    ));
    let raw = new(&[-1e31, -5.0, -0.0, 1e30f32.next_down(), 1e30, f32::INFINITY]).unwrap();
    assert_eq!(raw.depths(), [-1e31, -5.0, 0.0, 1e30f32.next_down(), f32::INFINITY, f32::INFINITY]);
    assert!(raw.map_depths(|texel, depth| if texel.x == 2 { f32::NAN } else { depth }).is_err());
    let moved = raw.map_depths(|texel, depth| depth.min(3.0) + texel.x as f32).unwrap();
    assert_eq!(moved.depths(), [-1e31, -4.0, 2.0, 3.0, 4.0, 5.0]);
}

#[test]
fn tiles_of_nothing_are_none_and_texels_beyond_the_map_are_cleared() {
    let tile = |fill: f32, valid: UVec2| Tile::new(Box::new([fill; 1024]), valid);
    for nothing in [f32::INFINITY, 1e30, f32::NAN, f32::NEG_INFINITY] {
        assert_eq!(tile(nothing, UVec2::splat(TILE)), None);
    }
    assert_eq!(tile(1.0, UVec2::new(0, 32)), None);
    let cut = tile(3.0, UVec2::new(2, 50)).unwrap();
    assert_eq!(cut.range(), DepthRange { min: 3.0, max: 3.0 });
    assert_eq!(cut.depths()[31 * 32..31 * 32 + 3], [3.0, 3.0, f32::INFINITY]);
}

#[test]
#[should_panic(expected = "tiles of a map")]
fn tiles_must_be_as_many_as_the_map_has() {
    let _ = Tiled::from_tiles(view(33, 32), vec![None]);
}
