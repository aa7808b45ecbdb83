//! A view with one thing changed.

use crate::{Kind, Projection, Rules, Sampling, TexelRect, View, ViewError};
use glam::{DMat4, DQuat, DVec2, DVec3, UVec2};
use std::f64::consts::FRAC_PI_2;

/// The angle from one seed of a sunflower to the next, radians.
const GOLDEN_ANGLE: f64 = 2.399_963_229_728_653;

/// The distance from the centre of a unit sphere within which lies a fraction, in 0..=1, of what is spread by 1 / √(1 − r²): r = sin t with
/// t − sin t · cos t = fraction · π / 2.
fn distance_of(share: f64) -> f64 {
    let (mut low, mut high) = (0.0, FRAC_PI_2);
    for _ in 0..40 {
        let middle = 0.5 * (low + high);
        if middle - middle.sin() * middle.cos() < share * FRAC_PI_2 { low = middle } else { high = middle }
    }
    low.sin()
}

impl View {
    /// The same view whose map stores another kind of depth.
    #[must_use]
    pub fn with_kind(mut self, kind: Kind) -> Self {
        self.kind = kind;
        self
    }

    /// The same view sampled elsewhere inside its texels.
    #[must_use]
    pub fn with_sampling(mut self, sampling: Sampling) -> Self {
        self.sampling = sampling;
        self
    }

    /// The same view with other answers outside its map.
    #[must_use]
    pub fn with_rules(mut self, rules: Rules) -> Self {
        self.rules = rules;
        self
    }

    /// The same view with a cone of light about its axis: `cos_half` is the cosine of the angle between the axis and the
    /// cone's side, so that 0 is everything in front of the light. Meaningless, and ignored, in an orthographic view.
    ///
    /// # Errors
    /// [`ViewError::Cone`] unless the cosine is within [0, 1).
    pub fn with_cone(mut self, cos_half: Option<f64>) -> Result<Self, ViewError> {
        if let Some(cos_half) = cos_half.filter(|cos_half| !(0.0..1.0).contains(cos_half)) {
            return Err(ViewError::Cone(cos_half));
        }
        self.cone = cos_half;
        Ok(self)
    }

    /// The same view with a map of another size over the same field; its texels need not stay square.
    ///
    /// # Errors
    /// [`ViewError::Size`].
    pub fn with_size(self, size: UVec2) -> Result<Self, ViewError> {
        Self::new(self.world_to_eye, self.projection, self.near, self.far, size).map(|view| view.alike(&self))
    }

    /// The same view, moved by `by` world units without turning. What it shows of a world that moves along is the same to
    /// the roundings of f64: at 10⁶ units from the origin they are about 10⁻¹⁰.
    ///
    /// # Errors
    /// [`ViewError::Placement`] when it ends at a place that is not finite.
    pub fn moved(self, by: DVec3) -> Result<Self, ViewError> {
        if by == DVec3::ZERO {
            return Ok(self);
        }
        let mut world_to_eye = self.world_to_eye;
        world_to_eye.w_axis -= world_to_eye.transform_vector3(by).extend(0.0);
        Self::new(world_to_eye, self.projection, self.near, self.far, self.size).map(|view| view.alike(&self))
    }

    /// The same view of a world that is `factor` times as large about its origin: place, near and far plane and the width
    /// of an orthographic view are multiplied. For powers of two nothing is rounded; depths in world units are then
    /// `factor` times the old ones, bit for bit.
    ///
    /// # Errors
    /// [`ViewError`], unless `factor` is positive and what it makes of the view is usable.
    pub fn scaled(self, factor: f64) -> Result<Self, ViewError> {
        if !(factor.is_finite() && factor > 0.0) {
            return Err(ViewError::Factor(factor));
        }
        let mut world_to_eye = self.world_to_eye;
        world_to_eye.w_axis = (world_to_eye.w_axis.truncate() * factor).extend(1.0);
        let projection = match self.projection {
            Projection::Perspective { .. } => self.projection,
            Projection::Orthographic { half, shift } => Projection::Orthographic { half: half * factor, shift },
        };
        let (near, far) = (self.near * factor, self.far * factor);
        Self::new(world_to_eye, projection, near, far, self.size).map(|view| view.alike(&self))
    }

    /// Views from `count` points of a disc in this light's place, spread evenly by area in the order of a sunflower's seeds (Vogel 1979): a light
    /// of that size is their mean. `radius` is in world units, about the eye and square to the axis; of parallel light it is the tangent
    /// of the disc's angle on the sky, and all views turn about the middle of the range on the axis.
    ///
    /// Perspective views keep the window at the far plane, so that each shows all that this one shows there. Nothing is dark only for being outside
    /// of one of them: their rules are [`Rules::OPEN`] and they have no cone.
    ///
    /// # Errors
    /// [`ViewError::Factor`] unless `radius` is finite and not negative; [`ViewError`] when a view ends at a place that is not finite.
    pub fn over_disc(self, radius: f64, count: u32) -> Result<Vec<Self>, ViewError> {
        if !(radius.is_finite() && radius >= 0.0) {
            return Err(ViewError::Factor(radius));
        }
        let at = |index: u32| {
            let share = (f64::from(index) + 0.5) / f64::from(count);
            DVec2::from_angle(GOLDEN_ANGLE * f64::from(index)) * (radius * share.sqrt())
        };
        (0..count).map(|index| self.at_offset(at(index))).collect()
    }

