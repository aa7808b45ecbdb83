use crate::ViewError;
use glam::{DMat4, DVec3, DVec4};

/// What is up on a map whose light shines along `direction` or comes from there: +y of the world, or +z where the light
/// shines nearly along y (within about 2.6°).
pub fn up_for(direction: DVec3) -> DVec3 {
    if direction.normalize_or_zero().y.abs() < 0.999 { DVec3::Y } else { DVec3::Z }
}

/// World to eye space of an eye that looks at a target.
pub(crate) fn look_at(eye: DVec3, target: DVec3, up: DVec3) -> Result<DMat4, ViewError> {
    ViewError::of_finite("eye", eye)?;
    ViewError::of_finite("target", target)?;
    ViewError::of_finite("up", up)?;
    let forward = (target - eye).try_normalize().ok_or(ViewError::NoDirection { eye, target })?;
    let right = forward.cross(up).try_normalize().ok_or(ViewError::Up { up, ahead: forward })?;
    let up = right.cross(forward);
    let axes = DMat4::from_cols(right.extend(0.0), up.extend(0.0), (-forward).extend(0.0), DVec4::W);
    Ok(axes.transpose() * DMat4::from_translation(-eye))
}
