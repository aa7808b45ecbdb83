//! Scenes of the kinds that shadow maps find hard, each in two variants: other shapes under another light. Umbrage's own; nothing is after a
//! paper's figure.
//!
//! Each thing is an object of its own, the floor the last. All stand on a floor whose top is y = 0 within 24 world units of the middle (but for tiny and far ones), and are seen by a picture of
//! 512 × 512. Light 0 has 512 × 512 texels, about 1/7 of a world unit each, that hold everything.

use super::kind::Kind;
use crate::{Mesh, Scene};
use glam::{DVec3, Vec3};

/// Pickets, rails and wires: things thinner than a texel, with gaps between them.
///
/// `variant` is 0 or 1; others count as 1.
///
/// # Panics
/// Never: the views are constants.
pub fn fence(variant: u32) -> Scene {
    let mut kind = Kind::new(["fence", "fence-2"], variant, [(38.0, 115.0), (-50.0, 60.0)]);
    for row in 0..3 {
        let z = -14.0 + 12.0 * row as f32;
        let step = kind.either(0.9, 1.3);
        let count = (34.0 / step) as i32;
        for i in 0..=count {
            let (x, height) = (-17.0 + step * i as f32, kind.numbers.from(5.5, 7.0));
            kind.cuboid(Vec3::new(x, 0.0, z), Vec3::new(x + 0.35, height, z + 0.12));
        }
        for y in [1.5, 4.5] {
            kind.cuboid(Vec3::new(-17.5, y, z + 0.13), Vec3::new(17.5, y + 0.4, z + 0.3));
        }
        for y in [8.0, 9.0, 10.0] {
            kind.rod(Vec3::new(-17.0, y, z + 3.0), Vec3::new(17.0, y + 0.7, z + 3.0), 0.05);
        }
    }
    kind.scene()
}

/// Letters of boards that stand on the floor.
///
/// `variant` is 0 or 1; others count as 1.
///
/// # Panics
/// Never: the views are constants.
pub fn letters(variant: u32) -> Scene {
    let mut kind = Kind::new(["letters", "letters-2"], variant, [(45.0, 70.0), (28.0, 130.0)]);
    // Strokes on a grid of 5 × 7, as rectangles of left, bottom, right, top.
    let glyphs: [&[[f32; 4]]; 6] = [
        &[[0.0, 0.0, 1.0, 7.0], [1.0, 6.0, 4.0, 7.0], [1.0, 3.0, 3.0, 4.0], [1.0, 0.0, 4.0, 1.0]],
        &[[0.0, 0.0, 1.0, 7.0], [4.0, 0.0, 5.0, 7.0], [1.0, 3.0, 4.0, 4.0]],
        &[[2.0, 0.0, 3.0, 6.0], [0.0, 6.0, 5.0, 7.0]],
        &[[0.0, 0.0, 1.0, 7.0], [1.0, 0.0, 4.0, 1.0]],
        &[[0.0, 0.0, 1.0, 7.0], [1.0, 6.0, 4.0, 7.0], [1.0, 3.0, 3.5, 4.0]],
        &[[0.0, 0.0, 1.0, 7.0], [4.0, 0.0, 5.0, 7.0], [1.0, 0.0, 4.0, 1.0], [1.0, 6.0, 4.0, 7.0]],
    ];
    for i in 0..12 {
        let (row, column) = (i / 4, i % 4);
        let scale = kind.either(1.0, 0.7) * kind.numbers.from(0.8, 1.1);
        let at = Vec3::new(-16.0 + 8.5 * column as f32, 0.0, -13.0 + 10.0 * row as f32);
        for (stroke, [left, bottom, right, top]) in glyphs[(i * 5 + kind.variant as usize) % 6].iter().enumerate() {
            // Strokes reach into one another by a little, so that no two share a side.
            let (low, deep) = (Vec3::new(*left - 0.05, *bottom, 0.0), 0.8 + 0.02 * stroke as f32);
            kind.cuboid(at + low * scale, at + Vec3::new(*right + 0.05, *top, deep) * scale);
        }
    }
    kind.scene()
}

