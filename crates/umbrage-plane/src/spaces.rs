//! From world and eye space to a map's texels and depths, and back.

use crate::{Affine, Decode, Kind, Place, Projection, View};
use glam::{DMat4, DVec2, DVec3, DVec4, Vec2};

impl View {
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

    /// World space to (x_n, y_n, z_s): the matrix of screen depth, whatever the map's kind.
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

    /// A direction of this view's eye space in the world: for normals that are given in a camera's space (Wang & Molnar 1994). Normals of an object's own
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

    /// The plane through `eye_point` with `eye_normal` (need not be unit) as a key over texels; `None` when it is edge-on to the light, so that no key exists.
    #[inline(always)]
    pub fn affine(&self, eye_point: DVec3, eye_normal: DVec3) -> Option<Affine> {
        let plane = self.plane(eye_point, eye_normal);
        (plane.c.is_finite() && plane.dx.is_finite() && plane.dy.is_finite()).then_some(plane)
    }

    /// [`View::affine`] of any plane: of one that is edge-on to the light, it has a component that is not finite.
    #[inline(always)]
    pub fn plane(&self, eye_point: DVec3, eye_normal: DVec3) -> Affine {
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
        if self.kind == Kind::Screen { self.screen_plane(plane) } else { plane }
    }

    /// The plane over this view's texels of a plane over another's that stands at the same place, both in perspective and of a kind whose keys
    /// are −1/ζ; `None` when it is edge-on to the light.
    pub fn affine_of(&self, other: &Self, plane: &Affine) -> Option<Affine> {
        let Projection::Perspective { k, shift } = other.projection else { return None };
        // The normal whose product with every point of the plane is −1, by the formulas of `affine` backward.
        let (nx, ny) = (0.5 * plane.dx * f64::from(other.size.x), -0.5 * plane.dy * f64::from(other.size.y));
        let nz = ny * (1.0 - shift.y) - nx * (1.0 + shift.x) - plane.c;
        let there = DVec3::new(nx * k.x, ny * k.y, nz);
        let normal = self.world_to_eye.transform_vector3(other.eye_to_world.transform_vector3(there));
        self.affine(-normal / normal.length_squared(), normal)
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

    /// Width and height of a texel at axial distance `zeta`, in world units.
    #[inline(always)]
    pub fn texel_world(&self, zeta: f64) -> DVec2 {
        let size = self.size.as_dvec2();
        match self.projection {
            Projection::Perspective { k, .. } => 2.0 * zeta / (k * size),
            Projection::Orthographic { half, .. } => 2.0 * half / size,
        }
    }

    /// How much a key ([`View::key`]) changes over the width of a texel along the axis of view: √(width · height) of a texel at a key's
    /// distance, as a difference of keys there. +∞ for a key of +∞, and beyond the horizon.
    #[inline(always)]
    pub fn key_width(&self, key: f64) -> f64 {
        let zeta = self.decode().zeta_of(key);
        if key == f64::INFINITY || (self.is_perspective() && (zeta.is_nan() || zeta <= 0.0)) {
            return f64::INFINITY;
        }
        let texel = self.texel_world(zeta);
        (texel.x * texel.y).sqrt() * self.key_per_world(zeta)
    }

    /// Change of the key per world unit along the axis, at an axial distance.
    #[inline(always)]
    pub fn key_per_world(&self, zeta: f64) -> f64 {
        let perspective = if self.is_perspective() { 1.0 / (zeta * zeta) } else { 1.0 };
        match (self.kind, self.is_perspective()) {
            (Kind::Screen, true) => perspective * (self.far * self.near / (self.far - self.near)),
            (Kind::Screen, false) => 1.0 / (self.far - self.near),
            (Kind::Axial | Kind::Radial, _) => perspective,
        }
    }

    /// Where a texel position lies, as far as the rectangle and the cone can tell.
    #[inline(always)]
    pub fn locate(&self, texel: Vec2) -> Place {
        let size = self.size.as_vec2();
        if !(texel.x >= 0.0 && texel.y >= 0.0 && texel.x < size.x && texel.y < size.y) {
            return Place::Outside;
        }
        if let (Some(cos_half), Projection::Perspective { k, .. }) = (self.cone, self.projection)
            && (1.0 + (self.off_axis(texel.as_dvec2()) / k).length_squared()) * (cos_half * cos_half) > 1.0
        {
            return Place::BeyondCone;
        }
        Place::Inside
    }

    /// True when every position of the box `centre ± half` (texels) lies inside the rectangle and the cone.
    #[inline(always)]
    pub fn holds(&self, centre: Vec2, half: Vec2) -> bool {
        let inside = |x: f32, y: f32| self.locate(centre + half * Vec2::new(x, y)) == Place::Inside;
        inside(-1.0, -1.0) && inside(1.0, -1.0) && inside(-1.0, 1.0) && inside(1.0, 1.0)
    }
}
