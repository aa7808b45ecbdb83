//! Files of maps of facets. That baked ones survive is held in the workspace's tests.

use crate::hostile::{table, value};
use crate::{folder, map as depths, spot, sun, views};
use exr::meta::MetaData;
use exr::meta::header::Header;
use glam::{DVec3, IVec2, UVec2};
use proptest::prelude::*;
use std::sync::LazyLock;
use umbrage_depth::{
    DepthMap, FacetBlock, FacetCells, FacetDepths, FacetMap, FacetSource, FacetTile, Map, NO_FACET, Raw, Stored, TILE,
};
use umbrage_io::{
    DEFAULT_BUDGET, DEFAULT_DEEP_BUDGET, DEFAULT_FACET_BUDGET, Fault, Paged, decode_deep_map, decode_facet_map,
    decode_shadow_map, encode_facet_map, encode_shadow_map, read_facet_map, read_facet_map_within, read_shadow_map,
    write_facet_map, write_shadow_map,
};
use umbrage_plane::{Affine, TexelRect, View};

const AREA: u32 = TILE * TILE;
const TEXELS: u64 = 1 << 16;

/// Some bits that depend on all of `numbers`.
fn hash(numbers: [u32; 3]) -> u32 {
    let fold = |hash: u32, number: u32| (hash ^ number).wrapping_mul(0x9E37_79B1).rotate_left(13);
    numbers.into_iter().fold(0x1234_5677, fold) >> 3
}

/// Tiles of every kind, from `first` on: nothing, one facet, some with holes and blocks, a facet for each texel.
fn facets(view: &View, fine: u32, first: u32) -> FacetMap {
    let at_plane = FacetDepths::of(view);
    let grid = view.size().map(|side| side.div_ceil(TILE));
    let tile = |index: u32| {
        let origin = (UVec2::new(index % grid.x, index / grid.x) * TILE).as_ivec2();
        let count = [0, 1, 5, AREA][((index + first) % 4) as usize];
        let plane = |plane: u32| {
            let random = |of: u32| f64::from(hash([index, plane, of]) % 1000) / 1000.0;
            let key = view.key(view.near() + (0.1 + 0.8 * random(0)) * (view.far() - view.near()));
            let (dx, dy) = (key * (random(1) - 0.5) * 1e-3, key * (random(2) - 0.5) * 1e-3);
            Affine { c: key - dx * f64::from(origin.x) - dy * f64::from(origin.y), dx, dy }
        };
        let facet = |at: u32, of: u32| match count {
            1 | AREA => at % count,
            _ if hash([index, at, of]) % 7 < 2 => NO_FACET,
            _ => hash([at, index, of]) % count.max(1),
        };
        let planes: Vec<Affine> = (0..count).map(plane).collect();
        let texels: Vec<u32> = (0..AREA).map(|texel| if count == 0 { NO_FACET } else { facet(texel, 1) }).collect();
        let block = |texel: u32| FacetBlock {
            texel: texel as u16,
            samples: (0..fine * fine).map(|sample| facet(sample, texel)).collect(),
            links: (0..2 * fine * fine).step_by(3).map(|link| (link as u16, (link % (64 / fine)) as u8)).collect(),
        };
        let refined = fine > 1 && count == 5;
        let blocks: Vec<FacetBlock> = (0..AREA).filter(|texel| refined && texel % 9 == 2).map(block).collect();
        let valid = (view.size() - origin.as_uvec2()).min(UVec2::splat(TILE));
        let cells = FacetCells { planes: &planes, texels: &texels, blocks: &blocks };
        FacetTile::new(&cells, origin, valid, fine, |texel, plane| at_plane.depth(texel, plane))
    };
    let tiles = (0..grid.element_product()).map(tile).collect();
    FacetMap::from_tiles(*view, Stored::Second, fine, if fine == 1 { 1 } else { 64 / fine }, tiles)
}

/// Everything that a map can answer, as bits.
fn looked_up(map: &FacetMap) -> Vec<u64> {
    let size = map.view().size().as_ivec2();
    let around = TexelRect::new(IVec2::splat(-2), size + 2);
    let mut all: Vec<u64> = around.texels().map(|texel| u64::from(map.depth(texel).to_bits())).collect();
    for at in TexelRect::new(IVec2::ZERO, size * map.fine() as i32).texels() {
        let sample = map.sample(at);
        all.extend(
            [sample.plane.c, sample.plane.dx, sample.plane.dy, sample.at.x, sample.at.y, sample.side].map(f64::to_bits),
        );
        all.extend([false, true].map(|down| map.link(at, down).map_or(u64::MAX, f64::to_bits)));
    }
    all
}

