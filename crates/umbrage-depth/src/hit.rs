use glam::DVec3;
use umbrage_plane::View;

/// One surface that a ray through a texel's sample meets, for [`DepthRule::of`](crate::DepthRule::of).
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub struct Hit {
    /// ζ, the distance from the light *along its view's axis*, world units: not along the ray, unless it is the axis.
    pub zeta: f64,
    /// Whether the outside of the surface is seen.
    pub front: bool,
    /// True for a piece of an open, two-sided surface; false for the boundary of a solid.
    pub sheet: bool,
    /// Id of the object it belongs to.
    pub object: u32,
}

impl Hit {
    /// The outside of object 0, a solid, at axial distance `zeta`.
    #[must_use]
    pub const fn front(zeta: f64) -> Self {
        Self { zeta, front: true, sheet: false, object: 0 }
    }

    /// The inside of object 0, a solid, at axial distance `zeta`.
    #[must_use]
    pub const fn back(zeta: f64) -> Self {
        Self { front: false, ..Self::front(zeta) }
    }

    /// A solid's surface met at a place in the world, whose unit or other `normal` points out of the solid.
    #[must_use]
    pub fn at(view: &View, world: DVec3, normal: DVec3) -> Self {
        let zeta = -view.world_to_eye().transform_point3(world).z;
        Self { front: normal.dot(view.toward_eye(world)) > 0.0, ..Self::front(zeta) }
    }

    /// The same surface of an open, two-sided sheet.
    #[must_use]
    pub const fn of_sheet(self) -> Self {
        Self { sheet: true, ..self }
    }

    /// The same surface of another object.
    #[must_use]
    pub const fn of_object(self, object: u32) -> Self {
        Self { object, ..self }
    }
}
