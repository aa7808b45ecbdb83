use crate::deep_maps::{bits, deep};
use crate::hostile::{table, value};
use crate::{spot, sun};
use glam::{UVec2, Vec3};
use proptest::prelude::*;
use std::sync::LazyLock;
use umbrage_depth::{DeepMap, Step};
use umbrage_io::{DEFAULT_DEEP_BUDGET, Fault, decode_deep_map, encode_deep_map};

const STEPS: u64 = 1 << 16;

/// A map whose file has 21 rows.
fn file() -> (DeepMap, Vec<u8>) {
    static FILE: LazyLock<(DeepMap, Vec<u8>)> = LazyLock::new(|| {
        let map = deep(&spot(UVec2::new(14, 31)), 0.0, false);
        let bytes = encode_deep_map(&map).expect("written");
        (map, bytes)
    });
    FILE.clone()
}

/// One texel with one surface: its row stands unpacked at the end of the file, from its number on.
fn single() -> (Vec<u8>, usize) {
    let steps = vec![Step { depth: 2.0, passes: Vec3::splat(0.5) }];
    let bytes = encode_deep_map(&DeepMap::new(sun(UVec2::ONE), 0.0, [steps]).expect("valid")).expect("written");
    let row = bytes.len() - 12 - 4 - 28;
    (bytes, row)
}

/// The error, if it is one, is one line.
fn survives(bytes: &[u8]) -> Result<DeepMap, Fault> {
    let read = decode_deep_map(bytes, STEPS);
    if let Err(fault) = &read {
        let line = fault.to_string();
        assert!(!line.contains('\n') && !fault.field.is_empty(), "{line}");
    }
    read
}

/// Whatever comes of it must be an error of one line, or the very map that was written; never a panic.
fn harmless(bytes: &[u8], written: &DeepMap) {
    if let Ok(map) = survives(bytes) {
        assert!(bits(&map) == bits(written) && map.epsilon() == written.epsilon(), "damage went unnoticed");
    }
}

#[test]
fn every_cut_is_an_error() {
    let (_, bytes) = file();
    for length in 0..bytes.len() {
        assert!(survives(&bytes[..length]).is_err(), "cut at {length}");
    }
}

#[test]
fn every_byte_may_be_anything() {
    let (map, bytes) = file();
    for at in 0..bytes.len() {
        for change in [0x01, 0xFF, bytes[at]] {
            let mut damaged = bytes.clone();
            damaged[at] ^= change;
            harmless(&damaged, &map);
        }
    }
}

#[test]
fn every_byte_of_an_unpacked_row_may_be_anything() {
    let (bytes, _) = single();
    let map = decode_deep_map(&bytes, STEPS).expect("undamaged");
    for at in 0..bytes.len() {
        for bit in 0..8 {
            let mut damaged = bytes.clone();
            damaged[at] ^= 1 << bit;
            harmless(&damaged, &map);
        }
    }
}

#[test]
fn counts_and_lengths_that_lie() {
    let (bytes, row) = single();
    let patched = |at: usize, with: &[u8]| {
        let mut bytes = bytes.clone();
        bytes[at..at + with.len()].copy_from_slice(with);
        survives(&bytes).map(|_| ()).map_err(|fault| fault.to_string())
    };
    let refused = |at: usize, with: &[u8], expected: &str| {
        let message = patched(at, with).expect_err(expected);
        assert!(message.starts_with("block 0, 0 at byte ") && message.contains(expected), "{message}");
    };
    assert_eq!(patched(row, &0i32.to_le_bytes()), Ok(()));
    for number in [-1, 1, i32::MIN, i32::MAX] {
        refused(row, &i32::to_le_bytes(number), "the row there should be 0");
    }
    for (at, what) in [(row + 4, "table"), (row + 12, "samples")] {
        for length in [17, 1 << 20, 1 << 40, u64::MAX, 1 << 63] {
            refused(at, &u64::to_le_bytes(length), "not a length within the file");
        }
        for length in [0, 1, 3] {
            assert!(patched(at, &u64::to_le_bytes(length)).is_err(), "{what} of {length}");
        }
    }
    for length in [0, 1, 11, 13, 1 << 30, u64::MAX] {
        refused(row + 20, &u64::to_le_bytes(length), "1 samples need another length");
    }
    for count in [0, 2, 65_536] {
        refused(row + 28, &i32::to_le_bytes(count), &format!("{count} samples need another length"));
    }
    for count in [65_537, i32::MAX] {
        refused(row + 28, &i32::to_le_bytes(count), "more samples than are allowed in all");
    }
    for count in [-1, i32::MIN] {
        refused(row + 28, &i32::to_le_bytes(count), "numbers of samples that fall");
    }
    // A count and lengths that agree: the file cannot hold so much.
    let mut giant = bytes.clone();
    giant[row + 28..row + 32].copy_from_slice(&60_000i32.to_le_bytes());
    giant[row + 20..row + 28].copy_from_slice(&720_000u64.to_le_bytes());
    let message = survives(&giant).expect_err("12 bytes").to_string();
    assert!(message.contains("no such number of bytes packs 720000"), "{message}");
    refused(row + 32, &0.25f32.to_le_bytes(), "channel A is 0.25: not what belongs to the channels named passes");
}

