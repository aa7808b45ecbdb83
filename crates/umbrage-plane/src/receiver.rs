use crate::{Affine, DepthPlane, Footprint, Kind, View};
use glam::{DVec3, Vec2, Vec3};

/// A region of surface to be shaded, in world space.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SurfacePoint {
    /// Its centre.
    pub position: Vec3,
    /// Geometric unit normal, on the side that is looked at.
    pub normal: Vec3,
    /// The region's four corners on the tangent plane, in order around it; all equal to `position` for a point.
    pub corners: [Vec3; 4],
    /// Names the region within its picture: random numbers are keyed by it.
    pub region: u32,
    /// Id of the object.
    pub object: u32,
}

impl SurfacePoint {
    /// A point without extent, region 0, object 0.
    pub const fn at(position: Vec3, normal: Vec3) -> Self {
        Self { position, normal, corners: [position; 4], region: 0, object: 0 }
    }
}

/// How far a receiver is moved toward the light before it is compared. The unit is part of the type.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Bias {
    /// World units along the light's axis (along the ray in a radial map). Reeves 1987.
    World(f32),
    /// Widths of a texel at the receiver: τ, the larger of both axes, in world units.
    Texels(f32),
    /// Depth steps of the receiver's own plane from texel to texel: τ·tanθ (spec D-9). ½ along each axis is free of acne for point look-ups.
    Steps(f32),
    /// Units of the stored numbers: z_s in a screen map, quanta times the quantum for integer depth. Williams 1978.
    Map(f32),
}

impl Bias {
    /// None at all.
    pub const ZERO: Self = Self::World(0.0);
}

/// A surface point as a light sees it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Receiver {
    /// What its depth means; a map of another kind must not be asked about it (spec C-4).
    pub kind: Kind,
    /// The region's image in the map.
    pub footprint: Footprint,
    /// Depth at the region's centre, in the map's kind.
    pub depth: f32,
    /// Width and height of a texel at this depth, in world units.
    pub texel_world: Vec2,
    /// Cosine between normal and the direction to the light; ≤ 0 facing away.
    pub facing: f32,
    /// Depth change per world unit across the light's rays: tanθ on the axis, the effective slope σ elsewhere (spec D-15). +∞ edge-on.
    pub slope: f32,
    /// Id of the object.
    pub object: u32,
    /// The centre in the light's eye space.
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

    /// The depth to compare: this receiver's, moved toward the light by `bias`. The only place where a bias is applied.
    ///
    /// A world bias is exact in every kind of map (spec D-8).
    #[inline(always)]
    pub fn nearer(&self, view: &View, bias: Bias) -> f32 {
        let world = match bias {
            Bias::Map(amount) => return self.depth - amount,
            Bias::World(amount) => amount,
            Bias::Texels(amount) => amount * self.texel_world.max_element(),
            Bias::Steps(amount) => {
                let step = self.texel_world.max_element() * self.slope;
                // Edge-on no finite step exists; none at all is still none.
                if step.is_finite() {
                    amount * step
                } else if amount > 0.0 {
                    f32::INFINITY
                } else {
                    0.0
                }
            }
        };
        self.toward_light(view, world)
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
