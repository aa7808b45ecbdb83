use crate::EngineError;
use umbrage_plane::{Projection, Receiver, View};

/// How a shadow map keeps its depths.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Default)]
pub enum DepthFormat {
    /// 16 bits, whole numbers from 0 to 65,535 for depths from 0 to 1.
    Unorm16,
    /// 24 bits, whole numbers from 0 to 16,777,215 for depths from 0 to 1.
    Unorm24,
    /// 32 bits, floating point.
    #[default]
    Float32,
}

impl DepthFormat {
    /// All of them.
    pub const ALL: [Self; 3] = [Self::Unorm16, Self::Unorm24, Self::Float32];

    /// Bits of a whole number; `None` for floating point.
    pub(crate) const fn bits(self) -> Option<i32> {
        match self {
            Self::Unorm16 => Some(16),
            Self::Unorm24 => Some(24),
            Self::Float32 => None,
        }
    }
}

/// All that a conversion depends on: a light's projection and map, and a receiver in it. Lengths are world units.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub struct Conditions {
    /// True for a spot light's projection, false for parallel light.
    pub perspective: bool,
    /// Near plane, world units along the light's axis; above 0 in perspective.
    pub near: f64,
    /// Far plane, world units along the light's axis; above `near`.
    pub far: f64,
    /// The receiver's distance along the light's axis, from `near` to `far`, both included, and above 0 in perspective.
    pub distance: f64,
    /// Texels of the map from side to side, at least 1: those that the projection covers, without an engine's border.
    pub map_size: u32,
    /// Width of a texel at the receiver's distance, world units; above 0. Times `map_size` it is the width that the map covers there.
    pub texel: f64,
    /// N·L: cosine between the surface's normal and the direction from the receiver to the light, above 0, at most 1.
    pub facing: f64,
    /// Depth change per world unit across the light's rays, from 0: tan θ on the light's axis and for parallel light, [`Receiver::slope`] elsewhere.
    pub slope: f64,
    /// Cosine between the light's axis and the ray to the receiver, above 0, at most 1: 1 on the axis and for parallel light.
    pub ray: f64,
    /// The radius in texels by which URP and Godot multiply their biases; above 0. `None` is what they do by default: 1 in URP,
    /// whose shadows are hard (1.5, 2.5 or 3.5 for soft ones of low, medium or high quality), and 2 in Godot, whose filter is
    /// *Soft Low* (`shadow_blur` times the radius of the quality). No other engine looks at it.
    pub filter_radius: Option<f64>,
    /// How the map keeps depths.
    pub format: DepthFormat,
    /// True where the near plane is depth 1 and the far plane depth 0.
    pub reversed: bool,
    /// True where the map is a depth texture that the hardware compares: Babylon.js with `FILTER_PCF` or `FILTER_PCSS`. Other
    /// engines leave no choice, and do not look at it.
    pub depth_texture: bool,
}

umbrage_plane::builders!([] Conditions {
    with_near near: f64,
    with_far far: f64,
    with_map_size map_size: u32,
    with_texel texel: f64,
    with_facing facing: f64,
    with_slope slope: f64,
    with_ray ray: f64,
    with_filter_radius filter_radius: Option<f64>,
    with_format format: DepthFormat,
    with_reversed reversed: bool,
    with_depth_texture depth_texture: bool,
});

impl Conditions {
    /// Parallel light over a square of `width` world units with `map_size` texels per side. The receiver faces the light;
    /// floating-point depths that grow away from it.
    ///
    /// # Errors
    /// A value that is out of its field's range; `width` is refused as `texel`.
    pub fn orthographic(width: f64, map_size: u32, near: f64, far: f64, distance: f64) -> Result<Self, EngineError> {
        let texel = width / f64::from(map_size);
        Self::at(false, near, far, distance, map_size, texel).checked()
    }

    /// A spot light of `half_angle` radians from its axis to the sides of a square map with `map_size` texels per side. The receiver
    /// is on the axis and faces the light; floating-point depths that grow away from it.
    ///
    /// # Errors
    /// A value that is out of its field's range, and an angle that is not within (0, π/2).
    pub fn perspective(
        half_angle: f64,
        map_size: u32,
        near: f64,
        far: f64,
        distance: f64,
    ) -> Result<Self, EngineError> {
        if !(half_angle > 0.0 && half_angle < std::f64::consts::FRAC_PI_2) {
            return Err(EngineError::Condition {
                field: "half angle",
                value: half_angle,
                needs: "within (0, π/2) radians",
            });
        }
        let texel = 2.0 * half_angle.tan() * distance / f64::from(map_size);
        Self::at(true, near, far, distance, map_size, texel).checked()
    }

    /// A light's own view with a receiver that faces it on its axis. The wider side of a texel counts.
    ///
    /// # Errors
    /// A distance that is not from the view's near plane to its far one.
    pub fn on_axis(view: &View, distance: f64) -> Result<Self, EngineError> {
        let (Projection::Perspective { k: scale, .. } | Projection::Orthographic { half: scale, .. }) =
            view.projection();
        let half = if view.is_perspective() { distance / scale } else { scale };
        let texel = (2.0 * half / view.size().as_dvec2()).max_element();
        Self::at(view.is_perspective(), view.near(), view.far(), distance, view.size().x, texel).checked()
    }

