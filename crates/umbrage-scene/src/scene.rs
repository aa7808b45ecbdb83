use crate::{Cover, Mesh, Patch, dice};
use glam::{DVec3, Vec3};
use std::borrow::Cow;
use umbrage_plane::{View, ViewError};

use crate::Light;

/// The geometry of an object.
#[derive(Clone, Debug, PartialEq)]
pub enum Shape {
    /// Fixed triangles.
    Mesh(Mesh),
    /// Patches, diced anew for each view (Williams 1978).
    Patches(Vec<Patch>),
}

impl Shape {
    /// The triangles to draw in `view`: a mesh as it is, patches diced so that no piece is larger than a texel ([`dice`]).
    /// `view` stands in the shape's own space: see [`Scene::about_origin`].
    pub fn mesh_for(&self, view: &View) -> Cow<'_, Mesh> {
        match self {
            Self::Mesh(mesh) => Cow::Borrowed(mesh),
            Self::Patches(patches) => Cow::Owned(dice(patches, view)),
        }
    }

    /// Points whose convex hull holds the shape: vertices, or control points, relative to [`Scene::origin`].
    pub fn hull(&self) -> impl Iterator<Item = Vec3> + '_ {
        let (vertices, patches) = match self {
            Self::Mesh(mesh) => (mesh.positions.as_slice(), [].as_slice()),
            Self::Patches(patches) => ([].as_slice(), patches.as_slice()),
        };
        vertices.iter().copied().chain(patches.iter().flat_map(|patch| patch.control.into_iter().flatten()))
    }

    /// At least as near to a place, relative to [`Scene::origin`], as any triangle, by boxes around them, or as any patch; world units, +∞ where there is none.
    pub fn nearest(&self, place: DVec3) -> f64 {
        let distance = |corners: &[Vec3]| {
            let first = corners.first().map_or(DVec3::INFINITY, |at| at.as_dvec3() - place);
            let around = corners.iter().map(|at| at.as_dvec3() - place);
            let (low, high) = around.fold((first, first), |(low, high), at| (low.min(at), high.max(at)));
            DVec3::ZERO.clamp(low, high).length()
        };
        match self {
            Self::Mesh(mesh) => {
                let triangles = (0..mesh.triangles.len()).map(|triangle| distance(&mesh.corners(triangle)));
                triangles.fold(f64::INFINITY, f64::min)
            }
            Self::Patches(patches) => {
                patches.iter().map(|patch| distance(patch.control.as_flattened())).fold(f64::INFINITY, f64::min)
            }
        }
    }

    /// Multiplies all positions, rounding each once.
    fn scale(&mut self, factor: f64) {
        let scale = |at: &mut Vec3| *at = (at.as_dvec3() * factor).as_vec3();
        match self {
            Self::Mesh(mesh) => mesh.positions.iter_mut().for_each(scale),
            Self::Patches(patches) => {
                patches.iter_mut().flat_map(|patch| patch.control.iter_mut().flatten()).for_each(scale);
            }
        }
    }
}

/// A plastic-like surface: ambient and diffuse colour, a white or tinted Blinn highlight. Linear light.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Material {
    /// Diffuse reflectance, linear RGB in 0..1.
    pub diffuse: Vec3,
    /// Specular reflectance, linear RGB in 0..1.
    pub specular: Vec3,
    /// Blinn exponent.
    pub shininess: f32,
}

impl Material {
    /// Without a highlight.
    pub const fn matt(diffuse: Vec3) -> Self {
        Self { diffuse, specular: Vec3::ZERO, shininess: 1.0 }
    }

    /// With a white highlight, as the papers' pictures show it.
    pub const fn plastic(diffuse: Vec3) -> Self {
        Self { diffuse, specular: Vec3::splat(0.35), shininess: 40.0 }
    }
}

/// One thing of a scene. Its id is its index in [`Scene::objects`].
#[derive(Clone, Debug, PartialEq)]
pub struct Object {
    /// Name for people.
    pub name: String,
    /// Geometry.
    pub shape: Shape,
    /// Surface.
    pub material: Material,
    /// Drawn in pass 1 (Reeves 1987 leaves the ground out).
    pub casts: bool,
    /// Can be shadowed.
    pub receives: bool,
    /// True for the closed boundary of a solid, false for an open, two-sided surface. Where the [cover](Self::cover) has holes, or
    /// blends, it counts as false: see [`Object::is_solid`].
    pub solid: bool,
    /// Fraction of the light that passes one surface of it, linear RGB in 0..=1: 0 is opaque. Only deep maps and rays know of it;
    /// a closed solid has two surfaces in the way. Where the [cover](Self::cover) blends it is what passes at an alpha of 1.
    pub passes: Vec3,
    /// What its texture adds to [`Object::material`] and [`Object::passes`]: colour, holes, and alpha that lets light pass.
    pub cover: Cover,
}

