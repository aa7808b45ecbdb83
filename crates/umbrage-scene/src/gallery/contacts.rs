//! A scene of things that touch: they stand on, lean against and lie upon each other. It comes in two variants, and is Umbrage's
//! own.
//!
//! Floor, picture and light are those of [`kinds`](super::kinds); each thing is an object of its own.

use super::kind::{Kind, turned};
use crate::{Material, Mesh, Scene};
use glam::{DMat4, DVec3, Vec3};
use std::f32::consts::TAU;

const OAK: Material = Material::matt(Vec3::new(0.52, 0.34, 0.18));
const WALNUT: Material = Material::matt(Vec3::new(0.26, 0.15, 0.09));
const CARD: Material = Material::matt(Vec3::new(0.60, 0.46, 0.28));
const RED: Material = Material::plastic(Vec3::new(0.60, 0.12, 0.08));
const BLUE: Material = Material::plastic(Vec3::new(0.12, 0.26, 0.60));
const TIN: Material = Material::plastic(Vec3::new(0.46, 0.50, 0.54));

/// Boxes and cylinders that stand on, lean against and lie upon each other, among furniture with thin legs: a room on the
/// day of a move, and a builder's yard.
///
/// `variant` is 0 or 1; others count as 1.
///
/// # Panics
/// Never: the views are constants.
pub fn contacts(variant: u32) -> Scene {
    let mut kind = Kind::new(["contacts", "contacts-2"], variant, [(38.0, 155.0), (27.0, 150.0)]);
    if kind.variant == 0 {
        room(&mut kind);
    } else {
        yard(&mut kind);
    }
    kind.scene()
}

/// Two tables with chairs around them and tins and books on them, boxes, and a cupboard that boards lean against.
fn room(kind: &mut Kind) {
    for (at, turn) in [(Vec3::new(-8.0, 0.0, -5.0), 8.0), (Vec3::new(7.0, 0.0, 7.0), -20.0)] {
        kind.paint = OAK;
        kind.solid(turned(table(Vec3::new(4.6, 5.0, 2.8)), at, Vec3::Y, turn));
        for (x, z, facing) in [(-2.2, -4.2, 0.0), (2.0, -4.4, 12.0), (-2.0, 4.3, 180.0), (2.3, 4.6, 171.0)] {
            kind.paint = WALNUT;
            kind.solid(turned(chair(), at + about_y(Vec3::new(x, 0.0, z), turn), Vec3::Y, turn + facing));
        }
        for (x, z, count) in [(-3.4, -1.2, 2), (-1.9, 1.1, 3), (0.2, -1.4, 1), (0.9, 0.6, 2)] {
            kind.paint = TIN;
            tins(kind, at + about_y(Vec3::new(x, 5.0, z), turn), [0.55, 1.1], count);
        }
        kind.paint = RED;
        for book in 0..4 {
            let low = 5.0 + 0.45 * book as f32;
            let mesh = Mesh::cuboid(Vec3::new(-0.8, 0.0, -1.1), Vec3::new(0.8, 0.45, 1.1));
            let place = at + about_y(Vec3::new(3.2, low, 0.0), turn);
            let askew = kind.numbers.from(-25.0, 25.0);
            kind.solid(turned(mesh, place, Vec3::Y, turn + askew));
        }
    }
    for (x, z) in [(11.0, -8.0), (-13.0, 9.0), (14.5, -3.0), (-7.0, 13.0)] {
        boxes(kind, Vec3::new(x, 0.0, z), 1.9, 3);
    }
    kind.paint = WALNUT;
    kind.cuboid(Vec3::new(-4.0, 0.7, -18.0), Vec3::new(3.0, 11.0, -14.8));
    for (x, z) in [(-3.9, -17.9), (2.5, -17.9), (-3.9, -15.3), (2.5, -15.3)] {
        kind.cuboid(Vec3::new(x, 0.0, z), Vec3::new(x + 0.4, 0.7, z + 0.4));
    }
    kind.paint = OAK;
    for board in 0..4 {
        let z = -17.6 + 0.75 * board as f32;
        let foot = Vec3::new(6.0 + 0.5 * board as f32, 0.0, z);
        kind.solid(lean(board_of([12.6 - 0.8 * board as f32, 0.2, 0.3]), foot, Vec3::new(3.0, 11.0, z)));
    }
}

