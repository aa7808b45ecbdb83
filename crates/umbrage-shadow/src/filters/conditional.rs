use crate::{Biased, Filter, OnPlane, Probe, Query};
use fearless_simd::Simd;
use umbrage_depth::DepthMap;
use umbrage_sample::{EveryTexel, Pattern};

/// When the tangent plane is compared (Wang & Molnar 1994).
#[derive(Clone, Copy, Debug, PartialEq, Eq, Default)]
pub enum VirtualWhen {
    /// Where the texels disagree about the receiver's own depth. The paper's rule.
    #[default]
    Mixed,
    /// Everywhere: fails on curved surfaces nearly edge-on to the light, whose plane climbs past its occluders (Fig. 9).
    Always,
    /// Nowhere: plain comparison.
    Never,
}

/// Wang & Molnar's rule for a map of second surfaces: texels that agree about the receiver's depth settle it, and where they do not,
/// the receiver's tangent plane is compared at each of them instead (Wang & Molnar 1994, §3 and Fig. 10).
///
/// The nearby texels are those of `pattern` over the receiver's region times `res_factor`, of at least `min_size` half-extent. With
/// [`EveryTexel`], a `res_factor` and `min_size` of 0 and 1 are the nearest four, 0 and n/2 a box of n × n, and 1 and 1 the region's own texels, at least 2 ×
/// 2.
/// [`Tent`](umbrage_sample::Tent) weighs them by nearness.
///
/// Departures from the printed listing, by the errata of [`as_printed`](crate::as_printed): (1) counts begin at 0 and are divided as
/// fractions; (2) equality is lit at virtual samples too, within their rounding; (3) the view's rules settle places
/// outside the map; (4) there is a bias, of 0; (5) planes that nearly contain the light's ray fall back on plain comparison,
/// and beyond a plane's horizon its depth is +∞.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub struct Conditional<P = EveryTexel> {
    /// The nearby texels.
    pub pattern: P,
    /// Multiplies the region's size.
    pub res_factor: f32,
    /// Least half-extent of the region after that, in texels. Stochastic maps need 1.5: the samples of three by three texels surround the point,
    /// while those of the nearest four may all lie to one side of it, and on a steep sheet all be nearer.
    pub min_size: f32,
    /// The virtual samples. Its bias also applies to plain comparison.
    pub plane: OnPlane,
    /// Below this |cosine| between normal and light only plain comparison counts.
    pub min_cos: f32,
    /// When virtual samples are taken.
    pub when: VirtualWhen,
    /// Whether surfaces that face away from the light are dark without a look-up: shading darkens them anyway, if it is max(N·L, 0) (Wang & Molnar 1994).
    pub dark_backs: bool,
}

impl Default for Conditional {
    /// The paper's: the nearest four, no bias.
    fn default() -> Self {
        Self {
            pattern: EveryTexel,
            res_factor: 0.0,
            min_size: 1.0,
            plane: OnPlane { slack: 1.0, ..OnPlane::default() },
            min_cos: 0.02,
            when: VirtualWhen::Mixed,
            dark_backs: false,
        }
    }
}

umbrage_plane::builders!([P] Conditional<P> {
    with_res_factor res_factor: f32,
    with_min_size min_size: f32,
    with_plane plane: OnPlane,
    with_min_cos min_cos: f32,
    with_when when: VirtualWhen,
    with_dark_backs dark_backs: bool,
});

impl<P> Conditional<P> {
    /// The same with another pattern.
    #[must_use]
    pub fn with_pattern<Q: Pattern>(self, pattern: Q) -> Conditional<Q> {
        let Self { res_factor, min_size, plane, min_cos, when, dark_backs, .. } = self;
        Conditional { pattern, res_factor, min_size, plane, min_cos, when, dark_backs }
    }
}

impl<P: Pattern> Filter for Conditional<P> {
    #[inline(always)]
    fn shadow<S: Simd, M: DepthMap, Q: Probe>(&self, query: &mut Query<'_, S, M, Q>) -> f32 {
        let facing = query.receiver().facing;
        if self.dark_backs && facing <= 0.0 {
            return 1.0;
        }
        let region = query.region(self.res_factor, self.min_size);
        let plain = query.share(&region, &self.pattern, &Biased::constant(self.plane.bias));
        let agreed = plain == 0.0 || plain == 1.0;
        let asked = match self.when {
            VirtualWhen::Mixed => !agreed,
            VirtualWhen::Always => true,
            VirtualWhen::Never => false,
        };
        if !asked || facing.abs() < self.min_cos {
            return plain;
        }
        query.probe().virtual_sampled();
        query.share(&region, &self.pattern, &self.plane)
    }
}
