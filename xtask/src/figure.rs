//! What a figure is: how it is made, and what making it leaves behind.

use glam::{UVec2, Vec3};
use serde::{Deserialize, Serialize};
use umbrage_render::Storage;

/// Where a figure comes from; the gallery's order.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Paper {
    /// Williams 1978.
    Williams78,
    /// Reeves, Salesin & Cook 1987.
    Reeves87,
    /// Woo 1992.
    Woo92,
    /// Wang & Molnar 1994.
    WangMolnar94,
    /// Burley 2006.
    Burley06,
    /// Our own.
    Umbrage,
}

impl Paper {
    /// Authors and year.
    pub fn name(self) -> &'static str {
        match self {
            Self::Williams78 => "Williams 1978",
            Self::Reeves87 => "Reeves, Salesin & Cook 1987",
            Self::Woo92 => "Woo 1992",
            Self::WangMolnar94 => "Wang & Molnar 1994",
            Self::Burley06 => "Burley 2006",
            Self::Umbrage => "Umbrage",
        }
    }
}

/// One row of the catalogue.
pub struct Figure {
    /// The row's id without panel letters, such as `R87-F7`.
    pub id: &'static str,
    /// Its paper.
    pub paper: Paper,
    /// A few words.
    pub title: &'static str,
    /// What the figure must show.
    pub claim: &'static str,
    /// Makes it.
    pub make: fn(&Context) -> anyhow::Result<Made>,
}

/// What one run asks of every figure.
#[derive(Clone, Debug)]
pub struct Context {
    /// Smaller pictures and fewer samples.
    pub quick: bool,
    /// Seed of all randomness.
    pub seed: u32,
    /// How maps are kept while they are looked up. Changes no bit.
    pub storage: Storage,
}

impl Context {
    /// The first in a full run, the second in a quick one.
    pub fn pick<T>(&self, full: T, quick: T) -> T {
        if self.quick { quick } else { full }
    }
}

/// What a panel is for.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Role {
    /// A method's picture.
    Result,
    /// Ray-traced truth.
    Truth,
    /// Difference from truth as colours.
    Error,
    /// A depth map or other material.
    Map,
}

/// One picture of a figure, linear light.
#[derive(Clone, Debug)]
pub struct Panel {
    /// File stem, unique in its figure.
    pub name: String,
    /// What is seen.
    pub caption: String,
    /// Parameters under the picture.
    pub parameters: Vec<(String, String)>,
    /// Pixels.
    pub size: UVec2,
    /// Linear RGB, rows from the top.
    pub pixels: Vec<Vec3>,
    /// Each pixel is written as `zoom` × `zoom` (R87's figures are zooms).
    pub zoom: u32,
    /// What it is for.
    pub role: Role,
    /// Name of the truth panel that it can be wiped against.
    pub against: Option<String>,
}

impl Panel {
    /// A colour picture.
    pub fn rgb(name: &str, caption: &str, size: UVec2, pixels: Vec<Vec3>) -> Self {
        Self {
            name: name.into(),
            caption: caption.into(),
            parameters: Vec::new(),
            size,
            pixels,
            zoom: 1,
            role: Role::Result,
            against: None,
        }
    }

    /// A grey picture: 0 black, 1 white.
    pub fn grey(name: &str, caption: &str, size: UVec2, values: Vec<f32>) -> Self {
        Self::rgb(name, caption, size, values.into_iter().map(Vec3::splat).collect())
    }

    /// Adds a parameter.
    #[expect(clippy::needless_pass_by_value, reason = "callers hand over literals")]
    pub fn with(mut self, name: &str, value: impl ToString) -> Self {
        self.parameters.push((name.into(), value.to_string()));
        self
    }

    /// Says what it is for.
    pub fn role(mut self, role: Role) -> Self {
        self.role = role;
        self
    }

    /// Enlarges it by pixel replication.
    pub fn zoom(mut self, zoom: u32) -> Self {
        self.zoom = zoom;
        self
    }

    /// Names the truth panel it is compared with.
    pub fn against(mut self, truth: &str) -> Self {
        self.against = Some(truth.into());
        self
    }
}

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
    /// Told, not judged.
    Info,
    /// Has a bound that this run cannot judge; the reason.
    NotJudged(String),
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

    /// Only told.
    pub fn info(name: &str, value: f64, unit: &str) -> Self {
        Self::new(name, value, unit, Bound::Info)
    }

    /// Keeps the bound only in a full run: it means nothing at a quick run's size.
    pub fn full_size(mut self, cx: &Context) -> Self {
        if cx.quick {
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
