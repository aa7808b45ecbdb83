use crate::{map, spot, sun};
use glam::UVec2;
use proptest::prelude::*;
use std::sync::LazyLock;
use umbrage_depth::Raw;
use umbrage_io::{DEFAULT_BUDGET, Fault, decode_shadow_map, encode_shadow_map};

const TEXELS: u64 = 1 << 16;

fn file() -> (Raw, Vec<u8>) {
    static FILE: LazyLock<(Raw, Vec<u8>)> = LazyLock::new(|| {
        let raw = map(&spot(UVec2::new(150, 140)));
        let bytes = encode_shadow_map(&raw).expect("written");
        (raw, bytes)
    });
    FILE.clone()
}

/// Takes from a file all that says that it is one of ours: what is left is a file of another maker.
pub(crate) fn disown(bytes: &mut [u8]) {
    let digest = bytes.windows(8).position(|part| part == b"\ndigest=").expect("the digest is there");
    for at in [value(bytes, "comments", "string"), digest + 1, value(bytes, "software", "string")] {
        bytes[at] = b'U';
    }
}

/// Whatever comes of it must be an error of one line, or the very map that was written; never a panic.
fn harmless(bytes: &[u8]) {
    if let Ok(map) = survives(bytes) {
        assert!(map == file().0, "damage went unnoticed");
    }
}

/// The error, if it is one, is one line.
fn survives(bytes: &[u8]) -> Result<Raw, Fault> {
    let read = decode_shadow_map(bytes, TEXELS);
    if let Err(fault) = &read {
        let line = fault.to_string();
        assert!(!line.contains('\n') && !fault.field.is_empty(), "{line}");
    }
    read
}

/// Where the bytes of an attribute's value begin.
pub(crate) fn value(bytes: &[u8], attribute: &str, kind: &str) -> usize {
    let name = format!("{attribute}\0{kind}\0");
    let at = bytes.windows(name.len()).position(|window| window == name.as_bytes()).expect("the attribute is there");
    at + name.len() + 4
}

/// Where the offset table begins: at the value that points just behind a table of `blocks` entries.
pub(crate) fn table(bytes: &[u8], blocks: usize) -> usize {
    (0..bytes.len() - 8)
        .find(|at| bytes[*at..*at + 8] == ((at + 8 * blocks) as u64).to_le_bytes())
        .expect("the first block follows the table")
}

fn patched(at: usize, with: &[u8]) -> Result<Raw, Fault> {
    let (_, mut bytes) = file();
    bytes[at..at + with.len()].copy_from_slice(with);
    survives(&bytes)
}

pub(crate) fn words(words: [i32; 4]) -> Vec<u8> {
    words.into_iter().flat_map(i32::to_le_bytes).collect()
}

#[test]
fn every_cut_is_an_error() {
    let (_, bytes) = file();
    for length in (0..2500.min(bytes.len())).chain((2500..bytes.len()).step_by(37)) {
        assert!(survives(&bytes[..length]).is_err(), "cut at {length}");
    }
}

#[test]
fn every_byte_of_the_header_and_the_table_may_be_anything() {
    let (_, bytes) = file();
    let end = table(&bytes, 4) + 8 * 4 + 24;
    for at in 0..end {
        for change in [0x01, 0x80, 0xFF, bytes[at], bytes[at] ^ 0x7F] {
            let mut damaged = bytes.clone();
            damaged[at] ^= change;
            harmless(&damaged);
        }
    }
}

#[test]
fn windows_that_lie() {
    let (_, bytes) = file();
    let (data, display) = (value(&bytes, "dataWindow", "box2i"), value(&bytes, "displayWindow", "box2i"));
    let cases = [
        (data, [0, 0, -1, -1]),
        (data, [-1, 0, 70, 70]),
        (data, [100, 100, 150, 139]),
        (data, [0, 0, i32::MAX, i32::MAX]),
        (data, [i32::MIN, i32::MIN, i32::MAX, i32::MAX]),
        (data, [0, 0, 149, 139]),
        (display, [0, 0, 148, 139]),
        (display, [0, 0, 32_767, 32_767]),
        (display, [0, 0, 1_000_000_000, 1_000_000_000]),
        (display, [i32::MIN, 0, i32::MAX, 10]),
        (display, [-100, -100, 49, 39]),
    ];
    for (at, corners) in cases {
        assert!(patched(at, &words(corners)).is_err(), "{corners:?}");
    }
}