    /// A light's own view with one receiver in it, wherever it is.
    ///
    /// # Errors
    /// A receiver that faces away from the light or is edge-on to it, or is not from the view's near plane to its far one.
    pub fn of(view: &View, receiver: &Receiver) -> Result<Self, EngineError> {
        let mut conditions = Self::on_axis(view, -receiver.eye.z)?;
        let to_light = if view.is_perspective() { -receiver.eye.normalize() } else { glam::DVec3::Z };
        conditions.facing = receiver.normal.dot(to_light).min(1.0);
        conditions.ray = to_light.z;
        conditions.slope = f64::from(receiver.slope);
        conditions.checked()
    }

    /// The same with a surface that is tilted until its N·L is this; its slope is that of a receiver on the light's axis.
    /// A cosine out of range is refused when the conditions are used.
    #[must_use]
    pub fn with_light_at(self, facing: f64) -> Self {
        Self { facing, slope: sine(facing) / facing, ..self }
    }

    /// The width that the map covers at the receiver's distance, world units.
    pub fn extent(&self) -> f64 {
        self.texel * f64::from(self.map_size)
    }

    fn at(perspective: bool, near: f64, far: f64, distance: f64, map_size: u32, texel: f64) -> Self {
        Self {
            perspective,
            near,
            far,
            distance,
            map_size,
            texel,
            facing: 1.0,
            slope: 0.0,
            ray: 1.0,
            filter_radius: None,
            format: DepthFormat::default(),
            reversed: false,
            depth_texture: false,
        }
    }

    fn checked(self) -> Result<Self, EngineError> {
        self.check().map(|()| self)
    }

    /// Refuses what is out of range, in one line that names it.
    pub(crate) fn check(&self) -> Result<(), EngineError> {
        let positive = |value: f64| value.is_finite() && value > 0.0;
        let cosine = |value: f64| value > 0.0 && value <= 1.0;
        let radius = self.filter_radius.unwrap_or(1.0);
        let within = self.distance >= self.near && self.distance <= self.far;
        let rows = [
            ("near", self.near, self.near.is_finite(), "finite"),
            ("near", self.near, !self.perspective || self.near > 0.0, "above 0, as it must be in perspective"),
            ("far", self.far, self.far.is_finite() && self.far > self.near, "finite and above near"),
            ("distance", self.distance, within, "from near to far"),
            ("map size", f64::from(self.map_size), self.map_size > 0, "at least 1 texel"),
            ("texel", self.texel, positive(self.texel), "finite and above 0"),
            ("facing", self.facing, cosine(self.facing), "above 0 and at most 1"),
            ("slope", self.slope, self.slope.is_finite() && self.slope >= 0.0, "finite and from 0"),
            ("ray", self.ray, cosine(self.ray), "above 0 and at most 1"),
            ("filter radius", radius, positive(radius), "finite and above 0"),
        ];
        match rows.into_iter().find(|(_, _, holds, _)| !holds) {
            Some((field, value, _, needs)) => Err(EngineError::Condition { field, value, needs }),
            None => Ok(()),
        }
    }

    /// Sine of the angle between the normal and the direction to the light.
    pub(crate) fn sine(&self) -> f64 {
        sine(self.facing)
    }

    /// Depth at the receiver, from 0 at the near plane to 1 at the far one, or the other way round where it is reversed.
    pub(crate) fn depth(&self) -> f64 {
        let (near, far, distance) = (self.near, self.far, self.distance);
        let scale = if self.perspective { distance } else { 1.0 };
        let (ahead, behind) = if self.perspective { (far, near) } else { (1.0, 1.0) };
        if self.reversed {
            behind * (far - distance) / (scale * (far - near))
        } else {
            ahead * (distance - near) / (scale * (far - near))
        }
    }

    /// How fast depth from 0 to 1 changes with distance at the receiver, per world unit.
    fn depth_rate(&self) -> f64 {
        let range = self.far - self.near;
        if self.perspective { self.near / range * (self.far / self.distance) / self.distance } else { 1.0 / range }
    }

    /// Change of depth from texel to texel on the receiver's plane.
    pub(crate) fn depth_slope(&self) -> f64 {
        self.depth_rate() * self.texel * self.slope
    }

    /// The step of depth that moves the receiver by `world` units toward the light.
    ///
    /// With z = f(ζ − n)/(ζ(f − n)) in perspective, z(ζ) − z(ζ − w) = fn/(f − n) · w/(ζ(ζ − w)): no difference of nearly equal numbers.
    pub(crate) fn depth_step(&self, world: f64) -> Result<f64, EngineError> {
        if !self.perspective {
            return Ok(world * self.depth_rate());
        }
        if world >= self.distance {
            return Err(EngineError::Reaches { constant: world, distance: self.distance });
        }
        Ok(world * self.depth_rate() * (self.distance / (self.distance - world)))
    }

    /// World units along the axis by which a step of depth moves the receiver toward the light: the inverse of
    /// [`Self::depth_step`].
    pub(crate) fn world_step(&self, step: f64) -> Result<f64, EngineError> {
        let linear = step / self.depth_rate();
        if !self.perspective {
            return Ok(linear);
        }
        let shrink = 1.0 + linear / self.distance;
        if shrink <= 0.0 {
            return Err(EngineError::Beyond { step, distance: self.distance });
        }
        Ok(linear / shrink)
    }
}

fn sine(cosine: f64) -> f64 {
    (1.0 - cosine * cosine).max(0.0).sqrt()
}
