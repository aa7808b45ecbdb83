//! The fields that say which surface is stored, and pass 1 by them.

use super::values::{count, number, one_of, positive, share};
use super::{RecipeError, Set};
use crate::{Soup, expose, expose_deep};
use std::sync::Arc;
use umbrage_bake::{Deep, bake, bake_by_normals, bake_multi};
use umbrage_depth::{BackFace, DepthRule, First, Map, Midpoint, SameSurface, Second, Tiled};
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
    /// Samples along a texel's side of maps of one surface.
    pub sub_samples: u32,
}

impl Stored {
    pub fn new(rule: Rule) -> Self {
        Self { rule, midpoint: Midpoint::default(), deep: Deep::default(), sub_samples: 1 }
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
            "sub-samples" => {
                let axis = count(field, value)?;
                if axis > 8 {
                    return Err(RecipeError::value(field, value, "a whole number from 1 to 8"));
                }
                (self.sub_samples, self.deep) = (axis, self.deep.with_axis(axis));
            }
            "same" => {
                let known =
                    [("depth", SameSurface::Depth), ("object", SameSurface::Object), ("surface", SameSurface::Surface)];
                self.midpoint.same = one_of(field, value, &known, "depth, object or surface")?;
            }
            _ => return Ok(false),
        }
        Ok(true)
    }

    /// `moments` are the scene at evenly spread times: deep maps hold their mean, and of rules that keep one surface each texel sees one of them.
    pub fn bake(&self, moments: &[&Scene], view: &View) -> Map {
        if self.rule == Rule::Deep {
            return expose_deep(view, moments, &self.deep).into();
        }
        match moments {
            [scene] => self.flat(scene, view).into(),
            _ => expose(view, moments, 0, |scene| self.flat(scene, view)).into(),
        }
    }

    /// One surface a texel.
    fn flat(&self, scene: &Scene, view: &View) -> Arc<Tiled> {
        let soup = Soup::casters(scene, view);
        match self.rule {
            Rule::First | Rule::Deep => self.sampled(&soup, view, &First, Cull::None),
            Rule::Second => self.sampled(&soup, view, &Second, Cull::None),
            Rule::BackFace => self.sampled(&soup, view, &BackFace, Cull::Front),
            Rule::Midpoint => self.sampled(&soup, view, &self.midpoint, Cull::None),
            Rule::Normals => bake_by_normals(view, soup.casting(), &BackFace).map,
        }
    }

    /// As many samples a texel as are asked for, one where so many do not fit.
    fn sampled<R: DepthRule>(&self, soup: &Soup, view: &View, rule: &R, cull: Cull) -> Arc<Tiled> {
        let many =
            (self.sub_samples > 1).then(|| bake_multi(view, soup.triangles(), rule, cull, self.sub_samples).ok());
        many.flatten().unwrap_or_else(|| bake(view, soup.triangles(), rule, cull)).map
    }
}
