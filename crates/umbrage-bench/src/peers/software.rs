//! Depth by `euc`, whose depth buffer holds what is affine in the map: −1/ζ.
//!
//! Its colours have no size, so that only depth is written. Vertices are transformed by its vertex shader, which a real map needs
//! as well.

use crate::meshes::Mesh;
use euc::buffer::Buffer2d;
use euc::rasterizer::{BackfaceCullingDisabled, Triangles};
use euc::{Pipeline, Target};
use glam::{Mat4, Vec3};
use std::fmt;
use umbrage_plane::{Projection, View};

/// A depth buffer and how it is drawn into.
pub struct Software {
    to_eye: Mat4,
    k: [f32; 2],
    depth: Buffer2d<f32>,
    colour: Buffer2d<()>,
}

impl fmt::Debug for Software {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("Software").field("depth", &self.depth).finish_non_exhaustive()
    }
}

struct Shader<'a> {
    vertices: &'a [Vec3],
    to_eye: Mat4,
    k: [f32; 2],
}

impl Pipeline for Shader<'_> {
    type Vertex = u32;
    type VsOut = f32;
    type Pixel = ();

    fn vert(&self, vertex: &u32) -> ([f32; 4], f32) {
        let eye = self.to_eye.transform_point3(self.vertices[*vertex as usize]);
        ([eye.x * self.k[0], eye.y * self.k[1], -1.0, -eye.z], 0.0)
    }

    fn frag(&self, _: &f32) {}
}

impl Software {
    /// A buffer as large as the map of a view.
    ///
    /// # Panics
    /// When the view is not a perspective one.
    pub fn new(view: &View) -> Self {
        let Projection::Perspective { k, .. } = view.projection() else { panic!("a perspective view") };
        let size = view.size().as_usizevec2().to_array();
        Self {
            to_eye: view.world_to_eye().as_mat4(),
            k: k.as_vec2().to_array(),
            depth: Buffer2d::new(size, f32::INFINITY),
            colour: Buffer2d::new(size, ()),
        }
    }

    /// Clears the buffer and draws a mesh.
    pub fn draw(&mut self, mesh: &Mesh) {
        self.depth.clear(f32::INFINITY);
        let shader = Shader { vertices: &mesh.vertices, to_eye: self.to_eye, k: self.k };
        let indices = mesh.triangles.as_flattened();
        let depth = Some(&mut self.depth);
        shader.draw::<Triangles<'_, Buffer2d<f32>, BackfaceCullingDisabled>, _>(indices, &mut self.colour, depth);
    }

    /// What was drawn: −1/ζ row by row from the top, +∞ where nothing is.
    pub fn keys(&self) -> &[f32] {
        self.depth.as_ref()
    }
}
