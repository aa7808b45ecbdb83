//! What making a figure leaves behind, and the judgement on it.

use crate::measure::Measure;
use crate::panel::Panel;
use serde::{Deserialize, Serialize};

/// A small table.
#[derive(Clone, Debug, Default)]
pub struct Table {
    /// File stem.
    pub name: String,
    /// Column heads.
    pub head: Vec<String>,
    /// Rows.
    pub rows: Vec<Vec<String>>,
}

/// What making a figure leaves behind.
#[derive(Clone, Debug, Default)]
pub struct Made {
    /// Pictures.
    pub panels: Vec<Panel>,
    /// Tables.
    pub tables: Vec<Table>,
    /// SVG plots: file stem and text.
    pub plots: Vec<(String, String)>,
    /// Numbers with their bounds.
    pub measures: Vec<Measure>,
    /// A remark for the reader.
    pub note: String,
    /// Why a bound is missed, with the numbers that show it.
    pub caveat: Option<String>,
    /// Seconds by name; never part of the report.
    pub timings: Vec<(String, f64)>,
}

/// The judgement on a figure.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Verdict {
    /// Every bound met.
    Reproduced,
    /// A bound missed, with its cause.
    Caveat,
    /// A bound missed, unexplained.
    Missed,
}

impl Made {
    /// The verdict of the measures (a caveat explains misses; without one a miss is a miss).
    pub fn verdict(&self) -> Verdict {
        match (self.measures.iter().any(|measure| measure.pass() == Some(false)), &self.caveat) {
            (false, _) => Verdict::Reproduced,
            (true, Some(_)) => Verdict::Caveat,
            (true, None) => Verdict::Missed,
        }
    }
}

impl Verdict {
    /// As people read it.
    pub fn word(self) -> &'static str {
        match self {
            Self::Reproduced => "reproduced",
            Self::Caveat => "caveat",
            Self::Missed => "missed",
        }
    }
}
