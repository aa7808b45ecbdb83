use crate::{Conditions, EngineError, Part};

/// A shadow bias in world units: the common currency of all engines.
///
/// A receiver is compared as if it were moved by all three parts. Whether an engine moves the receiver or its casters the other
/// way is the same. Parts may be negative: the receiver is then moved away from the light.
#[derive(Clone, Copy, Debug, PartialEq, Default)]
pub struct WorldBias {
    /// World units toward the light along its axis: a caster that is nearer to the light by less, measured along the axis,
    /// casts no shadow on the receiver.
    pub constant: f64,
    /// What grows with the slope of the surface: texels, times the width of a texel at the receiver, times
    /// [`Conditions::slope`], are world units along the axis.
    pub slope: f64,
    /// World units along the surface's normal, toward the side that the light is on.
    pub normal: f64,
}

impl WorldBias {
    /// None at all.
    pub const ZERO: Self = Self { constant: 0.0, slope: 0.0, normal: 0.0 };

    /// A constant part alone, world units along the light's axis.
    pub const fn constant(constant: f64) -> Self {
        Self { constant, ..Self::ZERO }
    }

    /// A part that grows with the slope alone, texels.
    pub const fn slope(slope: f64) -> Self {
        Self { slope, ..Self::ZERO }
    }

    /// An offset along the normal alone, world units.
    pub const fn normal(normal: f64) -> Self {
        Self { normal, ..Self::ZERO }
    }

    /// One of the parts, in its own unit.
    pub const fn part(&self, part: Part) -> f64 {
        match part {
            Part::Constant => self.constant,
            Part::Slope => self.slope,
            Part::Normal => self.normal,
        }
    }

    /// What all parts together do on a plane, in world units along the light's axis: how far the receiver's plane is from the
    /// place that is compared.
    ///
    /// # Errors
    /// Conditions or parts that are not numbers, as [`Engine::settings`](crate::Engine::settings) refuses them.
    pub fn along_axis(&self, conditions: &Conditions) -> Result<f64, EngineError> {
        conditions.check()?;
        self.check()?;
        let steps = self.slope * conditions.texel * conditions.slope;
        Ok(self.constant + steps + self.normal * conditions.ray / conditions.facing)
    }

    /// Refuses NaN and ∞.
    pub(crate) fn check(&self) -> Result<(), EngineError> {
        let wrong = Part::ALL.into_iter().find(|part| !self.part(*part).is_finite());
        match wrong {
            Some(part) => Err(EngineError::Bias { part, value: self.part(part) }),
            None => Ok(()),
        }
    }
}

/// From where to where a bias is. Both ends are equal unless the interface leaves its unit open (see
/// [`Engine::unit`](crate::Engine::unit)) or the setting itself is a range, as RSL's is.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct WorldRange {
    /// What is had at least.
    pub least: WorldBias,
    /// What is had at most.
    pub most: WorldBias,
}

impl WorldRange {
    /// Where nothing is left open.
    pub(crate) const fn exactly(bias: WorldBias) -> Self {
        Self { least: bias, most: bias }
    }
}
