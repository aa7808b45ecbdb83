//! Where a buffer's bytes come from: the text itself, or a plain file below the scene's folder.

use crate::GltfError;
use crate::budget::Budget;
use crate::error::quoted;
use base64::Engine as _;
use base64::alphabet::STANDARD;
use base64::engine::{DecodePaddingMode, GeneralPurpose, GeneralPurposeConfig};
use std::fs::File;
use std::io::Read as _;
use std::path::{Path, PathBuf};

/// The first `length` bytes that an address names, or all where there are fewer. `path` is the field that holds the address.
pub(crate) fn fetch(
    path: &str,
    uri: &str,
    length: usize,
    folder: Option<&Path>,
    budget: &Budget,
) -> Result<Vec<u8>, GltfError> {
    match uri.get(..5) {
        Some(scheme) if scheme.eq_ignore_ascii_case("data:") => inline(path, uri, budget),
        _ => beside(path, uri, length, folder, budget),
    }
}

/// What a data URI holds.
fn inline(path: &str, uri: &str, budget: &Budget) -> Result<Vec<u8>, GltfError> {
    let wrong = |expected: &str| GltfError::field(path, quoted(uri), expected);
    let data = uri.split_once(',').filter(|(head, _)| head.to_ascii_lowercase().ends_with(";base64"));
    let (_, data) = data.ok_or_else(|| wrong("a data URI in base64"))?;
    budget.charge(path, data.len() as u64, 1)?;
    let forgiving = GeneralPurposeConfig::new().with_decode_padding_mode(DecodePaddingMode::Indifferent);
    GeneralPurpose::new(&STANDARD, forgiving).decode(data).map_err(|_| wrong("base64 without faults"))
}

/// What a file beside the scene holds.
fn beside(path: &str, uri: &str, length: usize, folder: Option<&Path>, budget: &Budget) -> Result<Vec<u8>, GltfError> {
    let wrong = |expected: &str| GltfError::field(path, quoted(uri), expected);
    let io = |fault| GltfError::Io { path: format!("{path} {}", quoted(uri)), fault };
    let relative = relative(uri).ok_or_else(|| wrong("a plain relative path below the scene's folder"))?;
    let folder = folder.ok_or_else(|| wrong("a data URI: this scene has no folder"))?;
    let home = folder.canonicalize().map_err(io)?;
    let file = home.join(relative).canonicalize().map_err(io)?;
    if !file.starts_with(&home) {
        return Err(wrong("a file below the scene's folder, not a link that leaves it"));
    }
    regular(path, &file, length as u64, budget)
}

/// The first `most` bytes of a regular file. Devices and pipes are refused before they are opened.
pub(crate) fn regular(path: &str, file: &Path, most: u64, budget: &Budget) -> Result<Vec<u8>, GltfError> {
    let io = |fault| GltfError::Io { path: path.to_owned(), fault };
    let about = file.metadata().map_err(io)?;
    if !about.is_file() {
        return Err(GltfError::field(path, quoted(&file.to_string_lossy()), "a regular file"));
    }
    let length = about.len().min(most);
    budget.charge(path, length, 1)?;
    let mut bytes = Vec::new();
    File::open(file).and_then(|file| file.take(length).read_to_end(&mut bytes)).map_err(io)?;
    Ok(bytes)
}

/// A URI as a path that goes down only; `None` for anything else.
fn relative(uri: &str) -> Option<PathBuf> {
    let plain = |letter: char| !letter.is_control() && !matches!(letter, '\\' | ':' | '?' | '#');
    if !uri.chars().all(plain) {
        return None;
    }
    let text = String::from_utf8(unescaped(uri.as_bytes())?).ok()?;
    // What was escaped must be plain too, but a file's name may hold these two.
    let fits = text.chars().all(|letter| plain(letter) || matches!(letter, '?' | '#'));
    let down = text.split('/').all(|part| !matches!(part, "" | "." | ".."));
    (fits && down).then(|| PathBuf::from(text))
}

/// `%20` and its like as the bytes that they stand for.
fn unescaped(uri: &[u8]) -> Option<Vec<u8>> {
    let digit = |letter: u8| char::from(letter).to_digit(16).map(|digit| digit as u8);
    let mut bytes = Vec::with_capacity(uri.len());
    let mut rest = uri;
    while let [first, after @ ..] = rest {
        rest = after;
        if *first == b'%' {
            let [high, low, after @ ..] = rest else { return None };
            bytes.push(digit(*high)? * 16 + digit(*low)?);
            rest = after;
        } else {
            bytes.push(*first);
        }
    }
    Some(bytes)
}
