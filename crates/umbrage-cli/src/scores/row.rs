//! What is compared with truth, and its numbers.

use glam::DVec2;
use serde_json::{Map, Value, json};
use umbrage_oracle::judge::Score;

/// A result that is compared with truth.
pub struct Row {
    /// Of which light.
    pub light: String,
    /// The recipe's text, or the name of the image's file.
    pub what: String,
    /// How it was made; `None` for an image.
    pub made: Option<Made>,
    pub score: Score,
    /// The fraction in shadow; empty where it is not shown.
    pub shadow: Vec<f32>,
}

/// The time and memory that a recipe's result took.
pub struct Made {
    pub map_size: u32,
    /// Bytes of its maps.
    pub bytes: usize,
    pub bake_ms: f64,
    pub look_up_ns: Option<f64>,
}

/// A number of a row that has a limit or a column.
pub struct Number {
    /// Its word in `--fail-above` and in JSON.
    pub name: &'static str,
    /// Its head in tables.
    pub head: &'static str,
    /// Whether it is a fraction, which is shown in per cent.
    pub is_share: bool,
    pub of: fn(&Row) -> Option<f64>,
}

/// Every number of a row, in the order in which they are listed.
pub static NUMBERS: [Number; 17] = [
    number("rms", "rms", false, |row| row.score.rms),
    number("false-shadow", "false shadow", true, |row| row.score.false_shadow),
    number("false-light", "false light", true, |row| row.score.false_light),
    number("acne", "acne", true, |row| row.score.acne),
    number("detachment", "detachment", true, |row| row.score.detachment),
    number("leak", "leak", true, |row| row.score.leak),
    number("detached", "detached, world units", false, |row| row.score.detached.map(|size| size.mean)),
    number("detached-texels", "detached, texels", false, |row| row.score.detached.map(|size| size.texels)),
    number("noise", "noise", false, |row| row.score.noise),
    number("penumbra-ratio", "penumbra width over truth's", false, |row| row.score.penumbra_ratio),
    number("displacement", "displacement, px", false, |row| row.score.displacement.map(DVec2::length)),
    number("displacement-x", "to the right, px", false, |row| row.score.displacement.map(|by| by.x)),
    number("displacement-y", "down, px", false, |row| row.score.displacement.map(|by| by.y)),
    number("edge-shift", "edge shift, px", false, |row| row.score.edge_shift.map(|shift| shift.absolute)),
    number("edge-shift-signed", "edge shift with its sign, px", false, |row| {
        row.score.edge_shift.map(|shift| shift.mean)
    }),
    number("bake-ms", "bake ms", false, |row| Some(row.made.as_ref()?.bake_ms)),
    number("look-up-ns", "ns per look-up", false, |row| row.made.as_ref()?.look_up_ns),
];

/// Columns of the table for people beside what, map size, bytes and times.
pub const SHOWN: usize = 6;

const fn number(name: &'static str, head: &'static str, is_share: bool, of: fn(&Row) -> Option<f64>) -> Number {
    Number { name, head, is_share, of }
}

impl Row {
    /// Its name in messages.
    pub fn name(&self) -> String {
        match &self.made {
            Some(made) => format!("{} at {} texels under {:?}", self.what, made.map_size, self.light),
            None => format!("{} under {:?}", self.what, self.light),
        }
    }

    /// The same for programs.
    pub fn json(&self) -> Value {
        let made = self.made.as_ref();
        let mut row = Map::new();
        row.insert("light".into(), json!(self.light));
        row.insert(if made.is_some() { "recipe" } else { "image" }.into(), json!(self.what));
        if let Some(made) = made {
            row.insert("map-size".into(), json!(made.map_size));
            row.insert("bytes".into(), json!(made.bytes));
        }
        row.insert("judged-pixels".into(), json!(self.score.judged));
        // Numbers that an image cannot have are left out; those that could not be measured are null.
        for number in NUMBERS.iter().filter(|number| made.is_some() || !number.needs_recipe()) {
            row.insert(number.name.into(), json!((number.of)(self)));
        }
        Value::Object(row)
    }
}

impl Number {
    /// Whether an image alone never has it.
    pub fn needs_recipe(&self) -> bool {
        ["detachment", "leak", "detached", "detached-texels", "noise", "bake-ms", "look-up-ns"].contains(&self.name)
    }

    /// The number, in per cent where it is a fraction.
    pub fn text(&self, value: f64) -> String {
        if self.is_share { format!("{}%", rounded(100.0 * value)) } else { rounded(value) }
    }
}

/// At most four decimals, more for numbers that would otherwise round to 0.
pub fn rounded(value: f64) -> String {
    if value != 0.0 && value.abs() < 1e-3 { format!("{value:.2e}") } else { format!("{}", (value * 1e4).round() / 1e4) }
}
