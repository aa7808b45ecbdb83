//! A bicycle of tubes, rings and thin spokes.

use crate::Mesh;
use glam::{DMat4, DVec3, Vec3};
use std::f32::consts::{PI, TAU};

/// A bicycle's closed meshes by material, in a space of its own: it stands on y = 0 and rides along +x, its middle at x = 0;
/// 38 units long, 21 high.
pub(super) struct Bicycle {
    /// Painted tubes.
    pub(super) frame: Mesh,
    /// Tyres, saddle, grips and pedals.
    pub(super) rubber: Mesh,
    /// Rims, spokes, hubs, bars, cranks and chain.
    pub(super) metal: Mesh,
}

/// Spokes of a wheel, every second one to the other flange of its hub.
const SPOKES: u16 = 32;
/// Outer radius of a wheel, tyre included.
pub(super) const WHEEL: f32 = 7.6;

const REAR: Vec3 = Vec3::new(-11.2, WHEEL, 0.0);
const FRONT: Vec3 = Vec3::new(12.0, WHEEL, 0.0);
const CRANK: Vec3 = Vec3::new(-1.2, 6.4, 0.0);
const SEAT: Vec3 = Vec3::new(-4.6, 17.0, 0.0);
const HEAD_TOP: Vec3 = Vec3::new(8.3, 17.6, 0.0);
const HEAD_LOW: Vec3 = Vec3::new(9.2, 14.4, 0.0);

/// A bicycle; `drop_bars` bends its handlebar forward and down instead of back.
pub(super) fn bicycle(drop_bars: bool) -> Bicycle {
    let (mut rubber, mut metal) = wheel();
    let (tyre, spokes) = (rubber.clone(), metal.clone());
    let at = |place: Vec3, turn: f64| DMat4::from_translation(place.as_dvec3()) * DMat4::from_rotation_z(turn);
    rubber = rubber.transformed(&at(REAR, 0.1));
    metal = metal.transformed(&at(REAR, 0.1));
    rubber.append(&tyre.transformed(&at(FRONT, 0.03)));
    metal.append(&spokes.transformed(&at(FRONT, 0.03)));
    drive(&mut metal, &mut rubber);
    handlebar(&mut metal, &mut rubber, drop_bars);
    rubber.append(&saddle(SEAT + Vec3::new(-0.8, 2.0, 0.0)));
    metal.append(&Mesh::tube(&[SEAT, SEAT + Vec3::new(-0.5, 1.7, 0.0)], 0.30, 16));
    Bicycle { frame: frame(), rubber, metal }
}

/// A wheel about the z axis, its hub at the origin: the tyre, and the rim with spokes and hub.
pub(super) fn wheel() -> (Mesh, Mesh) {
    const TYRE: f32 = 0.42;
    const RIM: f32 = WHEEL - 2.0 * TYRE;
    let tyre = Mesh::torus(Vec3::ZERO, Vec3::Z, WHEEL - TYRE, TYRE, 72);
    let rim = [(RIM - 0.30, -0.18), (RIM + 0.10, -0.30), (RIM + 0.15, 0.0), (RIM + 0.10, 0.30), (RIM - 0.30, 0.18)];
    let mut metal = Mesh::lathe(Vec3::ZERO, Vec3::Z, &rim, 96);
    metal.append(&Mesh::lathe(Vec3::ZERO, Vec3::Z, &HUB, 24));
    for spoke in 0..SPOKES {
        let side = if spoke % 2 == 0 { 1.0 } else { -1.0 };
        let angle = TAU * f32::from(spoke) / f32::from(SPOKES);
        // Spokes leave the flange nearly along its rim, two this way, two that way.
        let lead = if spoke % 4 < 2 { 0.9 } else { -0.9 };
        let at = |radius: f32, angle: f32, z: f32| Vec3::new(radius * angle.cos(), radius * angle.sin(), z);
        let (inner, outer) = (at(0.66, angle + lead, 0.62 * side), at(RIM - 0.2, angle, 0.05 * side));
        metal.append(&Mesh::tube(&[inner, outer], 0.05, 6));
    }
    (tyre, metal)
}

const HUB: [(f32, f32); 14] = [
    (0.0, -1.1),
    (0.22, -1.1),
    (0.22, -0.72),
    (0.75, -0.70),
    (0.75, -0.56),
    (0.36, -0.50),
    (0.28, 0.0),
    (0.36, 0.50),
    (0.75, 0.56),
    (0.75, 0.70),
    (0.22, 0.72),
    (0.22, 1.1),
    (0.12, 1.12),
    (0.0, 1.12),
];

