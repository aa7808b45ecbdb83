//! A workshop's room and what stands in it.

use super::SLAB_THICKNESS;
use crate::Mesh;
use glam::{DMat4, Vec3};

/// Half the room's width: its side walls are at x = ±[`HALF_WIDTH`].
pub(super) const HALF_WIDTH: f32 = 62.0;
/// Its back wall is at z = −[`BACK`].
pub(super) const BACK: f32 = 48.0;
/// Its ceiling's height.
pub(super) const HEIGHT: f32 = 62.0;
/// Its open front is at z = [`OPEN`].
pub(super) const OPEN: f32 = 62.0;

/// The window in the left wall: least and greatest y and z.
pub(super) const WINDOW: [f32; 4] = [20.0, 48.0, -26.0, 12.0];

/// The left wall: four slabs around the window.
pub(super) fn window_wall() -> Mesh {
    let [low, high, far, near] = WINDOW;
    let (outside, inside) = (-HALF_WIDTH - SLAB_THICKNESS, -HALF_WIDTH);
    let slab = |y: [f32; 2], z: [f32; 2]| Mesh::cuboid(Vec3::new(outside, y[0], z[0]), Vec3::new(inside, y[1], z[1]));
    let mut mesh = slab([-2.0, low], [-BACK - 2.0, OPEN]);
    // Slabs run into one another by a little, so that no edge is shared and no light passes.
    mesh.append(&slab([high, HEIGHT + 2.0], [-BACK - 2.5, OPEN + 0.5]));
    mesh.append(&slab([low - 0.5, high + 0.5], [-BACK - 1.5, far]));
    mesh.append(&slab([low - 0.7, high + 0.7], [near, OPEN - 0.5]));
    mesh
}

/// The window's frame and its bars.
pub(super) fn window_bars() -> Mesh {
    let [low, high, far, near] = WINDOW;
    let middle = -HALF_WIDTH - 0.5 * SLAB_THICKNESS;
    let mut mesh = Mesh::default();
    for part in 0..=3u8 {
        let z = far + (near - far) * f32::from(part) / 3.0;
        let half = if part % 3 == 0 { 1.0 } else { 0.5 };
        mesh.append(&Mesh::cuboid(
            Vec3::new(middle - 0.6, low - 0.3, z - half),
            Vec3::new(middle + 0.6, high + 0.3, z + half),
        ));
    }
    for part in 0..=2u8 {
        let y = low + (high - low) * f32::from(part) / 2.0;
        let half = if part % 2 == 0 { 0.9 } else { 0.45 };
        mesh.append(&Mesh::cuboid(
            Vec3::new(middle - 0.5, y - half, far - 0.2),
            Vec3::new(middle + 0.5, y + half, near + 0.2),
        ));
    }
    mesh
}

/// Beams under the ceiling.
pub(super) fn beams() -> Mesh {
    let mut mesh = Mesh::default();
    for beam in 0..4u8 {
        let z = -34.0 + 26.0 * f32::from(beam);
        mesh.append(&Mesh::cuboid(
            Vec3::new(-HALF_WIDTH - 1.0, HEIGHT - 4.0, z - 1.6),
            Vec3::new(HALF_WIDTH + 1.0, HEIGHT + 1.0, z + 1.6),
        ));
    }
    mesh
}

/// Shelves along the back wall, and what is on them.
pub(super) struct Shelves {
    /// Uprights and boards.
    pub(super) wood: Mesh,
    /// Cartons in two tones.
    pub(super) boxes: [Mesh; 2],
    /// Tins in two colours.
    pub(super) tins: [Mesh; 2],
}

