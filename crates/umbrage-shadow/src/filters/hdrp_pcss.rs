use super::soft::distance;
use crate::{Biased, Compared, Filter, Probe, Query, ReceiverDepth};
use fearless_simd::{Simd, f32x16, prelude::*};
use glam::Vec2;
use umbrage_depth::DepthMap;
use umbrage_plane::{Bias, DepthRange, Footprint, Kind, Receiver, TexelRect, View};
use umbrage_sample::{Density, Spiral, Taps, Vogel};

/// Percentage-closer soft shadows as Unity's High Definition Render Pipeline has them at high quality (`HDShadowSampling.hlsl` and `HDPCSS.hlsl`, commit
/// 3064379; the numbers that they are given, in `HDAdditionalLightData.cs` and where shadow requests are made of it).
///
/// The mean of the blockers on a [`Spiral`] sets the radius of a [`Vogel`] disc of bilinear comparisons. How it does so depends on the light:
///
/// * Parallel light is a cone: the receiver is compared nearer to the light the farther a sample is from it, so that only what is inside the cone blocks. The
///   search reaches as far as a blocker at the near plane would need it, up to a penumbra of 0.56 world units, and its cone has an angle of 12° or the light's.
///   Of the blockers' mean distance from the receiver, nine tenths count; times twice the tangent of half the light's angle they are the disc's radius, at
///   least 1.5 texels. While the samples are compared, the cone rises to half a world unit at most, and to a quarter of the way to the blockers. Without a
///   blocker there is light.
/// * The radius of a lamp's disc was fitted to ray tracing. It is a fraction of the map: a polynomial of the lamp's radius times a polynomial of the blockers'
///   distance, together at most 0.32, times 1 − d̄/d of reversed screen depths, which is Burley's factor times f/(f − z̄). It is at least 0.41 texels. The
///   radius of the search uses the first polynomial alone. The blockers' mean is taken over screen depths, in which near blockers weigh more. There is no cone.
///
/// What is open there, or left out: (1) discs are turned by interleaved gradient noise of the pixel and the frame, here by the key of the region, and both discs
/// alike, as there; (2) the radius of parallel light is that of depths from 0 to 1, as Direct3D, Metal and Vulkan have them; it is as wide as the whole penumbra
/// should be, not as half of it; (3) samples outside the map are not left out: the view's rules settle them, and they hide nothing in the search; (4) cascades
/// and atlases are not here, so that a map is as wide as its light's view; (5) no region is wider than a quarter of the map to each side; (6) distances in a
/// radial map are those along the rays.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub struct HdrpPcss<D = Biased> {
    /// Which depth is compared before the cone raises it.
    pub depth: D,
    /// The angle under which parallel light's source is seen, degrees, within 0..=90; `angularDiameter`.
    pub diameter: f32,
    /// The radius of a lamp, world units, from 0; `shapeRadius`.
    pub radius: f32,
    /// Samples that search for blockers, from 1 to 64.
    pub search: u32,
    /// Samples that are compared, from 1 to 64.
    pub blur: u32,
    /// Whether each region turns both discs by an angle of its own.
    pub rotate: bool,
}

impl Default for HdrpPcss {
    /// A light's defaults: half a degree or 0.025 world units, 24 and 16 samples; no bias.
    fn default() -> Self {
        let depth = Biased::constant(Bias::ZERO);
        Self { depth, diameter: 0.5, radius: 0.025, search: 24, blur: 16, rotate: true }
    }
}

umbrage_plane::builders!([D] HdrpPcss<D> {
    with_diameter diameter: f32, with_radius radius: f32, with_search search: u32, with_blur blur: u32, with_rotate rotate: bool
});

/// Widest penumbra of parallel light, world units (`dirLightPCSSMaxPenumbraSize`).
const WIDEST: f32 = 0.56;
/// How far the cone of parallel light rises at most where samples are compared, world units (`dirLightPCSSMaxSamplingDistance`).
const HIGHEST: f32 = 0.5;
/// Least radius of parallel light's discs, texels (`dirLightPCSSMinFilterSizeTexels`).
const NARROWEST: f32 = 1.5;
/// Least angle of parallel light's cone, degrees (`dirLightPCSSBlockerSearchAngularDiameter`, which is larger than
/// `dirLightPCSSMinFilterMaxAngularDiameter` is).
const CONE: f32 = 12.0;
/// Least radius of a lamp's disc, texels: `minFilterSize` in thousandths of an atlas of 4096 texels.
const FINEST: f32 = 0.1 * 0.001 * 4096.0;
/// What a lamp's search has beyond its softness, texels: a millionth of such an atlas.
const LEAST: f32 = 0.000_001 * 4096.0;
/// Largest softness of a lamp in a map of 512 texels (`resIndepenentMaxSoftness`), and the fraction of a map that 1 of it is: 4096 texels of 512.
const SOFTEST: f32 = 0.04;
const OF_MAP: f32 = 8.0;
/// Distance of blockers from a lamp beyond which its polynomial is not used, world units.
const FITTED: f32 = 7.5;

