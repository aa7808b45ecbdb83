//! Parts of the hall of the walkthrough. Its inside is −50..=50 wide (x), −48..=54 deep (z) and 48 high.

use super::curved::curved;
use crate::Mesh;
use glam::{DVec3, Vec3};
use std::f64::consts::FRAC_PI_2;

/// Windows of the left wall: least and greatest z of each.
const WINDOWS: [[f32; 2]; 3] = [[-38.0, -22.0], [-10.0, 6.0], [18.0, 34.0]];
/// Height of their sills.
const SILL: f32 = 7.0;
/// Height of their tops.
const TOP: f32 = 38.0;
/// The left wall, from outside to inside.
const WALL: [f32; 2] = [-54.0, -50.0];
/// Height of a step.
const RISE: f32 = 2.2;
/// Depth of a step.
const GOING: f32 = 4.2;
/// Number of steps.
const STEPS: u8 = 10;

fn slab(min: [f32; 3], max: [f32; 3]) -> Mesh {
    Mesh::cuboid(min.into(), max.into())
}

/// The left wall: piers, and between them what is below and above each window, a little thinner and run into the
/// piers.
pub(super) fn window_wall() -> Mesh {
    let mut mesh = Mesh::default();
    let starts = [-52.0].into_iter().chain(WINDOWS.map(|window| window[1]));
    let ends = WINDOWS.map(|window| window[0]).into_iter().chain([56.0]);
    for (start, end) in starts.zip(ends) {
        mesh.append(&slab([WALL[0], -1.0, start], [WALL[1], 50.0, end]));
    }
    for [start, end] in WINDOWS {
        mesh.append(&slab([WALL[0] + 0.3, -0.9, start - 0.5], [WALL[1] - 0.3, SILL, end + 0.5]));
        mesh.append(&slab([WALL[0] + 0.2, TOP, start - 0.6], [WALL[1] - 0.2, 49.0, end + 0.6]));
    }
    mesh
}

/// Frames and bars of the windows, 0.7 thin.
pub(super) fn mullions() -> Mesh {
    let mut mesh = Mesh::default();
    let [middle, half] = [0.5 * (WALL[0] + WALL[1]), 0.35];
    for [start, end] in WINDOWS {
        for part in 1..=3u8 {
            let z = start + (end - start) * f32::from(part) / 4.0;
            mesh.append(&slab([middle - half, SILL - 0.3, z - half], [middle + half, TOP + 0.3, z + half]));
        }
        for part in 1..=5u8 {
            let y = SILL + (TOP - SILL) * f32::from(part) / 6.0;
            mesh.append(&slab([middle - 0.3, y - half, start - 0.3], [middle + 0.3, y + half, end + 0.3]));
        }
    }
    mesh
}

/// The back wall with its doorway, the right wall, the wall behind the camera, and the court's wall beyond the
/// doorway.
pub(super) fn plain_walls() -> Mesh {
    let mut mesh = slab([-53.0, -1.2, -52.0], [-10.0, 49.5, -48.0]);
    mesh.append(&slab([6.0, -1.2, -52.0], [53.5, 49.4, -48.0]));
    mesh.append(&slab([-10.5, 27.0, -51.7], [6.5, 49.3, -48.3]));
    mesh.append(&slab([50.0, -1.4, -51.0], [53.8, 49.6, 56.5]));
    mesh.append(&slab([-53.2, -1.6, 54.0], [53.4, 49.7, 56.8]));
    mesh.append(&slab([-62.0, -1.8, -82.0], [52.0, 22.0, -79.0]));
    mesh
}

/// Beams across, under the ceiling.
pub(super) fn beams() -> Mesh {
    let mut mesh = Mesh::default();
    for beam in 0..6u8 {
        let z = -38.0 + 16.0 * f32::from(beam);
        mesh.append(&slab([-50.6, 43.6, z - 1.4], [50.6, 48.6, z + 1.4]));
    }
    mesh.append(&slab([21.4, 41.4, -48.6], [24.6, 44.2, 54.6]));
    mesh
}

/// Three turned columns under the long beam.
pub(super) fn columns() -> Mesh {
    let profile = [
        (0.0, -0.5),
        (3.6, -0.5),
        (3.6, 1.6),
        (3.1, 2.2),
        (3.3, 3.0),
        (2.5, 3.8),
        (2.1, 36.0),
        (2.6, 36.6),
        (2.3, 37.4),
        (3.6, 40.0),
        (3.6, 42.0),
        (0.0, 42.0),
    ];
    let mut mesh = Mesh::default();
    for z in [-40.0, -20.0, 0.0] {
        mesh.append(&Mesh::lathe(Vec3::new(23.0, 0.0, z), Vec3::Y, &profile, 48));
    }
    mesh
}

/// How far forward step `step` begins, z.
fn front(step: u8) -> f32 {
    8.0 - GOING * f32::from(step)
}

/// Steps along the right wall and the landing at their end; each is solid down to the floor and runs under the next.
pub(super) fn stairs() -> Mesh {
    let mut mesh = Mesh::default();
    for step in 0..STEPS {
        let (z, inset) = (front(step), 0.02 * f32::from(step));
        let back = if step + 1 == STEPS { -48.5 } else { z - GOING - 0.5 };
        let top = RISE * f32::from(step + 1);
        mesh.append(&slab([31.0 + inset, -0.5 - inset, back], [50.5 + inset, top, z]));
    }
    mesh
}

/// A baluster on each step, and the rail over them.
pub(super) fn railing() -> Mesh {
    let (x, height) = (32.2, 9.0);
    let mut mesh = Mesh::default();
    for step in 0..STEPS {
        for half in [0.25, 0.75] {
            let z = front(step) - GOING * half;
            let foot = Vec3::new(x, RISE * f32::from(step + 1) - 0.2, z);
            let top = foot.y + height + RISE * (half - 0.75);
            mesh.append(&Mesh::cylinder(foot, foot.with_y(top), 0.28, 10));
        }
    }
    let rail = |step: f32| Vec3::new(x, RISE * (step + 0.25) + height, 8.0 - GOING * step);
    mesh.append(&Mesh::tube(&[rail(-0.3), rail(f32::from(STEPS))], 0.5, 16));
    mesh
}

/// Awnings over the windows outside: a quarter of a cylinder's wall each.
pub(super) fn awnings() -> Mesh {
    let mut mesh = Mesh::default();
    for [start, end] in WINDOWS {
        let (near, far) = (f64::from(end) + 1.0, f64::from(start) - 1.0);
        mesh.append(&curved(1, 12, |u, v| {
            let (sin, cos) = (FRAC_PI_2 * v).sin_cos();
            DVec3::new(-54.5 - 8.0 * sin, f64::from(TOP) - 4.0 + 6.0 * cos, near + (far - near) * u)
        }));
    }
    mesh
}

/// A folding screen of paper, four leaves in zigzag.
pub(super) fn screen() -> Mesh {
    let mut mesh = Mesh::default();
    let foot = |fold: u8| Vec3::new(-31.0 + 5.0 * f32::from(fold % 2), 0.4, -24.0 + 6.5 * f32::from(fold));
    for fold in 0..4 {
        let (from, to) = (foot(fold), foot(fold + 1));
        mesh.append(&Mesh::sheet([from, to, to + Vec3::Y * 15.0, from + Vec3::Y * 15.0], 1));
    }
    mesh
}
