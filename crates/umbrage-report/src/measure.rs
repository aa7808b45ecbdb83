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
}

impl Measure {
    /// A measure with any bound.
    pub fn new(name: &str, value: f64, unit: &str, bound: Bound) -> Self {
        Self { name: name.into(), value, unit: unit.into(), bound }
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

    /// Keeps the bound only in a full run: it means nothing at a `quick` run's size.
    pub fn full_size(mut self, quick: bool) -> Self {
        if quick {
            self.bound = Bound::NotJudged("meant for full size".into());
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
        assert_eq!(measure.clone().full_size(true).pass(), None);
        assert_eq!(measure.full_size(false).pass(), Some(false));
    }
}
