use crate::Mesh;
use glam::{DVec3, Vec3};
use std::f64::consts::{PI, TAU};

impl Mesh {
    /// Segments of a sphere whose outline leaves a circle by less than 1/13,000 of its radius.
    pub const FINE: u32 = 256;

    /// A closed sphere with poles along y, one surface: `segments` around (at least 3), half as many from pole to pole
    /// (at least 2). `radius` is in world units and positive.
    ///
    /// Every place is one vertex, poles and seam included; normals are the sphere's own.
    pub fn sphere(centre: Vec3, radius: f32, segments: u32) -> Self {
        let (columns, rings) = (segments.max(3), (segments / 2).max(2));
        let mut mesh = Self::default();
        mesh.on_sphere(centre, radius, DVec3::Y);
        for ring in 1..rings {
            let (sin, cos) = (PI * f64::from(ring) / f64::from(rings)).sin_cos();
            for column in 0..columns {
                let (z, x) = turn(column, columns);
                mesh.on_sphere(centre, radius, DVec3::new(sin * x, cos, sin * z));
            }
        }
        mesh.on_sphere(centre, radius, DVec3::NEG_Y);
        let at = |ring: u32, column: u32| match ring {
            0 => 0,
            _ if ring == rings => 1 + (rings - 1) * columns,
            _ => 1 + (ring - 1) * columns + column % columns,
        };
        for ring in 0..rings {
            for column in 0..columns {
                let (a, b) = (at(ring, column), at(ring, column + 1));
                let (c, d) = (at(ring + 1, column + 1), at(ring + 1, column));
                mesh.quad([a, b, c, d], 0);
            }
        }
        mesh
    }

    /// A closed box between two corners, six surfaces in the order −x, +x, −y, +y, −z, +z. `min` is below `max` on
    /// every axis.
    pub fn cuboid(min: Vec3, max: Vec3) -> Self {
        let mut mesh = Self::default();
        for axis in 0..3 {
            let (across, up) = ((axis + 1) % 3, (axis + 2) % 3);
            for (side, bound) in [min, max].into_iter().enumerate() {
                let corner = |a: Vec3, b: Vec3| {
                    let mut at = bound;
                    at[across] = a[across];
                    at[up] = b[up];
                    at
                };
                let ring = [corner(min, min), corner(max, min), corner(max, max), corner(min, max)];
                let outward = Vec3::AXES[axis] * [-1.0, 1.0][side];
                let first = mesh.positions.len() as u32;
                for at in ring {
                    mesh.vertex(at, outward);
                }
                let [a, b, c, d] = [0, 1, 2, 3].map(|corner| first + corner);
                mesh.quad(if side == 0 { [d, c, b, a] } else { [a, b, c, d] }, (2 * axis + side) as u32);
            }
        }
        mesh
    }

    /// An open four-sided sheet, bilinear between corners given counter-clockwise from its front, cut into
    /// `divisions` × `divisions` pieces (at least 1). One surface. Normals are those of the bilinear surface; a sheet without area has normals of 0.
    pub fn sheet(corners: [Vec3; 4], divisions: u32) -> Self {
        let n = divisions.max(1);
        let [a, b, c, d] = corners.map(Vec3::as_dvec3);
        let mut mesh = Self::default();
        for row in 0..=n {
            let v = f64::from(row) / f64::from(n);
            for column in 0..=n {
                let u = f64::from(column) / f64::from(n);
                let at = a.lerp(b, u).lerp(d.lerp(c, u), v);
                let normal = (b - a).lerp(c - d, v).cross((d - a).lerp(c - b, u)).normalize_or_zero();
                mesh.vertex(at.as_vec3(), normal.as_vec3());
            }
        }
        let at = |row: u32, column: u32| row * (n + 1) + column;
        for row in 0..n {
            for column in 0..n {
                mesh.quad([at(row, column), at(row, column + 1), at(row + 1, column + 1), at(row + 1, column)], 0);
            }
        }
        mesh
    }

