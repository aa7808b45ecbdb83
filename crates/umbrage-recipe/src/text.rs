//! Recipes as text and as TOML.

use crate::values::Values;
use crate::{Field, PresetName, Recipe, RecipeError, kind, settings};
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
        let fields = fields.into_iter().collect::<Result<Vec<_>, _>>()?;
        // Which settings there are depends on the depth, which may be written behind them.
        for (name, text) in fields.iter().filter(|(name, _)| *name == "depth") {
            Field::named(preset, name)?.read(&mut values, text)?;
        }
        let engine = values.engine();
        let mut given = Vec::new();
        for (name, text) in &fields {
            // Where an engine has a setting called `bias`, the name means that setting, and the field `bias` cannot be given.
            if values.settings.read(engine, name, text)? {
                continue;
            }
            let missing = |error| settings::missing(engine, name).unwrap_or(error);
            let field = Field::named(preset, name).map_err(missing)?;
            field.read(&mut values, text)?;
            given.push(field.name);
        }
        values.check(preset, &given)?;
        Ok(Self { preset, values, names_stored: given.contains(&"stored") })
    }

    /// The fields in which it differs from its preset, as they are written, then the settings of an engine; `stored` too where it is named.
    fn written(&self) -> impl Iterator<Item = (&'static str, String)> {
        let default = Values::of(self.preset);
        let differs = move |field: &&Field| {
            (field.name == "stored" && self.names_stored) || (field.get)(&self.values) != (field.get)(&default)
        };
        let fields = Field::of(self.preset).filter(differs);
        let settings = self.values.engine().into_iter().flat_map(|engine| self.values.settings.given(engine));
        let settings = settings.map(|(info, value)| (info.name, value.to_string()));
        fields.filter_map(|field| Some((field.name, (field.get)(&self.values)?))).chain(settings)
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
            // Names of settings may have spaces.
            let quote = if name.contains(' ') { "\"" } else { "" };
            let _ = writeln!(lines, "{quote}{name}{quote} = {}", value(&text));
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
    Ok((name.trim_end(), value.trim_start().into()))
}

/// The shortest text that reads as the same recipe: the preset's name and the fields that differ from it.
impl fmt::Display for Recipe {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.preset.name())?;
        self.written().try_for_each(|(name, value)| write!(f, ",{name}={value}"))
    }
}
