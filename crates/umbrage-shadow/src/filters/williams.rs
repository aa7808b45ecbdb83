//! Casting curved shadows on curved surfaces, Williams 1978.
//!
//! [`Williams`] is the test of one point against the light's map, with the stages that the paper puts in front of the
//! comparison in their order: transform, dither, look up, compare. The matrices by which a finished picture is
//! tested are here as well; the stages after the comparison work on the shadow image and live in `umbrage-render`.
//!
//! Departures: (1) bilinear interpolation of an axial perspective map is done on −1/ζ, where planes are linear;
//! (2) [`Guard`] keeps blends across silhouettes out of the comparison.

use crate::{Filter, Probe, Query, Surfaces, TapJudged};
use fearless_simd::Simd;
use glam::{DMat4, DVec3, DVec4, IVec2, Vec2};
use umbrage_depth::DepthMap;
use umbrage_plane::{Bias, Kind, Place, Receiver, View};
use umbrage_sample::Key;

/// How the light's depth at a point is read from the texels around it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Lookup {
    /// The texel that the point falls in (Williams 1978).
    Nearest,
    /// Interpolated between the four nearest texel centres (Williams 1978).
    Bilinear(Guard),
}

/// What bilinear interpolation does at a silhouette, where a blend means nothing (Williams 1978).
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Guard {
    /// Blends whatever is there; empty texels count as the far plane.
    Faithful,
    /// Takes the nearest texel instead when one of the four is empty, or when they differ by more than this many depth steps of the receiver's own plane.
    Steps(f32),
}

impl Default for Guard {
    fn default() -> Self {
        Self::Steps(4.0)
    }
}

/// The law of the dither (Williams 1978).
#[derive(Clone, Copy, Debug, PartialEq, Eq, Default)]
pub enum DitherLaw {
    /// Normal with σ = 1/6, redrawn outside ±½: standard deviation 0.16443.
    #[default]
    TruncatedNormal,
    /// Mean of three uniform numbers minus ½: standard deviation 1/6.
    ThreeUniforms,
}

/// A random displacement before the look-up (Williams 1978).
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub struct Dither {
    /// Full range of the displacement in x and y, in texels: 1 means ±½. 0 is off; the legal range is 0..=2.
    pub amplitude: f32,
    /// The law it is drawn from.
    pub law: DitherLaw,
    /// Full range of a displacement of the receiver's depth, in units of the map's numbers (the paper's wording admits both); 0 is off.
    pub depth: f32,
}

umbrage_plane::builders!([] Dither { with_amplitude amplitude: f32, with_law law: DitherLaw, with_depth depth: f32 });

impl Default for Dither {
    /// [`Dither::OFF`].
    fn default() -> Self {
        Self::OFF
    }
}

impl Dither {
    /// None.
    pub const OFF: Self = Self { amplitude: 0.0, law: DitherLaw::TruncatedNormal, depth: 0.0 };
    /// The paper's: ±½ texel.
    pub const HALF_TEXEL: Self = Self { amplitude: 1.0, ..Self::OFF };

    /// One number of the law, in \[−½, ½\]; `axis` 0, 1 or 2 gives independent ones.
    pub fn draw(law: DitherLaw, key: Key, axis: u32) -> f32 {
        match law {
            DitherLaw::ThreeUniforms => (key.unit(axis, 4) + key.unit(axis, 5) + key.unit(axis, 6)) * (1.0 / 3.0) - 0.5,
            DitherLaw::TruncatedNormal => {
                // Box–Muller; outside ±3σ comes up 27 times in 10,000, so that eight tries never fail in practice.
                for attempt in 0..8 {
                    let draw = axis * 8 + attempt;
                    let radius = (-2.0 * f64::from(1.0 - key.unit(draw, 4)).ln()).sqrt();
                    let value = radius * (std::f64::consts::TAU * f64::from(key.unit(draw, 5))).cos() / 6.0;
                    if value.abs() <= 0.5 {
                        return value as f32;
                    }
                }
                0.0
            }
        }
    }
}

/// Williams' test of one point. The result is 0 or 1, except over deep maps, where it is the fraction of light that the surfaces stop.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub struct Williams {
    /// Moves the point toward the light (Williams 1978).
    pub bias: Bias,
    /// How the stored depth is read.
    pub lookup: Lookup,
    /// Displacement before the look-up.
    pub dither: Dither,
}

umbrage_plane::builders!([] Williams { with_bias bias: Bias, with_lookup lookup: Lookup, with_dither dither: Dither });

impl Default for Williams {
    /// The paper's: [`presets::williams78`](crate::presets::williams78).
    fn default() -> Self {
        Self { bias: Bias::Map(2.0 / 65_535.0), lookup: Lookup::Nearest, dither: Dither::OFF }
    }
}

