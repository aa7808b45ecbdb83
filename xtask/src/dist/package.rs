//! What all packages share: what is in them, and how they are made.

use anyhow::{Context as _, ensure};
use std::ffi::OsStr;
use std::path::{Path, PathBuf};
use std::process::Command;

/// The program's name.
pub const NAME: &str = "umbrage";
/// Texts that go with the program.
pub const TEXTS: [&str; 3] = ["LICENSE-MIT", "LICENSE-APACHE", "CHANGELOG.md"];

/// What is packed.
pub struct Package {
    /// Of the workspace.
    pub version: String,
    /// As rustc names the machine, such as `x86_64-unknown-linux-gnu`.
    pub machine: String,
    /// A folder with the program, `man`, `completions` and the texts.
    pub folder: PathBuf,
}

/// Copies a file, its permissions too.
pub fn copied(from: &Path, to: &Path) -> anyhow::Result<()> {
    std::fs::copy(from, to).with_context(|| format!("{} to {}", from.display(), to.display())).map(drop)
}

/// What a program prints, which must succeed.
pub fn output(command: &mut Command) -> anyhow::Result<String> {
    let name = OsStr::to_string_lossy(command.get_program()).into_owned();
    let output = command.output().with_context(|| name.clone())?;
    ensure!(output.status.success(), "{name}: {}", String::from_utf8_lossy(&output.stderr).trim());
    Ok(String::from_utf8_lossy(&output.stdout).into_owned())
}
