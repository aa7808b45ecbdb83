/// Why a recipe cannot be read, or not be put over a map: one line that names the field, the value and what was expected.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error("{field} = {value:?}: expected {expected}")]
pub struct RecipeError {
    /// The field; `recipe` for the preset's name, `map` for a map that records another surface.
    pub field: String,
    /// What was written, cut where it is too long to be read.
    pub value: String,
    /// What may be written.
    pub expected: String,
}

impl RecipeError {
    /// The same with the recipe's owner: `owner` is put before the field.
    #[must_use]
    pub fn of(self, owner: &str) -> Self {
        Self { field: format!("{owner}, {}", self.field), ..self }
    }

    /// `field` and `value` may be what somebody wrote: long, or with control characters.
    pub(crate) fn value(field: &str, value: &str, expected: impl Into<String>) -> Self {
        const MOST: usize = 80;
        let field = field.escape_debug().take(MOST).collect();
        Self { field, value: value.chars().take(MOST).collect(), expected: expected.into() }
    }
}