    /// Views from `count` points inside a sphere about this light's place, turned as this one: a light of that size is their mean,
    /// whichever way it shines. `radius` is in world units.
    ///
    /// Seen from anywhere far enough the points lie evenly over the sphere's disc: their density at a distance r from the centre goes with
    /// 1 / √(radius² − r²), whose integral along every line through the sphere is the same.
    ///
    /// # Errors
    /// [`ViewError::Factor`] unless `radius` is finite and not negative; [`ViewError`] when a view ends at a place that is not finite.
    pub fn over_sphere(self, radius: f64, count: u32) -> Result<Vec<Self>, ViewError> {
        if !(radius.is_finite() && radius >= 0.0) {
            return Err(ViewError::Factor(radius));
        }
        let at = |index: u32| {
            let height = 1.0 - (2.0 * f64::from(index) + 1.0) / f64::from(count);
            let around = DVec2::from_angle(GOLDEN_ANGLE * f64::from(index)) * (1.0 - height * height).sqrt();
            // Distances in the order of van der Corput, so that neighbours on the sphere lie at different ones.
            let share = (f64::from(index.reverse_bits()) + 0.5) / 2f64.powi(32);
            around.extend(height) * (radius * distance_of(share))
        };
        (0..count).map(|index| self.moved(at(index))).collect()
    }

    /// The same light from another point of a disc.
    fn at_offset(self, by: DVec2) -> Result<Self, ViewError> {
        let (world_to_eye, projection) = match self.projection {
            Projection::Perspective { k, shift } => {
                let mut moved = self.world_to_eye;
                moved.w_axis -= by.extend(0.0).extend(0.0);
                (moved, Projection::Perspective { k, shift: shift + k * by / self.far })
            }
            Projection::Orthographic { .. } => {
                let middle = DVec3::NEG_Z * (0.5 * (self.near + self.far));
                let turn = DQuat::from_rotation_arc(by.extend(-1.0).normalize(), DVec3::NEG_Z);
                let about = DMat4::from_translation(middle) * DMat4::from_quat(turn) * DMat4::from_translation(-middle);
                (about * self.world_to_eye, self.projection)
            }
        };
        let view = Self::new(world_to_eye, projection, self.near, self.far, self.size)?;
        Ok(Self { rules: Rules::OPEN, cone: None, ..view.alike(&self) })
    }

    /// The part of the same view that a rectangle of its texels shows, with those texels as its map: what was at a texel
    /// position is now there minus `texels.min`. The rectangle may reach beyond the map, which widens the view.
    ///
    /// Everything is the same to the roundings of f64, so that a depth rounded to f32 rarely differs (in fewer than one texel of a thousand), and then by a few steps. Two
    /// things belong to a map and not to a view: footprints are capped at a quarter of the map, which is now smaller, and a
    /// jittered sampling draws its places by the texel's column and row, which are now others.
    ///
    /// # Errors
    /// [`ViewError::Size`] for a rectangle that is empty or more than 32,768 texels wide or high.
    pub fn window(self, texels: TexelRect) -> Result<Self, ViewError> {
        let (whole, low) = (self.size.as_dvec2(), texels.min.as_dvec2());
        let part = (texels.max.as_dvec2() - low).max(DVec2::ZERO);
        let size = part.as_uvec2();
        ViewError::of_size(size)?;
        let ratio = whole / part;
        // x_n of the part is linear in x_n of the whole: both ends of the part are at ±1.
        let middle = (whole - 2.0 * low - part) / part;
        let shifted = |shift: DVec2| shift * ratio + middle * DVec2::new(1.0, -1.0);
        let projection = match self.projection {
            Projection::Perspective { k, shift } => Projection::Perspective { k: k * ratio, shift: shifted(shift) },
            Projection::Orthographic { half, shift } => {
                Projection::Orthographic { half: half / ratio, shift: shifted(shift) }
            }
        };
        Self::new(self.world_to_eye, projection, self.near, self.far, size).map(|view| view.alike(&self))
    }

    /// The same placement, projection, range and size, with everything of another view that [`View::new`] does not take: kind, sampling,
    /// rules and cone.
    #[must_use]
    pub fn alike(self, other: &Self) -> Self {
        Self { kind: other.kind, sampling: other.sampling, rules: other.rules, cone: other.cone, ..self }
    }
}
