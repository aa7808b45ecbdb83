use super::kind::Moments;
use glam::Vec2;

/// What a map knows of the moments of its depths ([`MomentMap`](crate::MomentMap)).
pub trait MomentSource {
    /// Which moments are kept, with the exponents that they were made with.
    fn kind(&self) -> Moments;

    /// A depth as the moments have it. The nearest depth of the map is 0 and the farthest 8/9; texels without a surface count as 1, and so does
    /// every receiver behind the farthest depth by an eighth of the range or more. So a receiver behind all that is stored is behind it here too, and
    /// nothing is behind where no surface is. Renderers fit the range of their depths likewise.
    ///
    /// [`Moments::Deviation`] has another scale: screen depth, 0 at the near plane and 1 at the far one and where no surface is, whatever kind of depth the map
    /// stores (a distance from the eye counts as one along the axis).
    ///
    /// Depths before the nearest are 0. The range counts as at least 2⁻¹⁶ of the larger of its ends, so that roundings stay
    /// small in a map of one depth. NaN stays NaN; in a map without a surface every finite depth is 0.
    fn scaled(&self, depth: f32) -> f64;

    /// The moments at a place of the map, in texels of its finest level. A level of 0 is the finest, the next has texels twice as wide. What lies
    /// between texel centres and between levels is interpolated linearly; places outside the map have what lies on its edge. Levels that do not exist count
    /// as the nearest that does, and NaN as 0, in a place too. Channels beyond [`Moments::channels`] are 0.
    fn at(&self, texel: Vec2, level: f32) -> [f64; 4];
}
