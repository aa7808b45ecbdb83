//! Soft-shadow recipes: Burley's and Fernando's.

use super::depth::{Choice, Depth};
use super::values::{count, extent, number, one_of, positive, share, switch};
use super::{RecipeError, Set, over};
use crate::Map;
use umbrage_plane::Bias;
use umbrage_sample::{Density, Disc};
use umbrage_shadow::{Biased, Falloff, Opacity, ReceiverDepth, Shadow, Soft, Softness, presets};

pub const FIELDS: &str = "stored, ratio, merge, epsilon, sub-samples, min, max, light, nearest, search, blur, rotate, half-offset, rescue, falloff, shape, opacity, opacity-shape, fade, bias, spread, depth, slope, radius or slack";

/// The named parts of a soft recipe.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Burley {
    pub depth: Depth,
    /// Its own depth is not used.
    pub soft: Soft,
}

impl Burley {
    pub fn cone() -> Self {
        Self { depth: Depth::new(Choice::Cone, Biased::constant(Bias::ZERO)), soft: presets::burley() }
    }

    pub fn fernando() -> Self {
        // One texel: what a constant bias is set to where nothing is known of the scene.
        let Soft { softness, search, blur, falloff, radius_gamma, opacity, rescue, depth } =
            presets::fernando(Bias::Texels(1.0));
        let soft = Soft { softness, search, blur, falloff, radius_gamma, opacity, rescue, ..presets::burley() };
        Self { depth: Depth::new(Choice::Constant, depth), soft }
    }

    pub fn set(&mut self, field: &str, value: &str) -> Set {
        let soft = &mut self.soft;
        match field {
            "min" | "max" => {
                let radius = extent(field, value)?;
                let Softness::Between { min, max } = &mut soft.softness else {
                    return Err(RecipeError::value(field, value, "no such field beside light"));
                };
                *(if field == "min" { min } else { max }) = radius;
            }
            "light" => soft.softness = Softness::Light { radius: number(field, value)?, nearest: 0.0 },
            "nearest" => {
                let Softness::Light { nearest, .. } = &mut soft.softness else {
                    return Err(RecipeError::value(field, value, "light first"));
                };
                *nearest = positive(field, value)?;
            }
            "search" => soft.search.num_samples = count(field, value)?,
            "blur" => soft.blur.num_samples = count(field, value)?,
            "rotate" => each(soft, |disc| &mut disc.rotate, switch(field, value)?),
            "half-offset" => each(soft, |disc| &mut disc.half_offset, switch(field, value)?),
            "rescue" => soft.rescue = switch(field, value)?,
            "falloff" => {
                let known = [
                    ("linear", (Falloff::Linear { rim: 0.1 }, Density::Centred)),
                    ("smooth", (Falloff::Smooth { rim: 0.1 }, Density::Centred)),
                    ("flat", (Falloff::Flat, Density::Uniform)),
                ];
                (soft.falloff, soft.search.density) = one_of(field, value, &known, "linear, smooth or flat")?;
            }
            "shape" => soft.radius_gamma = positive(field, value)?,
            "opacity-shape" => soft.opacity.gamma = positive(field, value)?,
            "fade" => soft.opacity.fade = positive(field, value)?,
            "opacity" => {
                let ends =
                    value.split_once("..").and_then(|(near, far)| share(field, near).ok().zip(share(field, far).ok()));
                let (near, far) =
                    ends.ok_or_else(|| RecipeError::value(field, value, "two numbers a..b from 0 to 1"))?;
                soft.opacity = Opacity { near, far, ..soft.opacity };
            }
            _ => return self.depth.set(field, value),
        }
        Ok(true)
    }

    /// What only all fields together can show.
    pub fn check(&self) -> Result<(), RecipeError> {
        self.depth.check()
    }

    pub fn bind(self, map: Map) -> Box<dyn Shadow> {
        match self.depth.choice {
            Choice::Constant => self.with_depth(self.depth.biased, map),
            Choice::Plane => self.with_depth(self.depth.plane(), map),
            Choice::Cone => self.with_depth(self.depth.cone(), map),
        }
    }

    fn with_depth<D: ReceiverDepth + 'static>(self, depth: D, map: Map) -> Box<dyn Shadow> {
        let Soft { softness, search, blur, falloff, radius_gamma, opacity, rescue, .. } = self.soft;
        over(Soft { softness, search, blur, falloff, depth, radius_gamma, opacity, rescue }, map)
    }
}

fn each(soft: &mut Soft, field: fn(&mut Disc) -> &mut bool, on: bool) {
    *field(&mut soft.search) = on;
    *field(&mut soft.blur) = on;
}
