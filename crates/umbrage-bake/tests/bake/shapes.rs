//! Triangles to bake.

use glam::Vec3;
use umbrage_raster::Triangle;

fn triangle(corners: [Vec3; 3], object: u32, sheet: bool) -> Triangle {
    Triangle::new(corners, object, sheet)
}

/// The two triangles of a four-sided piece, counter-clockwise from its outside.
pub fn quad([a, b, c, d]: [Vec3; 4], object: u32, sheet: bool) -> [Triangle; 2] {
    [triangle([a, b, c], object, sheet), triangle([a, c, d], object, sheet)]
}

/// A closed box between two corners.
pub fn cuboid(min: Vec3, max: Vec3, object: u32, sheet: bool) -> Vec<Triangle> {
    let corner = |index: usize| {
        let bound = |axis: usize| if index >> axis & 1 == 1 { max[axis] } else { min[axis] };
        Vec3::new(bound(0), bound(1), bound(2))
    };
    let faces = [[0, 4, 6, 2], [1, 3, 7, 5], [0, 1, 5, 4], [2, 6, 7, 3], [0, 2, 3, 1], [4, 5, 7, 6]];
    faces.iter().flat_map(|face| quad(face.map(corner), object, sheet)).collect()
}

/// A ball of `2 × rings` columns: its triangles, each with the directions from the centre to its corners.
pub fn ball(centre: Vec3, radius: f32, rings: usize, object: u32) -> Vec<(Triangle, [Vec3; 3])> {
    let columns = 2 * rings;
    let direction = |ring: usize, column: usize| {
        let polar = std::f32::consts::PI * ring as f32 / rings as f32;
        let around = std::f32::consts::TAU * (column % columns) as f32 / columns as f32;
        match ring {
            0 => Vec3::Y,
            _ if ring == rings => Vec3::NEG_Y,
            _ => Vec3::new(polar.sin() * around.sin(), polar.cos(), polar.sin() * around.cos()),
        }
    };
    let mut made = Vec::new();
    for (ring, column) in (0..rings).flat_map(|ring| (0..columns).map(move |column| (ring, column))) {
        let [a, b] = [direction(ring, column), direction(ring, column + 1)];
        let [c, d] = [direction(ring + 1, column), direction(ring + 1, column + 1)];
        let mut add =
            |ways: [Vec3; 3]| made.push((triangle(ways.map(|way| centre + radius * way), object, false), ways));
        if ring + 1 < rings {
            add([a, c, d]);
        }
        if ring > 0 {
            add([a, d, b]);
        }
    }
    made
}