impl Filter for Williams {
    #[inline(always)]
    fn shadow<S: Simd, M: DepthMap, P: Probe>(&self, query: &mut Query<'_, S, M, P>) -> f32 {
        let (view, receiver, key) = (query.view(), query.receiver(), query.key());
        let mut at = receiver.texel.as_vec2();
        if self.dither.amplitude > 0.0 {
            let draw = |axis| Dither::draw(self.dither.law, key, axis);
            at += Vec2::new(draw(0), draw(1)) * self.dither.amplitude;
        }
        if let Some(dark) = query.placed(at) {
            return dark;
        }
        let mut compared = receiver.nearer(view, self.bias);
        if self.dither.depth > 0.0 {
            compared += Dither::draw(self.dither.law, key, 2) * self.dither.depth;
        }
        match self.lookup {
            Lookup::Bilinear(guard) if view.locate(at) != Place::Outside => {
                let dark = compared > bilinear(query.map(), at, guard, receiver);
                let (texels, fraction) = four(view, at);
                let surfaces = texels.map(|texel| query.texel(texel));
                if P::EXPLAINS {
                    // The depths are interpolated, and one result is made of all four.
                    query.probe().asked();
                    let [x, y] = fraction.to_array();
                    let weights = [(1.0 - x) * (1.0 - y), x * (1.0 - y), (1.0 - x) * y, x * y];
                    for (texel, (surfaces, weight)) in texels.iter().zip(surfaces.iter().zip(weights)) {
                        let (at, stored) = (texel.as_vec2() + 0.5, surfaces.nearest());
                        let dark = f32::from(u8::from(dark));
                        query.probe().tapped(&TapJudged { at, stored, compared, weight, ruled: None, dark });
                    }
                }
                if dark && query.map().translucent().is_some() {
                    // What the surfaces of those of the four texels that have any stop in all.
                    let stops = lerp(surfaces.each_ref().map(|surfaces| surfaces.dark(f32::INFINITY)), fraction);
                    let any = |surfaces: &Surfaces<'_>| f32::from(u8::from(surfaces.nearest() < f32::INFINITY));
                    let there = lerp(surfaces.each_ref().map(any), fraction);
                    if there > 0.0 { stops / there } else { 1.0 }
                } else {
                    f32::from(u8::from(dark))
                }
            }
            // Outside the map there is nothing to interpolate, only what a neighbour may store there.
            Lookup::Nearest | Lookup::Bilinear(_) => {
                let surfaces = query.texel(at.floor().as_ivec2());
                let dark = surfaces.dark(compared);
                if P::EXPLAINS {
                    let stored = surfaces.nearest();
                    query.probe().asked();
                    query.probe().tapped(&TapJudged { at, stored, compared, weight: 1.0, ruled: None, dark });
                }
                dark
            }
        }
    }
}

/// The four texels whose centres lie around a texel position, clamped to the map: left and right above, left and right below. Also
/// the position between the first and the last, from 0 to 1 on each axis.
#[inline(always)]
pub(super) fn four(view: &View, at: Vec2) -> ([IVec2; 4], Vec2) {
    let corner = (at - 0.5).floor();
    let last = view.size().as_ivec2() - 1;
    let texel = |x, y| (corner.as_ivec2() + IVec2::new(x, y)).clamp(IVec2::ZERO, last);
    ([texel(0, 0), texel(1, 0), texel(0, 1), texel(1, 1)], at - 0.5 - corner)
}

#[inline(always)]
pub(super) fn lerp([a, b, c, d]: [f32; 4], fraction: Vec2) -> f32 {
    let top = a + (b - a) * fraction.x;
    let bottom = c + (d - c) * fraction.x;
    top + (bottom - top) * fraction.y
}

/// The depth at a texel position between the four nearest texel centres (Williams 1978).
///
/// Screen and orthographic depths are interpolated as they are, axial perspective depths through −1/ζ.
pub fn bilinear<M: DepthMap>(map: &M, at: Vec2, guard: Guard, receiver: &Receiver) -> f32 {
    let view = map.view();
    let (texels, fraction) = four(view, at);
    let mut four = texels.map(|texel| map.depth(texel));
    match guard {
        Guard::Faithful => {
            let far = far_depth(view);
            four = four.map(|depth| depth.min(far));
        }
        Guard::Steps(steps) => {
            let (low, high) = four.iter().fold((f32::INFINITY, f32::NEG_INFINITY), |(l, h), &d| (l.min(d), h.max(d)));
            let step = receiver.depth - receiver.nearer(view, Bias::Steps(1.0));
            if !high.is_finite() || high - low > steps * step {
                return map.depth(at.floor().as_ivec2());
            }
        }
    }
    let inverse = view.is_perspective() && view.kind() == Kind::Axial;
    let value = lerp(four.map(|depth| if inverse { -1.0 / depth } else { depth }), fraction);
    if inverse { -1.0 / value } else { value }
}

fn far_depth(view: &View) -> f32 {
    if view.kind() == Kind::Screen { 1.0 } else { view.far() as f32 }
}

/// The single matrix from the observer's screen (x_n, y_n, z_s) to the light's: M_light · M_observer⁻¹ (Williams 1978).
///
/// It takes homogeneous points; divide by w afterwards ([`transform`]).
pub fn observer_to_light(observer: &View, light: &View) -> DMat4 {
    // From eye to eye first: far from the world's origin the two places cancel there, before anything is projected.
    let eye_to_eye = light.world_to_eye() * observer.eye_to_world();
    light.eye_to_screen() * eye_to_eye * observer.eye_to_screen().inverse()
}

/// Subtracts `bias` (units of z_s) from the z that comes out, inside the matrix: row 3 minus bias times row 4 (Williams 1978).
pub fn fold_bias(matrix: DMat4, bias: f64) -> DMat4 {
    let rows = matrix.transpose();
    DMat4::from_cols(rows.x_axis, rows.y_axis, rows.z_axis - bias * rows.w_axis, rows.w_axis).transpose()
}

/// A point through a matrix with the homogeneous divide. `None` behind the light (w ≤ 0).
#[inline(always)]
pub fn transform(matrix: &DMat4, point: DVec3) -> Option<DVec3> {
    let out: DVec4 = *matrix * point.extend(1.0);
    (out.w > 0.0).then(|| out.truncate() / out.w)
}

/// Many points at once through one matrix (Williams 1978); the ones behind the light become NaN.
pub fn transform_all(matrix: &DMat4, points: &mut [DVec3]) {
    for point in points {
        *point = transform(matrix, *point).unwrap_or(DVec3::NAN);
    }
}
