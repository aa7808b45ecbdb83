use crate::{Affine, Decode, Kind, Rules, Sampling, Where};
use glam::{DMat3, DMat4, DVec2, DVec3, DVec4, UVec2, Vec2};

/// How eye space is laid on the map.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Projection {
    /// x_n = k·x/ζ: `k` is the cotangent of half the field of view, per axis.
    Perspective {
        /// cot(fov/2) for x and y.
        k: DVec2,
    },
    /// x_n = x/half: `half` is half the width and height of the view, in world units.
    Orthographic {
        /// Half width and half height.
        half: DVec2,
    },
}

/// Why a view cannot be made.
#[derive(Clone, Copy, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum ViewError {
    /// A number of the placement is NaN or infinite, or the directions do not span a frame.
    #[error("view placement is degenerate: {0}")]
    Placement(&'static str),
    /// The field of view or width is not positive and finite, or an angle is not below 180°.
    #[error("view projection scale ({x}, {y}) is not positive and finite")]
    Scale {
        /// Scale in x.
        x: f64,
        /// Scale in y.
        y: f64,
    },
    /// Not near < far, both finite, near > 0 in perspective.
    #[error("view range near = {near}, far = {far} is not usable (near < far, both finite, near > 0 in perspective)")]
    Range {
        /// Near distance.
        near: f64,
        /// Far distance.
        far: f64,
    },
    /// A cone of light whose tangent is not positive and finite.
    #[error("view cone tangent {0} is not positive and finite")]
    Cone(f64),
    /// A map side of 0 or more than 32,768 texels.
    #[error("view size {width} x {height} is not within 1..=32768 texels")]
    Size {
        /// Columns.
        width: u32,
        /// Rows.
        height: u32,
    },
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
    /// From a rigid `world_to_eye` transform. Kind [`Kind::Axial`], sampled at texel centres, [`Rules::OPEN`], no cone.
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
                "the matrix is no rotation and shift: it scales, shears, mirrors or projects",
            ));
        }
        let (Projection::Perspective { k: scale } | Projection::Orthographic { half: scale }) = projection;
        if !(scale.is_finite() && scale.cmpgt(DVec2::ZERO).all()) {
            return Err(ViewError::Scale { x: scale.x, y: scale.y });
        }
        let perspective = matches!(projection, Projection::Perspective { .. });
        if !(near.is_finite() && far.is_finite() && near < far) || (perspective && near <= 0.0) {
            return Err(ViewError::Range { near, far });
        }
        if size.min_element() == 0 || size.max_element() > 32_768 {
            return Err(ViewError::Size { width: size.x, height: size.y });
        }
        Ok(Self {
            world_to_eye,
            eye_to_world: world_to_eye.inverse(),
            projection,
            near,
            far,
            size,
            kind: Kind::Axial,
            sampling: Sampling::Centre,
            rules: Rules::OPEN,
            cone: None,
        })
    }

    /// At `eye`, looking at `target`, `up` upward, `fov` radians over the map's height; square texels.
    ///
    /// # Errors
    /// As [`View::new`]; also when `eye` equals `target` or `up` is parallel to the direction of view.
    pub fn perspective(
        eye: DVec3,
        target: DVec3,
        up: DVec3,
        fov: f64,
        near: f64,
        far: f64,
        size: UVec2,
    ) -> Result<Self, ViewError> {
        let k = 1.0 / (0.5 * fov).tan();
        let aspect = f64::from(size.x) / f64::from(size.y.max(1));
        let k = if fov < std::f64::consts::PI { DVec2::new(k / aspect, k) } else { DVec2::splat(f64::NAN) };
        Self::new(look_at(eye, target, up)?, Projection::Perspective { k }, near, far, size)
    }

    /// Parallel rays from `eye` toward `target`; `half_height` in world units; square texels.
    ///
    /// # Errors
    /// As [`View::perspective`].
    pub fn orthographic(
        eye: DVec3,
        target: DVec3,
        up: DVec3,
        half_height: f64,
        near: f64,
        far: f64,
        size: UVec2,
    ) -> Result<Self, ViewError> {
        let aspect = f64::from(size.x) / f64::from(size.y.max(1));
        let half = DVec2::new(half_height * aspect, half_height);
        Self::new(look_at(eye, target, up)?, Projection::Orthographic { half }, near, far, size)
    }

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

    /// The same view with a cone of light: `tan_half` is the tangent of its half-angle. Meaningless, and ignored, in an orthographic view.
    ///
    /// # Errors
    /// [`ViewError::Cone`] unless the tangent is positive and finite.
    pub fn with_cone(mut self, tan_half: Option<f64>) -> Result<Self, ViewError> {
        if let Some(tan_half) = tan_half.filter(|tan_half| !(tan_half.is_finite() && *tan_half > 0.0)) {
            return Err(ViewError::Cone(tan_half));
        }
        self.cone = tan_half;
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
            return Err(ViewError::Placement("a scale must be positive and finite"));
        }
        let mut world_to_eye = self.world_to_eye;
        world_to_eye.w_axis = (world_to_eye.w_axis.truncate() * factor).extend(1.0);
        let projection = match self.projection {
            Projection::Perspective { k } => Projection::Perspective { k },
            Projection::Orthographic { half } => Projection::Orthographic { half: half * factor },
        };
        let (near, far) = (self.near * factor, self.far * factor);
        Self::new(world_to_eye, projection, near, far, self.size).map(|view| view.alike(&self))
    }

    /// With everything of another view that [`View::new`] does not ask for.
    fn alike(self, other: &Self) -> Self {
        Self { kind: other.kind, sampling: other.sampling, rules: other.rules, cone: other.cone, ..self }
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
    /// Tangent of the half-angle of the cone of light.
    pub fn cone(&self) -> Option<f64> {
        self.cone
    }
    /// True for a perspective view.
    #[inline(always)]
    pub fn is_perspective(&self) -> bool {
        matches!(self.projection, Projection::Perspective { .. })
    }

    /// The eye's place in the world (perspective), as a homogeneous point; a direction toward the light with w = 0 (orthographic).
    pub fn light(&self) -> DVec4 {
        if self.is_perspective() { self.eye_to_world.w_axis } else { self.eye_to_world.z_axis.normalize() }
    }

    /// Unit direction of view, in the world.
    pub fn ahead(&self) -> DVec3 {
        -self.eye_to_world.z_axis.truncate()
    }

    /// Unit vector from a world point toward the eye.
    pub fn toward_eye(&self, world: DVec3) -> DVec3 {
        let light = self.light();
        (light.truncate() - world * light.w).normalize_or_zero()
    }

    /// World space to (x_n, y_n, z_s): spec C-2's matrix, whatever the kind.
    pub fn world_to_screen(&self) -> DMat4 {
        self.eye_to_screen() * self.world_to_eye
    }

    /// Eye space to (x_n, y_n, z_s): the projection alone of [`View::world_to_screen`].
    pub fn eye_to_screen(&self) -> DMat4 {
        let (n, f) = (self.near, self.far);
        match self.projection {
            Projection::Perspective { k } => DMat4::from_cols(
                DVec4::new(k.x, 0.0, 0.0, 0.0),
                DVec4::new(0.0, k.y, 0.0, 0.0),
                DVec4::new(0.0, 0.0, -f / (f - n), -1.0),
                DVec4::new(0.0, 0.0, -f * n / (f - n), 0.0),
            ),
            Projection::Orthographic { half } => DMat4::from_cols(
                DVec4::new(1.0 / half.x, 0.0, 0.0, 0.0),
                DVec4::new(0.0, 1.0 / half.y, 0.0, 0.0),
                DVec4::new(0.0, 0.0, -1.0 / (f - n), 0.0),
                DVec4::new(0.0, 0.0, -n / (f - n), 1.0),
            ),
        }
    }

    /// Screen x_n, y_n (−1..1, y up) to texel space.
    #[inline(always)]
    pub fn screen_to_texel(&self, screen: DVec2) -> DVec2 {
        DVec2::new((screen.x + 1.0) * 0.5, (1.0 - screen.y) * 0.5) * self.size.as_dvec2()
    }

    /// A point of eye space in texel space. In perspective ζ must be positive; at ζ ≤ 0 the result means nothing.
    #[inline(always)]
    pub fn eye_to_texel(&self, eye: DVec3) -> DVec2 {
        let screen = match self.projection {
            Projection::Perspective { k } => k * eye.truncate() / -eye.z,
            Projection::Orthographic { half } => eye.truncate() / half,
        };
        self.screen_to_texel(screen)
    }

    /// The world point that a texel position shows at a key ([`View::key`]).
    #[inline(always)]
    pub fn world_at(&self, texel: DVec2, key: f64) -> DVec3 {
        let screen = DVec2::new(2.0, -2.0) * texel / self.size.as_dvec2() + DVec2::new(-1.0, 1.0);
        let zeta = self.decode().zeta_of(key);
        let eye = match self.projection {
            Projection::Perspective { k } => (screen / k).extend(-1.0) * zeta,
            Projection::Orthographic { half } => (screen * half).extend(-zeta),
        };
        self.eye_to_world.transform_point3(eye)
    }

    /// A direction of this view's eye space in the world: for normals that are given in a camera's space (WM94-8). Normals of an object's own
    /// space go through the inverse transpose of its placement.
    pub fn direction_to_world(&self, eye: DVec3) -> DVec3 {
        self.eye_to_world.transform_vector3(eye)
    }

    /// The key of an axial distance: −1/ζ in perspective, ζ in an orthographic view; z_s in a view of [`Kind::Screen`], so that
    /// the integer depths of Williams are exact however far the narrow range between near and far is.
    #[inline(always)]
    pub fn key(&self, zeta: f64) -> f64 {
        match self.kind {
            Kind::Screen => self.decode().screen(zeta),
            Kind::Axial | Kind::Radial => {
                if self.is_perspective() {
                    -1.0 / zeta
                } else {
                    zeta
                }
            }
        }
    }

    /// The plane through `eye_point` with `eye_normal` (need not be unit) as a key over texels; `None` when it is edge-on to the light, so that no key exists (spec D-1, D-3).
    pub fn affine(&self, eye_point: DVec3, eye_normal: DVec3) -> Option<Affine> {
        let size = self.size.as_dvec2();
        let through = eye_normal.dot(eye_point);
        let plane = match self.projection {
            Projection::Perspective { k } => {
                // −1/ζ = (n_x X + n_y Y − n_z) / −through, with the ray tangents X, Y affine in texels.
                let scale = -1.0 / through;
                let (nx, ny) = (eye_normal.x / k.x, eye_normal.y / k.y);
                Affine {
                    c: (ny - nx - eye_normal.z) * scale,
                    dx: 2.0 / size.x * nx * scale,
                    dy: -2.0 / size.y * ny * scale,
                }
            }
            Projection::Orthographic { half } => {
                let scale = 1.0 / eye_normal.z;
                let (nx, ny) = (eye_normal.x * half.x, eye_normal.y * half.y);
                Affine { c: (ny - nx - through) * scale, dx: 2.0 / size.x * nx * scale, dy: -2.0 / size.y * ny * scale }
            }
        };
        let plane = if self.kind == Kind::Screen { self.screen_plane(plane) } else { plane };
        (plane.c.is_finite() && plane.dx.is_finite() && plane.dy.is_finite()).then_some(plane)
    }

    /// z_s of a plane of −1/ζ or ζ: both are affine in it.
    #[inline(always)]
    fn screen_plane(&self, plane: Affine) -> Affine {
        let (n, f) = (self.near, self.far);
        if self.is_perspective() {
            let scale = f * n / (f - n);
            Affine { c: f / (f - n) + plane.c * scale, dx: plane.dx * scale, dy: plane.dy * scale }
        } else {
            let scale = 1.0 / (f - n);
            Affine { c: (plane.c - n) * scale, dx: plane.dx * scale, dy: plane.dy * scale }
        }
    }

    /// How this view's keys become stored depths.
    #[inline(always)]
    pub fn decode(&self) -> Decode {
        let (tangent0, tangent_step) = match self.projection {
            Projection::Perspective { k } => {
                (DVec2::new(-1.0, 1.0) / k, DVec2::new(2.0, -2.0) / self.size.as_dvec2() / k)
            }
            Projection::Orthographic { .. } => (DVec2::ZERO, DVec2::ZERO),
        };
        Decode {
            kind: self.kind,
            perspective: self.is_perspective(),
            near: self.near,
            far: self.far,
            tangent0,
            tangent_step,
        }
    }

    /// The stored depth of a point of eye space, rounded once.
    #[inline(always)]
    pub fn depth(&self, eye: DVec3) -> f32 {
        let zeta = -eye.z;
        match self.kind {
            Kind::Axial => zeta as f32,
            Kind::Screen => self.decode().screen(zeta) as f32,
            Kind::Radial => {
                if self.is_perspective() {
                    eye.length() as f32
                } else {
                    zeta as f32
                }
            }
        }
    }

    /// Width and height of a texel at axial distance `zeta`, in world units (spec D-9's τ).
    #[inline(always)]
    pub fn texel_world(&self, zeta: f64) -> DVec2 {
        let size = self.size.as_dvec2();
        match self.projection {
            Projection::Perspective { k } => 2.0 * zeta / (k * size),
            Projection::Orthographic { half } => 2.0 * half / size,
        }
    }

    /// Where a texel position lies, as far as the rectangle and the cone can tell.
    #[inline(always)]
    pub fn locate(&self, texel: Vec2) -> Where {
        let size = self.size.as_vec2();
        if !(texel.x >= 0.0 && texel.y >= 0.0 && texel.x < size.x && texel.y < size.y) {
            return Where::Outside;
        }
        if let (Some(cone), Projection::Perspective { k }) = (self.cone, self.projection) {
            let screen = DVec2::new(2.0, -2.0) * texel.as_dvec2() / self.size.as_dvec2() + DVec2::new(-1.0, 1.0);
            if (screen / k).length_squared() > cone * cone {
                return Where::BeyondCone;
            }
        }
        Where::Inside
    }

    /// True when every position of the box `centre ± half` (texels) lies inside the rectangle and the cone.
    #[inline(always)]
    pub fn holds(&self, centre: Vec2, half: Vec2) -> bool {
        let inside = |x: f32, y: f32| self.locate(centre + half * Vec2::new(x, y)) == Where::Inside;
        inside(-1.0, -1.0) && inside(1.0, -1.0) && inside(-1.0, 1.0) && inside(1.0, 1.0)
    }
}

/// A rotation and a shift, to 1e-6.
fn is_rigid(matrix: DMat4) -> bool {
    let rotation = DMat3::from_mat4(matrix);
    (rotation * rotation.transpose()).abs_diff_eq(DMat3::IDENTITY, 1e-6)
        && rotation.determinant() > 0.0
        && matrix.row(3) == DVec4::W
}

fn look_at(eye: DVec3, target: DVec3, up: DVec3) -> Result<DMat4, ViewError> {
    let forward = (target - eye).try_normalize().ok_or(ViewError::Placement("eye and target coincide"))?;
    let right =
        forward.cross(up).try_normalize().ok_or(ViewError::Placement("up is parallel to the direction of view"))?;
    let up = right.cross(forward);
    let axes = DMat4::from_cols(right.extend(0.0), up.extend(0.0), (-forward).extend(0.0), DVec4::W);
    Ok(axes.transpose() * DMat4::from_translation(-eye))
}