/// Five boards, 44 wide from x = `left`, filled from left to right with boxes and stacks of tins.
pub(super) fn shelves(left: f32) -> Shelves {
    const WIDTH: f32 = 44.0;
    let (back, front) = (-BACK + 0.2, -BACK + 10.0);
    let mut wood = Mesh::default();
    for upright in 0..3u8 {
        let x = left + 0.5 * (WIDTH - 1.2) * f32::from(upright);
        wood.append(&Mesh::cuboid(Vec3::new(x, 0.1, back), Vec3::new(x + 1.2, 45.5, front)));
    }
    let (mut boxes, mut tins) = (<[Mesh; 2]>::default(), <[Mesh; 2]>::default());
    let mut draw = 1u32;
    // A few numbers that look like none in particular, the same every time: 0 to `below` − 1.
    let mut pick = |below: u32| {
        draw = draw.wrapping_mul(747_796_405).wrapping_add(2_891_336_453);
        (draw >> 16) % below
    };
    for board in 0..5u8 {
        let y = 2.0 + 9.4 * f32::from(board);
        wood.append(&Mesh::cuboid(
            Vec3::new(left - 0.5, y, back + 0.1),
            Vec3::new(left + WIDTH + 0.5, y + 0.9, front + 0.4),
        ));
        let (floor, mut x) = (y + 0.92, left + 1.9);
        while x < left + WIDTH - 6.0 {
            let kind = pick(2) as usize;
            if pick(5) < 2 {
                let size =
                    Vec3::new(3.5 + 0.5 * pick(6) as f32, 3.0 + 0.5 * pick(8) as f32, 5.0 + 0.5 * pick(6) as f32);
                let corner = Vec3::new(x, floor, front - 0.8 - size.z - 0.2 * pick(6) as f32);
                boxes[kind].append(&Mesh::cuboid(corner, corner + size));
                x += size.x + 0.7;
            } else {
                let (radius, height) = (1.1 + 0.15 * pick(6) as f32, 2.2 + 0.4 * pick(5) as f32);
                for stacked in 0..=pick(2) {
                    let z = front - 1.0 - radius - 0.3 * pick(5) as f32;
                    let at = Vec3::new(x + radius, floor + (height + 0.03) * stacked as f32, z);
                    tins[kind].append(&tin(at, radius, height));
                }
                x += 2.0 * radius + 0.5;
            }
            // The middle upright stands here.
            let upright = left + 0.5 * (WIDTH - 1.2);
            if x > upright - 5.5 && x < upright + 1.8 {
                x = upright + 2.0;
            }
        }
    }
    Shelves { wood, boxes, tins }
}

/// A tin with beaded rims.
fn tin(at: Vec3, radius: f32, height: f32) -> Mesh {
    let (rim, lid) = (radius + 0.08, height - 0.18);
    let profile = [
        (0.0, 0.0),
        (radius, 0.0),
        (rim, 0.1),
        (radius, 0.2),
        (radius, height - 0.2),
        (rim, height - 0.1),
        (radius, height),
        (radius - 0.15, height),
        (radius - 0.25, lid),
        (0.0, lid),
    ];
    Mesh::lathe(at, Vec3::Y, &profile, 40)
}

/// A bench from x = `left` along the back wall, 40 wide: its wood, and the tools on it and above it.
pub(super) fn bench(left: f32) -> (Mesh, Mesh) {
    let (back, front) = (-BACK + 0.3, -BACK + 15.0);
    let mut wood = Mesh::cuboid(Vec3::new(left, 15.2, back), Vec3::new(left + 40.0, 17.0, front));
    for x in [left + 1.5, left + 35.5] {
        for z in [back + 1.0, front - 4.0] {
            wood.append(&Mesh::cuboid(Vec3::new(x, 0.1, z), Vec3::new(x + 3.0, 15.5, z + 3.0)));
        }
    }
    wood.append(&Mesh::cuboid(Vec3::new(left + 2.0, 5.0, back + 1.5), Vec3::new(left + 38.0, 6.0, front - 1.5)));
    let mut tools = Mesh::default();
    let mut add = |part: &Mesh| tools.append(part);
    // A vice.
    let vice = Vec3::new(left + 31.0, 17.0, front - 3.5);
    add(&Mesh::cuboid(vice + Vec3::new(-2.0, -0.1, -2.0), vice + Vec3::new(2.0, 1.2, 2.0)));
    add(&Mesh::cuboid(vice + Vec3::new(-1.6, 1.0, -1.0), vice + Vec3::new(1.6, 4.0, 0.4)));
    add(&Mesh::cuboid(vice + Vec3::new(-1.7, 1.1, 2.0), vice + Vec3::new(1.7, 4.1, 3.4)));
    add(&Mesh::tube(&[vice + Vec3::new(0.0, 2.4, -2.0), vice + Vec3::new(0.0, 2.4, 6.0)], 0.5, 24));
    add(&Mesh::tube(&[vice + Vec3::new(-2.4, 2.1, 5.4), vice + Vec3::new(2.4, 2.7, 5.4)], 0.22, 16));
    // Spanners on the wall, by size.
    for size in 0..7u8 {
        let length = 3.6 + 0.8 * f32::from(size);
        let hung = DMat4::from_translation(
            Vec3::new(left + 6.0 + 3.6 * f32::from(size), 37.0 - length, back + 0.1).as_dvec3(),
        );
        add(&spanner(length).transformed(&hung));
    }
    (wood, tools)
}

/// A spanner along +y, a ring at either end.
fn spanner(length: f32) -> Mesh {
    let ring = |y: f32, radius: f32| {
        let profile = [(0.55 * radius, -0.2), (radius, -0.2), (radius, 0.2), (0.55 * radius, 0.2)];
        Mesh::lathe(Vec3::new(0.0, y, 0.3), Vec3::Z, &profile, 32)
    };
    let mut mesh = Mesh::cuboid(Vec3::new(-0.32, 0.6, 0.16), Vec3::new(0.32, length - 0.6, 0.42));
    mesh.append(&ring(0.0, 0.95));
    mesh.append(&ring(length, 0.75));
    mesh
}
