//! What making a figure leaves behind, and the judgement on it.

use crate::measure::Measure;
use crate::panel::Panel;
use serde::{Deserialize, Serialize};

/// A small table.
#[derive(Clone, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
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
    /// Tables of this run alone, as of seconds: shown on the page, never part of the report.
    pub run_tables: Vec<Table>,
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
    /// No bound that this run can judge.
    NotJudged,
}

impl Made {
    /// The verdict of the measures (a caveat explains misses; without one a miss is a miss). Where none is judged, neither is
    /// the figure.
    pub fn verdict(&self) -> Verdict {
        let all_met = self.measures.iter().filter_map(Measure::pass).reduce(|all, met| all && met);
        match (all_met, &self.caveat) {
            (None, _) => Verdict::NotJudged,
            (Some(true), _) => Verdict::Reproduced,
            (Some(false), Some(_)) => Verdict::Caveat,
            (Some(false), None) => Verdict::Missed,
        }
    }
}

impl Verdict {
    /// Every verdict, in the order in which they are counted.
    pub const ALL: [Self; 4] = [Self::Reproduced, Self::Caveat, Self::Missed, Self::NotJudged];

    /// As people read it.
    pub fn word(self) -> &'static str {
        match self {
            Self::Reproduced => "reproduced",
            Self::Caveat => "caveat",
            Self::Missed => "missed",
            Self::NotJudged => "not judged",
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_figure_of_which_no_bound_is_judged_is_not_called_reproduced() {
        let made = |measures: &[Measure]| Made { measures: measures.to_vec(), ..Made::default() };
        let unjudged = Measure::at_most("big", 2.0, "", 1.0).full_size(true);
        let info = Measure::info("seen", 2.0, "");
        let met = Measure::at_most("small", 0.5, "", 1.0);
        assert_eq!(made(&[]).verdict(), Verdict::NotJudged);
        assert_eq!(made(&[unjudged.clone(), info.clone()]).verdict(), Verdict::NotJudged);
        assert_eq!(made(&[unjudged, info, met]).verdict(), Verdict::Reproduced);
    }
}
