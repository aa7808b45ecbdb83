use crate::{Part, SettingInfo};
use std::fmt;

/// The settings that give a wanted bias, and what of it they do not give.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub struct Translation {
    /// All settings of the engine, in the order of its [`About`](crate::About).
    pub settings: Vec<Setting>,
    /// Each part that these settings give less or more of than was wanted; empty where all is met.
    pub unmet: Vec<Unmet>,
}

/// A setting and its value. `Display` writes `name = value`, or `name = a..b` where the value depends on what is drawn; six digits,
/// and whole numbers away from 0 where the engine takes no others.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub struct Setting {
    /// Which.
    pub info: &'static SettingInfo,
    /// The value that gives at most what was wanted, whatever is drawn. A setting of the other sign than the bias has its least
    /// value nearer to 0 too.
    pub least: f64,
    /// The value that gives at least what was wanted, whatever is drawn. Equal to `least` where nothing is left open.
    pub most: f64,
}

impl fmt::Display for Setting {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let shown = |value: f64| if self.info.whole { away(value) } else { rounded(value) };
        let (least, most) = (shown(self.least), shown(self.most));
        if least == most {
            write!(f, "{} = {most}", self.info.name)
        } else {
            write!(f, "{} = {least}..{most}", self.info.name)
        }
    }
}

/// A part that an engine gives less or more of than was wanted. `Display` is one line.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub struct Unmet {
    /// Which.
    pub part: Part,
    /// How much was wanted, in the part's unit.
    pub wanted: f64,
    /// How much is had at least.
    pub least: f64,
    /// How much is had at most.
    pub most: f64,
    /// Why.
    pub why: &'static str,
}

impl fmt::Display for Unmet {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let (wanted, least, most) = (rounded(self.wanted), rounded(self.least), rounded(self.most));
        write!(f, "{} {wanted} is not met but {least}", self.part)?;
        if least != most {
            write!(f, "..{most}")?;
        }
        write!(f, ": {}", self.why)
    }
}

/// The nearest number of six digits.
fn rounded(value: f64) -> f64 {
    let near: f64 = format!("{value:.5e}").parse().unwrap_or(value);
    // 0 has no sign for a reader.
    near + 0.0
}

/// The next whole number away from 0, but for a rounding of the value itself.
fn away(value: f64) -> f64 {
    let whole = value.round();
    let near = (value - whole).abs() <= 1e-9 * value.abs();
    (if near { whole } else { value.abs().ceil().copysign(value) }) + 0.0
}
