use crate::{folder, map, spot, sun, views};
use ::exr::prelude as exr;
use ::exr::prelude::{ReadChannels as _, ReadLayers as _};
use glam::{DVec2, DVec3, DVec4, IVec2, Mat4, UVec2, Vec3};
use proptest::prelude::*;
use umbrage_depth::{Bbox, DepthMap, Raw, Tiled};
use umbrage_io::{DEFAULT_BUDGET, Paged, decode_shadow_map, encode_shadow_map, read_shadow_map, write_shadow_map};
use umbrage_plane::{Kind, Projection, Rules, Sampling, TexelRect, View};

fn bits(map: &Raw) -> Vec<u32> {
    map.depths().iter().map(|depth| depth.to_bits()).collect()
}

fn again(map: &Raw) -> Raw {
    decode_shadow_map(&encode_shadow_map(map).expect("written"), DEFAULT_BUDGET).expect("read")
}

#[test]
fn r87_4_round_trip_is_bit_exact_for_every_kind_and_size() {
    for size in [UVec2::ONE, UVec2::new(37, 61), UVec2::splat(64), UVec2::new(65, 1), UVec2::new(130, 129)] {
        for view in views(size) {
            let written = map(&view);
            let read = again(&written);
            assert_eq!(bits(&read), bits(&written), "{size}");
            assert_eq!(read.view(), written.view());
            let bits_of = |view: &View| view.world_to_eye().to_cols_array().map(f64::to_bits);
            assert_eq!(bits_of(read.view()), bits_of(&view));
            let at = DVec3::new(0.3, 0.1, 0.2);
            assert_eq!(read.view().world_at(at.truncate(), -0.125), view.world_at(at.truncate(), -0.125));
        }
    }
}

#[test]
fn r87_4_empty_full_and_signed_maps() {
    let view = sun(UVec2::new(3, 2));
    let cases = [
        vec![f32::INFINITY; 6],
        vec![0.0, -0.0, 1e-45, -3.5, 9.9e29, f32::MIN],
        vec![f32::INFINITY, f32::INFINITY, f32::INFINITY, f32::INFINITY, f32::INFINITY, 1.0],
    ];
    for depths in cases {
        let written = Raw::new(view, depths).expect("valid");
        assert_eq!(bits(&again(&written)), bits(&written));
    }
}

#[test]
fn the_same_map_makes_the_same_bytes_whatever_its_storage() {
    let raw = map(&spot(UVec2::new(150, 90)));
    let bytes = encode_shadow_map(&raw).expect("written");
    for _ in 0..8 {
        assert_eq!(encode_shadow_map(&raw).expect("written"), bytes);
    }
    assert_eq!(encode_shadow_map(&Bbox::from(&raw)).expect("written"), bytes);
    assert_eq!(encode_shadow_map(&Tiled::from(&raw)).expect("written"), bytes);
}

#[test]
fn files_on_disk() {
    let folder = folder("maps");
    let path = folder.join("lamp.exr");
    let written = map(&spot(UVec2::new(40, 30)));
    write_shadow_map(&path, &written).expect("written");
    assert_eq!(read_shadow_map(&path).expect("read"), written);
    let absent = read_shadow_map(&folder.join("no\nlamp.exr")).expect_err("absent").to_string();
    assert!(absent.contains("no\\nlamp.exr: cannot open") && !absent.contains('\n'), "{absent}");
    assert!(read_shadow_map(&folder).expect_err("a folder").to_string().contains("not a regular file"));
}

