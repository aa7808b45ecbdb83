use crate::{Affine, Decode, Kind, Rules, Sampling, TexelRect, ViewError, Where, look_at};
use glam::{DMat3, DMat4, DVec2, DVec3, DVec4, UVec2, Vec2};

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
            kind: Kind::Axial,
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

    /// The part of the same view that a rectangle of its texels shows, with those texels as its map: what was at a texel
    /// position is now there minus `texels.min`. The rectangle may reach beyond the map, which widens the view.
    ///
    /// Everything is the same to the roundings of f64, so that a depth rounded to f32 rarely differs, and then by one step. Two
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
            // 0 − shift, so that no shift is +0.
            Projection::Perspective { k, shift } => DMat4::from_cols(
                DVec4::new(k.x, 0.0, 0.0, 0.0),
                DVec4::new(0.0, k.y, 0.0, 0.0),
                DVec4::new(0.0 - shift.x, 0.0 - shift.y, -f / (f - n), -1.0),
                DVec4::new(0.0, 0.0, -f * n / (f - n), 0.0),
            ),
            Projection::Orthographic { half, shift } => DMat4::from_cols(
                DVec4::new(1.0 / half.x, 0.0, 0.0, 0.0),
                DVec4::new(0.0, 1.0 / half.y, 0.0, 0.0),
                DVec4::new(0.0, 0.0, -1.0 / (f - n), 0.0),
                DVec4::new(shift.x, shift.y, -n / (f - n), 1.0),
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
            Projection::Perspective { k, shift } => k * eye.truncate() / -eye.z + shift,
            Projection::Orthographic { half, shift } => eye.truncate() / half + shift,
        };
        self.screen_to_texel(screen)
    }

    /// Screen x_n, y_n of a texel position, measured from where the axis of view meets the screen.
    #[inline(always)]
    fn off_axis(&self, texel: DVec2) -> DVec2 {
        DVec2::new(2.0, -2.0) * texel / self.size.as_dvec2() + DVec2::new(-1.0, 1.0) - self.projection.shift()
    }

    /// The world point that a texel position shows at a key ([`View::key`]).
    #[inline(always)]
    pub fn world_at(&self, texel: DVec2, key: f64) -> DVec3 {
        let screen = self.off_axis(texel);
        let zeta = self.decode().zeta_of(key);
        let eye = match self.projection {
            Projection::Perspective { k, .. } => (screen / k).extend(-1.0) * zeta,
            Projection::Orthographic { half, .. } => (screen * half).extend(-zeta),
        };
        self.eye_to_world.transform_point3(eye)
    }

    /// The ray through a texel position: its origin and unit direction in the world. In perspective it starts at the eye, so
    /// that distances along it are radial; in an orthographic view it starts on the near plane and goes straight ahead, so
    /// that a distance along it plus [`View::near`] is axial. Any finite position has a ray, outside the map too.
    pub fn ray(&self, texel: DVec2) -> (DVec3, DVec3) {
        let screen = self.off_axis(texel);
        match self.projection {
            Projection::Perspective { k, .. } => {
                let direction = self.eye_to_world.transform_vector3((screen / k).extend(-1.0));
                (self.eye_to_world.w_axis.truncate(), direction.normalize())
            }
            Projection::Orthographic { half, .. } => {
                let origin = self.eye_to_world.transform_point3((screen * half).extend(-self.near));
                (origin, self.ahead().normalize())
            }
        }
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
            Projection::Perspective { k, shift } => {
                // −1/ζ = (n_x X + n_y Y − n_z) / −through, with the ray tangents X, Y affine in texels.
                let scale = -1.0 / through;
                let (nx, ny) = (eye_normal.x / k.x, eye_normal.y / k.y);
                Affine {
                    c: (ny * (1.0 - shift.y) - nx * (1.0 + shift.x) - eye_normal.z) * scale,
                    dx: 2.0 / size.x * nx * scale,
                    dy: -2.0 / size.y * ny * scale,
                }
            }
            Projection::Orthographic { half, shift } => {
                let scale = 1.0 / eye_normal.z;
                let (nx, ny) = (eye_normal.x * half.x, eye_normal.y * half.y);
                Affine {
                    c: (ny * (1.0 - shift.y) - nx * (1.0 + shift.x) - through) * scale,
                    dx: 2.0 / size.x * nx * scale,
                    dy: -2.0 / size.y * ny * scale,
                }
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
            Projection::Perspective { k, shift } => {
                ((DVec2::new(-1.0, 1.0) - shift) / k, DVec2::new(2.0, -2.0) / self.size.as_dvec2() / k)
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
            Projection::Perspective { k, .. } => 2.0 * zeta / (k * size),
            Projection::Orthographic { half, .. } => 2.0 * half / size,
        }
    }

    /// Where a texel position lies, as far as the rectangle and the cone can tell.
    #[inline(always)]
    pub fn locate(&self, texel: Vec2) -> Where {
        let size = self.size.as_vec2();
        if !(texel.x >= 0.0 && texel.y >= 0.0 && texel.x < size.x && texel.y < size.y) {
            return Where::Outside;
        }
        if let (Some(cone), Projection::Perspective { k, .. }) = (self.cone, self.projection)
            && (self.off_axis(texel.as_dvec2()) / k).length_squared() > cone * cone
        {
            return Where::BeyondCone;
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
