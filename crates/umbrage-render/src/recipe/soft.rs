//! Soft-shadow recipes: Burley's and Fernando's.

use super::depth::{Choice, Depth};
use super::values::{count, extent, number, one_of, positive, share, switch};
use super::{RecipeError, Set, over};
use umbrage_depth::Map;
use umbrage_plane::Bias;
use umbrage_sample::{Density, Disc};
use umbrage_shadow::{Biased, MapRadius, OccluderFalloff, Shadow, Soft, Softness, presets};

pub const FIELDS: &str = "stored, ratio, merge, same, epsilon, sub-samples, min, max, light, nearest, search, blur, rotate, half-offset, rescue, falloff, shape, opacity, opacity-shape, fade, bias, spread, depth, slope, radius, slack or reach";

/// The named parts of a soft recipe.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Burley {
    pub depth: Depth,
    /// Its own depth is not used.
    pub soft: Soft,
    /// Radii that are given.
    min: Option<MapRadius>,
    max: Option<MapRadius>,
    light: Option<f32>,
    nearest: Option<f32>,
}

impl Burley {
    pub fn cone() -> Self {
        Self::new(Depth::new(Choice::Cone, Biased::constant(Bias::ZERO)), presets::burley().filter)
    }

    pub fn fernando() -> Self {
        // One texel: what a constant bias is set to where nothing is known of the scene.
        let Soft { softness, search, blur, falloff, radius_gamma, opacity, rescue, depth, .. } =
            presets::fernando(Bias::Texels(1.0)).filter;
        let soft = presets::burley()
            .filter
            .with_softness(softness)
            .with_search(search)
            .with_blur(blur)
            .with_falloff(falloff)
            .with_radius_gamma(radius_gamma)
            .with_opacity(opacity)
            .with_rescue(rescue);
        Self::new(Depth::new(Choice::Constant, depth), soft)
    }

    fn new(depth: Depth, soft: Soft) -> Self {
        Self { depth, soft, min: None, max: None, light: None, nearest: None }
    }

    /// The radii as they are meant together.
    pub fn softness(&self) -> Softness {
        match (self.light, self.soft.softness) {
            (Some(radius), _) => Softness::Light { radius, nearest: self.nearest.unwrap_or(0.0) },
            (None, Softness::Between { min, max }) => {
                Softness::Between { min: self.min.unwrap_or(min), max: self.max.unwrap_or(max) }
            }
            (None, known) => known,
        }
    }

    pub fn set(&mut self, field: &str, value: &str) -> Set {
        let soft = &mut self.soft;
        match field {
            "min" => self.min = Some(extent(field, value)?),
            "max" => self.max = Some(extent(field, value)?),
            "light" => self.light = Some(number(field, value)?),
            "nearest" => self.nearest = Some(positive(field, value)?),
            "search" => soft.search.num_samples = count(field, value)?,
            "blur" => soft.blur.num_samples = count(field, value)?,
            "rotate" => each(soft, |disc| &mut disc.rotate, switch(field, value)?),
            "half-offset" => each(soft, |disc| &mut disc.half_offset, switch(field, value)?),
            "rescue" => soft.rescue = switch(field, value)?,
            "falloff" => {
                let known = [
                    ("linear", (OccluderFalloff::Linear { rim: 0.1 }, Density::Centred)),
                    ("smooth", (OccluderFalloff::Smooth { rim: 0.1 }, Density::Centred)),
                    ("square", (OccluderFalloff::Power { rim: 0.1, exponent: 2.0 }, Density::Centred)),
                    ("flat", (OccluderFalloff::Flat, Density::Uniform)),
                ];
                (soft.falloff, soft.search.density) = one_of(field, value, &known, "linear, smooth, square or flat")?;
            }
            "shape" => soft.radius_gamma = positive(field, value)?,
            "opacity-shape" => soft.opacity.gamma = positive(field, value)?,
            "fade" => soft.opacity.fade = positive(field, value)?,
            "opacity" => {
                let ends =
                    value.split_once("..").and_then(|(near, far)| share(field, near).ok().zip(share(field, far).ok()));
                let (near, far) =
                    ends.ok_or_else(|| RecipeError::value(field, value, "two numbers a..b from 0 to 1"))?;
                soft.opacity = soft.opacity.with_near(near).with_far(far);
            }
            _ => return self.depth.set(field, value),
        }
        Ok(true)
    }

    /// What only all fields together can show.
    pub fn check(&self) -> Result<(), RecipeError> {
        if self.light.is_some() && (self.min.is_some() || self.max.is_some()) {
            let field = if self.min.is_some() { "min" } else { "max" };
            return Err(RecipeError::value(field, "given", "no such field beside light"));
        }
        if let (Some(nearest), None) = (self.nearest, self.light) {
            return Err(RecipeError::value("nearest", &nearest.to_string(), "light too"));
        }
        if let Softness::Between { min, max } = self.softness() {
            let larger = match (min, max) {
                (MapRadius::Texels(min), MapRadius::Texels(max))
                | (MapRadius::Fraction(min), MapRadius::Fraction(max))
                | (MapRadius::World(min), MapRadius::World(max)) => min > max,
                _ => false,
            };
            if larger {
                return Err(RecipeError::value("min", &format!("{min:?}"), "at most max"));
            }
        }
        self.depth.check()
    }

    pub fn bind(self, map: Map) -> Box<dyn Shadow> {
        over(self.soft.with_softness(self.softness()).with_depth(self.depth.chosen()), map)
    }
}

fn each(soft: &mut Soft, field: fn(&mut Disc) -> &mut bool, on: bool) {
    *field(&mut soft.search) = on;
    *field(&mut soft.blur) = on;
}
