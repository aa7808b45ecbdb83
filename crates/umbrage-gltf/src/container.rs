//! The two forms of a glTF file: JSON, or a binary container of JSON and one buffer.

use crate::GltfError;
use crate::budget::Budget;
use serde_json::Value;

const MAGIC: &[u8] = b"glTF";
const JSON: u32 = 0x4E4F_534A;
const BIN: u32 = 0x004E_4942;

/// The document and the container's own buffer.
pub(crate) fn split<'a>(bytes: &'a [u8], budget: &Budget) -> Result<(Value, Option<&'a [u8]>), GltfError> {
    if !bytes.starts_with(MAGIC) {
        let text = bytes.strip_prefix(b"\xEF\xBB\xBF").unwrap_or(bytes);
        return Ok((parse(text, budget)?, None));
    }
    let header = "a header of 12 bytes";
    let [version, length] = [4, 8]
        .map(|at| word(bytes, at).ok_or_else(|| GltfError::field("glb", format!("{} bytes", bytes.len()), header)));
    let version = version?;
    if version != 2 {
        return Err(GltfError::field("glb.version", version, "2"));
    }
    let length = length?;
    if length as usize != bytes.len() {
        return Err(GltfError::field("glb.length", length, format!("the file's {} bytes", bytes.len())));
    }
    let (kind, json, mut at) = chunk(bytes, 12, 0)?;
    if kind != JSON {
        return Err(GltfError::field("glb.chunks[0].type", format!("{kind:#010x}"), "JSON"));
    }
    let mut bin = None;
    let mut number = 1;
    while at < bytes.len() {
        let (kind, data, next) = chunk(bytes, at, number)?;
        if kind == BIN && number == 1 {
            bin = Some(data);
        }
        (at, number) = (next, number + 1);
    }
    Ok((parse(json, budget)?, bin))
}

fn word(bytes: &[u8], at: usize) -> Option<u32> {
    bytes.get(at..).and_then(|rest| rest.first_chunk()).map(|word| u32::from_le_bytes(*word))
}

/// A chunk's type and data, and where the next one begins.
fn chunk(bytes: &[u8], at: usize, number: usize) -> Result<(u32, &[u8], usize), GltfError> {
    let left = bytes.len().saturating_sub(at);
    let path = |field: &str| format!("glb.chunks[{number}]{field}");
    let (Some(length), Some(kind)) = (word(bytes, at), word(bytes, at.saturating_add(4))) else {
        return Err(GltfError::field(path(""), format!("{left} bytes"), "a header of 8 bytes"));
    };
    let begin = at.saturating_add(8);
    let end = begin.saturating_add(length as usize);
    let Some(data) = bytes.get(begin..end) else {
        return Err(GltfError::field(path(".length"), length, format!("at most {} bytes", left.saturating_sub(8))));
    };
    Ok((kind, data, end))
}

/// The document, once it is known what it may take in memory.
fn parse(text: &[u8], budget: &Budget) -> Result<Value, GltfError> {
    let mut bytes = text.len() as u64;
    for letter in text {
        // What the parser allocates at most for a member, an array with its first members, and an object's first node. Letters in
        // texts are counted too: too much rather than too little.
        bytes = bytes.saturating_add(match letter {
            b',' => 100,
            b'[' => 200,
            b'{' => 800,
            _ => 0,
        });
    }
    budget.charge("json", bytes, 1)?;
    let value: Value = serde_json::from_slice(text).map_err(|error| GltfError::Json(error.to_string()))?;
    if value.is_object() { Ok(value) } else { Err(GltfError::Json("not an object".into())) }
}
