//! Places of triangles by where a map's texels look.

use glam::{DVec2, DVec3};
use umbrage_plane::{Projection, View};

/// Where a place of the map looks in eye space: (x/ζ, y/ζ, −1), or (x, y, 1) in an orthographic view.
pub(crate) fn ray(view: &View, texel: DVec2) -> DVec3 {
    let screen =
        DVec2::new(2.0, -2.0) * texel / view.size().as_dvec2() + DVec2::new(-1.0, 1.0) - view.projection().shift();
    match view.projection() {
        Projection::Perspective { k, .. } => (screen / k).extend(-1.0),
        Projection::Orthographic { half, .. } => (screen * half).extend(1.0),
    }
}

/// The corners of a triangle of eye space as [`ray`] has them: what it sees of the triangle is a mean of these, times a number.
pub(crate) fn places(view: &View, eye: [DVec3; 3]) -> [DVec3; 3] {
    eye.map(|at| if view.is_perspective() { at } else { DVec3::new(at.x, at.y, 1.0) })
}
