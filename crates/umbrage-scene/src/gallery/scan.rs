//! Statues as a scanner gives them, in two variants: closed meshes without any order, of triangles large and small. They are
//! Umbrage's own.
//!
//! Floor, picture and light are those of [`kinds`](super::kinds); each statue and each pedestal is an object of its own.

use super::kind::{Kind, turned};
use super::marched::{Grid, marched};
use super::rough::{noise, octaves};
use crate::{Material, Scene};
use glam::{UVec3, Vec3};

const MARBLE: Material = Material::matt(Vec3::new(0.66, 0.64, 0.60));
const BRONZE: Material = Material::plastic(Vec3::new(0.42, 0.27, 0.14));
const STONE: Material = Material::matt(Vec3::new(0.36, 0.35, 0.34));

/// A bust with curls and a draped chest; and three hares.
///
/// `variant` is 0 or 1; others count as 1.
///
/// # Panics
/// Never: the views are constants.
pub fn scan(variant: u32) -> Scene {
    let mut kind = Kind::new(["scan", "scan-2"], variant, [(38.0, 140.0), (25.0, 130.0)]);
    if kind.variant == 0 {
        let grid = Grid {
            low: Vec3::new(-9.2, -0.2, -5.5),
            high: Vec3::new(9.2, 18.6, 5.9),
            cells: UVec3::new(60, 84, 42),
            finer_above: 0.55,
        };
        let bust = marched(&grid, bust);
        kind.paint = STONE;
        kind.cuboid(Vec3::new(-5.0, 0.0, -5.0), Vec3::new(5.0, 1.5, 5.0));
        kind.paint = MARBLE;
        kind.solid(turned(bust, Vec3::Y * 1.5, Vec3::Y, 5.0));
    } else {
        let grid = Grid {
            low: Vec3::new(-4.2, -0.2, -5.6),
            high: Vec3::new(4.2, 12.4, 5.8),
            cells: UVec3::new(34, 50, 46),
            finer_above: 0.55,
        };
        let hare = marched(&grid, hare);
        for (at, turn) in [
            (Vec3::new(-10.0, 0.0, -6.0), 70.0),
            (Vec3::new(3.0, 0.0, 6.0), 10.0),
            (Vec3::new(10.0, 0.0, -10.0), -60.0),
        ] {
            kind.paint = BRONZE;
            kind.solid(turned(hare.clone(), at, Vec3::Y, turn));
        }
    }
    kind.scene()
}

/// Distance to a surface, about: negative inside.
type Distance = f32;

fn ellipsoid(at: Vec3, middle: Vec3, radii: Vec3) -> Distance {
    let (near, far) = (((at - middle) / radii).length(), ((at - middle) / (radii * radii)).length());
    near * (near - 1.0) / far.max(1e-6)
}

/// A round bar between two points.
fn bar(at: Vec3, [from, to]: [Vec3; 2], radius: f32) -> Distance {
    let along = to - from;
    let part = ((at - from).dot(along) / along.length_squared()).clamp(0.0, 1.0);
    (at - from - along * part).length() - radius
}

/// Both, with a fillet of about `round`.
fn joined(a: Distance, b: Distance, round: f32) -> Distance {
    let overlap = (round - (a - b).abs()).max(0.0) / round;
    a.min(b) - overlap * overlap * round * 0.25
}

/// The first without the second, with a fillet of about `round`.
fn carved(a: Distance, b: Distance, round: f32) -> Distance {
    -joined(-a, b, round)
}

