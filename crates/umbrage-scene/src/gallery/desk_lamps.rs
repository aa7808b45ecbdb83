use super::lamp::{CONE_DEG, Lamp, MAP_DEG, Pose};
use crate::{Light, Material, Mesh, Object, Scene};
use glam::{DVec3, UVec2, Vec3};
use umbrage_plane::View;

/// Radius of the ball, world units.
const BALL: f32 = 6.0;

/// Two desk lamps and a ball on a wooden table, lit by both lamps and from overhead, after the film frame of Reeves,
/// Salesin & Cook 1987, Figure 12.
///
/// Objects 0 to 2 are the table's boards in three tones, the ground that is left out of the maps: it receives but does not cast.
/// Then come each lamp's frame, shade, lining and bulb (big 3 to 6, small 7 to 10), the ball (11) and its band (12).
/// Linings and bulbs neither cast nor receive: they glow. Lights 0 and 1 are the big and the small lamp's spots, inside their shades, whose rims bound the light;
/// light 2 is overhead. All cast; their maps are 2048 × 2048, 1024 × 1024 and 1024 × 1024. The table is y = 0 and the
/// picture 1024 × 1024.
///
/// # Panics
/// Never: the views are constants.
pub fn desk_lamps() -> Scene {
    let big = Pose {
        scale: 1.0,
        foot: DVec3::new(-30.0, 0.0, -6.0),
        heading: -0.30,
        elbow: Vec3::new(-9.0, 25.0, 0.0),
        neck: Vec3::new(9.0, 43.0, 0.0),
        look: Vec3::new(0.66, -0.82, 0.16),
    }
    .lamp();
    let small = Pose {
        scale: 0.56,
        foot: DVec3::new(31.0, 0.0, 2.0),
        heading: 3.55,
        elbow: Vec3::new(-10.0, 19.0, 0.0),
        neck: Vec3::new(5.0, 34.0, 0.0),
        look: Vec3::new(0.82, -0.63, -0.20),
    }
    .lamp();
    let middle = Vec3::new(4.0, BALL, 10.0);
    let overhead = Light::point(
        "overhead",
        DVec3::new(10.0, 150.0, 75.0),
        DVec3::new(0.0, 14.0, 0.0),
        44.0,
        40.0,
        320.0,
        UVec2::splat(1024),
    )
    .expect("a constant view is valid");
    let lights = vec![
        spot("big lamp", &big, 2048).coloured(Vec3::new(0.88, 0.80, 0.62)),
        spot("small lamp", &small, 1024).coloured(Vec3::new(0.55, 0.48, 0.36)),
        overhead.coloured(Vec3::new(0.17, 0.20, 0.27)),
    ];
    let camera = View::perspective(
        DVec3::new(10.0, 54.0, 122.0),
        DVec3::new(1.0, 15.5, 0.0),
        DVec3::Y,
        38f64.to_radians(),
        20.0,
        600.0,
        UVec2::splat(1024),
    )
    .expect("a constant view is valid");
    let mut objects = boards();
    let paint = |diffuse: Vec3| Material { diffuse, specular: Vec3::splat(0.40), shininess: 60.0 };
    for (name, lamp, colour) in
        [("big", big, Vec3::new(0.62, 0.64, 0.66)), ("small", small, Vec3::new(0.62, 0.64, 0.66))]
    {
        objects.push(Object::solid(&format!("{name} lamp"), lamp.frame, paint(colour * 0.8)));
        objects.push(Object::solid(&format!("{name} shade"), lamp.shade, paint(colour)));
        for (part, mesh, colour) in [("lining", lamp.lining, colour), ("bulb", lamp.bulb, Vec3::new(1.0, 1.0, 0.96))] {
            let glowing = Object::solid(&format!("{name} {part}"), mesh, Material::matt(colour));
            objects.push(Object { casts: false, receives: false, ..glowing });
        }
    }
    objects.push(Object::solid("ball", Mesh::sphere(middle, BALL, Mesh::FINE), paint(Vec3::new(0.06, 0.34, 0.40))));
    objects.push(Object::solid("ball band", band(middle), paint(Vec3::new(0.80, 0.62, 0.16))));
    Scene {
        name: "desk-lamps".into(),
        origin: DVec3::ZERO,
        objects,
        lights,
        ambient: Vec3::new(0.035, 0.035, 0.045),
        background: Vec3::new(0.004, 0.005, 0.008),
        camera,
    }
}

fn spot(name: &str, lamp: &Lamp, size: u32) -> Light {
    // The near plane lies before everything that the map's corners see of the shade.
    let ahead = lamp.filament + lamp.toward;
    let mut light = Light::spot(name, lamp.filament, ahead, MAP_DEG, 1.0, 400.0, UVec2::splat(size))
        .expect("a constant view is valid");
    // Beyond its map all that receives is dark; what does not, the lining, is lit as far as the cone goes.
    let cos_half = (0.5 * CONE_DEG.to_radians()).cos();
    light.view = light.view.with_cone(Some(cos_half)).expect("a constant view is valid");
    light
}

/// A sash around the ball, a little proud of it.
fn band(middle: Vec3) -> Mesh {
    const STEPS: u8 = 8;
    let at = |step: u8, radius: f32| {
        let (sin, cos) = (0.24 * (f32::from(step) / f32::from(STEPS) * 2.0 - 1.0)).sin_cos();
        (radius * cos, radius * sin)
    };
    let outside = (0..=STEPS).map(|step| at(step, BALL + 0.05));
    let inside = (0..=STEPS).rev().map(|step| at(step, BALL - 0.4));
    let profile: Vec<(f32, f32)> = outside.chain(inside).collect();
    Mesh::lathe(middle, Vec3::new(0.45, 0.75, 0.35), &profile, Mesh::FINE)
}

/// Boards along x, sawn at different lengths, in three tones.
fn boards() -> Vec<Object> {
    const WIDTH: f32 = 13.0;
    let mut tones: [Mesh; 3] = Default::default();
    for row in -10..=7i16 {
        let low = f32::from(row) * WIDTH;
        let shift = f32::from((row * 47).rem_euclid(90));
        for piece in -3..=2i16 {
            let left = f32::from(piece) * 90.0 + shift;
            let board = Mesh::cuboid(Vec3::new(left, -3.0, low), Vec3::new(left + 89.8, 0.0, low + WIDTH - 0.2));
            tones[(row * 5 + piece * 2 + row * row).rem_euclid(3) as usize].append(&board);
        }
    }
    let colours = [Vec3::new(0.38, 0.21, 0.10), Vec3::new(0.33, 0.18, 0.085), Vec3::new(0.42, 0.245, 0.125)];
    let named = ["ground", "ground, dark boards", "ground, light boards"].into_iter().zip(colours);
    let varnish = |diffuse: Vec3| Material { diffuse, specular: Vec3::splat(0.06), shininess: 25.0 };
    named
        .zip(tones)
        .map(|((name, colour), mesh)| Object { casts: false, ..Object::solid(name, mesh, varnish(colour)) })
        .collect()
}
