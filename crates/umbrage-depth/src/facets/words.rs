use glam::UVec2;

/// Why 32-bit words do not hold a [`FacetMap`](crate::FacetMap).
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error("{field} is {value}: {problem}")]
#[non_exhaustive]
pub struct FacetWordsError {
    /// What the word or number is, with the column and row of its tile where it belongs to one.
    pub field: String,
    /// What it holds.
    pub value: String,
    /// Why that will not do.
    pub problem: String,
}

impl FacetWordsError {
    #[expect(clippy::needless_pass_by_value, reason = "callers hand over what they have just read")]
    pub(super) fn new(field: &str, value: impl ToString, problem: impl Into<String>) -> Self {
        let value = value.to_string();
        Self { field: field.into(), value, problem: problem.into() }
    }

    /// The same fault, said of a tile.
    pub(super) fn in_tile(self, tile: UVec2) -> Self {
        Self { field: format!("tile {}, {}: {}", tile.x, tile.y, self.field), ..self }
    }
}

/// Words that are read one after the other. Counts among them are only believed as far as there are words, so that none of them can
/// ask for more memory than the words themselves take.
pub(super) struct Words<'a> {
    rest: &'a [u32],
}

impl<'a> Words<'a> {
    pub fn new(words: &'a [u32]) -> Self {
        Self { rest: words }
    }

    /// How many are left.
    pub fn left(&self) -> usize {
        self.rest.len()
    }

    pub fn take(&mut self, field: &str, count: usize) -> Result<&'a [u32], FacetWordsError> {
        let Some((taken, rest)) = self.rest.split_at_checked(count) else {
            let problem = format!("only {} words are left", self.rest.len());
            return Err(FacetWordsError::new(field, format!("{count} words"), problem));
        };
        self.rest = rest;
        Ok(taken)
    }

    pub fn one(&mut self, field: &str) -> Result<u32, FacetWordsError> {
        Ok(self.take(field, 1)?[0])
    }

    /// A number of 64 bits that must be finite.
    pub fn finite(&mut self, field: &str) -> Result<f64, FacetWordsError> {
        let words = self.take(field, 2)?;
        let number = double([words[0], words[1]]);
        if number.is_finite() { Ok(number) } else { Err(FacetWordsError::new(field, number, "not finite")) }
    }
}

/// The number that two words hold, the low one first.
pub(super) fn double([low, high]: [u32; 2]) -> f64 {
    f64::from_bits(u64::from(low) | u64::from(high) << 32)
}

/// The two words of a number.
pub(super) fn words_of(number: f64) -> [u32; 2] {
    [number.to_bits() as u32, (number.to_bits() >> 32) as u32]
}
