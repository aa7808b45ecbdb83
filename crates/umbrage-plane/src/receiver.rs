use crate::{Affine, Cells, DepthPlane, Footprint, Kind, Place, Projection, Verdict, View};
use glam::{DVec2, DVec3, Vec2, Vec3};

/// A region of surface to be shaded, in world space.
///
/// Its place is f64, so that it is as exact far from the world's origin as near it; its extent is small, and kept as f32
/// offsets from there.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SurfacePoint {
    /// Its centre, in world space.
    pub position: DVec3,
    /// Geometric unit normal, on the side that is looked at.
    pub normal: Vec3,
    /// From `position` to the region's four corners on the tangent plane, in order around it, world units; all zero for a
    /// point.
    pub corner_offsets: [Vec3; 4],
    /// Which part of the region is the surface. Its `position` is where they have their centroid, and the corners are those of the whole region moved there: what
    /// looks at the whole region has it about what it stands for.
    pub cells: Cells,
    /// Names the region within its picture: random numbers are keyed by it.
    pub region: u32,
    /// Id of the object.
    pub object: u32,
}

impl SurfacePoint {
    /// A point without extent, region 0, object 0. `position` may be a [`Vec3`] or a [`DVec3`].
    pub fn at(position: impl Into<DVec3>, normal: Vec3) -> Self {
        Self {
            position: position.into(),
            normal,
            corner_offsets: [Vec3::ZERO; 4],
            cells: Cells::ALL,
            region: 0,
            object: 0,
        }
    }

    /// The same point with the extent of four corners in world space, in order around it. They may be [`Vec3`]s or
    /// [`DVec3`]s; their offsets are rounded to f32 once.
    #[must_use]
    pub fn with_corners(self, corners: [impl Into<DVec3>; 4]) -> Self {
        Self { corner_offsets: corners.map(|corner| (corner.into() - self.position).as_vec3()), ..self }
    }

    /// The region's four corners in world space, in order around it; all equal to the position for a point.
    pub fn corners(&self) -> [DVec3; 4] {
        self.corner_offsets.map(|offset| self.position + offset.as_dvec3())
    }
}

/// How far a receiver is moved toward the light before it is compared. The unit is part of the type.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Bias {
    /// World units along the light's axis (along the ray in a radial map). Reeves 1987.
    World(f32),
    /// Widths of a texel at the receiver: τ, the larger of both axes, in world units.
    Texels(f32),
    /// Depth steps of the receiver's own plane from texel to texel: τ·tanθ. ½ along each axis is free of acne for point look-ups.
    Steps(f32),
    /// Fractions of the way from the near plane to the far one, as screen depth z_s measures it: the very numbers that a map of
    /// [`Kind::Screen`] stores, quanta times the quantum for integer depth (Williams 1978). Over a map of another kind it is the same
    /// step in space.
    Map(f32),
}

impl Bias {
    /// None at all.
    pub const ZERO: Self = Self::World(0.0);

    /// Whether it depends on a receiver's [slope](Receiver::slope).
    #[inline(always)]
    pub const fn asks_tilt(self) -> bool {
        matches!(self, Self::Steps(_))
    }
}

/// A surface point as a light sees it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Receiver {
    /// What its depth means; it must not be compared with depths of another kind.
    pub kind: Kind,
    /// The region's image in the map.
    pub footprint: Footprint,
    /// Where the point itself lies in the map, texels. The footprint's box lies around it but its centre is elsewhere: the
    /// image of a region's centre is not the centre of its image in perspective.
    pub texel: DVec2,
    /// Half-axes of the footprint, texels: along the region's first edge (from its first corner to its second) and along its
    /// second edge, each the mean of two opposite edges. Zero for a point.
    pub axes: [Vec2; 2],
    /// Which part of the parallelogram of the axes is the surface; the point is at their centroid.
    pub cells: Cells,
    /// Depth at the region's centre, in the map's kind.
    pub depth: f32,
    /// Width and height of a texel at this depth, in world units.
    pub texel_world: Vec2,
    /// Cosine between normal and the direction to the light; ≤ 0 facing away. NaN may stand where it [was not asked for](View::receivers_for).
    pub facing: f32,
    /// Depth change per world unit across the light's rays: tanθ on the axis, the effective slope σ elsewhere. +∞ edge-on.
    /// NaN may stand where it [was not asked for](View::receivers_for).
    pub slope: f32,
    /// Id of the object.
    pub object: u32,
    /// The centre in the light's eye space, in world units.
    pub eye: DVec3,
    /// The unit normal in the light's eye space.
    pub normal: DVec3,
}

impl Receiver {
    /// The tangent plane as a depth over texels. Where it is edge-on to the light, the receiver's own depth everywhere.
    #[inline(always)]
    pub fn plane(&self, view: &View) -> DepthPlane {
        let key = view.affine(self.eye, self.normal).unwrap_or_else(|| Affine::constant(view.key(-self.eye.z)));
        DepthPlane { key, decode: view.decode() }
    }

