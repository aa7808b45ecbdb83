use super::SLAB_THICKNESS;
use crate::{Light, Material, Mesh, Object, Scene, Shape, utah_teapot};
use glam::{DVec3, UVec2, Vec3};
use umbrage_plane::View;

/// The Utah teapot (object 0) on a slab (object 1) under a spot light from the left (light 0): curved shadows on a
/// curved surface, after Williams 1978. 32 patches, diced for each view.
///
/// The pot is 63 world units long and 31.5 high, stands on y = 0 and is two-sided; its handle throws a shadow on its
/// body, its knob one on the lid. The slab is closed and casts. Map and picture are 1024 × 1024.
///
/// # Panics
/// Never: the views are constants.
pub fn teapot() -> Scene {
    const SCALE: f32 = 10.0;
    // The published table has z up. Turned by the angle of a 3-4-5 triangle, the handle comes toward the camera and its shadow falls
    // on the body's lit side.
    let placed = |at: Vec3| Vec3::new(0.8 * at.x - 0.6 * at.y, at.z, -0.6 * at.x - 0.8 * at.y) * SCALE;
    let patches = utah_teapot().iter().map(|patch| patch.mapped(placed)).collect();
    let slab = Mesh::cuboid(Vec3::new(-160.0, -SLAB_THICKNESS, -160.0), Vec3::new(160.0, 0.0, 160.0));
    let size = UVec2::splat(1024);
    let light = Light::spot("lamp", DVec3::new(-90.0, 80.0, 22.0), DVec3::new(6.0, 6.0, 0.0), 70.0, 30.0, 400.0, size)
        .expect("a constant view is valid");
    let camera = View::perspective(
        DVec3::new(25.0, 62.0, 118.0),
        DVec3::new(6.0, 9.0, -4.0),
        DVec3::Y,
        38f64.to_radians(),
        20.0,
        500.0,
        size,
    )
    .expect("a constant view is valid");
    Scene {
        name: "teapot".into(),
        origin: DVec3::ZERO,
        objects: vec![
            Object::two_sided("teapot", Shape::Patches(patches), Material::plastic(Vec3::new(0.70, 0.42, 0.16))),
            Object::solid("slab", slab, Material::matt(Vec3::new(0.45, 0.48, 0.55))),
        ],
        lights: vec![light.coloured(Vec3::new(1.0, 0.97, 0.90))],
        ambient: Vec3::new(0.14, 0.15, 0.18),
        background: Vec3::new(0.02, 0.02, 0.03),
        camera,
    }
}
