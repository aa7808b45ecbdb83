//! Views around a light that shines in all directions: the six faces of a cube, or sectors about an axis.

use crate::{Kind, Projection, Rules, View, ViewError};
use glam::{DMat3, DMat4, DVec2, DVec3, UVec2};

/// Directions of the faces and what is up on each, in the order +X, −X, +Y, −Y, +Z, −Z.
const FACES: [(DVec3, DVec3); 6] = [
    (DVec3::X, DVec3::Y),
    (DVec3::NEG_X, DVec3::Y),
    (DVec3::Y, DVec3::NEG_Z),
    (DVec3::NEG_Y, DVec3::Z),
    (DVec3::Z, DVec3::Y),
    (DVec3::NEG_Z, DVec3::Y),
];

/// The six views of a cube map around `eye`, 90° wide, `side` texels square, in the order +X, −X, +Y, −Y, +Z, −Z (Reeves
/// 1987). They store Euclidean distance ([`Kind::Radial`]), so that a depth means the same on every face.
///
/// Faces are right-handed like all views: s to the right, t downward as seen from the light, with −Z up on +Y and +Z up on −Y.
/// Outside its rectangle a face compares: its neighbours answer there.
///
/// # Errors
/// As [`View::new`].
pub fn cube_views(eye: DVec3, near: f64, far: f64, side: u32) -> Result<[View; 6], ViewError> {
    let [a, b, c, d, e, f] =
        FACES.map(|(ahead, up)| looking(eye, ahead, up, DVec2::ONE, near, far, UVec2::splat(side)));
    Ok([a?, b?, c?, d?, e?, f?])
}

/// The face that a direction (any length but 0) meets and where, s and t in 0..=1 from its upper left. Where faces meet, the
/// first of the order +X, −X, +Y, −Y, +Z, −Z.
pub fn cube_face(direction: DVec3) -> (usize, DVec2) {
    let (mut face, mut most) = (0, f64::NEG_INFINITY);
    for (index, (ahead, _)) in FACES.into_iter().enumerate() {
        let along = ahead.dot(direction);
        if along > most {
            (face, most) = (index, along);
        }
    }
    let (ahead, up) = FACES[face];
    let (right, along) = (ahead.cross(up), ahead.dot(direction));
    let screen = DVec2::new(right.dot(direction), up.dot(direction)) / along;
    (face, DVec2::new(screen.x + 1.0, 1.0 - screen.y) * 0.5)
}

/// How a light's surroundings are cut into sectors about the vertical.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Sectors {
    /// Number of views, at least 3: each sees 360°/`count` of azimuth.
    pub count: u32,
    /// Extra azimuth that each view sees to either side, radians: as wide as the filter, so that no look-up goes on in a neighbour.
    pub margin: f64,
    /// Tangent of the highest elevation above and below the horizon that is seen.
    pub tan_elevation: f64,
    /// Columns and rows of each view.
    pub size: UVec2,
}

/// Views around `eye` about +y, sector i looking toward azimuth 2π·i/count from +x toward −z (Williams 1978). They store
/// Euclidean distance; outside they are lit.
///
/// # Errors
/// As [`View::new`]; also [`ViewError::Sectors`] for fewer than three sectors, or a margin that makes a sector 180° wide.
pub fn sector_views(eye: DVec3, near: f64, far: f64, sectors: &Sectors) -> Result<Vec<View>, ViewError> {
    let half = std::f64::consts::PI / f64::from(sectors.count) + sectors.margin;
    if !(sectors.count >= 3 && half < std::f64::consts::FRAC_PI_2) {
        return Err(ViewError::Sectors { count: sectors.count, half_radians: half });
    }
    let wide = 1.0 / half.tan();
    // The corners of a flat view see less elevation than its middle: what must be seen at its side.
    let k = DVec2::new(wide, half.cos() / sectors.tan_elevation);
    let one = |index: u32| {
        let (sin, cos) = (std::f64::consts::TAU * f64::from(index) / f64::from(sectors.count)).sin_cos();
        let view = looking(eye, DVec3::new(cos, 0.0, -sin), DVec3::Y, k, near, far, sectors.size)?;
        Ok(view.with_rules(Rules::OPEN))
    };
    (0..sectors.count).map(one).collect()
}

fn looking(eye: DVec3, ahead: DVec3, up: DVec3, k: DVec2, near: f64, far: f64, size: UVec2) -> Result<View, ViewError> {
    let axes = DMat3::from_cols(ahead.cross(up), up, -ahead);
    let world_to_eye = DMat4::from_mat3(axes.transpose()) * DMat4::from_translation(-eye);
    let view = View::new(world_to_eye, Projection::perspective(k), near, far, size)?;
    Ok(view.with_kind(Kind::Radial).with_rules(Rules::AROUND))
}
