use crate::error::{Fault, IoError};
use crate::file::read_bytes;
use crate::write_file::write_bytes;
use exr::prelude as exr;
use glam::{UVec2, Vec3};
use png::{BitDepth, ColorType};
use std::fmt::Display;
use std::io::Cursor;
use std::path::Path;

/// A picture as it stands in a PNG file: 8-bit sRGB codes, rows from the top.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Codes {
    /// Columns and rows.
    pub size: UVec2,
    /// Red, green, blue; grey pictures have them equal.
    pub rgb: Vec<[u8; 3]>,
}

/// The 8-bit sRGB code of linear light: of the 256 codes the one whose value is nearest after encoding; a value midway
/// between two takes the upper one. Below 0 and NaN are 0, above 1 is 255.
pub fn linear_to_srgb8(linear: f32) -> u8 {
    let linear = f64::from(linear.clamp(0.0, 1.0));
    let encoded = if linear <= 0.003_130_8 { linear * 12.92 } else { 1.055 * linear.powf(1.0 / 2.4) - 0.055 };
    // A NaN has passed the clamp and becomes 0 here.
    (encoded * 255.0 + 0.5) as u8
}

/// A PNG file's bytes from linear light; the same bytes for the same picture. `linear_rgb` holds `size.x` × `size.y`
/// pixels, rows from the top.
///
/// # Errors
/// When the number of pixels does not fit the size, or the size has no pixels.
pub fn encode_png(size: UVec2, linear_rgb: &[Vec3]) -> Result<Vec<u8>, Fault> {
    check_length(size, linear_rgb.len())?;
    let mut code = codes();
    let codes: Vec<u8> = linear_rgb.iter().flat_map(|pixel| pixel.to_array().map(&mut code)).collect();
    encode(size, &codes, ColorType::Rgb)
}

/// As [`encode_png`], in shades of grey: 0 is black, 1 is white, linear light.
///
/// # Errors
/// As [`encode_png`].
pub fn encode_png_grey(size: UVec2, linear_grey: &[f32]) -> Result<Vec<u8>, Fault> {
    check_length(size, linear_grey.len())?;
    let mut code = codes();
    let codes: Vec<u8> = linear_grey.iter().map(|grey| code(*grey)).collect();
    encode(size, &codes, ColorType::Grayscale)
}

/// [`linear_to_srgb8`] of one value after another, many of which are like the one before.
fn codes() -> impl FnMut(f32) -> u8 {
    let mut last = (0.0, linear_to_srgb8(0.0));
    move |linear| {
        if linear != last.0 {
            last = (linear, linear_to_srgb8(linear));
        }
        last.1
    }
}

/// A PNG file's bytes of a quantity: 16 bits of grey without a curve, 0 is 0 and 1 is 65535; below 0 and NaN are 0, above 1 is 65535. A
/// `gAMA` chunk of 1 says so. The same bytes for the same values.
///
/// # Errors
/// As [`encode_png`].
pub fn encode_png_values(size: UVec2, values: &[f32]) -> Result<Vec<u8>, Fault> {
    check_length(size, values.len())?;
    // A NaN has passed the clamp and becomes 0 here.
    let code = |value: &f32| (f64::from(value.clamp(0.0, 1.0)) * 65535.0 + 0.5) as u16;
    let codes: Vec<u8> = values.iter().flat_map(|value| code(value).to_be_bytes()).collect();
    let mut bytes = Vec::new();
    let mut encoder = png::Encoder::new(&mut bytes, size.x, size.y);
    encoder.set_color(ColorType::Grayscale);
    encoder.set_depth(BitDepth::Sixteen);
    encoder.set_source_gamma(png::ScaledFloat::new(1.0));
    write_codes(encoder, size, &codes)?;
    Ok(bytes)
}

