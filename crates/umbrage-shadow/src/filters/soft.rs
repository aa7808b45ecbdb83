use crate::{BiasCone, Biased, Filter, Probe, Query, ReceiverDepth};
use fearless_simd::{Simd, prelude::*};
use glam::Vec2;
use umbrage_depth::DepthMap;
use umbrage_plane::{Bias, Footprint, Kind, Projection, Receiver, View};
use umbrage_sample::{Density, Disc};

/// A radius on the map, from 0; +∞ reaches beyond the map. The unit is part of the type.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum MapRadius {
    /// Texels.
    Texels(f32),
    /// Fraction of the map's width and height.
    Fraction(f32),
    /// World units on the plane perpendicular to the light's axis through the receiver.
    World(f32),
}

impl MapRadius {
    /// In texels along both axes.
    #[inline(always)]
    fn texels(self, view: &View, receiver: &Receiver) -> Vec2 {
        let texels = match self {
            Self::Texels(radius) => Vec2::splat(radius),
            Self::Fraction(share) => view.size().as_vec2() * share,
            Self::World(radius) => Vec2::splat(radius) / receiver.texel_world,
        };
        // Finite, so that differences of radii are.
        texels.min(Vec2::splat(f32::MAX))
    }
}

/// How wide the blur is, from the mean distance of the occluders (Burley 2006).
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Softness {
    /// Burley's: from `min` where the occluder touches the receiver to `max` where it is at the light, by 1 − z̄/z_p. Occluders are searched
    /// within `max`. It is a disc light's own penumbra for one distance of occluders only.
    ///
    /// Parallel light has no distance: there `max` is reached where the occluder is as far from the receiver as the map is
    /// wide, in world units, over the larger of its sides.
    Between {
        /// Radius at contact.
        min: MapRadius,
        /// Largest radius, and the radius of the search.
        max: MapRadius,
    },
    /// Physical: the penumbra of a disc that stands for the light. It is half a texel at contact.
    Light {
        /// Radius of the disc in world units; of a directional light, the tangent of its angular radius (the sun: .00465).
        radius: f32,
        /// No occluder is nearer to the light than this, axial world units: it bounds the search. 0, or anything below it, is the near
        /// plane's distance, which is always safe; larger is less noisy. In parallel light distances from the light mean nothing, and
        /// the near plane bounds the search.
        nearest: f32,
    },
}

impl Softness {
    /// Burley's factor 1 − z̄/z_p, between 0 and 1, for occluders at a mean distance and a receiver at another; 0 for a receiver at or behind
    /// the light.
    #[inline(always)]
    pub fn factor(mean: f32, distance: f32) -> f32 {
        if distance > 0.0 { (1.0 - mean / distance).clamp(0.0, 1.0) } else { 0.0 }
    }

    /// The search's radius in texels.
    #[inline(always)]
    fn search(self, view: &View, receiver: &Receiver, distance: f32) -> Vec2 {
        match self {
            Self::Between { min, max } => max.texels(view, receiver).max(min.texels(view, receiver)),
            // The map stores what is nearer than the near plane at that plane.
            Self::Light { nearest, .. } => {
                let near = view.near() as f32;
                let bound = if view.is_perspective() { nearest.max(near) } else { near };
                self.blur(view, receiver, bound, distance, 1.0)
            }
        }
    }

    /// The blur's radius in texels, for occluders at `mean` and a receiver at `distance` from the light.
    #[inline(always)]
    fn blur(self, view: &View, receiver: &Receiver, mean: f32, distance: f32, gamma: f32) -> Vec2 {
        match self {
            Self::Between { min, max } => {
                let (min, max) = (min.texels(view, receiver), max.texels(view, receiver));
                let factor = match view.projection() {
                    Projection::Perspective { .. } => Self::factor(mean, distance),
                    Projection::Orthographic { half, .. } => {
                        ((distance - mean) / (2.0 * half.max_element()) as f32).clamp(0.0, 1.0)
                    }
                };
                min + (max - min) * factor.powf(gamma)
            }
            Self::Light { radius, .. } => {
                // Seen from the light, the half penumbra has the tangent ℓ/2·(1/ζ_o − 1/ζ_r); at the receiver it is ζ_r as wide.
                let scale = if view.is_perspective() { 1.0 / mean } else { 1.0 };
                let world = radius * (distance - mean).max(0.0) * scale;
                // Even at contact it is as wide as a bilinear look-up, so that single texels do not show.
                (Vec2::splat(if world.is_finite() { world } else { f32::MAX }) / receiver.texel_world)
                    .max(Vec2::splat(0.5))
            }
        }
    }
}

