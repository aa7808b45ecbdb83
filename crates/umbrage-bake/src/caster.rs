use glam::Vec3;
use umbrage_raster::Triangle;

/// A triangle, and what some kinds of map want to know of it beyond its corners.
///
/// Made from a bare [`Triangle`], which is opaque and flat:
///
/// ```
/// use glam::{DVec3, Vec3};
/// use umbrage_bake::Caster;
/// use umbrage_raster::Triangle;
///
/// let corners = [DVec3::ZERO, DVec3::X, DVec3::Y];
/// let leaf = Caster::from(Triangle { corners, object: 3, sheet: true }).with_opacity(0.75);
/// assert_eq!((leaf.passes, leaf.normals), (Vec3::splat(0.25), None));
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub struct Caster {
    /// Where it is, and whose.
    pub triangle: Triangle,
    /// The fraction of the light that passes it, linear RGB; 0 is opaque. What lies outside 0..=1 counts as the nearer end of it, NaN as 0.
    /// Asked for by [`bake_deep`](crate::bake_deep) alone.
    pub passes: Vec3,
    /// The shading normals at its corners, in their order, of any length but 0; `None` for a flat triangle. Asked for by
    /// [`bake_by_normals`](crate::bake_by_normals) alone.
    pub normals: Option<[Vec3; 3]>,
}

impl Caster {
    /// The same, letting `passes` of the light through, linear RGB: the colour of glass.
    #[must_use]
    pub fn with_passes(self, passes: Vec3) -> Self {
        Self { passes, ..self }
    }

    /// The same, stopping this fraction of all light: 1 is opaque, 0 stops nothing.
    #[must_use]
    pub fn with_opacity(self, opacity: f32) -> Self {
        self.with_passes(Vec3::splat(1.0 - opacity))
    }

    /// The same with shading normals at its corners.
    #[must_use]
    pub fn with_normals(self, normals: [Vec3; 3]) -> Self {
        Self { normals: Some(normals), ..self }
    }

    /// What passes, as a map can store it.
    pub(crate) fn passing(&self) -> Vec3 {
        // `max` first: it turns NaN into 0.
        self.passes.max(Vec3::ZERO).min(Vec3::ONE)
    }
}

impl From<Triangle> for Caster {
    fn from(triangle: Triangle) -> Self {
        Self { triangle, passes: Vec3::ZERO, normals: None }
    }
}
