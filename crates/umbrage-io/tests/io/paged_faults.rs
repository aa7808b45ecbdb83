//! What a paged map says of a file that is not as it should be (R87-20): at open what can be known then, later by its handle.

use crate::hostile::{table, value, words};
use crate::shadow_maps::foreign;
use crate::{folder, map, spot, sun};
use exr::prelude::{Blocks, Compression};
use glam::{IVec2, UVec2};
use std::path::PathBuf;
use umbrage_depth::{DepthMap, Raw};
use umbrage_io::{Paged, PagedHandle, encode_shadow_map, write_bytes, write_shadow_map};

/// Four tiles, the last ones cut: 75 × 70 texels from (50, 46) on.
fn file() -> (Raw, Vec<u8>) {
    let raw = map(&spot(UVec2::new(150, 140)));
    let bytes = encode_shadow_map(&raw).expect("written");
    (raw, bytes)
}

/// A texel with a surface in each of the tiles.
const IN_TILE: [IVec2; 4] = [IVec2::new(52, 50), IVec2::new(116, 50), IVec2::new(52, 112), IVec2::new(116, 112)];

fn on_disk(test: &str, bytes: &[u8]) -> PathBuf {
    let path = folder(&format!("paged_{test}")).join("lamp.exr");
    write_bytes(&path, bytes).expect("written");
    path
}

/// Opening fails with one line that names the file.
fn refused(test: &str, bytes: &[u8], pages: usize) -> String {
    let path = on_disk(test, bytes);
    let line = Paged::open(&path, pages).expect_err("refused").to_string();
    assert!(line.contains("lamp.exr: ") && !line.contains('\n'), "{line}");
    line
}

/// The handle's line.
fn told(handle: &PagedHandle) -> String {
    let line = handle.error().expect("a fault").to_string();
    assert!(line.contains(".exr: block ") && !line.contains('\n'), "{line}");
    line
}

/// A tile that is good and one that is not: the first and the last, or the other way round.
fn damage_is_told(test: &str, bytes: &[u8], [good, bad]: [usize; 2], expected: &str) {
    let (raw, _) = file();
    let path = on_disk(test, bytes);
    let (paged, handle) = Paged::open(&path, 4).expect("header and table are whole");
    assert_eq!(paged.depth(IN_TILE[good]), raw.depth(IN_TILE[good]));
    assert!(handle.error().is_none());
    assert_eq!(paged.depth(IN_TILE[bad]), f32::INFINITY);
    let line = told(&handle);
    let block = format!("block {}, {} at byte ", bad % 2, bad / 2);
    assert!(line.contains(&block) && line.contains(expected), "{line} should say {expected}");
    // It is final, for resident tiles too, and the first one stays.
    for texel in IN_TILE {
        assert_eq!(paged.depth(texel), f32::INFINITY);
    }
    assert_eq!((handle.faults(), told(&handle)), (2, line));
}

#[test]
fn r87_20_a_damaged_tile_is_told_by_the_handle_and_looks_like_nothing() {
    let (_, bytes) = file();
    let at = table(&bytes, 4);
    let place =
        |entry: usize| u64::from_le_bytes(bytes[at + 8 * entry..][..8].try_into().expect("eight bytes")) as usize;
    let (first, last) = (place(0), place(3));
    let with = |place: usize, patch: &[u8]| {
        let mut bytes = bytes.clone();
        bytes[place..place + patch.len()].copy_from_slice(patch);
        bytes
    };
    let last_is_told = |test: &str, bytes: &[u8], expected: &str| damage_is_told(test, bytes, [0, 3], expected);
    last_is_told("tile", &with(last, &words([0, 0, 0, 0])), "is [0, 0, 0, 0]: the block there should be [1, 1, 0, 0]");
    last_is_told("level", &with(last + 8, &[1]), "should be [1, 1, 0, 0]");
    last_is_told("length", &with(last + 16, &(-1i32).to_le_bytes()), "is -1: no such number of bytes");
    last_is_told("cut", &bytes[..bytes.len() - 1], "not a length within the file");
    last_is_told("head", &bytes[..last + 10], "is cut off: level x");
    // The table may point anywhere inside the file.
    last_is_told("table", &with(at + 24, &(bytes.len() as u64 - 1).to_le_bytes()), "is cut off: tile x");
    damage_is_told("packed", &with(first + 20, &[0xFF; 40]), [3, 0], "is damaged: ");
}

