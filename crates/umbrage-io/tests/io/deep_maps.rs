use crate::hostile::{disown, value};
use crate::{folder, spot, sun, views};
use ::exr::prelude as exr;
use glam::{IVec2, UVec2, Vec3};
use proptest::prelude::*;
use umbrage_depth::{DeepMap, DepthMap, Step};
use umbrage_io::{
    DEFAULT_DEEP_BUDGET, decode_deep_map, encode_deep_map, read_deep_map, read_deep_map_within, write_deep_map,
};
use umbrage_plane::{TexelRect, View, mix32};

fn step(depth: f32, passes: f32) -> Step {
    Step { depth, passes: Vec3::splat(passes) }
}

/// A map of up to six surfaces a texel, none outside a box from a third on; of grey light or coloured.
pub(crate) fn deep(view: &View, epsilon: f32, grey: bool) -> DeepMap {
    let size = view.size();
    let texel = |index: u32| {
        let (x, y) = (index % size.x, index / size.x);
        let boxed = x >= size.x / 3 && y >= size.y / 3 && x * 6 < size.x * 5;
        let count = if boxed { mix32(index) % 7 } else { 0 };
        let share = |step: u32, channel: u32| {
            let channel = if grey { 0 } else { channel };
            (mix32(index * 64 + step * 8 + channel) % 1000) as f32 / 999.0
        };
        let mut passes = Vec3::ONE;
        let steps = (0..count).map(|step| {
            passes *= Vec3::from_array([0, 1, 2].map(|channel| share(step, channel)));
            // Behind the near plane, as surfaces are.
            let near = view.near().max(0.0) as f32;
            Step { depth: near + 1.0 / 3.0 + step as f32 * 1.1 + share(step, 3), passes }
        });
        // Bounds of every size cut at full opacity, or nothing would be left to compress.
        steps.take_while(|step| step.passes != Vec3::ZERO).collect()
    };
    DeepMap::new(*view, epsilon, (0..size.x * size.y).map(texel)).expect("ascending and falling")
}

/// All that a map says, by its bits.
pub(crate) fn bits(map: &DeepMap) -> Vec<Vec<[u32; 4]>> {
    let bits = |step: &Step| [step.depth, step.passes.x, step.passes.y, step.passes.z].map(f32::to_bits);
    let texels = TexelRect::of_size(map.view().size()).texels();
    texels.map(|texel| map.steps(texel).iter().map(bits).collect()).collect()
}

fn again(map: &DeepMap) -> DeepMap {
    decode_deep_map(&encode_deep_map(map).expect("written"), DEFAULT_DEEP_BUDGET).expect("read")
}

/// The same file without what only we write: from its opacities alone.
fn foreign(map: &DeepMap) -> Vec<u8> {
    let mut bytes = encode_deep_map(map).expect("written");
    disown(&mut bytes);
    let list = value(&bytes, "channels", "chlist");
    for at in list..list + 200 {
        if bytes[at..].starts_with(b"passes.") {
            bytes[at] = b'q';
        }
    }
    bytes
}

#[test]
fn b06_11_ext_3_round_trip_is_bit_exact_for_every_view_and_size() {
    for size in [UVec2::ONE, UVec2::new(37, 61), UVec2::new(65, 1), UVec2::new(1, 20), UVec2::new(130, 129)] {
        for view in views(size) {
            for (epsilon, grey) in [(0.0, true), (0.0, false), (0.05, false), (1.0 / 3.0, true)] {
                let written = deep(&view, epsilon, grey);
                let read = again(&written);
                assert_eq!(bits(&read), bits(&written), "{size}");
                assert_eq!(read.view(), written.view());
                assert_eq!(read.epsilon().to_bits(), epsilon.to_bits());
            }
        }
    }
}

/// Eight numbers do not get smaller: they stand as they are, at the end, channel after channel.
#[test]
fn v56_each_sample_has_the_opacity_of_its_surface_alone() {
    let view = sun(UVec2::ONE);
    let texel = vec![step(2.0, 0.6), step(5.0, 0.0)];
    let bytes = encode_deep_map(&DeepMap::new(view, 0.0, [texel]).expect("valid")).expect("written");
    let floats: Vec<f32> =
        bytes[bytes.len() - 24..].as_chunks::<4>().0.iter().map(|b| f32::from_le_bytes(*b)).collect();
    assert_eq!(floats, [1.0 - 0.6f32, 1.0, 2.0, 5.0, 0.6, 0.0]);
    let colour = Step { depth: 3.0, passes: Vec3::new(0.75, 0.5, 0.25) };
    let bytes = encode_deep_map(&DeepMap::new(view, 0.0, [vec![colour]]).expect("valid")).expect("written");
    let floats: Vec<f32> =
        bytes[bytes.len() - 32..].as_chunks::<4>().0.iter().map(|b| f32::from_le_bytes(*b)).collect();
    assert_eq!(floats, [0.5, 0.75, 0.5, 0.25, 3.0, 0.25, 0.5, 0.75]);
}

