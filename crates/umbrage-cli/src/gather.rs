//! `umbrage gather`.

use crate::args::{Cli, GatherArgs};
use crate::manifest::{self, parts_of, path_in};
use crate::memory;
use crate::report::written;
use crate::shell::Shell;
use anyhow::bail;
use serde_json::json;
use std::path::{Path, PathBuf};
use umbrage_io::{IoError, file_bytes, read_bytes, write_bytes};

pub fn run(cli: &Cli, args: &GatherArgs, shell: &mut Shell<'_>) -> anyhow::Result<()> {
    let folder = &args.folder;
    // Reads the folder so that a missing one is an error.
    file_bytes(folder)?;
    let parts = parts_of(folder);
    if !path_in(&parts).is_file() {
        shell.note(&format!("{}: nothing to gather", folder.display()));
        return written(cli, shell, &[], [("there", json!(0))]);
    }
    let jobs = manifest::read(&parts)?;
    let is_missing = |(_, part): &&(String, String)| !parts.join(part).is_file();
    let missing: Vec<&str> = jobs.iter().filter(is_missing).map(|(picture, _)| picture.as_str()).collect();
    if !missing.is_empty() {
        let (folder, count, all) = (folder.display(), missing.len(), jobs.len());
        bail!("{folder}: {count} of {all} pictures are not drawn yet: {}", missing.join(", "));
    }
    let mut files: Vec<PathBuf> = Vec::new();
    // A part and the picture that may already be there are both held in memory.
    let most_bytes = cli.max_memory.unwrap_or_else(memory::default) / 2;
    for (picture, part) in &jobs {
        let path = folder.join(picture);
        if place(&parts.join(part), &path, most_bytes)? {
            files.push(path);
        }
    }
    manifest::remove(&parts)?;
    let there = jobs.len() - files.len();
    shell.note(&format!("{}: {} pictures, {there} of them there already", folder.display(), jobs.len()));
    written(cli, shell, &files, [("there", json!(there))])
}

/// Gives a part its name, and returns whether it did not have it before. It is copied rather than renamed, so that if this is
/// interrupted, all parts are still there for the next attempt.
fn place(part: &Path, picture: &Path, most_bytes: u64) -> Result<bool, IoError> {
    let bytes = read_bytes(part, most_bytes)?;
    let is_there = file_bytes(picture).is_ok_and(|length| length == bytes.len() as u64)
        && read_bytes(picture, most_bytes).is_ok_and(|old| old == bytes);
    if !is_there {
        write_bytes(picture, &bytes)?;
    }
    Ok(!is_there)
}