#[test]
fn c_5_a_nan_in_a_page_is_named() {
    let raw = Raw::new(sun(UVec2::new(2, 1)), vec![1.0, 2.0]).expect("valid");
    let mut bytes = encode_shadow_map(&raw).expect("written");
    // Eight bytes do not get smaller: they stand as they are, at the end.
    let at = bytes.len() - 4;
    for (value, name) in [(f32::NAN, "NaN"), (f32::NEG_INFINITY, "-inf")] {
        bytes[at..].copy_from_slice(&value.to_le_bytes());
        let (paged, handle) = Paged::open(&on_disk("nan", &bytes), 1).expect("opened");
        assert_eq!(paged.depth(IVec2::ZERO), f32::INFINITY);
        let line = told(&handle);
        assert!(line.ends_with(&format!("texel (1, 0) holds {name}, which is not a depth")), "{line}");
    }
    // Far is nothing; other depths in place of the written ones are what only the digest of the whole map would tell.
    for (value, wanted) in [(1e30f32, f32::INFINITY), (1e30f32.next_down(), 1e30f32.next_down()), (7.0, 7.0)] {
        bytes[at..].copy_from_slice(&value.to_le_bytes());
        let (paged, handle) = Paged::open(&on_disk("far", &bytes), 1).expect("opened");
        assert_eq!((paged.depth(IVec2::X), handle.error().is_none()), (wanted, true));
    }
}

#[test]
fn r87_20_what_is_wrong_before_the_tiles_is_refused_at_open() {
    let (_, bytes) = file();
    assert!(refused("refused", &bytes, 0).ends_with("pages is 0: one must be kept at least"));
    let at = table(&bytes, 4);
    for length in (0..at + 33).step_by(41).chain([at - 1, at, at + 8, at + 31, at + 32]) {
        refused("refused", &bytes[..length], 1);
    }
    let patched = |at: usize, with: &[u8]| {
        let mut bytes = bytes.clone();
        bytes[at..at + with.len()].copy_from_slice(with);
        refused("refused", &bytes, 1)
    };
    for lie in [0u64, 8, at as u64, bytes.len() as u64, u64::MAX, 1 << 63] {
        assert!(patched(at + 8, &lie.to_le_bytes()).contains("offset table is "));
    }
    assert!(patched(at, &bytes[at + 8..at + 16]).contains("two blocks in one place"));
    assert!(patched(value(&bytes, "compression", "compression"), &[5]).contains("compression is "));
    assert!(patched(value(&bytes, "dataWindow", "box2i"), &words([-1, 0, 70, 70])).contains("dataWindow is "));
    assert!(patched(value(&bytes, "displayWindow", "box2i"), &words([0, 0, 99_999, 9])).contains("displayWindow is "));
    let view = spot(UVec2::splat(40));
    let lines = foreign(&view, Blocks::ScanLines, Compression::ZIP16);
    assert!(refused("refused", &lines, 1).ends_with("tiles is missing: scan lines cannot be paged"));
    let absent = folder("paged_absent").join("no\nlamp.exr");
    let line = Paged::open(&absent, 1).expect_err("absent").to_string();
    assert!(line.contains("no\\nlamp.exr: cannot open") && !line.contains('\n'), "{line}");
}