fn frame() -> Mesh {
    let mut mesh = Mesh::default();
    let mut tube = |path: &[Vec3], radius: f32| mesh.append(&Mesh::tube(path, radius, 20));
    let down = HEAD_LOW + Vec3::new(-0.1, 0.5, 0.0);
    tube(&[CRANK, down], 0.50);
    tube(&[SEAT + Vec3::new(0.2, -0.8, 0.0), HEAD_TOP + Vec3::new(0.1, -0.6, 0.0)], 0.42);
    tube(&[CRANK + Vec3::new(0.0, -0.2, 0.0), SEAT], 0.44);
    tube(&[HEAD_LOW + Vec3::new(0.06, -0.2, 0.0), HEAD_TOP + Vec3::new(-0.06, 0.2, 0.0)], 0.56);
    tube(&[CRANK - Vec3::Z * 1.1, CRANK + Vec3::Z * 1.1], 0.62);
    for side in [-1.0, 1.0] {
        let aside = Vec3::Z * side;
        tube(&[CRANK + aside * 0.5, CRANK + Vec3::new(-2.6, 0.3, 0.85 * side), REAR + aside * 0.95], 0.24);
        tube(
            &[SEAT + Vec3::new(0.1, -0.6, 0.3 * side), SEAT + Vec3::new(-1.6, -3.4, 0.85 * side), REAR + aside * 0.95],
            0.22,
        );
        // The fork: out of the crown, straight down, and forward at the end.
        let crown = HEAD_LOW + Vec3::new(0.1, -0.3, 0.0);
        let blade = (0..=8u8).map(|step| {
            let part = f32::from(step) / 8.0;
            crown.lerp(FRONT, part)
                + Vec3::new(-1.1 * part * (1.0 - part) * 2.0 * part, 0.0, 0.9 * side * (part * 6.0).min(1.0))
        });
        tube(&blade.collect::<Vec<_>>(), 0.26);
    }
    mesh
}

fn drive(metal: &mut Mesh, rubber: &mut Mesh) {
    const RING: f32 = 1.7;
    let aside = Vec3::Z * 0.95;
    let cog = |radius: f32| [(radius - 0.35, -0.08), (radius, -0.08), (radius, 0.08), (radius - 0.35, 0.08)];
    metal.append(&Mesh::lathe(CRANK + aside, Vec3::Z, &cog(RING), 64));
    metal.append(&Mesh::lathe(REAR + aside, Vec3::Z, &cog(0.8), 40));
    for arm in 0..5u8 {
        let (sin, cos) = (TAU * f32::from(arm) / 5.0 + 0.3).sin_cos();
        metal.append(&Mesh::tube(&[CRANK + aside, CRANK + aside + Vec3::new(cos, sin, 0.0) * (RING - 0.2)], 0.13, 10));
    }
    for side in [1.0, -1.0] {
        let reach = side * 0.5;
        let (out, crank) = (Vec3::Z * (1.35 * side), Vec3::new(3.2 * reach.cos() * side, -3.2 * 0.38 * side, 0.0));
        metal.append(&Mesh::tube(&[CRANK + out, CRANK + out + crank], 0.22, 16));
        let pedal = CRANK + out * 1.9 + crank;
        metal.append(&Mesh::tube(&[CRANK + out * 1.05 + crank, pedal], 0.14, 12));
        rubber.append(&Mesh::cuboid(pedal - Vec3::new(0.8, 0.22, 0.75), pedal + Vec3::new(0.8, 0.22, 0.75)));
        // The chain's two straight runs.
        let run = Vec3::Y * side;
        metal.append(&Mesh::tube(&[CRANK + aside + run * RING, REAR + aside + run * 0.8], 0.09, 8));
    }
}

fn handlebar(metal: &mut Mesh, rubber: &mut Mesh, drop: bool) {
    let stem = HEAD_TOP + Vec3::new(-0.45, 1.7, 0.0);
    let clamp = stem + Vec3::new(1.5, 0.3, 0.0);
    metal.append(&Mesh::tube(&[HEAD_TOP, stem], 0.30, 16));
    metal.append(&Mesh::tube(&[stem - Vec3::Y * 0.1, clamp], 0.28, 16));
    for side in [-1.0, 1.0] {
        let bend = |step: u8| {
            let part = f32::from(step) / 12.0;
            if drop {
                let angle = PI * part * 1.05;
                clamp + Vec3::new(2.2 * angle.sin(), 1.2 * (angle.cos() - 1.0), 3.6 * side * (part * 3.0).min(1.0))
            } else {
                let back = part * part;
                clamp + Vec3::new(-3.4 * back, 1.3 * part - 0.5 * back, side * (5.2 * part - 0.5 * back))
            }
        };
        let path: Vec<Vec3> = (0..=12).map(bend).collect();
        // A nudge apart in the middle, where both halves start.
        metal.append(&Mesh::tube(&path, 0.22 - 0.005 * side, 14));
        rubber.append(&Mesh::tube(&path[if drop { 6 } else { 9 }..], 0.33, 16));
    }
}

/// A saddle whose middle is at `at`: a drop, nose first, pressed flat.
fn saddle(at: Vec3) -> Mesh {
    const STEPS: u8 = 20;
    let outline = |step: u8| {
        let part = f32::from(step) / f32::from(STEPS);
        let full = 0.42 + 1.05 / (1.0 + (14.0 * (part - 0.42)).exp());
        let ends = (1.0 - (2.0 * part - 1.0).powi(8)).max(0.0).sqrt();
        (if step.is_multiple_of(STEPS) { 0.0 } else { full * ends }, 5.0 * part - 2.5)
    };
    let profile: Vec<(f32, f32)> = (0..=STEPS).map(outline).collect();
    let pressed = DMat4::from_translation(at.as_dvec3()) * DMat4::from_scale(DVec3::new(1.0, 0.42, 1.0));
    Mesh::lathe(Vec3::ZERO, Vec3::X, &profile, 32).transformed(&pressed)
}