    /// The depth to compare: this receiver's, moved toward the light by `bias`. The only place where a [`Bias`] is applied.
    ///
    /// A world bias is exact in every kind of map.
    #[inline(always)]
    pub fn nearer(&self, view: &View, bias: Bias) -> f32 {
        match bias {
            Bias::Map(amount) if self.kind == Kind::Screen || amount.is_infinite() => self.depth - amount,
            bias => self.toward_light(view, self.in_world(view, bias)),
        }
    }

    /// How far `bias` moves this receiver toward the light, world units along the light's axis (along the ray in a radial map).
    #[inline(always)]
    pub fn in_world(&self, view: &View, bias: Bias) -> f32 {
        match bias {
            Bias::Map(amount) if amount.is_infinite() => amount,
            Bias::Map(amount) => self.screen_step(view, amount),
            Bias::World(amount) => amount,
            Bias::Texels(amount) => amount * self.texel_world.max_element(),
            Bias::Steps(amount) => scaled(amount, self.texel_world.max_element() * self.slope),
        }
    }

    /// `amount` times the change of the plane's axial depth from a texel to the next of its row or its column, whichever is larger: the slope by which
    /// rasterisers scale a bias, in world units. On a surface that rises along a row or a column it is [`Bias::Steps`] of the same amount, along
    /// the map's diagonal as little as 0.71 of that. Edge-on no finite step exists: +∞, or 0 for an `amount` of 0.
    #[inline(always)]
    pub fn steeper_steps(&self, view: &View, amount: f32) -> f32 {
        let ray = if view.is_perspective() { self.eye / self.eye.z } else { DVec3::Z };
        let along = self.normal.dot(ray).abs();
        let rise = (self.normal.truncate().abs() * self.texel_world.as_dvec2()).max_element();
        let step = rise / along;
        scaled(amount, if step.is_nan() { f32::INFINITY } else { step as f32 })
    }

    /// This receiver moved by `along` world units along its normal, to the side that the light is on (negative: to the other side), so that it is looked up at
    /// another place and another depth. What belongs to the surface stays: its slope, its cosine, and the extent of its footprint.
    /// `None` where that leads behind the light, or nowhere.
    #[inline(always)]
    pub fn offset(&self, view: &View, along: f64) -> Option<Self> {
        let outward = if self.facing < 0.0 { -along } else { along };
        let eye = self.eye + self.normal * outward;
        let in_front = if view.is_perspective() { -eye.z > 0.0 } else { eye.is_finite() };
        if !in_front {
            return None;
        }
        let texel = view.eye_to_texel(eye);
        let shift = (texel - self.texel).as_vec2();
        let Footprint { centre, half, corners } = self.footprint;
        let footprint = Footprint { centre: centre + shift, half, corners: corners.map(|corner| corner + shift) };
        let texel_world = view.texel_world(-eye.z).as_vec2();
        Some(Self { footprint, texel, depth: view.depth(eye), texel_world, eye, ..*self })
    }

    /// A step of screen depth toward the light in world units: along the axis, or along the ray in a radial map.
    #[inline(always)]
    fn screen_step(&self, view: &View, amount: f32) -> f32 {
        let (near, far, zeta) = (view.near(), view.far(), -self.eye.z);
        if !view.is_perspective() {
            return (f64::from(amount) * (far - near)) as f32;
        }
        // Beyond a screen depth of f/(f − n), which infinity has, nothing is.
        let inverse = (1.0 / zeta + f64::from(amount) * (far - near) / (far * near)).max(0.0);
        let along = if self.kind == Kind::Radial { f64::from(self.depth) / zeta } else { 1.0 };
        ((zeta - 1.0 / inverse) * along) as f32
    }

    /// The depth after a step of `world` units toward the light.
    #[inline(always)]
    fn toward_light(&self, view: &View, world: f32) -> f32 {
        if world == 0.0 {
            return self.depth;
        }
        if view.kind() == Kind::Screen {
            let zeta = -self.eye.z - f64::from(world);
            if view.is_perspective() && zeta <= 0.0 { f32::NEG_INFINITY } else { view.decode().screen(zeta) as f32 }
        } else {
            self.depth - world
        }
    }
}

/// So many steps. Edge-on, where no finite step exists, none at all is still none.
#[inline(always)]
fn scaled(amount: f32, step: f32) -> f32 {
    if step.is_finite() {
        amount * step
    } else if amount > 0.0 {
        f32::INFINITY
    } else {
        0.0
    }
}

