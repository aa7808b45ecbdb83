//! Bodies with known shadows.
use glam::{DMat3, DVec3, Vec3};
use umbrage_oracle::Face;

/// The eight-cornered box between two points, turned by `turn` about the origin.
pub fn cuboid(low: DVec3, high: DVec3, turn: DMat3, object: u32) -> Vec<Face> {
    let corner = |i: usize| {
        let pick = |bit: usize, a: f64, b: f64| if i >> bit & 1 == 0 { a } else { b };
        (turn * DVec3::new(pick(0, low.x, high.x), pick(1, low.y, high.y), pick(2, low.z, high.z))).as_vec3()
    };
    let quads = [[0, 2, 3, 1], [4, 5, 7, 6], [0, 1, 5, 4], [2, 6, 7, 3], [0, 4, 6, 2], [1, 3, 7, 5]];
    quads.iter().flat_map(|&quad| rectangle(quad.map(corner), object)).collect()
}

/// Two triangles, counter-clockwise as the corners are.
pub fn rectangle([a, b, c, d]: [Vec3; 4], object: u32) -> [Face; 2] {
    [Face { corners: [a, b, c], object }, Face { corners: [a, c, d], object }]
}

/// A floor at y = 0, seen from above, `half` to all sides.
pub fn floor(half: f32, object: u32) -> [Face; 2] {
    let corner = |x: f32, z: f32| Vec3::new(x * half, 0.0, z * half);
    rectangle([corner(-1.0, -1.0), corner(-1.0, 1.0), corner(1.0, 1.0), corner(1.0, -1.0)], object)
}

/// A closed sphere of `slices` × `slices / 2` patches, all vertices on the sphere (up to f32).
pub fn sphere(centre: DVec3, radius: f64, slices: u32, object: u32) -> Vec<Face> {
    let stacks = slices / 2;
    let vertex = |i: u32, j: u32| {
        let up = std::f64::consts::PI * f64::from(j) / f64::from(stacks);
        let around = std::f64::consts::TAU * f64::from(i % slices) / f64::from(slices);
        let ring = if j == 0 || j == stacks { 0.0 } else { up.sin() };
        (centre + radius * DVec3::new(ring * around.cos(), up.cos(), ring * around.sin())).as_vec3()
    };
    let mut faces = Vec::new();
    for j in 0..stacks {
        for i in 0..slices {
            let [a, b, c, d] = [vertex(i, j), vertex(i + 1, j), vertex(i + 1, j + 1), vertex(i, j + 1)];
            if j > 0 {
                faces.push(Face { corners: [a, b, c], object });
            }
            if j + 1 < stacks {
                faces.push(Face { corners: [a, c, d], object });
            }
        }
    }
    faces
}

/// Unit normal on the counter-clockwise side.
pub fn normal(face: &Face) -> DVec3 {
    let [a, b, c] = face.corners.map(Vec3::as_dvec3);
    (b - a).cross(c - a).normalize()
}
