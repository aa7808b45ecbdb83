//! Percentage-closer recipes: Reeves' and Woo's.

use super::depth::{Choice, Depth};
use super::values::{count, number, one_of, positive, share, switch};
use super::{RecipeError, Set, over};
use umbrage_depth::Map;
use umbrage_plane::Bias;
use umbrage_sample::{
    AnyPattern, Centre, Density, Disc, EveryTexel, Gaussian, InsideQuadReject, InsideQuadWarp, Jittered, Tent, Uniform,
};
use umbrage_shadow::{Biased, IntegerFirst, Pcf, Shadow};

pub const FIELDS: &str = "stored, ratio, merge, same, epsilon, sub-samples, pattern, samples, min-samples, jitter, hard-cap, compare, unit, res-factor, min-size, bias, spread, depth, slope, radius, slack or reach";

/// The named parts of a percentage-closer recipe.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Reeves {
    pub pattern: PatternName,
    pub depth: Depth,
    pub integer_first: bool,
    pub unit: f32,
    /// Its own depth is not used.
    pub pcf: Pcf,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum PatternName {
    Jittered,
    Uniform,
    Gaussian,
    Inside,
    Warp,
    Every,
    Tent,
    Centre,
    Disc,
}

pub const PATTERNS: &[(&str, PatternName)] = &[
    ("jittered", PatternName::Jittered),
    ("uniform", PatternName::Uniform),
    ("gaussian", PatternName::Gaussian),
    ("inside", PatternName::Inside),
    ("warp", PatternName::Warp),
    ("every", PatternName::Every),
    ("tent", PatternName::Tent),
    ("centre", PatternName::Centre),
    ("disc", PatternName::Disc),
];

impl Reeves {
    pub fn new(pcf: Pcf) -> Self {
        let depth = Depth::new(Choice::Constant, pcf.depth);
        let pcf = pcf.with_depth(Biased::default());
        Self { pattern: PatternName::Jittered, depth, integer_first: false, unit: 1.0, pcf }
    }

    pub fn set(&mut self, field: &str, value: &str) -> Set {
        match field {
            "pattern" => {
                let expected = "jittered, uniform, gaussian, inside, warp, every, tent, centre or disc";
                self.pattern = one_of(field, value, PATTERNS, expected)?;
            }
            "samples" => self.pcf.pattern.num_samples = count(field, value)?,
            "min-samples" => self.pcf.pattern.min_samples = count(field, value)?,
            "res-factor" => self.pcf.res_factor = number(field, value)?,
            "min-size" => self.pcf.min_size = number(field, value)?,
            "jitter" => self.pcf.pattern.jitter = share(field, value)?,
            "hard-cap" => self.pcf.pattern.hard_cap = switch(field, value)?,
            "compare" => {
                self.integer_first = one_of(field, value, &[("float", false), ("integer", true)], "float or integer")?;
            }
            "unit" => self.unit = positive(field, value)?,
            _ => return self.depth.set(field, value),
        }
        Ok(true)
    }

    /// What only all fields together can show.
    pub fn check(&self) -> Result<(), RecipeError> {
        let Jittered { num_samples, min_samples, .. } = self.pcf.pattern;
        if min_samples > num_samples {
            return Err(RecipeError::value("min-samples", &min_samples.to_string(), "at most samples"));
        }
        let plain = self.pattern == PatternName::Jittered && self.depth.biased == Biased::constant(Bias::ZERO);
        if self.integer_first && !(plain && self.depth.choice == Choice::Constant) {
            return Err(RecipeError::value(
                "compare",
                "integer",
                "float, unless pattern=jittered, depth=constant, bias=0",
            ));
        }
        self.depth.check()
    }

    pub fn bind(self, map: Map) -> Box<dyn Shadow> {
        let Pcf { pattern, res_factor, min_size, .. } = self.pcf;
        if self.integer_first {
            return over(
                IntegerFirst::default()
                    .with_pattern(pattern)
                    .with_res_factor(res_factor)
                    .with_min_size(min_size)
                    .with_unit(self.unit),
                map,
            );
        }
        over(self.pcf.with_pattern(self.pattern()).with_depth(self.depth.chosen()), map)
    }

    fn pattern(self) -> AnyPattern {
        let jittered = self.pcf.pattern;
        let num_samples = jittered.num_samples;
        match self.pattern {
            PatternName::Jittered => jittered.into(),
            PatternName::Uniform => Uniform::default().with_num_samples(num_samples).into(),
            PatternName::Gaussian => Gaussian::default().with_num_samples(num_samples).into(),
            PatternName::Inside => InsideQuadReject(jittered).into(),
            PatternName::Warp => InsideQuadWarp(jittered).into(),
            PatternName::Every => EveryTexel.into(),
            PatternName::Tent => Tent.into(),
            PatternName::Centre => Centre.into(),
            PatternName::Disc => Disc::default().with_num_samples(num_samples).with_density(Density::Uniform).into(),
        }
    }
}