fn read(bytes: &[u8]) -> Result<FacetMap, Fault> {
    let read = decode_facet_map(bytes, TEXELS);
    if let Err(fault) = &read {
        let line = fault.to_string();
        assert!(!line.contains('\n') && !fault.field.is_empty(), "{line}");
    }
    read
}

fn message(bytes: &[u8]) -> String {
    read(bytes).expect_err("refused").to_string()
}

fn headers(bytes: &[u8]) -> Vec<Header> {
    MetaData::read_from_buffered(bytes, true).expect("an EXR file").headers.into_vec()
}

#[test]
fn a_map_read_again_is_the_map() {
    let sizes = [UVec2::new(1, 1), UVec2::new(1, 37), UVec2::new(101, 43), UVec2::splat(64)];
    for view in sizes.into_iter().flat_map(views) {
        for fine in [1, 2, 4, 8] {
            let map = facets(&view, fine, view.size().x);
            let bytes = encode_facet_map(&map).expect("written");
            assert!(bytes == encode_facet_map(&map).expect("written"), "the same bytes each time");
            let again = read(&bytes).expect("as it was written");
            assert!(again == map, "{view:?}, fine {fine}");
            assert_eq!(again.view(), &view);
            assert_eq!(again.stored(), Stored::Second);
            if view.size().x < 101 || fine == 4 {
                assert!(looked_up(&again) == looked_up(&map), "{view:?}, fine {fine}");
            }
            // Whoever knows nothing of facets.
            assert!(decode_shadow_map(&bytes, TEXELS).expect("a shadow map") == Raw::copy_of(&map));
        }
    }
}

#[test]
fn maps_without_a_surface_and_of_one_facet() {
    for (first, depth) in [(0, f32::INFINITY), (1, f32::NEG_INFINITY)] {
        let map = facets(&sun(UVec2::new(20, 30)), 4, first);
        let again = read(&encode_facet_map(&map).expect("written")).expect("as it was written");
        assert!(again == map && looked_up(&again) == looked_up(&map));
        assert_eq!(again.depth(IVec2::new(7, 7)).max(depth) == f32::INFINITY, first == 0);
    }
}

#[test]
fn other_readers_see_the_shadow_map_first() {
    let map = facets(&spot(UVec2::new(150, 140)), 4, 1);
    let (plain, both) = (encode_shadow_map(&map).expect("written"), encode_facet_map(&map).expect("written"));
    let (plain, both) = (headers(&plain), headers(&both));
    let [depths, words] = both.as_slice() else { panic!("{} parts", both.len()) };
    let names =
        |header: &Header| header.channels.list.iter().map(|channel| channel.name.to_string()).collect::<Vec<_>>();
    assert_eq!((names(depths), names(words)), (vec!["Z".to_string()], vec!["facets".to_string()]));
    assert_eq!(depths.own_attributes, plain[0].own_attributes);
    assert_eq!(depths.shared_attributes, plain[0].shared_attributes);
    assert_eq!((depths.blocks, depths.compression), (plain[0].blocks, plain[0].compression));
    let comments = words.own_attributes.comments.as_ref().expect("comments").to_string();
    let expected = format!("umbrage facets 1\nfine=4\nslots=16\nwords={}\ndigest=", map.to_words().len());
    assert!(comments.starts_with(&expected), "{comments}");
}

#[test]
fn pages_and_plain_files_hold_the_depths() {
    let folder = folder("facets");
    let map = facets(&spot(UVec2::new(150, 140)), 2, 2);
    let (path, plain) = (folder.join("facets.exr"), folder.join("plain.exr"));
    write_facet_map(&path, &map).expect("written");
    assert!(read_facet_map(&path).expect("as it was written") == map);
    assert!(read_shadow_map(&path).expect("a shadow map") == Raw::copy_of(&map));
    let (paged, handle) = Paged::open(&path, 2).expect("tiles");
    let whole = TexelRect::of_size(map.view().size());
    assert!(whole.texels().all(|texel| paged.depth(texel).to_bits() == map.depth(texel).to_bits()));
    assert!(handle.error().is_none() && handle.faults() > 4);
    // In whatever it is kept, a map's file of depths is the same.
    write_shadow_map(&plain, &Map::from(map.clone())).expect("written");
    assert!(std::fs::read(&plain).expect("there") == encode_shadow_map(&Raw::copy_of(&map)).expect("written"));
    let refused = read_facet_map(&plain).expect_err("depths").to_string();
    assert!(refused.ends_with("plain.exr: parts is 1: a map of facets has them in a second one"), "{refused}");
    let bytes = std::fs::read(&path).expect("there");
    let refused = decode_deep_map(&bytes, DEFAULT_DEEP_BUDGET).expect_err("flat").to_string();
    assert_eq!(refused, "type is flat: a deep map has several depths per texel");
    let refused = read_facet_map_within(&path, 1000).expect_err("too large").to_string();
    assert!(refused.contains("displayWindow is 150 x 140: more than the allowed 1000 texels"), "{refused}");
    std::fs::write(&path, &bytes[..bytes.len() - 100]).expect("written");
    let refused = read_facet_map(&path).expect_err("cut").to_string();
    assert!(refused.contains("facets.exr: part facets: block 0, "), "{refused}");
}

