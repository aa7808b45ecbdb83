//! Scenes of kinds that people have: closed solids, balls and leaves. Each comes in two variants: other shapes under
//! another light. They are Umbrage's own; nothing is after a paper's figure.
//!
//! Floor, picture and light are those of [`kinds`](super::kinds); each thing is an object of its own.

use super::foliage::Leaf;
use super::kind::{Kind, turned};
use crate::{Material, Mesh, Scene};
use glam::Vec3;
use std::f32::consts::{SQRT_2, TAU};

/// Paints of toys.
const PAINTS: [Material; 5] = [
    Material::plastic(Vec3::new(0.66, 0.12, 0.08)),
    Material::plastic(Vec3::new(0.72, 0.50, 0.12)),
    Material::plastic(Vec3::new(0.12, 0.26, 0.66)),
    Material::plastic(Vec3::new(0.14, 0.44, 0.20)),
    Material::plastic(Vec3::new(0.60, 0.57, 0.52)),
];
const CLAY: Material = Material::matt(Vec3::new(0.52, 0.22, 0.12));
const EARTH: Material = Material::matt(Vec3::new(0.10, 0.065, 0.04));
const BARK: Material = Material::matt(Vec3::new(0.24, 0.17, 0.10));

/// A table full of closed solids: boxes, prisms, cones, rings and turned pieces.
///
/// `variant` is 0 or 1; others count as 1.
///
/// # Panics
/// Never: the views are constants.
pub fn solids(variant: u32) -> Scene {
    let mut kind = Kind::new(["solids", "solids-2"], variant, [(38.0, 160.0), (27.0, 150.0)]);
    let across = kind.either(5, 6);
    let step = 38.0 / across as f32;
    for i in 0..across * across {
        let (column, row) = (i % across, i / across);
        let corner = Vec3::new(column as f32 + 0.5, 0.0, row as f32 + 0.5) * step - Vec3::new(19.0, 0.0, 19.0);
        let at = corner + Vec3::new(kind.numbers.from(-0.3, 0.3), 0.0, kind.numbers.from(-0.3, 0.3));
        let (size, turn) = (step * kind.numbers.from(0.22, 0.33), kind.numbers.from(0.0, 360.0));
        let tall = size * kind.numbers.from(1.4, 3.0);
        let mesh = match (3 * i + row) % 7 {
            0 => Mesh::cuboid(Vec3::new(-size, 0.0, -size * 0.8), Vec3::new(size, tall, size * 0.8)),
            1 => Mesh::cylinder(Vec3::ZERO, Vec3::Y * tall, size, kind.either(6, 5)),
            2 => roof(size, 2.2 * size),
            3 => Mesh::lathe(Vec3::ZERO, Vec3::Y, &[(0.0, 0.0), (size, 0.0), (0.0, tall)], kind.either(64, 4)),
            4 => rings(size, kind.either(3, 2)),
            5 => Mesh::lathe(Vec3::ZERO, Vec3::Y, &kind.either(PAWN, GOBLET).map(|(r, h)| (r * size, h * size)), 48),
            _ => Mesh::lathe(Vec3::ZERO, Vec3::Y, &nut(size, 0.9 * size), kind.either(8, 6)),
        };
        kind.paint = PAINTS[(i + row) as usize % PAINTS.len()];
        kind.solid(turned(mesh, at, Vec3::Y, turn));
    }
    kind.scene()
}

/// A prism of three sides that lies on one of them, like a roof.
fn roof(radius: f32, length: f32) -> Mesh {
    let along = Vec3::X * length * 0.5;
    // The first corner of a cylinder along x points to −z; a quarter turn brings it to the top.
    turned(Mesh::cylinder(-along, along, radius, 3), Vec3::Y * radius * 0.5, Vec3::X, 90.0)
}

/// Rings that lie upon each other, each smaller than the one below.
fn rings(radius: f32, count: u32) -> Mesh {
    let mut tower = Mesh::default();
    let mut height = 0.0;
    for ring in 0..count {
        let (major, minor) = (radius * (0.8 - 0.16 * ring as f32), radius * 0.27);
        tower.append(&Mesh::torus(Vec3::Y * (height + minor), Vec3::Y, major, minor, 48));
        height += 2.0 * minor;
    }
    tower
}

