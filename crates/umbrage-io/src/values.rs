//! Pictures of one quantity, such as a fraction in shadow, as they are read.

use crate::error::{Fault, IoError};
use crate::file::read_bytes;
use exr::meta::MetaData;
use exr::prelude::{Compression, ReadChannels, ReadLayers, read};
use glam::UVec2;
use png::{BitDepth, ColorType};
use std::fmt::Display;
use std::io::Cursor;
use std::path::Path;

/// Most pixels that are read.
const MOST_PIXELS: u64 = 1 << 26;
/// Most channels of an EXR file that is read.
const MOST_CHANNELS: usize = 8;
/// What an EXR file starts with.
const EXR_MAGIC: [u8; 4] = [0x76, 0x2f, 0x31, 0x01];

/// A quantity for each pixel.
#[derive(Clone, Debug, PartialEq)]
pub struct Values {
    /// Columns and rows.
    pub size: UVec2,
    /// Rows from the top. Numbers of EXR files may be anything, NaN and infinities too.
    pub values: Vec<f32>,
}

/// Reads a quantity from a PNG or an EXR file, whichever the file is: what [`encode_png_values`](crate::encode_png_values) and
/// [`encode_exr_values`](crate::encode_exr_values) write, and alike files of other makers. At most `most_pixels`, and never more than 2²⁶: reading
/// takes up to 64 bytes for each of them beside the file's own.
///
/// # Errors
/// [`IoError`], when the system refuses or as [`decode_values`].
pub fn read_values(path: &Path, most_pixels: u64) -> Result<Values, IoError> {
    decode_values(&read_bytes(path, MOST_PIXELS * 8 + (1 << 20))?, most_pixels).map_err(|fault| fault.in_file(path))
}

/// As [`read_values`], from bytes.
///
/// Samples of PNG files are taken without a curve, whatever the file says of one: 0 is 0 and the largest code is 1. Transparency is dropped. Of an EXR
/// file's first part with flat pixels, the channel Y counts, or its only channel. Of colours the mean of red, green and blue counts, in both.
///
/// ```
/// use glam::UVec2;
/// use umbrage_io::{decode_values, encode_exr_values, encode_png_values};
///
/// let size = UVec2::new(2, 1);
/// let exact = decode_values(&encode_exr_values(size, &[0.3, 1.0])?, 2)?;
/// assert_eq!((exact.size, exact.values), (size, vec![0.3, 1.0]));
/// let rounded = decode_values(&encode_png_values(size, &[0.3, 1.0])?, 2)?;
/// assert!((rounded.values[0] - 0.3).abs() < 1e-5 && rounded.values[1] == 1.0);
/// let refused = decode_values(&encode_png_values(size, &[0.3, 1.0])?, 1).unwrap_err();
/// assert_eq!(refused.to_string(), "size is 2 x 1: more than the allowed 1 pixels");
/// # Ok::<(), umbrage_io::Fault>(())
/// ```
///
/// # Errors
/// A [`Fault`], when the bytes are neither, or have more pixels than the limit, channels of which none is known, or are EXR packed by
/// anything but none, RLE, ZIPS, ZIP, PIZ and PXR24.
pub fn decode_values(bytes: &[u8], most_pixels: u64) -> Result<Values, Fault> {
    let most = most_pixels.min(MOST_PIXELS);
    if bytes.starts_with(&EXR_MAGIC) { of_exr(bytes, most) } else { of_png(bytes, most) }
}

fn check(width: usize, height: usize, most: u64) -> Result<UVec2, Fault> {
    if (width as u64).saturating_mul(height as u64) > most {
        return Err(Fault::new("size", format!("{width} x {height}"), format!("more than the allowed {most} pixels")));
    }
    Ok(UVec2::new(width as u32, height as u32))
}