/// Writes [`encode_png`]'s bytes, as a whole or not at all.
///
/// # Errors
/// [`IoError`], when the pixels do not fit the size or the system refuses.
pub fn write_png(path: &Path, size: UVec2, linear_rgb: &[Vec3]) -> Result<(), IoError> {
    write_bytes(path, &encode_png(size, linear_rgb).map_err(|fault| fault.in_file(path))?)
}

/// Writes [`encode_png_grey`]'s bytes, as a whole or not at all.
///
/// # Errors
/// As [`write_png`].
pub fn write_png_grey(path: &Path, size: UVec2, linear_grey: &[f32]) -> Result<(), IoError> {
    write_bytes(path, &encode_png_grey(size, linear_grey).map_err(|fault| fault.in_file(path))?)
}

/// Most pixels that are read.
const MOST_PIXELS: u64 = 1 << 26;

/// Reads a PNG file's codes; transparency is dropped, 16 bits become 8. At most 2²⁶ pixels.
///
/// # Errors
/// [`IoError`], when the system refuses or the file is not a PNG of a size within the limit.
pub fn read_png(path: &Path) -> Result<Codes, IoError> {
    decode_png(&read_bytes(path, MOST_PIXELS * 8 + (1 << 20))?).map_err(|fault| fault.in_file(path))
}

/// As [`read_png`], from bytes.
///
/// # Errors
/// A [`Fault`], when the bytes are not a PNG of a size within the limit.
pub fn decode_png(bytes: &[u8]) -> Result<Codes, Fault> {
    let broken = |error: &dyn Display| Fault::new("PNG data", format!("{} bytes", bytes.len()), error);
    let limits = png::Limits { bytes: MOST_PIXELS as usize * 8 };
    let mut decoder = png::Decoder::new_with_limits(Cursor::new(bytes), limits);
    decoder.set_transformations(png::Transformations::EXPAND);
    let (width, height) = decoder.read_header_info().map_err(|error| broken(&error))?.size();
    if u64::from(width) * u64::from(height) > MOST_PIXELS {
        return Err(Fault::new("IHDR size", format!("{width} x {height}"), format!("more than {MOST_PIXELS} pixels")));
    }
    let mut reader = decoder.read_info().map_err(|error| broken(&error))?;
    let length = reader.output_buffer_size().ok_or_else(|| broken(&"more bytes than fit in memory"))?;
    let mut samples = vec![0; length];
    reader.next_frame(&mut samples).map_err(|error| broken(&error))?;
    let (colour, depth) = reader.output_color_type();
    if depth == BitDepth::Sixteen {
        let rounded = |pair: &[u8]| ((u32::from(u16::from_be_bytes([pair[0], pair[1]])) + 128) / 257) as u8;
        samples = samples.chunks_exact(2).map(rounded).collect();
    }
    let grey = matches!(colour, ColorType::Grayscale | ColorType::GrayscaleAlpha);
    let pixel = |samples: &[u8]| if grey { [samples[0]; 3] } else { [samples[0], samples[1], samples[2]] };
    Ok(Codes { size: UVec2::new(width, height), rgb: samples.chunks_exact(colour.samples()).map(pixel).collect() })
}

/// An EXR file's bytes with channels R, G, B as 32-bit floats, linear light, ZIP; the same bytes for the same picture.
///
/// # Errors
/// As [`encode_png`].
pub fn encode_exr(size: UVec2, linear_rgb: &[Vec3]) -> Result<Vec<u8>, Fault> {
    use exr::WritableImage;
    check_length(size, linear_rgb.len())?;
    let width = size.x as usize;
    let pixel = |at: exr::Vec2<usize>| {
        let pixel = linear_rgb[at.y() * width + at.x()];
        (pixel.x, pixel.y, pixel.z)
    };
    let encoding = exr::Encoding {
        compression: exr::Compression::ZIP16,
        blocks: exr::Blocks::ScanLines,
        line_order: exr::LineOrder::Increasing,
    };
    let layer = exr::Layer::new(
        (width, size.y as usize),
        exr::LayerAttributes::default(),
        encoding,
        exr::SpecificChannels::rgb(pixel),
    );
    let mut bytes = Cursor::new(Vec::new());
    let written = exr::Image::from_layer(layer).write().non_parallel().to_buffered(&mut bytes);
    written.map_err(|error| Fault::new("picture", format!("{width} x {}", size.y), error))?;
    Ok(bytes.into_inner())
}

