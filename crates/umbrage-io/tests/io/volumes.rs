//! Deep samples that have a thickness, and parts, channels, packings and views of other makers.

use crate::shadow_maps::foreign_of;
use crate::{map, spot};
use ::exr::prelude as exr;
use glam::{IVec2, UVec2};
use umbrage_depth::{DeepMap, DepthMap, Map, Raw};
use umbrage_io::{Fault, GivenView, MapOptions, decode_deep_map, decode_maps, decode_shadow_map};
use umbrage_plane::Kind;

/// A deep file of one texel with the samples given: Z, `ZBack`, A.
fn deep(samples: &[[f32; 3]]) -> Vec<u8> {
    let mut bytes = vec![0x76, 0x2f, 0x31, 0x01, 2, 0x08, 0, 0];
    let mut attribute = |name: &str, kind: &str, value: &[u8]| {
        bytes.extend(
            [name.as_bytes(), b"\0", kind.as_bytes(), b"\0", &(value.len() as u32).to_le_bytes(), value].concat(),
        );
    };
    let channel = |name: &str| [name.as_bytes(), b"\0", &words(&[2, 0, 1, 1])].concat();
    attribute("channels", "chlist", &[channel("A"), channel("Z"), channel("ZBack"), vec![0]].concat());
    attribute("compression", "compression", &[0]);
    attribute("dataWindow", "box2i", &words(&[0; 4]));
    attribute("displayWindow", "box2i", &words(&[0; 4]));
    attribute("lineOrder", "lineOrder", &[0]);
    attribute("pixelAspectRatio", "float", &1f32.to_le_bytes());
    attribute("screenWindowCenter", "v2f", &[0; 8]);
    attribute("screenWindowWidth", "float", &1f32.to_le_bytes());
    attribute("type", "string", b"deepscanline");
    attribute("name", "string", b"smoke");
    attribute("version", "int", &words(&[1]));
    attribute("maxSamplesPerPixel", "int", &words(&[samples.len() as i32]));
    attribute("chunkCount", "int", &words(&[1]));
    bytes.push(0);
    let offset = bytes.len() as u64 + 8;
    bytes.extend(offset.to_le_bytes());
    bytes.extend(words(&[0, 4, 0, 12 * samples.len() as i32, 0, 12 * samples.len() as i32, 0, samples.len() as i32]));
    for channel in [2, 0, 1] {
        bytes.extend(samples.iter().flat_map(|sample| sample[channel].to_le_bytes()));
    }
    bytes
}

fn words(words: &[i32]) -> Vec<u8> {
    words.iter().flat_map(|word| word.to_le_bytes()).collect()
}

/// A light at the origin that looks along −z of the world, 90° wide, as RenderMan writes it.
fn given() -> GivenView {
    let world_to_camera = glam::DMat4::from_scale(glam::DVec3::new(1.0, 1.0, -1.0)).to_cols_array();
    let screen = glam::DMat4::from_cols_array_2d(&[
        [1.0, 0.0, 0.0, 0.0],
        [0.0, 1.0, 0.0, 0.0],
        [0.0, 0.0, 0.0, -1.0],
        [0.0, 0.0, 0.0, 0.0],
    ]);
    let (near, far) = (Some(1.0), Some(100.0));
    GivenView { world_to_camera, world_to_screen: screen.to_cols_array(), near, far, depth: Kind::Axial }
}

fn smoke(samples: &[[f32; 3]]) -> Result<DeepMap, Fault> {
    let options = MapOptions::default().with_view(Some(given()));
    match decode_maps(&deep(samples), &options)?.maps.pop().map(|named| named.map) {
        Some(Map::Deep(map)) => Ok((*map).clone()),
        other => panic!("{other:?}"),
    }
}