#[test]
fn other_tools_find_what_the_convention_promises() {
    let view = spot(UVec2::new(48, 36));
    let written = map(&view);
    let path = folder("convention").join("lamp.exr");
    write_shadow_map(&path, &written).expect("written");
    let image = exr::read().no_deep_data().largest_resolution_level().all_channels().first_valid_layer();
    let image = exr::ReadImage::from_file(image.all_attributes(), &path).expect("the crate's own reader takes it");
    let (layer, window) = (&image.layer_data, image.attributes.display_window);
    assert_eq!((window.position, window.size), (exr::Vec2(0, 0), exr::Vec2(48, 36)));
    assert_eq!(layer.attributes.layer_position, exr::Vec2(16, 12));
    assert_eq!(layer.size, exr::Vec2(24, 18));
    let attributes = &layer.attributes;
    assert_eq!(
        attributes.other.get(&exr::Text::from("textureformat")),
        Some(&exr::AttributeValue::Text(exr::Text::from("Shadow")))
    );
    assert_eq!((attributes.near_clip_plane, attributes.far_clip_plane), (Some(20.1), Some(220.3)));
    let channel = &layer.channel_data.list[0];
    assert_eq!(channel.name, exr::Text::from("Z"));

    // A point ahead of the light: +z in camera space, and its texel in NDC.
    let at = DVec3::new(1.0, 2.0, 13.0);
    let eye = view.world_to_eye().transform_point3(at);
    let camera = Mat4::from_cols_array(&attributes.world_to_camera.expect("there")).as_dmat4().transform_point3(at);
    assert!((camera - eye * DVec3::new(1.0, 1.0, -1.0)).length() < 1e-4 && camera.z > 0.0);
    let ndc = Mat4::from_cols_array(&attributes.world_to_normalized_device.expect("there")).as_dmat4();
    let place: DVec4 = ndc * at.extend(1.0);
    let texel = view.eye_to_texel(eye) / view.size().as_dvec2();
    assert!((place.truncate().truncate() / place.w - texel).length() < 1e-5);
    assert_eq!(channel.sample_data.value_by_flat_index(0), exr::Sample::F32(written.depths()[12 * 48 + 16]));
}

/// As another tool would write it: scan lines, no text of ours, the data window off the origin like the display window.
pub(crate) fn foreign(view: &View, blocks: exr::Blocks, compression: exr::Compression) -> Vec<u8> {
    foreign_of(&map(view), blocks, compression)
}

/// The same with any depths.
pub(crate) fn foreign_of(map: &Raw, blocks: exr::Blocks, compression: exr::Compression) -> Vec<u8> {
    let attributes = exr::LayerAttributes {
        comments: Some(exr::Text::from("by hand")),
        software_name: None,
        layer_position: exr::Vec2(5, -7),
        ..our_attributes(map)
    };
    whole_file(map.view().size(), attributes, map.depths().to_vec(), blocks, compression)
}

/// As `maketx --shadow` leaves a file of ours: what we say of it is kept, and what we did not write is filled with `filling`.
pub(crate) fn filled_up(map: &Raw, filling: f32) -> Vec<u8> {
    let ours = our_attributes(map);
    let TexelRect { min, max } = Bbox::from(map).finite();
    let depth = |texel: IVec2| if TexelRect::new(min, max).contains(texel) { map.depth(texel) } else { filling };
    let depths = TexelRect::of_size(map.view().size()).texels().map(depth).collect();
    let attributes = exr::LayerAttributes {
        software_name: Some(exr::Text::from("another")),
        layer_position: exr::Vec2(0, 0),
        ..ours
    };
    let blocks = exr::Blocks::Tiles(exr::Vec2(64, 64));
    whole_file(map.view().size(), attributes, depths, blocks, exr::Compression::ZIP16)
}

fn our_attributes(map: &Raw) -> exr::LayerAttributes {
    let ours = encode_shadow_map(map).expect("written");
    let meta = exr::MetaData::read_from_buffered(ours.as_slice(), true).expect("ours");
    meta.headers[0].own_attributes.clone()
}