fn of_png(bytes: &[u8], most: u64) -> Result<Values, Fault> {
    let broken = |error: &dyn Display| Fault::new("PNG data", format!("{} bytes", bytes.len()), error);
    let limits = png::Limits { bytes: most as usize * 8 + (1 << 20) };
    let mut decoder = png::Decoder::new_with_limits(Cursor::new(bytes), limits);
    decoder.set_ignore_text_chunk(true);
    decoder.set_ignore_iccp_chunk(true);
    decoder.set_transformations(png::Transformations::EXPAND);
    let (width, height) = decoder.read_header_info().map_err(|error| broken(&error))?.size();
    let size = check(width as usize, height as usize, most)?;
    let mut reader = decoder.read_info().map_err(|error| broken(&error))?;
    let length = reader.output_buffer_size().ok_or_else(|| broken(&"more bytes than fit in memory"))?;
    let mut codes = vec![0; length];
    reader.next_frame(&mut codes).map_err(|error| broken(&error))?;
    let (colour, depth) = reader.output_color_type();
    let wide = depth == BitDepth::Sixteen;
    let grey = matches!(colour, ColorType::Grayscale | ColorType::GrayscaleAlpha);
    let colours = if grey { 1 } else { 3 };
    let value = |pixel: &[u8]| {
        let code = |at: usize| {
            if wide { u32::from(u16::from_be_bytes([pixel[2 * at], pixel[2 * at + 1]])) } else { u32::from(pixel[at]) }
        };
        let most = if wide { 65535.0 } else { 255.0 };
        (f64::from((0..colours).map(code).sum::<u32>()) / (most * colours as f64)) as f32
    };
    let bytes_each = colour.samples() * if wide { 2 } else { 1 };
    Ok(Values { size, values: codes.chunks_exact(bytes_each).map(value).collect() })
}

fn of_exr(bytes: &[u8], most: u64) -> Result<Values, Fault> {
    let broken = |error: &dyn Display| Fault::new("EXR data", format!("{} bytes", bytes.len()), error);
    let meta = MetaData::read_from_buffered(Cursor::new(bytes), false).map_err(|error| broken(&error))?;
    for header in &meta.headers {
        check(header.layer_size.width(), header.layer_size.height(), most)?;
        let channels = header.channels.list.len();
        if channels > MOST_CHANNELS {
            return Err(Fault::new("channels", channels, format!("more than {MOST_CHANNELS}")));
        }
    }
    // The others are not known to bear hostile bytes: sums of what unpacks B44 wrap, which stops a build that checks them.
    let coder = meta.headers.iter().find(|header| !header.deep).map(|header| header.compression);
    match coder {
        None
        | Some(
            Compression::Uncompressed
            | Compression::RLE
            | Compression::ZIP1
            | Compression::ZIP16
            | Compression::PIZ
            | Compression::PXR24,
        ) => {}
        Some(other) => {
            let taken = "values are read from none, RLE, ZIPS, ZIP, PIZ and PXR24 only";
            return Err(Fault::new("compression", other, taken));
        }
    }
    let read = read().no_deep_data().largest_resolution_level().all_channels().first_valid_layer().all_attributes();
    let image = read.non_parallel().from_buffered(Cursor::new(bytes)).map_err(|error| broken(&error))?;
    let layer = image.layer_data;
    let channels = layer.channel_data.list;
    let named = |name: &str| channels.iter().find(|channel| channel.name == *name);
    let chosen = match (named("Y"), [named("R"), named("G"), named("B")]) {
        (Some(only), _) => vec![only],
        (None, [Some(red), Some(green), Some(blue)]) => vec![red, green, blue],
        _ if channels.len() == 1 => vec![&channels[0]],
        _ => {
            let names: Vec<String> = channels.iter().map(|channel| channel.name.to_string()).collect();
            return Err(Fault::new("channels", names.join(", "), "expected Y, or R, G and B, or one alone"));
        }
    };
    let size = check(layer.size.width(), layer.size.height(), most)?;
    let mut values = vec![0.0f64; size.element_product() as usize];
    for channel in &chosen {
        for (sum, value) in values.iter_mut().zip(channel.sample_data.values_as_f32()) {
            *sum += f64::from(value);
        }
    }
    Ok(Values { size, values: values.into_iter().map(|sum| (sum / chosen.len() as f64) as f32).collect() })
}
