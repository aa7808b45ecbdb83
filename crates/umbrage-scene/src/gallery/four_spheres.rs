use crate::{Light, Material, Mesh, Object, Scene};
use glam::{DVec3, UVec2, Vec3};
use umbrage_plane::{Kind, View};

/// Four unit spheres after Williams 1978, Figures 1 to 6; objects 0 to 3, light 0.
///
/// The observer looks along −z, the light is at infinity, 100° about the vertical to the left of the observer's bearing;
/// both views are orthographic, 512 × 512, and store screen depth. Seen from the light, sphere 0 covers part of
/// sphere 1; spheres 2 and 3 stand alone.
///
/// # Panics
/// Never: the views are constants.
pub fn four_spheres() -> Scene {
    four_spheres_lit_from(100.0)
}

/// [`four_spheres`] with the light at another angle in degrees from the observer's bearing: Williams' wording can also be
/// read as 80.
///
/// # Panics
/// When the angle is not finite.
pub fn four_spheres_lit_from(degrees: f64) -> Scene {
    let size = UVec2::splat(512);
    let spheres = [
        ("upper left", Vec3::new(-1.6, 1.3, 0.0), Vec3::new(0.80, 0.28, 0.20)),
        ("upper right", Vec3::new(1.3, 1.0, -0.8), Vec3::new(0.85, 0.70, 0.22)),
        ("lower left", Vec3::new(-1.3, -1.4, 0.5), Vec3::new(0.25, 0.50, 0.80)),
        ("lower right", Vec3::new(1.5, -1.5, -1.6), Vec3::new(0.35, 0.68, 0.35)),
    ];
    let (sin, cos) = degrees.to_radians().sin_cos();
    let centre = DVec3::new(0.0, 0.0, -0.5);
    let mut light = Light::directional("sun", DVec3::new(-sin, 0.0, cos), centre, 3.2, 2.0, 10.0, size)
        .expect("the angle is finite");
    light.view = light.view.with_kind(Kind::Screen);
    let camera = View::orthographic(DVec3::new(0.0, 0.0, 6.0), centre, DVec3::Y, 3.2, 3.0, 10.0, size)
        .expect("the angle is finite");
    Scene {
        name: "four-spheres".into(),
        origin: DVec3::ZERO,
        objects: spheres
            .into_iter()
            .map(|(name, centre, colour)| {
                Object::solid(name, Mesh::sphere(centre, 1.0, Mesh::FINE), Material::plastic(colour))
            })
            .collect(),
        lights: vec![light],
        ambient: Vec3::splat(0.12),
        background: Vec3::ZERO,
        camera: camera.with_kind(Kind::Screen),
    }
}
