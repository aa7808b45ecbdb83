//! Which numbers are depths of a surface.

/// Stored values from here on mean that no surface was seen.
const NO_SURFACE: f32 = 1e30;

/// The depth that a map keeps for `depth`: +∞ for no surface. NaN and −∞, which are not depths, count as no surface too.
#[inline(always)]
pub(crate) fn kept(depth: f32) -> f32 {
    // A choice between the depth and +∞, written over the depth, would become a masked store, which is slow on some processors.
    depth.max(if depth < NO_SURFACE && depth > f32::NEG_INFINITY { f32::NEG_INFINITY } else { f32::INFINITY })
}
