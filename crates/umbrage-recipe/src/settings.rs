//! Settings of engines' biases, by the engines' own names and in their units: all that is known of them is in `umbrage-engines`.

use crate::{RecipeError, kind};
use umbrage_engines::{Engine, SettingInfo};

/// Most settings that an engine has.
const MOST: usize = 4;

/// Which settings a recipe gives, by their places in the list of the engine whose bias is compared; the others have their defaults.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Settings([Option<f64>; MOST]);

impl Settings {
    /// Those that differ from their defaults.
    pub fn given(&self, engine: Engine) -> impl Iterator<Item = (&'static SettingInfo, f64)> {
        let values = self.0;
        of(engine).iter().zip(values).filter_map(|(info, value)| Some((info, value?)))
    }

    /// Reads a setting of the engine whose bias is compared; false where `name` is none of its settings.
    pub fn read(&mut self, engine: Option<Engine>, name: &str, text: &str) -> Result<bool, RecipeError> {
        let mut settings = engine.into_iter().flat_map(of).zip(&mut self.0);
        let Some((info, place)) = settings.find(|(info, _)| info.name == name) else { return Ok(false) };
        let value = number(text).filter(|value| !info.whole || value.fract() == 0.0);
        let value = value.ok_or_else(|| RecipeError::value(name, text, expected(info)))?;
        // What an engine does by itself is not worth a word.
        *place = Some(value).filter(|value| info.default != Some(*value));
        Ok(true)
    }
}

/// The settings of an engine's bias.
pub fn of(engine: Engine) -> &'static [SettingInfo] {
    let settings = engine.about().settings;
    debug_assert!(settings.len() <= MOST, "{engine}");
    settings
}

/// Why a name that some engine has as a setting is none of this one's; `None` for a name that no engine has.
pub fn missing(engine: Option<Engine>, name: &str) -> Option<RecipeError> {
    let known = Engine::ALL.into_iter().flat_map(|engine| engine.about().settings).any(|info| info.name == name);
    let expected = engine.map_or("none, unless depth is an engine's bias".into(), |engine| {
        let names: Vec<_> = of(engine).iter().map(|info| info.name).collect();
        format!("{}, the settings of {engine}", kind::either(&names))
    });
    known.then(|| RecipeError::value("setting", name, expected))
}

/// What may be written, with its unit.
pub fn expected(info: &SettingInfo) -> String {
    format!("a finite {}number ({})", if info.whole { "whole " } else { "" }, info.unit)
}

/// A finite number, or the second end of a range as `Setting` of `umbrage-engines` writes it: where a unit of the depth format is left open, the least is taken, so
/// that this end gives what was wanted.
fn number(text: &str) -> Option<f64> {
    let finite = |text: &str| text.trim().parse::<f64>().ok().filter(|value| value.is_finite());
    match text.split_once("..") {
        Some((least, most)) => finite(least).and_then(|_| finite(most)),
        None => finite(text),
    }
    // 0 has no sign.
    .map(|value| value + 0.0)
}
