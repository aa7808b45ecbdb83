use crate::Mesh;
use glam::{DMat3, DMat4, DVec2, DVec3, Vec3};
use std::f64::consts::TAU;

/// Two legs of a profile that turn by more than this meet in a crease; cosine of 40°.
const SMOOTH: f64 = 0.766;

impl Mesh {
    /// A closed solid of revolution, as from a lathe: `profile` is (radius, height) pairs in world units, radii not
    /// negative, turned about the line from `base` along `axis` (any length but 0). At least 3 segments.
    ///
    /// The outside is to the right of the profile as it is walked: from bottom to top for a solid whose two ends lie on
    /// the axis, counter-clockwise in the (radius, height) plane for a ring. A profile whose ends are not both on the
    /// axis is closed from its last point to its first; such a ring has at least three. Legs that turn by more than 40°
    /// meet in a crease; each smooth run is a surface, in order. Repeated points and a profile without a leg off the axis leave nothing.
    pub fn lathe(base: Vec3, axis: Vec3, profile: &[(f32, f32)], segments: u32) -> Self {
        let n = segments.max(3);
        let legs = legs(profile);
        let axis = axis.as_dvec3().normalize_or_zero();
        let (across, up) = axis.any_orthonormal_pair();
        let mut mesh = Self::default();
        let mut surface = 0;
        for (index, leg) in legs.iter().enumerate() {
            let before = &legs[(index + legs.len() - 1) % legs.len()];
            let after = &legs[(index + 1) % legs.len()];
            surface += u32::from(index > 0 && !leg.follows(before));
            let ends = [(leg.from, leg.normal_beside(before)), (leg.to, leg.normal_beside(after))];
            let first = mesh.positions.len() as u32;
            for column in 0..n {
                let (sin, cos) = (TAU * f64::from(column) / f64::from(n)).sin_cos();
                let spoke = across * cos + up * sin;
                for (at, normal) in ends {
                    let place = base.as_dvec3() + spoke * at.x + axis * at.y;
                    mesh.vertex(place.as_vec3(), (spoke * normal.x + axis * normal.y).as_vec3());
                }
            }
            for column in 0..n {
                let (low, low_next) = (first + 2 * column, first + 2 * ((column + 1) % n));
                mesh.quad([low, low_next, low_next + 1, low + 1], surface);
            }
        }
        mesh
    }

    /// A closed round tube of one radius along a path of at least two points, all apart, mitred where it bends and flat at
    /// its ends: three surfaces (side, start, end). At least 3 segments around; a path of fewer points leaves nothing.
    ///
    /// Bends sharper than about a right angle grow long mitres; cut them into several.
    pub fn tube(path: &[Vec3], radius: f32, segments: u32) -> Self {
        let n = segments.max(3);
        let mut mesh = Self::default();
        let path: Vec<DVec3> = path.iter().map(|at| at.as_dvec3()).collect();
        let legs: Vec<DVec3> = path.windows(2).map(|leg| (leg[1] - leg[0]).normalize_or_zero()).collect();
        let (Some(&start), Some(&end)) = (legs.first(), legs.last()) else { return mesh };
        // A frame that is carried along without twisting: a circle square to a leg, slid along that leg onto each mitre.
        let (across, up) = start.any_orthonormal_pair();
        let mut ring: Vec<DVec3> = (0..n)
            .map(|column| {
                let (sin, cos) = (TAU * f64::from(column) / f64::from(n)).sin_cos();
                across * cos + up * sin
            })
            .collect();
        for (index, centre) in path.iter().enumerate() {
            let ahead = legs[index.min(legs.len() - 1)];
            let behind = legs[index.saturating_sub(1)];
            let mitre = (ahead + behind).normalize_or(ahead);
            for spoke in &mut ring {
                let slid = *spoke - behind * (spoke.dot(mitre) / behind.dot(mitre).max(0.1));
                let side = (slid - mitre * slid.dot(mitre)).normalize_or_zero();
                mesh.vertex((*centre + slid * f64::from(radius)).as_vec3(), side.as_vec3());
                *spoke = (slid - ahead * slid.dot(ahead)).normalize_or_zero();
            }
        }
        for ring in 0..path.len() as u32 - 1 {
            for column in 0..n {
                let (a, b) = (ring * n + column, ring * n + (column + 1) % n);
                mesh.quad([a, b, b + n, a + n], 0);
            }
        }
        let last = (path.len() as u32 - 1) * n;
        for (surface, centre, rim, normal) in [(1, path[0], 0, -start), (2, path[path.len() - 1], last, end)] {
            let hub = mesh.positions.len() as u32;
            mesh.vertex(centre.as_vec3(), normal.as_vec3());
            for column in 0..n {
                let at = mesh.positions[(rim + column) as usize];
                mesh.vertex(at, normal.as_vec3());
            }
            for column in 0..n {
                let (from, to) = (hub + 1 + column, hub + 1 + (column + 1) % n);
                mesh.triangle(if surface == 1 { [hub, to, from] } else { [hub, from, to] }, surface);
            }
        }
        mesh
    }

    /// The same mesh through an affine map that can be undone. Normals stay square to the surface, and a mirrored mesh is
    /// turned right side out.
    #[must_use]
    pub fn transformed(mut self, map: &DMat4) -> Self {
        let linear = DMat3::from_mat4(*map);
        let across = linear.inverse().transpose();
        for at in &mut self.positions {
            *at = map.transform_point3(at.as_dvec3()).as_vec3();
        }
        for normal in &mut self.normals {
            *normal = (across * normal.as_dvec3()).normalize_or_zero().as_vec3();
        }
        if linear.determinant() < 0.0 {
            for corners in &mut self.triangles {
                corners.swap(1, 2);
            }
        }
        self
    }
}

/// One straight part of a profile, as (radius, height).
struct Leg {
    from: DVec2,
    to: DVec2,
    normal: DVec2,
}

impl Leg {
    /// Whether the surface goes on smoothly from a neighbouring leg to this one.
    fn follows(&self, other: &Self) -> bool {
        self.normal.dot(other.normal) >= SMOOTH && (self.from == other.to || self.to == other.from)
    }

    /// The normal where this leg meets a neighbour: shared if smooth, its own at a crease.
    fn normal_beside(&self, other: &Self) -> DVec2 {
        if self.follows(other) { (self.normal + other.normal).normalize_or(self.normal) } else { self.normal }
    }
}

/// The legs of a profile that make surface: not points, not pieces of the axis.
fn legs(profile: &[(f32, f32)]) -> Vec<Leg> {
    let at = |(radius, height): (f32, f32)| DVec2::new(f64::from(radius), f64::from(height));
    let on_axis = |end: Option<&(f32, f32)>| end.is_some_and(|end| end.0 == 0.0);
    let open = on_axis(profile.first()) && on_axis(profile.last());
    let closing = profile.last().zip(profile.first()).filter(|_| !open).map(|(last, first)| [*last, *first]);
    let steps = profile.windows(2).map(|step| [step[0], step[1]]).chain(closing);
    steps
        .map(|step| step.map(at))
        .filter(|[from, to]| from != to && (from.x > 0.0 || to.x > 0.0))
        .map(|[from, to]| {
            let along = (to - from).normalize();
            Leg { from, to, normal: DVec2::new(along.y, -along.x) }
        })
        .collect()
}
