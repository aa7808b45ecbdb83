use super::SLAB_THICKNESS;
use super::views::camera;
use crate::{Light, Material, Mesh, Object, Scene};
use glam::{DVec3, UVec2, Vec3};

/// Spheres, boxes and cylinders in a corner of a room under one wide spot, after Woo 1992, Figure 2.
///
/// Objects 0 to 2 are closed slabs: the floor, whose top is y = 0, the back wall and the left wall. Then come three
/// spheres (3 to 5), three boxes (6 to 8) and three cylinders (9 to 11). Light 0 is a spot of 75° with a map of 256 ×
/// 256; its cone ends on the floor and on both walls. The tall box and the tall post reach out of it, and their
/// shadows run over its rim. The picture is 1024 × 1024.
///
/// # Panics
/// Never: the views are constants.
pub fn spot_room() -> Scene {
    let [thick, half, high] = [SLAB_THICKNESS, 64.0, 70.0];
    let slab = |min: [f32; 3], max: [f32; 3]| Mesh::cuboid(min.into(), max.into());
    let pale = |r: f32, g: f32, b: f32| Material::matt(Vec3::new(r, g, b));
    let shiny = |r: f32, g: f32, b: f32| Material::plastic(Vec3::new(r, g, b));
    let ball = |x: f32, z: f32, radius: f32| Mesh::sphere(Vec3::new(x, radius, z), radius, 96);
    let crate_at = |x: f32, y: f32, z: f32, size: [f32; 3]| {
        let corner = Vec3::new(x, y, z);
        Mesh::cuboid(corner, corner + Vec3::from(size))
    };
    let post = |x: f32, z: f32, radius: f32, height: f32| {
        Mesh::cylinder(Vec3::new(x, 0.0, z), Vec3::new(x, height, z), radius, 64)
    };
    // The walls end inside one another and in the floor, so that no light passes a corner.
    let things = [
        ("floor", slab([-half, -thick, -half], [half, 0.0, half]), pale(0.62, 0.58, 0.50)),
        ("back wall", slab([-half, -2.0, -half - thick], [half, high, -half + 0.5]), pale(0.50, 0.58, 0.66)),
        (
            "left wall",
            slab([-half - thick, -2.5, -half - 2.0], [-half + 0.5, high + 1.0, half - 1.0]),
            pale(0.66, 0.54, 0.48),
        ),
        ("red ball", ball(-8.0, 14.0, 9.0), shiny(0.72, 0.10, 0.08)),
        ("blue ball", ball(20.0, 30.0, 6.0), shiny(0.10, 0.22, 0.70)),
        ("white ball", ball(-44.0, 30.0, 7.0), shiny(0.75, 0.75, 0.75)),
        ("low box", crate_at(8.0, 0.0, -24.0, [26.0, 10.0, 18.0]), shiny(0.16, 0.52, 0.22)),
        ("small box", crate_at(14.0, 10.0, -20.0, [11.0, 11.0, 11.0]), shiny(0.80, 0.62, 0.12)),
        ("tall box", crate_at(-38.0, 0.0, -40.0, [13.0, 54.0, 13.0]), shiny(0.45, 0.28, 0.60)),
        ("fat post", post(-26.0, -4.0, 6.0, 20.0), shiny(0.20, 0.55, 0.60)),
        ("tall post", post(49.0, -10.0, 2.5, 38.0), shiny(0.70, 0.68, 0.64)),
        ("thin post", post(12.0, 46.0, 1.2, 20.0), shiny(0.70, 0.68, 0.64)),
    ];
    let spot = Light::spot(
        "spot",
        DVec3::new(18.0, 92.0, 42.0),
        DVec3::new(-8.0, 0.0, -4.0),
        75.0,
        30.0,
        260.0,
        UVec2::splat(256),
    )
    .expect("a constant view is valid");
    Scene {
        name: "spot-room".into(),
        origin: DVec3::ZERO,
        objects: things.into_iter().map(|(name, mesh, material)| Object::solid(name, mesh, material)).collect(),
        lights: vec![spot],
        ambient: Vec3::splat(0.10),
        background: Vec3::new(0.02, 0.02, 0.03),
        camera: camera([62.0, 74.0, 150.0], [-4.0, 14.0, -4.0], 40.0, [20.0, 400.0], UVec2::splat(1024)),
    }
}
