//! The fields that say which surface is stored, and pass 1 by them.

use super::values::{count, number, one_of, positive, share};
use super::{RecipeError, Set};
use crate::{Deep, Map, Soup, bake, bake_by_normals, bake_deep};
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
    Normals,
    Midpoint,
    Deep,
}

/// A depth rule with its parameters.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Stored {
    pub rule: Rule,
    pub midpoint: Midpoint,
    pub deep: Deep,
}

impl Stored {
    pub fn new(rule: Rule) -> Self {
        Self { rule, midpoint: Midpoint::default(), deep: Deep::default() }
    }

    pub fn set(&mut self, field: &str, value: &str) -> Set {
        match field {
            "stored" => {
                let known = [
                    ("first", Rule::First),
                    ("second", Rule::Second),
                    ("back-face", Rule::BackFace),
                    ("normals", Rule::Normals),
                    ("midpoint", Rule::Midpoint),
                    ("deep", Rule::Deep),
                ];
                self.rule = one_of(field, value, &known, "first, second, back-face, normals, midpoint or deep")?;
            }
            "ratio" => {
                let ratio = positive(field, value).and_then(|_| share(field, value));
                let expected = "a number above 0, at most 1";
                self.midpoint.ratio = ratio.map_err(|_| RecipeError::value(field, value, expected))?;
            }
            "merge" => self.midpoint.merge = number(field, value)?,
            "epsilon" => {
                let deep = number(field, value).ok().and_then(|epsilon| self.deep.with_epsilon(epsilon).ok());
                self.deep = deep.ok_or_else(|| RecipeError::value(field, value, "a number from 0, below 1"))?;
            }
            "sub-samples" => self.deep = self.deep.with_axis(count(field, value)?),
            _ => return Ok(false),
        }
        Ok(true)
    }

    /// `moments` are the scene at evenly spread times; rules that keep one surface see the first of them.
    pub fn bake(&self, moments: &[&Scene], view: &View) -> Map {
        if self.rule == Rule::Deep {
            return bake_deep(view, moments, &self.deep).into();
        }
        let Some(scene) = moments.first() else {
            return bake(view, std::iter::empty(), &First, Cull::None).map.into();
        };
        let soup = Soup::casters(scene, view);
        let triangles = soup.triangles();
        match self.rule {
            Rule::First | Rule::Deep => bake(view, triangles, &First, Cull::None).map,
            Rule::Second => bake(view, triangles, &Second, Cull::None).map,
            Rule::BackFace => bake(view, triangles, &BackFace, Cull::Front).map,
            Rule::Normals => bake_by_normals(view, &soup, &BackFace).map,
            Rule::Midpoint => bake(view, triangles, &self.midpoint, Cull::None).map,
        }
        .into()
    }
}
