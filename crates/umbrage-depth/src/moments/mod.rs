//! Maps whose depths are filtered before they are looked up.

mod kind;
mod pyramid;
mod source;

pub use kind::Moments;
pub use source::MomentSource;

use crate::{DepthMap, Raw, Stored, rows};
use fearless_simd::{Simd, f32x16};
use glam::{IVec2, Vec2};
use pyramid::{Level, MOST_BLUR};
use umbrage_plane::{Kind, TexelRect, View};

/// A map with moments of its depths: means, over regions of any size, from which a filter concludes how much of a region is nearer than a
/// receiver without looking at its texels.
///
/// As a [`DepthMap`] it answers with the depths that it was made from, bit for bit. Beside them it holds up to four 32-bit floats per texel
/// ([`Moments`]), which may be blurred, and levels of half the resolution each down to a single texel.
///
/// ```
/// use glam::{DVec3, UVec2, Vec2};
/// use umbrage_depth::{MomentMap, MomentSource, Moments, Raw};
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
    depths: Raw,
    kind: Moments,
    prefilter: f32,
    /// The depth that is scaled to 0, and the length that is scaled to 1; infinite in a map without a surface.
    nearest: f64,
    span: f64,
    levels: Vec<Level>,
}

impl MomentMap {
    /// The moments of a map's depths, those of the nearest surfaces where it holds several.
    ///
    /// `prefilter` is the standard deviation, in texels, of a normal law by which the moments are blurred along rows and columns, as far as
    /// three standard deviations reach; for [`Moments::Deviation`] it is how far a box reaches to each side. Beyond an edge of the map lies what lies on it. 0, NaN and negative numbers are none; more than 64
    /// counts as 64. Coarser levels are means of two by two texels. Sums are f64, and rounded once for each level.
    #[must_use]
    pub fn of(map: &impl DepthMap, kind: Moments, prefilter: f32) -> Self {
        let (depths, kind) = (Raw::copy_of(map), kind.held());
        let prefilter = if prefilter > 0.0 { prefilter.min(MOST_BLUR) } else { 0.0 };
        let (nearest, span) = range(depths.depths());
        let size = map.view().size();
        let levels = if let Moments::Deviation { samples } = kind {
            let scaled: Vec<f64> = depths.depths().iter().map(|depth| on_screen(map.view(), *depth)).collect();
            vec![Level::deviations(size, &scaled, prefilter, samples)]
        } else {
            let scaled: Vec<f64> = depths.depths().iter().map(|depth| texel(*depth, nearest, span)).collect();
            std::iter::successors(Some(Level::finest(size, &scaled, kind, prefilter)), Level::coarser).collect()
        };
        Self { depths, kind, prefilter, nearest, span, levels }
    }

    /// Standard deviation of the blur, or how far its box reaches to each side ([`Moments::Deviation`]), texels.
    pub fn prefilter(&self) -> f32 {
        self.prefilter
    }

    /// One depth per texel, row by row from the top; +∞ for a texel without a surface.
    pub fn depths(&self) -> &[f32] {
        self.depths.depths()
    }

    /// Number of levels, the finest included: the last is a single texel, unless there is only one ([`Moments::Deviation`]).
    pub fn levels(&self) -> usize {
        self.levels.len()
    }
}

impl MomentSource for MomentMap {
    fn kind(&self) -> Moments {
        self.kind
    }

    #[inline(always)]
    fn scaled(&self, depth: f32) -> f64 {
        if let Moments::Deviation { .. } = self.kind {
            return on_screen(self.depths.view(), depth);
        }
        ((f64::from(depth) - self.nearest) / self.span).clamp(0.0, 1.0)
    }

    fn at(&self, texel: Vec2, level: f32) -> [f64; 4] {
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

/// Screen depth of a depth of a view's own kind, within 0..=1.
fn on_screen(view: &View, depth: f32) -> f64 {
    let depth = f64::from(depth);
    if view.kind() == Kind::Screen || depth.is_nan() || depth == f64::INFINITY {
        return depth.clamp(0.0, 1.0);
    }
    // The map holds nothing nearer than the near plane, and screen depth is not defined at the eye.
    view.with_kind(Kind::Screen).key(depth.max(view.near())).clamp(0.0, 1.0)
}

impl DepthMap for MomentMap {
    fn view(&self) -> &View {
        self.depths.view()
    }

    #[inline(always)]
    fn depth(&self, texel: IVec2) -> f32 {
        self.depths.depth(texel)
    }

    #[inline(always)]
    fn look<S: Simd>(&self, simd: S, within: TexelRect, x: f32x16<S>, y: f32x16<S>) -> f32x16<S> {
        rows::look(simd, self.depths(), TexelRect::of_size(self.view().size()), within, x, y)
    }

    #[inline(always)]
    fn moments(&self) -> Option<&dyn MomentSource> {
        Some(self)
    }

    fn stored(&self) -> Stored {
        self.depths.stored()
    }

    /// Those of its depths and of all moments.
    fn bytes(&self) -> usize {
        self.depths.bytes() + self.levels.iter().map(Level::bytes).sum::<usize>()
    }

    fn allocated(&self) -> usize {
        self.bytes() + self.levels.len() * size_of::<Level>() + size_of::<Self>()
    }
}