/// Pallets of crates, drums, logs, ladders, trestles and stools.
fn yard(kind: &mut Kind) {
    for (x, z, rows) in [(-11.0, -9.0, 3), (4.0, -11.0, 2), (-13.0, 8.0, 1)] {
        kind.paint = OAK;
        kind.solid(turned(pallet(), Vec3::new(x, 0.0, z), Vec3::Y, 0.0));
        for row in 0..rows {
            for (i, side) in [-1.55f32, 1.55].into_iter().enumerate() {
                kind.paint = if (i + row) % 2 == 0 { CARD } else { OAK };
                let low = Vec3::new(x + side - 1.5, 0.8 + 2.6 * row as f32, z - 2.4);
                kind.cuboid(low, low + Vec3::new(3.0, 2.6, 4.8));
            }
        }
        kind.paint = TIN;
        let top = 0.8 + 2.6 * rows as f32;
        kind.solid(lean(ladder(13.0), Vec3::new(x + 6.0, 0.0, z + 0.4), Vec3::new(x + 3.05, top, z + 0.4)));
        for board in 0..2 {
            let along = x - 2.2 + 1.3 * board as f32;
            let foot = Vec3::new(along, 0.0, z + 4.4 + 0.5 * board as f32);
            kind.paint = OAK;
            kind.solid(lean(board_of([top + 2.0, 0.12, 0.3]), foot, Vec3::new(along, top, z + 2.4)));
        }
    }
    // Drums that stand, some on others, and logs that lie in the hollows of those below.
    for i in 0..5 {
        kind.paint = if i % 2 == 0 { BLUE } else { RED };
        tins(
            kind,
            Vec3::new(12.0 + 2.5 * (i % 2) as f32, 0.0, -6.0 + 2.4 * (i / 2) as f32),
            [1.15, 3.2],
            1 + i as u32 % 2,
        );
    }
    for layer in 0..4u32 {
        for log in 0..5 - layer {
            let x = -3.6 + 1.4 * (log as f32 + 0.5 * layer as f32);
            let y = 0.7 * (1.0 + 3.0f32.sqrt() * layer as f32);
            kind.paint = WALNUT;
            kind.solid(Mesh::cylinder(Vec3::new(x, y, 7.0), Vec3::new(x, y, 15.0), 0.7, 32));
        }
    }
    kind.paint = OAK;
    for x in [4.6, 11.4] {
        kind.solid(trestle(Vec3::new(x, 0.0, 6.0)));
    }
    kind.cuboid(Vec3::new(3.0, 4.0, 4.8), Vec3::new(13.0, 4.25, 7.2));
    for (x, count) in [(4.2, 2), (6.0, 1), (9.3, 3)] {
        kind.paint = TIN;
        tins(kind, Vec3::new(x, 4.25, 6.0), [0.45, 0.9], count);
    }
    for (x, z) in [(5.0, 11.5), (9.5, 12.0), (-4.0, 0.0)] {
        kind.paint = WALNUT;
        kind.solid(stool(Vec3::new(x, 0.0, z)));
    }
}

/// A point turned about the y axis, as [`turned`] turns a mesh.
fn about_y(at: Vec3, degrees: f32) -> Vec3 {
    glam::Quat::from_rotation_y(degrees.to_radians()) * at
}

/// Cylinders of a radius and a height that stand upon each other.
fn tins(kind: &mut Kind, at: Vec3, [radius, height]: [f32; 2], count: u32) {
    for tin in 0..count {
        let base = at + Vec3::Y * height * tin as f32;
        kind.solid(Mesh::cylinder(base, base + Vec3::Y * height, radius, 40));
    }
}

/// Boxes that stand upon each other, each a little smaller and askew.
fn boxes(kind: &mut Kind, at: Vec3, half: f32, count: u32) {
    let mut low = 0.0;
    for number in 0..count {
        let half = half * (1.0 - 0.16 * number as f32) * kind.numbers.from(0.9, 1.1);
        let high = half * kind.numbers.from(0.9, 1.5);
        let mesh = Mesh::cuboid(Vec3::new(-half, 0.0, -half * 0.8), Vec3::new(half, high, half * 0.8));
        let askew = kind.numbers.from(-30.0, 30.0);
        kind.paint = CARD;
        kind.solid(turned(mesh, at + Vec3::Y * low, Vec3::Y, askew));
        low += high;
    }
}

/// A closed box that reaches from 0 along x, stands on y = 0 and lies on both sides of z = 0.
fn board_of([length, thick, half_width]: [f32; 3]) -> Mesh {
    Mesh::cuboid(Vec3::new(0.0, 0.0, -half_width), Vec3::new(length, thick, half_width))
}