/// Spiral stairs under a raking light.
///
/// `variant` is 0 or 1; others count as 1.
///
/// # Panics
/// Never: the views are constants.
pub fn stairs(variant: u32) -> Scene {
    let mut kind = Kind::new(["stairs", "stairs-2"], variant, [(9.0, 150.0), (16.0, 40.0)]);
    let steps = kind.either(28, 40);
    for i in 0..steps {
        let turn = 540.0 * i as f32 / steps as f32;
        let (sin, cos) = turn.to_radians().sin_cos();
        let middle = Vec3::new(6.0 * cos, 0.4 + 12.0 * i as f32 / steps as f32, 6.0 * sin);
        kind.turned(middle, Vec3::new(3.5, 0.15, 1.0), Vec3::Y, -turn);
        let outer = Vec3::new(9.2 * cos, middle.y, 9.2 * sin);
        kind.rod(outer, outer + Vec3::Y * 2.4, 0.06);
    }
    kind.rod(Vec3::ZERO, Vec3::Y * 15.0, 1.1);
    kind.scene()
}

/// Louvres, and sheets a thousandth of the scene apart.
///
/// `variant` is 0 or 1; others count as 1.
///
/// # Panics
/// Never: the views are constants.
pub fn louvres(variant: u32) -> Scene {
    let mut kind = Kind::new(["louvres", "louvres-2"], variant, [(40.0, 80.0), (55.0, 120.0)]);
    for i in 0..14 {
        let at = Vec3::new(-8.0, 1.2 + 0.85 * i as f32, -6.0);
        kind.turned(at, Vec3::new(8.0, 0.06, 0.7), Vec3::X, kind.either(35.0, -20.0));
    }
    for i in 0..5 {
        let (y, x) = (3.0 + 0.05 * i as f32, 8.0 + 0.6 * i as f32);
        kind.turned(Vec3::new(x, y, 6.0), Vec3::new(6.0, 0.004, 5.0), Vec3::Z, kind.either(0.0, 12.0));
    }
    kind.scene()
}

/// City blocks, 10⁶ units from the origin in the second variant.
///
/// `variant` is 0 or 1; others count as 1.
///
/// # Panics
/// Never: the views are constants.
pub fn city(variant: u32) -> Scene {
    let mut kind = Kind::new(["city", "city-2"], variant, [(33.0, 100.0), (24.0, 50.0)]);
    for i in 0..100 {
        let (x, z) = (-20.0 + 4.0 * (i % 10) as f32, -20.0 + 4.0 * (i / 10) as f32);
        let low = Vec3::new(x + kind.numbers.from(0.2, 0.6), 0.0, z + kind.numbers.from(0.2, 0.6));
        let size = Vec3::new(kind.numbers.from(1.6, 2.8), kind.numbers.from(0.5, 7.0), kind.numbers.from(1.6, 2.8));
        kind.cuboid(low, low + size);
        if i % 3 == 0 {
            let roof = low + Vec3::new(0.3, size.y, 0.3);
            kind.rod(roof, roof + Vec3::Y * 1.8, 0.05);
        }
    }
    let far = kind.either(DVec3::ZERO, DVec3::new(1_000_000.0, -200_000.0, 600_000.0));
    kind.scene().moved(far).expect("a place")
}

/// Gears, a centimetre in all where a world unit is a metre.
///
/// `variant` is 0 or 1; others count as 1.
///
/// # Panics
/// Never: the views are constants.
pub fn gears(variant: u32) -> Scene {
    let mut kind = Kind::new(["gears", "gears-2"], variant, [(48.0, 65.0), (-60.0, 100.0)]);
    let gear = |kind: &mut Kind, at: Vec3, radius: f32, teeth: u32| {
        let axle = at + Vec3::Y * 1.2;
        kind.solid(Mesh::cylinder(at, axle, radius, 48));
        kind.solid(Mesh::cylinder(at + Vec3::Y * 1.2, at + Vec3::Y * 3.5, 0.5, 16));
        for tooth in 0..teeth {
            let turn = 360.0 * tooth as f32 / teeth as f32;
            let (sin, cos) = turn.to_radians().sin_cos();
            let middle = at + Vec3::new(cos, 0.0, sin) * (radius + 0.3) + Vec3::Y * 0.6;
            kind.turned(middle, Vec3::new(0.45, 0.55, 0.3), Vec3::Y, -turn);
        }
    };
    for i in 0..6 {
        let (x, z) = (-12.0 + 11.0 * (i % 3) as f32, -8.0 + 13.0 * (i / 3) as f32);
        let (lift, radius) = (kind.numbers.from(0.02, 2.5), kind.numbers.from(2.6, 4.4));
        let teeth = kind.either(20, 31);
        gear(&mut kind, Vec3::new(x, lift, z), radius, teeth);
    }
    kind.scene().scaled(2e-4).expect("a size")
}