/// A file without a cropped window, written by the crate's own writer.
fn whole_file(
    size: UVec2,
    attributes: exr::LayerAttributes,
    depths: Vec<f32>,
    blocks: exr::Blocks,
    compression: exr::Compression,
) -> Vec<u8> {
    let size = exr::Vec2(size.x as usize, size.y as usize);
    let window = exr::IntegerBounds::new(attributes.layer_position, size);
    let channel = exr::AnyChannel::new("Z", exr::FlatSamples::F32(depths));
    let encoding = exr::Encoding { compression, blocks, line_order: exr::LineOrder::Increasing };
    let layer = exr::Layer::new(size, attributes, encoding, exr::AnyChannels::sort(std::iter::once(channel).collect()));
    let image = exr::Image::new(exr::ImageAttributes::new(window), layer);
    let mut bytes = std::io::Cursor::new(Vec::new());
    exr::WritableImage::write(&image).non_parallel().to_buffered(&mut bytes).expect("written");
    bytes.into_inner()
}

/// What was not written is "no surface", bit for bit, whatever a tool puts there: 0 as `maketx` does, or NaN.
#[test]
fn our_cropped_files_are_read_right_after_a_tool_has_filled_them_up() {
    let folder = folder("filled");
    for view in [spot(UVec2::new(145, 133)), sun(UVec2::new(145, 133))] {
        let map = map(&view);
        for filling in [0.0, f32::NAN, -1.0, 25.0, f32::NEG_INFINITY] {
            let bytes = filled_up(&map, filling);
            let read = decode_shadow_map(&bytes, DEFAULT_BUDGET).expect("read");
            assert_eq!(bits(&read), bits(&map), "{filling}");
            let path = folder.join("filled.exr");
            std::fs::write(&path, &bytes).expect("written");
            let (paged, handle) = Paged::open(&path, 9).expect("opened");
            for texel in TexelRect::of_size(view.size()).texels() {
                assert_eq!(paged.depth(texel), map.depth(texel), "{filling} {texel}");
            }
            assert!(handle.error().is_none());
        }
        // Inside, NaN is damage as before.
        let mut depths: Vec<f32> = map.depths().to_vec();
        depths[60 * 145 + 60] = f32::NAN;
        let blocks = exr::Blocks::Tiles(exr::Vec2(64, 64));
        let broken = exr::LayerAttributes { layer_position: exr::Vec2(0, 0), ..our_attributes(&map) };
        let broken = whole_file(view.size(), broken, depths, blocks, exr::Compression::ZIP16);
        let message = decode_shadow_map(&broken, DEFAULT_BUDGET).expect_err("damaged").to_string();
        assert!(message.starts_with("comments: digest is "), "{message}");
    }
}

#[test]
fn foreign_files_are_read_from_their_matrices() {
    use exr::{Blocks, Compression};
    let ways = [
        (Blocks::ScanLines, Compression::ZIP16),
        (Blocks::ScanLines, Compression::ZIP1),
        (Blocks::ScanLines, Compression::RLE),
        (Blocks::ScanLines, Compression::Uncompressed),
        (Blocks::Tiles(exr::Vec2(10, 17)), Compression::ZIP16),
    ];
    for (blocks, compression) in ways {
        for view in [spot(UVec2::new(45, 33)), sun(UVec2::new(45, 33))] {
            let read = decode_shadow_map(&foreign(&view, blocks, compression), DEFAULT_BUDGET).expect("read");
            assert_eq!(bits(&read), bits(&map(&view)));
            let found = *read.view();
            assert_eq!((found.kind(), found.sampling(), found.cone()), (Kind::Axial, Sampling::Centre, None));
            assert_eq!(found.rules(), &Rules::OPEN);
            assert!(found.world_to_eye().abs_diff_eq(view.world_to_eye(), 1e-4));
            let scale = |view: &View| match view.projection() {
                Projection::Perspective { k, .. } => k,
                Projection::Orthographic { half, .. } => half,
            };
            assert_eq!(found.is_perspective(), view.is_perspective());
            assert!((scale(&found) / scale(&view) - 1.0).length() < 1e-5);
            assert!((found.near() - view.near()).abs() < 1e-4 && (found.far() - view.far()).abs() < 1e-4);
        }
    }
}

