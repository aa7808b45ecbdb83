use crate::weights::weights;
use glam::{DVec2, DVec3, Vec2, Vec3};
use std::borrow::Cow;
use umbrage_bake::{CasterMesh, Film, Mask, MaskPlace};
use umbrage_plane::View;
use umbrage_raster::{IndexedMesh, Triangle};
use umbrage_scene::{Cover, Mesh, MeshError, Object, Scene};

/// The triangles of a scene for one view, and the way back from a triangle's index to its mesh.
///
/// Patches are diced for the view (Williams 1978), meshes are borrowed.
pub struct Soup<'a> {
    /// What the positions of the meshes are relative to.
    origin: DVec3,
    pieces: Vec<Piece<'a>>,
    /// The [`alpha_test`] of the scene.
    alpha_test: Box<dyn Fn(&MaskPlace) -> bool + Send + Sync + 'a>,
    /// Its [`alpha_blend`].
    alpha_blend: Box<dyn Fn(&MaskPlace) -> Vec3 + Send + Sync + 'a>,
}

/// Where something of a scene's objects is, by their [covers](Cover): the [`Mask`] of all [casters](Soup::into_casting) of the scene.
pub fn alpha_test(scene: &Scene) -> impl Fn(&MaskPlace) -> bool + Send + Sync + '_ {
    |place| scene.objects[place.object as usize].cover.is_there(place.uv)
}

/// What light passes a scene's objects, by their [covers](Cover): the [`Film`] of its [casters](Soup::into_casting) whose cover
/// [blends](Cover::blends).
pub fn alpha_blend(scene: &Scene) -> impl Fn(&MaskPlace) -> Vec3 + Send + Sync + '_ {
    |place| {
        let object = &scene.objects[place.object as usize];
        object.cover.passes(object.passes, place.uv)
    }
}

struct Piece<'a> {
    object: u32,
    sheet: bool,
    passes: Vec3,
    cover: &'a Cover,
    first: u32,
    mesh: Cow<'a, Mesh>,
}

impl Piece<'_> {
    #[inline]
    fn triangle(&self, origin: DVec3, local: usize) -> Triangle {
        let world = |vertex: u32| origin + self.mesh.positions[vertex as usize].as_dvec3();
        Triangle { corners: self.mesh.triangles[local].map(world), object: self.object, sheet: self.sheet }
    }

    /// The weights of a triangle's corners at a point of it.
    fn weights(&self, origin: DVec3, local: usize, at: DVec3) -> DVec3 {
        weights(at, self.triangle(origin, local).corners).unwrap_or(DVec3::X)
    }

    fn uv(&self, local: usize, weights: DVec3) -> DVec2 {
        let [a, b, c] = self.mesh.corner_uvs(local).map(Vec2::as_dvec2);
        a * weights.x + b * weights.y + c * weights.z
    }
}

impl<'a> Piece<'a> {
    /// The same, borrowed.
    fn borrowed(&self) -> Piece<'_> {
        Piece { mesh: Cow::Borrowed(&self.mesh), ..*self }
    }

    /// What bakes take of it, about an origin.
    fn into_casting(self, origin: DVec3, alpha_test: Mask<'a>, alpha_blend: Film<'a>) -> CasterMesh<'a> {
        let (positions, triangles, normals, uvs) = match self.mesh {
            Cow::Borrowed(mesh) => {
                let Mesh { positions, triangles, normals, uvs, .. } = mesh;
                (positions.into(), triangles.into(), normals.into(), uvs.into())
            }
            Cow::Owned(mesh) => {
                (Cow::from(mesh.positions), Cow::from(mesh.triangles), Cow::from(mesh.normals), Cow::from(mesh.uvs))
            }
        };
        let mesh = IndexedMesh::new(origin, positions, triangles, self.object, self.sheet);
        let mut casting = CasterMesh::from(mesh).with_passes(self.passes).with_normals(normals);
        if self.cover.has_holes() {
            casting = casting.with_mask(alpha_test);
        }
        if self.cover.blends {
            casting = casting.with_film(alpha_blend);
        }
        if self.cover.has_holes() || self.cover.blends {
            casting = casting.with_uvs(uvs);
        }
        casting
    }
}

impl<'a> Soup<'a> {
    /// The objects that cast: what pass 1 draws (Reeves 1987).
    ///
    /// # Panics
    /// When a mesh's indices or lengths do not fit together ([`Mesh::check`]), or the scene's origin is not finite. Vertices
    /// that are not finite only cost their triangles, which the rasteriser skips and counts.
    pub fn casters(scene: &'a Scene, view: &View) -> Self {
        Self::of(scene, view, |object| object.casts)
    }

    /// Every object: what the camera sees.
    ///
    /// # Panics
    /// When a mesh's indices or lengths do not fit together ([`Mesh::check`]), or the scene's origin is not finite. Vertices
    /// that are not finite only cost their triangles, which the rasteriser skips and counts.
    pub fn all(scene: &'a Scene, view: &View) -> Self {
        Self::of(scene, view, |_| true)
    }

