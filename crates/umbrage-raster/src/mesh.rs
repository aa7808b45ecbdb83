use crate::Triangle;
use crate::piece::Owner;
use glam::{DVec3, Vec3};
use std::borrow::Cow;
use std::ops::Range;
use std::sync::Arc;

/// Triangles that share corners, as scenes keep them: [`Bins`](crate::Bins) take its triangles in their order, with the bits that
/// [`triangle`](Self::triangle) gives, and less work. Corners that triangles share are projected once for some thousands of them where
/// their indices lie close together.
///
/// Positions and indices are borrowed or owned, and clones and [parts](Self::split_to) share them.
///
/// ```
/// use glam::{DVec3, UVec2, Vec3};
/// use umbrage_plane::{TexelRect, View};
/// use umbrage_raster::{Bins, Cull, IndexedMesh};
///
/// let positions = [(-9.0, -9.0), (9.0, -9.0), (9.0, 9.0), (-9.0, 9.0)].map(|(x, y)| Vec3::new(x, y, 0.0));
/// let square = IndexedMesh::new(DVec3::NEG_Z * 5.0, &positions[..], &[[0, 1, 2], [0, 2, 3]][..], 7, true);
/// assert_eq!(square.triangle(0).corners[1], DVec3::new(9.0, -9.0, -5.0));
/// let view = View::orthographic(DVec3::ZERO, DVec3::NEG_Z, DVec3::Y, 16.0, 1.0, 9.0, UVec2::splat(32))?;
/// assert_eq!(Bins::new(&view, TexelRect::of_size(view.size()), Cull::None, [square]).stats().kept(), 2);
/// # Ok::<(), umbrage_plane::ViewError>(())
/// ```
#[derive(Clone, Debug)]
pub struct IndexedMesh<'a> {
    whole: Arc<Whole<'a>>,
    /// Which triangles of the whole it has.
    range: Range<usize>,
}

#[derive(Debug)]
struct Whole<'a> {
    origin: DVec3,
    positions: Cow<'a, [Vec3]>,
    triangles: Cow<'a, [[u32; 3]]>,
    owner: Owner,
}

impl Whole<'_> {
    /// The position of that index, in world space; NaN where the mesh has none.
    #[inline(always)]
    fn corner(&self, index: u32) -> DVec3 {
        self.positions.get(index as usize).map_or(DVec3::NAN, |position| self.origin + position.as_dvec3())
    }
}

impl<'a> IndexedMesh<'a> {
    /// Triangles between positions, which are relative to an origin in world space; all of one object, pieces of a two-sided surface where it is a
    /// `sheet`. See [`Triangle`].
    ///
    /// A triangle that has an index beyond the positions counts as one with a corner that is not finite.
    pub fn new(
        origin: DVec3,
        positions: impl Into<Cow<'a, [Vec3]>>,
        triangles: impl Into<Cow<'a, [[u32; 3]]>>,
        object: u32,
        sheet: bool,
    ) -> Self {
        let (positions, triangles) = (positions.into(), triangles.into());
        let range = 0..triangles.len();
        Self { whole: Arc::new(Whole { origin, positions, triangles, owner: Owner { object, sheet } }), range }
    }

    /// Number of triangles.
    pub fn len(&self) -> usize {
        self.range.len()
    }

    /// True without a triangle.
    pub fn is_empty(&self) -> bool {
        self.range.is_empty()
    }

    /// A triangle by its index.
    ///
    /// # Panics
    /// When there is none of that index.
    #[inline(always)]
    pub fn triangle(&self, index: usize) -> Triangle {
        let (whole, [a, b, c]) = (&*self.whole, self.indices()[index]);
        let Owner { object, sheet } = whole.owner;
        Triangle { corners: [whole.corner(a), whole.corner(b), whole.corner(c)], object, sheet }
    }

    /// Its triangles, in their order.
    pub fn triangles(&self) -> impl ExactSizeIterator<Item = Triangle> + '_ {
        (0..self.len()).map(|index| self.triangle(index))
    }

    /// Takes so many of the first triangles away, or all where it has fewer, and gives them.
    #[must_use]
    pub fn split_to(&mut self, count: usize) -> Self {
        let at = self.range.start + count.min(self.len());
        let first = Self { whole: Arc::clone(&self.whole), range: self.range.start..at };
        self.range.start = at;
        first
    }

    /// Three indices into the positions for each triangle.
    #[inline(always)]
    pub fn indices(&self) -> &[[u32; 3]] {
        &self.whole.triangles[self.range.clone()]
    }

    /// Whose its triangles are.
    pub(crate) fn owner(&self) -> Owner {
        self.whole.owner
    }

    /// What positions are relative to.
    pub(crate) fn origin(&self) -> DVec3 {
        self.whole.origin
    }

    /// Positions that its triangles have corners at, relative to the origin, and the index of the first among all of the mesh: those from the
    /// least of its triangles' indices to the greatest. `None` without a triangle, or where one has no position.
    pub(crate) fn positions(&self) -> Option<(u32, &[Vec3])> {
        let (mut least, mut greatest) = ([u32::MAX; 3], [0; 3]);
        for triangle in self.indices() {
            for corner in 0..3 {
                least[corner] = least[corner].min(triangle[corner]);
                greatest[corner] = greatest[corner].max(triangle[corner]);
            }
        }
        let (least, greatest) = (*least.iter().min()?, *greatest.iter().max()?);
        let positions = self.whole.positions.get(least as usize..=greatest as usize)?;
        Some((least, positions))
    }
}

/// What [`Bins`](crate::Bins) take: a triangle, or many that share corners.
#[derive(Clone, Debug)]
pub enum Geometry<'a> {
    /// One triangle.
    Triangle(Triangle),
    /// All triangles of a mesh.
    Mesh(IndexedMesh<'a>),
}

impl From<Triangle> for Geometry<'_> {
    #[inline(always)]
    fn from(triangle: Triangle) -> Self {
        Self::Triangle(triangle)
    }
}

impl<'a> From<IndexedMesh<'a>> for Geometry<'a> {
    fn from(mesh: IndexedMesh<'a>) -> Self {
        Self::Mesh(mesh)
    }
}
