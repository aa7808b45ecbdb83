use crate::error::{IoError, system};
use std::fs::{File, Metadata, OpenOptions};
use std::io::{self, BufWriter, Read, Write};
use std::path::{Path, PathBuf};

/// Writes a file as a whole or not at all: into a temporary file in the same folder, flushed to the disk, then renamed over
/// `path`. Whatever fails, the old file stays as it was and the temporary one is removed; a killed run leaves at most
/// that. Everything Umbrage writes goes through here.
///
/// # Errors
/// [`IoError::System`], also when `fill` fails.
pub fn write_atomic(path: &Path, fill: impl FnOnce(&mut BufWriter<File>) -> io::Result<()>) -> Result<(), IoError> {
    let (temporary, file) = create_beside(path).map_err(system(path, "create a temporary file beside it"))?;
    let mut writer = BufWriter::new(file);
    fill(&mut writer).and_then(|()| writer.flush()).map_err(system(path, "write"))?;
    writer.get_ref().sync_all().map_err(system(path, "flush to the disk"))?;
    drop(writer);
    temporary.rename(path).map_err(system(path, "rename the finished temporary file to it"))
}

/// Writes bytes as a whole or not at all ([`write_atomic`]).
///
/// # Errors
/// [`IoError::System`].
pub fn write_bytes(path: &Path, bytes: &[u8]) -> Result<(), IoError> {
    write_atomic(path, |file| file.write_all(bytes))
}

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

/// All memory of the machine, bytes; `None` where the system does not say so in `/proc/meminfo`.
pub fn machine_memory() -> Option<u64> {
    let text = std::fs::read_to_string("/proc/meminfo").ok()?;
    let line = text.lines().find_map(|line| line.strip_prefix("MemTotal:"))?;
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

/// A file that is removed unless it is renamed.
struct Temporary {
    path: Option<PathBuf>,
}

impl Temporary {
    fn rename(mut self, to: &Path) -> io::Result<()> {
        let Some(from) = &self.path else { return Ok(()) };
        std::fs::rename(from, to)?;
        self.path = None;
        Ok(())
    }
}

impl Drop for Temporary {
    fn drop(&mut self) {
        if let Some(path) = &self.path {
            // Nothing is left to be done about a file that will not go, and the error that led here matters more.
            let _ = std::fs::remove_file(path);
        }
    }
}

fn create_beside(path: &Path) -> io::Result<(Temporary, File)> {
    const MOST_LEFT_BEHIND: u32 = 1000;
    let name = path.file_name().ok_or_else(|| io::Error::new(io::ErrorKind::InvalidInput, "the path names no file"))?;
    for attempt in 0..MOST_LEFT_BEHIND {
        let mut hidden = std::ffi::OsString::from(".");
        hidden.push(name);
        hidden.push(format!(".{attempt}.tmp"));
        let temporary = path.with_file_name(hidden);
        match OpenOptions::new().write(true).create_new(true).open(&temporary) {
            Ok(file) => return Ok((Temporary { path: Some(temporary) }, file)),
            Err(error) if error.kind() == io::ErrorKind::AlreadyExists => {}
            Err(error) => return Err(error),
        }
    }
    Err(io::Error::new(io::ErrorKind::AlreadyExists, "too many temporary files of interrupted runs"))
}
