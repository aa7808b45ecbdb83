//! A corner of a room: sun through windows on furniture with thin legs. Umbrage's own.

use super::kind::Kind;
use crate::{Material, Scene};
use glam::{Vec2, Vec3};

const PLASTER: Material = Material::matt(Vec3::new(0.70, 0.66, 0.58));
const WOOD: Material = Material::plastic(Vec3::new(0.36, 0.20, 0.09));

/// Height of the room, and how thick its walls are.
const HEIGHT: f32 = 13.0;
const WALL: f32 = 0.8;
/// Windows: their sill, lintel, half width, and bars along a side.
const SILL: f32 = 3.0;
const LINTEL: f32 = 11.0;
const HALF: f32 = 3.2;

/// The room with a table set for four, chairs and a shelf of books; with blinds and a bench in variant 1.
pub fn interior(variant: u32) -> Scene {
    let mut kind = Kind::new(["interior", "interior-2"], variant, [(38.0, 236.0), (27.0, 214.0)]);
    kind.paint = PLASTER;
    for along_x in [true, false] {
        wall(&mut kind, along_x);
    }
    kind.paint = WOOD;
    table(&mut kind, Vec2::new(1.0, 0.5), Vec2::new(5.0, 3.0), 4.6);
    for (x, z, turn) in [(-2.0, -4.5, 0.0), (3.5, -4.5, 10.0), (-1.5, 5.5, 180.0), (4.0, 5.6, 165.0)] {
        chair(&mut kind, Vec3::new(x, 0.0, z), turn);
    }
    shelf(&mut kind);
    if kind.variant == 1 {
        table(&mut kind, Vec2::new(12.0, 4.0), Vec2::new(1.4, 6.0), 2.4);
        for i in 0..9 {
            kind.turned(Vec3::new(12.0, 2.9, -1.0 + 1.2 * i as f32), Vec3::new(1.5, 0.08, 0.2), Vec3::Z, 20.0);
        }
    } else {
        // A lamp on a stand.
        kind.rod(Vec3::new(11.0, 0.0, -9.0), Vec3::new(11.0, 9.0, -9.0), 0.12);
        kind.rod(Vec3::new(11.0, 8.4, -9.0), Vec3::new(11.0, 10.6, -9.0), 1.6);
        kind.rod(Vec3::new(11.0, 0.0, -9.0), Vec3::new(11.0, 0.2, -9.0), 1.4);
    }
    kind.scene()
}

/// A wall with two windows: along x at the back, or along z at the left.
fn wall(kind: &mut Kind, along_x: bool) {
    let place = |along: f32, height: f32, across: f32| {
        if along_x { Vec3::new(along, height, across) } else { Vec3::new(across, height, along) }
    };
    let back = -16.0;
    let mut part = |from: f32, to: f32, low: f32, high: f32, thick: f32| {
        let middle = back - 0.5 * WALL;
        kind.cuboid(place(from, low, middle - 0.5 * thick), place(to, high, middle + 0.5 * thick));
    };
    let (first, second) = (-8.0, 4.0);
    // The walls meet in the corner.
    for (from, to) in [(-16.0 - WALL, first - HALF), (first + HALF, second - HALF), (second + HALF, 16.0)] {
        part(from, to, 0.0, HEIGHT, WALL);
    }
    for middle in [first, second] {
        part(middle - HALF, middle + HALF, 0.0, SILL, WALL);
        part(middle - HALF, middle + HALF, LINTEL, HEIGHT, WALL);
        for bar in 1..4 {
            let at = middle - HALF + 2.0 * HALF * bar as f32 / 4.0;
            part(at - 0.09, at + 0.09, SILL, LINTEL, 0.2);
        }
        for bar in 1..6 {
            let at = SILL + (LINTEL - SILL) * bar as f32 / 6.0;
            part(middle - HALF, middle + HALF, at - 0.08, at + 0.08, 0.16);
        }
    }
    if kind.variant == 1 {
        // Blinds, half let down inside.
        let slats = 22;
        for middle in [first, second] {
            for i in 0..slats {
                let height = LINTEL - 0.22 * i as f32;
                let at = place(middle, height, back + 0.9);
                let half = if along_x { Vec3::new(HALF, 0.03, 0.22) } else { Vec3::new(0.22, 0.03, HALF) };
                kind.turned(at, half, if along_x { Vec3::X } else { Vec3::Z }, 35.0);
            }
        }
    }
}

/// A table about a place of the floor, of half-extents `half`.
fn table(kind: &mut Kind, at: Vec2, half: Vec2, height: f32) {
    let top = Vec3::new(at.x, height, at.y);
    let out = Vec3::new(half.x, 0.0, half.y);
    kind.cuboid(top - out, top + out + Vec3::Y * 0.3);
    for (x, z) in [(-1.0, -1.0), (1.0, -1.0), (-1.0, 1.0), (1.0, 1.0)] {
        let foot = Vec3::new(at.x + x * (half.x - 0.4), 0.0, at.y + z * (half.y - 0.4));
        kind.rod(foot, foot + Vec3::Y * height, 0.16);
    }
    if height > 4.0 {
        for i in 0..6 {
            let place =
                Vec3::new(at.x - 3.4 + 1.4 * i as f32, height + 0.3, at.y + if i % 2 == 0 { 1.4 } else { -1.3 });
            kind.rod(place, place + Vec3::Y * (0.2 + 0.5 * (i % 3) as f32), 0.35);
        }
    }
}

/// A chair whose back is a row of thin rods.
fn chair(kind: &mut Kind, at: Vec3, degrees: f32) {
    let turn = glam::Quat::from_rotation_y(degrees.to_radians());
    let place = |x: f32, y: f32, z: f32| at + turn * Vec3::new(x, y, z);
    for (x, z) in [(-1.1, -1.1), (1.1, -1.1), (-1.1, 1.1), (1.1, 1.1)] {
        kind.rod(place(x, 0.0, z), place(x * 0.9, 2.6, z * 0.9), 0.1);
    }
    kind.turned(place(0.0, 2.75, 0.0), Vec3::new(1.25, 0.14, 1.25), Vec3::Y, degrees);
    for i in 0..6 {
        let x = -1.05 + 2.1 * i as f32 / 5.0;
        kind.rod(place(x, 2.9, -1.1), place(x, 5.2, -1.35), 0.07);
    }
    kind.turned(place(0.0, 5.35, -1.37), Vec3::new(1.25, 0.14, 0.12), Vec3::Y, degrees);
}

/// Shelves at the left wall, with books of many heights.
fn shelf(kind: &mut Kind) {
    let x = -15.9;
    for z in [7.5, 14.5] {
        kind.cuboid(Vec3::new(x, 0.0, z - 0.12), Vec3::new(x + 2.0, 9.0, z + 0.12));
    }
    for level in 0..4 {
        let y = 0.4 + 2.7 * level as f32;
        kind.cuboid(Vec3::new(x, y, 7.62), Vec3::new(x + 1.95, y + 0.15, 14.38));
        let mut z = 7.7;
        while z < 13.8 {
            let thick = kind.numbers.from(0.15, 0.5);
            let (deep, tall) = (kind.numbers.from(1.1, 1.8), kind.numbers.from(1.2, 2.2));
            if y + tall < 10.5 {
                kind.cuboid(
                    Vec3::new(x + 0.1, y + 0.15, z),
                    Vec3::new(x + 0.1 + deep, y + 0.15 + tall, z + thick - 0.02),
                );
            }
            z += thick;
        }
    }
}
