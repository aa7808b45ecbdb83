//! PNG and JPEG images as texels of red, green, blue and alpha, eight bits each, as they are coded.

use glam::UVec2;
use png::{ColorType, Limits, Transformations};
use std::fmt::Display;
use std::io::Cursor;
use zune_jpeg::JpegDecoder;
use zune_jpeg::zune_core::colorspace::ColorSpace;
use zune_jpeg::zune_core::options::DecoderOptions;

/// Longest side that is read: the longest that JPEG can store.
const MOST_SIDE: u32 = 65_535;

/// Why an image was not decoded.
pub(crate) enum ImageError<E> {
    /// The decoder's error, or that the format is not known.
    Unreadable(String),
    /// The error by which the caller refused its size.
    Refused(E),
}

impl<E> ImageError<E> {
    fn of(fault: impl Display) -> Self {
        Self::Unreadable(fault.to_string())
    }
}

/// Columns and rows of an image, and its texels, row after row. Its size is given to `allow` before anything is allocated for them.
pub(crate) fn decode<E>(
    bytes: &[u8],
    allow: impl Fn(UVec2) -> Result<(), E>,
) -> Result<(UVec2, Vec<[u8; 4]>), ImageError<E>> {
    let allow = |size: UVec2| match size.max_element() {
        1..=MOST_SIDE => allow(size).map_err(ImageError::Refused),
        _ => Err(ImageError::of(format_args!("{} x {} texels", size.x, size.y))),
    };
    match bytes {
        [0x89, b'P', b'N', b'G', ..] => png(bytes, allow),
        [0xFF, 0xD8, ..] => jpeg(bytes, allow),
        _ => Err(ImageError::of("neither PNG nor JPEG")),
    }
}

type Decoded<E> = Result<(UVec2, Vec<[u8; 4]>), ImageError<E>>;

fn png<E>(bytes: &[u8], allow: impl Fn(UVec2) -> Result<(), ImageError<E>>) -> Decoded<E> {
    let mut decoder = png::Decoder::new_with_limits(Cursor::new(bytes), Limits { bytes: 1 << 20 });
    decoder.set_transformations(Transformations::normalize_to_color8() | Transformations::ALPHA);
    let header = decoder.read_header_info().map_err(ImageError::of)?;
    let size = UVec2::new(header.width, header.height);
    allow(size)?;
    let count = size.x as usize * size.y as usize;
    decoder.set_limits(Limits { bytes: (1 << 20) + 8 * count });
    let mut reader = decoder.read_info().map_err(ImageError::of)?;
    let needed = reader.output_buffer_size().ok_or_else(|| ImageError::of("larger than memory"))?;
    let mut samples = vec![0; needed];
    let info = reader.next_frame(&mut samples).map_err(ImageError::of)?;
    let texels = match info.color_type {
        ColorType::GrayscaleAlpha => {
            samples.as_chunks().0.iter().map(|&[grey, alpha]: &[u8; 2]| [grey, grey, grey, alpha]).collect()
        }
        _ => samples.as_chunks().0.to_vec(),
    };
    Ok((size, texels))
}

fn jpeg<E>(bytes: &[u8], allow: impl Fn(UVec2) -> Result<(), ImageError<E>>) -> Decoded<E> {
    let options = DecoderOptions::default().set_max_width(MOST_SIDE as usize).set_max_height(MOST_SIDE as usize);
    let options = options.jpeg_set_out_colorspace(ColorSpace::RGBA);
    let mut decoder = JpegDecoder::new_with_options(Cursor::new(bytes), options);
    decoder.decode_headers().map_err(ImageError::of)?;
    let info = decoder.info().ok_or_else(|| ImageError::of("no size"))?;
    if info.components == 4 {
        return Err(ImageError::of("of four inks (CMYK), which no glTF file may have"));
    }
    let size = UVec2::new(info.width.into(), info.height.into());
    allow(size)?;
    let samples = decoder.decode().map_err(ImageError::of)?;
    Ok((size, samples.as_chunks().0.to_vec()))
}
