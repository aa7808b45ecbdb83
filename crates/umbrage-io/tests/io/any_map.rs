use crate::{map, spot};
use glam::UVec2;
use umbrage_depth::{DeepMap, Map, Step};
use umbrage_io::{decode_map, encode_deep_map, encode_shadow_map};

#[test]
fn whichever_map_a_file_holds_is_read() {
    let view = spot(UVec2::new(40, 30));
    let flat = map(&view);
    match decode_map(&encode_shadow_map(&flat).expect("a file"), 1 << 20) {
        Ok(Map::Raw(read)) => assert!(*read == flat),
        other => panic!("{other:?}"),
    }
    let step = |k: u32| vec![Step { depth: 30.0 + k as f32, passes: glam::Vec3::splat(0.5) }];
    let deep = DeepMap::new(view, 0.0, (0..40 * 30).map(step)).expect("a map");
    match decode_map(&encode_deep_map(&deep).expect("a file"), 1 << 20) {
        Ok(Map::Deep(read)) => assert!(*read == deep),
        other => panic!("{other:?}"),
    }
    // Maps of facets: see facets.rs, whose file is read as one here too.
    match decode_map(&crate::facets::file().1, 1 << 20) {
        Ok(Map::Facets(read)) => assert!(*read == crate::facets::file().0),
        other => panic!("{other:?}"),
    }
    // Damaged facets are not passed off as the depths beside them.
    let mut damaged = crate::facets::file().1.clone();
    let last = damaged.len() - 9;
    damaged[last] ^= 0x55;
    assert!(decode_map(&damaged, 1 << 20).is_err());
    assert!(decode_map(b"", 1 << 20).is_err() && decode_map(&[0; 12], 1 << 20).is_err());
}
