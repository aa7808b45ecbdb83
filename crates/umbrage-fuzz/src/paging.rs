//! Shadow maps page by page.

use crate::exr_bodies::most_texels;
use crate::mutate::Dice;
use crate::promises::assert_line;
use glam::IVec2;
use umbrage_depth::DepthMap;
use umbrage_io::{Paged, decode_shadow_map};
use umbrage_plane::mix32;

/// Takes bytes as a file of a shadow map, of which one to three tiles are kept, and looks at texels in an order that depends on the bytes.
/// What a whole read of the file gives is what every look-up answers. Whether the file could be paged.
///
/// # Panics
/// When it answers anything else, when an error does not end all reading, or when more tiles are kept than were allowed.
pub fn paging(file: &[u8]) -> bool {
    const LOOKS: usize = 40;
    let path = std::env::temp_dir().join(format!("umbrage-fuzz-{}.exr", std::process::id()));
    std::fs::write(&path, file).expect("a file in the folder of temporary ones");
    let mut dice = Dice(file.iter().fold(0, |sum, byte| mix32(sum ^ u32::from(*byte))));
    let whole = decode_shadow_map(file, most_texels(file));
    let pages = 1 + dice.below(3);
    let (paged, handle) = match Paged::open(&path, pages) {
        Ok(opened) => opened,
        Err(error) => {
            let line = error.to_string();
            let allowed = whole.is_err() || line.ends_with("scan lines cannot be paged");
            assert!(allowed, "a map that can be read: {line}");
            assert_line(line);
            return false;
        }
    };
    let size = paged.view().size().as_ivec2();
    for _ in 0..LOOKS {
        let texel = IVec2::new(dice.below(size.x as usize) as i32, dice.below(size.y as usize) as i32);
        let depth = paged.depth(texel);
        assert!(!depth.is_nan() && handle.resident_pages() <= pages);
        match (&whole, handle.error()) {
            (Ok(whole), None) => assert_eq!(depth.to_bits(), whole.depth(texel).to_bits(), "{texel}"),
            (Ok(_), Some(error)) => panic!("a map that can be read: {error}"),
            (Err(_), Some(_)) => assert_eq!(depth, f32::INFINITY, "{texel}"),
            (Err(_), None) => {}
        }
    }
    handle.error().inspect(|error| assert_line(error)).is_none()
}
