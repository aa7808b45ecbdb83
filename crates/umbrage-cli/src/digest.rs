//! Digests of what a picture is drawn from.

use crate::memory::{self, Need};
use crate::stage::GALLERY;
use serde_json::Value;
use std::path::{Component, Path, PathBuf};
use umbrage_io::{file_bytes, read_bytes};

/// A number that depends on every byte that it is given, in order (128-bit FNV-1a). It is not cryptographic: other bytes with the same
/// number can be found on purpose.
pub struct Digest(u128);

impl Digest {
    pub fn new() -> Self {
        Self(0x6C62_272E_07BB_0142_62B8_2175_6295_C58D)
    }

    /// With a text or the bytes of a file after what was there before. Its length goes in first, so that no two lists of texts are alike
    /// because one text ends where another begins.
    pub fn with(self, bytes: &[u8]) -> Self {
        let fold =
            |hash: u128, byte: u8| (hash ^ u128::from(byte)).wrapping_mul(0x0000_0000_0100_0000_0000_0000_0000_013B);
        let length = (bytes.len() as u64).to_le_bytes();
        Self(length.into_iter().chain(bytes.iter().copied()).fold(self.0, fold))
    }

    /// 32 hexadecimal digits.
    pub fn text(&self) -> String {
        format!("{:032x}", self.0)
    }
}

/// The digest of a scene: of its file and of the files that it names, or of the name of one that is built in.
///
/// # Errors
/// A file that cannot be read, or one for which there is too little memory.
pub fn of_scene(source: &str, max_memory: Option<u64>) -> anyhow::Result<String> {
    if source.starts_with(GALLERY) {
        return Ok(Digest::new().with(source.as_bytes()).text());
    }
    let path = Path::new(source);
    let bytes = read(path, max_memory)?;
    let mut digest = Digest::new().with(&bytes);
    for file in beside(&bytes) {
        let path = path.parent().unwrap_or(Path::new("")).join(&file);
        // A scene can be read without some of its files, so a missing one is not an error here either.
        let there = path.is_file().then(|| read(&path, max_memory)).transpose()?;
        digest = digest.with(file.to_string_lossy().as_bytes()).with(&there.unwrap_or_default());
    }
    Ok(digest.text())
}

fn read(path: &Path, max_memory: Option<u64>) -> anyhow::Result<Vec<u8>> {
    let most = max_memory.unwrap_or_else(memory::default);
    let file_bytes = file_bytes(path)?;
    let fits = Need { file_bytes, ..Need::default() }.check(max_memory);
    fits.map_err(|error| error.context(path.display().to_string()))?;
    Ok(read_bytes(path, most)?)
}

/// The files that a glTF file names, in order; none where it is damaged, which its reader reports.
fn beside(bytes: &[u8]) -> Vec<PathBuf> {
    /// The header of a binary file, and those of its first chunk, which is the document.
    const HEADERS: usize = 20;
    let document = match bytes.strip_prefix(b"glTF").and_then(|_| bytes.get(12..16)?.try_into().ok()) {
        Some(length) => bytes.get(HEADERS..).map(|rest| &rest[..rest.len().min(u32::from_le_bytes(length) as usize)]),
        None => Some(bytes),
    };
    let document: Value = document.and_then(|text| serde_json::from_slice(text).ok()).unwrap_or_default();
    let listed = ["buffers", "images"].into_iter().filter_map(|list| document[list].as_array()).flatten();
    listed.filter_map(|item| relative(item["uri"].as_str()?)).collect()
}

/// A URI as a path that goes down only, which is what the reader of scenes follows.
fn relative(uri: &str) -> Option<PathBuf> {
    let mut bytes = Vec::new();
    let mut rest = uri.bytes();
    while let Some(byte) = rest.next() {
        let mut digit = || char::from(rest.next()?).to_digit(16);
        bytes.push(if byte == b'%' { (digit()? * 16 + digit()?) as u8 } else { byte });
    }
    let path = PathBuf::from(String::from_utf8(bytes).ok()?);
    let goes_down = path.components().all(|part| matches!(part, Component::Normal(_)));
    (goes_down && !uri.contains(':')).then_some(path)
}