/// A file of a few tiles, both unrefined and with blocks.
pub fn file() -> &'static (FacetMap, Vec<u8>) {
    static FILE: LazyLock<(FacetMap, Vec<u8>)> = LazyLock::new(|| {
        let map = facets(&spot(UVec2::new(100, 33)), 4, 1);
        let bytes = encode_facet_map(&map).expect("written");
        (map, bytes)
    });
    &FILE
}

/// Whatever comes of it must be an error of one line, or the very map that was written; never a panic.
fn harmless(bytes: &[u8]) {
    if let Ok(map) = read(bytes) {
        assert!(map == file().0, "damage went unnoticed");
    }
    if let Ok(map) = decode_shadow_map(bytes, TEXELS) {
        assert!(map == Raw::copy_of(&file().0), "damage went unnoticed");
    }
}

fn patched(at: usize, with: &[u8]) -> Vec<u8> {
    let mut bytes = file().1.clone();
    bytes[at..at + with.len()].copy_from_slice(with);
    bytes
}

/// Where the second part's attribute begins.
fn second(attribute: &str, kind: &str) -> usize {
    let bytes = &file().1;
    let behind = value(bytes, attribute, kind);
    behind + value(&bytes[behind..], attribute, kind)
}

/// Blocks of depths and of words, and the offset of one.
fn offset(index: usize) -> usize {
    let bytes = &file().1;
    let at = table(bytes, blocks()) + 8 * index;
    u64::from_le_bytes(bytes[at..at + 8].try_into().expect("eight bytes")) as usize
}

fn blocks() -> usize {
    headers(&file().1).iter().map(|header| header.chunk_count).sum()
}

#[test]
fn every_cut_is_an_error() {
    let bytes = &file().1;
    for length in (0..offset(0) + 100).chain((offset(0)..bytes.len()).step_by(41)) {
        assert!(read(&bytes[..length]).is_err(), "cut at {length}");
    }
}

#[test]
fn every_byte_of_headers_and_tables_may_be_anything() {
    let bytes = &file().1;
    for (at, byte) in bytes.iter().enumerate().take(offset(0) + 30) {
        for change in [0x01, 0x80, 0xFF, *byte, byte ^ 0x7F] {
            harmless(&patched(at, &[byte ^ change]));
        }
    }
}

#[test]
fn bytes_of_blocks_may_be_anything() {
    let bytes = &file().1;
    for at in (offset(0)..bytes.len()).step_by(13).chain(offset(blocks() - 1)..offset(blocks() - 1) + 40) {
        harmless(&patched(at, &[bytes[at] ^ 1 << (at % 8)]));
    }
}

#[test]
fn headers_of_the_second_part_that_lie() {
    let data = second("dataWindow", "box2i");
    let window = |sides: [i32; 4]| message(&patched(data, &crate::hostile::words(sides)));
    assert_eq!(
        window([1, 0, 1024, 10]),
        "part facets: dataWindow is 1024 x 11 at 1, 0: empty, too large or not at 0, 0"
    );
    // The library sees that the number of blocks is another.
    assert!(window([0, 0, 1023, i32::MAX - 1]).starts_with("header is unreadable"));
    assert!(window([0, 0, 70_000, 1]).contains("header is unreadable") || window([0, 0, 70_000, 1]).contains("32768"));
    let mut giant = patched(data, &crate::hostile::words([0, 0, 1023, 0xF_FFFF]));
    let count = second("chunkCount", "int");
    giant[count..count + 4].copy_from_slice(&65_536u32.to_le_bytes());
    let giant = message(&giant);
    assert!(giant.starts_with("offset table is ") && giant.ends_with(" blocks need more"), "{giant}");
    let channels = second("channels", "chlist");
    assert_eq!(message(&patched(channels, b"f_cets")), "part facets: channels is f_cets: not the one channel facets");
    assert!(message(&patched(channels + 7, &[2])).starts_with("part facets: channel is F32"));
    assert!(message(&patched(second("compression", "compression"), &[5])).contains("compression is "));
    // The name of a part is for people.
    assert!(read(&patched(second("name", "string"), b"F")).expect("the map") == file().0);
}

