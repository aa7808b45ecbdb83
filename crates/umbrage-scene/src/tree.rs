//! Light trees: what a light sends to a point, as an expression (Reeves, Salesin & Cook 1987).
//!
//! The same nodes stand in two forms. A [`Tree`] is data, which a scene file can hold and which is walked each time. The node types
//! themselves, such as [`Cone`], combine by [`Product`], [`Sum`] and [`Mix`] into one type that the compiler inlines. Both
//! compute by the same functions and agree bit for bit.

use glam::Vec3;
use serde::{Deserialize, Serialize};

/// A point as a light sees it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Sight {
    /// World units from the light; +∞ from a light at infinity.
    pub distance: f32,
    /// Cosine of the angle between the light's axis and the direction to the point.
    pub cos_axis: f32,
    /// What of the light passes whatever stands between, per channel: 1 lit, 0 in shadow.
    pub transmittance: Vec3,
}

/// Something that says how much light a point gets, linear RGB.
pub trait Emission {
    /// The light, per channel.
    fn light(&self, sight: &Sight) -> Vec3;
}

/// The same everywhere.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Colour(pub Vec3);

/// Falls with distance: (`reference` / distance) to the power of `exponent`, 1 at `reference` world units; exponent 2 is nature's,
/// 0 none. 1 from a light at infinity, and never more than `most`.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Falloff {
    /// Power of the inverse distance.
    pub exponent: f32,
    /// Distance at which nothing is lost or gained, world units, > 0.
    pub reference: f32,
    /// Bound near the light.
    pub most: f32,
}

/// A cone about the light's axis with a soft edge: 1 inside `inner_deg`, 0 outside `outer_deg` (half-angles, degrees), smooth between.
/// Equal angles make a hard edge, which belongs to the inside.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Cone {
    /// Half-angle of full light.
    pub inner_deg: f32,
    /// Half-angle of no light.
    pub outer_deg: f32,
}

/// Any distribution about the axis: intensities at equal steps of the angle from 0 (the axis) to 180°, linear between. Empty is 0.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Distribution(pub Vec<f32>);

/// What passes to the point, by the light's shadow map: 1 − shadow. A tree without this node casts no shadow.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
pub struct Passing;

/// The product of two.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Product<A, B>(pub A, pub B);

/// The sum of two.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Sum<A, B>(pub A, pub B);

/// From the second to the third as the first goes from 0 to 1.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Mix<S, A, B>(pub S, pub A, pub B);

impl Emission for Colour {
    #[inline(always)]
    fn light(&self, _sight: &Sight) -> Vec3 {
        self.0
    }
}

impl Emission for Falloff {
    #[inline(always)]
    fn light(&self, sight: &Sight) -> Vec3 {
        let share =
            if sight.distance.is_finite() { (self.reference / sight.distance).powf(self.exponent) } else { 1.0 };
        Vec3::splat(share.min(self.most))
    }
}

impl Emission for Cone {
    #[inline(always)]
    fn light(&self, sight: &Sight) -> Vec3 {
        let (inner, outer) = (self.inner_deg.to_radians().cos(), self.outer_deg.to_radians().cos());
        let share = if sight.cos_axis >= inner {
            1.0
        } else if sight.cos_axis <= outer {
            0.0
        } else {
            let t = (sight.cos_axis - outer) / (inner - outer);
            t * t * (3.0 - 2.0 * t)
        };
        Vec3::splat(share)
    }
}

impl Emission for Distribution {
    #[inline(always)]
    fn light(&self, sight: &Sight) -> Vec3 {
        let Some(last) = self.0.len().checked_sub(1) else { return Vec3::ZERO };
        let place = sight.cos_axis.clamp(-1.0, 1.0).acos() * (last as f32 / std::f32::consts::PI);
        let (step, share) = ((place as usize).min(last), place.fract());
        let next = self.0[(step + 1).min(last)];
        Vec3::splat(self.0[step] + (next - self.0[step]) * share)
    }
}

impl Emission for Passing {
    #[inline(always)]
    fn light(&self, sight: &Sight) -> Vec3 {
        sight.transmittance
    }
}

impl<A: Emission, B: Emission> Emission for Product<A, B> {
    #[inline(always)]
    fn light(&self, sight: &Sight) -> Vec3 {
        self.0.light(sight) * self.1.light(sight)
    }
}

impl<A: Emission, B: Emission> Emission for Sum<A, B> {
    #[inline(always)]
    fn light(&self, sight: &Sight) -> Vec3 {
        self.0.light(sight) + self.1.light(sight)
    }
}

