//! Several maps in one file.

use crate::deep_maps::{bits as deep_bits, deep};
use crate::hostile::{table, value};
use crate::{folder, map, spot, sun};
use exr::meta::MetaData;
use glam::UVec2;
use std::sync::LazyLock;
use umbrage_depth::{Map, Raw, Stored};
use umbrage_io::{
    CUBE_FACES, Fault, MapOptions, Maps, NamedMap, Paged, decode_map, decode_maps, decode_shadow_map, encode_facet_map,
    encode_maps, encode_shadow_map, light_of, read_maps, write_maps,
};

fn named(name: &str, map: impl Into<Map>) -> NamedMap {
    NamedMap { name: name.into(), map: map.into(), light_cone: None }
}

fn facets() -> Map {
    crate::facets::file().0.clone().into()
}

/// Maps of every kind and of several sizes.
fn all() -> Vec<NamedMap> {
    let flat = |size| map(&spot(size)).with_stored(Stored::Midpoint);
    vec![
        named("key", flat(UVec2::new(90, 40))),
        named("key.001", facets()),
        NamedMap { light_cone: Some(0.125), ..named("fill.ahead", flat(UVec2::new(30, 71))) },
        named("glass", deep(&spot(UVec2::new(33, 20)), 0.05, false)),
        named("sun", facets()),
        named("grey", deep(&sun(UVec2::new(20, 33)), 0.0, true)),
    ]
}

fn file() -> &'static [u8] {
    static FILE: LazyLock<Vec<u8>> = LazyLock::new(|| encode_maps(&all()).expect("written"));
    &FILE
}

fn same(a: &NamedMap, b: &NamedMap) -> bool {
    let maps = match (&a.map, &b.map) {
        (Map::Facets(a), Map::Facets(b)) => a == b,
        (Map::Deep(a), Map::Deep(b)) => a == b && deep_bits(a) == deep_bits(b),
        (Map::Raw(a), Map::Raw(b)) => {
            a == b && a.depths().iter().zip(b.depths()).all(|(a, b)| a.to_bits() == b.to_bits())
        }
        _ => false,
    };
    maps && a.name == b.name && a.light_cone.map(f64::to_bits) == b.light_cone.map(f64::to_bits)
}

fn read(bytes: &[u8], part: Option<&str>) -> Result<Maps, Fault> {
    let options = MapOptions::default().with_most_texels(1 << 16).with_part(part.map(Into::into));
    let read = decode_maps(bytes, &options);
    if let Err(fault) = &read {
        let line = fault.to_string();
        assert!(!line.contains('\n') && !fault.field.is_empty(), "{line}");
    }
    read
}

fn message(bytes: &[u8], part: Option<&str>) -> String {
    read(bytes, part).expect_err("refused").to_string()
}

#[test]
fn maps_of_every_kind_come_back_bit_for_bit() {
    assert_eq!(encode_maps(&all()).expect("written"), file(), "the same bytes each time");
    let path = folder("several").join("lights.exr");
    write_maps(&path, &all()).expect("written");
    let again = read_maps(&path, &MapOptions::default()).expect("as it was written");
    assert!(again.notes.is_empty() && again.maps.len() == all().len());
    for (again, map) in again.maps.iter().zip(all()) {
        assert!(same(again, &map), "{}", map.name);
        let one = read(file(), Some(&map.name)).expect("one of them");
        assert!(one.maps.len() == 1 && same(&one.maps[0], &map), "{} alone", map.name);
        // The only one of a file is as it is among others.
        let alone = read(&encode_maps(std::slice::from_ref(&map)).expect("written"), None).expect("read");
        assert!(alone.maps.len() == 1 && same(&alone.maps[0], &map), "{}", map.name);
    }
    assert!(read(file(), Some("fill")).is_ok_and(|maps| maps.maps[0].name == "fill.ahead"));
    let refused = "parts is key, key.001, fill.ahead, glass, sun, grey: one map is wanted, and the file has several";
    assert_eq!(decode_map(file(), 1 << 16).expect_err("several").to_string(), refused);
    assert!(Paged::open(&path, 2).expect_err("several").to_string().ends_with(refused));
    let unknown = message(file(), Some("ke"));
    assert_eq!(unknown, "part is ke: the file has key, key.001, fill.ahead, glass, sun, grey");
}

