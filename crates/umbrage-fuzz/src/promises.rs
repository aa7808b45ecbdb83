//! What every reader promises, whatever the format.

use std::fmt::Display;

/// Most memory that reading a file may take, bytes: 64 MiB and eight times the file.
pub fn most_bytes(file: &[u8]) -> u64 {
    (64 << 20) + 8 * file.len() as u64
}

/// Checks that an error is one line, short enough to read.
///
/// # Panics
/// When it is not.
pub(crate) fn assert_line(refusal: impl Display) {
    let line = refusal.to_string();
    assert!(!line.is_empty() && line.len() < 1000, "{} bytes: {line:?}", line.len());
    assert!(!line.contains(char::is_control), "{line:?}");
}