/// 0 or less for a background, and whatever else lies before the near plane: no surface can have made it.
#[test]
fn foreign_depths_before_the_near_plane_are_refused_by_texel_and_value() {
    use exr::{Blocks, Compression};
    for view in [spot(UVec2::new(45, 33)), sun(UVec2::new(45, 33))] {
        let with = |depth: f32| {
            let mut depths = map(&view).depths().to_vec();
            depths[45 * 12 + 16] = depth;
            Raw::new(view, depths).expect("a map")
        };
        let read = |depth: f32| {
            let bytes = foreign_of(&with(depth), Blocks::ScanLines, Compression::ZIP16);
            decode_shadow_map(&bytes, DEFAULT_BUDGET).map(|map| map.depth(IVec2::new(16, 12)))
        };
        let before = if view.is_perspective() {
            vec![0.0, -1.0, -0.0, 0.5 * view.near() as f32]
        } else {
            vec![view.near() as f32 - 5.0]
        };
        for depth in before {
            let message = read(depth).expect_err("refused").to_string();
            let expected = format!("channel Z at texel 16, 12 is {depth}: before the near plane at ");
            assert!(message.starts_with(&expected) && !message.contains('\n'), "{message}");
        }
        for depth in [view.near() as f32, view.near() as f32 + 1.0, f32::INFINITY] {
            assert_eq!(read(depth).expect("read"), depth);
        }
        // Ours are what was written, whatever that was.
        let ours = encode_shadow_map(&with(0.25)).expect("written");
        assert_eq!(decode_shadow_map(&ours, DEFAULT_BUDGET).expect("read").depth(IVec2::new(16, 12)), 0.25);
    }
}

#[test]
fn foreign_files_without_what_a_map_needs_are_refused_by_name() {
    use exr::{Blocks, Compression};
    let refused = |compression, blocks, expected: &str| {
        let fault = decode_shadow_map(&foreign(&spot(UVec2::splat(40)), blocks, compression), DEFAULT_BUDGET);
        let message = fault.expect_err("refused").to_string();
        assert!(message.contains(expected), "{message}");
    };
    for lossy in [Compression::PXR24, Compression::B44] {
        refused(lossy, Blocks::ScanLines, "compression is");
    }
    let pixels = [Vec3::ONE; 4];
    let picture = umbrage_io::encode_exr(UVec2::splat(2), &pixels).expect("written");
    let message = decode_shadow_map(&picture, DEFAULT_BUDGET).expect_err("three channels").to_string();
    assert_eq!(message, "channels is B, G, R: no channel Z among them");
}

#[test]
fn maps_past_the_budget_are_refused_before_memory_is_taken() {
    let huge = Raw::new(spot(UVec2::new(300, 200)), vec![f32::INFINITY; 60_000]).expect("valid");
    let bytes = encode_shadow_map(&huge).expect("written");
    assert!(decode_shadow_map(&bytes, 60_000).is_ok());
    let message = decode_shadow_map(&bytes, 59_999).expect_err("too large").to_string();
    assert_eq!(message, "displayWindow is 300 x 200: more than the allowed 59999 texels");
}

proptest! {
    #[test]
    fn r87_4_any_depths_and_view_survive(
        width in 1u32..100, height in 1u32..100, fov in 0.01f64..3.1, near in 1e-3f64..10.0, reach in 0.1f64..1e6,
        eye in (-1e5f64..1e5, -1e5f64..1e5, -1e5f64..1e5), seed in any::<u32>(), share in 0u32..9,
    ) {
        let size = UVec2::new(width, height);
        let eye = DVec3::new(eye.0, eye.1, eye.2);
        let view = View::perspective(eye, DVec3::new(0.1, 0.2, 0.3), DVec3::Y, fov, near, near + reach, size);
        prop_assume!(view.is_ok());
        let view = view.expect("checked").with_sampling(Sampling::Jittered { seed }).with_kind(Kind::Radial);
        let depth = |index: u32| {
            let bits = umbrage_plane::mix32(index ^ seed);
            let depth = f32::from_bits(bits);
            if bits % 9 < share && depth.is_finite() { depth } else { f32::INFINITY }
        };
        let written = Raw::new(view, (0..width * height).map(depth).collect()).expect("valid");
        let read = again(&written);
        prop_assert_eq!(bits(&read), bits(&written));
        prop_assert_eq!(read.view(), written.view());
    }
}

