use super::pins::{ball, pin};
use super::views::{camera, lamp};
use crate::{Material, Mesh, Object, Scene};
use glam::{DVec3, UVec2, Vec3};

/// Number of the last frame of [`bowling`]; the first is 0.
pub const BOWLING_FRAMES: u32 = 24;

/// A bowling ball rolls in and scatters the pins, after the film that Wang & Molnar 1994, Figure 15, is a still of.
///
/// `frame` is 0..=[`BOWLING_FRAMES`]; later ones are the last. At 0 all pins stand and the ball rolls; it meets the
/// head pin at 8. What does not move is the same, bit for bit, in all frames: the lane (object 0), whose top is y = 0,
/// the gutters (1), the side walls (2) and the curtain at the back (3). Then the ball (4), and each pin with its two
/// stripes as a body and a band of red, `pin 1` to `pin 10` (5, 7, .. 23) and `stripes 1` to `stripes 10` (6, 8, ..
/// 24), in the usual numbers. All is closed. One world unit is an inch, and sizes are the rules'. Pins move by simple
/// curves that keep them apart, not by mechanics.
///
/// Light 0 is at upper right before the pins, with a map of 512 × 512. The picture is not square: 640 × 512.
///
/// # Panics
/// Never: the views are constants.
pub fn bowling(frame: u32) -> Scene {
    let frame = frame.min(BOWLING_FRAMES) as f32;
    let mut objects = alley();
    let polish =
        |r: f32, g: f32, b: f32| Material { diffuse: Vec3::new(r, g, b), specular: Vec3::splat(0.5), shininess: 80.0 };
    objects.push(Object::solid("ball", ball(frame), polish(0.05, 0.10, 0.36)));
    for number in 1..=10 {
        let [body, stripes] = pin(number, frame);
        objects.push(Object::solid(&format!("pin {number}"), body, polish(0.82, 0.80, 0.74)));
        objects.push(Object::solid(&format!("stripes {number}"), stripes, polish(0.70, 0.05, 0.05)));
    }
    Scene {
        name: "bowling".into(),
        origin: DVec3::ZERO,
        objects,
        lights: vec![lamp(DVec3::new(34.0, 92.0, 64.0), DVec3::new(0.0, 2.0, 0.0), 68.0, [30.0, 220.0], 512)],
        ambient: Vec3::splat(0.13),
        background: Vec3::new(0.012, 0.010, 0.014),
        camera: camera([-15.0, 34.0, 74.0], [0.0, 2.0, -1.0], 50.0, [10.0, 300.0], UVec2::new(640, 512)),
    }
}

/// Half the lane's width and half that with its gutters, world units.
const LANE: f32 = 21.0;
const WALLS: f32 = 30.25;

/// All that does not move.
fn alley() -> Vec<Object> {
    let slab = |min: [f32; 3], max: [f32; 3]| Mesh::cuboid(min.into(), max.into());
    // Before the pins run gutters; beside them the deck goes on from wall to wall. Pieces run into one another by a little.
    let mut lane = slab([-LANE, -4.0, 13.0], [LANE, 0.0, 76.0]);
    lane.append(&slab([-WALLS, -4.5, -55.0], [WALLS, 0.0, 13.5]));
    let mut gutters = Mesh::default();
    let mut walls = Mesh::default();
    for side in [-1.0, 1.0] {
        let piece = |x: [f32; 2], y: [f32; 2], z: [f32; 2]| {
            let (a, b) = (Vec3::new(side * x[0], y[0], z[0]), Vec3::new(side * x[1], y[1], z[1]));
            Mesh::cuboid(a.min(b), a.max(b))
        };
        gutters.append(&piece([LANE - 1.0, WALLS + 0.5], [-4.4, -2.8], [13.0, 76.2]));
        walls.append(&piece([WALLS, WALLS + 2.0], [-5.0, 24.0], [-58.0, 18.0]));
        walls.append(&piece([WALLS - 0.3, WALLS + 2.2], [-4.6, 1.2], [13.2, 76.4]));
    }
    let curtain = slab([-WALLS - 1.0, -8.0, -59.0], [WALLS + 1.0, 28.0, -56.0]);
    let maple = Material { diffuse: Vec3::new(0.62, 0.40, 0.20), specular: Vec3::splat(0.10), shininess: 60.0 };
    vec![
        Object::solid("lane", lane, maple),
        Object::solid("gutters", gutters, Material::matt(Vec3::new(0.20, 0.20, 0.22))),
        Object::solid("side walls", walls, Material::matt(Vec3::new(0.26, 0.30, 0.36))),
        Object::solid("curtain", curtain, Material::matt(Vec3::new(0.20, 0.10, 0.12))),
    ]
}
