use std::str::FromStr;
use umbrage_depth::{Bbox, Raw, Tiled};
use umbrage_plane::Bias;
use umbrage_sample::{
    Centre, Density, Disc, EveryTexel, Gaussian, InsideQuadReject, InsideQuadWarp, Jittered, Pattern, Uniform,
};
use umbrage_shadow::williams::{DitherLaw, Guard, Lookup};
use umbrage_shadow::{
    Biased, Filter, OnPlane, Ordinary, Pcf, ReceiverDepth, Shadow, ShadowMap, Spread, Williams, presets,
};

/// How a map is kept while it is looked up. Answers are the same bits.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Default)]
pub enum Storage {
    /// Every texel.
    Raw,
    /// The rectangle of finite depths (R87-19).
    Bbox,
    /// 32 × 32 tiles with their ranges (R87-21, R87-22).
    #[default]
    Tiled,
}

impl FromStr for Storage {
    type Err = RecipeError;
    fn from_str(text: &str) -> Result<Self, RecipeError> {
        match text {
            "raw" => Ok(Self::Raw),
            "bbox" => Ok(Self::Bbox),
            "tiled" => Ok(Self::Tiled),
            _ => Err(RecipeError::value("storage", text, "raw, bbox or tiled")),
        }
    }
}

/// Puts a filter over a map in the storage that is asked for: where types end and the one dynamic seam begins.
pub fn bind<F: Filter + 'static>(filter: F, map: &Tiled, storage: Storage) -> Box<dyn Shadow> {
    match storage {
        Storage::Raw => Box::new(ShadowMap { filter, map: Raw::from(map) }),
        Storage::Bbox => Box::new(ShadowMap { filter, map: Bbox::from(map) }),
        Storage::Tiled => Box::new(ShadowMap { filter, map: map.clone() }),
    }
}

/// Why a recipe's text cannot be used: one line that names the field and the value.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error("{field} = {value:?}: expected {expected}")]
pub struct RecipeError {
    /// The field.
    pub field: String,
    /// What was written.
    pub value: String,
    /// What may be written.
    pub expected: &'static str,
}

impl RecipeError {
    /// The same, saying whose recipe it is.
    pub(crate) fn of_light(self, name: &str) -> Self {
        Self { field: format!("light {name:?}, {}", self.field), ..self }
    }

    fn value(field: &str, value: &str, expected: &'static str) -> Self {
        Self { field: field.into(), value: value.into(), expected }
    }
}

/// A shadow algorithm by name, as people write it: a preset and what differs from it, such as
/// `reeves87,samples=16,res-factor=3,bias=0.3..0.4`.
///
/// | field | of | values |
/// |---|---|---|
/// | `pattern` | reeves87 | `jittered`, `uniform`, `gaussian`, `inside`, `warp`, `every`, `centre`, `disc` |
/// | `samples`, `min-samples` | reeves87 | counts from 1, the second at most the first |
/// | `jitter` | reeves87 | part of a cell, 0 (a regular grid) to 1 |
/// | `hard-cap` | reeves87 | `on`, `off`: whether `samples` is never exceeded |
/// | `res-factor`, `min-size` | reeves87, ordinary | numbers from 0 |
/// | `bias` | all | a number or, for reeves87, a range `a..b`, then a unit: none or `w` world, `t` texels, `s` depth steps, `m` map units |
/// | `spread` | reeves87 | `random`, `ramp` |
/// | `depth` | reeves87 | `constant`, `plane` (one bias, no spread) |
/// | `lookup` | williams78 | `nearest`, `bilinear`, `faithful` |
/// | `guard` | williams78 | depth steps of difference up to which `bilinear` interpolates |
/// | `dither` | williams78 | full range in texels, 0 to 2 |
/// | `dither-law` | williams78 | `normal`, `uniforms` |
/// | `dither-depth` | williams78 | full range of a displacement in depth, map units, from 0 |
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Recipe {
    /// Williams 1978, point by point.
    Williams(Williams),
    /// Percentage-closer filtering and its relatives.
    Reeves(Reeves),
    /// Depths filtered first: the control.
    Ordinary(Ordinary),
}

/// The named parts of a percentage-closer recipe.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Reeves {
    pattern: PatternName,
    on_plane: bool,
    pcf: Pcf,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum PatternName {
    Jittered,
    Uniform,
    Gaussian,
    Inside,
    Warp,
    Every,
    Centre,
    Disc,
}