    /// A closed cylinder from the centre of its base to the centre of its top (which differ), three surfaces: side,
    /// base, top. At least 3 segments; `radius` is in world units and positive.
    pub fn cylinder(base: Vec3, top: Vec3, radius: f32, segments: u32) -> Self {
        let n = segments.max(3);
        let axis = (top - base).as_dvec3().normalize_or_zero();
        let (across, up) = axis.any_orthonormal_pair();
        let mut mesh = Self::default();
        let outward = |column: u32| {
            let (sin, cos) = turn(column, n);
            across * cos + up * sin
        };
        let rim = |end: Vec3, column: u32| (end.as_dvec3() + outward(column) * f64::from(radius)).as_vec3();
        for end in [base, top] {
            for column in 0..n {
                mesh.vertex(rim(end, column), outward(column).as_vec3());
            }
        }
        for column in 0..n {
            let next = (column + 1) % n;
            mesh.quad([column, next, n + next, n + column], 0);
        }
        for (surface, end, normal) in [(1, base, -axis), (2, top, axis)] {
            let centre = mesh.positions.len() as u32;
            mesh.vertex(end, normal.as_vec3());
            for column in 0..n {
                mesh.vertex(rim(end, column), normal.as_vec3());
            }
            for column in 0..n {
                let (from, to) = (centre + 1 + column, centre + 1 + (column + 1) % n);
                mesh.triangle(if surface == 1 { [centre, to, from] } else { [centre, from, to] }, surface);
            }
        }
        mesh
    }

    /// A closed ring around `axis` (any length but 0): the circle of radius `major` carries a tube of radius `minor`,
    /// both in world units, 0 < minor < major. `segments` along the ring, half as many around the tube (at least 3). One surface.
    pub fn torus(centre: Vec3, axis: Vec3, major: f32, minor: f32, segments: u32) -> Self {
        let (n, m) = (segments.max(3), (segments / 2).max(3));
        let axis = axis.as_dvec3().normalize_or_zero();
        let (across, up) = axis.any_orthonormal_pair();
        let mut mesh = Self::default();
        for column in 0..n {
            let (sin, cos) = turn(column, n);
            let spoke = across * cos + up * sin;
            for row in 0..m {
                let (sin, cos) = turn(row, m);
                let normal = spoke * cos + axis * sin;
                let at = centre.as_dvec3() + spoke * f64::from(major) + normal * f64::from(minor);
                mesh.vertex(at.as_vec3(), normal.as_vec3());
            }
        }
        let at = |column: u32, row: u32| column % n * m + row % m;
        for column in 0..n {
            for row in 0..m {
                mesh.quad([at(column, row), at(column + 1, row), at(column + 1, row + 1), at(column, row + 1)], 0);
            }
        }
        mesh
    }

    fn on_sphere(&mut self, centre: Vec3, radius: f32, direction: DVec3) {
        self.vertex((centre.as_dvec3() + direction * f64::from(radius)).as_vec3(), direction.as_vec3());
    }

    pub(crate) fn vertex(&mut self, position: Vec3, normal: Vec3) {
        self.positions.push(position);
        self.normals.push(normal);
    }

    /// Two triangles, or the one that is left where two of the corners are the same place.
    pub(crate) fn quad(&mut self, [a, b, c, d]: [u32; 4], surface: u32) {
        self.triangle([a, b, c], surface);
        self.triangle([a, c, d], surface);
    }

    pub(crate) fn triangle(&mut self, corners: [u32; 3], surface: u32) {
        let [a, b, c] = corners.map(|corner| self.positions[corner as usize]);
        if a != b && b != c && c != a {
            self.triangles.push(corners);
            self.surfaces.push(surface);
        }
    }
}

/// Sine and cosine of part `step` of `steps` of a full turn.
fn turn(step: u32, steps: u32) -> (f64, f64) {
    (TAU * f64::from(step) / f64::from(steps)).sin_cos()
}