/// As any compositor does: each sample lets 1 − opacity of the light through. 2⁻²⁵ is the rounding of an opacity; the last factor of a product
/// rounds last and what came before is made up for.
#[test]
fn ext_3_opacities_composite_to_the_transmittance() {
    let mut worst = 0.0f32;
    for grey in [true, false] {
        let written = deep(&spot(UVec2::new(90, 70)), 0.0, grey);
        let read = decode_deep_map(&foreign(&written), DEFAULT_DEEP_BUDGET).expect("read as another maker's");
        for texel in TexelRect::of_size(written.view().size()).texels() {
            let (ours, theirs) = (written.steps(texel), read.steps(texel));
            assert_eq!(ours.len(), theirs.len());
            for (ours, theirs) in ours.iter().zip(theirs) {
                assert_eq!(ours.depth.to_bits(), theirs.depth.to_bits());
                worst = worst.max((ours.passes - theirs.passes).abs().max_element());
            }
        }
    }
    assert!(worst <= 2f32.powi(-24), "{worst}");
}

#[test]
fn empty_maps_full_texels_and_odd_depths() {
    let view = sun(UVec2::new(3, 2));
    let many = (0..300).map(|i| step(i as f32, 1.0 - i as f32 / 1000.0)).collect::<Vec<_>>();
    let small = vec![step(-3.5, 1.0), step(-0.0, 1.0 - f32::EPSILON / 2.0), step(1e-45, 1e-45), step(9.9e29, 0.0)];
    for texels in [
        vec![vec![]; 6],
        vec![vec![], vec![], vec![], vec![], vec![], many],
        vec![small, vec![], vec![step(f32::MIN, 0.0)], vec![], vec![], vec![]],
    ] {
        let written = DeepMap::new(view, 0.0, texels).expect("valid");
        assert_eq!(bits(&again(&written)), bits(&written));
    }
}

#[test]
fn the_same_map_makes_the_same_bytes() {
    let map = deep(&spot(UVec2::new(150, 90)), 0.01, false);
    let bytes = encode_deep_map(&map).expect("written");
    for _ in 0..8 {
        assert_eq!(encode_deep_map(&map).expect("written"), bytes);
    }
    assert_eq!(encode_deep_map(&again(&map)).expect("written"), bytes);
}

#[test]
fn files_on_disk_and_budgets() {
    let folder = folder("deep");
    let path = folder.join("glass.exr");
    let written = deep(&spot(UVec2::new(40, 30)), 0.0, false);
    write_deep_map(&path, &written).expect("written");
    assert_eq!(bits(&read_deep_map(&path).expect("read")), bits(&written));
    let message = read_deep_map_within(&path, 1199).expect_err("too large").to_string();
    assert!(message.ends_with("displayWindow is 40 x 30: more than the allowed 1199 texels"), "{message}");
    let three = vec![step(1.0, 0.5), step(2.0, 0.25), step(3.0, 0.125)];
    let full = DeepMap::new(sun(UVec2::new(4, 5)), 0.0, vec![three; 20]).expect("valid");
    write_deep_map(&path, &full).expect("written");
    assert!(read_deep_map_within(&path, 60).is_ok());
    let message = read_deep_map_within(&path, 59).expect_err("too many").to_string();
    assert!(
        message.contains("glass.exr: block 0, 4 at ") && message.contains("more samples than are allowed"),
        "{message}"
    );
    let absent = read_deep_map(&folder.join("no\nlamp.exr")).expect_err("absent").to_string();
    assert!(absent.contains("no\\nlamp.exr: cannot open") && !absent.contains('\n'), "{absent}");
}

#[test]
fn other_tools_find_what_the_convention_promises() {
    let view = spot(UVec2::new(48, 36));
    let map = deep(&view, 0.25, false);
    let bytes = encode_deep_map(&map).expect("written");
    let meta = exr::MetaData::read_from_buffered(bytes.as_slice(), true).expect("a header");
    let header = &meta.headers[0];
    assert!(
        meta.requirements.has_deep_data && header.deep && header.blocks == ::exr::meta::BlockDescription::ScanLines
    );
    assert_eq!((header.deep_data_version, header.compression), (Some(1), exr::Compression::ZIP1));
    let most = bits(&map).iter().map(Vec::len).max();
    assert_eq!(header.max_samples_per_pixel, most);
    let names: Vec<String> = header.channels.list.iter().map(|channel| channel.name.to_string()).collect();
    assert_eq!(names, ["A", "AB", "AG", "AR", "Z", "passes.B", "passes.G", "passes.R"]);
    let attributes = &header.own_attributes;
    assert_eq!(attributes.layer_position, exr::Vec2(16, 12));
    assert_eq!(header.layer_size, exr::Vec2(24, 24));
    let other = |name: &str| attributes.other.get(&exr::Text::from(name));
    assert_eq!(other("textureformat"), Some(&exr::AttributeValue::Text(exr::Text::from("Shadow"))));
    assert_eq!(other("epsilon"), Some(&exr::AttributeValue::F32(0.25)));
    assert_eq!((attributes.near_clip_plane, attributes.far_clip_plane), (Some(20.1), Some(220.3)));
    assert!(attributes.world_to_camera.is_some() && attributes.world_to_normalized_device.is_some());
    // Neither reader takes the other's file.
    let message = umbrage_io::decode_shadow_map(&bytes, DEFAULT_DEEP_BUDGET).expect_err("deep").to_string();
    assert_eq!(message, "type is deep: a shadow map has one depth per texel");
    let flat = umbrage_io::encode_shadow_map(&map).expect("the nearest surfaces");
    let message = decode_deep_map(&flat, DEFAULT_DEEP_BUDGET).expect_err("flat").to_string();
    assert_eq!(message, "type is flat: a deep map has several depths per texel");
}