const PATTERNS: &[(&str, PatternName)] = &[
    ("jittered", PatternName::Jittered),
    ("uniform", PatternName::Uniform),
    ("gaussian", PatternName::Gaussian),
    ("inside", PatternName::Inside),
    ("warp", PatternName::Warp),
    ("every", PatternName::Every),
    ("centre", PatternName::Centre),
    ("disc", PatternName::Disc),
];

impl FromStr for Recipe {
    type Err = RecipeError;
    fn from_str(text: &str) -> Result<Self, RecipeError> {
        let mut parts = text.split(',').map(str::trim);
        let name = parts.next().unwrap_or_default();
        let reeves = |pcf| Self::Reeves(Reeves { pattern: PatternName::Jittered, on_plane: false, pcf });
        let mut recipe = match name {
            "williams78" => Self::Williams(presets::williams78()),
            "reeves87" => reeves(presets::reeves87()),
            "reeves87-recommended" => reeves(presets::reeves87_recommended()),
            "ordinary" => Self::Ordinary(Ordinary { pattern: EveryTexel, bias: Bias::ZERO, res_factor: 1.0 }),
            _ => {
                let known = "williams78, reeves87, reeves87-recommended or ordinary";
                return Err(RecipeError::value("recipe", name, known));
            }
        };
        for part in parts {
            let (field, value) = part.split_once('=').ok_or_else(|| RecipeError::value(part, "", "field=value"))?;
            match &mut recipe {
                Self::Williams(williams) => set_williams(williams, field, value)?,
                Self::Reeves(reeves) => reeves.set(field, value)?,
                Self::Ordinary(ordinary) => set_ordinary(ordinary, field, value)?,
            }
        }
        if let Self::Reeves(reeves) = &recipe {
            reeves.check()?;
        }
        Ok(recipe)
    }
}

impl Recipe {
    /// The algorithm over a map.
    pub fn bind(&self, map: &Tiled, storage: Storage) -> Box<dyn Shadow> {
        match *self {
            Self::Williams(williams) => bind(williams, map, storage),
            Self::Ordinary(ordinary) => bind(ordinary, map, storage),
            Self::Reeves(reeves) => reeves.bind(map, storage),
        }
    }
}

impl Reeves {
    fn set(&mut self, field: &str, value: &str) -> Result<(), RecipeError> {
        match field {
            "pattern" => {
                let known = PATTERNS.iter().find(|(name, _)| *name == value);
                let expected = "jittered, uniform, gaussian, inside, warp, every, centre or disc";
                self.pattern = known.ok_or_else(|| RecipeError::value(field, value, expected))?.1;
            }
            "samples" => self.pcf.pattern.num_samples = count(field, value)?,
            "min-samples" => self.pcf.pattern.min_samples = count(field, value)?,
            "res-factor" => self.pcf.res_factor = number(field, value)?,
            "min-size" => self.pcf.min_size = number(field, value)?,
            "jitter" => self.pcf.pattern.jitter = number_up_to(1.0, field, value)?,
            "hard-cap" => {
                self.pcf.pattern.hard_cap = match value {
                    "on" => true,
                    "off" => false,
                    _ => return Err(RecipeError::value(field, value, "on or off")),
                }
            }
            "bias" => (self.pcf.depth.low, self.pcf.depth.high) = bias_range(field, value)?,
            "spread" => {
                self.pcf.depth.spread = match value {
                    "random" => Spread::Random,
                    "ramp" => Spread::Ramp,
                    _ => return Err(RecipeError::value(field, value, "random or ramp")),
                }
            }
            "depth" => {
                self.on_plane = match value {
                    "constant" => false,
                    "plane" => true,
                    _ => return Err(RecipeError::value(field, value, "constant or plane")),
                }
            }
            _ => {
                let fields =
                    "pattern, samples, min-samples, jitter, hard-cap, res-factor, min-size, bias, spread or depth";
                return Err(RecipeError::value("field", field, fields));
            }
        }
        Ok(())
    }

    /// What only all fields together can show.
    fn check(&self) -> Result<(), RecipeError> {
        let Jittered { num_samples, min_samples, .. } = self.pcf.pattern;
        if min_samples > num_samples {
            return Err(RecipeError::value("min-samples", &min_samples.to_string(), "at most samples"));
        }
        let Biased { low, high, spread } = self.pcf.depth;
        if self.on_plane && low != high {
            return Err(RecipeError::value("bias", &format!("{low:?} to {high:?}"), "one bias, with depth=plane"));
        }
        if self.on_plane && spread != Spread::default() {
            return Err(RecipeError::value("spread", "ramp", "none, with depth=plane"));
        }
        Ok(())
    }

