//! Cameras and lights from constants.

use crate::Light;
use glam::{DVec3, UVec2};
use umbrage_plane::View;

/// A camera from `eye` toward `target` with y up: full field of view across in degrees, near and far plane in world
/// units.
pub(super) fn camera(eye: [f64; 3], target: [f64; 3], fov_deg: f64, [near, far]: [f64; 2], size: UVec2) -> View {
    View::perspective(eye.into(), target.into(), DVec3::Y, fov_deg.to_radians(), near, far, size)
        .expect("a constant view is valid")
}

/// [`Light::point`] with a square map of `side` texels.
pub(super) fn lamp(eye: DVec3, target: DVec3, fov_deg: f64, [near, far]: [f64; 2], side: u32) -> Light {
    Light::point("lamp", eye, target, fov_deg, near, far, UVec2::splat(side)).expect("a constant view is valid")
}

/// [`Light::directional`] with a square map of `side` texels that reaches `half` world units to either side of
/// `target` and as far before and behind it.
pub(super) fn sun(to_light: DVec3, target: DVec3, half: f64, side: u32) -> Light {
    Light::directional("sun", to_light, target, half, half * 0.5, half * 2.5, UVec2::splat(side))
        .expect("a constant view is valid")
}

/// The direction to a light from its elevation above the horizon and its bearing from +x toward +z, degrees. Unit.
pub(super) fn toward(elevation_deg: f64, bearing_deg: f64) -> DVec3 {
    let (up, out) = elevation_deg.to_radians().sin_cos();
    let (z, x) = bearing_deg.to_radians().sin_cos();
    DVec3::new(out * x, up, out * z)
}
