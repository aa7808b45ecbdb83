//! A desk lamp on two sprung arms.

use crate::Mesh;
use glam::{DMat4, DVec3, Vec3};
use std::f32::consts::TAU;

/// A lamp's meshes in world space, and where it shines. All are closed.
pub(super) struct Lamp {
    /// Base, arms, joints and springs.
    pub(super) frame: Mesh,
    /// Shade with its socket, as thick as sheet metal.
    pub(super) shade: Mesh,
    /// A thin reflector all over the inside of the shade.
    pub(super) lining: Mesh,
    /// The bulb. Its shading normals point inward: glass that is lit from within.
    pub(super) bulb: Mesh,
    /// Where the filament is: at the bulb's back, so that nearly all of the bulb is before it.
    pub(super) filament: DVec3,
    /// Unit direction in which the shade opens.
    pub(super) toward: DVec3,
}

/// How a lamp stands. In its own space the foot is at the origin, the arms move in the x, y plane and look along +x;
/// lengths are those of a lamp about 45 units tall.
pub(super) struct Pose {
    /// Factor on all lengths.
    pub(super) scale: f64,
    /// World place of the foot.
    pub(super) foot: DVec3,
    /// Turn about the vertical; positive turns the look from +x toward the far side, −z.
    pub(super) heading: f64,
    /// Joint between the arms.
    pub(super) elbow: Vec3,
    /// Joint between the upper arm and the head.
    pub(super) neck: Vec3,
    /// Direction of the head (any length but 0).
    pub(super) look: Vec3,
}

/// Full angle of a map at the filament, degrees: it just holds the opening of the shade, so that it is the rim that
/// bounds what leaves the lamp.
pub(super) const MAP_DEG: f64 = 80.0;

/// Full angle of the light itself, degrees: it reaches the lining too.
pub(super) const CONE_DEG: f64 = 120.0;

/// Radius of the foot.
const FOOT: f32 = 8.5;
/// Behind the filament lies the shade's apex, before it the rim, which it sees at 39° from the axis.
const FILAMENT: f32 = 0.6;

impl Pose {
    pub(super) fn lamp(&self) -> Lamp {
        let placed = DMat4::from_translation(self.foot)
            * DMat4::from_rotation_y(self.heading)
            * DMat4::from_scale(DVec3::splat(self.scale));
        let look = self.look.normalize();
        let apex = self.neck + look * 2.0;
        let mut bulb = Mesh::sphere(apex + look * (FILAMENT + 2.5), 2.5, 64);
        for normal in &mut bulb.normals {
            *normal = -*normal;
        }
        let socket = Mesh::lathe(apex, look, &SOCKET, 64);
        let mut shade = Mesh::lathe(apex, look, &SHADE, 192);
        shade.append(&socket);
        Lamp {
            frame: self.frame(look).transformed(&placed),
            shade: shade.transformed(&placed),
            lining: Mesh::lathe(apex, look, &lining(), 192).transformed(&placed),
            bulb: bulb.transformed(&placed),
            filament: placed.transform_point3((apex + look * FILAMENT).as_dvec3()),
            toward: placed.transform_vector3(look.as_dvec3()).normalize(),
        }
    }

