//! Fields of Williams' recipes.

use super::Set;
use super::values::{bias, number, one_of, up_to_two};
use umbrage_shadow::Williams;
use umbrage_shadow::williams::{DitherLaw, Guard, Lookup};

pub const FIELDS: &str =
    "stored, ratio, merge, same, epsilon, sub-samples, bias, lookup, guard, dither, dither-law or dither-depth";

pub fn set(williams: &mut Williams, field: &str, value: &str) -> Set {
    match field {
        "bias" => williams.bias = bias(field, value)?,
        "lookup" => {
            let known = [
                ("nearest", Lookup::Nearest),
                ("bilinear", Lookup::Bilinear(Guard::default())),
                ("faithful", Lookup::Bilinear(Guard::Faithful)),
            ];
            williams.lookup = one_of(field, value, &known, "nearest, bilinear or faithful")?;
        }
        "guard" => williams.lookup = Lookup::Bilinear(Guard::Steps(number(field, value)?)),
        "dither" => williams.dither.amplitude = up_to_two(field, value)?,
        "dither-law" => {
            let known = [("normal", DitherLaw::TruncatedNormal), ("uniforms", DitherLaw::ThreeUniforms)];
            williams.dither.law = one_of(field, value, &known, "normal or uniforms")?;
        }
        "dither-depth" => williams.dither.depth = number(field, value)?,
        _ => return Ok(false),
    }
    Ok(true)
}