/// A mesh that lies along x on y = 0, set up so that its start stands at `foot` and its lower side touches `edge`.
fn lean(mesh: Mesh, foot: Vec3, edge: Vec3) -> Mesh {
    let along = (edge - foot).as_dvec3().normalize();
    let side = along.cross(DVec3::Y).normalize();
    let up = side.cross(along);
    let place = DMat4::from_cols(along.extend(0.0), up.extend(0.0), side.extend(0.0), foot.as_dvec3().extend(1.0));
    mesh.transformed(&place)
}

/// A ladder that lies along x on y = 0.
fn ladder(length: f32) -> Mesh {
    let mut mesh = Mesh::default();
    for z in [-0.9, 0.9] {
        mesh.append(&Mesh::cuboid(Vec3::new(0.0, 0.0, z - 0.1), Vec3::new(length, 0.3, z + 0.1)));
    }
    for rung in 0..(length - 0.4) as i32 {
        let at = Vec3::new(0.7 + rung as f32, 0.15, 0.0);
        // Rungs end inside the rails.
        mesh.append(&Mesh::cylinder(at - Vec3::Z * 0.88, at + Vec3::Z * 0.88, 0.08, 10));
    }
    mesh
}

/// A table: half its width, its height, half its depth.
fn table(size: Vec3) -> Mesh {
    let mut mesh = Mesh::cuboid(Vec3::new(-size.x, size.y - 0.25, -size.z), size);
    for (x, z) in [(-1.0, -1.0), (-1.0, 1.0), (1.0, -1.0), (1.0, 1.0)] {
        let foot = Vec3::new(x * (size.x - 0.4), 0.0, z * (size.z - 0.4));
        // Legs end inside the top.
        mesh.append(&leg(foot, size.y - 0.2, 0.16));
    }
    mesh
}

/// A square leg.
fn leg(foot: Vec3, height: f32, half: f32) -> Mesh {
    let across = Vec3::new(half, 0.0, half);
    Mesh::cuboid(foot - across, foot + across + Vec3::Y * height)
}

/// A chair with its back at −z.
fn chair() -> Mesh {
    let mut mesh = Mesh::cuboid(Vec3::new(-1.3, 2.7, -1.3), Vec3::new(1.3, 2.9, 1.3));
    for x in [-1.15, 1.15] {
        mesh.append(&leg(Vec3::new(x, 0.0, 1.12), 2.8, 0.12));
        mesh.append(&leg(Vec3::new(x, 0.0, -1.12), 6.2, 0.12));
    }
    for slat in 0..4 {
        let low = 3.9 + 0.6 * slat as f32;
        mesh.append(&Mesh::cuboid(Vec3::new(-1.1, low, -1.18), Vec3::new(1.1, low + 0.3, -1.06)));
    }
    mesh
}

/// A stool on three legs that spread.
fn stool(at: Vec3) -> Mesh {
    const SEAT: [(f32, f32); 5] = [(0.0, 3.0), (1.0, 3.0), (1.15, 3.15), (1.1, 3.35), (0.0, 3.3)];
    let mut mesh = Mesh::lathe(at, Vec3::Y, &SEAT, 40);
    for number in 0..3 {
        let turn = TAU * (number as f32 / 3.0 + 0.1);
        let out = Vec3::new(turn.cos(), 0.0, turn.sin());
        // The lowest place of a slanting end touches the floor.
        mesh.append(&Mesh::cylinder(at + out * 1.3 + Vec3::Y * 0.022, at + out * 0.6 + Vec3::Y * 3.1, 0.1, 12));
    }
    mesh
}

/// A beam on two pairs of legs that spread, 4 high, along z.
fn trestle(at: Vec3) -> Mesh {
    let mut mesh = Mesh::cuboid(at + Vec3::new(-0.25, 3.5, -1.6), at + Vec3::new(0.25, 4.0, 1.6));
    for (x, z) in [(-1.0, -1.2), (-1.0, 1.2), (1.0, -1.2), (1.0, 1.2)] {
        let foot = at + Vec3::new(x * 1.2, 0.03, z * 1.1);
        mesh.append(&Mesh::cylinder(foot, at + Vec3::new(x * 0.15, 3.7, z), 0.12, 12));
    }
    mesh
}

/// Seven slats on three bearers, 0.8 high and 6.4 × 5 wide.
fn pallet() -> Mesh {
    let mut mesh = Mesh::default();
    for x in [-3.2, -0.2, 2.8] {
        mesh.append(&Mesh::cuboid(Vec3::new(x, 0.0, -2.5), Vec3::new(x + 0.4, 0.65, 2.5)));
    }
    for slat in 0..7 {
        let z = -2.5 + 0.74 * slat as f32;
        mesh.append(&Mesh::cuboid(Vec3::new(-3.2, 0.6, z), Vec3::new(3.2, 0.8, z + 0.5)));
    }
    mesh
}