impl<S: Emission, A: Emission, B: Emission> Emission for Mix<S, A, B> {
    #[inline(always)]
    fn light(&self, sight: &Sight) -> Vec3 {
        let (share, a, b) = (self.0.light(sight), self.1.light(sight), self.2.light(sight));
        a + (b - a) * share
    }
}

/// A light's tree as data.
///
/// ```
/// use glam::Vec3;
/// use umbrage_scene::tree::{Cone, Emission, Sight, Tree};
///
/// let lamp = Tree::Product(vec![
///     Tree::colour(Vec3::new(1.0, 0.9, 0.7)),
///     Tree::Cone(Cone { inner_deg: 25.0, outer_deg: 35.0 }),
///     Tree::Shadow { recipe: "reeves87,samples=32".into() },
/// ]);
/// let sight = Sight { distance: 4.0, cos_axis: 1.0, transmittance: Vec3::splat(0.5) };
/// assert_eq!(lamp.light(&sight), Vec3::new(0.5, 0.45, 0.35));
/// assert_eq!(lamp.recipe(), Some("reeves87,samples=32"));
/// ```
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Tree {
    /// See [`Colour`].
    Colour(Colour),
    /// See [`Falloff`].
    Falloff(Falloff),
    /// See [`Cone`].
    Cone(Cone),
    /// See [`Distribution`].
    Distribution(Distribution),
    /// The light's shadow, by a recipe of its own (its own samples, softness and bias); see [`Passing`] for the value.
    Shadow {
        /// The algorithm and its parameters, as text; empty for whatever the picture uses. One light has one map and one recipe: the
        /// first that is met from the left counts.
        recipe: String,
    },
    /// The product of all, from the left; 1 of none.
    Product(Vec<Tree>),
    /// The sum of all, from the left; 0 of none.
    Sum(Vec<Tree>),
    /// See [`Mix`].
    Mix(Box<[Tree; 3]>),
}

impl Tree {
    /// A constant.
    pub fn colour(rgb: Vec3) -> Self {
        Self::Colour(Colour(rgb))
    }

    /// The same light in a world that is `factor` times as large: distances are multiplied. Recipes of shadow nodes are text,
    /// and stay as they are.
    #[must_use]
    pub fn scaled(self, factor: f64) -> Self {
        let all = |nodes: Vec<Self>| nodes.into_iter().map(|node| node.scaled(factor)).collect();
        match self {
            Self::Falloff(node) => {
                let reference = (f64::from(node.reference) * factor) as f32;
                Self::Falloff(Falloff { reference, ..node })
            }
            Self::Product(nodes) => Self::Product(all(nodes)),
            Self::Sum(nodes) => Self::Sum(all(nodes)),
            Self::Mix(nodes) => Self::Mix(Box::new(nodes.map(|node| node.scaled(factor)))),
            other @ (Self::Colour(_) | Self::Cone(_) | Self::Distribution(_) | Self::Shadow { .. }) => other,
        }
    }

    /// The recipe of the first shadow node; `None` when the light casts no shadow.
    pub fn recipe(&self) -> Option<&str> {
        match self {
            Self::Shadow { recipe } => Some(recipe),
            Self::Product(nodes) | Self::Sum(nodes) => nodes.iter().find_map(Self::recipe),
            Self::Mix(nodes) => nodes.iter().find_map(Self::recipe),
            Self::Colour(_) | Self::Falloff(_) | Self::Cone(_) | Self::Distribution(_) => None,
        }
    }
}

impl Emission for Tree {
    fn light(&self, sight: &Sight) -> Vec3 {
        match self {
            Self::Colour(node) => node.light(sight),
            Self::Falloff(node) => node.light(sight),
            Self::Cone(node) => node.light(sight),
            Self::Distribution(node) => node.light(sight),
            Self::Shadow { .. } => Passing.light(sight),
            Self::Product(nodes) => all(nodes, sight, Vec3::ONE, |a, b| a * b),
            Self::Sum(nodes) => all(nodes, sight, Vec3::ZERO, |a, b| a + b),
            Self::Mix(nodes) => {
                let [share, a, b] = nodes.as_ref();
                Mix(ByRef(share), ByRef(a), ByRef(b)).light(sight)
            }
        }
    }
}

/// Folded from the left, beginning with the first node itself.
fn all(nodes: &[Tree], sight: &Sight, none: Vec3, combine: impl Fn(Vec3, Vec3) -> Vec3) -> Vec3 {
    nodes.iter().map(|node| node.light(sight)).reduce(combine).unwrap_or(none)
}

struct ByRef<'a>(&'a Tree);

impl Emission for ByRef<'_> {
    fn light(&self, sight: &Sight) -> Vec3 {
        self.0.light(sight)
    }
}