#[test]
fn a_file_says_which_surface_its_map_stores() {
    let view = View::orthographic(DVec3::Y, DVec3::ZERO, DVec3::X, 1.0, 0.0, 9.0, UVec2::splat(3)).expect("a view");
    for stored in umbrage_depth::Stored::ALL {
        let map = Raw::new(view, vec![2.0; 9]).expect("a map").with_stored(stored);
        let read = decode_shadow_map(&encode_shadow_map(&map).expect("written"), 9).expect("read");
        assert_eq!(read, map, "{stored}");
    }
    // A file that says nothing holds nearest surfaces, as all did before.
    let plain = Raw::new(view, vec![2.0; 9]).expect("a map");
    let bytes = encode_shadow_map(&plain).expect("written");
    assert!(!bytes.windows(7).any(|word| word == b"stored="));
}

/// A file of another maker with these channels, whose attributes are changed.
fn others(
    view: &View,
    channels: Vec<(&str, exr::FlatSamples)>,
    change: impl FnOnce(&mut exr::LayerAttributes),
) -> Vec<u8> {
    let map = map(view);
    let mut attributes = our_attributes(&map);
    attributes.comments = None;
    attributes.software_name = None;
    attributes.layer_position = exr::Vec2(0, 0);
    change(&mut attributes);
    let size = exr::Vec2(view.size().x as usize, view.size().y as usize);
    let channels = channels.into_iter().map(|(name, samples)| exr::AnyChannel::new(name, samples)).collect();
    let encoding = exr::Encoding {
        compression: exr::Compression::ZIP16,
        blocks: exr::Blocks::ScanLines,
        line_order: exr::LineOrder::Increasing,
    };
    let layer = exr::Layer::new(size, attributes, encoding, exr::AnyChannels::sort(channels));
    let mut bytes = std::io::Cursor::new(Vec::new());
    exr::WritableImage::write(&exr::Image::from_layer(layer)).non_parallel().to_buffered(&mut bytes).expect("written");
    bytes.into_inner()
}

#[test]
fn depths_of_other_makers_stand_among_other_channels_and_in_halves() {
    let view = spot(UVec2::new(45, 33));
    let own = map(&view);
    let depths = || exr::FlatSamples::F32(own.depths().to_vec());
    let halves = || exr::FlatSamples::F16(own.depths().iter().map(|depth| exr::f16::from_f32(*depth)).collect());
    let grey = || exr::FlatSamples::F32(vec![0.25; 45 * 33]);
    let small = || exr::FlatSamples::F16(vec![exr::f16::ONE; 45 * 33]);
    let ids = || exr::FlatSamples::U32(vec![7; 45 * 33]);
    let read = |channels| decode_shadow_map(&others(&view, channels, |_| ()), DEFAULT_BUDGET);
    for channels in [
        vec![("Z", depths())],
        vec![("R", grey()), ("G", small()), ("B", grey()), ("A", small()), ("Z", depths())],
        vec![("depth.Z", depths())],
        vec![("a", ids()), ("depth.Z", depths()), ("z", small())],
        vec![("Z", depths()), ("ZBack", grey()), ("depth.Z", small())],
    ] {
        assert_eq!(bits(&read(channels).expect("read")), bits(&own));
    }
    for channels in [vec![("Z", halves())], vec![("A", grey()), ("Z", halves()), ("id", ids())]] {
        let found = read(channels).expect("read");
        let rounded = own.depths().iter().map(|depth| exr::f16::from_f32(*depth).to_f32().to_bits());
        assert!(found.depths().iter().map(|depth| depth.to_bits()).eq(rounded));
    }
    for (channels, expected) in [
        (vec![("R", grey()), ("A", small())], "channels is A, R: no channel Z among them"),
        (vec![("a.Z", grey()), ("b.Z", small())], "channels is a.Z, b.Z: no channel Z among them"),
        (vec![("Z", ids())], "channel Z is U32: not of floats"),
    ] {
        assert_eq!(read(channels).expect_err("refused").to_string(), expected);
    }
}