#[test]
fn offsets_that_lie() {
    let (raw, bytes) = file();
    let at = table(&bytes, 4);
    let entry = |index: usize| bytes[at + 8 * index..][..8].to_vec();
    assert_eq!(patched(at, &entry(0)).expect("unchanged"), raw);
    for lie in [0u64, 8, at as u64, bytes.len() as u64, bytes.len() as u64 - 3, u64::MAX, 1 << 63] {
        assert!(patched(at + 8, &lie.to_le_bytes()).is_err(), "{lie}");
    }
    let message = patched(at, &entry(1)).expect_err("a tile twice").to_string();
    assert!(message.contains("two blocks in one place"), "{message}");
    let swapped = [entry(1), entry(0)].concat();
    let message = patched(at, &swapped).expect_err("tiles in each other's place").to_string();
    assert!(message.contains("should be [0, 0, 0, 0]"), "{message}");
}

/// A block of its own that repeats another tile's coordinates: one tile twice, one missing.
#[test]
fn a_tile_twice_and_one_missing_is_an_error() {
    let (_, bytes) = file();
    let at = table(&bytes, 4);
    let second = u64::from_le_bytes(bytes[at + 8..at + 16].try_into().expect("eight bytes")) as usize;
    assert!(patched(second, &words([0, 0, 0, 0])).is_err());
    assert!(patched(second, &words([1, 0, 1, 1])).is_err());
    assert!(patched(second, &words([-1, 0, 0, 0])).is_err());
    for length in [-1i32, 0, 1, 3, i32::MAX, i32::MIN] {
        assert!(patched(second + 16, &length.to_le_bytes()).is_err(), "{length}");
    }
}

#[test]
fn forms_that_are_no_shadow_map() {
    let (_, bytes) = file();
    let compression = value(&bytes, "compression", "compression");
    for (code, name) in [(5u8, "PXR24"), (6, "B44"), (7, "B44A"), (8, "DWAA"), (9, "DWAB")] {
        let message = patched(compression, &[code]).expect_err(name).to_string();
        assert!(message.starts_with("compression is "), "{message}");
    }
    let channels = value(&bytes, "channels", "chlist");
    assert_eq!(&bytes[channels..channels + 6], b"Z\0\x02\0\0\0");
    for (at, with, expected) in [
        (channels, &b"Y"[..], "channels is Y"),
        (channels + 2, &[1], "block 0, 0 at byte"),
        (channels + 2, &[0], "not of floats"),
        (channels + 10, &[2], "sampling"),
    ] {
        let message = patched(at, with).expect_err(expected).to_string();
        assert!(message.contains(expected), "{message}");
    }
    let tiles = value(&bytes, "tiles", "tiledesc");
    assert!(patched(tiles, &words([0, 64, 0, 0])[..8]).is_err());
    assert!(patched(tiles, &[0xFF; 8]).is_err());
    // The count of blocks would tell on the levels first, were it not for the misspelling.
    let (_, mut levels) = file();
    levels[tiles + 8] = 1;
    let count = value(&bytes, "chunkCount", "int") - "chunkCount_int_____".len();
    levels[count] = b'C';
    assert!(survives(&levels).expect_err("levels").to_string().contains("one level"));
    assert!(survives(b"").is_err());
    assert!(survives(b"not an EXR file at all, but long enough to be one").is_err());
}

