//! What a package of the command holds: the program, its manual pages and its shell completions.

use crate::programs::cargo;
use anyhow::Context as _;
use std::path::Path;
use std::process::Command;

/// Builds the command and fills `target/dist` anew. Whether all went well.
pub fn run(root: &Path) -> anyhow::Result<bool> {
    let built =
        Command::new(cargo()).args(["build", "--release", "--package", "umbrage-cli"]).current_dir(root).status();
    if !built.context("cargo build")?.success() {
        return Ok(false);
    }
    let target = std::env::var_os("CARGO_TARGET_DIR").map_or_else(|| root.join("target"), Into::into);
    let program = target.join("release").join(format!("umbrage{}", std::env::consts::EXE_SUFFIX));
    let folder = root.join("target/dist");
    if folder.exists() {
        std::fs::remove_dir_all(&folder).with_context(|| folder.display().to_string())?;
    }
    std::fs::create_dir_all(&folder).with_context(|| folder.display().to_string())?;
    for what in ["man", "completions"] {
        let made = Command::new(&program).args(["generate", what]).arg(folder.join(what)).status();
        if !made.with_context(|| program.display().to_string())?.success() {
            return Ok(false);
        }
    }
    let copy = folder.join(program.file_name().context("a program has a name")?);
    std::fs::copy(&program, &copy).with_context(|| copy.display().to_string())?;
    println!("{} holds the program, man/ and completions/", folder.display());
    Ok(true)
}