impl View {
    /// A surface point as this light sees it: the exact projection of its corners, its depth, slope and facing.
    ///
    /// Corners behind the light are cut off at a sixteenth of the centre's distance; half-extents are capped at a quarter of the map.
    ///
    /// # Errors
    /// The place, when that alone settles the answer by this view's [`Rules`](crate::Rules): behind the light, or nearer or farther than the range under rules that do not compare there.
    #[inline(always)]
    pub fn receiver(&self, at: &SurfacePoint) -> Result<Receiver, Place> {
        let eye = self.world_to_eye.transform_point3(at.position);
        let zeta = -eye.z;
        self.reached(zeta)?;
        let normal = self.world_to_eye.transform_vector3(at.normal.as_dvec3());
        let (toward, slope) = match self.projection {
            Projection::Perspective { .. } => {
                let ray = -eye / zeta;
                (ray.normalize(), normal.truncate().length() / normal.dot(ray).abs())
            }
            Projection::Orthographic { .. } => (DVec3::Z, normal.truncate().length() / normal.z.abs()),
        };
        let texel = self.eye_to_texel(eye);
        let footprint = self.footprint(at, eye, texel.as_vec2());
        Ok(Receiver {
            kind: self.kind,
            footprint,
            texel,
            axes: footprint.axes(),
            cells: at.cells,
            depth: self.depth(eye),
            texel_world: self.texel_world(zeta).as_vec2(),
            facing: normal.dot(toward) as f32,
            slope: if slope.is_nan() { f32::INFINITY } else { slope as f32 },
            object: at.object,
            eye,
            normal,
        })
    }

    /// The place at an axial distance, when that alone settles the answer.
    #[inline(always)]
    pub(crate) fn reached(&self, zeta: f64) -> Result<(), Place> {
        if self.is_perspective() && (zeta <= 0.0 || zeta.is_nan()) {
            return Err(Place::Behind);
        }
        if zeta < self.near && self.rules.near != Verdict::Compare {
            return Err(Place::Near);
        }
        if zeta > self.far && self.rules.far != Verdict::Compare {
            return Err(Place::Far);
        }
        Ok(())
    }

    #[inline(always)]
    pub(crate) fn footprint(&self, at: &SurfacePoint, eye: DVec3, centre: Vec2) -> Footprint {
        let [first, second, third, _] = at.corner_offsets;
        if second == first && third == first {
            return Footprint::point(centre);
        }
        let nearest = -eye.z * (1.0 / 16.0);
        let corners = at.corner_offsets.map(|offset| eye + self.world_to_eye.transform_vector3(offset.as_dvec3()));
        let clipped = corners.map(|corner| {
            let zeta = -corner.z;
            if self.is_perspective() && (zeta < nearest || zeta.is_nan()) {
                // Back along the line to the centre until it is in front of the light.
                let t = (-eye.z - nearest) / (-eye.z - zeta);
                self.eye_to_texel(eye + (corner - eye) * t)
            } else {
                self.eye_to_texel(corner)
            }
            .as_vec2()
        });
        self.capped(clipped, centre)
    }

    /// The footprint of four corners about the image of their region's centre, at most a quarter of the map to each side.
    #[inline(always)]
    fn capped(&self, corners: [Vec2; 4], centre: Vec2) -> Footprint {
        let whole = Footprint::around(corners);
        let most = self.size.as_vec2() * 0.25;
        if whole.half.cmple(most).all() {
            return whole;
        }
        // A box that is cut to size must still lie around the point that is looked up.
        let capped = whole.scaled(whole.centre, 1.0, 0.0, most);
        let shift = centre.clamp(whole.centre - whole.half + capped.half, whole.centre + whole.half - capped.half)
            - whole.centre;
        Footprint { centre: capped.centre + shift, corners: capped.corners.map(|corner| corner + shift), ..capped }
    }

    /// The footprint by derivatives instead of exact corners: half-extent = ½(|∂/∂x| + |∂/∂y|) for the region's two axes.
    ///
    /// The axes are half the differences of opposite edges' midpoints.
    pub fn derivative_footprint(&self, at: &SurfacePoint) -> Option<Footprint> {
        let eye = self.world_to_eye.transform_point3(at.position);
        if self.is_perspective() && (-eye.z <= 0.0 || eye.z.is_nan()) {
            return None;
        }
        let [a, b, c, d] = at.corner_offsets.map(|offset| self.world_to_eye.transform_vector3(offset.as_dvec3()));
        let step = 1.0 / 64.0;
        let (across, down) = ((b + c - a - d) * (0.5 * step), (d + c - a - b) * (0.5 * step));
        let central = |axis: DVec3| (self.eye_to_texel(eye + axis) - self.eye_to_texel(eye - axis)) / (2.0 * step);
        let half = (central(across).abs() + central(down).abs()) * 0.5;
        Some(Footprint::boxed(self.eye_to_texel(eye).as_vec2(), half.as_vec2()))
    }
}
