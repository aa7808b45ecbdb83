//! Starts the program that makes the figures, once cargo has built it.

use crate::programs::cargo;
use anyhow::Context as _;
use std::ffi::OsString;
use std::path::Path;
use std::process::{Command, ExitCode};

/// What cargo itself ends with when it cannot build.
const NOT_BUILT: i32 = 101;

/// Hands the arguments over, and ends as that program ends; 1 when it could not be built or was killed.
///
/// Cargo is not told to be quiet: the first build takes minutes, and its user must see that something happens.
pub fn run(root: &Path, args: &[OsString]) -> anyhow::Result<ExitCode> {
    let mut command = Command::new(cargo());
    command.args(["run", "--release", "--package", "umbrage-figures", "--manifest-path"]);
    command.arg(root.join("Cargo.toml")).arg("--").args(args);
    let status = command.status().context("cargo run")?;
    Ok(match status.code() {
        Some(NOT_BUILT) | None => ExitCode::FAILURE,
        Some(code) => u8::try_from(code).map_or(ExitCode::FAILURE, ExitCode::from),
    })
}
