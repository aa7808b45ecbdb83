use super::SLAB_THICKNESS;
use super::views::{camera, lamp, toward};
use crate::{Light, Material, Mesh, Object, Scene};
use glam::{DVec3, UVec2, Vec3};
use umbrage_plane::View;

const GREY: Material = Material::matt(Vec3::new(0.54, 0.52, 0.48));
const RED: Material = Material::plastic(Vec3::new(0.70, 0.14, 0.08));
const BLUE: Material = Material::plastic(Vec3::new(0.12, 0.26, 0.66));

/// A box that stands on a floor and throws a long shadow, sharp where it begins and soft where it ends, after
/// Burley 2006.
///
/// The box (object 0) is 20 wide (x), 120 tall (y) and 80 deep (z), its foot about the origin; the floor (object 1) is
/// a closed slab whose top is y = 0. Light 0 is 1000 away in direction −x, 40° above the horizon: the shadow runs
/// along +x, between edges that start at the box's corners, and ends near x = 188. Map and picture are 1024 × 1024.
///
/// # Panics
/// Never: the views are constants.
pub fn contact_box() -> Scene {
    let upright = Mesh::cuboid(Vec3::new(-10.0, 0.0, -40.0), Vec3::new(10.0, 120.0, 40.0));
    on_floor(
        "contact-box",
        vec![Object::solid("box", upright, RED)],
        [Vec3::new(-60.0, 0.0, -120.0), Vec3::new(250.0, 0.0, 120.0)],
        far_lamp(),
        &camera([150.0, 250.0, 330.0], [92.0, 28.0, 0.0], 46.0, [50.0, 1000.0], UVec2::splat(1024)),
    )
}

/// [`contact_box`] with a board (object 2) high above the end of the box's shadow, on the same side of the light: one
/// search meets occluders at two depths there (Burley 2006).
///
/// # Panics
/// Never: the views are constants.
pub fn overlapping_boxes() -> Scene {
    let mut scene = contact_box();
    let board = Mesh::cuboid(Vec3::new(-104.0, 150.0, 14.0), Vec3::new(-76.0, 155.0, 48.0));
    scene.objects.push(Object::solid("board", board, BLUE));
    scene.camera = camera([170.0, 250.0, 420.0], [52.0, 62.0, 0.0], 48.0, [50.0, 1000.0], UVec2::splat(1024));
    Scene { name: "overlapping-boxes".into(), ..scene }
}

/// Two boards with straight edges along z, their undersides 10 and 40 above one floor: filters of one width make both
/// shadows equally soft, whatever the height (Reeves 1987).
///
/// Objects: the low board (0), the high board (1), the floor (2), a closed slab whose top is y = 0. Both boards end in
/// the plane x = 5; light 0 is 400 straight above the origin, so that the shadows end on the floor at x = 5·400/(400 −
/// h), for the undersides' heights h = 10 and 40. Map and picture are 1024 × 1024.
///
/// # Panics
/// Never: the views are constants.
pub fn two_heights() -> Scene {
    let board = |y: f32, z: [f32; 2]| Mesh::cuboid(Vec3::new(-45.0, y, z[0]), Vec3::new(5.0, y + 1.0, z[1]));
    let boards = [("low board", board(10.0, [2.0, 50.0]), RED), ("high board", board(40.0, [-50.0, -2.0]), BLUE)];
    on_floor(
        "two-heights",
        boards.into_iter().map(|(name, mesh, material)| Object::solid(name, mesh, material)).collect(),
        [Vec3::new(-70.0, 0.0, -70.0), Vec3::new(70.0, 0.0, 70.0)],
        overhead(),
        &camera([150.0, 96.0, 22.0], [4.0, 9.0, -1.0], 42.0, [20.0, 400.0], UVec2::splat(1024)),
    )
}

/// One board with a straight edge along z, its underside 50 above a floor and light 0 400 straight above the origin:
/// distances to occluder and receiver are 350 and 400 everywhere at the edge, so that an area light's penumbra is
/// known.
///
/// Objects: the board (0), which ends in the plane x = 0, and the floor (1), whose top is y = 0; the shadow ends at x
/// = 0 too. Map and picture are 1024 × 1024.
///
/// # Panics
/// Never: the views are constants.
pub fn single_occluder() -> Scene {
    let board = Mesh::cuboid(Vec3::new(-40.0, 50.0, -40.0), Vec3::new(0.0, 51.0, 40.0));
    on_floor(
        "single-occluder",
        vec![Object::solid("board", board, RED)],
        [Vec3::new(-70.0, 0.0, -70.0), Vec3::new(70.0, 0.0, 70.0)],
        overhead(),
        &camera([138.0, 84.0, 20.0], [0.0, 20.0, 0.0], 44.0, [20.0, 400.0], UVec2::splat(1024)),
    )
}

fn far_lamp() -> Light {
    lamp(toward(40.0, 180.0) * 1000.0, DVec3::new(56.0, 44.0, 0.0), 22.0, [600.0, 1400.0], 1024)
}

fn overhead() -> Light {
    lamp(DVec3::new(0.0, 400.0, 0.0), DVec3::ZERO, 21.0, [300.0, 420.0], 1024)
}

fn on_floor(name: &str, mut objects: Vec<Object>, [low, high]: [Vec3; 2], light: Light, camera: &View) -> Scene {
    let floor = Mesh::cuboid(low - Vec3::Y * SLAB_THICKNESS, high);
    objects.push(Object::solid("floor", floor, GREY));
    Scene {
        name: name.into(),
        origin: DVec3::ZERO,
        objects,
        lights: vec![light],
        ambient: Vec3::splat(0.15),
        background: Vec3::new(0.02, 0.02, 0.03),
        camera: *camera,
    }
}
