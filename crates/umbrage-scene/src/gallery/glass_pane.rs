use super::SLAB_THICKNESS;
use super::views::{camera, lamp};
use crate::{Material, Mesh, Object, Scene, Shape};
use glam::{DVec3, UVec2, Vec3};

/// What passes red, amber, green and blue glass, linear RGB.
const GLASS: [(&str, Vec3); 4] = [
    ("red", Vec3::new(0.85, 0.06, 0.05)),
    ("amber", Vec3::new(0.90, 0.52, 0.06)),
    ("green", Vec3::new(0.10, 0.62, 0.16)),
    ("blue", Vec3::new(0.08, 0.16, 0.85)),
];

/// A window of coloured glass that stands on a white floor with the light behind it, and a yellow and a cyan pane
/// before it: coloured shadows, and a green one where both lie over one another (Burley 2006).
///
/// Objects: the floor (0), the frame (1), a closed solid, and sheets: red, amber, green and blue panes in it, two by
/// two (2 to 5), the yellow pane (6) and the cyan pane (7), whose shadows overlap each other and the window's. What a
/// pane lets pass is [`Object::passes`]. The floor's top is y = 0. The panes stand between light 0 and the part of the
/// floor that the camera sees before them; the map is 512 × 512, the picture 1024 × 1024.
///
/// # Panics
/// Never: the views are constants.
pub fn glass_pane() -> Scene {
    let floor = Mesh::cuboid(Vec3::new(-80.0, -SLAB_THICKNESS, -50.0), Vec3::new(80.0, 0.0, 90.0));
    let mut objects = vec![
        Object::solid("floor", floor, Material::matt(Vec3::splat(0.85))),
        Object::solid("frame", frame(), Material::plastic(Vec3::new(0.30, 0.18, 0.09))),
    ];
    for (place, (colour, passes)) in (0u8..).zip(GLASS) {
        let (left, low) = (-24.0 + 24.0 * f32::from(place % 2), 3.0 + 20.0 * f32::from(place / 2));
        // Edges end inside the frame.
        let upright = [(-0.5, -0.5), (24.5, -0.5), (24.5, 20.5), (-0.5, 20.5)];
        let corners = upright.map(|(x, y)| Vec3::new(left + x, low + y, -20.0));
        objects.push(pane(&format!("{colour} pane"), corners, passes));
    }
    let leaning = |x: f32, z: f32, turn: f32| {
        let across = Vec3::new(turn.cos(), 0.0, turn.sin()) * 18.0;
        let up = Vec3::new(0.0, 22.0, -4.0);
        let foot = Vec3::new(x, 0.0, z);
        [foot, foot + across, foot + across + up, foot + up]
    };
    objects.push(pane("yellow pane", leaning(24.0, 4.0, -0.25), Vec3::new(0.90, 0.85, 0.06)));
    objects.push(pane("cyan pane", leaning(33.0, -6.0, -0.25), Vec3::new(0.06, 0.80, 0.85)));
    Scene {
        name: "glass-pane".into(),
        origin: DVec3::ZERO,
        objects,
        lights: vec![lamp(DVec3::new(-40.0, 110.0, -120.0), DVec3::new(8.0, 10.0, 4.0), 42.0, [60.0, 320.0], 512)],
        ambient: Vec3::splat(0.14),
        background: Vec3::new(0.02, 0.02, 0.03),
        camera: camera([30.0, 84.0, 128.0], [18.0, 5.0, 6.0], 47.0, [20.0, 400.0], UVec2::splat(1024)),
    }
}

fn pane(name: &str, corners: [Vec3; 4], passes: Vec3) -> Object {
    let surface = Material { diffuse: passes * 0.35, specular: Vec3::splat(0.3), shininess: 60.0 };
    Object { passes, ..Object::two_sided(name, Shape::Mesh(Mesh::sheet(corners, 1)), surface) }
}

/// Two uprights and a mullion, a sill, a bar and a lintel; each ends inside others.
fn frame() -> Mesh {
    let mut mesh = Mesh::default();
    for (middle, half) in [(-24.0, 1.5), (0.0, 0.9), (24.0, 1.5)] {
        mesh.append(&Mesh::cuboid(Vec3::new(middle - half, 0.0, -21.5), Vec3::new(middle + half, 45.0, -18.5)));
    }
    for (middle, half) in [(2.0, 1.4), (23.0, 0.8), (43.0, 1.2)] {
        mesh.append(&Mesh::cuboid(Vec3::new(-24.5, middle - half, -21.2), Vec3::new(24.5, middle + half, -18.8)));
    }
    mesh
}