/// Samples of other makers stand in any order, several at one depth, some behind everything.
#[test]
fn foreign_samples_are_sorted_and_merged() {
    // Numbers that do not pack: they stand as they are at the end.
    let texel = vec![step(1.23, 0.91), step(2.34, 0.73), step(3.45, 0.41), step(4.56, 0.17)];
    let mut bytes = foreign(&DeepMap::new(sun(UVec2::ONE), 0.0, [texel]).expect("valid"));
    let depths = bytes.len() - 32;
    assert_eq!(bytes[depths..depths + 4], 1.23f32.to_le_bytes());
    for (index, depth) in [7.0f32, 2.0, 7.0, 1e30].into_iter().enumerate() {
        bytes[depths + 4 * index..][..4].copy_from_slice(&depth.to_le_bytes());
    }
    let map = decode_deep_map(&bytes, DEFAULT_DEEP_BUDGET).expect("read");
    // The second's opacity first, then those of the first and the third in one.
    let [near, far] = map.steps(IVec2::ZERO) else { panic!("two depths") };
    assert_eq!((near.depth, far.depth), (2.0, 7.0));
    let (second, all) = (0.73 / 0.91, 0.73 / 0.91 * 0.91 * (0.41 / 0.73));
    assert!((near.passes - second).abs().max_element() < 1e-6 && (far.passes - all).abs().max_element() < 1e-6);
    for (at, value, expected) in [
        (depths, f32::NAN, "channel Z is NaN: not a depth"),
        (depths, -1000.0, "channel Z is -1000: before the near plane at "),
        (depths - 12, 1.5, "channel A is 1.5: not an opacity"),
        (depths - 12, 1.001, "channel A is 1.001: not an opacity"),
        (depths - 16, f32::NAN, "channel A is NaN: not an opacity"),
    ] {
        let mut bytes = bytes.clone();
        bytes[at..at + 4].copy_from_slice(&value.to_le_bytes());
        let message = decode_deep_map(&bytes, DEFAULT_DEEP_BUDGET).expect_err(expected).to_string();
        assert!(message.starts_with("block 0, 0 at byte ") && message.contains(expected), "{message}");
    }
}

/// An opacity that rounding carried past 1 or 0 is read as 1 or 0.
#[test]
fn foreign_opacities_may_be_rounded_past_their_ends() {
    let texel = vec![step(1.23, 0.91), step(2.34, 0.73)];
    let bytes = foreign(&DeepMap::new(sun(UVec2::ONE), 0.0, [texel]).expect("valid"));
    let opacities = bytes.len() - 24;
    let read = |first: f32| {
        let mut bytes = bytes.clone();
        bytes[opacities..opacities + 4].copy_from_slice(&first.to_le_bytes());
        let map = decode_deep_map(&bytes, DEFAULT_DEEP_BUDGET).expect("read");
        map.steps(IVec2::ZERO).first().map(|step| step.passes)
    };
    assert_eq!(read(1.000_000_1), Some(Vec3::ZERO));
    assert_eq!(read(-1e-7), Some(Vec3::ONE));
}

proptest! {
    #[test]
    fn ext_3_any_steps_survive(
        width in 1u32..40, height in 1u32..40, seed in any::<u32>(), most in 1u32..12, grey in any::<bool>(),
    ) {
        let view = spot(UVec2::new(width, height));
        let texel = |index: u32| {
            let draw = |i: u32| mix32(mix32(index ^ seed).wrapping_add(i));
            let count = draw(0) % most;
            let mut depths: Vec<f32> = (0..count).map(|i| f32::from_bits(draw(i + 1))).collect();
            depths.retain(|depth| depth.is_finite() && *depth < 1e30);
            depths.sort_by(f32::total_cmp);
            depths.dedup();
            let mut passes = Vec3::ONE;
            let steps = depths.into_iter().enumerate().map(|(i, depth)| {
                // From a hair's breadth of nothing to all but nothing.
                let bits = [0, 1, 2].map(|c| draw(100 + i as u32 * 3 + if grey { 0 } else { c }) % 0x3F80_0001);
                passes = passes.min(Vec3::from_array(bits.map(f32::from_bits)));
                Step { depth, passes }
            });
            steps.collect::<Vec<_>>()
        };
        let written = DeepMap::new(view, 0.0, (0..width * height).map(texel)).expect("ascending and falling");
        prop_assert_eq!(bits(&again(&written)), bits(&written));
    }
}
