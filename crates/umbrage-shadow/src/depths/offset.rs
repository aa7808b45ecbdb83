use super::Compared;
use fearless_simd::{Simd, f32x16, prelude::*};
use glam::{DVec3, Vec2};
use umbrage_plane::{Bias, DepthRange, Footprint, Receiver, TexelRect, View};
use umbrage_sample::Taps;

/// How a [`NormalOffset`] grows with the angle θ between the surface's normal and the direction to the light.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Default)]
pub enum OffsetGrowth {
    /// Not at all: as Bevy and Unity's HDRP offset a receiver.
    #[default]
    Even,
    /// By sin θ, nothing where the surface faces the light: as Filament and Babylon.js do. Off the axis of a spot light, the depth of a surface that faces it
    /// still changes from texel to texel, and this is too little for it.
    Sine,
    /// By 1 − cos θ: as Unity's URP does, and Godot for spot lights.
    Versine,
}

impl OffsetGrowth {
    /// The factor for the angle between normal and light, by its sine, from 0 to 1, and its cosine. Surfaces that face away are treated as if seen
    /// from behind. Both are given because near 0 the sine cannot be found from the cosine.
    #[inline(always)]
    pub fn of(self, sine: f64, cosine: f64) -> f64 {
        match self {
            Self::Even => 1.0,
            Self::Sine => sine.min(1.0),
            Self::Versine => 1.0 - cosine.abs().min(1.0),
        }
    }
}

/// The receiver moved along its geometric normal, to the side that the light is on, before it is looked up: elsewhere in the map, and at another depth
/// (Holbert 2011, *Saying Goodbye to Shadow Acne*, and engines since).
///
/// On a plane at an angle θ to parallel light, an offset of s world units puts the compared depth s/cos θ in front of the plane. With an offset of w texels
/// (τ world units each) that is more than the plane changes over h texels along both axes, √2·h·τ·tan θ, wherever w is more than √2·h·sin θ: so an
/// offset of √2·h texels, or of as many times [the sine](OffsetGrowth::Sine), is free of false shadow at any tilt. Unlike a bias it does not grow without
/// bounds at
/// grazing light; but shadows move sideways by up to the offset.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub struct NormalOffset {
    /// Widths of a texel at the receiver: τ, the larger of both axes.
    pub texels: f32,
    /// How it grows at grazing angles.
    pub growth: OffsetGrowth,
    /// Also moves the receiver toward the light.
    pub bias: Bias,
}

impl Default for NormalOffset {
    /// One and a half texels, whatever the angle, for the rounding texel and a filter of the nearest four.
    fn default() -> Self {
        Self { texels: 1.5, growth: OffsetGrowth::Even, bias: Bias::ZERO }
    }
}

umbrage_plane::builders!([] NormalOffset { with_texels texels: f32, with_growth growth: OffsetGrowth, with_bias bias: Bias });

impl NormalOffset {
    /// How far a receiver is moved along its normal, world units.
    #[inline(always)]
    pub fn world(&self, view: &View, receiver: &Receiver) -> f64 {
        let toward = if view.is_perspective() { -receiver.eye.normalize_or_zero() } else { DVec3::Z };
        let factor = self.growth.of(receiver.normal.cross(toward).length(), f64::from(receiver.facing));
        f64::from(self.texels * receiver.texel_world.max_element()) * factor
    }

    /// For one receiver.
    #[inline(always)]
    pub(super) fn ready(&self, view: &View, receiver: &Receiver) -> Moved {
        Moved::by(view, receiver, self.world(view, receiver), f64::from(receiver.in_world(view, self.bias)))
    }
}

by_what_is_ready!(NormalOffset, |_| true);

/// A receiver that was moved before it is looked up: what a [`ReceiverDepth`](crate::ReceiverDepth) with an offset prepares.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Moved {
    /// From where the receiver is in the map to where it is looked up, texels.
    pub shift: Vec2,
    /// What is compared at every tap, of the map's kind.
    pub depth: f32,
}

impl Moved {
    /// A receiver moved by `along` world units along its normal, to the side that the light is on, and then by `toward` world units toward the light along its
    /// axis (along the ray in a radial map). One that is moved behind the light is lit.
    #[inline(always)]
    pub fn by(view: &View, receiver: &Receiver, along: f64, toward: f64) -> Self {
        let Some(moved) = receiver.offset(view, along) else {
            return Self { shift: Vec2::ZERO, depth: f32::NEG_INFINITY };
        };
        Self { shift: (moved.texel - receiver.texel).as_vec2(), depth: moved.nearer(view, Bias::World(toward as f32)) }
    }
}

impl Compared for Moved {
    #[inline(always)]
    fn region(&self, region: &Footprint) -> Footprint {
        let Footprint { centre, half, corners } = *region;
        Footprint { centre: centre + self.shift, half, corners: corners.map(|corner| corner + self.shift) }
    }

    #[inline(always)]
    fn lanes<S: Simd>(&self, simd: S, _taps: &Taps<S>) -> f32x16<S> {
        f32x16::splat(simd, self.depth)
    }

    #[inline(always)]
    fn bounds(&self, _rect: TexelRect) -> DepthRange {
        DepthRange { min: self.depth, max: self.depth }
    }
}