    fn of(scene: &'a Scene, view: &View, keep: impl Fn(&Object) -> bool) -> Self {
        let local = scene.about_origin(view);
        let mut first = 0;
        let mut pieces = Vec::new();
        for (id, object) in scene.objects.iter().enumerate().filter(|(_, object)| keep(object)) {
            let mesh = object.shape.mesh_for(&local);
            if let Err(fault) = mesh.check()
                && !matches!(fault, MeshError::NotFinite { .. })
            {
                panic!("object {id}, {:?}: {fault}", object.name);
            }
            let count = mesh.triangles.len() as u32;
            let (sheet, passes, cover) = (!object.is_solid(), object.passes, &object.cover);
            pieces.push(Piece { object: id as u32, sheet, passes, cover, first, mesh });
            first += count;
        }
        let (alpha_test, alpha_blend) = (Box::new(alpha_test(scene)), Box::new(alpha_blend(scene)));
        Self { origin: scene.origin, pieces, alpha_test, alpha_blend }
    }

    /// Number of triangles.
    pub fn len(&self) -> usize {
        self.pieces.last().map_or(0, |piece| piece.first as usize + piece.mesh.triangles.len())
    }

    /// True without a triangle.
    pub fn is_empty(&self) -> bool {
        self.len() == 0
    }

    /// The triangles in order, in world space; a triangle's index counts from 0 over all objects. Nothing is known of their holes:
    /// [`casting`](Self::casting) knows.
    pub fn triangles(&self) -> impl Iterator<Item = Triangle> + '_ {
        self.pieces
            .iter()
            .flat_map(|piece: &Piece| (0..piece.mesh.triangles.len()).map(|local| piece.triangle(self.origin, local)))
    }

    /// The same triangles, mesh by mesh, with what passes their objects, the shading normals of their meshes, and what their covers add.
    pub fn casting(&self) -> impl Iterator<Item = CasterMesh<'_>> {
        self.pieces
            .iter()
            .map(|piece| piece.borrowed().into_casting(self.origin, &*self.alpha_test, &*self.alpha_blend))
    }

    /// As [`casting`](Self::casting), for who keeps no soup but the scene's [`alpha_test`] and [`alpha_blend`].
    pub fn into_casting<'m>(
        self,
        alpha_test: Mask<'m>,
        alpha_blend: Film<'m>,
    ) -> impl Iterator<Item = CasterMesh<'m>> + use<'a, 'm>
    where
        'a: 'm,
    {
        let origin = self.origin;
        self.pieces.into_iter().map(move |piece| piece.into_casting(origin, alpha_test, alpha_blend))
    }

    /// The smooth piece of surface that a triangle belongs to; unique together with its object.
    pub(crate) fn surface(&self, triangle: u32) -> u32 {
        let (piece, local) = self.find(triangle);
        piece.mesh.surfaces[local]
    }

    /// A triangle's world corners and their shading normals.
    pub(crate) fn corners(&self, triangle: u32) -> ([DVec3; 3], [Vec3; 3]) {
        let (piece, local) = self.find(triangle);
        let vertices = piece.mesh.triangles[local].map(|vertex| vertex as usize);
        (
            vertices.map(|vertex| self.world(piece.mesh.positions[vertex])),
            vertices.map(|vertex| piece.mesh.normals[vertex]),
        )
    }

    /// The cover of a triangle's object.
    pub(crate) fn cover(&self, triangle: u32) -> &Cover {
        self.find(triangle).0.cover
    }

    /// Where a point of a triangle, in world space, lies in the texture.
    pub(crate) fn uv(&self, triangle: u32, at: DVec3) -> DVec2 {
        let (piece, local) = self.find(triangle);
        piece.uv(local, piece.weights(self.origin, local, at))
    }

    /// Whether a triangle's object has one colour all over.
    pub(crate) fn is_plain(&self, triangle: u32) -> bool {
        let piece = self.find(triangle).0;
        piece.cover.texture.is_none() && piece.mesh.colours.is_empty()
    }

    /// What multiplies the diffuse colour at a point of a triangle, in world space: the texture, and the colours of the corners.
    pub(crate) fn colour(&self, triangle: u32, at: DVec3) -> Vec3 {
        let (piece, local) = self.find(triangle);
        let weights = piece.weights(self.origin, local, at);
        let texture = piece.cover.colour(piece.uv(local, weights));
        if piece.mesh.colours.is_empty() {
            return texture;
        }
        let [a, b, c] = piece.mesh.corner_colours(local).map(Vec3::as_dvec3);
        texture * (a * weights.x + b * weights.y + c * weights.z).as_vec3()
    }

    fn world(&self, position: Vec3) -> DVec3 {
        self.origin + position.as_dvec3()
    }

    fn find(&self, triangle: u32) -> (&Piece<'a>, usize) {
        let at = self.pieces.partition_point(|piece| piece.first <= triangle) - 1;
        (&self.pieces[at], (triangle - self.pieces[at].first) as usize)
    }
}
