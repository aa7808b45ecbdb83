use crate::{folder, spot};
use exr::prelude as exr;
use glam::{UVec2, Vec3};
use proptest::prelude::*;
use umbrage_depth::Raw;
use umbrage_io::{
    decode_png, depth_view, encode_exr, encode_exr_values, encode_png, encode_png_grey, encode_png_values,
    linear_to_srgb8, read_png, replicate, write_exr, write_png, write_png_grey,
};

/// The linear light of a code, by the standard's formula.
fn linear(code: f64) -> f64 {
    let encoded = code / 255.0;
    if encoded <= 0.04045 { encoded / 12.92 } else { ((encoded + 0.055) / 1.055).powf(2.4) }
}

#[test]
fn every_code_is_hit_and_rounding_turns_midway_between_codes() {
    for code in 0..=255u8 {
        assert_eq!(linear_to_srgb8(linear(f64::from(code)) as f32), code);
        if code < 255 {
            let midway = linear(f64::from(code) + 0.5);
            assert_eq!(linear_to_srgb8((midway * 0.9999) as f32), code);
            assert_eq!(linear_to_srgb8((midway * 1.0001) as f32), code + 1);
        }
    }
}

#[test]
fn light_out_of_range_is_cut() {
    let cases = [(f32::NAN, 0), (-1.0, 0), (-0.0, 0), (f32::NEG_INFINITY, 0), (1.5, 255), (f32::INFINITY, 255)];
    for (light, code) in cases {
        assert_eq!(linear_to_srgb8(light), code, "{light}");
    }
}

#[test]
fn x_7_png_of_known_pixels() {
    let folder = folder("png");
    let size = UVec2::new(3, 2);
    let pixels = [Vec3::ZERO, Vec3::X, Vec3::Y, Vec3::Z, Vec3::splat(0.5), Vec3::splat(0.214_041_14)];
    write_png(&folder.join("colour.png"), size, &pixels).expect("written");
    let codes = read_png(&folder.join("colour.png")).expect("read");
    assert_eq!(codes.size, size);
    assert_eq!(codes.rgb, [[0; 3], [255, 0, 0], [0, 255, 0], [0, 0, 255], [188; 3], [128; 3]]);
    write_png_grey(&folder.join("grey.png"), size, &[0.0, 1.0, 0.5, 0.25, 0.75, f32::NAN]).expect("written");
    let grey = read_png(&folder.join("grey.png")).expect("read");
    assert_eq!(grey.rgb, [0, 255, 188, 137, 225, 0].map(|code| [code; 3]));
    assert_eq!(encode_png(size, &pixels), encode_png(size, &pixels));
    assert!(encode_png_grey(size, &[0.5; 6]).expect("valid").starts_with(b"\x89PNG\r\n"));
}

#[test]
fn pixels_that_do_not_fit_their_size_are_refused() {
    let fault = encode_png(UVec2::new(2, 2), &[Vec3::ONE; 5]).expect_err("five are not four");
    assert_eq!(fault.to_string(), "picture size is 2 x 2: 5 pixels do not fill it");
    assert!(encode_png_grey(UVec2::ZERO, &[]).is_err());
    assert!(encode_exr(UVec2::new(3, 1), &[Vec3::ONE]).is_err());
    let path = folder("unfit").join("x.png");
    let message = write_png(&path, UVec2::ONE, &[]).expect_err("none is not one").to_string();
    assert!(message.contains("x.png: picture size is 1 x 1"), "{message}");
    assert!(!path.exists());
}

#[test]
fn x_7_exr_keeps_every_bit_of_a_picture() {
    let path = folder("exr").join("beauty.exr");
    let size = UVec2::new(37, 5);
    let pixels: Vec<Vec3> = (0..37 * 5).map(|i| Vec3::new(i as f32 / 3.0, -1.0 / i as f32, 1e-30)).collect();
    write_exr(&path, size, &pixels).expect("written");
    let read = exr::read_first_rgba_layer_from_file(
        &path,
        |size, _| (size.width(), vec![Vec3::ZERO; size.area()]),
        |(width, pixels), at, (r, g, b, _): (f32, f32, f32, f32)| pixels[at.y() * *width + at.x()] = Vec3::new(r, g, b),
    )
    .expect("read");
    let (width, found) = read.layer_data.channel_data.pixels;
    assert_eq!(width, 37);
    let bits = |pixels: &[Vec3]| pixels.iter().map(|pixel| pixel.to_array().map(f32::to_bits)).collect::<Vec<_>>();
    assert_eq!(bits(&found), bits(&pixels));
    assert_eq!(encode_exr(size, &pixels), encode_exr(size, &pixels));
}

