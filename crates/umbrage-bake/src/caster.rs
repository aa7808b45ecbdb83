use crate::{Film, Mask};
use glam::{Vec2, Vec3};
use std::fmt;
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
///
/// A caster may have holes, of which its [mask](Self::mask) knows, such as the alpha of a texture. It is borrowed, so that casters are
/// cheap to copy and one mask serves as many of them as one likes:
///
/// ```
/// # use glam::{DVec3, IVec2, UVec2, Vec2};
/// # use umbrage_bake::{Caster, MaskPlace, bake};
/// # use umbrage_depth::{DepthMap, First};
/// # use umbrage_plane::View;
/// # use umbrage_raster::{Cull, Triangle};
/// // The left half of a square is there.
/// let alpha = |at: &MaskPlace| at.uv.x < 0.5;
/// let view = View::orthographic(DVec3::Z * 9.0, DVec3::ZERO, DVec3::Y, 16.0, 1.0, 20.0, UVec2::splat(32))?;
/// let square = [[Vec2::ZERO, Vec2::X, Vec2::ONE], [Vec2::ZERO, Vec2::ONE, Vec2::Y]].map(|uvs| {
///     let corners = uvs.map(|uv| (uv * 32.0 - 16.0).extend(0.0));
///     Caster::from(Triangle::new(corners, 0, true)).with_uvs(uvs).with_mask(&alpha)
/// });
/// let map = bake(&view, square, &First, Cull::None).map;
/// assert_eq!([15, 16].map(|x| map.depth(IVec2::new(x, 9))), [9.0, f32::INFINITY]);
/// # Ok::<(), umbrage_plane::ViewError>(())
/// ```
#[derive(Clone, Copy)]
#[non_exhaustive]
pub struct Caster<'a> {
    /// Where it is, and whose.
    pub triangle: Triangle,
    /// The fraction of the light that passes it, linear RGB; 0 is opaque. What lies outside 0..=1 counts as the nearer end of it, NaN as 0.
    /// Asked for by [`bake_deep`](crate::bake_deep) alone.
    pub passes: Vec3,
    /// The shading normals at its corners, in their order, of any length but 0; `None` for a flat triangle. Asked for by
    /// [`bake_by_normals`](crate::bake_by_normals) alone.
    pub normals: Option<[Vec3; 3]>,
    /// Where its corners lie in a texture, in their order; all at (0, 0) unless given. Only its mask and its film use them.
    pub uvs: [Vec2; 3],
    /// What decides, wherever the triangle would be seen, whether anything of it is there; `None` for a triangle without holes. Every
    /// kind of map evaluates it, at each of its samples, and a [refined](crate::bake_refined) one at the slots of its links too. Where nothing
    /// is there the sample sees what is behind, as if the triangle had not been given. Holes between samples are not seen.
    pub mask: Option<Mask<'a>>,
    /// The fraction of light that passes it where that varies over its surface; it replaces [`passes`](Self::passes). Only
    /// [`bake_deep`](crate::bake_deep) calls it, at each of its samples.
    pub film: Option<Film<'a>>,
}

impl<'a> Caster<'a> {
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

    /// The same with places in a texture at its corners.
    #[must_use]
    pub fn with_uvs(self, uvs: [Vec2; 3]) -> Self {
        Self { uvs, ..self }
    }

    /// The same with holes, wherever the mask says that nothing is there.
    #[must_use]
    pub fn with_mask(self, mask: Mask<'a>) -> Self {
        Self { mask: Some(mask), ..self }
    }

    /// The same with a [film](Self::film).
    #[must_use]
    pub fn with_film(self, film: Film<'a>) -> Self {
        Self { film: Some(film), ..self }
    }

    /// Whether light may pass it.
    #[must_use]
    pub fn is_transparent(&self) -> bool {
        self.film.is_some() || self.passing() != Vec3::ZERO
    }

    /// Whether it has a mask or a film.
    #[inline(always)]
    pub(crate) fn is_masked(&self) -> bool {
        self.mask.is_some() || self.film.is_some()
    }

    /// What passes, as a map can store it.
    pub(crate) fn passing(&self) -> Vec3 {
        within(self.passes)
    }
}

/// What passes, kept within 0..=1.
pub(crate) fn within(passes: Vec3) -> Vec3 {
    // `max` first: it turns NaN into 0.
    passes.max(Vec3::ZERO).min(Vec3::ONE)
}

impl From<Triangle> for Caster<'_> {
    #[inline]
    fn from(triangle: Triangle) -> Self {
        Self { triangle, passes: Vec3::ZERO, normals: None, uvs: [Vec2::ZERO; 3], mask: None, film: None }
    }
}

impl fmt::Debug for Caster<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("Caster")
            .field("triangle", &self.triangle)
            .field("passes", &self.passes)
            .field("normals", &self.normals)
            .field("uvs", &self.uvs)
            .field("masked", &self.mask.is_some())
            .field("filmed", &self.film.is_some())
            .finish()
    }
}

/// Masks and films are the same when they are one and the same function at one place in memory, not when they return the same.
impl PartialEq for Caster<'_> {
    fn eq(&self, other: &Self) -> bool {
        fn one<F: ?Sized>(own: Option<&F>, other: Option<&F>) -> bool {
            match (own, other) {
                (Some(own), Some(other)) => std::ptr::eq(own, other),
                (own, other) => own.is_none() && other.is_none(),
            }
        }
        let same = one(self.mask, other.mask) && one(self.film, other.film);
        let known = |caster: &Self| (caster.triangle, caster.passes, caster.normals, caster.uvs);
        same && known(self) == known(other)
    }
}