    fn frame(&self, look: Vec3) -> Mesh {
        let hip = Vec3::new(0.0, 4.2, 0.0);
        let mut mesh = Mesh::lathe(Vec3::ZERO, Vec3::Y, &BASE, 128);
        let mut add = |part: &Mesh| mesh.append(part);
        let pin =
            |at: Vec3, radius: f32, half: f32| Mesh::cylinder(at - Vec3::Z * half, at + Vec3::Z * half, radius, 32);
        add(&pin(hip, 1.3, 1.7));
        add(&pin(self.elbow, 1.6, 2.0));
        add(&pin(self.elbow, 0.7, 2.5));
        add(&pin(self.neck, 1.2, 1.6));
        add(&Mesh::tube(&[self.neck - look * 1.5, self.neck + look * 1.6], 1.1, 32));
        for side in [-1.2, 1.2] {
            let aside = Vec3::Z * side;
            add(&Mesh::tube(&[hip + aside, self.elbow + aside * 1.2], 0.42, 20));
            add(&Mesh::tube(&[self.elbow + aside, self.neck + aside * 0.9], 0.42, 20));
            let behind = Vec3::new(-2.0, 0.3, 0.0) + aside * 0.5;
            add(&Mesh::tube(&[hip + behind, self.elbow + behind], 0.30, 16));
            let above = Vec3::new(-0.9, 1.9, 0.0) + aside * 0.5;
            add(&Mesh::tube(&[self.elbow + above, self.neck + above], 0.30, 16));
            let along = self.elbow - hip;
            add(&spring(hip + along * 0.12 + aside * 1.9, hip + along * 0.62 + aside * 1.9));
            let along = self.neck - self.elbow;
            add(&spring(self.elbow + along * 0.08 + aside * 1.7, self.elbow + along * 0.45 + aside * 1.7));
        }
        // Plates that the parallel rods are hinged on.
        for (at, reach) in [
            (hip, Vec3::new(-2.0, 0.3, 0.0)),
            (self.elbow, Vec3::new(-2.0, 0.3, 0.0)),
            (self.elbow, Vec3::new(-0.9, 1.9, 0.0)),
            (self.neck, Vec3::new(-0.9, 1.9, 0.0)),
        ] {
            add(&Mesh::tube(&[at, at + reach * 1.15], 0.75, 20));
        }
        mesh
    }
}

const BASE: [(f32, f32); 10] = [
    (0.0, 0.0),
    (FOOT - 0.4, 0.0),
    (FOOT, 0.4),
    (FOOT, 1.2),
    (FOOT - 0.6, 1.7),
    (FOOT - 2.2, 2.1),
    (2.6, 2.7),
    (1.6, 3.2),
    (1.5, 4.4),
    (0.0, 4.4),
];

const SOCKET: [(f32, f32); 6] = [(0.0, -2.6), (1.9, -2.6), (2.3, -2.2), (2.3, -0.2), (1.8, 0.4), (0.0, 0.4)];

/// Out along the back, round the rim and home along the inside.
const SHADE: [(f32, f32); 17] = [
    (0.0, -2.0),
    (2.9, -2.0),
    (3.3, -1.5),
    (3.5, 0.6),
    (4.5, 2.2),
    (6.1, 3.8),
    (7.4, 5.8),
    (8.4, 8.2),
    (9.4, 11.6),
    (9.0, 11.6),
    (8.0, 8.2),
    (7.0, 6.0),
    (5.7, 4.2),
    (4.0, 2.5),
    (3.0, 0.8),
    (2.5, -0.6),
    (0.0, -0.6),
];

/// Along the shade's inside, home a little nearer to its axis.
fn lining() -> Vec<(f32, f32)> {
    // What the shade's profile has between its rim and its back, from the back.
    let inside = || SHADE[10..=14].iter().rev().copied().chain([(8.93, 11.3)]);
    let nearer = |by: f32| inside().map(move |(radius, height)| (radius - by, height));
    nearer(0.06).chain(nearer(0.12).collect::<Vec<_>>().into_iter().rev()).collect()
}

/// A coil between two points.
fn spring(from: Vec3, to: Vec3) -> Mesh {
    const TURNS: u16 = 13;
    const STEPS: u16 = 12;
    let (across, up) = (to - from).normalize().any_orthonormal_pair();
    let at = |step: u16| {
        let part = f32::from(step) / f32::from(TURNS * STEPS);
        let (sin, cos) = (TAU * f32::from(step) / f32::from(STEPS)).sin_cos();
        from.lerp(to, part) + (across * cos + up * sin) * 0.62
    };
    let path: Vec<Vec3> = (0..=TURNS * STEPS).map(at).collect();
    Mesh::tube(&path, 0.13, 8)
}
