use std::fmt;

/// Who wants to read a note.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Level {
    /// Everybody: part of the scene is not shown, or something had to be guessed.
    Always,
    /// For details only: what was passed over makes no difference to shadows.
    Verbose,
}

/// What was ignored, skipped or guessed: one line.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Note {
    /// Who wants to read it.
    pub level: Level,
    /// The line, without a full stop at its end.
    pub text: String,
    /// How often it holds, at least 1.
    pub times: u64,
}

impl fmt::Display for Note {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&self.text)?;
        if self.times > 1 {
            write!(f, " ({} times)", self.times)?;
        }
        Ok(())
    }
}

/// Notes as they are collected. Their number is bounded, whatever the file holds.
#[derive(Debug, Default)]
pub(crate) struct Notes {
    notes: Vec<Note>,
    lost: u64,
}

impl Notes {
    const MOST: usize = 100;

    /// Adds a note, or counts it once more.
    pub(crate) fn add(&mut self, level: Level, text: String) {
        self.add_times(level, text, 1);
    }

    /// Adds a note that holds several times.
    pub(crate) fn add_times(&mut self, level: Level, text: String, times: u64) {
        if let Some(known) = self.notes.iter_mut().find(|note| note.text == text) {
            known.times = known.times.saturating_add(times);
        } else if self.notes.len() < Self::MOST {
            self.notes.push(Note { level, text, times });
        } else {
            self.lost = self.lost.saturating_add(1);
        }
    }

    /// All of them, what everybody wants to read first.
    pub(crate) fn finish(mut self) -> Vec<Note> {
        self.notes.sort_by_key(|note| note.level);
        if self.lost > 0 {
            let text = format!("{} further notes are left out", self.lost);
            self.notes.push(Note { level: Level::Always, text, times: 1 });
        }
        self.notes
    }
}
