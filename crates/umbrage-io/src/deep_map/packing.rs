use crate::shadow_map::MOST_BYTES_PER_BYTE;
use exr::meta::BlockDescription;
use exr::meta::header::Header;
use exr::prelude::{ChannelDescription, Compression, IntegerBounds, LineOrder, SampleType, Text, Vec2};

/// Longer rows are neither written nor read: the coder counts in 31 bits.
const MOST_BYTES: usize = 1 << 30;

/// What our files are packed with: ZIPS, the strongest that deep files may have.
pub(super) const PACKING: Compression = Compression::ZIP1;

/// A row's little-endian bytes, packed unless that makes them no shorter; nothing stays nothing.
pub(super) fn pack(bytes: Vec<u8>) -> Result<Vec<u8>, String> {
    if bytes.is_empty() {
        return Ok(bytes);
    }
    let (header, section) = stand_in(bytes.len(), PACKING)?;
    let packed = PACKING.compress_image_section_to_le(&header, turned(bytes), section);
    packed.map_err(|error| error.to_string())
}

/// The `expected` little-endian bytes that were packed.
pub(super) fn unpack(packing: Compression, packed: &[u8], expected: usize) -> Result<Vec<u8>, String> {
    let plausible = packed.len() <= expected && packed.len().saturating_mul(MOST_BYTES_PER_BYTE) >= expected;
    if !plausible || (packing == Compression::Uncompressed && packed.len() != expected) {
        return Err(format!("no such number of bytes packs {expected}"));
    }
    if expected == 0 {
        return Ok(Vec::new());
    }
    let (header, section) = stand_in(expected, packing)?;
    let bytes = packing.decompress_image_section_from_le(&header, packed.to_vec(), section, true);
    let bytes = bytes.map(turned).map_err(|error| error.to_string())?;
    if bytes.len() == expected { Ok(bytes) } else { Err(format!("should unpack to {expected} bytes")) }
}

/// The coder knows flat images only. Bytes are bytes to it: they pass as one row of 16-bit numbers.
fn stand_in(bytes: usize, packing: Compression) -> Result<(Header, IntegerBounds), String> {
    if bytes > MOST_BYTES || !bytes.is_multiple_of(2) {
        return Err(format!("{bytes} bytes are odd or more than {MOST_BYTES} in a row"));
    }
    let numbers = ChannelDescription {
        name: Text::from("Y"),
        sample_type: SampleType::F16,
        quantize_linearly: false,
        sampling: Vec2(1, 1),
    };
    let size = Vec2(bytes / 2, 1);
    let header = Header::new(Text::from("row"), size, std::iter::once(numbers).collect());
    let header = header.with_encoding(packing, BlockDescription::ScanLines, LineOrder::Increasing);
    Ok((header, IntegerBounds::from_dimensions(size)))
}

/// From the file's order of bytes to the machine's, in which the coder wants its numbers, or back.
fn turned(mut bytes: Vec<u8>) -> Vec<u8> {
    for number in bytes.as_chunks_mut::<2>().0 {
        *number = u16::from_le_bytes(*number).to_ne_bytes();
    }
    bytes
}
