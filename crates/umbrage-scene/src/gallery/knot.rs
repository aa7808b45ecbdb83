use super::SLAB_THICKNESS;
use super::views::camera;
use crate::{Light, Material, Mesh, Object, Scene};
use glam::{DVec3, UVec2, Vec3};

/// A torus knot on a ground under one spot: many small triangles that shade one another, and the scene by which `umbrage view` is timed. It is
/// Umbrage's own.
///
/// Objects: the slab (0), 120 × 120, whose top is y = 0, and the knot (1), of 74,664 triangles, 68 wide, from 5.8 to 30.2 high. Light 0 is a
/// spot of 52° with a map of 512 × 512; its cone ends on the slab. The picture is 512 × 512.
///
/// # Panics
/// Never: the views are constants.
pub fn knot() -> Scene {
    let half = 60.0;
    let slab = Mesh::cuboid(Vec3::new(-half, -SLAB_THICKNESS, -half), Vec3::new(half, 0.0, half));
    let mut knot = Mesh::knot(612, 61);
    knot.positions.iter_mut().for_each(|at| *at *= 10.0);
    let spot = Light::spot(
        "spot",
        DVec3::new(-62.0, 92.0, 58.0),
        DVec3::new(0.0, 8.0, 0.0),
        52.0,
        40.0,
        280.0,
        UVec2::splat(512),
    )
    .expect("a constant view is valid");
    Scene {
        name: "knot".into(),
        origin: DVec3::ZERO,
        objects: vec![
            Object::solid("slab", slab, Material::matt(Vec3::new(0.62, 0.60, 0.56))),
            Object::solid("knot", knot, Material::plastic(Vec3::new(0.16, 0.40, 0.58))),
        ],
        lights: vec![spot],
        ambient: Vec3::splat(0.12),
        background: Vec3::new(0.02, 0.02, 0.03),
        camera: camera([34.0, 86.0, 118.0], [2.0, 6.0, 0.0], 38.0, [30.0, 400.0], UVec2::splat(512)),
    }
}