#[test]
fn files_of_one_map_are_those_of_the_functions_for_one() {
    let flat = map(&spot(UVec2::new(40, 30)));
    assert_eq!(encode_maps(&[named("shadow", flat.clone())]).expect("written"), encode_shadow_map(&flat).expect("so"));
    let of_facets = crate::facets::file();
    assert_eq!(encode_maps(&[named("shadow", facets())]).expect("written"), of_facets.1);
    assert_eq!(encode_facet_map(&of_facets.0).expect("written"), of_facets.1);
}

#[test]
fn other_readers_find_parts_with_one_display_window() {
    let headers = MetaData::read_from_buffered(file(), true).expect("an EXR file").headers;
    let names: Vec<String> =
        headers.iter().map(|header| header.own_attributes.layer_name.as_ref().expect("a name").to_string()).collect();
    assert_eq!(names, ["key", "key.001", "key.001.facets", "fill.ahead", "glass", "sun", "sun.facets", "grey"]);
    assert!(headers.iter().all(|header| header.shared_attributes == headers[0].shared_attributes));
    assert_eq!(headers[0].shared_attributes.display_window.size, exr::math::Vec2(100, 71));
    // The middle of a smaller map is where its own share of the window is.
    let small = map(&spot(UVec2::new(30, 71)));
    let ndc = |matrix: Option<[f32; 16]>| glam::Mat4::from_cols_array(&matrix.expect("there"));
    let alone = MetaData::read_from_buffered(encode_shadow_map(&small).expect("written").as_slice(), true);
    let alone = ndc(alone.expect("an EXR file").headers[0].own_attributes.world_to_normalized_device);
    let shared = ndc(headers[3].own_attributes.world_to_normalized_device);
    let at = glam::Vec3::new(1.0, 2.0, 13.0);
    let (alone, shared) = (alone.project_point3(at), shared.project_point3(at));
    assert!((alone.x * 0.3 - shared.x).abs() < 1e-5 && (alone.y - shared.y).abs() < 1e-5, "{alone} {shared}");
}

#[test]
fn names_and_numbers_that_cannot_be_written_are_refused() {
    let flat = || map(&spot(UVec2::new(4, 3)));
    let refused = |maps: &[NamedMap]| encode_maps(maps).expect_err("refused").to_string();
    assert_eq!(refused(&[]), "parts is 0: not within 1..=2048");
    assert_eq!(refused(&[named("a", flat()), named("a", flat())]), "name is a: two parts are to be called that");
    let facets = refused(&[named("a", facets()), named("a.facets", flat())]);
    assert_eq!(facets, "name is a.facets: two parts are to be called that");
    for name in ["", "a\nb", "日", &"x".repeat(256)] {
        assert!(refused(&[named(name, flat())]).contains("not a name of 1 to 255 bytes"), "{name}");
    }
    for cone in [1.0, -0.5, f64::NAN] {
        let cone = NamedMap { light_cone: Some(cone), ..named("a", flat()) };
        assert!(refused(&[cone]).starts_with("part a: light_cone is Some("));
    }
    let many: Vec<NamedMap> = (0..2049).map(|number| named(&number.to_string(), flat())).collect();
    assert_eq!(refused(&many), "parts is 2049: not within 1..=2048");
    assert!(read(&encode_maps(&many[..2048]).expect("as many as fit"), None).is_ok_and(|read| read.maps.len() == 2048));
}

/// The file with a part's name in another spelling of the same length.
fn renamed(from: &str, to: &str) -> Vec<u8> {
    let mut bytes = file().to_vec();
    let value = |name: &str| [&(name.len() as u32).to_le_bytes()[..], name.as_bytes()].concat();
    let from = [&b"name\0string\0"[..], &value(from)].concat();
    let at = bytes.windows(from.len()).position(|window| window == from).expect("a name");
    bytes[at + from.len() - to.len()..at + from.len()].copy_from_slice(to.as_bytes());
    bytes
}

