use super::views::{camera, lamp, toward};
use crate::{Material, Mesh, Object, Scene};
use glam::{DVec3, UVec2, Vec3};

/// Height of the table top's underside, world units.
const HEIGHT: f32 = 400.0;
/// Half the table top, x and z, world units.
const HALF: [f32; 2] = [300.0, 200.0];
/// From the top's edges to the outer faces of the legs, world units.
const INSET: f32 = 20.0;
/// Side of a leg, world units.
const LEG: f32 = 8.0;
/// How thick the floor is: many texels, so that its second surface is far from its first.
const FLOOR: f32 = 60.0;

/// A table on a floor, its thin legs touching it, after Wang & Molnar 1994, Figures 4 and 12.
///
/// Objects: the floor (0), 2000 × 2000, whose top is y = 0; the table top (1), 600 × 400 × 20 at height 400; its four
/// legs (2 to 5), 8 × 8, 20 inside the top's edges. All are closed, cast and receive. Legs stand on the floor, face on
/// face, and end 10 inside the top, so that no light passes between. Light 0 is at distance 3500 in direction −x, 25°
/// above the horizon, aimed at the origin: faces of the legs are square to its bearing, so that a leg is 8 thick along
/// the light. Its map is 512 × 512 and a texel 3.92 wide at the origin. The picture is 512 × 512; see
/// [`table_close_up`] for a single leg.
///
/// # Panics
/// Never: the views are constants.
pub fn table() -> Scene {
    let [x, z] = HALF;
    let legs = [[-1.0, 1.0], [-1.0, -1.0], [1.0, 1.0], [1.0, -1.0]].map(|[to_x, to_z]: [f32; 2]| {
        let outer = Vec3::new(to_x * (x - INSET), 0.0, to_z * (z - INSET));
        let inner = Vec3::new(to_x * (x - INSET - LEG), HEIGHT + 10.0, to_z * (z - INSET - LEG));
        Mesh::cuboid(outer.min(inner), outer.max(inner))
    });
    let floor = Mesh::cuboid(Vec3::new(-1000.0, -FLOOR, -1000.0), Vec3::new(1000.0, 0.0, 1000.0));
    let top = Mesh::cuboid(Vec3::new(-x, HEIGHT, -z), Vec3::new(x, HEIGHT + 20.0, z));
    let wood = Material::plastic(Vec3::new(0.55, 0.30, 0.13));
    let mut objects = vec![
        Object::solid("floor", floor, Material::matt(Vec3::new(0.60, 0.60, 0.56))),
        Object::solid("top", top, wood),
    ];
    let numbered = (1..).zip(legs);
    objects.extend(numbered.map(|(number, leg)| Object::solid(&format!("leg {number}"), leg, wood)));
    Scene {
        name: "table".into(),
        origin: DVec3::ZERO,
        objects,
        lights: vec![lamp(toward(25.0, 180.0) * 3500.0, DVec3::ZERO, 32.0, [2200.0, 5000.0], 512)],
        ambient: Vec3::splat(0.15),
        background: Vec3::new(0.02, 0.02, 0.03),
        camera: camera([420.0, 680.0, 1750.0], [310.0, 110.0, 0.0], 47.0, [300.0, 4000.0], UVec2::splat(512)),
    }
}

/// [`table`] with the camera, 512 × 512, close on the foot of leg 1 (object 2), the one that stands nearest to light
/// and camera, and on its shadow, whose way to the far side of the picture nothing else crosses.
///
/// # Panics
/// Never: the views are constants.
pub fn table_close_up() -> Scene {
    let close = camera([-225.0, 95.0, 310.0], [-240.0, 6.0, 178.0], 32.0, [60.0, 4000.0], UVec2::splat(512));
    Scene { name: "table-close-up".into(), camera: close, ..table() }
}