#[test]
fn steps_that_are_no_map_are_named() {
    let (bytes, row) = single();
    for (at, with) in [(row + 36, f32::NAN), (row + 36, f32::NEG_INFINITY), (row + 40, f32::NAN), (row + 40, -0.5)] {
        let mut bytes = bytes.clone();
        bytes[at..at + 4].copy_from_slice(&with.to_le_bytes());
        assert!(survives(&bytes).is_err(), "{with}");
    }
    let mut bytes = bytes.clone();
    bytes[row + 36..row + 40].copy_from_slice(&2.5f32.to_le_bytes());
    assert!(survives(&bytes).expect_err("another depth").field.contains("digest"));
}

#[test]
fn forms_that_are_no_deep_map() {
    let (_, bytes) = file();
    let patched = |at: usize, with: &[u8]| {
        let mut bytes = bytes.clone();
        bytes[at..at + with.len()].copy_from_slice(with);
        survives(&bytes).expect_err("refused").to_string()
    };
    let list = value(&bytes, "channels", "chlist");
    let channel = |name: &str| {
        let name = format!("{name}\0");
        let at = bytes[list..].windows(name.len()).position(|window| window == name.as_bytes()).expect("there");
        list + at
    };
    for (code, rows) in [(3u8, 16), (4, 32), (5, 16), (6, 32), (7, 32), (8, 32), (9, 256)] {
        let mut bytes = bytes.clone();
        let at = value(&bytes, "compression", "compression");
        bytes[at] = code;
        let chunks = 21u32.div_ceil(rows);
        let at = value(&bytes, "chunkCount", "int");
        bytes[at..at + 4].copy_from_slice(&chunks.to_le_bytes());
        let message = survives(&bytes).expect_err("not for deep data").to_string();
        assert!(message.starts_with("compression is "), "{message}");
    }
    assert_eq!(
        patched(value(&bytes, "type", "string"), b"sc"),
        "header is unreadable: invalid: block type attribute value"
    );
    assert!(patched(value(&bytes, "version", "int"), &[2]).starts_with("version is Some(2)"));
    assert!(patched(channel("Z"), b"Q").ends_with("no Z, the depth of a sample"));
    assert!(patched(channel("Z") + 2, &[1]).starts_with("channel Z is F16"));
    assert!(patched(channel("Z") + 2, &[0]).starts_with("channel Z is of whole numbers"));
    assert!(patched(channel("Z") + 10, &[2]).starts_with("channel Z sampling is"));
    // Without red there are only the opacities, whose rounded products are not what was written.
    assert!(patched(channel("passes.R"), b"q").starts_with("comments: digest is"));
    let mut bare = bytes.clone();
    for name in ["passes.R", "AR", "A"] {
        bare[channel(name)] = b'q';
    }
    assert!(survives(&bare).expect_err("no opacity").to_string().ends_with("the opacity of a sample"));
    let epsilon = value(&bytes, "epsilon", "float");
    for with in [0.5, -1.0, f32::NAN] {
        let message = patched(epsilon, &f32::to_le_bytes(with));
        assert!(message.contains("digest") || message.contains("samples"), "{message}");
    }
}

#[test]
fn offsets_that_lie() {
    let (map, bytes) = file();
    let rows = 21;
    let at = table(&bytes, rows);
    let entry = |index: usize| bytes[at + 8 * index..][..8].to_vec();
    let patched = |at: usize, with: &[u8]| {
        let mut bytes = bytes.clone();
        bytes[at..at + with.len()].copy_from_slice(with);
        survives(&bytes)
    };
    assert_eq!(bits(&patched(at, &entry(0)).expect("unchanged")), bits(&map));
    for lie in [0u64, 8, at as u64, bytes.len() as u64, bytes.len() as u64 - 3, u64::MAX, 1 << 63] {
        assert!(patched(at + 8, &lie.to_le_bytes()).is_err(), "{lie}");
    }
    let message = patched(at, &[entry(1), entry(0)].concat()).expect_err("rows in each other's place").to_string();
    assert!(message.contains("the row there should be 10"), "{message}");
    assert!(patched(at, &entry(1)).expect_err("a row twice").to_string().contains("two blocks in one place"));
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(2000))]
    #[test]
    fn any_damage_is_survived(hits in prop::collection::vec((any::<prop::sample::Index>(), any::<u8>()), 1..6)) {
        let (map, mut bytes) = file();
        for (at, value) in hits {
            let at = at.index(bytes.len());
            bytes[at] = value;
        }
        harmless(&bytes, &map);
    }

    #[test]
    fn rubbish_behind_a_good_start_is_survived(keep in 0usize..4000, rubbish in prop::collection::vec(any::<u8>(), 0..600)) {
        let (_, mut bytes) = file();
        bytes.truncate(keep);
        bytes.extend(rubbish);
        prop_assert!(survives(&bytes).is_err());
        prop_assert!(decode_deep_map(&bytes, DEFAULT_DEEP_BUDGET).is_err());
    }
}
