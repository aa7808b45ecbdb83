use super::SLAB_THICKNESS;
use super::views::{camera, lamp};
use crate::{Material, Mesh, Object, Scene};
use glam::{DVec3, UVec2, Vec3};

/// Radius of the ball, world units.
const RADIUS: f32 = 6.0;

/// A ball (object 0) that flies over a floor (object 2) past a post (object 1), at `time` 0 (just left of the middle)
/// to 1 (just right of it): its shadow is blurred by motion when maps of several times are put together (Burley 2006).
///
/// The ball's middle goes from (−16, 14, 4) to (16, 14, 4) in an arc that is 6 higher half-way. Times outside 0..=1
/// are brought to the nearer end, NaN to 0. All but the ball is the same, bit for bit, at all times. The floor is y =
/// 0; light 0 has 512 × 512 texels, the picture 1024 × 1024.
///
/// # Panics
/// Never: the views are constants.
pub fn moving_ball(time: f32) -> Scene {
    let time = if time.is_nan() { 0.0 } else { time.clamp(0.0, 1.0) };
    let middle = Vec3::new(32.0 * time - 16.0, 14.0 + 24.0 * time * (1.0 - time), 4.0);
    let floor = Mesh::cuboid(Vec3::new(-60.0, -SLAB_THICKNESS, -60.0), Vec3::new(60.0, 0.0, 60.0));
    let post = Mesh::cylinder(Vec3::new(26.0, 0.0, -18.0), Vec3::new(26.0, 22.0, -18.0), 3.0, 64);
    Scene {
        name: "moving-ball".into(),
        origin: DVec3::ZERO,
        objects: vec![
            Object::solid("ball", Mesh::sphere(middle, RADIUS, 128), Material::plastic(Vec3::new(0.75, 0.16, 0.07))),
            Object::solid("post", post, Material::plastic(Vec3::new(0.16, 0.36, 0.62))),
            Object::solid("floor", floor, Material::matt(Vec3::new(0.62, 0.60, 0.56))),
        ],
        lights: vec![lamp(DVec3::new(-30.0, 120.0, 50.0), DVec3::new(4.0, 4.0, 0.0), 46.0, [40.0, 240.0], 512)],
        ambient: Vec3::splat(0.15),
        background: Vec3::new(0.02, 0.02, 0.03),
        camera: camera([20.0, 56.0, 112.0], [2.0, 6.0, 0.0], 40.0, [20.0, 400.0], UVec2::splat(1024)),
    }
}
