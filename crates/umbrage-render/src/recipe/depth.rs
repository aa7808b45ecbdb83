//! The fields that say which depth is compared.

use super::values::{bias_range, number, one_of, share};
use super::{RecipeError, Set};
use umbrage_plane::Bias;
use umbrage_shadow::{AnyDepth, BiasCone, Biased, OnPlane, Radius, Spread};

/// Which depth is compared.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Choice {
    Constant,
    Plane,
    Cone,
}

/// The three ways to give a receiver its depth, and the one that is meant.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Depth {
    pub choice: Choice,
    pub biased: Biased,
    pub slope: f32,
    pub radius: Radius,
    pub slack: f32,
    pub reach: f32,
}

impl Depth {
    pub fn new(choice: Choice, biased: Biased) -> Self {
        let BiasCone { slope, radius, .. } = BiasCone::default();
        Self { choice, biased, slope, radius, slack: 0.0, reach: f32::INFINITY }
    }

    /// The one that is meant.
    pub fn chosen(&self) -> AnyDepth {
        match self.choice {
            Choice::Constant => self.biased.into(),
            Choice::Plane => self.plane().into(),
            Choice::Cone => self.cone().into(),
        }
    }

    pub fn plane(&self) -> OnPlane {
        OnPlane::default().with_bias(self.biased.low).with_slack(self.slack).with_reach(self.reach)
    }

    pub fn cone(&self) -> BiasCone {
        let base = if let Bias::World(base) = self.biased.low { base } else { 0.0 };
        BiasCone::default().with_base(base).with_slope(self.slope).with_radius(self.radius)
    }

    pub fn set(&mut self, field: &str, value: &str) -> Set {
        match field {
            "bias" => (self.biased.low, self.biased.high) = bias_range(field, value)?,
            "spread" => {
                let known = [("random", Spread::Random), ("ramp", Spread::Ramp)];
                self.biased.spread = one_of(field, value, &known, "random or ramp")?;
            }
            "depth" => {
                let known = [("constant", Choice::Constant), ("plane", Choice::Plane), ("cone", Choice::Cone)];
                self.choice = one_of(field, value, &known, "constant, plane or cone")?;
            }
            "slope" => self.slope = number(field, value)?,
            "radius" => {
                let known = [("texel-centre", Radius::TexelCentre), ("nominal", Radius::Nominal)];
                self.radius = one_of(field, value, &known, "texel-centre or nominal")?;
            }
            "slack" => self.slack = share(field, value)?,
            "reach" => self.reach = number(field, value)?,
            _ => return Ok(false),
        }
        Ok(true)
    }

    /// What only all fields together can show.
    pub fn check(&self) -> Result<(), RecipeError> {
        let Biased { low, high, spread, .. } = self.biased;
        if self.choice != Choice::Constant && low != high {
            return Err(RecipeError::value("bias", &format!("{low:?} to {high:?}"), "one bias, unless depth=constant"));
        }
        if self.choice != Choice::Constant && spread != Spread::default() {
            return Err(RecipeError::value("spread", "ramp", "none, unless depth=constant"));
        }
        if self.choice == Choice::Cone && !matches!(low, Bias::World(_)) {
            return Err(RecipeError::value("bias", &format!("{low:?}"), "world units, with depth=cone"));
        }
        Ok(())
    }
}
