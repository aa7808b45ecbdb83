//! Where a command reads and writes, and how it reports errors.

use indicatif::{ProgressBar, ProgressFinish, ProgressStyle};
use std::io::{self, BufRead, Write};
use std::time::Duration;

/// What a command reads and writes besides files.
pub struct Shell<'a> {
    pub input: &'a mut dyn BufRead,
    /// Data.
    pub out: &'a mut dyn Write,
    /// Messages for people.
    pub err: &'a mut dyn Write,
    /// `-q`: nothing but errors.
    pub quiet: bool,
    /// `-v`: also what was left alone.
    pub verbose: bool,
    /// Whether `err` is a terminal: only there is progress shown.
    pub is_terminal: bool,
}

impl Shell<'_> {
    /// A line for people, unless they want none. Where it cannot be written, the error has nowhere to go.
    pub fn note(&mut self, line: &str) {
        if !self.quiet {
            let _ = writeln!(self.err, "{line}");
        }
    }

    /// A progress bar of this many steps, which disappears when it is dropped; hidden unless standard error is a terminal.
    pub fn progress(&self, steps: usize) -> ProgressBar {
        if !self.is_terminal || self.quiet {
            return ProgressBar::hidden();
        }
        let style = ProgressStyle::with_template("{spinner} {wide_msg} {pos}/{len} {elapsed}");
        let bar = ProgressBar::new(steps as u64).with_finish(ProgressFinish::AndClear);
        bar.set_style(style.unwrap_or_else(|_| ProgressStyle::default_bar()));
        bar.enable_steady_tick(Duration::from_millis(100));
        bar
    }
}

/// Standard output. Its errors name it, so that a full disk there is not mistaken for one under a file that the command writes.
pub struct Output<'a>(pub &'a mut dyn Write);

impl Write for Output<'_> {
    fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
        self.0.write(bytes).map_err(|error| named(&error))
    }

    fn flush(&mut self) -> io::Result<()> {
        self.0.flush().map_err(|error| named(&error))
    }
}

fn named(error: &io::Error) -> io::Error {
    io::Error::new(error.kind(), format!("standard output: {error}"))
}

/// The command line demands something impossible: exit code 2, as for any other invalid command line.
#[derive(Debug)]
pub struct Usage(pub String);

impl std::fmt::Display for Usage {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.write_str(&self.0)
    }
}

impl std::error::Error for Usage {}

/// Something exceeds its limit: exit code 3.
#[derive(Debug)]
pub struct Exceeded(pub String);

impl std::fmt::Display for Exceeded {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.write_str(&self.0)
    }
}

impl std::error::Error for Exceeded {}

/// A word quoted for a shell where it needs it.
pub fn quoted(word: &str) -> String {
    let is_plain = |c: char| c.is_ascii_alphanumeric() || "_-./:=,+@%".contains(c);
    if !word.is_empty() && word.chars().all(is_plain) {
        return word.into();
    }
    format!("'{}'", word.replace('\'', r"'\''"))
}

/// An error and its causes as one line. A cause that the text before it already ends with is not repeated.
pub fn line(error: &anyhow::Error) -> String {
    let mut line = error.to_string();
    for cause in error.chain().skip(1).map(ToString::to_string) {
        if !line.ends_with(&cause) {
            line = format!("{line}: {cause}");
        }
    }
    line.replace(['\n', '\r'], " ")
}
