//! The default biases of engines as compared depths.

use crate::settings::Settings;
use umbrage_engines::{Conditions, Engine, EngineError, WorldBias};
use umbrage_plane::{DepthRange, Footprint, Receiver, TexelRect, View};
use umbrage_sample::Taps;
use umbrage_shadow::{AnyDepth, Compared, HdrpPcss, Moved, ReceiverDepth, Simd, f32x16};

/// An engine's default bias. It differs from receiver to receiver, with the light's projection and its map.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum EngineBias {
    Three,
    /// Without a depth texture.
    Babylon,
    /// With one.
    BabylonPcf,
    Filament,
    Bevy,
    Godot,
    /// Of hard shadows.
    Urp,
    /// Of soft ones.
    UrpSoft,
    Hdrp,
    /// Of its soft shadows of high quality.
    HdrpPcss,
}

impl EngineBias {
    pub const fn engine(self) -> Engine {
        match self {
            Self::Three => Engine::Three,
            Self::Babylon | Self::BabylonPcf => Engine::Babylon,
            Self::Filament => Engine::Filament,
            Self::Bevy => Engine::Bevy,
            Self::Godot => Engine::Godot,
            Self::Urp | Self::UrpSoft => Engine::Urp,
            Self::Hdrp | Self::HdrpPcss => Engine::Hdrp,
        }
    }
}

/// An engine's bias with what a recipe says of it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct OfEngine {
    pub bias: EngineBias,
    pub settings: Settings,
    /// The radius of a lamp, on which HDRP's bias depends under its soft shadows, world units.
    pub lamp: f32,
}

impl OfEngine {
    /// Under conditions that a light and a receiver give.
    fn under(self, view: &View, conditions: &Conditions) -> Result<WorldBias, EngineError> {
        let conditions = match self.bias {
            EngineBias::BabylonPcf => conditions.with_depth_texture(true),
            // Medium quality, 5 x 5 texels.
            EngineBias::UrpSoft => conditions.with_filter_radius(Some(2.5)),
            _ => *conditions,
        };
        // Where a unit of the depth format is left open, the least value.
        let given: Vec<(&str, f64)> =
            self.settings.given(self.bias.engine()).map(|(info, value)| (info.name, value)).collect();
        let mut found = self.bias.engine().world(&given, &conditions)?.least;
        if self.bias == EngineBias::HdrpPcss {
            found.slope *= f64::from(HdrpPcss::default().with_radius(self.lamp).slope_bias(view));
        }
        Ok(found)
    }

    /// In world units; none for a receiver that no engine shades or maps: one that faces away from the light, or is nearer or farther than its range. None
    /// either where settings lead behind all that a light can see.
    pub fn of(self, view: &View, receiver: &Receiver) -> WorldBias {
        let conditions = Conditions::of(view, receiver);
        conditions.and_then(|conditions| self.under(view, &conditions)).unwrap_or(WorldBias::ZERO)
    }

    /// How far in front of a plane of a slope the compared depth lies at an axial distance, world units along the light's axis; 0 where nothing is known of it.
    pub fn lift(self, light: &View, zeta: f64, slope: f64) -> f64 {
        let lift = || -> Result<f64, EngineError> {
            let conditions = Conditions::on_axis(light, zeta)?.with_light_at(1.0 / slope.hypot(1.0));
            self.under(light, &conditions)?.along_axis(&conditions)
        };
        lift().unwrap_or(0.0)
    }

    /// How much nearer to the light along its axis a receiver is compared, world units; `offset` is what a way along the normal contributes.
    pub fn nearer(self, view: &View, receiver: &Receiver, offset: impl Fn(f64) -> f64) -> f64 {
        let (normal, toward) = self.parts(view, receiver);
        offset(normal) + toward
    }

    fn moved(self, view: &View, receiver: &Receiver) -> Moved {
        let (normal, toward) = self.parts(view, receiver);
        Moved::by(view, receiver, normal, toward)
    }

    /// The way along the normal, and the one toward the light.
    fn parts(self, view: &View, receiver: &Receiver) -> (f64, f64) {
        let WorldBias { constant, slope, normal } = self.of(view, receiver);
        let steps = f64::from(receiver.texel_world.max_element() * receiver.slope);
        let scaled = if slope == 0.0 { 0.0 } else { slope * steps };
        (normal, constant + scaled)
    }
}

/// What a recipe compares.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Depth {
    Any(AnyDepth),
    Engine(OfEngine),
}

impl ReceiverDepth for Depth {
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
        match self {
            Self::Any(depth) => Ready::Any(depth.prepared(view, receiver)),
            Self::Engine(bias) => Ready::Moved(bias.moved(view, receiver)),
        }
    }
}

/// [`Depth`] of one receiver.
enum Ready<C> {
    Any(C),
    Moved(Moved),
}

impl<C: Compared> Compared for Ready<C> {
    #[inline(always)]
    fn region(&self, region: &Footprint) -> Footprint {
        match self {
            Self::Any(depth) => depth.region(region),
            Self::Moved(depth) => depth.region(region),
        }
    }

    #[inline(always)]
    fn lanes<S: Simd>(&self, simd: S, taps: &Taps<S>) -> f32x16<S> {
        match self {
            Self::Any(depth) => depth.lanes(simd, taps),
            Self::Moved(depth) => depth.lanes(simd, taps),
        }
    }

    #[inline(always)]
    fn bounds(&self, rect: TexelRect) -> DepthRange {
        match self {
            Self::Any(depth) => depth.bounds(rect),
            Self::Moved(depth) => depth.bounds(rect),
        }
    }

    #[inline(always)]
    fn settled(&self, rect: TexelRect, stored: DepthRange) -> Option<bool> {
        match self {
            Self::Any(depth) => depth.settled(rect, stored),
            Self::Moved(depth) => depth.settled(rect, stored),
        }
    }
}
