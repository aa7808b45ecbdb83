//! The program of `umbrage-bench` and what compiles it.

use crate::programs::cargo;
use anyhow::{Context as _, ensure};
use std::path::{Path, PathBuf};
use std::process::Command;

/// How the program is compiled.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Flags {
    /// As a user's own release build.
    Default,
    /// For this machine's processor, with fat LTO.
    Native,
}

/// Builds the program; where it lies.
pub fn built(root: &Path, flags: Flags) -> anyhow::Result<PathBuf> {
    let target = std::env::var_os("CARGO_TARGET_DIR").map_or_else(|| root.join("target"), |folder| root.join(folder));
    let mut command = Command::new(cargo());
    command.args(["build", "--release", "--package", "umbrage-bench", "--bin", "bench-report"]).current_dir(root);
    let target = match flags {
        Flags::Default => target,
        Flags::Native => {
            // A folder of its own, so that neither build throws the other's away.
            let target = target.join("native");
            command.env("RUSTFLAGS", "-C target-cpu=native").env("CARGO_PROFILE_RELEASE_LTO", "fat");
            command.env("CARGO_PROFILE_RELEASE_CODEGEN_UNITS", "1");
            target
        }
    };
    command.env("CARGO_TARGET_DIR", &target);
    ensure!(command.status().context("cargo build")?.success(), "umbrage-bench could not be built");
    Ok(target.join("release").join(format!("bench-report{}", std::env::consts::EXE_SUFFIX)))
}

/// The compiler's version, a line.
pub fn rustc() -> anyhow::Result<String> {
    let output = Command::new("rustc").arg("-V").output().context("rustc -V")?;
    Ok(String::from_utf8(output.stdout)?.trim().to_string())
}
