use crate::TapJudged;
use glam::{IVec2, Vec3};
use std::borrow::Cow;
use umbrage_depth::{Step, Translucent};
use umbrage_sample::Tap;

/// Which light a query is about, where a deep map colours it.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Channel {
    /// The mean of red, green and blue.
    All,
    /// Red, green or blue: 0, 1 or 2.
    One(usize),
}

impl Channel {
    /// What passes of this light.
    #[inline(always)]
    pub fn of(self, passes: Vec3, grey: bool) -> f32 {
        match self {
            Self::One(channel) => passes[channel],
            Self::All if grey => passes.x,
            Self::All => passes.element_sum() * (1.0 / 3.0),
        }
    }
}

/// What [`Query::each`](crate::Query::each) reports of one tap.
#[derive(Clone, Debug)]
pub struct Seen<'a> {
    /// Where it is, and its weight.
    pub tap: Tap,
    /// The receiver's depth there, bias included.
    pub compared: f32,
    /// What is there.
    pub met: Met<'a>,
}

impl Seen<'_> {
    /// The fraction of the light that does not arrive at this tap, in 0..=1: what percentage-closer filtering averages.
    #[inline(always)]
    pub fn dark(&self) -> f32 {
        match &self.met {
            Met::Settled(dark) => *dark,
            Met::Surfaces(surfaces) => surfaces.dark(self.compared),
        }
    }

    /// The same for a probe, with the nearest depth that is stored there.
    pub(crate) fn judged(&self, stored: f32) -> TapJudged {
        let ruled = if let Met::Settled(dark) = &self.met { Some(*dark) } else { None };
        let (at, weight, compared) = (self.tap.at, self.tap.weight, self.compared);
        TapJudged { at, stored, compared, weight, ruled, dark: self.dark() }
    }
}

/// What a tap meets.
#[derive(Clone, Debug)]
pub enum Met<'a> {
    /// Its place settles the result by the view's [`Rules`](umbrage_plane::Rules): 0 is lit, 1 is in shadow. Whatever the map
    /// holds there does not count.
    Settled(f32),
    /// What the map stores there.
    Surfaces(Surfaces<'a>),
}

/// The surfaces over one texel, as one colour of light meets them. A plain map has one opaque surface, or none.
#[derive(Clone, Debug)]
pub struct Surfaces<'a>(Stack<'a>);

#[derive(Clone, Debug)]
enum Stack<'a> {
    Opaque(f32),
    Deep { steps: Cow<'a, [Step]>, channel: Channel, grey: bool },
}

impl<'a> Surfaces<'a> {
    /// The one surface of a plain map's texel; none for +∞.
    #[inline(always)]
    pub(crate) fn opaque(stored: f32) -> Self {
        Self(Stack::Opaque(stored))
    }

    /// All surfaces of a deep map's texel.
    #[inline(always)]
    pub(crate) fn deep(deep: &'a dyn Translucent, texel: IVec2, channel: Channel) -> Self {
        Self(Stack::Deep { steps: deep.steps(texel), channel, grey: deep.is_grey() })
    }

    /// The fraction of the light that surfaces nearer than `depth` stop, in 0..=1. A surface at `depth` itself is not nearer.
    #[inline(always)]
    pub fn dark(&self, depth: f32) -> f32 {
        match &self.0 {
            Stack::Opaque(stored) => f32::from(u8::from(depth > *stored)),
            Stack::Deep { steps, channel, grey } => {
                let nearer = steps.partition_point(|step| step.depth < depth);
                if nearer == 0 { 0.0 } else { 1.0 - channel.of(steps[nearer - 1].passes, *grey) }
            }
        }
    }

    /// The depth of the nearest surface, opaque or not; +∞ without one.
    #[inline(always)]
    pub fn nearest(&self) -> f32 {
        match &self.0 {
            Stack::Opaque(stored) => *stored,
            Stack::Deep { steps, .. } => steps.first().map_or(f32::INFINITY, |step| step.depth),
        }
    }

    /// Each surface, nearest first: its depth and the fraction of the light from the lamp that it stops. The fractions of a
    /// texel add up to 1 where nothing passes.
    pub fn iter(&self) -> impl Iterator<Item = (f32, f32)> + '_ {
        let (plain, deep) = match &self.0 {
            Stack::Opaque(stored) => ((*stored < f32::INFINITY).then_some((*stored, 1.0)), None),
            Stack::Deep { steps, channel, grey } => {
                let mut left = 1.0;
                let stopped = steps.iter().map(move |step| {
                    let before = std::mem::replace(&mut left, channel.of(step.passes, *grey));
                    (step.depth, before - left)
                });
                (None, Some(stopped))
            }
        };
        plain.into_iter().chain(deep.into_iter().flatten())
    }
}
