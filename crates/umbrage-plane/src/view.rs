use crate::{Kind, Rules, Sampling, ViewError, look_at};
use glam::{DMat3, DMat4, DVec2, DVec3, DVec4, UVec2};

/// How eye space is laid on the map.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Projection {
    /// x_n = k·x/ζ + shift: `k` is the cotangent of half the field of view, per axis.
    Perspective {
        /// cot(fov/2) for x and y.
        k: DVec2,
        /// Where the axis of view meets the screen, x_n and y_n: 0 in its middle, ±1 at its sides.
        shift: DVec2,
    },
    /// x_n = x/half + shift: `half` is half the width and height of the view, in world units.
    Orthographic {
        /// Half width and half height.
        half: DVec2,
        /// Where the axis of view meets the screen, x_n and y_n: 0 in its middle, ±1 at its sides.
        shift: DVec2,
    },
}

impl Projection {
    /// A perspective about its axis: [`Projection::Perspective`] without a shift.
    pub const fn perspective(k: DVec2) -> Self {
        Self::Perspective { k, shift: DVec2::ZERO }
    }

    /// A parallel projection about its axis: [`Projection::Orthographic`] without a shift.
    pub const fn orthographic(half: DVec2) -> Self {
        Self::Orthographic { half, shift: DVec2::ZERO }
    }

    /// Where the axis of view meets the screen, x_n and y_n; zero for a view about its axis.
    #[inline(always)]
    pub const fn shift(self) -> DVec2 {
        let (Self::Perspective { shift, .. } | Self::Orthographic { shift, .. }) = self;
        shift
    }
}

/// An eye or a light: placement, projection, texel grid, and what its map's numbers mean.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct View {
    pub(crate) world_to_eye: DMat4,
    pub(crate) eye_to_world: DMat4,
    pub(crate) projection: Projection,
    pub(crate) near: f64,
    pub(crate) far: f64,
    pub(crate) size: UVec2,
    pub(crate) kind: Kind,
    pub(crate) sampling: Sampling,
    pub(crate) rules: Rules,
    pub(crate) cone: Option<f64>,
}

impl View {
    /// From a rigid `world_to_eye` transform. The kind is that [of its range](Kind::of_range): axial where it is not narrow; sampled at texel centres, [`Rules::OPEN`], no cone.
    ///
    /// # Errors
    /// See [`ViewError`]; nothing is rounded or repaired.
    pub fn new(
        world_to_eye: DMat4,
        projection: Projection,
        near: f64,
        far: f64,
        size: UVec2,
    ) -> Result<Self, ViewError> {
        if !world_to_eye.is_finite() {
            return Err(ViewError::Placement("a matrix entry is not finite"));
        }
        if !is_rigid(world_to_eye) {
            return Err(ViewError::Placement(
                "the matrix is not a rotation and a shift: it scales, shears, mirrors or projects",
            ));
        }
        let (Projection::Perspective { k: scale, shift } | Projection::Orthographic { half: scale, shift }) =
            projection;
        if !(scale.is_finite() && scale.cmpgt(DVec2::ZERO).all()) {
            return Err(ViewError::Scale { x: scale.x, y: scale.y });
        }
        if !shift.is_finite() {
            return Err(ViewError::Shift { x: shift.x, y: shift.y });
        }
        if !near.is_finite() {
            return Err(ViewError::Near(near));
        }
        if !far.is_finite() {
            return Err(ViewError::Far(far));
        }
        if matches!(projection, Projection::Perspective { .. }) && near <= 0.0 {
            return Err(ViewError::NearAtEye(near));
        }
        if near >= far {
            return Err(ViewError::Range { near, far });
        }
        ViewError::of_size(size)?;
        Ok(Self {
            world_to_eye,
            eye_to_world: world_to_eye.inverse(),
            projection,
            near,
            far,
            size,
            kind: Kind::of_range(near, far),
            sampling: Sampling::Centre,
            rules: Rules::OPEN,
            cone: None,
        })
    }

    /// At `eye`, looking at `target`, `up` upward, `fov` radians over the map's height; square texels.
    ///
    /// # Errors
    /// As [`View::new`]; also when `eye`, `target` or `up` is not finite, `eye` equals `target`, `up` is parallel to the
    /// direction of view, or `fov` is not within (0, π), as it is when degrees are given for radians.
    pub fn perspective(
        eye: DVec3,
        target: DVec3,
        up: DVec3,
        fov: f64,
        near: f64,
        far: f64,
        size: UVec2,
    ) -> Result<Self, ViewError> {
        ViewError::of_size(size)?;
        if !(fov > 0.0 && fov < std::f64::consts::PI) {
            return Err(ViewError::FieldOfView { radians: fov });
        }
        let k = 1.0 / (0.5 * fov).tan();
        let aspect = f64::from(size.x) / f64::from(size.y);
        let k = DVec2::new(k / aspect, k);
        Self::new(look_at(eye, target, up)?, Projection::perspective(k), near, far, size)
    }

    /// Parallel rays from `eye` toward `target`; `half_height` in world units; square texels.
    ///
    /// # Errors
    /// As [`View::perspective`]; also when `half_height` is not positive and finite.
    pub fn orthographic(
        eye: DVec3,
        target: DVec3,
        up: DVec3,
        half_height: f64,
        near: f64,
        far: f64,
        size: UVec2,
    ) -> Result<Self, ViewError> {
        ViewError::of_size(size)?;
        if !(half_height.is_finite() && half_height > 0.0) {
            return Err(ViewError::HalfHeight(half_height));
        }
        let aspect = f64::from(size.x) / f64::from(size.y);
        let half = DVec2::new(half_height * aspect, half_height);
        Self::new(look_at(eye, target, up)?, Projection::orthographic(half), near, far, size)
    }

    /// World to eye space; rigid.
    pub fn world_to_eye(&self) -> DMat4 {
        self.world_to_eye
    }
    /// Eye to world space; rigid.
    pub fn eye_to_world(&self) -> DMat4 {
        self.eye_to_world
    }
    /// The projection.
    pub fn projection(&self) -> Projection {
        self.projection
    }
    /// Distance of the near plane, world units.
    pub fn near(&self) -> f64 {
        self.near
    }
    /// Distance of the far plane, world units.
    pub fn far(&self) -> f64 {
        self.far
    }
    /// Columns and rows of the map.
    pub fn size(&self) -> UVec2 {
        self.size
    }
    /// What the map's numbers mean.
    pub fn kind(&self) -> Kind {
        self.kind
    }
    /// Where inside its texels the scene is sampled.
    pub fn sampling(&self) -> Sampling {
        self.sampling
    }
    /// The answers outside the map.
    pub fn rules(&self) -> &Rules {
        &self.rules
    }
    /// Cosine of the half-angle of the cone of light.
    pub fn cone(&self) -> Option<f64> {
        self.cone
    }
    /// True for a perspective view.
    #[inline(always)]
    pub fn is_perspective(&self) -> bool {
        matches!(self.projection, Projection::Perspective { .. })
    }
}

/// A rotation and a shift, to 1e-6.
fn is_rigid(matrix: DMat4) -> bool {
    let rotation = DMat3::from_mat4(matrix);
    (rotation * rotation.transpose()).abs_diff_eq(DMat3::IDENTITY, 1e-6)
        && rotation.determinant() > 0.0
        && matrix.row(3) == DVec4::W
}
