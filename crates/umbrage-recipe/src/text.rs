//! Recipes as text and as TOML.

use crate::values::Values;
use crate::{Field, PresetName, Recipe, RecipeError, kind};
use std::fmt::{self, Write};
use std::str::FromStr;
use toml::{Table, Value};

impl Recipe {
    /// A preset with fields, in their order.
    pub(crate) fn with<'a>(
        name: &str,
        fields: impl IntoIterator<Item = Result<(&'a str, String), RecipeError>>,
    ) -> Result<Self, RecipeError> {
        let presets = || kind::either(&PresetName::ALL.map(PresetName::name));
        let preset = PresetName::named(name).ok_or_else(|| RecipeError::value("recipe", name, presets()))?;
        let mut values = Values::of(preset);
        let mut given = Vec::new();
        for field in fields {
            let (name, text) = field?;
            let field = Field::named(preset, name)?;
            field.read(&mut values, &text)?;
            given.push(field.name);
        }
        values.check(preset, &given)?;
        Ok(Self { preset, values, names_stored: given.contains(&"stored") })
    }

    /// The fields in which it differs from its preset, as they are written; `stored` too where it is named.
    fn written(&self) -> impl Iterator<Item = (&'static str, String)> {
        let default = Values::of(self.preset);
        let differs = move |field: &&Field| {
            (field.name == "stored" && self.names_stored) || (field.get)(&self.values) != (field.get)(&default)
        };
        let fields = Field::of(self.preset).filter(differs);
        fields.filter_map(|field| Some((field.name, (field.get)(&self.values)?)))
    }

    /// Reads a recipe from a TOML table: `preset` and the fields by their names. Numbers may be numbers, `on` and `off` booleans.
    ///
    /// ```
    /// use umbrage_recipe::Recipe;
    ///
    /// let recipe = Recipe::from_toml("preset = 'reeves87'\nsamples = 32\nbias = '0.1..0.2'\nhard-cap = true")?;
    /// assert_eq!(recipe, "reeves87,samples=32,bias=0.1..0.2,hard-cap=on".parse()?);
    /// assert_eq!(Recipe::from_toml(&recipe.to_toml())?, recipe);
    /// # Ok::<(), umbrage_recipe::RecipeError>(())
    /// ```
    ///
    /// # Errors
    /// Text that is not TOML, and what [`FromStr`] refuses.
    pub fn from_toml(text: &str) -> Result<Self, RecipeError> {
        let not_toml = |error: toml::de::Error| RecipeError::value("recipe", error.message(), "a TOML table");
        let table: Table = text.parse().map_err(not_toml)?;
        let written = |name: &str, value: &Value| match value {
            Value::String(text) => Ok(text.clone()),
            Value::Integer(number) => Ok(number.to_string()),
            Value::Float(number) => Ok(number.to_string()),
            Value::Boolean(on) => Ok(if *on { "on" } else { "off" }.into()),
            other => Err(RecipeError::value(name, &other.to_string(), "a text, a number or a boolean")),
        };
        let name = table.get("preset").map_or(Ok(String::new()), |name| written("preset", name))?;
        // In the table's own order, as some fields set others too.
        let place = |field: &&String| Field::all().iter().position(|row| row.name == field.as_str());
        let mut names: Vec<&String> = table.keys().filter(|name| *name != "preset").collect();
        names.sort_by_key(place);
        Self::with(&name, names.into_iter().map(|name| Ok((name.as_str(), written(name, &table[name])?))))
    }

    /// The recipe as a TOML table of `preset` and the fields in which it differs from it.
    #[must_use]
    pub fn to_toml(&self) -> String {
        let value = |text: &str| match text {
            "on" => Value::Boolean(true),
            "off" => Value::Boolean(false),
            _ => text.parse().map(Value::Integer).or_else(|_| text.parse().map(Value::Float)).unwrap_or(text.into()),
        };
        let mut lines = format!("preset = {}\n", Value::from(self.preset.name()));
        for (name, text) in self.written() {
            let _ = writeln!(lines, "{name} = {}", value(&text));
        }
        lines
    }
}

impl FromStr for Recipe {
    type Err = RecipeError;

    fn from_str(text: &str) -> Result<Self, RecipeError> {
        let mut parts = text.split(',').map(str::trim);
        let name = parts.next().unwrap_or_default();
        Self::with(name, parts.map(pair))
    }
}

/// A field's name and value.
pub(crate) fn pair(part: &str) -> Result<(&str, String), RecipeError> {
    let (name, value) = part.split_once('=').ok_or_else(|| RecipeError::value(part, "", "field=value"))?;
    Ok((name, value.into()))
}

/// The shortest text that reads as the same recipe: the preset's name and the fields that differ from it.
impl fmt::Display for Recipe {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.preset.name())?;
        self.written().try_for_each(|(name, value)| write!(f, ",{name}={value}"))
    }
}
