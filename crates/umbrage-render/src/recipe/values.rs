//! Values of fields, read from text.

use super::RecipeError;
use umbrage_plane::Bias;
use umbrage_shadow::MapRadius;

/// A whole number from 1.
pub fn count(field: &str, value: &str) -> Result<u32, RecipeError> {
    let parsed = value.parse().ok().filter(|n| (1..=65_536).contains(n));
    parsed.ok_or_else(|| RecipeError::value(field, value, "a whole number from 1 to 65536"))
}

/// A finite number from 0.
pub fn number(field: &str, value: &str) -> Result<f32, RecipeError> {
    let parsed = value.parse().ok().filter(|n: &f32| n.is_finite() && *n >= 0.0);
    parsed.ok_or_else(|| RecipeError::value(field, value, "a finite number from 0"))
}

/// A finite number above 0.
pub fn positive(field: &str, value: &str) -> Result<f32, RecipeError> {
    let parsed = number(field, value).ok().filter(|n| *n > 0.0);
    parsed.ok_or_else(|| RecipeError::value(field, value, "a finite number above 0"))
}

/// A number from 0 to 1.
pub fn share(field: &str, value: &str) -> Result<f32, RecipeError> {
    let parsed = number(field, value).ok().filter(|n| *n <= 1.0);
    parsed.ok_or_else(|| RecipeError::value(field, value, "a number from 0 to 1"))
}

/// A number from 0 to 2.
pub fn up_to_two(field: &str, value: &str) -> Result<f32, RecipeError> {
    let parsed = number(field, value).ok().filter(|n| *n <= 2.0);
    parsed.ok_or_else(|| RecipeError::value(field, value, "a number from 0 to 2"))
}

/// `on` or `off`.
pub fn switch(field: &str, value: &str) -> Result<bool, RecipeError> {
    one_of(field, value, &[("on", true), ("off", false)], "on or off")
}

/// One of several words.
pub fn one_of<T: Copy>(
    field: &str,
    value: &str,
    known: &[(&str, T)],
    expected: &'static str,
) -> Result<T, RecipeError> {
    let found = known.iter().find(|(name, _)| *name == value).map(|(_, meant)| *meant);
    found.ok_or_else(|| RecipeError::value(field, value, expected))
}

/// A number of one unit as a bias.
type Unit = fn(f32) -> Bias;

/// The digits of a bias, and its unit.
fn unit(value: &str) -> (&str, Unit) {
    let units: [(char, Unit); 4] = [('w', Bias::World), ('t', Bias::Texels), ('s', Bias::Steps), ('m', Bias::Map)];
    let named = units.into_iter().find_map(|(letter, unit)| Some((value.strip_suffix(letter)?, unit)));
    named.unwrap_or((value, Bias::World))
}

/// One bias with its unit, world units without.
pub fn bias(field: &str, value: &str) -> Result<Bias, RecipeError> {
    let (digits, unit) = unit(value);
    let error = |_| RecipeError::value(field, value, "a number from 0 with a unit w, t, s or m");
    number(field, digits).map(unit).map_err(error)
}

/// `a..b` with one unit behind, or one bias for both.
pub fn bias_range(field: &str, value: &str) -> Result<(Bias, Bias), RecipeError> {
    let (digits, unit) = unit(value);
    let Some((low, high)) = digits.split_once("..") else { return bias(field, value).map(|bias| (bias, bias)) };
    let both = number(field, low).ok().zip(number(field, high).ok()).filter(|(low, high)| low <= high);
    let error = || RecipeError::value(field, value, "two numbers from 0, the smaller first, and one unit w, t, s or m");
    both.map(|(low, high)| (unit(low), unit(high))).ok_or_else(error)
}

/// A number of one unit as a radius.
type Radius = fn(f32) -> MapRadius;

/// A radius on the map with its unit, texels without.
pub fn extent(field: &str, value: &str) -> Result<MapRadius, RecipeError> {
    let units: [(char, Radius); 3] =
        [('w', MapRadius::World), ('t', MapRadius::Texels), ('%', |percent| MapRadius::Fraction(percent / 100.0))];
    let named = units.into_iter().find_map(|(letter, unit)| Some((value.strip_suffix(letter)?, unit)));
    let (digits, unit) = named.unwrap_or((value, MapRadius::Texels));
    let error =
        |_| RecipeError::value(field, value, "a number from 0 with a unit t (texels), w (world) or % (of the map)");
    number(field, digits).map(unit).map_err(error)
}
