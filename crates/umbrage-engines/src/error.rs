use crate::{About, Part};

/// Why a conversion cannot be made. Each case is one line, with the value that was given.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum EngineError {
    /// A word that names no engine.
    #[error("engine = {given:?}: expected {expected}")]
    Name {
        /// The word.
        given: String,
        /// The names of all engines.
        expected: String,
    },
    /// A field of [`Conditions`](crate::Conditions) that is out of its range.
    #[error("condition {field} = {value} is not {needs}")]
    Condition {
        /// The field.
        field: &'static str,
        /// What was given.
        value: f64,
        /// What it must be.
        needs: &'static str,
    },
    /// A wanted part that is NaN or infinite.
    #[error("bias {part} = {value} is not finite")]
    Bias {
        /// The part.
        part: Part,
        /// What was given.
        value: f64,
    },
    /// A wanted constant part that reaches the light itself, which no step of depth does in perspective.
    #[error("bias constant = {constant} reaches the light, {distance} away")]
    Reaches {
        /// The wanted constant part, world units.
        constant: f64,
        /// The receiver's distance along the axis, world units.
        distance: f64,
    },
    /// A step of depth away from the light that leads beyond infinity.
    #[error("a step of depth of {step} leads beyond infinity from a receiver {distance} away")]
    Beyond {
        /// The step, of depth from 0 at the near plane to 1 at the far one.
        step: f64,
        /// The receiver's distance along the axis, world units.
        distance: f64,
    },
    /// A setting that the engine does not have.
    #[error("{engine} has no setting {given:?}: expected {expected}")]
    Setting {
        /// The engine's name.
        engine: &'static str,
        /// The name that was given.
        given: String,
        /// The names of its settings.
        expected: String,
    },
    /// A setting that is given twice.
    #[error("setting {0} is given twice")]
    Twice(&'static str),
    /// A setting that is NaN or infinite.
    #[error("setting {name} = {value} is not finite")]
    Value {
        /// The setting.
        name: &'static str,
        /// What was given.
        value: f64,
    },
    /// An engine whose settings no public text gives a formula for.
    #[error("{engine}: {why}")]
    NoFormula {
        /// The engine's name.
        engine: &'static str,
        /// What is known instead.
        why: &'static str,
    },
}

impl EngineError {
    /// [`EngineError::Setting`], with the names of the engine's settings.
    pub(crate) fn setting(about: &About, given: &str) -> Self {
        let names: Vec<&str> = about.settings.iter().map(|info| info.name).collect();
        Self::Setting { engine: about.name, given: given.into(), expected: either(&names) }
    }
}

/// Words as help and errors list them: `a, b or c`.
pub(crate) fn either(words: &[&str]) -> String {
    match words {
        [] => "none".into(),
        [only] => (*only).into(),
        [first @ .., last] => format!("{} or {last}", first.join(", ")),
    }
}
