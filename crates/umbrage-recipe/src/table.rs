use crate::fields::FIELDS;
use crate::values::Values;
use crate::{Kind, PresetName, RecipeError, kind};
use std::fmt::Write;

/// One field of a recipe: a row of the table from which parsing, errors, writing, help and documentation come.
#[derive(Clone, Copy, Debug)]
#[non_exhaustive]
pub struct Field {
    /// Its name. Fields of different presets may have one name.
    pub name: &'static str,
    /// The presets that know it.
    pub of: &'static [PresetName],
    /// What its value may be.
    pub kind: Kind,
    /// What it does, a sentence without its full stop.
    pub doc: &'static str,
    /// Where it comes from: paper and section, or nothing.
    pub source: &'static str,
    /// Reads a value; false for one that is not of `kind`.
    pub(crate) set: fn(&mut Values, &str, Kind) -> bool,
    /// Writes the value; `None` where there is none to write.
    pub(crate) get: fn(&Values) -> Option<String>,
}

impl Field {
    /// All fields, in the order in which recipes are written.
    #[must_use]
    pub fn all() -> &'static [Self] {
        FIELDS
    }

    /// The fields that a preset knows.
    pub fn of(preset: PresetName) -> impl Iterator<Item = &'static Self> {
        FIELDS.iter().filter(move |field| field.of.contains(&preset))
    }

    /// The value that a preset has unless told otherwise; `None` where it is without one.
    #[must_use]
    pub fn default(&self, preset: PresetName) -> Option<String> {
        (self.get)(&Values::of(preset))
    }

    /// The row of a preset's field.
    pub(crate) fn named(preset: PresetName, name: &str) -> Result<&'static Self, RecipeError> {
        let unknown = || {
            let names: Vec<_> = Self::of(preset).map(|field| field.name).collect();
            RecipeError::value("field", name, kind::either(&names))
        };
        Self::of(preset).find(|field| field.name == name).ok_or_else(unknown)
    }

    pub(crate) fn read(&self, values: &mut Values, text: &str) -> Result<(), RecipeError> {
        let read = (self.set)(values, text, self.kind);
        read.then_some(()).ok_or_else(|| RecipeError::value(self.name, text, self.kind.to_string()))
    }

    /// The defaults in few words: of all presets that know it, or each of its own.
    fn defaults(&self) -> String {
        let of = |preset: &PresetName| match self.default(*preset) {
            Some(value) if value == "inf" => "∞".into(),
            Some(value) => format!("`{value}`"),
            None => "none".into(),
        };
        let values: Vec<String> = self.of.iter().map(of).collect();
        if values.iter().all(|value| *value == values[0]) {
            return values[0].clone();
        }
        let each = self.of.iter().zip(&values).map(|(preset, value)| format!("{value} ({})", preset.name()));
        each.collect::<Vec<_>>().join(", ")
    }

    fn presets(&self) -> String {
        if self.of.len() == PresetName::ALL.len() {
            return "all".into();
        }
        self.of.iter().map(|preset| preset.name()).collect::<Vec<_>>().join(", ")
    }
}

/// The table of fields as Markdown, as the documentation of [`Recipe`](crate::Recipe) has it.
#[must_use]
pub fn markdown() -> String {
    let mut table =
        String::from("| field | of | values | unless told | what it does | source |\n|---|---|---|---|---|---|\n");
    for field in FIELDS {
        let values = match field.kind {
            Kind::Words(words) => words.iter().map(|word| format!("`{word}`")).collect::<Vec<_>>().join(", "),
            kind => kind.to_string(),
        };
        let (of, defaults) = (field.presets(), field.defaults());
        let _ =
            writeln!(table, "| `{}` | {of} | {values} | {defaults} | {} | {} |", field.name, field.doc, field.source);
    }
    table
}

/// What may be written behind a preset's name: a line per field, for a terminal.
#[must_use]
pub fn help(preset: PresetName) -> String {
    let mut lines = String::new();
    for field in Field::of(preset) {
        let default = field.default(preset).map_or_else(String::new, |value| format!(" [{value}]"));
        let _ = writeln!(lines, "{}={default}: {}; {}", field.name, field.kind, field.doc);
    }
    lines
}
