//! Files as they are written: any number of parts, flat or deep.

use super::parts::{MOST_HEADER_BYTES, MOST_PARTS};
use crate::error::Fault;
use exr::error::UnitResult;
use exr::meta::attribute::{self, BlockType};
use exr::meta::header::{Header, standard_names};
use exr::meta::{BlockDescription, Requirements, magic_number, sequence_end};
use exr::prelude::{AttributeValue, Text};
use std::collections::HashSet;

/// Longest name of a part, bytes.
const MOST_NAME_BYTES: usize = 255;

/// A part that is to be written.
pub(crate) struct Part<'a> {
    /// Its `chunk_count` is how many blocks it has.
    pub header: Header,
    /// An attribute beside those of the header: of those that the library does not know it keeps the order of one only.
    pub further: Option<(&'static str, AttributeValue)>,
    /// True for deep scan lines: the library describes flat images only, but otherwise their headers are the same.
    pub deep: bool,
    /// A block, by its number: what stands behind the part's, packed.
    pub block: Box<dyn Fn(usize) -> Result<Vec<u8>, String> + 'a>,
}

/// A name as that of a part.
pub(crate) fn part_name(name: &str) -> Result<Text, Fault> {
    let fits = (1..=MOST_NAME_BYTES).contains(&name.len()) && !name.chars().any(char::is_control);
    let text = Text::new_or_none(name).filter(|_| fits);
    let problem = || format!("not a name of 1 to {MOST_NAME_BYTES} bytes, printable and of Latin letters");
    text.ok_or_else(|| Fault::new("name", name, problem()))
}

/// What a file says of a part before its blocks: the fields of [`Part`].
#[derive(Clone, Copy)]
pub(crate) struct Head<'a> {
    pub header: &'a Header,
    pub further: Option<&'a (&'static str, AttributeValue)>,
    pub deep: bool,
}

impl Part<'_> {
    fn head(&self) -> Head<'_> {
        Head { header: &self.header, further: self.further.as_ref(), deep: self.deep }
    }
}

/// The bytes of a file; the same bytes for the same parts.
pub(crate) fn encode(parts: &[Part<'_>]) -> Result<Vec<u8>, Fault> {
    let heads: Vec<Head<'_>> = parts.iter().map(Part::head).collect();
    let (mut bytes, mut entry) = start(&heads)?;
    for (number, part) in parts.iter().enumerate() {
        for index in 0..part.header.chunk_count {
            let offset = bytes.len() as u64;
            bytes[entry..entry + 8].copy_from_slice(&offset.to_le_bytes());
            entry += 8;
            if parts.len() > 1 {
                bytes.extend((number as u32).to_le_bytes());
            }
            let block = (part.block)(index);
            let unwritable = |error| Fault::new(format!("part {}", name(&part.header)), "unwritable", error);
            bytes.extend(block.map_err(unwritable)?);
        }
    }
    Ok(bytes)
}

/// What stands before a file's blocks, with an offset table of zeros; and where that table begins.
pub(crate) fn start(parts: &[Head<'_>]) -> Result<(Vec<u8>, usize), Fault> {
    if !(1..=MOST_PARTS).contains(&parts.len()) {
        return Err(Fault::new("parts", parts.len(), format!("not within 1..={MOST_PARTS}")));
    }
    let mut names = HashSet::new();
    if let Some(twice) = parts.iter().map(|part| name(part.header)).find(|name| !names.insert(name.clone())) {
        return Err(Fault::new("name", twice, "two parts are to be called that"));
    }
    let mut bytes = Vec::new();
    write_headers(parts, &mut bytes).map_err(|error| Fault::new("header", "unwritable", error))?;
    if bytes.len() as u64 > MOST_HEADER_BYTES {
        return Err(Fault::new("header", format!("{} bytes", bytes.len()), format!("more than {MOST_HEADER_BYTES}")));
    }
    let table = bytes.len();
    let blocks: usize = parts.iter().map(|part| part.header.chunk_count).sum();
    bytes.resize(table + 8 * blocks, 0);
    Ok((bytes, table))
}

fn name(header: &Header) -> String {
    header.own_attributes.layer_name.clone().unwrap_or_default().to_string()
}

fn write_headers(parts: &[Head<'_>], bytes: &mut Vec<u8>) -> UnitResult {
    magic_number::write(bytes)?;
    let several = parts.len() > 1;
    let has_deep_data = parts.iter().any(|part| part.deep);
    let tiled = |part: &Head<'_>| matches!(part.header.blocks, BlockDescription::Tiles(_));
    let flags = Requirements {
        file_format_version: 2,
        is_single_layer_and_tiled: !several && parts.iter().any(tiled),
        has_long_names: false,
        has_deep_data,
        has_multiple_layers: several,
    };
    flags.write(bytes)?;
    for part in parts {
        for (name, value) in part.header.all_named_attributes() {
            let deep = AttributeValue::BlockType(BlockType::DeepScanLine);
            let value = if part.deep && name == standard_names::BLOCK_TYPE { deep } else { value };
            attribute::write(name, &value, bytes)?;
        }
        if let Some((name, value)) = part.further {
            attribute::write(name.as_bytes(), value, bytes)?;
        }
        sequence_end::write(bytes)?;
    }
    if several { sequence_end::write(bytes) } else { Ok(()) }
}
