use crate::Mesh;
use glam::Vec3;
use std::f32::consts::TAU;

impl Mesh {
    /// A closed tube along a trefoil, the torus knot of 2 turns about y and 3 through the hole, one surface: `along` segments along it, `around` about it (at least 3 each), so that it
    /// has 2 · `along` · `around` triangles. It is 6.8 wide in x and z, and its heights are from .58 to 3.02.
    pub fn knot(along: u32, around: u32) -> Self {
        let (along, around) = (along.max(3), around.max(3));
        let mut mesh = Self::default();
        let curve = |turn: f32| {
            let (p, q) = (2.0 * turn, 3.0 * turn);
            let radius = 2.2 + 0.8 * q.cos();
            Vec3::new(radius * p.cos(), 1.8 + 0.8 * q.sin(), radius * p.sin())
        };
        for i in 0..along {
            let turn = TAU * i as f32 / along as f32;
            let tangent = (curve(turn + 1e-2) - curve(turn - 1e-2)).normalize();
            let side = tangent.cross(Vec3::Y).normalize();
            let up = side.cross(tangent);
            for j in 0..around {
                let (sin, cos) = (TAU * j as f32 / around as f32).sin_cos();
                let spoke = side * cos + up * sin;
                mesh.vertex(curve(turn) + spoke * 0.42, spoke.normalize());
            }
        }
        for i in 0..along {
            for j in 0..around {
                let vertex = |i: u32, j: u32| (i % along) * around + j % around;
                let [a, b, c, d] = [vertex(i, j), vertex(i + 1, j), vertex(i + 1, j + 1), vertex(i, j + 1)];
                mesh.triangles.extend([[a, b, c], [a, c, d]]);
                mesh.surfaces.extend([0, 0]);
            }
        }
        mesh
    }
}