/// Hair and grass: two-sided blades far thinner than a texel.
///
/// `variant` is 0 or 1; others count as 1.
///
/// # Panics
/// Never: the views are constants.
pub fn hair(variant: u32) -> Scene {
    let mut kind = Kind::new(["hair", "hair-2"], variant, [(50.0, 110.0), (30.0, 75.0)]);
    for _ in 0..kind.either(900, 1500) {
        let root = Vec3::new(kind.numbers.from(-16.0, 16.0), 0.0, kind.numbers.from(-16.0, 16.0));
        let (turn, height) = (kind.numbers.from(0.0, std::f32::consts::TAU), kind.numbers.from(2.0, 5.0));
        let (side, lean) = (Vec3::new(turn.cos(), 0.0, turn.sin()), Vec3::new(-turn.sin(), 0.0, turn.cos()));
        let width = kind.numbers.from(0.03, 0.09);
        let at = |share: f32| root + Vec3::Y * height * share + lean * height * 0.4 * share * share;
        let mut blade = Mesh::default();
        for i in 0..3 {
            let (a, b) = (i as f32 / 3.0, (i + 1) as f32 / 3.0);
            let (wide, narrow) = (side * width * (1.0 - a), side * width * (1.0 - b).max(0.05));
            let corners = [at(a) - wide, at(a) + wide, at(b) + narrow, at(b) - narrow];
            blade.append(&Mesh::sheet(corners, 1));
        }
        kind.sheet(blade);
    }
    kind.scene()
}

/// Spoked wheels.
///
/// `variant` is 0 or 1; others count as 1.
///
/// # Panics
/// Never: the views are constants.
pub fn wheels(variant: u32) -> Scene {
    let mut kind = Kind::new(["wheels", "wheels-2"], variant, [(42.0, 95.0), (-55.0, 30.0)]);
    for i in 0..5 {
        let radius = kind.numbers.from(4.0, 6.0);
        let hub = Vec3::new(-14.0 + 7.0 * i as f32, radius + 0.3, kind.numbers.from(-10.0, 8.0));
        let turn = kind.numbers.from(-0.8, 0.8);
        let (along, axis) = (Vec3::new(turn.cos(), 0.0, turn.sin()), Vec3::new(-turn.sin(), 0.0, turn.cos()));
        kind.solid(Mesh::torus(hub, axis, radius, 0.25, 64));
        kind.rod(hub - axis * 0.7, hub + axis * 0.7, 0.4);
        let spokes = kind.either(18, 26);
        for spoke in 0..spokes {
            let (sin, cos) = (std::f32::consts::TAU * spoke as f32 / spokes as f32).sin_cos();
            let way = along * cos + Vec3::Y * sin;
            kind.rod(hub + axis * 0.3 + way * 0.2, hub + way * radius, 0.045);
        }
    }
    kind.scene()
}

/// A pergola over a room without a ceiling.
///
/// `variant` is 0 or 1; others count as 1.
///
/// # Panics
/// Never: the views are constants.
pub fn pergola(variant: u32) -> Scene {
    let mut kind = Kind::new(["pergola", "pergola-2"], variant, [(52.0, 60.0), (35.0, 110.0)]);
    for (low, high) in [
        (Vec3::new(-15.0, 0.0, -15.0), Vec3::new(15.0, 9.0, -14.4)),
        (Vec3::new(-15.0, 0.0, -14.3), Vec3::new(-14.4, 9.0, 15.0)),
    ] {
        kind.cuboid(low, high);
    }
    let beams = kind.either(16, 24);
    for i in 0..beams {
        let at = -13.5 + 27.0 * i as f32 / beams as f32;
        kind.cuboid(Vec3::new(at, 9.1, -15.0), Vec3::new(at + 0.4, 9.9, 14.0));
        if i % 3 == 0 {
            kind.cuboid(Vec3::new(-15.0, 9.95, at), Vec3::new(14.0, 10.4, at + 0.3));
        }
    }
    for corner in [Vec3::new(13.0, 0.0, 12.0), Vec3::new(13.0, 0.0, -12.0), Vec3::new(-12.0, 0.0, 12.5)] {
        kind.rod(corner, corner + Vec3::Y * 9.05, 0.5);
    }
    kind.scene()
}
