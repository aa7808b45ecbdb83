//! A row, its goal, and what all rows go by.

use std::fmt;

/// How a report is made.
#[derive(Clone, Copy, Debug, Default)]
pub struct Settings {
    /// Small workloads, each run once: for its assertions. No goal is judged.
    pub quick: bool,
    /// Whether this program was compiled for the machine's own processor, which helps peers more than what chooses its
    /// instructions by itself: some goals differ.
    pub native: bool,
}

impl Settings {
    /// Runs of each way, of which the median counts.
    pub(super) fn rounds(self) -> usize {
        if self.quick { 1 } else { 5 }
    }

    /// Sides of maps, texels.
    pub(super) fn sides(self) -> &'static [u32] {
        if self.quick { &[256] } else { &[1024, 4096] }
    }

    /// Sides of the camera's picture, pixels.
    pub(super) fn picture(self) -> u32 {
        if self.quick { 64 } else { 1024 }
    }

    /// A goal by default flags, and one for native ones.
    pub(super) fn goal(self, default: Goal, native: Goal) -> Goal {
        match (self.quick, self.native) {
            (true, _) => Goal::Free,
            (false, false) => default,
            (false, true) => native,
        }
    }

    /// A goal whatever the flags.
    pub(super) fn always(self, goal: Goal) -> Goal {
        self.goal(goal, goal)
    }
}

/// What a row should reach.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Goal {
    /// The peer takes at least so many times as long.
    Faster(f64),
    /// It takes at most so many times the peer.
    Within(f64),
    /// Nothing in particular.
    Free,
}

impl fmt::Display for Goal {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Faster(times) => write!(f, "faster\t{times}"),
            Self::Within(times) => write!(f, "within\t{times}"),
            Self::Free => write!(f, "free\t0"),
        }
    }
}

/// One comparison. As text it is a line of fields between tabs: group, what, unit, ours, peer, theirs, kind of goal, its number.
#[derive(Clone, Debug, PartialEq)]
pub struct Row {
    /// What it belongs to.
    pub group: &'static str,
    /// What is measured.
    pub what: String,
    /// Unit of both numbers.
    pub unit: &'static str,
    /// Ours.
    pub ours: f64,
    /// Name of what stands beside it.
    pub peer: String,
    /// The peer's.
    pub theirs: f64,
    /// What it should reach.
    pub goal: Goal,
}

impl fmt::Display for Row {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self { group, what, unit, ours, peer, theirs, goal } = self;
        write!(f, "row\t{group}\t{what}\t{unit}\t{ours:.4}\t{peer}\t{theirs:.4}\t{goal}")
    }
}