/// The profile of a nut: a ring with straight sides.
fn nut(radius: f32, height: f32) -> [(f32, f32); 4] {
    [(radius * 0.55, 0.0), (radius, 0.0), (radius, height), (radius * 0.55, height)]
}

/// Profiles of turned pieces about 1 wide, as (radius, height).
const PAWN: [(f32, f32); 14] = [
    (0.0, 0.0),
    (0.9, 0.0),
    (0.95, 0.35),
    (0.6, 0.6),
    (0.38, 1.3),
    (0.32, 1.9),
    (0.6, 2.0),
    (0.6, 2.12),
    (0.35, 2.2),
    (0.55, 2.45),
    (0.58, 2.7),
    (0.5, 2.95),
    (0.3, 3.15),
    (0.0, 3.22),
];
const GOBLET: [(f32, f32); 14] = [
    (0.0, 0.0),
    (0.75, 0.0),
    (0.7, 0.08),
    (0.16, 0.25),
    (0.12, 1.4),
    (0.3, 1.6),
    (0.7, 2.0),
    (0.85, 2.6),
    (0.78, 3.4),
    (0.72, 3.4),
    (0.78, 2.6),
    (0.62, 2.05),
    (0.25, 1.75),
    (0.0, 1.7),
];

/// Many balls of several sizes, finely cut, that touch each other and the floor or nearly do.
///
/// `variant` is 0 or 1; others count as 1.
///
/// # Panics
/// Never: the views are constants.
pub fn spheres(variant: u32) -> Scene {
    let mut kind = Kind::new(["spheres", "spheres-2"], variant, [(36.0, 150.0), (24.0, 140.0)]);
    // Middle and radius of every ball.
    let mut balls: Vec<(Vec3, f32)> = Vec::new();
    let piles = kind.either(
        [(Vec3::new(-9.0, 0.0, -9.0), 1.7, 4), (Vec3::new(9.0, 0.0, 5.0), 1.3, 3)],
        [(Vec3::new(7.0, 0.0, -8.0), 1.5, 4), (Vec3::new(-10.0, 0.0, 7.0), 1.1, 4)],
    );
    for (middle, radius, rows) in piles {
        // Each layer lies in the hollows of the one below.
        for layer in 0..rows {
            let across = rows - layer;
            for i in 0..across * across {
                let place = Vec3::new((i % across) as f32, 0.0, (i / across) as f32) * 2.0 - (across - 1) as f32;
                let height = 1.0 + SQRT_2 * layer as f32;
                balls.push((middle + place.with_y(height) * radius, radius));
            }
        }
    }
    let [least, most] = kind.either([1.1, 3.0], [0.9, 2.4]);
    for i in 0..kind.either(300, 400) {
        let at = Vec3::new(kind.numbers.from(-18.5, 18.5), 0.0, kind.numbers.from(-18.5, 18.5));
        let wish = least + (most - least) * kind.numbers.next().powi(3);
        // The radius r at which a ball that stands here touches another of radius R: their places on the floor are d apart, and
        // d² + (y − r)² = (R + r)².
        let room = |(middle, radius): &(Vec3, f32)| {
            let apart = at.with_y(middle.y) - *middle;
            (apart.length_squared() + middle.y * middle.y - radius * radius) / (2.0 * (middle.y + radius))
        };
        let free = balls.iter().map(room).fold(f32::INFINITY, f32::min);
        // Half of those that find no more room touch; the others leave a gap of a hundredth.
        let radius = wish.min(if i % 2 == 0 { free } else { free * 0.99 });
        if radius >= least {
            balls.push((at.with_y(radius), radius));
        }
    }
    for (i, (middle, radius)) in balls.into_iter().enumerate() {
        kind.paint = PAINTS[i % PAINTS.len()];
        kind.solid(Mesh::sphere(middle, radius, 32 + (12.0 * radius) as u32));
    }
    kind.scene()
}