#[test]
fn texts_that_lie() {
    let bytes = &file().1;
    let text = second("comments", "string");
    let line = |name: &str| {
        let name = format!("\n{name}=");
        text + bytes[text..].windows(name.len()).position(|window| window == name.as_bytes()).expect("a line")
            + name.len()
    };
    for (name, with, expected) in [
        ("fine", "8", "comments: digest is "),
        ("fine", "0", "comments: digest is "),
        ("fine", "x", "comments: fine is x: not a whole number"),
        ("slots", "12", "comments: digest is "),
        ("slots", "-1", "comments: slots is -1: not a whole number"),
        ("words", "99999", "comments: words is 99999"),
        ("words", "1", "comments: digest is "),
        ("words", "x", "comments: words is x"),
        ("digest", "0123456789", "comments: digest is 0123456789"),
        ("digest", "g", "comments: digest is g"),
    ] {
        let message = message(&patched(line(name), with.as_bytes()));
        assert!(message.starts_with(&format!("part facets: {expected}")), "{name}={with}: {message}");
    }
    let other = message(&patched(text + "umbrage facets ".len(), b"2"));
    assert_eq!(other, "part facets: comments is umbrage facets 2: does not begin with \\\"umbrage facets 1\\\"");
    // What the first part says counts too: the digest of words is over it.
    let seed = message(&patched(value(bytes, "comments", "string") + "umbrage view ".len(), b"2"));
    assert!(seed.starts_with("comments is no view"), "{seed}");
}

#[test]
fn blocks_and_offsets_that_lie() {
    let (map, bytes) = file();
    let (table, last) = (table(bytes, blocks()), blocks() - 1);
    let entry = |index: usize| (offset(index) as u64).to_le_bytes();
    assert!(read(&patched(table, &entry(0))).expect("unchanged") == *map);
    for index in [0, last] {
        for lie in [0, 8, table as u64, bytes.len() as u64, bytes.len() as u64 - 3, u64::MAX, 1 << 63] {
            assert!(read(&patched(table + 8 * index, &lie.to_le_bytes())).is_err(), "{lie}");
        }
    }
    assert!(message(&patched(table, &entry(last))).contains("two blocks in one place"));
    let swapped = message(&patched(table + 8 * (last - 1), &[entry(last), entry(last - 1)].concat()));
    assert!(swapped.ends_with("is 1: the block there should be of part 0"), "{swapped}");
    for (index, part) in [(0, 1), (0, -1), (last, 0), (last, i32::MAX)] {
        let lie = message(&patched(offset(index), &i32::to_le_bytes(part)));
        assert!(
            lie.contains(&format!("is {part}: the block there should be of part {}", usize::from(index == last))),
            "{lie}"
        );
    }
    for length in [-1, 0, 1, i32::MAX, i32::MIN] {
        assert!(read(&patched(offset(last) + 8, &i32::to_le_bytes(length))).is_err(), "{length}");
    }
}

/// Depths that are not those of the facets, with a digest that fits them.
#[test]
fn parts_that_disagree_are_refused() {
    let view = View::orthographic(DVec3::Y, DVec3::ZERO, DVec3::X, 1.0, 0.0, 9.0, UVec2::ONE).expect("valid");
    let map = facets(&view, 1, 1);
    let own = map.depth(IVec2::ZERO);
    let other = encode_shadow_map(&Raw::new(view, vec![own + 1.0]).expect("a depth").with_stored(Stored::Second));
    let other = other.expect("written");
    let mut bytes = encode_facet_map(&map).expect("written");
    let digest = |bytes: &[u8]| bytes.windows(8).position(|window| window == b"\ndigest=").expect("a digest") + 8;
    let (to, from) = (digest(&bytes), digest(&other));
    bytes[to..to + 16].copy_from_slice(&other[from..from + 16]);
    // One texel is not packed.
    let depth =
        bytes.windows(8).position(|window| window == [[4, 0, 0, 0], own.to_le_bytes()].concat()).expect("a depth");
    bytes[depth + 4..depth + 8].copy_from_slice(&(own + 1.0).to_le_bytes());
    assert_eq!(decode_shadow_map(&bytes, 1).expect("a shadow map").depth(IVec2::ZERO), own + 1.0);
    let refused = message(&bytes);
    let expected = format!("channel Z at texel 0, 0 is {}: the facet there is at {own}", own + 1.0);
    assert_eq!(refused, expected);
}