    fn bind(self, map: &Tiled, storage: Storage) -> Box<dyn Shadow> {
        if self.on_plane {
            self.with_depth(OnPlane { bias: self.pcf.depth.low }, map, storage)
        } else {
            self.with_depth(self.pcf.depth, map, storage)
        }
    }

    fn with_depth<D: ReceiverDepth + 'static>(self, depth: D, map: &Tiled, storage: Storage) -> Box<dyn Shadow> {
        let num_samples = self.pcf.pattern.num_samples;
        match self.pattern {
            PatternName::Jittered => self.with(self.pcf.pattern, depth, map, storage),
            PatternName::Uniform => self.with(Uniform { num_samples }, depth, map, storage),
            PatternName::Gaussian => self.with(Gaussian { num_samples }, depth, map, storage),
            PatternName::Inside => self.with(InsideQuadReject(self.pcf.pattern), depth, map, storage),
            PatternName::Warp => self.with(InsideQuadWarp(self.pcf.pattern), depth, map, storage),
            PatternName::Every => self.with(EveryTexel, depth, map, storage),
            PatternName::Centre => self.with(Centre, depth, map, storage),
            PatternName::Disc => {
                let disc = Disc { num_samples, density: Density::Uniform, ..Disc::default() };
                self.with(disc, depth, map, storage)
            }
        }
    }

    fn with<P: Pattern + 'static, D: ReceiverDepth + 'static>(
        self,
        pattern: P,
        depth: D,
        map: &Tiled,
        storage: Storage,
    ) -> Box<dyn Shadow> {
        let Pcf { res_factor, min_size, cull, .. } = self.pcf;
        bind(Pcf { pattern, depth, res_factor, min_size, cull }, map, storage)
    }
}

fn set_williams(williams: &mut Williams, field: &str, value: &str) -> Result<(), RecipeError> {
    match field {
        "bias" => williams.bias = bias(field, value)?,
        "lookup" => {
            williams.lookup = match value {
                "nearest" => Lookup::Nearest,
                "bilinear" => Lookup::Bilinear(Guard::default()),
                "faithful" => Lookup::Bilinear(Guard::Faithful),
                _ => return Err(RecipeError::value(field, value, "nearest, bilinear or faithful")),
            }
        }
        "dither" => {
            williams.dither.amplitude = number_up_to(2.0, field, value)?;
        }
        "dither-law" => {
            williams.dither.law = match value {
                "normal" => DitherLaw::TruncatedNormal,
                "uniforms" => DitherLaw::ThreeUniforms,
                _ => return Err(RecipeError::value(field, value, "normal or uniforms")),
            }
        }
        "dither-depth" => williams.dither.depth = number(field, value)?,
        "guard" => williams.lookup = Lookup::Bilinear(Guard::Steps(number(field, value)?)),
        _ => {
            let fields = "bias, lookup, guard, dither, dither-law or dither-depth";
            return Err(RecipeError::value("field", field, fields));
        }
    }
    Ok(())
}

fn set_ordinary(ordinary: &mut Ordinary, field: &str, value: &str) -> Result<(), RecipeError> {
    match field {
        "bias" => ordinary.bias = bias(field, value)?,
        "res-factor" => ordinary.res_factor = number(field, value)?,
        _ => return Err(RecipeError::value("field", field, "bias or res-factor")),
    }
    Ok(())
}

fn count(field: &str, value: &str) -> Result<u32, RecipeError> {
    let parsed = value.parse().ok().filter(|n| (1..=65_536).contains(n));
    parsed.ok_or_else(|| RecipeError::value(field, value, "a whole number from 1 to 65536"))
}

fn number(field: &str, value: &str) -> Result<f32, RecipeError> {
    let parsed = value.parse().ok().filter(|n: &f32| n.is_finite() && *n >= 0.0);
    parsed.ok_or_else(|| RecipeError::value(field, value, "a finite number from 0"))
}

fn number_up_to(most: f32, field: &str, value: &str) -> Result<f32, RecipeError> {
    let expected = if most == 1.0 { "a number from 0 to 1" } else { "a number from 0 to 2" };
    number(field, value).ok().filter(|n| *n <= most).ok_or_else(|| RecipeError::value(field, value, expected))
}