#[test]
fn r87_f7_zooms_repeat_pixels() {
    let (size, zoomed) = replicate(UVec2::new(2, 2), &[1, 2, 3, 4], 3);
    assert_eq!(size, UVec2::splat(6));
    assert_eq!(zoomed[..12], [1, 1, 1, 2, 2, 2, 1, 1, 1, 2, 2, 2]);
    assert_eq!(zoomed[30..], [3, 3, 3, 4, 4, 4]);
    assert_eq!(replicate(UVec2::new(2, 1), &[5, 6], 1), (UVec2::new(2, 1), vec![5, 6]));
    assert_eq!(replicate(UVec2::new(2, 1), &[5, 6], 0).1, []);
}

#[test]
fn r87_24_nearer_is_darker_and_nothing_is_white() {
    let view = spot(UVec2::new(2, 2));
    let grey = |depths: [f32; 4]| depth_view(&Raw::new(view, depths.to_vec()).expect("valid"));
    assert_eq!(grey([30.0, 50.0, 40.0, f32::INFINITY]), [0.0, 0.75, 0.375, 1.0]);
    assert_eq!(grey([f32::INFINITY; 4]), [1.0; 4]);
    assert_eq!(grey([7.0, 7.0, f32::INFINITY, 7.0]), [0.0, 0.0, 1.0, 0.0]);
    assert_eq!(grey([f32::MIN, 9e29, f32::INFINITY, 0.0])[0], 0.0);
}

proptest! {
    #[test]
    fn damaged_png_is_an_error_or_a_picture(at in 0usize..2000, value in any::<u8>(), cut in 0usize..2000) {
        let pixels: Vec<Vec3> = (0..19 * 23).map(|i| Vec3::splat(i as f32 / 437.0)).collect();
        let mut bytes = encode_png(UVec2::new(19, 23), &pixels).expect("valid");
        let length = bytes.len();
        bytes[at % length] ^= value;
        let _ = decode_png(&bytes);
        bytes[at % length] ^= value;
        let whole = decode_png(&bytes).expect("undamaged");
        let cut = decode_png(&bytes[..cut % length]);
        prop_assert!(cut.is_err() || cut == Ok(whole), "only what follows the pixels may be missing");
    }
}

#[test]
fn values_are_written_without_a_curve() {
    let size = UVec2::new(4, 2);
    let values = [0.0, 1.0, 0.5, 1.0 / 3.0, f32::NAN, -1.0, 7.0, 2.6 / 65535.0];
    let bytes = encode_png_values(size, &values).expect("a picture");
    let mut reader = png::Decoder::new(std::io::Cursor::new(&bytes)).read_info().expect("a picture");
    assert_eq!(reader.info().gama_chunk.map(png::ScaledFloat::into_value), Some(1.0));
    let mut samples = vec![0; reader.output_buffer_size().expect("a small picture")];
    let frame = reader.next_frame(&mut samples).expect("a picture");
    assert_eq!((frame.color_type, frame.bit_depth), (png::ColorType::Grayscale, png::BitDepth::Sixteen));
    let codes: Vec<u16> = samples.chunks_exact(2).map(|code| u16::from_be_bytes([code[0], code[1]])).collect();
    assert_eq!(codes, [0, 65535, 32768, 21845, 0, 0, 65535, 3]);

    let path = folder("exr-values").join("values.exr");
    std::fs::write(&path, encode_exr_values(size, &values).expect("a picture")).expect("a file");
    let image = exr::read_all_flat_layers_from_file(&path).expect("a picture");
    let [layer] = image.layer_data.as_slice() else { panic!("one layer") };
    let [channel] = layer.channel_data.list.as_slice() else { panic!("one channel") };
    assert_eq!(channel.name.to_string(), "Y");
    let bits: Vec<u32> = channel.sample_data.values_as_f32().map(f32::to_bits).collect();
    assert_eq!(bits, values.map(f32::to_bits));

    assert!(encode_png_values(size, &values[1..]).is_err() && encode_exr_values(size, &values[1..]).is_err());
}
