//! What the figures of Reeves' sphere and plane share: ids, places to look at, masks.

use super::masks::{lit, of, value};
use glam::DVec2;
use umbrage_oracle::metrics;
use umbrage_render::Picture;

/// Ids of the sphere and the plane in the gallery's scene.
pub const SPHERE: u32 = 0;
/// See [`SPHERE`].
pub const PLANE: u32 = 1;
/// Where the zooms look: the cast shadow's edge on the plane and the sphere's own terminator, as fractions of the picture.
pub const CAST_EDGE: DVec2 = DVec2::new(0.70, 0.47);
/// See [`CAST_EDGE`].
pub const TERMINATOR: DVec2 = DVec2::new(0.56, 0.47);

/// False shadow over the plane and over the sphere (M2).
pub fn false_shadow(picture: &Picture, truth: &Picture, border: usize) -> (f64, f64) {
    let on = |object: u32| value(metrics::false_shadow(&picture.shadow[0], &lit(truth, border, |id| id == object)));
    (on(PLANE), on(SPHERE))
}

/// Pixels of one surface inside a soft edge.
pub fn penumbra(limit: &Picture) -> Vec<bool> {
    metrics::both(&metrics::penumbra_mask(&limit.shadow[0]), &of(limit, |_| true))
}
