//! A scene of thin tubes, in two variants. It is Umbrage's own.
//!
//! Floor, picture and light are those of [`kinds`](super::kinds); each tube is an object of its own.

use super::kind::Kind;
use crate::{Material, Mesh, Scene};
use glam::Vec3;
use std::f32::consts::TAU;

const STEEL: Material = Material::plastic(Vec3::new(0.50, 0.52, 0.55));

/// Many thin tubes that cross: lattice towers of straight rods, and a scaffold.
///
/// `variant` is 0 or 1; others count as 1.
///
/// # Panics
/// Never: the views are constants.
pub fn tubes(variant: u32) -> Scene {
    let mut kind = Kind::new(["tubes", "tubes-2"], variant, [(44.0, 155.0), (36.0, 168.0)]);
    kind.paint = STEEL;
    if kind.variant == 0 {
        for (x, z, foot, top, height) in
            [(-8.0, -8.0, 5.0, 2.6, 17.0), (9.0, -3.0, 4.0, 3.0, 12.0), (-6.0, 9.0, 3.6, 3.6, 7.0)]
        {
            tower(&mut kind, Vec3::new(x, 0.0, z), [foot, top], height);
        }
    } else {
        scaffold(&mut kind);
    }
    kind.scene()
}

/// A tower of two families of straight rods that lean either way around, held by rings.
fn tower(kind: &mut Kind, at: Vec3, [foot, top]: [f32; 2], height: f32) {
    const RODS: u32 = 18;
    for (lean, apart) in [(1.0, 0.0), (-1.0, 0.24)] {
        for rod in 0..RODS {
            let spoke = |turn: f32, radius: f32| Vec3::new(turn.cos(), 0.0, turn.sin()) * (radius + apart);
            let turn = TAU * rod as f32 / RODS as f32;
            let (low, high) = (spoke(turn, foot), spoke(turn + lean * 1.9, top));
            kind.rod(at + low, at + high + Vec3::Y * height, 0.11);
        }
    }
    for ring in 0..=4 {
        let part = ring as f32 / 4.0;
        // How far from the axis a rod is at this height.
        let (low, high) = (Vec3::new(foot, 0.0, 0.0), Vec3::new(1.9f32.cos(), 0.0, 1.9f32.sin()) * top);
        let radius = low.lerp(high, part).length() + 0.12;
        kind.solid(Mesh::torus(at + Vec3::Y * (height * part).max(0.14), Vec3::Y, radius, 0.14, 48));
    }
}

/// Uprights, ledgers, rails and braces, side by side where they cross.
fn scaffold(kind: &mut Kind) {
    const RADIUS: f32 = 0.17;
    let (columns, rows) = ([-14.0, -7.0, 0.0, 7.0, 14.0], [-4.0, 0.5, 5.0]);
    for x in columns {
        for z in rows {
            kind.rod(Vec3::new(x, 0.0, z), Vec3::new(x, 15.4, z), RADIUS);
        }
    }
    for level in 0..4 {
        let y = 1.0 + 4.0 * level as f32;
        for z in rows {
            for rail in [0.0, 1.7] {
                let beside = z + 2.0 * RADIUS;
                kind.rod(Vec3::new(-14.7, y + rail, beside), Vec3::new(14.7, y + rail, beside), RADIUS);
            }
        }
        for x in columns {
            let beside = x + 2.0 * RADIUS;
            kind.rod(Vec3::new(beside, y + 2.0 * RADIUS, -4.7), Vec3::new(beside, y + 2.0 * RADIUS, 5.7), RADIUS);
        }
    }
    for (bay, x) in columns.windows(2).map(|pair| (pair[0], pair[1])).enumerate() {
        for level in 0..3 {
            let (low, high) = (1.0 + 4.0 * level as f32, 5.0 + 4.0 * level as f32);
            let (from, to) = if (bay + level) % 2 == 0 { x } else { (x.1, x.0) };
            for z in [rows[0], rows[2]] {
                let beside = z - 2.0 * RADIUS;
                kind.rod(Vec3::new(from, low, beside), Vec3::new(to, high, beside), RADIUS);
            }
        }
    }
}