/// Many small bent leaves: a bush in a pot, and a young tree, with fallen leaves on the floor.
///
/// `variant` is 0 or 1; others count as 1.
///
/// # Panics
/// Never: the views are constants.
pub fn leaves(variant: u32) -> Scene {
    let mut kind = Kind::new(["leaves", "leaves-2"], variant, [(50.0, 160.0), (33.0, 172.0)]);
    let place = kind.either(Vec3::new(-2.0, 0.0, 2.0), Vec3::new(-6.0, 0.0, 0.0));
    // Where the boughs begin; how far they reach, out and up; how long leaves are.
    let (crotch, reach, rise, length) = kind.either((4.0, 8.0, 9.5, 1.6), (7.0, 9.0, 9.0, 1.3));
    if kind.variant == 0 {
        let clay = [(0.0, 0.0), (2.8, 0.0), (3.9, 4.2), (4.3, 4.2), (4.4, 5.2), (3.9, 5.2), (3.6, 4.4), (0.0, 4.4)];
        kind.paint = CLAY;
        kind.solid(Mesh::lathe(place, Vec3::Y, &clay, 64));
        kind.paint = EARTH;
        kind.solid(Mesh::lathe(place, Vec3::Y, &[(0.0, 4.0), (3.5, 4.0), (3.7, 4.7), (0.0, 4.9)], 48));
    } else {
        kind.paint = BARK;
        kind.solid(Mesh::lathe(place, Vec3::Y, &[(0.0, 0.0), (1.1, 0.0), (0.6, 1.2), (0.45, 8.0), (0.0, 9.0)], 24));
    }
    let boughs = kind.either(11, 12);
    for bough in 0..boughs {
        let turn = TAU * (bough as f32 + 0.4 * kind.numbers.next()) / boughs as f32;
        let share = kind.numbers.from(0.35, 1.0);
        let out = Vec3::new(turn.cos(), 0.0, turn.sin());
        let at = |part: f32| {
            let (away, up) = (reach * share * part, rise * (1.25 - 0.75 * share) * part * (1.3 - 0.3 * part));
            place + Vec3::Y * (crotch + up) + out * away
        };
        kind.paint = BARK;
        kind.solid(Mesh::tube(&[0.0, 0.25, 0.5, 0.75, 1.0].map(at), 0.16, 8));
        for twig in 0..9 {
            let foot = at(0.28 + 0.08 * twig as f32);
            let bearing = turn + 2.4 * twig as f32;
            let way = Vec3::new(bearing.cos(), kind.numbers.from(0.1, 0.9), bearing.sin());
            let tip = foot + way * kind.numbers.from(1.6, 2.8);
            kind.paint = BARK;
            kind.solid(Mesh::tube(&[foot, tip], 0.05, 6));
            for leaf in 0..kind.either(8, 11) {
                let part = 0.3 + 0.7 * kind.numbers.next();
                let bearing = bearing + 2.4 * leaf as f32;
                let rise = kind.numbers.from(-0.3, 0.8);
                foliage(&mut kind, foot.lerp(tip, part), bearing, rise, length);
            }
        }
    }
    for _ in 0..kind.either(50, 80) {
        // Denser below the crown.
        let (turn, away) = (kind.numbers.from(0.0, TAU), 14.0 * kind.numbers.next().powf(0.8));
        let foot = place + Vec3::new(turn.cos() * away, 0.02, turn.sin() * away);
        let bearing = kind.numbers.from(0.0, TAU);
        foliage(&mut kind, foot, bearing, 0.45, length);
    }
    kind.scene()
}

/// One leaf from its foot toward a bearing and an angle above the horizon, radians; its length varies about `length`.
fn foliage(kind: &mut Kind, foot: Vec3, bearing: f32, rise: f32, length: f32) {
    let length = length * kind.numbers.from(0.75, 1.25);
    let leaf = Leaf {
        foot: foot.as_dvec3(),
        bearing: f64::from(bearing),
        rise: f64::from(rise),
        length: f64::from(length),
        half_width: f64::from(length * kind.numbers.from(0.22, 0.32)),
        droop: f64::from(kind.numbers.from(0.1, 0.4)),
    };
    let green = kind.numbers.from(0.28, 0.46);
    kind.paint = Material::matt(Vec3::new(kind.numbers.from(0.10, 0.24), green, 0.08));
    kind.sheet(leaf.broad());
}
