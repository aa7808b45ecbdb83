//! Maps whose depths are filtered before they are asked about.

mod kind;
mod look_up;
mod pyramid;

pub use kind::Moments;

use crate::Stored;
use glam::Vec2;
use pyramid::{Level, MOST_BLUR};
use umbrage_plane::View;

/// A map with moments of its depths: means, over regions of any size, from which a filter concludes how much of a region is nearer than a
/// receiver without looking at its texels.
///
/// As a [`DepthMap`](crate::DepthMap) it answers with the depths that it was made from, bit for bit. Beside them it holds up to four 32-bit floats a texel
/// ([`Moments`]), which may be blurred, and levels of half the resolution each down to a single texel.
///
/// ```
/// use glam::{DVec3, UVec2, Vec2};
/// use umbrage_depth::{MomentMap, Moments, Raw};
/// use umbrage_plane::View;
///
/// let lamp = View::orthographic(DVec3::Y, DVec3::ZERO, DVec3::X, 1.0, 0.0, 9.0, UVec2::new(2, 2))?;
/// let map = MomentMap::of(&Raw::new(lamp, vec![1.0, 1.0, 5.0, f32::INFINITY])?, Moments::Variance, 0.0);
/// // Scaled, the depths are 0, 0, 8/9 and 1, and the coarsest level holds their means.
/// let [mean, square, ..] = map.at(Vec2::ONE, 1.0);
/// assert!((mean - 17.0 / 36.0).abs() < 1e-7);
/// assert!((square - (64.0 / 81.0 + 1.0) / 4.0).abs() < 1e-7);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, Debug, PartialEq)]
pub struct MomentMap {
    view: View,
    stored: Stored,
    depths: Vec<f32>,
    kind: Moments,
    prefilter: f32,
    /// The depth that is scaled to 0, and the length that is scaled to 1; infinite in a map without a surface.
    nearest: f64,
    span: f64,
    levels: Vec<Level>,
}

impl MomentMap {
    /// From one depth a texel, row by row, and a standard deviation in texels.
    fn new(view: &View, stored: Stored, depths: Vec<f32>, kind: Moments, prefilter: f32) -> Self {
        let kind = kind.held();
        let prefilter = if prefilter > 0.0 { prefilter.min(MOST_BLUR) } else { 0.0 };
        let (nearest, span) = range(&depths);
        let scaled: Vec<f64> = depths.iter().map(|depth| texel(*depth, nearest, span)).collect();
        let finest = Level::finest(view.size(), &scaled, kind, prefilter);
        let levels = std::iter::successors(Some(finest), Level::coarser).collect();
        Self { view: *view, stored, depths, kind, prefilter, nearest, span, levels }
    }

    /// Which moments it keeps, with the exponents that they were made with.
    pub fn kind(&self) -> Moments {
        self.kind
    }

    /// Standard deviation of the blur, texels.
    pub fn prefilter(&self) -> f32 {
        self.prefilter
    }

    /// The depths, row by row from the top; +∞ where there is no surface.
    pub fn depths(&self) -> &[f32] {
        &self.depths
    }

    /// A depth as its moments have it. The nearest depth of the map is 0 and the farthest 8/9; texels without a surface count as 1, and so does
    /// every receiver behind the farthest depth by an eighth of the range or more. So a receiver behind all that is stored is behind it here too, and
    /// nothing is behind where no surface is. Renderers fit the range of their depths likewise.
    ///
    /// Depths before the nearest are 0. The range counts as at least 2⁻¹⁶ of the larger of its ends, so that roundings stay
    /// small in a map of one depth. NaN stays NaN; in a map without a surface every finite depth is 0.
    #[inline(always)]
    pub fn scaled(&self, depth: f32) -> f64 {
        ((f64::from(depth) - self.nearest) / self.span).clamp(0.0, 1.0)
    }

    /// Number of levels, the finest included: the last is a single texel.
    pub fn levels(&self) -> usize {
        self.levels.len()
    }

    /// The moments at a place of the map, in texels of its finest level. A level of 0 is the finest, the next has texels twice as wide. What lies
    /// between texel centres and between levels is interpolated linearly; places outside the map have what lies on its edge. Levels that do not exist count
    /// as the nearest that does, and NaN as 0, in a place too. Channels beyond [`Moments::channels`] are 0.
    #[must_use]
    pub fn at(&self, texel: Vec2, level: f32) -> [f64; 4] {
        let last = self.levels.len() - 1;
        let level = f64::from(level).max(0.0).min(last as f64);
        let fine = level as usize;
        let share = level - fine as f64;
        let of = |level: usize| self.levels[level].at(texel.as_dvec2() / (level as f64).exp2());
        let found = of(fine);
        if share == 0.0 {
            return found;
        }
        let coarse = of(fine + 1);
        std::array::from_fn(|channel| found[channel] + (coarse[channel] - found[channel]) * share)
    }
}

/// The nearest depth and the length that is scaled to 1.
fn range(depths: &[f32]) -> (f64, f64) {
    let surfaces = depths.iter().filter(|depth| **depth < f32::INFINITY).map(|depth| f64::from(*depth));
    let (nearest, farthest) =
        surfaces.fold((f64::INFINITY, f64::NEG_INFINITY), |(near, far), depth| (near.min(depth), far.max(depth)));
    if nearest > farthest {
        return (0.0, f64::INFINITY);
    }
    let least = nearest.abs().max(farthest.abs()).max(f64::from(f32::MIN_POSITIVE)) / 65_536.0;
    (nearest, (farthest - nearest).max(least) * 1.125)
}

/// A texel's depth, scaled.
fn texel(depth: f32, nearest: f64, span: f64) -> f64 {
    if depth == f32::INFINITY { 1.0 } else { (f64::from(depth) - nearest) / span }
}
