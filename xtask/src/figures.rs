//! Starts the program that makes the figures, once cargo has built it.

use crate::programs::cargo;
use anyhow::Context as _;
use std::ffi::OsString;
use std::path::Path;
use std::process::{Command, ExitCode};

/// Hands the arguments over, and ends as that program ends; 1 when it could not be built or was killed.
///
/// The build is not told to be quiet: the first one takes minutes, and its user must see that something happens. The run
/// is, as cargo would otherwise print an error of its own below a run that ends with anything but 0.
pub fn run(root: &Path, args: &[OsString]) -> anyhow::Result<ExitCode> {
    eprintln!("Building the program that makes the figures, which takes minutes the first time.");
    let built = cargo_on(root, "build").status().context("cargo build")?;
    if !built.success() {
        return Ok(ExitCode::FAILURE);
    }
    let status = cargo_on(root, "run").arg("--quiet").arg("--").args(args).status().context("cargo run")?;
    Ok(status.code().and_then(|code| u8::try_from(code).ok()).map_or(ExitCode::FAILURE, ExitCode::from))
}

/// `cargo COMMAND` on the figures' program.
fn cargo_on(root: &Path, command: &str) -> Command {
    let mut cargo = Command::new(cargo());
    cargo.args([command, "--release", "--package", "umbrage-figures", "--manifest-path"]).arg(root.join("Cargo.toml"));
    cargo
}
