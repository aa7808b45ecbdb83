//! Meshes, bicubic patches, materials, lights and the gallery of the papers' scenes.
use glam::{DVec3, Vec3};
use std::borrow::Cow;
use umbrage_plane::View;

/// Triangles with shading normals. Vertices on a crease are doubled with equal positions.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Mesh {
    /// World-space positions.
    pub positions: Vec<Vec3>,
    /// Unit shading normals, one a position.
    pub normals: Vec<Vec3>,
    /// Indices into the above, counter-clockwise from outside.
    pub triangles: Vec<[u32; 3]>,
    /// One a triangle: the smooth piece of surface it belongs to (a box has six, a sphere one).
    pub surfaces: Vec<u32>,
}

/// A bicubic patch by its 16 control points.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Patch {
    /// Control points in world space; rows along v.
    pub control: [[Vec3; 4]; 4],
}

/// The geometry of an object.
#[derive(Clone, Debug, PartialEq)]
pub enum Shape {
    /// Fixed triangles.
    Mesh(Mesh),
    /// Patches, diced anew for each view (Williams 1978).
    Patches(Vec<Patch>),
}

impl Shape {
    /// The triangles to draw in `view`.
    pub fn mesh_for(&self, _view: &View) -> Cow<'_, Mesh> {
        todo!()
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
    /// True for the closed boundary of a solid, false for an open, two-sided surface.
    pub solid: bool,
}

/// A light: where it stands and what it sees, its colour, whether it casts shadows.
#[derive(Clone, Debug, PartialEq)]
pub struct Light {
    /// Name for people.
    pub name: String,
    /// Placement, frustum, map size, cone and the answers outside (spec C-10).
    pub view: View,
    /// Linear RGB radiance factor.
    pub colour: Vec3,
    /// Whether it has a shadow map.
    pub casts: bool,
}

impl Light {
    /// Unit direction from a world point to the light and the light arriving there unshadowed (no distance falloff;
    /// zero behind a spot and outside its cone).
    pub fn incident(&self, _world: DVec3) -> (Vec3, Vec3) {
        todo!()
    }
}

/// Everything a figure draws.
#[derive(Clone, Debug, PartialEq)]
pub struct Scene {
    /// Name for people and files.
    pub name: String,
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
