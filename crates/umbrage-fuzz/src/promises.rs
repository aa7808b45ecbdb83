//! What holds of every file, whatever its format.

use std::fmt::Display;

/// Most memory that reading a file may take, bytes: 64 MiB and eight times the file.
pub fn most_bytes(file: &[u8]) -> u64 {
    (64 << 20) + 8 * file.len() as u64
}

/// A refusal is one line of a length that people read.
///
/// # Panics
/// When it is not.
pub(crate) fn assert_line(refusal: impl Display) {
    let line = refusal.to_string();
    assert!(!line.is_empty() && line.len() < 1000, "{} bytes: {line:?}", line.len());
    assert!(!line.contains(char::is_control), "{line:?}");
}