/// An EXR file's bytes of a quantity: one channel Y of 32-bit floats, ZIP; the same bytes for the same values.
///
/// # Errors
/// As [`encode_png`].
pub fn encode_exr_values(size: UVec2, values: &[f32]) -> Result<Vec<u8>, Fault> {
    use exr::WritableImage;
    check_length(size, values.len())?;
    let samples = exr::FlatSamples::F32(values.to_vec());
    let channels = exr::AnyChannels::sort(vec![exr::AnyChannel::new("Y", samples)].into());
    let encoding = exr::Encoding {
        compression: exr::Compression::ZIP16,
        blocks: exr::Blocks::ScanLines,
        line_order: exr::LineOrder::Increasing,
    };
    let layer =
        exr::Layer::new((size.x as usize, size.y as usize), exr::LayerAttributes::default(), encoding, channels);
    let mut bytes = Cursor::new(Vec::new());
    let written = exr::Image::from_layer(layer).write().non_parallel().to_buffered(&mut bytes);
    written.map_err(|error| Fault::new("picture", format!("{} x {}", size.x, size.y), error))?;
    Ok(bytes.into_inner())
}

/// Writes [`encode_exr`]'s bytes, as a whole or not at all.
///
/// # Errors
/// As [`write_png`].
pub fn write_exr(path: &Path, size: UVec2, linear_rgb: &[Vec3]) -> Result<(), IoError> {
    write_bytes(path, &encode_exr(size, linear_rgb).map_err(|fault| fault.in_file(path))?)
}

/// Every pixel as a square of `factor` × `factor` pixels, for zooms that invent nothing. The new size and its pixels;
/// a factor of 0 leaves none.
///
/// # Panics
/// When `pixels` holds fewer than `size.x` × `size.y`, or the new size passes 2³².
pub fn replicate<T: Copy>(size: UVec2, pixels: &[T], factor: u32) -> (UVec2, Vec<T>) {
    let zoomed = UVec2::new(
        size.x.checked_mul(factor).expect("a width below 2^32"),
        size.y.checked_mul(factor).expect("a height below 2^32"),
    );
    let source = |x: u32, y: u32| pixels[(y / factor) as usize * size.x as usize + (x / factor) as usize];
    (zoomed, (0..zoomed.y).flat_map(|y| (0..zoomed.x).map(move |x| source(x, y))).collect())
}

fn check_length(size: UVec2, length: usize) -> Result<(), Fault> {
    let pixels = u64::from(size.x) * u64::from(size.y);
    if pixels == 0 || pixels != length as u64 {
        let problem = format!("{length} pixels do not fill it");
        return Err(Fault::new("picture size", format!("{} x {}", size.x, size.y), problem));
    }
    Ok(())
}

fn encode(size: UVec2, codes: &[u8], colour: ColorType) -> Result<Vec<u8>, Fault> {
    let mut bytes = Vec::new();
    let mut encoder = png::Encoder::new(&mut bytes, size.x, size.y);
    encoder.set_color(colour);
    write_codes(encoder, size, codes)?;
    Ok(bytes)
}

fn write_codes(mut encoder: png::Encoder<'_, &mut Vec<u8>>, size: UVec2, codes: &[u8]) -> Result<(), Fault> {
    encoder.set_compression(png::Compression::Balanced);
    encoder.set_filter(png::Filter::Adaptive);
    let written = encoder.write_header().and_then(|mut writer| writer.write_image_data(codes));
    written.map_err(|error| Fault::new("picture", format!("{} x {}", size.x, size.y), error))
}