/// The text is read before the matrices: every one of its lines must hold what it should.
#[test]
fn texts_that_lie() {
    let (_, bytes) = file();
    let text = value(&bytes, "comments", "string");
    let line = |name: &str| {
        let name = format!("\n{name}=");
        let at = bytes[text..].windows(name.len()).position(|window| window == name.as_bytes()).expect("a line");
        text + at + name.len()
    };
    for (name, with, expected) in [
        ("world_to_eye", "1e99999", "not finite"),
        ("world_to_eye", "x", "not 16 numbers"),
        ("perspective", "-", "not positive"),
        ("perspective", "  ", "not 2 numbers"),
        ("near", "9e9", "near"),
        ("far", "-", "far"),
        ("size", "149 140", "displayWindow is 150 x 140"),
        ("size", "99999999", "not two whole numbers"),
        ("kind", "exial", "not axial, screen or radial"),
        ("sampling", "middle", "neither centre nor jittered"),
        ("rules", "dark", "not five of"),
        ("digest", "g", "invalid digit"),
        ("digest", "0123456789", "not what was written"),
        ("cone_cos", "-", "not within [0, 1)"),
    ] {
        let fault = patched(line(name), with.as_bytes()).expect_err(expected);
        assert!(fault.field.starts_with("comments: "), "{fault}");
        assert!(fault.to_string().contains(expected), "{fault} should say {expected}");
    }
    let message = patched(line("near") - 5, b"mear=").expect_err("no near").to_string();
    assert_eq!(message, "comments: near is missing: a view needs it");
    // Without the signature the matrices speak.
    assert!(patched(text, b"U").expect_err("ours without a view").to_string().contains("one of umbrage"));
    let (_, mut foreign) = file();
    disown(&mut foreign);
    assert!(survives(&foreign).is_ok());
    for (attribute, kind, with) in [
        ("worldToCamera", "m44f", f32::NAN.to_le_bytes()),
        ("worldToCamera", "m44f", 2f32.to_le_bytes()),
        ("worldToNDC", "m44f", f32::INFINITY.to_le_bytes()),
        ("worldToNDC", "m44f", 100f32.to_le_bytes()),
        ("near", "float", (-1f32).to_le_bytes()),
        ("far", "float", f32::NAN.to_le_bytes()),
    ] {
        let (_, mut bytes) = file();
        disown(&mut bytes);
        let at = value(&bytes, attribute, kind);
        bytes[at..at + 4].copy_from_slice(&with);
        assert!(survives(&bytes).is_err(), "{attribute}");
    }
}

#[test]
fn a_nan_depth_is_named() {
    let raw = Raw::new(sun(UVec2::new(2, 1)), vec![1.0, 2.0]).expect("valid");
    let mut bytes = encode_shadow_map(&raw).expect("written");
    // Eight bytes do not get smaller: they stand as they are, at the end.
    let at = bytes.len() - 4;
    assert_eq!(bytes[at..], 2f32.to_le_bytes());
    bytes[at..].copy_from_slice(&f32::NAN.to_le_bytes());
    assert!(decode_shadow_map(&bytes, DEFAULT_BUDGET).expect_err("damaged").field.contains("digest"));
    disown(&mut bytes);
    let message = decode_shadow_map(&bytes, DEFAULT_BUDGET).expect_err("not a depth").to_string();
    assert!(message.starts_with("channel Z is") && message.contains("(1, 0)"), "{message}");
}

/// A file of another maker is read without a digest and with a view of lower precision, so that damage would go unnoticed.
#[test]
fn two_damaged_bytes_do_not_make_a_file_of_another_maker() {
    let raw = map(&spot(UVec2::new(4, 4)));
    let bytes = encode_shadow_map(&raw).expect("written");
    let about = |name: &str, behind: usize| {
        let value = value(&bytes, name, "string");
        value - name.len() - "\0string\0".len() - 4..value + behind
    };
    for first in about("comments", 16) {
        for second in about("software", 7) {
            for damage in [0, 1, b'a', 255] {
                let mut bytes = bytes.clone();
                (bytes[first], bytes[second]) = (damage, damage);
                if let Ok(map) = survives(&bytes) {
                    assert!(map == raw, "bytes {first} and {second} set to {damage}");
                }
            }
        }
    }
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(2000))]
    #[test]
    fn any_damage_is_survived(hits in prop::collection::vec((any::<prop::sample::Index>(), any::<u8>()), 1..6)) {
        let (_, mut bytes) = file();
        for (at, value) in hits {
            let at = at.index(bytes.len());
            bytes[at] = value;
        }
        harmless(&bytes);
    }

    #[test]
    fn rubbish_behind_a_good_start_is_survived(keep in 0usize..2500, rubbish in prop::collection::vec(any::<u8>(), 0..600)) {
        let (_, mut bytes) = file();
        bytes.truncate(keep);
        bytes.extend(rubbish);
        prop_assert!(survives(&bytes).is_err());
    }
}
