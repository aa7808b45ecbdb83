//! Wang & Molnar's recipes.

use super::values::{bias, number, one_of, share};
use super::{RecipeError, Set, over};
use umbrage_depth::Map;
use umbrage_sample::{AnyPattern, Tent};
use umbrage_shadow::{Conditional, Shadow, VirtualWhen, presets};

pub const FIELDS: &str = "stored, ratio, merge, same, epsilon, sub-samples, nearby, pattern, res-factor, min-size, bias, slack, reach, virtual, min-cos or backs";

/// The named parts of a recipe of second surfaces.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct WangMolnar {
    pub tent: bool,
    pub filter: Conditional,
}

impl Default for WangMolnar {
    fn default() -> Self {
        Self { tent: false, filter: presets::wang_molnar94().filter }
    }
}

impl WangMolnar {
    pub fn set(&mut self, field: &str, value: &str) -> Set {
        let filter = &mut self.filter;
        match field {
            "nearby" => (filter.res_factor, filter.min_size) = nearby(field, value)?,
            "pattern" => self.tent = one_of(field, value, &[("every", false), ("tent", true)], "every or tent")?,
            "res-factor" => filter.res_factor = number(field, value)?,
            "min-size" => filter.min_size = number(field, value)?,
            "bias" => filter.plane.bias = bias(field, value)?,
            "slack" => filter.plane.slack = share(field, value)?,
            "reach" => filter.plane.reach = number(field, value)?,
            "virtual" => {
                let known =
                    [("mixed", VirtualWhen::Mixed), ("always", VirtualWhen::Always), ("never", VirtualWhen::Never)];
                filter.when = one_of(field, value, &known, "mixed, always or never")?;
            }
            "min-cos" => filter.min_cos = share(field, value)?,
            "backs" => {
                filter.dark_backs = one_of(field, value, &[("shaded", false), ("dark", true)], "shaded or dark")?;
            }
            _ => return Ok(false),
        }
        Ok(true)
    }

    pub fn bind(self, map: Map) -> Box<dyn Shadow> {
        let pattern: AnyPattern = if self.tent { Tent.into() } else { self.filter.pattern.into() };
        over(self.filter.with_pattern(pattern), map)
    }
}

/// `ResFactor` and least half-extent of a named neighbourhood (WM94-6).
fn nearby(field: &str, value: &str) -> Result<(f32, f32), RecipeError> {
    let side = value.strip_prefix("box").and_then(|side| side.parse().ok()).filter(|side: &u8| (3..=9).contains(side));
    match (value, side) {
        ("four", _) => Ok((0.0, 1.0)),
        ("region", _) => Ok((1.0, 1.0)),
        (_, Some(side)) => Ok((0.0, 0.5 * f32::from(side))),
        _ => Err(RecipeError::value(field, value, "four, region or box3 to box9")),
    }
}
