//! A triangle in f64, and the point of it that lies nearest to another.

use glam::{DVec3, Vec3};

/// A face in f64, relative to the geometry's origin, with its unit normal; zero for a triangle without area.
#[derive(Clone, Copy)]
pub(crate) struct Triangle {
    pub corners: [DVec3; 3],
    pub normal: DVec3,
}

impl Triangle {
    pub fn new(corners: [Vec3; 3]) -> Self {
        let corners = corners.map(Vec3::as_dvec3);
        let [a, b, c] = corners;
        Self { corners, normal: (b - a).cross(c - a).normalize_or_zero() }
    }

    /// The box around it.
    pub fn bounds(&self) -> (DVec3, DVec3) {
        let [a, b, c] = self.corners;
        (a.min(b).min(c), a.max(b).max(c))
    }

    /// The longest side of that box.
    pub fn size(&self) -> f64 {
        let (low, high) = self.bounds();
        (high - low).max_element()
    }

    /// The barycentric weights of a point of its plane, clamped to the triangle; all of the first corner where it has no area, and for a
    /// point that is not finite.
    pub fn weights(&self, at: DVec3) -> DVec3 {
        let [a, b, c] = self.corners;
        let (normal, from) = ((b - a).cross(c - a), at - a);
        let squared = normal.length_squared();
        let (v, w) = (from.cross(c - a).dot(normal) / squared, (b - a).cross(from).dot(normal) / squared);
        if v.is_nan() || w.is_nan() {
            return DVec3::X;
        }
        let v = v.clamp(0.0, 1.0);
        let w = w.clamp(0.0, 1.0 - v);
        DVec3::new(1.0 - v - w, v, w)
    }

    /// Its point that is nearest to another (Ericson 2005, 5.1.5).
    pub fn nearest(&self, at: DVec3) -> DVec3 {
        let [a, b, c] = self.corners;
        let (ab, ac) = (b - a, c - a);
        let [from_a, from_b, from_c] = self.corners.map(|corner| at - corner);
        let (d1, d2) = (ab.dot(from_a), ac.dot(from_a));
        if d1 <= 0.0 && d2 <= 0.0 {
            return a;
        }
        let (d3, d4) = (ab.dot(from_b), ac.dot(from_b));
        if d3 >= 0.0 && d4 <= d3 {
            return b;
        }
        let (d5, d6) = (ab.dot(from_c), ac.dot(from_c));
        if d6 >= 0.0 && d5 <= d6 {
            return c;
        }
        let along_ab = d1 * d4 - d3 * d2;
        if along_ab <= 0.0 && d1 >= 0.0 && d3 <= 0.0 {
            return a + ab * (d1 / (d1 - d3));
        }
        let along_ac = d5 * d2 - d1 * d6;
        if along_ac <= 0.0 && d2 >= 0.0 && d6 <= 0.0 {
            return a + ac * (d2 / (d2 - d6));
        }
        let along_bc = d3 * d6 - d5 * d4;
        if along_bc <= 0.0 && d4 >= d3 && d5 >= d6 {
            return b + (c - b) * ((d4 - d3) / ((d4 - d3) + (d5 - d6)));
        }
        at - self.normal * self.normal.dot(from_a)
    }
}
