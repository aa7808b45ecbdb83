//! Where a command reads and writes, and how it says what is wrong.

use std::io::{BufRead, Write};

/// What a command reads and writes beside files.
pub struct Shell<'a> {
    pub input: &'a mut dyn BufRead,
    /// Data.
    pub out: &'a mut dyn Write,
    /// What people read.
    pub err: &'a mut dyn Write,
    /// `-q`: nothing but errors.
    pub quiet: bool,
    /// `-v`: also what was left alone.
    pub verbose: bool,
}

impl Shell<'_> {
    /// A line for people, unless they want none. Where it cannot be written there is nobody to tell.
    pub fn note(&mut self, line: &str) {
        if !self.quiet {
            let _ = writeln!(self.err, "{line}");
        }
    }
}

/// What was asked for cannot be had: exit code 2, as for any other command line that makes no sense.
#[derive(Debug)]
pub struct Usage(pub String);

impl std::fmt::Display for Usage {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.write_str(&self.0)
    }
}

impl std::error::Error for Usage {}