#[test]
fn volumes_pass_what_openexr_says() {
    let passes = |samples: &[[f32; 3]], depth: f32| smoke(samples).expect("a map").transmittance(IVec2::ZERO, depth).x;
    let half = [[4.0, 5.0, 0.5]];
    for share in [0.0, 0.125, 0.25, 0.5, 0.8, 1.0f32] {
        let found = passes(&half, 4.0 + share);
        assert!((found - 0.5f32.powf(share)).abs() <= 1.0 / 2048.0, "{share}: {found}");
    }
    assert_eq!((passes(&half, 4.0), passes(&half, 5.001)), (1.0, 0.5));
    assert!((smoke(&half).expect("a map").epsilon() - 1.0 / 2048.0).abs() < f32::EPSILON);
    // Two that overlap dim one another, in any order, and a surface inside them once it is passed.
    let all = [[4.5, 6.5, 0.75], [5.0, 5.0, 0.2], [4.0, 6.0, 0.5]];
    for depth in [4.25f32, 4.75, 5.0, 5.25, 6.25, 7.0] {
        let part =
            |front: f32, back: f32, through: f32| through.powf(((depth - front) / (back - front)).clamp(0.0, 1.0));
        let surface = if depth > 5.0 { 0.8 } else { 1.0 };
        let (wanted, found) = (part(4.0, 6.0, 0.5) * part(4.5, 6.5, 0.25) * surface, passes(&all, depth));
        assert!((found - wanted).abs() <= 1.0 / 2048.0 + 1e-6, "{depth}: {found} {wanted}");
    }
    // What stops everything does so where it begins; what has no thickness is a surface, exactly.
    assert_eq!([passes(&[[4.0, 5.0, 1.0]], 4.0), passes(&[[4.0, 5.0, 1.0]], 4.001)], [1.0, 0.0]);
    let surfaces = smoke(&[[4.0, 4.0, 0.5], [3.0, 3.0, 0.25]]).expect("a map");
    assert_eq!((surfaces.epsilon(), surfaces.steps(IVec2::ZERO).len()), (0.0, 2));
    assert_eq!(surfaces.transmittance(IVec2::ZERO, 9.0).x, 0.375);
    // Many over one another take no longer than as many side by side.
    let many: Vec<[f32; 3]> = (0..20_000).map(|k| [4.0 + 1e-4 * k as f32, 90.0, 1e-4]).collect();
    assert!((passes(&many, 95.0) - (1.0f32 - 1e-4).powi(20_000)).abs() < 1e-3);
}

#[test]
fn thicknesses_without_a_right_reading_are_refused() {
    for (back, shown) in [(3.9, "3.9"), (f32::NAN, "NaN"), (f32::INFINITY, "inf"), (2e30, "2e30")] {
        let refused = smoke(&[[4.0, back, 0.5]]).expect_err("refused").to_string();
        assert!(
            refused.contains("channel ZBack is ") && refused.ends_with("a sample from 4 on cannot end there"),
            "{shown}: {refused}"
        );
    }
    let unplaced = decode_deep_map(&deep(&[[4.0, 5.0, 0.5]]), 100).expect_err("no view").to_string();
    assert_eq!(unplaced, "worldToCamera is missing: a shadow map needs it, or a view that is given");
}

/// A beauty picture beside depths of another name, in two parts, without a view.
fn two_parts(compression: exr::Compression, depths: &Raw) -> Vec<u8> {
    let size = depths.view().size();
    let size = exr::Vec2(size.x as usize, size.y as usize);
    let layer = |name: &str, channels: &[(&str, Vec<f32>)]| {
        let channel =
            |(name, values): &(&str, Vec<f32>)| exr::AnyChannel::new(*name, exr::FlatSamples::F32(values.clone()));
        let encoding =
            exr::Encoding { compression, blocks: exr::Blocks::ScanLines, line_order: exr::LineOrder::Increasing };
        let channels = exr::AnyChannels::sort(channels.iter().map(channel).collect());
        exr::Layer::new(size, exr::LayerAttributes::named(name), encoding, channels)
    };
    let grey = vec![0.5; size.area()];
    let colour = ["A", "B", "G", "R"].map(|name| (name, grey.clone()));
    let layers =
        [layer("beauty", &colour), layer("lamp", &[("R", grey.clone()), ("depth.V", depths.depths().to_vec())])];
    let window = exr::IntegerBounds::from_dimensions(size);
    let image =
        exr::Image::from_layers(exr::ImageAttributes::new(window), layers.into_iter().collect::<exr::Layers<_>>());
    let mut bytes = std::io::Cursor::new(Vec::new());
    exr::WritableImage::write(&image).non_parallel().to_buffered(&mut bytes).expect("written");
    bytes.into_inner()
}