/// The weight of occluders by their distance from the search's centre (Burley 2006).
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum OccluderFalloff {
    /// From 1 at the centre in a straight line to `rim`, above 0 and at most 1, at the search's radius. Burley's rim is 0.1.
    Linear {
        /// Weight at the rim.
        rim: f32,
    },
    /// A cosine's half wave from 1 to `rim`.
    Smooth {
        /// Weight at the rim.
        rim: f32,
    },
    /// As a power of the fraction r of the radius: 1 − (1 − `rim`)·rᵖ.
    Power {
        /// Weight at the rim.
        rim: f32,
        /// p, above 0: 1 is the straight line, more keeps the middle's weight for longer.
        exponent: f32,
    },
    /// All alike: the plain mean (Fernando 2005).
    Flat,
}

impl OccluderFalloff {
    /// The weight at a fraction of the search's radius.
    #[inline(always)]
    pub fn weight(self, share: f32) -> f32 {
        match self {
            Self::Linear { rim } => 1.0 - (1.0 - rim) * share,
            Self::Smooth { rim } => rim + (1.0 - rim) * (0.5 + 0.5 * (std::f32::consts::PI * share.min(1.0)).cos()),
            Self::Power { rim, exponent } => 1.0 - (1.0 - rim) * share.max(0.0).powf(exponent),
            Self::Flat => 1.0,
        }
    }
}

/// A shadow's density by the distance from occluder to receiver (Burley 2006).
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub struct Opacity {
    /// At contact, 0..=1.
    pub near: f32,
    /// From `fade` on, 0..=1.
    pub far: f32,
    /// World units after which the density is `far`, above 0; +∞ for `near` everywhere.
    pub fade: f32,
    /// Shapes the transition: the fraction of `fade` is raised to this power before it is smoothed. 1 leaves it alone.
    pub gamma: f32,
}

umbrage_plane::builders!([] Opacity { with_near near: f32, with_far far: f32, with_fade fade: f32, with_gamma gamma: f32 });

impl Default for Opacity {
    /// [`Opacity::FULL`].
    fn default() -> Self {
        Self::FULL
    }
}

impl Opacity {
    /// No effect.
    pub const FULL: Self = Self { near: 1.0, far: 1.0, fade: f32::INFINITY, gamma: 1.0 };

    /// The density for a gap in world units.
    #[inline(always)]
    pub fn at(&self, gap: f32) -> f32 {
        if self.fade == f32::INFINITY {
            return self.near;
        }
        let share = (gap / self.fade).clamp(0.0, 1.0).powf(self.gamma);
        self.near + (self.far - self.near) * (share * share * (3.0 - 2.0 * share))
    }
}

/// The weighted mean of occluders' distances (Burley 2006). Its own type because *none* is not a distance.
#[derive(Clone, Copy, Debug, Default)]
struct Mean {
    sum: f64,
    weight: f64,
}

impl Mean {
    #[inline(always)]
    fn add(&mut self, distance: f64, weight: f32) {
        self.sum += distance * f64::from(weight);
        self.weight += f64::from(weight);
    }

    #[inline(always)]
    fn value(self) -> Option<f32> {
        (self.weight > 0.0).then(|| (self.sum / self.weight) as f32)
    }
}

/// Soft shadows from one map: the mean distance of the occluders around a receiver sets how wide its shadow is blurred
/// (Burley 2006).
///
/// `depth` is compared in both passes: [`BiasCone`] is Burley's; a tangent plane or a constant bias can be used, too. Distances are measured from the
/// light: axial or Euclidean as the map stores them, and from the plane of the view's eye for directional lights. Texels outside the map are
/// never occluders; where the view's rules say dark, it is dark whatever the opacity and whether an occluder was found or not (Woo 1992). The blur is never
/// narrower than the receiver's own region, and no wider than a quarter of the map to each side.
///
/// Departures from the printed listing, by the errata of [`as_printed`](crate::as_printed): the bias moves toward the light, the blur is given
/// its point, *no occluder* is not a depth of 0, the factor is clamped, slope and radius are in world units.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub struct Soft<D = BiasCone> {
    /// How wide the blur is.
    pub softness: Softness,
    /// Where occluders are searched. Burley's is dense in the middle.
    pub search: Disc,
    /// Where the shadow is looked up. Only an even density filters as a disc light does.
    pub blur: Disc,
    /// The weights of occluders.
    pub falloff: OccluderFalloff,
    /// Which depth is compared.
    pub depth: D,
    /// Shapes the blur: the factor of [`Softness::Between`] is raised to this power. 1 leaves it alone.
    pub radius_gamma: f32,
    /// Density by distance.
    pub opacity: Opacity,
    /// Whether a receiver without occluders is still looked up at the least radius, so that occluders that only the blur meets
    /// do not vanish abruptly.
    pub rescue: bool,
}

