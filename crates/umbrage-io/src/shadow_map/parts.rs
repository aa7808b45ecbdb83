//! The headers of a file, and where each of its parts has its blocks.

use super::layout::check_levels;
use crate::error::Fault;
use exr::meta::MetaData;
use exr::meta::header::Header;
use exr::prelude::Text;
use std::collections::HashSet;
use std::io::{BufRead, Read};

/// Longer headers, those of all parts together, are neither read nor written.
pub(crate) const MOST_HEADER_BYTES: u64 = 1 << 22;

/// Files of more parts are neither read nor written.
pub(crate) const MOST_PARTS: usize = 2048;

/// What a file holds before its blocks.
#[derive(Debug)]
pub(crate) struct Parts {
    pub meta: MetaData,
    /// Where the file has each block of each part; all different, all behind the tables and inside the file.
    tables: Vec<Vec<u64>>,
}

impl Parts {
    /// From the start of a file of `length` bytes, of which nothing behind the offset tables is read.
    pub fn read(file: impl BufRead, length: u64, most_blocks: u64) -> Result<Self, Fault> {
        let most = length.min(MOST_HEADER_BYTES);
        let mut file = file.take(most);
        let meta = MetaData::read_from_buffered(&mut file, true);
        let position = most - file.limit();
        let meta = meta.map_err(|error| match position {
            MOST_HEADER_BYTES => Fault::new("header", "unreadable", format!("it passes {position} bytes")),
            _ => Fault::new("header", "unreadable", error),
        })?;
        let count = meta.headers.len();
        if !(1..=MOST_PARTS).contains(&count) {
            return Err(Fault::new("parts", count, format!("not within 1..={MOST_PARTS}")));
        }
        if let [only] = meta.headers.as_slice() {
            // Said before the number of blocks is, which the levels add to.
            check_levels(only)?;
        }
        let counts = meta.headers.iter().map(|header| header.chunk_count as u64);
        let all = counts.fold(0, u64::saturating_add);
        if all > most_blocks {
            return Err(Fault::new("offset table", all, format!("more than the allowed {most_blocks} blocks")));
        }
        file.set_limit(length - position);
        let mut rest = offsets(file, position, length, all)?;
        let mut tables = Vec::new();
        for header in meta.headers.iter().rev() {
            tables.push(rest.split_off(rest.len() - header.chunk_count));
        }
        tables.reverse();
        let parts = Self { meta, tables };
        let mut names = HashSet::new();
        match (0..count).map(|index| parts.name(index)).find(|name| !names.insert(name.clone())) {
            Some(twice) => Err(Fault::new("name", twice, "two parts are called that")),
            None => Ok(parts),
        }
    }

    /// Number of parts.
    pub fn count(&self) -> usize {
        self.tables.len()
    }

    pub fn header(&self, part: usize) -> &Header {
        &self.meta.headers[part]
    }

    /// Where the file has a part's blocks.
    pub fn offsets(&self, part: usize) -> &[u64] {
        &self.tables[part]
    }

    /// What a part's blocks begin with: its number, where the file says that it has several parts.
    pub fn mark(&self, part: usize) -> Option<usize> {
        self.meta.requirements.has_multiple_layers.then_some(part)
    }

    /// What a part is called; its number, from 0, where the file has no name for it.
    pub fn name(&self, part: usize) -> String {
        let name = self.header(part).own_attributes.layer_name.as_ref().map(Text::to_string);
        name.filter(|name| !name.is_empty()).unwrap_or_else(|| part.to_string())
    }
}

/// The offset tables of all parts, one behind the other: every block after them, inside the file and in a place of its own. `file` starts with
/// the first table, which is at byte `position` of `length`.
fn offsets(mut file: impl Read, position: u64, length: u64, count: u64) -> Result<Vec<u64>, Fault> {
    let first = count.saturating_mul(8).saturating_add(position);
    if first > length {
        let problem = format!("{count} blocks need more");
        return Err(Fault::new("offset table", format!("{} bytes left", length - position), problem));
    }
    let mut offsets = Vec::new();
    offsets.try_reserve_exact(count as usize).map_err(|full| Fault::new("offset table", count, full))?;
    for index in 0..count {
        let mut entry = [0; 8];
        file.read_exact(&mut entry).map_err(|error| Fault::new("offset table", "unreadable", error))?;
        let offset = u64::from_le_bytes(entry);
        if !(first..length).contains(&offset) {
            let problem = format!("block {index} is not within bytes {first}..{length}");
            return Err(Fault::new("offset table", offset, problem));
        }
        offsets.push(offset);
    }
    let mut sorted = offsets.clone();
    sorted.sort_unstable();
    match sorted.windows(2).find(|pair| pair[0] == pair[1]) {
        Some(pair) => Err(Fault::new("offset table", pair[0], "two blocks in one place")),
        None => Ok(offsets),
    }
}
