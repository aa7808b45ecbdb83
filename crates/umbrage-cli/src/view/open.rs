//! The system's browser.

use std::process::{Command, Stdio};

/// The program that opens an address, and its arguments before the address.
const OPENER: (&str, &[&str]) = if cfg!(target_os = "macos") {
    ("open", &[])
} else if cfg!(target_os = "windows") {
    ("rundll32", &["url.dll,FileProtocolHandler"])
} else {
    ("xdg-open", &[])
};

/// Opens an address and does not wait for it.
///
/// # Errors
/// A line that names the program that could not be started.
pub fn in_browser(address: &str) -> Result<(), String> {
    let (program, before) = OPENER;
    let mut command = Command::new(program);
    command.args(before).arg(address).stdin(Stdio::null()).stdout(Stdio::null()).stderr(Stdio::null());
    command.spawn().map(drop).map_err(|error| format!("{program}: {error}; open the address by hand"))
}
