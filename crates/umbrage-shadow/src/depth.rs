use fearless_simd::{Simd, f32x16, prelude::*};
use glam::{IVec2, Vec2};
use umbrage_plane::{Bias, DepthRange, Kind, Receiver, TexelRect, View, floor_texel};
use umbrage_sample::{Taps, radical_inverses};

/// Which depth the receiver is given at a tap; a texel nearer than that shadows it.
pub trait ReceiverDepth: Send + Sync {
    /// The depth to compare at each of the taps, in the map's kind, bias included.
    fn lanes<S: Simd>(&self, simd: S, view: &View, receiver: &Receiver, taps: &Taps<S>) -> f32x16<S>;

    /// Encloses every value that [`ReceiverDepth::lanes`] can return for taps inside `rect`, rounding included.
    fn bounds(&self, view: &View, receiver: &Receiver, rect: TexelRect) -> DepthRange;
}

/// How a bias is taken from its range at each tap.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Default)]
pub enum Spread {
    /// At random (Reeves 1987, R87-14): a surface that curves away shadows itself gradually, with noise.
    #[default]
    Random,
    /// As a ramp: tap k takes the radical inverse of k, so that the taps of a region share the range without noise; evenly when
    /// they are a power of two. Bias and place in the region then go together, as taps come row by row.
    Ramp,
}

/// One depth for the whole region, moved toward the light by a bias from a range (Reeves 1987, §3.2 and Fig. 4; R87-14).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Biased {
    /// Smallest bias.
    pub low: Bias,
    /// Largest bias; equal to `low` for a fixed bias. Never reached exactly when it differs.
    pub high: Bias,
    /// How a tap's bias is taken from the range.
    pub spread: Spread,
}

impl Biased {
    /// The same bias at every tap.
    pub const fn constant(bias: Bias) -> Self {
        Self { low: bias, high: bias, spread: Spread::Random }
    }

    /// World units drawn at random from `low..high`.
    pub const fn world(low: f32, high: f32) -> Self {
        Self { low: Bias::World(low), high: Bias::World(high), spread: Spread::Random }
    }

    #[inline(always)]
    fn ends(&self, view: &View, receiver: &Receiver) -> (f32, f32) {
        (receiver.nearer(view, self.low), receiver.nearer(view, self.high))
    }
}

impl Default for Biased {
    /// Reeves' (0.3, 0.4), for worlds of about 100 units.
    fn default() -> Self {
        Self::world(0.3, 0.4)
    }
}

impl ReceiverDepth for Biased {
    #[inline(always)]
    fn lanes<S: Simd>(&self, simd: S, view: &View, receiver: &Receiver, taps: &Taps<S>) -> f32x16<S> {
        let (near_end, far_end) = self.ends(view, receiver);
        if near_end == far_end || !(far_end - near_end).is_finite() {
            return f32x16::splat(simd, near_end);
        }
        let share = match self.spread {
            Spread::Random => taps.u,
            Spread::Ramp => radical_inverses(simd, taps.first),
        };
        share * (far_end - near_end) + near_end
    }

    #[inline(always)]
    fn bounds(&self, view: &View, receiver: &Receiver, _rect: TexelRect) -> DepthRange {
        let (near_end, far_end) = self.ends(view, receiver);
        if near_end == far_end || !(far_end - near_end).is_finite() {
            return DepthRange { min: near_end, max: near_end };
        }
        let last = near_end + (far_end - near_end);
        DepthRange { min: near_end.min(last), max: near_end.max(last) }
    }
}

/// The receiver's tangent plane where the texel that is read was sampled, moved toward the light
/// (the receiver plane of R87-13 and E-R16; the virtual sample of Wang & Molnar 1994, WM94-7 to WM94-10).
///
/// A plane then needs no bias for slope, only for rounding. One that is edge-on to the light has the receiver's own depth everywhere; one whose
/// horizon is passed is at +∞ there, behind everything that is stored (D-5).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct OnPlane {
    /// Moves the whole plane toward the light.
    pub bias: Bias,
    /// Moves it by so many times the rounding of its own depths: 4·10⁻⁶ of screen depth, 10⁻⁶ of other depths, both over |N·L|
    /// (WM94-12, V58). 1 lets a flat sheet be its own second surface.
    pub slack: f32,
    /// The plane's depth goes no farther than this from the receiver's own, in the map's units; +∞ lets it (WM94-10).
    pub reach: f32,
}

impl Default for OnPlane {
    /// The plane itself.
    fn default() -> Self {
        Self { bias: Bias::ZERO, slack: 0.0, reach: f32::INFINITY }
    }
}

impl OnPlane {
    /// The plane moved by a bias.
    pub const fn biased(bias: Bias) -> Self {
        Self { bias, slack: 0.0, reach: f32::INFINITY }
    }

    /// How far the plane is moved away from the receiver's own depth, in the map's units; ≤ 0 is toward the light.
    #[inline(always)]
    fn shift(&self, view: &View, receiver: &Receiver) -> f32 {
        let rounding = if view.kind() == Kind::Screen { 4e-6 } else { 1e-6 * receiver.depth.abs() };
        // At the least cosine that Wang & Molnar's rule looks at.
        let slack = self.slack * rounding / receiver.facing.abs().max(0.02);
        (receiver.nearer(view, self.bias) - receiver.depth) - slack
    }
}

impl ReceiverDepth for OnPlane {
    #[inline(always)]
    fn lanes<S: Simd>(&self, simd: S, view: &View, receiver: &Receiver, taps: &Taps<S>) -> f32x16<S> {
        let plane = receiver.plane(view);
        let shift = self.shift(view, receiver);
        let (column, row) = (floor_texel(simd, taps.x), floor_texel(simd, taps.y));
        let (low, high) = (receiver.depth - self.reach, receiver.depth + self.reach);
        let mut depths = [0.0; 16];
        for i in 0..16 {
            let depth = plane.at(view.sampling().position(IVec2::new(column[i], row[i])));
            depths[i] = depth.max(low).min(high) + shift;
        }
        f32x16::load_array(simd, depths)
    }

    #[inline(always)]
    fn bounds(&self, view: &View, receiver: &Receiver, rect: TexelRect) -> DepthRange {
        let shift = self.shift(view, receiver);
        let plane = receiver.plane(view).bounds(rect);
        let kept = |depth: f32| depth.max(receiver.depth - self.reach).min(receiver.depth + self.reach);
        DepthRange { min: kept(plane.min) + shift, max: kept(plane.max) + shift }
    }
}

/// Texel positions as a pair, for code that asks one lane at a time.
#[inline(always)]
pub(crate) fn lane<S: Simd>(taps: &Taps<S>, i: usize) -> Vec2 {
    Vec2::new(taps.x[i], taps.y[i])
}
