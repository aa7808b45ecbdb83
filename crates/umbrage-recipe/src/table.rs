//! The table of all fields.

use crate::fields::FIELDS;
use crate::{Field, Kind, PresetName, RecipeError, kind, settings};
use std::fmt::Write;

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

    /// The row of a preset's field.
    pub(crate) fn named(preset: PresetName, name: &str) -> Result<&'static Self, RecipeError> {
        let unknown = || {
            let names: Vec<_> = Self::of(preset).map(|field| field.name).collect();
            RecipeError::value("field", name, kind::either(&names))
        };
        Self::of(preset).find(|field| field.name == name).ok_or_else(unknown)
    }
}

/// The table of fields, and that of engines' settings, as Markdown, as in the documentation of [`Recipe`](crate::Recipe).
#[must_use]
pub fn markdown() -> String {
    let mut table =
        String::from("| field | of | values | default | what it does | source |\n|---|---|---|---|---|---|\n");
    for field in FIELDS {
        let values = match field.kind {
            Kind::Words(words) => words.iter().map(|word| format!("`{word}`")).collect::<Vec<_>>().join(", "),
            kind => kind.to_string(),
        };
        let (of, defaults) = (field.presets(), field.defaults());
        let _ =
            writeln!(table, "| `{}` | {of} | {values} | {defaults} | {} | {} |", field.name, field.doc, field.source);
    }
    table.push_str("\nWhere `depth` is an engine's bias, the engine's own settings are fields too, by its own names and in its units, as `umbrage bias --engine` prints them:\n");
    table.push_str("\n| engine | setting | default | unit | what it does |\n|---|---|---|---|---|\n");
    let mut engines: Vec<_> = PresetName::ENGINES.into_iter().filter_map(PresetName::engine).collect();
    engines.dedup();
    for engine in engines {
        for info in engine.about().settings {
            let default = info.default.map_or_else(|| "none".into(), |value| format!("`{value}`"));
            let _ = writeln!(
                table,
                "| {} | `{}` | {default} | {} | {} |",
                engine.about().title,
                info.name,
                info.unit,
                info.meaning
            );
        }
    }
    table
}

/// What may be written behind a preset's name: a line per field, and per setting of its engine, for a terminal.
#[must_use]
pub fn help(preset: PresetName) -> String {
    let mut lines = String::new();
    for field in Field::of(preset) {
        let default = field.default(preset).map_or_else(String::new, |value| format!(" [{value}]"));
        let _ = writeln!(lines, "{}={default}: {}; {}", field.name, field.kind, field.doc);
    }
    for info in preset.engine().into_iter().flat_map(settings::of) {
        let default = info.default.map_or_else(String::new, |value| format!(" [{value}]"));
        let _ = writeln!(lines, "{}={default}: {}; {}", info.name, settings::expected(info), info.meaning);
    }
    lines
}
