use crate::caster::within;
use crate::{Caster, Film, Mask};
use glam::{Vec2, Vec3};
use std::borrow::Cow;
use std::fmt;
use std::sync::Arc;
use umbrage_raster::{IndexedMesh, Triangle};

/// [`Caster`]s that share corners and all else but their places: as scenes keep them, and in less time than one by one.
///
/// ```
/// use glam::{DVec3, IVec2, UVec2, Vec3};
/// use umbrage_bake::{CasterMesh, bake};
/// use umbrage_depth::{DepthMap, First};
/// use umbrage_plane::View;
/// use umbrage_raster::{Cull, IndexedMesh};
///
/// let positions = [(-9.0, -9.0), (9.0, -9.0), (9.0, 9.0), (-9.0, 9.0)].map(|(x, y)| Vec3::new(x, y, 0.0));
/// let square = IndexedMesh::new(DVec3::Z * 4.0, &positions[..], &[[0, 1, 2], [0, 2, 3]][..], 0, true);
/// let view = View::orthographic(DVec3::Z * 9.0, DVec3::ZERO, DVec3::Y, 16.0, 1.0, 20.0, UVec2::splat(32))?;
/// let map = bake(&view, [CasterMesh::from(square)], &First, Cull::None).map;
/// assert_eq!(map.depth(IVec2::splat(16)), 5.0);
/// # Ok::<(), umbrage_plane::ViewError>(())
/// ```
#[derive(Clone)]
pub struct CasterMesh<'a> {
    mesh: IndexedMesh<'a>,
    passes: Vec3,
    normals: Attribute<'a, Vec3>,
    uvs: Attribute<'a, Vec2>,
    mask: Option<Mask<'a>>,
    film: Option<Film<'a>>,
}

/// A value at each of the positions of a mesh.
type Attribute<'a, T> = Option<Arc<Cow<'a, [T]>>>;

impl<'a> From<IndexedMesh<'a>> for CasterMesh<'a> {
    /// Opaque and flat, as a caster that is made [from a triangle](Caster).
    fn from(mesh: IndexedMesh<'a>) -> Self {
        Self { mesh, passes: Vec3::ZERO, normals: None, uvs: None, mask: None, film: None }
    }
}

impl<'a> CasterMesh<'a> {
    /// As [`Caster::passes`].
    #[must_use]
    pub fn with_passes(self, passes: Vec3) -> Self {
        Self { passes, ..self }
    }

    /// With one shading normal for each position of the mesh: [`Caster::normals`]. A triangle with a corner that has none is flat.
    #[must_use]
    pub fn with_normals(self, normals: impl Into<Cow<'a, [Vec3]>>) -> Self {
        Self { normals: Some(Arc::new(normals.into())), ..self }
    }

    /// With a place in a texture for each position of the mesh: [`Caster::uvs`]. A corner without one lies at (0, 0).
    #[must_use]
    pub fn with_uvs(self, uvs: impl Into<Cow<'a, [Vec2]>>) -> Self {
        Self { uvs: Some(Arc::new(uvs.into())), ..self }
    }

    /// As [`Caster::mask`].
    #[must_use]
    pub fn with_mask(self, mask: Mask<'a>) -> Self {
        Self { mask: Some(mask), ..self }
    }

    /// As [`Caster::film`].
    #[must_use]
    pub fn with_film(self, film: Film<'a>) -> Self {
        Self { film: Some(film), ..self }
    }

    /// Number of casters.
    pub fn len(&self) -> usize {
        self.mesh.len()
    }

    /// True without a caster.
    pub fn is_empty(&self) -> bool {
        self.mesh.is_empty()
    }

    /// One of the casters, by its index.
    ///
    /// # Panics
    /// When there is none of that index.
    pub fn caster(&self, index: usize) -> Caster<'a> {
        let Self { passes, mask, film, .. } = *self;
        let corners = self.mesh.indices()[index].map(|corner| corner as usize);
        let normals = self.normals.as_ref().and_then(|all| {
            let [a, b, c] = corners.map(|corner| all.get(corner).copied());
            Some([a?, b?, c?])
        });
        let uvs = self
            .uvs
            .as_ref()
            .map_or([Vec2::ZERO; 3], |all| corners.map(|corner| all.get(corner).copied().unwrap_or_default()));
        Caster { passes, normals, uvs, mask, film, ..Caster::from(self.mesh.triangle(index)) }
    }

    /// Whether they have a mask or a film.
    pub(crate) fn is_masked(&self) -> bool {
        self.mask.is_some() || self.film.is_some()
    }

    /// The triangles alone.
    pub(crate) fn into_mesh(self) -> IndexedMesh<'a> {
        self.mesh
    }

    /// What passes them, as a map can store it.
    pub(crate) fn passing(&self) -> Vec3 {
        within(self.passes)
    }

    /// Takes so many of the first casters away, or all where it has fewer, and gives them.
    #[must_use]
    pub(crate) fn split_to(&mut self, count: usize) -> Self {
        Self { mesh: self.mesh.split_to(count), ..self.clone() }
    }
}

impl fmt::Debug for CasterMesh<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("CasterMesh")
            .field("mesh", &self.mesh)
            .field("passes", &self.passes)
            .field("normals", &self.normals.is_some())
            .field("uvs", &self.uvs.is_some())
            .field("masked", &self.mask.is_some())
            .field("filmed", &self.film.is_some())
            .finish()
    }
}

/// What bakes take: a caster, or many that share corners. Made from either, and from what they are made of.
#[derive(Clone, Debug)]
pub enum Casting<'a> {
    /// One caster.
    One(Caster<'a>),
    /// All casters of a mesh.
    Mesh(CasterMesh<'a>),
}

impl<'a> Casting<'a> {
    /// Number of casters.
    pub fn count(&self) -> usize {
        match self {
            Self::One(_) => 1,
            Self::Mesh(mesh) => mesh.len(),
        }
    }

    /// The casters, in their order.
    pub fn casters(&self) -> impl ExactSizeIterator<Item = Caster<'a>> + '_ {
        (0..self.count()).map(|index| match self {
            Self::One(caster) => *caster,
            Self::Mesh(mesh) => mesh.caster(index),
        })
    }

    /// Their triangles, in their order.
    pub fn triangles(&self) -> impl ExactSizeIterator<Item = Triangle> + '_ {
        (0..self.count()).map(|index| match self {
            Self::One(caster) => caster.triangle,
            Self::Mesh(mesh) => mesh.mesh.triangle(index),
        })
    }

    /// Whether light may pass them: [`Caster::is_transparent`].
    #[must_use]
    pub fn is_transparent(&self) -> bool {
        match self {
            Self::One(caster) => caster.is_transparent(),
            Self::Mesh(mesh) => mesh.film.is_some() || mesh.passing() != Vec3::ZERO,
        }
    }
}

impl<'a> From<Caster<'a>> for Casting<'a> {
    #[inline(always)]
    fn from(caster: Caster<'a>) -> Self {
        Self::One(caster)
    }
}

impl From<Triangle> for Casting<'_> {
    #[inline(always)]
    fn from(triangle: Triangle) -> Self {
        Self::One(triangle.into())
    }
}

impl<'a> From<CasterMesh<'a>> for Casting<'a> {
    fn from(mesh: CasterMesh<'a>) -> Self {
        Self::Mesh(mesh)
    }
}

impl<'a> From<IndexedMesh<'a>> for Casting<'a> {
    fn from(mesh: IndexedMesh<'a>) -> Self {
        Self::Mesh(mesh.into())
    }
}
