//! Land under a low sun, in two variants. It is Umbrage's own.
//!
//! Floor, picture and light are those of [`kinds`](super::kinds); the land, each tree and each boulder are objects of their own.

use super::curved::curved;
use super::kind::Kind;
use super::rough::{noise, octaves, ridges, smoothed};
use crate::{Material, Mesh, Scene};
use glam::{DVec3, Vec3};

const ROCK: Material = Material::matt(Vec3::new(0.50, 0.46, 0.40));
const SAND: Material = Material::matt(Vec3::new(0.66, 0.46, 0.28));
const FIR: Material = Material::matt(Vec3::new(0.10, 0.24, 0.12));

/// Pieces along a side of the land, and half its side in world units.
const PIECES: u32 = 160;
const HALF: f32 = 20.0;

/// Land whose ridges shade their own slopes: mountains with firs, and terraced hills with boulders.
///
/// `variant` is 0 or 1; others count as 1.
///
/// # Panics
/// Never: the views are constants.
pub fn terrain(variant: u32) -> Scene {
    let mut kind = Kind::new(["terrain", "terrain-2"], variant, [(22.0, 150.0), (17.0, 140.0)]);
    let height = kind.either(mountains as fn(f32, f32) -> f32, hills);
    kind.paint = kind.either(ROCK, SAND);
    kind.solid(land(height));
    kind.paint = kind.either(FIR, ROCK);
    for i in 0..kind.either(360, 160) {
        let (x, z) = (kind.numbers.from(-19.0, 19.0), kind.numbers.from(-19.0, 19.0));
        let (size, foot) = (kind.numbers.from(0.5, 1.0), Vec3::new(x, height(x, z), z));
        let slope = (height(x + 0.3, z) - height(x - 0.3, z)).hypot(height(x, z + 0.3) - height(x, z - 0.3)) / 0.6;
        // Firs stand in woods below the tree line, boulders where it is flat.
        let grows = if kind.variant == 0 {
            foot.y < 5.5 && slope < 0.9 && noise(foot.with_y(0.0) * 0.15, 5) > -0.1
        } else {
            slope < 0.4
        };
        if grows && kind.variant == 0 {
            kind.solid(fir(foot - Vec3::Y * 0.15, size));
        } else if grows {
            kind.solid(boulder(foot, 0.15 + 0.7 * size.powi(6), i));
        }
    }
    kind.scene()
}

fn mountains(x: f32, z: f32) -> f32 {
    let at = Vec3::new(x, 0.0, z) * 0.075;
    let bent = at + Vec3::new(noise(at * 2.0, 71), 0.0, noise(at * 2.0, 72)) * 0.25;
    0.8 + 9.5 * ridges(bent, 4, 40).powi(2) * (0.75 + 0.5 * noise(at * 1.3, 73))
}

/// Steps of rock with slopes of sand between them.
fn hills(x: f32, z: f32) -> f32 {
    const STEP: f32 = 1.5;
    let at = Vec3::new(x, 0.0, z) * 0.09;
    let smooth = 3.2 + 5.5 * octaves(at, 3, 90);
    let (level, part) = ((smooth / STEP).floor(), (smooth / STEP).fract());
    let wall = ((part - 0.62) / 0.3).clamp(0.0, 1.0);
    let stepped = STEP * (level + 0.25 * part + 0.75 * wall * wall * (3.0 - 2.0 * wall));
    (0.9 + stepped + 0.12 * octaves(at * 9.0, 3, 91)).max(0.5)
}

/// The land as a closed block that stands on the floor.
fn land(height: fn(f32, f32) -> f32) -> Mesh {
    let mut mesh = curved(PIECES, PIECES, |u, v| {
        let (x, z) = (f64::from(HALF) * (2.0 * u - 1.0), f64::from(HALF) * (1.0 - 2.0 * v));
        DVec3::new(x, f64::from(height(x as f32, z as f32)), z)
    });
    let across = PIECES + 1;
    // Around the rim, counter-clockwise from above.
    let near = (0..PIECES).collect::<Vec<u32>>();
    let right = near.iter().map(|i| PIECES + i * across);
    let far = near.iter().map(|i| PIECES * across + PIECES - i);
    let left = near.iter().map(|i| (PIECES - i) * across);
    let rim: Vec<u32> = near.iter().copied().chain(right).chain(far).chain(left).collect();
    let centre = mesh.positions.len() as u32;
    mesh.vertex(Vec3::ZERO, Vec3::NEG_Y);
    for (i, from) in rim.iter().enumerate() {
        let side = i as u32 / PIECES;
        let [from, to] = [*from, rim[(i + 1) % rim.len()]].map(|at| mesh.positions[at as usize]);
        let outward = (to - from).with_y(0.0).normalize().cross(Vec3::Y);
        let wall = mesh.positions.len() as u32;
        for at in [from.with_y(0.0), to.with_y(0.0), to, from] {
            mesh.vertex(at, outward);
        }
        mesh.quad([wall, wall + 1, wall + 2, wall + 3], 1 + side);
        for at in [to, from] {
            mesh.vertex(at.with_y(0.0), Vec3::NEG_Y);
        }
        mesh.triangle([wall + 4, wall + 5, centre], 5);
    }
    mesh
}

/// A fir in three tiers.
fn fir(foot: Vec3, size: f32) -> Mesh {
    let tiers = [
        (0.0, 0.0),
        (0.1, 0.0),
        (0.1, 0.45),
        (0.6, 0.4),
        (0.28, 1.0),
        (0.46, 0.95),
        (0.2, 1.5),
        (0.33, 1.45),
        (0.0, 2.2),
    ];
    Mesh::lathe(foot, Vec3::Y, &tiers.map(|(radius, height)| (radius * size, height * size)), 10)
}

/// A ball with dents, sunk a little into the ground.
fn boulder(at: Vec3, radius: f32, seed: u32) -> Mesh {
    let mut mesh = Mesh::sphere(Vec3::ZERO, 1.0, 16);
    for place in &mut mesh.positions {
        let dent = 1.0 + 0.35 * octaves(*place * 1.6, 2, seed);
        *place = at + (*place * Vec3::new(1.2, 0.8, 1.0) * dent + Vec3::Y * 0.25) * radius;
    }
    smoothed(mesh)
}
