use super::SLAB_THICKNESS;
use super::foliage::Leaf;
use super::views::{camera, lamp};
use crate::{Material, Mesh, Object, Scene, Shape};
use glam::{DVec3, UVec2, Vec3};
use std::f64::consts::TAU;
use umbrage_plane::mix32;

/// Blades of grass beside the plant.
pub const BLADES: u32 = 1800;

/// Middle of the pot's floor and of the tuft, world space.
const POT: DVec3 = DVec3::new(-20.0, 0.0, -4.0);
const TUFT: DVec3 = DVec3::new(24.0, 0.0, 10.0);

/// A plant in a pot, its leaves letting green light through, beside a tuft of [`BLADES`] thin blades: partial shadows
/// for deep maps (Burley 2006).
///
/// Objects: the floor (0), whose top is y = 0, the pot (1), the soil (2), the stems (3), the leaves (4) and the grass
/// (5). Leaves and grass are curved two-sided sheets; the leaves pass (0.25, 0.45, 0.15) of the light, the grass a
/// fifth of that. The rest is closed. Light 0 is at upper left behind them, so that shadows fall toward the camera;
/// map and picture are 1024 × 1024.
///
/// # Panics
/// Never: the views are constants.
pub fn plant() -> Scene {
    let floor = Mesh::cuboid(Vec3::new(-80.0, -SLAB_THICKNESS, -60.0), Vec3::new(80.0, 0.0, 80.0));
    let clay = [(0.0, 0.0), (6.5, 0.0), (9.2, 11.5), (10.2, 11.5), (10.4, 14.5), (9.2, 14.5), (8.6, 11.0), (0.0, 11.0)];
    let earth = [(0.0, 10.0), (8.0, 10.0), (8.6, 12.6), (4.0, 13.4), (0.0, 13.6)];
    let (stems, leaves) = shoots();
    let passes = Vec3::new(0.25, 0.45, 0.15);
    let sheet = |name, mesh, diffuse: Vec3, passes: Vec3| {
        let waxy = Material { diffuse, specular: Vec3::splat(0.12), shininess: 30.0 };
        Object { passes, ..Object::two_sided(name, Shape::Mesh(mesh), waxy) }
    };
    let pot = POT.as_vec3();
    let objects = vec![
        Object::solid("floor", floor, Material::matt(Vec3::new(0.74, 0.72, 0.68))),
        Object::solid("pot", Mesh::lathe(pot, Vec3::Y, &clay, 64), Material::plastic(Vec3::new(0.52, 0.22, 0.12))),
        Object::solid("soil", Mesh::lathe(pot, Vec3::Y, &earth, 48), Material::matt(Vec3::new(0.10, 0.065, 0.04))),
        Object::solid("stems", stems, Material::matt(Vec3::new(0.16, 0.26, 0.08))),
        sheet("leaves", leaves, Vec3::new(0.14, 0.40, 0.09), passes),
        sheet("grass", tuft(), Vec3::new(0.34, 0.44, 0.10), passes * 0.2),
    ];
    Scene {
        name: "plant".into(),
        origin: DVec3::ZERO,
        objects,
        lights: vec![lamp(DVec3::new(-60.0, 120.0, -75.0), DVec3::new(4.0, 14.0, 6.0), 46.0, [50.0, 320.0], 1024)],
        ambient: Vec3::splat(0.20),
        background: Vec3::new(0.02, 0.02, 0.03),
        camera: camera([18.0, 68.0, 124.0], [2.0, 13.0, 8.0], 42.0, [20.0, 400.0], UVec2::splat(1024)),
    }
}

/// A number in 0..1 for a thing's property, the same every time.
fn chance(thing: u32, property: u32) -> f64 {
    f64::from(mix32(thing.wrapping_mul(16).wrapping_add(property))) / 4_294_967_296.0
}

/// Stems that lean out of the pot and the leaves on them.
fn shoots() -> (Mesh, Mesh) {
    let (mut stems, mut leaves) = (Mesh::default(), Mesh::default());
    for stem in 0..9u32 {
        let bearing = TAU * (f64::from(stem) + 0.5 * chance(stem, 1)) / 9.0;
        let (sin, cos) = bearing.sin_cos();
        let (height, lean) = (20.0 + 14.0 * chance(stem, 2), 5.0 + 9.0 * chance(stem, 3));
        let at = |part: f64| {
            let out = 2.0 + 1.8 * f64::from(stem % 3) + lean * part * part;
            POT + DVec3::new(cos * out, 11.5 + height * part, sin * out)
        };
        let path: Vec<Vec3> = (0..=6u8).map(|step| at(f64::from(step) / 6.0).as_vec3()).collect();
        stems.append(&Mesh::tube(&path, 0.4, 10));
        for number in 0..8u32 {
            let id = 100 + stem * 8 + number;
            let part = 0.34 + 0.66 * f64::from(number) / 7.0;
            let leaf = Leaf {
                foot: at(part),
                // Turned by the golden angle from leaf to leaf.
                bearing: bearing + 2.4 * f64::from(number) + 0.6 * chance(id, 1),
                rise: 0.35 + 0.5 * chance(id, 2),
                length: 8.0 + 5.0 * chance(id, 3),
                half_width: 2.2 + 1.2 * chance(id, 4),
                droop: 0.35 + 0.5 * chance(id, 5),
            };
            leaves.append(&leaf.broad());
        }
    }
    (stems, leaves)
}

/// [`BLADES`] blades that lean outward from a disc on the floor.
fn tuft() -> Mesh {
    let mut mesh = Mesh::default();
    for blade in 0..BLADES {
        let id = 1000 + blade;
        let (bearing, out) = (TAU * chance(id, 1), 10.0 * chance(id, 2).sqrt());
        let leaf = Leaf {
            foot: TUFT + DVec3::new(bearing.cos(), 0.0, bearing.sin()) * out,
            bearing: bearing + 2.4 * (chance(id, 3) - 0.5),
            rise: 1.45 - 0.06 * out - 0.25 * chance(id, 4),
            length: 10.0 + 8.0 * chance(id, 5),
            half_width: 0.16 + 0.10 * chance(id, 6),
            droop: 0.05 + 0.35 * chance(id, 7),
        };
        mesh.append(&leaf.blade());
    }
    mesh
}
