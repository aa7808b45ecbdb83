//! A second reader and writer of EXR files, small and strict, which shares nothing with the one in `umbrage-io`: what that one writes is
//! held to this one, and files that it never writes are made here.
//!
//! It knows what OpenEXR calls the file layout: attributes, offset tables, chunks. What the attributes mean, and how chunks are packed, is
//! up to whoever asks.

use crate::exr_part::{Chunk, Part};

/// A file, taken apart.
#[derive(Clone, Debug, PartialEq)]
pub struct ExrFile {
    /// The version field with its flags.
    pub version: u32,
    /// In the file's order; one at least.
    pub parts: Vec<Part>,
}

/// Flags of the version field.
const TILED: u32 = 1 << 9;
const DEEP: u32 = 1 << 11;
const SEVERAL_PARTS: u32 = 1 << 12;

/// What is left to read, and how much was there.
struct Cursor<'a> {
    bytes: &'a [u8],
    at: usize,
}

impl<'a> Cursor<'a> {
    fn take(&mut self, count: usize) -> Result<&'a [u8], String> {
        let end = self.at.checked_add(count).filter(|end| *end <= self.bytes.len());
        let end = end.ok_or_else(|| format!("{count} bytes at {} are past the end", self.at))?;
        let taken = &self.bytes[self.at..end];
        self.at = end;
        Ok(taken)
    }

    fn number(&mut self) -> Result<i32, String> {
        let mut word = [0; 4];
        word.copy_from_slice(self.take(4)?);
        Ok(i32::from_le_bytes(word))
    }

    fn length(&mut self) -> Result<usize, String> {
        let number = self.number()?;
        usize::try_from(number).map_err(|_| format!("{number} is not a length"))
    }

    fn long(&mut self) -> Result<u64, String> {
        let mut word = [0; 8];
        word.copy_from_slice(self.take(8)?);
        Ok(u64::from_le_bytes(word))
    }

    fn name(&mut self) -> Result<String, String> {
        let rest = &self.bytes[self.at..];
        let length = rest.iter().take(256).position(|byte| *byte == 0).ok_or("a name without end")?;
        let name = self.take(length)?.to_vec();
        self.take(1)?;
        String::from_utf8(name).map_err(|error| error.to_string())
    }
}

impl ExrFile {
    /// Takes a file apart. Every byte must belong to something.
    ///
    /// # Errors
    /// What is not as the file layout wants it.
    pub fn parse(bytes: &[u8]) -> Result<Self, String> {
        let mut file = Cursor { bytes, at: 0 };
        if file.number()? != 20_000_630 {
            return Err("not the magic number".into());
        }
        let version = file.number()? as u32;
        let several = version & SEVERAL_PARTS != 0;
        if version & !(TILED | DEEP | SEVERAL_PARTS) != 2 {
            return Err(format!("version {version:x}"));
        }
        let mut parts = Vec::new();
        loop {
            let mut attributes: Vec<(String, String, Vec<u8>)> = Vec::new();
            loop {
                let name = file.name()?;
                if name.is_empty() {
                    break;
                }
                if attributes.iter().any(|(known, ..)| *known == name) {
                    return Err(format!("{name} stands twice"));
                }
                let (kind, length) = (file.name()?, file.length()?);
                attributes.push((name, kind, file.take(length)?.to_vec()));
            }
            if attributes.is_empty() {
                break;
            }
            parts.push(Part { attributes, chunks: Vec::new() });
            if !several {
                break;
            }
        }
        for part in &mut parts {
            let offsets = (0..part.chunk_count()?).map(|_| file.long());
            let chunk = |offset: Result<u64, String>| Ok(Chunk { offset: offset? as usize, ..Chunk::default() });
            part.chunks = offsets.map(chunk).collect::<Result<_, String>>()?;
        }
        let mut ends = vec![file.at];
        for (number, part) in parts.iter_mut().enumerate() {
            let (tiled, deep) = (part.is_tiled(), part.is_deep());
            for chunk in &mut part.chunks {
                let mut at = Cursor { bytes, at: chunk.offset };
                if several && at.length()? != number {
                    return Err(format!("the chunk at {} is of another part", chunk.offset));
                }
                chunk.place = (0..if tiled { 4 } else { 1 }).map(|_| at.number()).collect::<Result<_, _>>()?;
                if deep {
                    let (table, samples, unpacked) = (at.long()?, at.long()?, at.long()?);
                    chunk.deep = Some((at.take(table as usize)?.to_vec(), unpacked));
                    chunk.packed = at.take(samples as usize)?.to_vec();
                } else {
                    let length = at.length()?;
                    chunk.packed = at.take(length)?.to_vec();
                }
                ends.push(at.at);
            }
        }
        // Chunks lie one behind the other, from the tables to the end of the file.
        let starts = parts.iter().flat_map(|part| &part.chunks).map(|chunk| chunk.offset);
        let mut starts: Vec<usize> = starts.chain([bytes.len()]).collect();
        starts.sort_unstable();
        ends.sort_unstable();
        if starts == ends { Ok(Self { version, parts }) } else { Err("gaps or overlaps between chunks".into()) }
    }

    /// The file with the parts' chunks one behind the other, each part's in the order of `order`, which holds the number of every chunk of
    /// the longest part once. Offset tables point to where chunks are.
    pub fn to_bytes(&self, order: &[usize]) -> Vec<u8> {
        let mut bytes = 20_000_630i32.to_le_bytes().to_vec();
        bytes.extend(self.version.to_le_bytes());
        let several = self.version & SEVERAL_PARTS != 0;
        for part in &self.parts {
            for (name, kind, value) in &part.attributes {
                for text in [name, kind] {
                    bytes.extend(text.bytes().chain([0]));
                }
                bytes.extend((value.len() as i32).to_le_bytes());
                bytes.extend(value);
            }
            bytes.push(0);
        }
        bytes.extend(several.then_some(0));
        let mut table = bytes.len();
        bytes.resize(table + self.parts.iter().map(|part| 8 * part.chunks.len()).sum::<usize>(), 0);
        for (number, part) in self.parts.iter().enumerate() {
            for &index in order.iter().filter(|index| **index < part.chunks.len()) {
                let offset = bytes.len() as u64;
                bytes[table + 8 * index..][..8].copy_from_slice(&offset.to_le_bytes());
                let chunk = &part.chunks[index];
                bytes.extend(several.then_some((number as i32).to_le_bytes()).into_iter().flatten());
                bytes.extend(chunk.place.iter().flat_map(|number| number.to_le_bytes()));
                if let Some((table, unpacked)) = &chunk.deep {
                    for length in [table.len() as u64, chunk.packed.len() as u64, *unpacked] {
                        bytes.extend(length.to_le_bytes());
                    }
                    bytes.extend(table);
                } else {
                    bytes.extend((chunk.packed.len() as i32).to_le_bytes());
                }
                bytes.extend(&chunk.packed);
            }
            table += 8 * part.chunks.len();
        }
        bytes
    }
}