impl Object {
    /// A closed mesh that casts and receives.
    pub fn solid(name: &str, mesh: Mesh, material: Material) -> Self {
        Self {
            name: name.into(),
            shape: Shape::Mesh(mesh),
            material,
            casts: true,
            receives: true,
            solid: true,
            passes: Vec3::ZERO,
            cover: Cover::default(),
        }
    }

    /// An open, two-sided shape that casts and receives.
    pub fn two_sided(name: &str, shape: Shape, material: Material) -> Self {
        Self { solid: false, shape, ..Self::solid(name, Mesh::default(), material) }
    }

    /// The same with a texture, or holes, or both.
    #[must_use]
    pub fn with_cover(self, cover: Cover) -> Self {
        Self { cover, ..self }
    }

    /// True for the closed boundary of a solid. An object with holes is not one: its inside is seen, and light
    /// comes in. One whose cover [blends](Cover::blends) may be clear at places, and is not one either.
    pub fn is_solid(&self) -> bool {
        self.solid && !self.cover.has_holes() && !self.cover.blends
    }
}

/// Everything a figure draws.
#[derive(Clone, Debug, PartialEq)]
pub struct Scene {
    /// Name for people and files.
    pub name: String,
    /// The world-space point that the f32 positions of all meshes and patches are relative to. A scene far from the world's
    /// origin keeps its own numbers small, and loses nothing. Lights and camera stand in world space.
    pub origin: DVec3,
    /// Things, by id.
    pub objects: Vec<Object>,
    /// Lights, by id.
    pub lights: Vec<Light>,
    /// Linear RGB light from everywhere.
    pub ambient: Vec3,
    /// Linear RGB where nothing is seen.
    pub background: Vec3,
    /// The observer.
    pub camera: View,
}

impl Scene {
    /// The scene moved by `by` world units, with its lights and camera: the same picture, to the roundings of f64.
    ///
    /// # Errors
    /// [`ViewError`] when a view ends at a place that is not finite.
    pub fn moved(mut self, by: DVec3) -> Result<Self, ViewError> {
        self.origin += by;
        self.camera = self.camera.moved(by)?;
        for light in &mut self.lights {
            light.view = light.view.moved(by)?;
        }
        Ok(self)
    }

    /// The scene `factor` times as large about the world's origin, with its lights, the distances in their trees, and its
    /// camera. For powers of two nothing is rounded. Recipes, and whatever else is given in world units, must be scaled with it
    /// for the same picture.
    ///
    /// # Errors
    /// [`ViewError`], unless `factor` is positive and every view stays usable.
    pub fn scaled(mut self, factor: f64) -> Result<Self, ViewError> {
        self.origin *= factor;
        self.camera = self.camera.scaled(factor)?;
        for light in &mut self.lights {
            light.view = light.view.scaled(factor)?;
            light.tree = light.tree.take().map(|tree| tree.scaled(factor));
        }
        for object in &mut self.objects {
            object.shape.scale(factor);
        }
        Ok(self)
    }

    /// A view of this scene from where the scene's own f32 numbers are at home: moved so that [`Scene::origin`] is 0. What
    /// [`Shape::mesh_for`] wants.
    ///
    /// # Panics
    /// When the scene's origin is not finite.
    #[must_use]
    pub fn about_origin(&self, view: &View) -> View {
        view.moved(-self.origin).expect("a scene's origin is finite")
    }

    /// An object's hull ([`Shape::hull`]) in world space.
    pub fn hull<'a>(&self, object: &'a Object) -> impl Iterator<Item = DVec3> + use<'a> {
        let origin = self.origin;
        object.shape.hull().map(move |at| origin + at.as_dvec3())
    }

    /// Ids of the casting objects that are not wholly inside what a light sees; their shadows may be cut off (Williams 1978).
    ///
    /// Patches are judged by their control points, so that one may be named that just fits.
    pub fn casters_outside(&self, light: &View) -> Vec<u32> {
        let casters = self.objects.iter().enumerate().filter(|(_, object)| object.casts);
        casters.filter(|(_, object)| !self.hull(object).all(|at| sees(light, at))).map(|(id, _)| id as u32).collect()
    }
}

/// True when a world point lies inside the view's volume, near and far planes included.
fn sees(view: &View, at: DVec3) -> bool {
    let eye = view.world_to_eye().transform_point3(at);
    let in_range = (view.near()..=view.far()).contains(&-eye.z);
    let texel = view.eye_to_texel(eye);
    let size = view.size().as_dvec2();
    in_range && texel.cmpge(glam::DVec2::ZERO).all() && texel.cmple(size).all()
}
