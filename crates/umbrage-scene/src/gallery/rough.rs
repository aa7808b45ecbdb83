//! Noise that makes ground, stones and statues rough, and the normals of what it displaced.

use crate::Mesh;
use glam::{IVec3, Vec3};
use umbrage_plane::mix32;

/// Noise in −1..=1 that is smooth over about one unit: random numbers at whole coordinates, blended between them.
pub(super) fn noise(at: Vec3, seed: u32) -> f32 {
    let floor = at.floor();
    let part = at - floor;
    let blend = part * part * (3.0 - 2.0 * part);
    let cell = floor.as_ivec3();
    let corner = |x: i32, y: i32, z: i32| {
        let IVec3 { x, y, z } = cell + IVec3::new(x, y, z);
        let bits = mix32(mix32(mix32(seed ^ x as u32).wrapping_add(y as u32)).wrapping_add(z as u32));
        (bits >> 8) as f32 / 8_388_608.0 - 1.0
    };
    let mix = |a: f32, b: f32, t: f32| a + (b - a) * t;
    let along = |y: i32, z: i32| mix(corner(0, y, z), corner(1, y, z), blend.x);
    let plane = |z: i32| mix(along(0, z), along(1, z), blend.y);
    mix(plane(0), plane(1), blend.z)
}

/// Several octaves of [`noise`], each twice as fine and half as high as the one before, in about −1..=1.
pub(super) fn octaves(at: Vec3, count: u32, seed: u32) -> f32 {
    let octave = |i: u32| noise(at * 2.0f32.powi(i as i32), seed.wrapping_add(i)) * 0.5f32.powi(i as i32 + 1);
    (0..count).map(octave).sum()
}

/// Several octaves that meet in sharp crests, in 0..=1.
pub(super) fn ridges(at: Vec3, count: u32, seed: u32) -> f32 {
    let octave = |i: u32| {
        let crest = 1.0 - noise(at * 2.0f32.powi(i as i32), seed.wrapping_add(i)).abs();
        crest * crest * 0.5f32.powi(i as i32 + 1)
    };
    (0..count).map(octave).sum()
}

/// The same mesh with normals that are means of the triangles around each vertex, weighted by area.
pub(super) fn smoothed(mut mesh: Mesh) -> Mesh {
    mesh.normals.fill(Vec3::ZERO);
    for triangle in 0..mesh.triangles.len() {
        let [a, b, c] = mesh.corners(triangle);
        for corner in mesh.triangles[triangle] {
            mesh.normals[corner as usize] += (b - a).cross(c - a);
        }
    }
    for normal in &mut mesh.normals {
        *normal = normal.normalize_or_zero();
    }
    mesh
}
