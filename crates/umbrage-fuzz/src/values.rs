//! Pictures of one quantity that any program has written, as `umbrage compare --against` reads them.

use crate::exr_bodies::most_texels;
use crate::promises::assert_line;
use exr::prelude::{
    AnyChannel, AnyChannels, Blocks, Compression, Encoding, FlatSamples, Image, Layer, LayerAttributes, LineOrder,
    Vec2, WritableImage, f16,
};
use glam::UVec2;
use png::{BitDepth, ColorType};
use std::io::Cursor;
use umbrage_io::{decode_values, encode_exr_values, encode_png_values};

/// Pictures of more pixels are not written again: that would take the time of thousands of small files.
const MOST_WRITTEN_AGAIN: u64 = 4096;
/// What a PNG file starts with.
const PNG_MAGIC: [u8; 8] = [0x89, b'P', b'N', b'G', b'\r', b'\n', 0x1a, b'\n'];

/// Reads bytes as a PNG or an EXR picture of one quantity; those of a PNG file once more with the checksums of its chunks made right, since what
/// is damaged without them goes no further than these. Whether they are a picture either way.
///
/// # Panics
/// When an error is longer than one line, more pixels are read than were allowed, a picture has another number of values than pixels, or a small one
/// changes by being written and read again.
pub fn values(file: &[u8]) -> bool {
    let read = holds(file);
    let with_sums = file.starts_with(&PNG_MAGIC) && holds(&summed(file));
    read || with_sums
}

fn holds(file: &[u8]) -> bool {
    let most = most_texels(file);
    match decode_values(file, most) {
        Err(fault) => {
            assert_line(fault);
            false
        }
        Ok(read) => {
            let pixels = u64::from(read.size.x) * u64::from(read.size.y);
            assert!(pixels <= most && read.values.len() as u64 == pixels, "{}: {}", read.size, read.values.len());
            if (1..=MOST_WRITTEN_AGAIN).contains(&pixels) {
                let written = encode_exr_values(read.size, &read.values).expect("written");
                let again = decode_values(&written, pixels).expect("our own file");
                // Arithmetic does not keep which NaN it is.
                let alike = |(a, b): (&f32, &f32)| a.to_bits() == b.to_bits() || a.is_nan() && b.is_nan();
                let is_same = again.values.iter().zip(&read.values).all(alike);
                assert!(again.size == read.size && is_same, "another picture after it was written");
            }
            true
        }
    }
}

/// A PNG file with the right checksum behind every chunk that is there whole.
fn summed(file: &[u8]) -> Vec<u8> {
    let mut file = file.to_vec();
    let mut at = PNG_MAGIC.len();
    while let Some(length) = file.get(at..at + 4) {
        let length = u32::from_be_bytes([length[0], length[1], length[2], length[3]]) as usize;
        let (start, end) = (at + 4, at.saturating_add(8).saturating_add(length));
        let Some(covered) = file.get(start..end) else { break };
        let sum = crc32fast::hash(covered).to_be_bytes();
        let Some(place) = file.get_mut(end..end + 4) else { break };
        place.copy_from_slice(&sum);
        at = end + 4;
    }
    file
}

/// Pictures of a few pixels: ours, and with the samples, channels and cuts of other programs.
pub(crate) fn images() -> Vec<Vec<u8>> {
    let size = UVec2::new(9, 7);
    let numbers: Vec<f32> = (0..size.element_product()).map(|index| (index % 11) as f32 / 10.0).collect();
    let mut all = vec![
        encode_png_values(size, &numbers).expect("written"),
        encode_exr_values(size, &numbers).expect("written"),
        png(size, ColorType::Grayscale, BitDepth::One),
        png(size, ColorType::GrayscaleAlpha, BitDepth::Eight),
        png(size, ColorType::Rgb, BitDepth::Eight),
        png(size, ColorType::Rgba, BitDepth::Sixteen),
        png(size, ColorType::Indexed, BitDepth::Four),
    ];
    let halves = || FlatSamples::F16(numbers.iter().copied().map(f16::from_f32).collect());
    let whole = || FlatSamples::U32((0..size.element_product()).collect());
    let floats = || FlatSamples::F32(numbers.clone());
    let colours = |samples: [FlatSamples; 4]| -> Vec<AnyChannel<FlatSamples>> {
        ["R", "G", "B", "A"].into_iter().zip(samples).map(|(name, samples)| AnyChannel::new(name, samples)).collect()
    };
    let tiles = Blocks::Tiles(Vec2(4, 4));
    let wide = Blocks::Tiles(Vec2(64, 64));
    all.extend([
        exr(size, Compression::Uncompressed, tiles, colours([halves(), halves(), halves(), halves()])),
        exr(size, Compression::RLE, Blocks::ScanLines, colours([floats(), halves(), whole(), floats()])),
        exr(size, Compression::PIZ, wide, colours([halves(), halves(), halves(), floats()])),
        exr(size, Compression::PXR24, Blocks::ScanLines, vec![AnyChannel::new("depth", floats())]),
        exr(size, Compression::ZIP1, tiles, vec![AnyChannel::new("Y", whole()), AnyChannel::new("Z", floats())]),
    ]);
    all
}

/// A PNG file whose bytes count up, row by row.
fn png(size: UVec2, colour: ColorType, depth: BitDepth) -> Vec<u8> {
    let mut bytes = Vec::new();
    let mut encoder = png::Encoder::new(&mut bytes, size.x, size.y);
    encoder.set_color(colour);
    encoder.set_depth(depth);
    if colour == ColorType::Indexed {
        encoder.set_palette((0..48).map(|code| code * 5).collect::<Vec<u8>>());
        encoder.set_trns(vec![255, 0, 128]);
    }
    let row = (size.x as usize * colour.samples() * depth as usize).div_ceil(8);
    let codes: Vec<u8> = (0..row * size.y as usize).map(|index| (index % 251) as u8).collect();
    let mut writer = encoder.write_header().expect("a header");
    writer.write_image_data(&codes).expect("written");
    writer.finish().expect("written");
    bytes
}

/// An EXR file of one part.
fn exr(size: UVec2, compression: Compression, blocks: Blocks, channels: Vec<AnyChannel<FlatSamples>>) -> Vec<u8> {
    let encoding = Encoding { compression, blocks, line_order: LineOrder::Increasing };
    let channels = AnyChannels::sort(channels.into());
    let layer = Layer::new((size.x as usize, size.y as usize), LayerAttributes::default(), encoding, channels);
    let mut bytes = Cursor::new(Vec::new());
    Image::from_layer(layer).write().non_parallel().to_buffered(&mut bytes).expect("written");
    bytes.into_inner()
}
