//! The one path on which files are written.

use crate::error::{IoError, system};
use std::fs::{File, OpenOptions, TryLockError};
use std::io::{self, BufWriter, Seek, SeekFrom, Write};
use std::path::{Path, PathBuf};

/// Writes a file as a whole or not at all: into a temporary file in the same folder, flushed to the disk, then renamed over
/// `path`. Whatever fails, the old file stays as it was and the temporary one is removed; a killed run leaves at most
/// that, and the next one that writes the same file replaces it. Everything Umbrage writes goes through here.
///
/// # Errors
/// [`IoError::System`], also when `fill` fails.
pub fn write_atomic(path: &Path, fill: impl FnOnce(&mut dyn Write) -> io::Result<()>) -> Result<(), IoError> {
    write_in_steps(path, |file| fill(file).map_err(system(path, "write")), &|_| Ok(()))
}

/// What a file is written to: it may go back to what it has written.
pub(crate) trait Output: Write + Seek {}

impl<W: Write + Seek> Output for W {}

/// Writes bytes as a whole or not at all ([`write_atomic`]).
///
/// # Errors
/// [`IoError::System`].
pub fn write_bytes(path: &Path, bytes: &[u8]) -> Result<(), IoError> {
    write_atomic(path, |file| file.write_all(bytes))
}

/// The system calls of a write.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Step {
    Create,
    Write,
    Flush,
    Rename,
    Remove,
}

/// As [`write_atomic`], where `before` is called before each step, and its error takes the place of the step's: tests inject failures with it.
pub(crate) fn write_in_steps<T>(
    path: &Path,
    fill: impl FnOnce(&mut dyn Output) -> Result<T, IoError>,
    before: &dyn Fn(Step) -> io::Result<()>,
) -> Result<T, IoError> {
    let temporary = Temporary::beside(path, before).map_err(system(path, "create a temporary file beside it"))?;
    let mut writer = BufWriter::new(&temporary);
    let filled = fill(&mut writer)?;
    writer.flush().map_err(system(path, "write"))?;
    drop(writer);
    temporary.flush_to_disk().map_err(system(path, "flush to the disk"))?;
    temporary.rename(path).map_err(system(path, "rename the finished temporary file to it"))?;
    Ok(filled)
}

/// A file that is locked while it is written, and removed unless it is renamed.
struct Temporary<'a> {
    file: File,
    /// `None` once it is renamed.
    path: Option<PathBuf>,
    before: &'a dyn Fn(Step) -> io::Result<()>,
}

impl<'a> Temporary<'a> {
    /// In the same folder, under a name made of that of `path`, in place of what a killed run may have left there.
    fn beside(path: &Path, before: &'a dyn Fn(Step) -> io::Result<()>) -> io::Result<Self> {
        const MOST_AT_ONCE: u32 = 1000;
        let no_name = || io::Error::new(io::ErrorKind::InvalidInput, "the path names no file");
        let name = path.file_name().ok_or_else(no_name)?;
        before(Step::Create)?;
        for number in 0..MOST_AT_ONCE {
            let mut hidden = std::ffi::OsString::from(".");
            hidden.push(name);
            hidden.push(format!(".{number}.tmp"));
            let temporary = path.with_file_name(hidden);
            remove_if_left_behind(&temporary);
            match OpenOptions::new().write(true).create_new(true).open(&temporary) {
                // The lock shows that the writer is alive. On systems without locks no file is taken for a leftover.
                Ok(file) => match file.try_lock() {
                    Ok(()) | Err(TryLockError::Error(_)) if is_at(&file, &temporary) => {
                        return Ok(Self { file, path: Some(temporary), before });
                    }
                    // Another run has taken it for one that was left behind, before the lock was there.
                    _ => {}
                },
                Err(error) if error.kind() == io::ErrorKind::AlreadyExists => {}
                Err(error) => return Err(error),
            }
        }
        Err(io::Error::new(io::ErrorKind::AlreadyExists, "too many temporary files of other runs"))
    }

    fn flush_to_disk(&self) -> io::Result<()> {
        (self.before)(Step::Flush)?;
        self.file.sync_all()
    }

    fn rename(mut self, to: &Path) -> io::Result<()> {
        (self.before)(Step::Rename)?;
        let Some(from) = &self.path else { return Ok(()) };
        std::fs::rename(from, to)?;
        self.path = None;
        Ok(())
    }
}

impl Write for &Temporary<'_> {
    fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
        (self.before)(Step::Write)?;
        (&self.file).write(bytes)
    }

    fn flush(&mut self) -> io::Result<()> {
        (&self.file).flush()
    }
}

impl Seek for &Temporary<'_> {
    fn seek(&mut self, to: SeekFrom) -> io::Result<u64> {
        (&self.file).seek(to)
    }
}

impl Drop for Temporary<'_> {
    fn drop(&mut self) {
        if let Some(path) = &self.path {
            // Nothing is left to be done about a file that will not go, and the error that led here matters more.
            let _ = (self.before)(Step::Remove).and_then(|()| std::fs::remove_file(path));
        }
    }
}

/// Removes a temporary file that nobody writes any more: a killed run's lock goes with it. Whatever is in doubt stays where it is.
fn remove_if_left_behind(path: &Path) {
    // Opening a pipe waits for somebody to read it.
    if path.symlink_metadata().is_ok_and(|named| named.is_file())
        && let Ok(file) = OpenOptions::new().write(true).open(path)
        && file.try_lock().is_ok()
        && is_at(&file, path)
    {
        let _ = std::fs::remove_file(path);
    }
}

/// Whether an open file is still the one under a name, which another run may have renamed or replaced. Links are another file.
#[cfg(unix)]
fn is_at(file: &File, path: &Path) -> bool {
    use std::os::unix::fs::MetadataExt;
    let same = |(own, named): (std::fs::Metadata, std::fs::Metadata)| {
        own.is_file() && (own.dev(), own.ino()) == (named.dev(), named.ino())
    };
    file.metadata().ok().zip(path.symlink_metadata().ok()).is_some_and(same)
}

/// Files have no numbers that could be compared here; names are taken at their word.
#[cfg(not(unix))]
fn is_at(_: &File, path: &Path) -> bool {
    path.symlink_metadata().is_ok_and(|named| named.is_file())
}