fn plane(depth: f32) -> Raw {
    Raw::new(spot(UVec2::new(40, 30)), vec![depth; 40 * 30]).expect("depths")
}

#[test]
fn parts_and_channels_of_other_makers_are_found() {
    let bytes = two_parts(exr::Compression::ZIP16, &plane(7.5));
    let options = MapOptions::default().with_view(Some(given()));
    let refused = decode_maps(&bytes, &options).expect_err("no Z").to_string();
    assert_eq!(refused, "parts is beauty, lamp: no channel Z in any of them");
    let read = decode_maps(&bytes, &options.clone().with_channel(Some("depth.V".into()))).expect("a map");
    assert_eq!(read.maps.len(), 1);
    assert_eq!((read.maps[0].name.as_str(), read.maps[0].map.depth(IVec2::splat(9))), ("lamp", 7.5));
    assert_eq!(read.notes[0].to_string(), "parts is beauty: no channel depth.V in them: left alone");
    let unplaced = decode_maps(&bytes, &MapOptions::default().with_channel(Some("depth.V".into())));
    assert!(unplaced.expect_err("no view").to_string().starts_with("part lamp: worldToCamera is missing"));
    let z = GivenView { depth: Kind::Screen, ..given() };
    for (depth, found) in [(0.25, 0.25), (1.0, f32::INFINITY)] {
        let bytes = two_parts(exr::Compression::PIZ, &plane(depth));
        let options = MapOptions::default().with_channel(Some("depth.V".into())).with_view(Some(z));
        let read = decode_maps(&bytes, &options).expect("a map");
        assert_eq!((read.maps[0].map.view().kind(), read.maps[0].map.depth(IVec2::ZERO)), (Kind::Screen, found));
    }
}

#[test]
fn lossy_packings_are_read_with_a_note() {
    let whole = map(&spot(UVec2::new(60, 50)));
    for (packing, name) in
        [(exr::Compression::PXR24, "PXR24"), (exr::Compression::B44, "B44"), (exr::Compression::B44A, "B44A")]
    {
        let bytes =
            foreign_of(&Raw::new(*whole.view(), vec![31.7; 3000]).expect("depths"), exr::Blocks::ScanLines, packing);
        let read = decode_maps(&bytes, &MapOptions::default()).expect("a map");
        assert!((read.maps[0].map.depth(IVec2::splat(7)) - 31.7).abs() < 1e-3);
        assert!(
            read.notes[0].to_string().starts_with(&format!("compression is {name}: a lossy packing")),
            "{:?}",
            read.notes
        );
        // Who has no place for notes does not take it.
        assert!(
            decode_shadow_map(&bytes, 3000)
                .expect_err("lossy")
                .to_string()
                .starts_with(&format!("compression is {name}"))
        );
        for at in (0..bytes.len()).step_by(7) {
            let mut damaged = bytes.clone();
            damaged[at] ^= 0x55;
            let _ = decode_maps(&damaged, &MapOptions::default().with_most_texels(1 << 16));
        }
    }
    let mut dwa = foreign_of(&whole, exr::Blocks::Tiles(exr::Vec2(64, 64)), exr::Compression::ZIP16);
    let at = crate::hostile::value(&dwa, "compression", "compression");
    for (code, name) in [(8, "DWAA"), (9, "DWAB")] {
        dwa[at] = code;
        let refused = decode_maps(&dwa, &MapOptions::default()).expect_err("DWA").to_string();
        assert!(refused.starts_with(&format!("compression is {name}: maps are read from none")), "{refused}");
    }
}