/// A number of one unit as a bias.
type Unit = fn(f32) -> Bias;

/// The digits of a bias, and its unit.
fn unit(value: &str) -> (&str, Unit) {
    let units: [(char, Unit); 4] = [('w', Bias::World), ('t', Bias::Texels), ('s', Bias::Steps), ('m', Bias::Map)];
    let named = units.into_iter().find_map(|(letter, unit)| Some((value.strip_suffix(letter)?, unit)));
    named.unwrap_or((value, Bias::World))
}

fn bias(field: &str, value: &str) -> Result<Bias, RecipeError> {
    let (digits, unit) = unit(value);
    let error = |_| RecipeError::value(field, value, "a number from 0 with a unit w, t, s or m");
    number(field, digits).map(unit).map_err(error)
}

/// `a..b` with one unit behind, or one bias for both.
fn bias_range(field: &str, value: &str) -> Result<(Bias, Bias), RecipeError> {
    let (digits, unit) = unit(value);
    let Some((low, high)) = digits.split_once("..") else { return bias(field, value).map(|bias| (bias, bias)) };
    let both = number(field, low).ok().zip(number(field, high).ok()).filter(|(low, high)| low <= high);
    let error = || RecipeError::value(field, value, "two numbers from 0, the smaller first, and one unit w, t, s or m");
    both.map(|(low, high)| (unit(low), unit(high))).ok_or_else(error)
}

#[cfg(test)]
mod tests {
    use super::*;
    use umbrage_shadow::williams::Dither;

    fn refused(text: &str) -> String {
        text.parse::<Recipe>().unwrap_err().to_string()
    }

    #[test]
    fn r87_12_every_field_is_read() {
        let all = "reeves87,min-samples=32,samples=64,jitter=0.5,hard-cap=on,res-factor=2,min-size=1,bias=0.2..0.3t,spread=ramp";
        let Recipe::Reeves(reeves) = all.parse().unwrap() else { panic!("reeves87") };
        let pattern = Jittered { num_samples: 64, min_samples: 32, jitter: 0.5, hard_cap: true };
        let depth = Biased { low: Bias::Texels(0.2), high: Bias::Texels(0.3), spread: Spread::Ramp };
        assert_eq!(reeves.pcf, Pcf { pattern, depth, res_factor: 2.0, min_size: 1.0, cull: true });
        let all = "williams78,bias=3m,guard=2,dither=1,dither-law=uniforms,dither-depth=0.5";
        let dither = Dither { amplitude: 1.0, law: DitherLaw::ThreeUniforms, depth: 0.5 };
        let lookup = Lookup::Bilinear(Guard::Steps(2.0));
        assert_eq!(all.parse(), Ok(Recipe::Williams(Williams { bias: Bias::Map(3.0), lookup, dither })));
        for (name, pattern) in PATTERNS {
            let Recipe::Reeves(reeves) = format!("reeves87,pattern={name}").parse().unwrap() else {
                panic!("reeves87")
            };
            assert_eq!(reeves.pattern, *pattern);
        }
    }

    #[test]
    fn what_cannot_be_meant_is_told_by_field_and_value() {
        let unit = "two numbers from 0, the smaller first, and one unit w, t, s or m";
        assert_eq!(refused("reeves87,bias=0.3w..0.4t"), format!("bias = \"0.3w..0.4t\": expected {unit}"));
        assert_eq!(refused("reeves87,bias=0.4..0.3"), format!("bias = \"0.4..0.3\": expected {unit}"));
        assert_eq!(refused("reeves87,samples=8,min-samples=9"), "min-samples = \"9\": expected at most samples");
        assert!(refused("reeves87,depth=plane,bias=0.1..0.2").starts_with("bias = "));
        assert!(refused("reeves87,depth=plane,bias=0,spread=ramp").starts_with("spread = "));
        assert_eq!(refused("reeves87,jitter=1.5"), "jitter = \"1.5\": expected a number from 0 to 1");
        assert_eq!(refused("williams78,dither=2.5"), "dither = \"2.5\": expected a number from 0 to 2");
        assert!(refused("reeves86").contains("expected williams78, reeves87"));
        for text in [
            "reeves87,samples=0",
            "reeves87,samples",
            "reeves87,bias=NaN",
            "ordinary,spread=ramp",
            "williams78,bias=-1",
            "",
        ] {
            assert!(!refused(text).contains('\n'), "{text}");
        }
    }
}