#[test]
fn members_that_are_missing_or_there_twice_are_named() {
    assert_eq!(message(&renamed("sun", "key"), None), "name is key: two parts are called that");
    let lost = "parts is sun.facets: facets of a map that is not there";
    assert_eq!(message(&renamed("sun", "son"), None), lost);
    assert_eq!(message(&renamed("sun.facets", "son.facets"), None), lost.replace("sun", "son"));
    // Facets of another map do not fit.
    let mut swapped = renamed("sun.facets", "kez.facets");
    let at = swapped.windows(3).position(|window| window == b"sun").expect("a name");
    swapped[at..at + 3].copy_from_slice(b"kez");
    assert!(read(&swapped, None).is_ok());
    let cone = file().windows(15).position(|window| window == b"light_cone_cos=").expect("a cone") + 15;
    let mut damaged = file().to_vec();
    damaged[cone + 2] = b'2';
    assert!(message(&damaged, None).starts_with("part fill.ahead: comments: digest is "));
}

#[test]
fn budgets_are_for_all_maps_together() {
    let maps: Vec<NamedMap> = CUBE_FACES.iter().map(|face| named(face, map(&spot(UVec2::splat(32))))).collect();
    let bytes = encode_maps(&maps).expect("written");
    let within = |most| decode_maps(&bytes, &MapOptions::default().with_most_texels(most));
    assert!(within(6 * 1024).is_ok());
    let refused = within(6 * 1024 - 1).expect_err("one too many").to_string();
    assert_eq!(refused, "part -z: displayWindow is 32 x 32: more than the allowed 1023 texels");
}

#[test]
fn lies_about_sizes_take_no_memory() {
    let giant = |attribute: &str| {
        let mut bytes = file().to_vec();
        let at = value(&bytes, attribute, "box2i");
        bytes[at + 8..at + 16].copy_from_slice(&[0xFF, 0xFF, 0xFF, 0x3F, 0xFF, 0xFF, 0xFF, 0x3F]);
        bytes
    };
    for bytes in [giant("dataWindow"), giant("displayWindow")] {
        message(&bytes, None);
    }
    for length in (0..file().len()).step_by(97) {
        message(&file()[..length], None);
    }
}

/// Each byte of headers and tables, and some of blocks, in turn: the maps that were written, or one line.
#[test]
fn damage_is_noticed_in_every_part() {
    let small = [named("a", map(&spot(UVec2::new(9, 7)))), named("b", deep(&spot(UVec2::new(6, 5)), 0.0, true))];
    let bytes = encode_maps(&small).expect("written");
    let headers = MetaData::read_from_buffered(bytes.as_slice(), true).expect("an EXR file").headers;
    let end = table(&bytes, headers.iter().map(|header| header.chunk_count).sum()) + 80;
    for at in 0..end.min(bytes.len()) {
        for change in [0x01, 0x80, 0x7F] {
            let mut damaged = bytes.clone();
            damaged[at] ^= change;
            let Ok(found) = read(&damaged, None) else { continue };
            for map in found.maps {
                // Names are for people; a channel that loses its name makes its part none of ours to read.
                let kept = |kept: &NamedMap| same(&NamedMap { name: map.name.clone(), ..kept.clone() }, &map);
                assert!(small.iter().any(kept), "byte {at}");
            }
        }
    }
}

#[test]
fn lights_are_found_by_the_names_of_their_maps() {
    for (map, light) in [("a.+x", "a"), ("a.b.-z", "a.b"), ("a.ahead", "a"), ("a.001", "a.001"), ("+x", "+x"), ("", "")]
    {
        assert_eq!(light_of(map), light);
    }
    assert!(decode_shadow_map(&encode_maps(&all()[..1]).expect("written"), 1 << 16).is_ok());
    assert_eq!(Raw::copy_of(&all()[0].map).depths().len(), 90 * 40);
}
