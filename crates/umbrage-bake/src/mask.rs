//! Functions of a caster's surface: where it has holes, and how much light passes it.

use glam::{DVec2, DVec3, Vec2, Vec3};

/// Whether anything of a caster is at a place of it: an alpha test, where true is opaque.
///
/// It is evaluated at samples, in no order, from several threads, and perhaps more than once at one. It must always say the same of the
/// same place, or the map depends on the order. A panic of it is one of the bake.
pub type Mask<'a> = &'a (dyn Fn(&MaskPlace) -> bool + Sync);

/// What passes of the light at a place of a caster, linear RGB: 0 is opaque. What lies outside 0..=1 counts as the nearer end of it,
/// NaN as 0.
///
/// Like a [`Mask`] it is called from several threads, and must always return the same for the same place.
pub type Film<'a> = &'a (dyn Fn(&MaskPlace) -> Vec3 + Sync);

/// A place on a triangle, the argument of a [`Mask`] and a [`Film`].
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub struct MaskPlace {
    /// Index of the triangle in the order in which they were given to the bake, 0-based and modulo 2³²; of a bake over several
    /// moments among those of its own moment.
    pub triangle: u32,
    /// Id of the object that it belongs to.
    pub object: u32,
    /// The weights of the triangle's corners, in their order: the place in world space is the mean of the corners by these, so that
    /// perspective is in them. Each is within 0..=1 and they sum to 1, but for rounding; none is NaN. Where snapping leaves a sample just beside its
    /// triangle they are those of a place on its border, and of a triangle that is edge-on to the view those of some place of it.
    pub weights: DVec3,
    /// The place in a texture: the [mean](Self::mix) of the [corners' own](crate::Caster::uvs).
    pub uv: DVec2,
}

impl MaskPlace {
    /// The mean of what is known at the corners, in their order, by the [weights](Self::weights).
    #[must_use]
    pub fn mix(&self, corners: [Vec2; 3]) -> DVec2 {
        mix(corners, self.weights)
    }
}

/// The mean of what is known at three corners by their weights.
pub(crate) fn mix(corners: [Vec2; 3], weights: DVec3) -> DVec2 {
    let [a, b, c] = corners.map(Vec2::as_dvec2);
    a * weights.x + b * weights.y + c * weights.z
}