/// A header that never ends is given up, a table of millions of tiles is not taken on trust.
#[test]
fn r87_20_what_is_read_at_open_is_bounded() {
    let (_, bytes) = file();
    let at = value(&bytes, "comments", "string") - 4;
    let mut long = bytes[..at].to_vec();
    long.extend((5i32 << 20).to_le_bytes());
    long.resize(at + (5 << 20), b'#');
    long.extend(&bytes[at..]);
    assert!(refused("bounded", &long, 1).ends_with("header is unreadable: it passes 4194304 bytes"));
    // The count of blocks would tell first, were it not for the misspelling.
    let mut many = bytes.clone();
    let count = value(&bytes, "chunkCount", "int") - "chunkCount_int_____".len();
    many[count] = b'C';
    for window in ["dataWindow", "displayWindow"] {
        let window = value(&bytes, window, "box2i");
        many[window..window + 16].copy_from_slice(&words([0, 0, 32_767, 32_767]));
    }
    let tiles = value(&bytes, "tiles", "tiledesc");
    many[tiles..tiles + 8].copy_from_slice(&words([1, 1, 0, 0])[..8]);
    assert!(refused("bounded", &many, 1).ends_with("offset table is 1073741824: more than the allowed 4194304 blocks"));
    many[tiles..tiles + 8].copy_from_slice(&words([64, 64, 0, 0])[..8]);
    assert!(refused("bounded", &many, 1).ends_with("262144 blocks need more"));
}

#[test]
fn r87_20_a_file_that_shrinks_after_it_was_opened_latches() {
    let (raw, bytes) = file();
    let at = table(&bytes, 4);
    for length in [bytes.len() as u64 - 5, at as u64 + 40, 3, 0] {
        let path = on_disk("shrinks", &bytes);
        let (paged, handle) = Paged::open(&path, 4).expect("whole so far");
        let whole = length > at as u64 + 2000;
        if whole {
            assert_eq!(paged.depth(IN_TILE[0]), raw.depth(IN_TILE[0]));
        }
        std::fs::OpenOptions::new().write(true).open(&path).and_then(|file| file.set_len(length)).expect("shortened");
        assert_eq!(paged.depth(IN_TILE[3]), f32::INFINITY);
        assert!(told(&handle).contains("block 1, 1 at byte "));
        assert_eq!(paged.depth(IN_TILE[0]), f32::INFINITY);
    }
}

/// The open file is the one that was opened, as long as nobody writes into it.
#[cfg(unix)]
#[test]
fn r87_20_a_file_that_is_replaced_or_removed_after_it_was_opened_stays_as_it_was() {
    let (raw, bytes) = file();
    let path = on_disk("replaced", &bytes);
    let (paged, handle) = Paged::open(&path, 1).expect("opened");
    write_shadow_map(&path, &map(&sun(UVec2::new(150, 140)))).expect("replaced");
    assert_eq!(paged.depth(IN_TILE[1]), raw.depth(IN_TILE[1]));
    std::fs::remove_file(&path).expect("removed");
    assert_eq!(Raw::copy_of(&paged), raw);
    assert!(handle.error().is_none());
}

/// Whichever byte of a tile is hit: its depths come out as they were or others, or the handle tells; never a panic.
#[test]
fn r87_20_any_damage_to_tiles_is_survived() {
    let (_, bytes) = file();
    let first = table(&bytes, 4) + 32;
    let mut told_of = 0;
    for round in 0..400u32 {
        let mut damaged = bytes.clone();
        for hit in 0..3 {
            let bits = umbrage_plane::mix32(round * 3 + hit);
            let at = first + bits as usize % (bytes.len() - first);
            damaged[at] ^= 1 << (bits >> 29);
        }
        let path = on_disk("damage", &damaged);
        let (paged, handle) = Paged::open(&path, 2).expect("the tiles are not read yet");
        for texel in IN_TILE {
            let depth = paged.depth(texel);
            assert!(!depth.is_nan() && (handle.error().is_none() || depth == f32::INFINITY));
        }
        if handle.error().is_some() {
            told(&handle);
            told_of += 1;
        }
    }
    assert!(told_of > 200, "{told_of} of 400");
}
