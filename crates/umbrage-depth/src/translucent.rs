use glam::{IVec2, Vec3};
use std::borrow::Cow;

/// One surface over a texel that lets part of the light through, and what is left of the light behind it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Step {
    /// Its depth, in the kind of the map's view.
    pub depth: f32,
    /// Fraction of the light that passes everything up to and including this surface, linear RGB in 0..=1.
    pub passes: Vec3,
}

/// What the surfaces of a map let through: the half of a deep map that a plain [`DepthMap`](crate::DepthMap) knows nothing of
/// (Lokovic & Veach 2000, as Burley 2006 uses it).
pub trait Translucent: Send + Sync {
    /// The surfaces of a texel, nearest first; none outside the map. Their depths ascend strictly and what passes never grows.
    fn steps(&self, texel: IVec2) -> Cow<'_, [Step]>;

    /// Whether red, green and blue light pass alike everywhere.
    fn is_grey(&self) -> bool;

    /// Fraction of the light that passes all surfaces of a texel nearer than `depth`, linear RGB; a surface at `depth` itself is
    /// not nearer. All of it for NaN.
    #[inline(always)]
    fn transmittance(&self, texel: IVec2, depth: f32) -> Vec3 {
        transmittance(&self.steps(texel), depth)
    }
}

/// What passes the steps nearer than `depth`.
#[inline(always)]
pub(crate) fn transmittance(steps: &[Step], depth: f32) -> Vec3 {
    let nearer = steps.partition_point(|step| step.depth < depth);
    if nearer == 0 { Vec3::ONE } else { steps[nearer - 1].passes }
}
