use super::foliage::Leaf;
use super::hall::{awnings, beams, columns, mullions, plain_walls, railing, screen, stairs, window_wall};
use super::views::camera;
use crate::{Light, Material, Mesh, Object, Scene, Shape};
use glam::{DVec3, UVec2, Vec3};

/// A hall in the sun, as one walks through a building, after Wang & Molnar 1994, Figure 14: polygons large
/// and thin, solids and sheets together.
///
/// Solids: `floor`, whose top is y = 0, `window wall` with three tall windows, `walls` with a doorway to a court
/// behind, `ceiling`, `beams`, `columns`, `mullions` (0.7 thin), `stairs` along the right wall, `railing`, `bench` and
/// `pot`. Sheets, two-sided: `awnings` over the windows outside, a folding paper `screen` and `leaves`. All cast and
/// receive. Light 0 is the sun, at infinity, 26° above the horizon to the left; its map, 2048 × 2048, holds
/// everything. Light 1, the sky, is dim and casts no shadow. The picture is 1024 × 1024.
///
/// # Panics
/// Never: the views are constants.
pub fn walkthrough() -> Scene {
    let slab = |min: [f32; 3], max: [f32; 3]| Mesh::cuboid(min.into(), max.into());
    let matt = |r: f32, g: f32, b: f32| Material::matt(Vec3::new(r, g, b));
    let wood = Material { diffuse: Vec3::new(0.34, 0.19, 0.09), specular: Vec3::splat(0.10), shininess: 30.0 };
    let floor = slab([-66.0, -4.0, -84.0], [56.0, 0.0, 58.0]);
    let tiles = Material { diffuse: Vec3::new(0.50, 0.40, 0.31), specular: Vec3::splat(0.08), shininess: 50.0 };
    let mut seat = slab([-14.0, 6.0, -37.0], [14.0, 7.5, -29.0]);
    for x in [-12.0, 9.0] {
        seat.append(&slab([x, 0.0, -36.0], [x + 3.0, 6.5, -30.0]));
    }
    let clay = [(0.0, 0.0), (3.4, 0.0), (4.8, 7.6), (5.6, 7.6), (5.6, 9.4), (4.6, 9.4), (4.2, 7.0), (0.0, 7.0)];
    let pot = Mesh::lathe(PLANT.as_vec3(), Vec3::Y, &clay, 48);
    let solids = [
        ("floor", floor, tiles),
        ("window wall", window_wall(), matt(0.72, 0.68, 0.60)),
        ("walls", plain_walls(), matt(0.74, 0.70, 0.62)),
        ("ceiling", slab([-55.0, 48.0, -53.0], [54.0, 51.0, 57.0]), matt(0.70, 0.68, 0.64)),
        ("beams", beams(), wood),
        ("columns", columns(), matt(0.70, 0.66, 0.60)),
        ("mullions", mullions(), Material::matt(Vec3::new(0.20, 0.13, 0.08))),
        ("stairs", stairs(), matt(0.58, 0.52, 0.46)),
        ("railing", railing(), Material::plastic(Vec3::new(0.10, 0.10, 0.11))),
        ("bench", seat, wood),
        ("pot", pot, Material::plastic(Vec3::new(0.50, 0.22, 0.12))),
    ];
    let mut leaves = Mesh::default();
    for number in 0..26u8 {
        let turn = f64::from(number);
        let part = turn / 25.0;
        leaves.append(
            &Leaf {
                foot: PLANT + DVec3::Y * 7.0,
                bearing: 2.4 * turn,
                rise: 0.5 + 0.95 * part,
                length: 11.0 + 9.0 * part,
                half_width: 1.5,
                droop: 0.55 - 0.4 * part,
            }
            .broad(),
        );
    }
    let sheets = [
        ("awnings", awnings(), matt(0.62, 0.20, 0.12)),
        ("screen", screen(), matt(0.78, 0.72, 0.56)),
        ("leaves", leaves, Material::plastic(Vec3::new(0.12, 0.34, 0.10))),
    ];
    let mut objects: Vec<Object> =
        solids.into_iter().map(|(name, mesh, material)| Object::solid(name, mesh, material)).collect();
    objects
        .extend(sheets.into_iter().map(|(name, mesh, material)| Object::two_sided(name, Shape::Mesh(mesh), material)));
    let to_sun = DVec3::new(-0.80, 0.42, 0.30);
    let sky = Light::directional("sky", DVec3::new(0.35, 0.7, 0.5), DVec3::ZERO, 84.0, 20.0, 260.0, UVec2::splat(16));
    let middle = DVec3::new(-4.0, 20.0, -12.0);
    let sun = Light::directional("sun", to_sun, middle, 96.0, 20.0, 260.0, UVec2::splat(2048));
    Scene {
        name: "walkthrough".into(),
        origin: DVec3::ZERO,
        objects,
        lights: vec![
            sun.expect("a constant view is valid").coloured(Vec3::new(2.6, 2.2, 1.6)),
            Light { casts: false, ..sky.expect("a constant view is valid").coloured(Vec3::new(0.30, 0.32, 0.38)) },
        ],
        ambient: Vec3::new(0.11, 0.115, 0.13),
        background: Vec3::new(0.45, 0.60, 0.80),
        camera: camera([10.0, 19.0, 52.0], [0.0, 15.0, -20.0], 70.0, [1.0, 300.0], UVec2::splat(1024)),
    }
}

/// Where the potted plant stands.
const PLANT: DVec3 = DVec3::new(-37.0, 0.0, -32.0);