fn bust(at: Vec3) -> Distance {
    // The left half is the right one mirrored, but for hair, folds and what the scanner adds.
    let half = at.with_x(at.x.abs());
    let v = Vec3::new;
    let foot = joined(
        ellipsoid(at, v(0.0, 0.0, 0.0), v(3.2, 1.4, 3.0)),
        bar(at, [v(0.0, 0.5, 0.0), v(0.0, 3.0, 0.0)], 1.3),
        1.0,
    );
    let mut body = ellipsoid(at, v(0.0, 5.6, 0.0), v(5.2, 3.6, 3.1));
    body = joined(body, ellipsoid(half, v(5.0, 6.3, -0.4), v(2.6, 2.3, 2.3)), 1.5);
    let fold = 2.1 * at.x + 2.6 * at.y + 2.4 * noise(at * 0.45, 7);
    body += 0.22 * fold.sin() * ((9.0 - at.y) * 0.5).clamp(0.0, 1.0);
    let neck = bar(at, [v(0.0, 7.0, -0.4), v(0.0, 11.0, 0.1)], 1.65);
    let mut head = ellipsoid(at, v(0.0, 13.6, 0.0), v(2.5, 3.2, 3.0));
    head = joined(head, ellipsoid(at, v(0.0, 11.7, 1.2), v(1.6, 1.3, 1.6)), 1.2);
    head = joined(head, bar(half, [v(0.0, 14.0, 2.75), v(1.3, 13.9, 2.3)], 0.32), 0.4);
    head = carved(head, ellipsoid(half, v(0.95, 13.35, 3.0), v(0.62, 0.42, 0.6)), 0.25);
    head = joined(head, ellipsoid(half, v(0.92, 13.35, 2.35), v(0.42, 0.36, 0.36)), 0.1);
    head = joined(head, bar(at, [v(0.0, 13.7, 2.9), v(0.0, 12.55, 3.45)], 0.33), 0.35);
    head = joined(head, ellipsoid(half, v(0.3, 12.45, 3.1), v(0.3, 0.22, 0.35)), 0.2);
    head = joined(head, bar(half, [v(0.0, 11.75, 2.75), v(0.65, 11.65, 2.45)], 0.17), 0.15);
    head = joined(head, bar(half, [v(0.0, 11.4, 2.72), v(0.5, 11.42, 2.5)], 0.18), 0.15);
    head = joined(head, ellipsoid(half, v(2.5, 13.0, 0.0), v(0.35, 0.95, 0.65)), 0.2);
    let mut hair = ellipsoid(at, v(0.0, 14.4, -0.55), v(2.85, 3.1, 3.1));
    hair += 0.5 * noise(at * 1.7, 11) + 0.25 * noise(at * 3.6, 12);
    // Hair ends above the brow and behind the ears.
    hair = hair.max(0.35 * (at.z - 1.4) - 0.9 * (at.y - 14.6));
    let all = joined(joined(joined(foot, body, 0.8), neck, 1.4), joined(head, hair, 0.15), 0.7);
    (all + 0.05 * octaves(at * 2.5, 2, 13)).max(-at.y)
}

fn hare(at: Vec3) -> Distance {
    let half = at.with_x(at.x.abs());
    let v = Vec3::new;
    let mut hare = ellipsoid(at, v(0.0, 2.9, -1.2), v(2.5, 2.7, 3.4));
    hare = joined(hare, ellipsoid(at, v(0.0, 3.6, 1.6), v(1.7, 2.6, 1.8)), 1.2);
    hare = joined(hare, ellipsoid(half, v(2.0, 1.9, -1.6), v(1.1, 1.9, 2.1)), 0.6);
    hare = joined(hare, bar(half, [v(2.1, 0.45, -1.6), v(2.0, 0.4, 1.4)], 0.55), 0.4);
    hare = joined(hare, bar(half, [v(0.9, 3.2, 2.4), v(0.95, 0.45, 2.9)], 0.5), 0.4);
    hare = joined(hare, bar(half, [v(0.95, 0.35, 2.8), v(0.95, 0.3, 3.7)], 0.42), 0.3);
    hare = joined(hare, ellipsoid(at, v(0.0, 6.9, 2.6), v(1.5, 1.45, 1.9)), 0.9);
    hare = joined(hare, ellipsoid(at, v(0.0, 6.4, 3.9), v(0.85, 0.75, 0.9)), 0.5);
    hare = joined(hare, ellipsoid(half, v(1.2, 7.3, 3.2), v(0.35, 0.42, 0.42)), 0.1);
    let mut ear = ellipsoid(half, v(1.0, 9.7, 1.4), v(0.62, 2.3, 0.42));
    ear = carved(ear, ellipsoid(half, v(1.05, 9.8, 1.95), v(0.36, 1.8, 0.4)), 0.15);
    hare = joined(hare, ear, 0.35);
    hare = joined(hare, ellipsoid(at, v(0.0, 1.9, -4.6), v(0.9, 0.9, 0.85)), 0.3);
    // Fur lies along the body.
    let fur = 0.08 * noise(at * Vec3::new(2.2, 2.2, 1.1), 21) + 0.05 * noise(at * 4.5, 22);
    (hare + fur).max(-at.y)
}
