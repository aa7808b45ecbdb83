use glam::{DMat4, DVec4};

/// Flattens points onto a plane as a light throws their shadows there: S = (π·L)·I − L·πᵀ (Williams 1978).
///
/// `plane` is (n, d) with n·p + d = 0 on the plane, `light` a homogeneous point (w = 0: a direction toward the light). Divide by w
/// afterwards; w ≤ 0 (relative to the sign of π·L) marks points on the wrong side of a point light.
pub fn planar_shadow(plane: DVec4, light: DVec4) -> DMat4 {
    let outer = DMat4::from_cols(light * plane.x, light * plane.y, light * plane.z, light * plane.w);
    DMat4::from_diagonal(DVec4::splat(plane.dot(light))) - outer
}
