//! Leaves and blades of grass: two-sided sheets that end in points.

use super::curved::curved;
use crate::Mesh;
use glam::DVec3;
use std::f64::consts::PI;

/// How a leaf or a blade grows.
#[derive(Clone, Copy)]
pub(super) struct Leaf {
    /// Where it begins, world space.
    pub(super) foot: DVec3,
    /// Bearing it grows toward, from +x toward +z, radians.
    pub(super) bearing: f64,
    /// Angle above the horizon at its foot, radians.
    pub(super) rise: f64,
    /// Along its middle before it droops, world units.
    pub(super) length: f64,
    /// Half its greatest width, world units.
    pub(super) half_width: f64,
    /// By which fraction of its length the tip hangs lower.
    pub(super) droop: f64,
}

impl Leaf {
    /// A pointed leaf, its edges a little raised.
    pub(super) fn broad(&self) -> Mesh {
        curved(4, 8, |u, v| self.at(2.0 * u - 1.0, v, (PI * v.powf(0.75)).sin()))
    }

    /// A blade that narrows from foot to tip.
    pub(super) fn blade(&self) -> Mesh {
        curved(1, 3, |u, v| self.at(2.0 * u - 1.0, v, 1.0 - v))
    }

    /// The place `across` (−1..=1) and `along` (0..=1) the leaf, where it is `width` (0..=1) of its greatest width.
    fn at(&self, across: f64, along: f64, width: f64) -> DVec3 {
        let (sin, cos) = self.bearing.sin_cos();
        let (out, side) = (DVec3::new(cos, 0.0, sin), DVec3::new(-sin, 0.0, cos));
        let (up, forward) = self.rise.sin_cos();
        let half = self.half_width * width;
        let height = self.length * (along * up - self.droop * along * along) + 0.3 * half * across * across;
        self.foot + out * (self.length * along * forward) + side * (across * half) + DVec3::Y * height
    }
}
