//! What must not be exceeded: `--fail-above`.

use super::row::{NUMBERS, Number, Row};

/// Numbers by their words, each with the most that it may be.
#[derive(Clone, Debug, PartialEq)]
pub struct Limits(Vec<(usize, f64)>);

/// Reads `NAME=NUMBER,..`; the number of a fraction may be given in per cent, with `%` after it.
///
/// # Errors
/// What is expected, for a name that is not known, or a text that is not a number.
pub fn limits(text: &str) -> Result<Limits, String> {
    let names = || NUMBERS.iter().map(|number| number.name).collect::<Vec<_>>().join(", ");
    let limit = |part: &str| {
        let (name, value) = part.split_once('=').ok_or("expected NAME=NUMBER, as in rms=0.02,acne=0.1%")?;
        let (name, value) = (name.trim(), value.trim());
        let at = NUMBERS.iter().position(|number| number.name == name);
        let at = at.ok_or_else(|| format!("{name:?} is not known: expected {}", names()))?;
        let (digits, scale) = match value.strip_suffix('%') {
            Some(_) if !NUMBERS[at].is_share => {
                return Err(format!("{name} is not a fraction: {value} cannot be in per cent"));
            }
            Some(digits) => (digits.trim(), 100.0),
            None => (value, 1.0),
        };
        let number = digits.parse().ok().filter(|number: &f64| number.is_finite());
        number
            .map(|number| (at, number / scale))
            .ok_or_else(|| format!("{name} is {value:?}: expected a finite number"))
    };
    let limits: Vec<(usize, f64)> = text.split(',').map(limit).collect::<Result<_, _>>()?;
    let twice = |index: usize| limits[..index].iter().any(|(at, _)| *at == limits[index].0);
    match (0..limits.len()).find(|index| twice(*index)) {
        Some(index) => Err(format!("{} is given twice", NUMBERS[limits[index].0].name)),
        None => Ok(Limits(limits)),
    }
}

/// A number of a row beside its limit.
pub struct Limited {
    pub number: &'static Number,
    pub value: f64,
    pub most: f64,
}

impl Limited {
    pub fn is_above(&self) -> bool {
        self.value > self.most
    }
}

impl Limits {
    /// The numbers of a row that have limits. Numbers that a row does not have, or that could not be measured, exceed none.
    pub fn of<'a>(&'a self, row: &'a Row) -> impl Iterator<Item = Limited> + 'a {
        self.0.iter().filter_map(|&(at, most)| {
            let number = &NUMBERS[at];
            (number.of)(row).map(|value| Limited { number, value, most })
        })
    }

    /// What is above its limit, in words; nothing where all is well.
    pub fn exceeded(&self, rows: &[Row]) -> Vec<String> {
        let of_row = |row: &Row| {
            let above = self.of(row).filter(Limited::is_above);
            let words = |limited: Limited| {
                let Limited { number, value, most } = limited;
                format!("{} has {} {}, above {}", row.name(), number.name, number.text(value), number.text(most))
            };
            above.map(words).collect::<Vec<_>>()
        };
        rows.iter().flat_map(of_row).collect()
    }
}