impl<D> HdrpPcss<D> {
    /// The same, comparing another depth.
    #[must_use]
    pub fn with_depth<E: ReceiverDepth>(self, depth: E) -> HdrpPcss<E> {
        let Self { diameter, radius, search, blur, rotate, .. } = self;
        HdrpPcss { depth, diameter, radius, search, blur, rotate }
    }

    /// A lamp's softness in a map of 512 texels per side (`GetNonDirectionalSoftness`).
    fn softness(&self) -> f32 {
        let x = self.radius.max(0.0);
        let fitted = 0.024_034_61 + x * (3.452_916 + x * (-1.362_672 + x * (0.670_011_5 + x * 0.215_947_4)));
        fitted / 100.0
    }

    /// How many times as large HDRP's slope bias is under this filter as under the others: more than once for lamps that are soft in a large map
    /// (`GetBaseBias`, which is given the softness in texels).
    #[must_use]
    pub fn slope_bias(&self, view: &View) -> f32 {
        let softness = self.softness() * view.size().x as f32 / 512.0;
        if !view.is_perspective() || softness <= 0.01 {
            return 1.0;
        }
        let (base, most) = (5.0, 18.0);
        (base + (most - base) * (softness * 20.0).min(1.0)) / base
    }

    /// Half-extents of the widest box that is looked up for a receiver, whatever blocks it, texels; bilinear comparisons are in it.
    #[must_use]
    pub fn widest(&self, view: &View, receiver: &Receiver) -> Vec2 {
        let half = match self.light(view) {
            Light::Lamp { softness } => {
                // The polynomial is largest at the lamp.
                view.size().as_vec2() * (OF_MAP * (softness * fitted(0.0)).min(SOFTEST)).max(0.0)
            }
            Light::Sun { tangent, .. } => {
                let own = distance(view, receiver.depth) as f32;
                Vec2::splat(((own - view.near() as f32).max(0.0) * tangent).min(WIDEST)) / receiver.texel_world
            }
        };
        half.max(Vec2::splat(NARROWEST)) + 1.0
    }

    fn light(&self, view: &View) -> Light {
        if view.is_perspective() {
            return Light::Lamp { softness: self.softness() };
        }
        let tangent = |degrees: f32| (0.5 * degrees.to_radians()).tan();
        let diameter = self.diameter.clamp(0.0, 90.0);
        Light::Sun { tangent: 2.0 * tangent(diameter), slope: 0.5 / tangent(diameter.max(CONE)) }
    }
}

/// A light's size, as its filter needs it.
#[derive(Clone, Copy)]
enum Light {
    Sun {
        /// World units of radius for each world unit of distance.
        tangent: f32,
        /// World units toward the light for each world unit aside.
        slope: f32,
    },
    Lamp {
        softness: f32,
    },
}

/// What is looked up: a disc, and how the compared depth rises on it.
#[derive(Clone, Copy)]
struct Disc {
    /// Half-axes, texels.
    half: Vec2,
    /// World units toward the light at the rim, and at most.
    rise: f32,
    most: f32,
}

/// The factor of a lamp's softness by the distance of what blocks it, world units.
fn fitted(distance: f32) -> f32 {
    let d = distance.min(FITTED);
    3.298_300_2 + d * (-2.001_364_6 + d * (0.496_731_14 + d * (-0.054_640_585 + d * 0.002_197_4)))
}

impl Light {
    /// Where blockers are searched by a receiver at a distance from the light.
    #[inline(always)]
    fn search(self, view: &View, receiver: &Receiver, own: f32) -> Disc {
        match self {
            Self::Lamp { softness } => {
                let most = view.size().as_vec2() * (OF_MAP * SOFTEST);
                let half = (view.size().as_vec2() * (OF_MAP * softness) + LEAST).min(most);
                Disc { half, rise: 0.0, most: 0.0 }
            }
            Self::Sun { tangent, slope } => {
                let world = ((own - view.near() as f32).max(0.0) * tangent).min(WIDEST);
                let half = (Vec2::splat(world) / receiver.texel_world).max(Vec2::splat(NARROWEST));
                let rise = slope * (half * receiver.texel_world).max_element();
                Disc { half, rise, most: f32::INFINITY }
            }
        }
    }

    /// Where the receiver is compared, for blockers at a mean distance from the light, or none.
    #[inline(always)]
    fn blur(self, view: &View, receiver: &Receiver, own: f32, blockers: Option<f32>) -> Disc {
        match self {
            Self::Lamp { softness } => {
                let share = blockers.map_or(0.0, |mean| {
                    let far = view.far() as f32;
                    let penumbra = far * (own - mean) / (own * (far - mean));
                    OF_MAP * (softness * fitted(mean)).min(SOFTEST) * penumbra.abs()
                });
                // NaN is the least.
                let half = (view.size().as_vec2() * share).max(Vec2::splat(FINEST));
                Disc { half, rise: 0.0, most: 0.0 }
            }
            Self::Sun { tangent, slope } => {
                // Nothing is before what is infinitely near: there is light, unless the view's rules call a place dark.
                let Some(mean) = blockers else {
                    return Disc { half: Vec2::splat(NARROWEST), rise: f32::INFINITY, most: f32::INFINITY };
                };
                let gap = (0.9 * (own - mean).abs()).min(WIDEST / tangent);
                let world = gap * tangent;
                let half = (Vec2::splat(world) / receiver.texel_world).max(Vec2::splat(NARROWEST));
                Disc { half, rise: slope * world, most: HIGHEST.min(0.25 * gap) }
            }
        }
    }
}