#[test]
fn other_names_for_where_a_light_stands_are_known() {
    use exr::AttributeValue::Matrix4x4;
    for view in [spot(UVec2::new(45, 33)), sun(UVec2::new(45, 33))] {
        let own = map(&view);
        // RenderMan's, OpenImageIO's and our own words; from -1 to 1 with y up, or 0 to 1 with y down.
        for (camera, screen, ndc) in
            [("Nl", "NP", false), ("worldtocamera", "worldtoscreen", false), ("Nl", "NP", true)]
        {
            let change = |attributes: &mut exr::LayerAttributes| {
                let to_camera = attributes.world_to_camera.take().expect("ours");
                let to_ndc = attributes.world_to_normalized_device.take().expect("ours");
                let to_screen = Mat4::from_scale(Vec3::new(2.0, -2.0, 1.0))
                    * Mat4::from_translation(Vec3::new(-0.5, -0.5, 0.0))
                    * Mat4::from_cols_array(&to_ndc);
                let matrix = if ndc { to_ndc } else { to_screen.to_cols_array() };
                attributes.other.insert(camera.into(), Matrix4x4(to_camera));
                attributes.other.insert(screen.into(), Matrix4x4(matrix));
                attributes.near_clip_plane = None;
                attributes.far_clip_plane = None;
            };
            let bytes = others(&view, vec![("Z", exr::FlatSamples::F32(own.depths().to_vec()))], change);
            let read = decode_shadow_map(&bytes, DEFAULT_BUDGET).expect("read");
            assert_eq!(bits(&read), bits(&own));
            assert!(read.view().world_to_eye().abs_diff_eq(view.world_to_eye(), 1e-4));
            let range = |view: &View| DVec2::new(view.near(), view.far());
            assert!((range(read.view()) - range(&view)).abs().max_element() < 1e-2, "{:?}", range(read.view()));
        }
        let without = |attributes: &mut exr::LayerAttributes| {
            attributes.far_clip_plane = None;
            // A third row that says nothing of depths.
            let matrix = attributes.world_to_normalized_device.as_mut().expect("ours");
            for entry in [2, 6, 10, 14] {
                matrix[entry] = 0.0;
            }
        };
        let bytes = others(&view, vec![("Z", exr::FlatSamples::F32(own.depths().to_vec()))], without);
        let message = decode_shadow_map(&bytes, DEFAULT_BUDGET).expect_err("refused").to_string();
        assert!(message.starts_with("far is missing: a shadow map needs it"), "{message}");
    }
}
/// Wavelets, as Houdini and others pack depths: read bit for bit, and damage of any kind ends in an error or in other depths.
#[test]
fn depths_that_wavelets_pack_are_read_and_damage_is_borne() {
    use exr::{Blocks, Compression};
    let mut state = 1u64;
    let mut below = |end: usize| {
        state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (state >> 33) as usize % end
    };
    for blocks in [Blocks::ScanLines, Blocks::Tiles(exr::Vec2(40, 37))] {
        let view = sun(UVec2::new(45, 33));
        let bytes = foreign(&view, blocks, Compression::PIZ);
        assert_eq!(bits(&decode_shadow_map(&bytes, DEFAULT_BUDGET).expect("read")), bits(&map(&view)));
        for _ in 0..1500 {
            let mut damaged = bytes.clone();
            for _ in 0..=below(3) {
                let at = 300 + below(bytes.len() - 300);
                damaged[at] = if below(2) == 0 { below(256) as u8 } else { damaged[at] ^ 1 << below(8) };
            }
            if let Err(fault) = decode_shadow_map(&damaged, DEFAULT_BUDGET) {
                assert!(!fault.to_string().contains('\n'), "{fault}");
            }
        }
    }
}
