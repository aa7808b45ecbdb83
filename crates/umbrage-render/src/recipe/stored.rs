//! The fields that say which surface is stored, and pass 1 by them.

use super::values::{number, one_of, positive, share};
use super::{RecipeError, Set};
use crate::{Map, Soup, bake};
use umbrage_depth::{BackFace, First, Midpoint, Second};
use umbrage_plane::View;
use umbrage_raster::Cull;
use umbrage_scene::Scene;

/// Which surface of a texel is stored.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Rule {
    First,
    Second,
    BackFace,
    Midpoint,
}

/// A depth rule with its parameters.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Stored {
    pub rule: Rule,
    pub midpoint: Midpoint,
}

impl Stored {
    pub fn new(rule: Rule) -> Self {
        Self { rule, midpoint: Midpoint::default() }
    }

    pub fn set(&mut self, field: &str, value: &str) -> Set {
        match field {
            "stored" => {
                let known = [
                    ("first", Rule::First),
                    ("second", Rule::Second),
                    ("back-face", Rule::BackFace),
                    ("midpoint", Rule::Midpoint),
                ];
                self.rule = one_of(field, value, &known, "first, second, back-face or midpoint")?;
            }
            "ratio" => {
                let ratio = positive(field, value).and_then(|_| share(field, value));
                let expected = "a number above 0, at most 1";
                self.midpoint.ratio = ratio.map_err(|_| RecipeError::value(field, value, expected))?;
            }
            "merge" => self.midpoint.merge = number(field, value)?,
            _ => return Ok(false),
        }
        Ok(true)
    }

    pub fn bake(&self, scene: &Scene, view: &View) -> Map {
        let soup = Soup::casters(scene, view);
        let triangles = soup.triangles();
        match self.rule {
            Rule::First => bake(view, triangles, &First, Cull::None).map,
            Rule::Second => bake(view, triangles, &Second, Cull::None).map,
            Rule::BackFace => bake(view, triangles, &BackFace, Cull::Front).map,
            Rule::Midpoint => bake(view, triangles, &self.midpoint, Cull::None).map,
        }
        .into()
    }
}
