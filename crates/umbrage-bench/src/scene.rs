//! A knotted tube on a ground: what its light sees, and what a camera sees of it.

use crate::meshes::{Mesh, knot_on_ground};
use crate::peers::rays::{Disc, Tree};
use glam::{DVec2, DVec3, UVec2, Vec3};
use umbrage_plane::{Place, Receiver, SurfacePoint, View};

/// Half-extent of the regions that filters look at, texels: sixteen taps in 6 × 6 texels.
pub const HALF: f32 = 3.0;

/// The light's place.
const LIGHT: DVec3 = DVec3::new(3.0, 14.0, 2.0);
/// The camera's.
const CAMERA: DVec3 = DVec3::new(0.0, 14.0, 9.0);

/// The triangles, and the regions that a camera sees.
#[derive(Debug)]
pub struct Scene {
    /// The triangles.
    pub mesh: Mesh,
    /// One for each pixel that is looked up, row by row, with the pixel's extent on the surface.
    pub points: Vec<SurfacePoint>,
}

/// Segments along and around the tube.
#[derive(Clone, Copy, Debug)]
pub struct Segments(pub u32, pub u32);

impl Segments {
    /// 75 thousand triangles.
    pub const MEDIUM: Self = Self(612, 61);
    /// 1.01 million.
    pub const LARGE: Self = Self(2236, 226);
    /// 3 thousand.
    pub const SMALL: Self = Self(100, 15);
}

impl Scene {
    /// A scene seen by `side`² pixels.
    pub fn new(segments: Segments, side: u32) -> Self {
        Self::sparse(segments, side, 1)
    }

    /// A scene seen by the first of every `step` pixels of `side`²: less to do, with regions as small as a whole picture's.
    ///
    /// # Panics
    /// When `step` is 0.
    pub fn sparse(Segments(along, around): Segments, side: u32, step: usize) -> Self {
        let mesh = knot_on_ground(along, around);
        let points = seen(&mesh, side, step);
        Self { mesh, points }
    }

    /// What the light's map of `side`² texels shows: all that the camera sees, with room for regions around it.
    ///
    /// # Panics
    /// When `side` is not a size of a map.
    pub fn view(side: u32) -> View {
        let (target, angle) = (DVec3::new(0.0, 0.0, -1.0), 68f64.to_radians());
        View::perspective(LIGHT, target, DVec3::NEG_Z, angle, 4.0, 60.0, UVec2::splat(side)).expect("a valid view")
    }

    /// A light of a size at the place of the view, for rays.
    pub fn disc() -> Disc {
        Disc { centre: LIGHT.as_vec3(), radius: 0.1 }
    }

    /// The points as a view sees them.
    ///
    /// # Panics
    /// When the region around one reaches out of the map.
    pub fn receivers(&self, view: &View) -> Vec<Receiver> {
        let mut seen = vec![Err(Place::Behind); self.points.len()];
        view.receivers(&self.points, &mut seen);
        let receiver = |seen: Result<Receiver, Place>| {
            let receiver = seen.expect("the light sees all that the camera sees");
            assert!(view.holds(receiver.texel.as_vec2(), glam::Vec2::splat(HALF)), "{:?}", receiver.texel);
            receiver
        };
        seen.into_iter().map(receiver).collect()
    }
}

/// Biases for a view's texels, world units: what Reeves draws from .3 to .4 for a map of his time.
pub fn bias(view: &View) -> [f32; 2] {
    let texel = view.texel_world(LIGHT.y).max_element() as f32;
    [4.0 * texel, 5.0 * texel]
}

/// What the first of every `step` pixels of a camera of `side`² sees.
fn seen(mesh: &Mesh, side: u32, step: usize) -> Vec<SurfacePoint> {
    let tree = Tree::of_eight(mesh);
    let ahead = (DVec3::new(0.0, 0.5, 0.0) - CAMERA).normalize();
    let right = ahead.cross(DVec3::Y).normalize();
    let down = ahead.cross(right);
    let half = 14f64.to_radians().tan();
    let direction = |pixel: DVec2| {
        let unit = (pixel * (2.0 / f64::from(side)) - 1.0) * half;
        ahead + right * unit.x + down * unit.y
    };
    let point = |region: u32| {
        let pixel = DVec2::new(f64::from(region % side), f64::from(region / side));
        let middle = direction(pixel + 0.5);
        let triangle = tree.nearest(CAMERA.as_vec3(), middle.as_vec3()).expect("the ground is everywhere");
        let [a, b, c] = mesh.corners(triangle).map(Vec3::as_dvec3);
        let normal = (b - a).cross(c - a).normalize();
        let normal = if normal.dot(middle) < 0.0 { normal } else { -normal };
        let on_plane = |direction: DVec3| CAMERA + direction * (normal.dot(a - CAMERA) / normal.dot(direction));
        let point = SurfacePoint::at(on_plane(middle), normal.as_vec3());
        let point = SurfacePoint { region, object: u32::from(triangle < mesh.solid), ..point };
        let corners = [(0.0, 0.0), (1.0, 0.0), (1.0, 1.0), (0.0, 1.0)].map(|at| direction(pixel + DVec2::from(at)));
        // Beyond a silhouette, the tangent plane leaves the surface far behind.
        let grazing = corners.iter().any(|corner| normal.dot(*corner) > -0.02);
        if grazing { point } else { point.with_corners(corners.map(on_plane)) }
    };
    (0..side * side).step_by(step).map(point).collect()
}
