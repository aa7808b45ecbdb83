use crate::error::{IoError, system};
use std::fs::{File, Metadata};
use std::io::{self, Read};
use std::path::Path;

/// How long a file is, bytes.
///
/// # Errors
/// [`IoError::System`].
pub fn file_bytes(path: &Path) -> Result<u64, IoError> {
    std::fs::metadata(path).map(|facts| facts.len()).map_err(system(path, "open"))
}

/// Creates a folder and those around it, where they do not exist.
///
/// # Errors
/// [`IoError::System`].
pub fn create_folder(path: &Path) -> Result<(), IoError> {
    std::fs::create_dir_all(path).map_err(system(path, "create"))
}

/// Removes a folder and all that is in it; links in it are removed and not followed.
///
/// # Errors
/// [`IoError::System`].
pub fn remove_folder(path: &Path) -> Result<(), IoError> {
    std::fs::remove_dir_all(path).map_err(system(path, "remove"))
}

/// All memory of the machine, bytes; `None` where the system does not say so in `/proc/meminfo`.
pub fn machine_memory() -> Option<u64> {
    kibibytes("/proc/meminfo", "MemTotal:")
}

/// The most memory that this process has held at once, bytes; `None` where the system does not say so in `/proc/self/status`.
pub fn peak_memory() -> Option<u64> {
    kibibytes("/proc/self/status", "VmHWM:")
}

/// The number that a line of a system's file gives in kB, as bytes.
fn kibibytes(file: &str, name: &str) -> Option<u64> {
    let text = std::fs::read_to_string(file).ok()?;
    let line = text.lines().find_map(|line| line.strip_prefix(name))?;
    line.trim().strip_suffix("kB")?.trim().parse::<u64>().ok()?.checked_mul(1024)
}

/// A regular file and its length. Pipes and devices, which have no length to trust, are refused.
pub(crate) fn open_regular(path: &Path) -> Result<(File, u64), IoError> {
    let regular = |facts: &Metadata| {
        let no = || system(path, "read")(io::Error::other("not a regular file"));
        if facts.is_file() { Ok(()) } else { Err(no()) }
    };
    // Asked before it is opened too: opening a pipe waits for somebody to write into it.
    regular(&std::fs::metadata(path).map_err(system(path, "open"))?)?;
    let file = File::open(path).map_err(system(path, "open"))?;
    let facts = file.metadata().map_err(system(path, "examine"))?;
    regular(&facts)?;
    Ok((file, facts.len()))
}

/// The bytes of a regular file, of at most `most_bytes`; pipes and devices, which have no length to trust, are refused.
///
/// # Errors
/// [`IoError::System`], also for a file that is longer.
pub fn read_bytes(path: &Path, most_bytes: u64) -> Result<Vec<u8>, IoError> {
    let (file, file_bytes) = open_regular(path)?;
    if file_bytes > most_bytes {
        let problem = format!("{file_bytes} bytes are more than {most_bytes}");
        return Err(system(path, "read")(io::Error::other(problem)));
    }
    let mut bytes = Vec::new();
    let length = usize::try_from(file_bytes).unwrap_or(usize::MAX);
    bytes.try_reserve_exact(length).map_err(|full| system(path, "hold")(io::Error::other(full)))?;
    file.take(file_bytes).read_to_end(&mut bytes).map_err(system(path, "read"))?;
    Ok(bytes)
}
