use crate::values::Values;
use crate::{Kind, PresetName, RecipeError};

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
    /// The value that a preset has by default; `None` where it is without one.
    #[must_use]
    pub fn default(&self, preset: PresetName) -> Option<String> {
        (self.get)(&Values::of(preset))
    }

    pub(crate) fn read(&self, values: &mut Values, text: &str) -> Result<(), RecipeError> {
        let read = (self.set)(values, text, self.kind);
        read.then_some(()).ok_or_else(|| RecipeError::value(self.name, text, self.kind.to_string()))
    }

    /// The defaults in few words: that of most presets, then the others by name. Those of engines are in a table of their own, unless no other preset knows
    /// the field.
    pub(crate) fn defaults(&self) -> String {
        let of = |preset: &PresetName| match self.default(*preset) {
            Some(value) if value == "inf" => "∞".into(),
            Some(value) => format!("`{value}`"),
            None => "none".into(),
        };
        let (engines, papers): (Vec<_>, Vec<_>) = self.of.iter().partition(|preset| preset.engine().is_some());
        let (engines, papers) = if papers.is_empty() { (papers, engines) } else { (engines, papers) };
        let values: Vec<String> = papers.iter().map(of).collect();
        let count = |value: &String| values.iter().filter(|other| *other == value).count();
        let Some(common) = values.iter().max_by_key(|value| count(value)) else { return String::new() };
        let others = papers.iter().zip(&values).filter(|(_, value)| *value != common);
        let others: Vec<String> = others.map(|(preset, value)| format!(", {value} ({})", preset.name())).collect();
        let own = if engines.iter().any(|preset| of(preset) != *common) { ", their own (engines')" } else { "" };
        format!("{common}{}{own}", others.concat())
    }

    pub(crate) fn presets(&self) -> String {
        if self.of.len() == PresetName::ALL.len() {
            return "all".into();
        }
        let mut others = PresetName::ALL.into_iter().filter(|preset| !self.of.contains(preset));
        if let (Some(but), None) = (others.next(), others.next()) {
            return format!("all but {}", but.name());
        }
        // Most engines' presets know the same fields: percentage closer in a few texels.
        let (known, unknown): (Vec<PresetName>, Vec<PresetName>) =
            PresetName::ENGINES.into_iter().partition(|preset| self.of.contains(preset));
        let engines = known.len() > unknown.len();
        let own = self.of.iter().filter(|preset| !engines || preset.engine().is_none()).map(|preset| preset.name());
        let listed = own.chain(engines.then_some("engines'")).collect::<Vec<_>>().join(", ");
        if !engines || unknown.is_empty() {
            return listed;
        }
        let but: Vec<_> = unknown.into_iter().map(PresetName::name).collect();
        format!("{listed} but {}", but.join(" and "))
    }
}