impl<D: ReceiverDepth> Filter for HdrpPcss<D> {
    #[inline(always)]
    fn shadow<S: Simd, M: DepthMap, Q: Probe>(&self, query: &mut Query<'_, S, M, Q>) -> f32 {
        let (view, receiver) = (query.view(), query.receiver());
        let own = distance(view, receiver.depth) as f32;
        let light = self.light(view);
        let (search, blur) = (self.search.clamp(1, 64), self.blur.clamp(1, 64));

        let density = if view.is_perspective() { Density::Uniform } else { Density::Centred };
        let spiral = Spiral::default().with_num_samples(search).with_density(density).with_rotate(self.rotate);
        let disc = light.search(view, receiver, own);
        let raised = Raised { depth: &self.depth, disc, density, count: search, taps: 1 };
        let (mut sum, mut found) = (0.0f64, 0u32);
        let region = query.boxed(disc.half);
        query.nearest(
            &region,
            &spiral,
            &raised,
            #[inline(always)]
            |_, taps, compared, stored| {
                let nearer = compared.simd_gt(stored).to_bitmask() as u32 & taps.mask;
                found += nearer.count_ones();
                for i in (0..16).filter(|i| nearer >> i & 1 == 1) {
                    let at = distance(view, stored[i]);
                    // Screen depth is linear in the distance, or in its reciprocal.
                    sum += if view.is_perspective() { 1.0 / at } else { at };
                }
            },
        );
        let mean = sum / f64::from(found);
        let mean = if view.is_perspective() { 1.0 / mean } else { mean };
        let disc = light.blur(view, receiver, own, (found > 0).then_some(mean as f32));
        let vogel = Vogel::default().with_num_samples(blur).with_rotate(self.rotate);
        let raised = Raised { depth: &self.depth, disc, density: Density::Uniform, count: blur, taps: 4 };
        let region = query.boxed(disc.half + 1.0);
        query.share(&region, &vogel, &raised)
    }
}

/// A depth that comes nearer to the light with the distance of a sample from the middle of its disc.
struct Raised<'a, D> {
    depth: &'a D,
    disc: Disc,
    density: Density,
    /// Samples on the disc, and taps of each.
    count: u32,
    taps: u32,
}

impl<D: ReceiverDepth> ReceiverDepth for Raised<'_, D> {
    #[inline(always)]
    fn lanes<S: Simd>(&self, simd: S, view: &View, receiver: &Receiver, taps: &Taps<S>) -> f32x16<S> {
        self.prepared(view, receiver).lanes(simd, taps)
    }

    #[inline(always)]
    fn bounds(&self, view: &View, receiver: &Receiver, rect: TexelRect) -> DepthRange {
        self.prepared(view, receiver).bounds(rect)
    }

    #[inline(always)]
    fn prepared<'a>(&'a self, view: &'a View, receiver: &'a Receiver) -> impl Compared + 'a {
        // It rises in parallel light alone, where depth is linear in the distance.
        let unit = if view.kind() == Kind::Screen { (1.0 / (view.far() - view.near())) as f32 } else { 1.0 };
        let Disc { rise, most, .. } = self.disc;
        Ready {
            depth: self.depth.prepared(view, receiver),
            rise: rise * unit,
            most: most * unit,
            density: self.density,
            count: self.count,
            taps: self.taps,
        }
    }
}

/// [`Raised`] of one receiver, in units of the map.
struct Ready<C> {
    depth: C,
    rise: f32,
    most: f32,
    density: Density,
    count: u32,
    taps: u32,
}

impl<C: Compared> Compared for Ready<C> {
    #[inline(always)]
    fn region(&self, region: &Footprint) -> Footprint {
        self.depth.region(region)
    }

    #[inline(always)]
    fn lanes<S: Simd>(&self, simd: S, taps: &Taps<S>) -> f32x16<S> {
        // By the sample's place on the disc, not by that of a texel beside it.
        let mut raised = [0.0; 16];
        for (raised, index) in raised.iter_mut().zip(taps.first..) {
            *raised = (self.rise * Spiral::share(self.density, index / self.taps, self.count)).min(self.most);
        }
        self.depth.lanes(simd, taps) - f32x16::load_array(simd, raised)
    }

    #[inline(always)]
    fn bounds(&self, rect: TexelRect) -> DepthRange {
        let DepthRange { min, max } = self.depth.bounds(rect);
        DepthRange { min: (min - self.rise.min(self.most)).next_down(), max: max.next_up() }
    }
}
