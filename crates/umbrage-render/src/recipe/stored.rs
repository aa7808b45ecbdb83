//! The fields that say which surface is stored, and pass 1 by them.

use super::values::{count, number, one_of, positive, share};
use super::{RecipeError, Set};
use crate::{Deep, Map, Soup, bake, bake_by_normals, bake_deep, bake_moments};
use umbrage_depth::{BackFace, DepthRule, First, Midpoint, Second};
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

    /// `moments` are the scene at evenly spread times: deep maps hold their mean, and of rules that keep one surface each texel sees one of them.
    pub fn bake(&self, moments: &[&Scene], view: &View) -> Map {
        match self.rule {
            Rule::Deep => bake_deep(view, moments, &self.deep).into(),
            Rule::First => baked(moments, view, &First, Cull::None),
            Rule::Second => baked(moments, view, &Second, Cull::None),
            Rule::BackFace => baked(moments, view, &BackFace, Cull::Front),
            Rule::Midpoint => baked(moments, view, &self.midpoint, Cull::None),
            Rule::Normals => match moments {
                [scene] => bake_by_normals(view, &Soup::casters(scene, view), &BackFace).map.into(),
                _ => baked(moments, view, &BackFace, Cull::Front),
            },
        }
    }
}

fn baked<R: DepthRule>(moments: &[&Scene], view: &View, rule: &R, cull: Cull) -> Map {
    match moments {
        [scene] => bake(view, Soup::casters(scene, view).triangles(), rule, cull).map,
        _ => bake_moments(view, moments, rule, 0),
    }
    .into()
}