impl Default for Soft {
    /// Burley's: 32 and 32 taps, from half a texel to 16 texels.
    fn default() -> Self {
        Self {
            softness: Softness::Between { min: MapRadius::Texels(0.5), max: MapRadius::Texels(16.0) },
            search: Disc::default().with_density(Density::Centred),
            blur: Disc::default(),
            falloff: OccluderFalloff::Linear { rim: 0.1 },
            depth: BiasCone::default(),
            radius_gamma: 1.0,
            opacity: Opacity::FULL,
            rescue: false,
        }
    }
}

umbrage_plane::builders!([D] Soft<D> {
    with_softness softness: Softness,
    with_search search: Disc,
    with_blur blur: Disc,
    with_falloff falloff: OccluderFalloff,
    with_radius_gamma radius_gamma: f32,
    with_opacity opacity: Opacity,
    with_rescue rescue: bool,
});

impl<D> Soft<D> {
    /// The same, comparing another depth.
    #[must_use]
    pub fn with_depth<E: ReceiverDepth>(self, depth: E) -> Soft<E> {
        let Self { softness, search, blur, falloff, radius_gamma, opacity, rescue, .. } = self;
        Soft { softness, search, blur, falloff, depth, radius_gamma, opacity, rescue }
    }
}

impl<D: ReceiverDepth> Soft<D> {
    /// The weighted mean distance of the occluders around a receiver, world units from the light; `None` without one
    /// (`sampleDepth` of the note).
    #[inline(always)]
    fn occluders<S: Simd, M: DepthMap, P: Probe>(
        &self,
        query: &mut Query<'_, S, M, P>,
        region: &Footprint,
    ) -> Option<f32> {
        let view = query.view();
        let mut mean = Mean::default();
        query.nearest(
            region,
            &self.search,
            &self.depth,
            #[inline(always)]
            |region, taps, compared, stored| {
                let nearer = compared.simd_gt(stored).to_bitmask() as u32 & taps.mask;
                for i in (0..16).filter(|i| nearer >> i & 1 == 1) {
                    let from = (Vec2::new(taps.x[i], taps.y[i]) - region.centre)
                        / region.half.max(Vec2::splat(f32::MIN_POSITIVE));
                    mean.add(distance(view, stored[i]), self.falloff.weight(from.length()));
                }
            },
        );
        mean.value()
    }
}

/// World distance from the light of a stored depth.
#[inline(always)]
pub(super) fn distance(view: &View, depth: f32) -> f64 {
    match view.kind() {
        Kind::Axial | Kind::Radial => f64::from(depth),
        Kind::Screen => view.decode().zeta(depth),
    }
}

impl<D: ReceiverDepth> Filter for Soft<D> {
    #[inline(always)]
    fn shadow<S: Simd, M: DepthMap, Q: Probe>(&self, query: &mut Query<'_, S, M, Q>) -> f32 {
        let (view, receiver) = (query.view(), query.receiver());
        let own = distance(view, receiver.depth) as f32;
        let search = query.region_around(self.softness.search(view, receiver, own));
        let found = self.occluders(query, &search);
        let mean = found.unwrap_or(own);
        let region = query.region_around(self.softness.blur(view, receiver, mean, own, self.radius_gamma));
        // Shadow by the view's rules alone: no occluder's opacity makes it lighter.
        let beyond = if view.holds(region.centre, region.half) {
            0.0
        } else {
            query.share(&region, &self.blur, &Biased::constant(Bias::Map(f32::INFINITY)))
        };
        if found.is_none() && !self.rescue {
            return beyond;
        }
        let dark = query.share(&region, &self.blur, &self.depth);
        beyond + (dark - beyond) * self.opacity.at(own - mean)
    }

    #[inline(always)]
    fn asks_tilt<M: DepthMap>(&self, _: &M) -> bool {
        self.depth.asks_tilt()
    }
}