#[test]
fn maps_that_could_not_be_read_again_are_not_written() {
    let view = sun(UVec2::splat(32));
    let tile = |fine: u32| {
        let depths = FacetDepths::of(&view);
        let plane = [Affine::constant(3.0)];
        let cells = FacetCells { planes: &plane, texels: &[0; AREA as usize], blocks: &[] };
        FacetTile::new(&cells, IVec2::ZERO, view.size(), fine, |texel, plane| depths.depth(texel, plane))
    };
    for (made_for, fine, slots, expected) in [
        (4, 9, 4, "part facets: fine is 9: not within 1..=8"),
        (4, 4, 300, "part facets: slots is 300: not within 1..=256"),
        (4, 1, 1, "part facets: tile 0, 0: form is 2: not a form of maps of fine = 1"),
    ] {
        let map = FacetMap::from_tiles(view, Stored::First, fine, slots, vec![tile(made_for)]);
        assert_eq!(encode_facet_map(&map).expect_err("refused").to_string(), expected);
    }
}

#[test]
fn files_of_depths_are_no_maps_of_facets() {
    let bytes = encode_shadow_map(&depths(&spot(UVec2::new(50, 40)))).expect("written");
    assert_eq!(message(&bytes), "parts is 1: a map of facets has them in a second one");
    assert!(decode_facet_map(b"not an EXR file", DEFAULT_FACET_BUDGET).is_err());
    assert!(decode_facet_map(b"", DEFAULT_BUDGET).is_err());
}

/// A map of tiles with one and the same facet.
fn one_facet(view: &View) -> FacetMap {
    let plane = [view.key(0.5 * (view.near() + view.far())), 1e-6, 2e-6].map(f64::to_bits);
    let plane = plane.iter().flat_map(|number| [*number as u32, (*number >> 32) as u32]);
    let tile: Vec<u32> = [1, 1].into_iter().chain(plane).chain([0, 0]).collect();
    let tiles = view.size().map(|side| side.div_ceil(TILE)).element_product() as usize;
    FacetMap::from_words(*view, Stored::First, 1, 1, &tile.repeat(tiles)).expect("a map")
}

#[test]
fn large_facets_take_next_to_no_room() {
    let map = one_facet(&spot(UVec2::splat(256)));
    let (file, plain) = (encode_facet_map(&map).expect("written"), encode_shadow_map(&map).expect("written"));
    assert!(file.len() < 256 * 256 * 4 / 2, "{} bytes", file.len());
    assert!(file.len() < plain.len() + 4000, "{} bytes for facets", file.len() - plain.len());
}

/// Tiles that are larger than the map: more words than a budget of its texels is for.
#[test]
fn more_words_than_are_allowed_are_refused() {
    let view = sun(UVec2::new(32_768, 1));
    let tile: Vec<u32> = std::iter::once(3).chain([2.5f32.to_bits(); AREA as usize]).collect();
    let map = FacetMap::from_words(view, Stored::First, 1, 1, &tile.repeat(1024)).expect("a map");
    let bytes = encode_facet_map(&map).expect("written");
    assert!(decode_facet_map(&bytes, DEFAULT_FACET_BUDGET).expect("as it was written") == map);
    let refused = decode_facet_map(&bytes, 32_768).expect_err("too many").to_string();
    assert_eq!(refused, "part facets: dataWindow is 1024 x 1025: more than the allowed 1048576 words");
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(1000))]
    #[test]
    fn any_damage_is_survived(hits in prop::collection::vec((any::<prop::sample::Index>(), any::<u8>()), 1..6)) {
        let mut bytes = file().1.clone();
        for (at, value) in hits {
            let at = at.index(bytes.len());
            bytes[at] = value;
        }
        harmless(&bytes);
    }

    #[test]
    fn rubbish_behind_a_good_start_is_survived(keep in 0usize..5000, rubbish in prop::collection::vec(any::<u8>(), 0..600)) {
        let mut bytes = file().1.clone();
        bytes.truncate(keep);
        bytes.extend(rubbish);
        prop_assert!(read(&bytes).is_err());
    }
}
