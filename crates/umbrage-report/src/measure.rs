//! A number, what it must be, and whether it is.

use crate::text::short;
use serde::{Deserialize, Serialize};
use std::fmt;

/// What a measure must be.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Bound {
    /// At most this.
    AtMost(f64),
    /// At least this.
    AtLeast(f64),
    /// Between these, both included.
    Within(f64, f64),
    /// Reported, not judged.
    Info,
    /// Has a bound that this run cannot judge; the reason.
    NotJudged(String),
}

impl Bound {
    /// The bound as it reads for values of this kind; empty where there is none.
    pub fn text(&self, kind: Kind) -> String {
        match self {
            Self::Within(low, high) if low == high => kind.word(*low).map_or_else(|| self.to_string(), Into::into),
            _ => self.to_string(),
        }
    }
}

impl fmt::Display for Bound {
    fn fmt(&self, out: &mut fmt::Formatter<'_>) -> fmt::Result {
        // Seven digits tell every bound of the catalogue apart; a third need not be written out.
        let number = |value: f64| short(value, 7);
        match self {
            Self::AtMost(high) => write!(out, "≤ {}", number(*high)),
            Self::AtLeast(low) => write!(out, "≥ {}", number(*low)),
            Self::Within(low, high) if low == high => write!(out, "= {}", number(*low)),
            Self::Within(low, high) => write!(out, "{} … {}", number(*low), number(*high)),
            Self::Info => Ok(()),
            Self::NotJudged(reason) => write!(out, "not judged: {reason}"),
        }
    }
}

/// How a value reads. It is kept as a number in either case.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Kind {
    /// As a number with its unit.
    #[default]
    Number,
    /// 1 as yes and 0 as no, without a unit; any other value as a number.
    YesNo,
}

impl Kind {
    /// The word for a value that answers a question; `None` where it reads as a number.
    pub fn word(self, value: f64) -> Option<&'static str> {
        match self {
            Self::YesNo if value == 1.0 => Some("yes"),
            Self::YesNo if value == 0.0 => Some("no"),
            Self::YesNo | Self::Number => None,
        }
    }
}

/// A number and its bound.
#[derive(Clone, Debug, PartialEq)]
pub struct Measure {
    /// What is measured.
    pub name: String,
    /// The value.
    pub value: f64,
    /// Its unit; empty for pure numbers.
    pub unit: String,
    /// What it must be.
    pub bound: Bound,
    /// How it reads.
    pub kind: Kind,
}

impl Measure {
    /// A measure with any bound.
    pub fn new(name: &str, value: f64, unit: &str, bound: Bound) -> Self {
        Self { name: name.into(), value, unit: unit.into(), bound, kind: Kind::Number }
    }

    /// Must not exceed `bound`.
    pub fn at_most(name: &str, value: f64, unit: &str, bound: f64) -> Self {
        Self::new(name, value, unit, Bound::AtMost(bound))
    }

    /// Must reach `bound`.
    pub fn at_least(name: &str, value: f64, unit: &str, bound: f64) -> Self {
        Self::new(name, value, unit, Bound::AtLeast(bound))
    }

    /// Must lie between `low` and `high`.
    pub fn within(name: &str, value: f64, unit: &str, low: f64, high: f64) -> Self {
        Self::new(name, value, unit, Bound::Within(low, high))
    }

    /// Must be `wanted` exactly.
    pub fn exactly(name: &str, value: f64, unit: &str, wanted: f64) -> Self {
        Self::within(name, value, unit, wanted, wanted)
    }

    /// Only reported.
    pub fn info(name: &str, value: f64, unit: &str) -> Self {
        Self::new(name, value, unit, Bound::Info)
    }

    /// Must hold. It is recorded as 1 where it does and as 0 where it does not.
    pub fn yes(name: &str, holds: bool) -> Self {
        Self::exactly(name, f64::from(u8::from(holds)), "yes = 1", 1.0).yes_no()
    }

    /// Reads as yes where the value is 1 and as no where it is 0, and so does its bound.
    pub fn yes_no(mut self) -> Self {
        self.kind = Kind::YesNo;
        self
    }

    /// Keeps the bound only in a full run: it means nothing at a `quick` run's size, which says so in its place.
    pub fn full_size(mut self, quick: bool) -> Self {
        if quick && self.pass().is_some() {
            self.bound = Bound::NotJudged(format!("{} is meant for full size", self.bound.text(self.kind)));
        }
        self
    }

    /// Whether the bound is met; `None` where there is none to judge. NaN meets no bound.
    pub fn pass(&self) -> Option<bool> {
        match self.bound {
            Bound::AtMost(high) => Some(self.value <= high),
            Bound::AtLeast(low) => Some(self.value >= low),
            Bound::Within(low, high) => Some(self.value >= low && self.value <= high),
            Bound::Info | Bound::NotJudged(_) => None,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_bound_meant_for_full_size_is_not_judged_in_a_quick_run() {
        let measure = Measure::at_most("m", 2.0, "", 1.0);
        let quick = measure.clone().full_size(true);
        assert_eq!(quick.pass(), None);
        assert_eq!(quick.bound.to_string(), "not judged: ≤ 1 is meant for full size");
        assert_eq!(Measure::info("m", 2.0, "").full_size(true).bound, Bound::Info, "there is no bound to judge");
        assert_eq!(measure.full_size(false).pass(), Some(false));
    }

    #[test]
    fn an_answer_is_a_number_that_reads_as_a_word() {
        let no = Measure::yes("m", false);
        assert_eq!((no.value, no.unit.as_str(), no.pass()), (0.0, "yes = 1", Some(false)), "the record keeps numbers");
        assert_eq!((no.kind.word(no.value), no.bound.text(no.kind).as_str()), (Some("no"), "yes"));
        assert_eq!(Measure::exactly("m", 0.0, "", 0.0).yes_no().bound.text(Kind::YesNo), "no");
        assert_eq!(Kind::YesNo.word(f64::NAN), None);
        assert_eq!(Measure::exactly("m", 1.0, "", 1.0).bound.text(Kind::Number), "= 1");
    }
}
