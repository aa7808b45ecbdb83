use super::{BiasCone, Biased, Compared, Moved, NormalOffset, OnPlane, SlopeScaled, biased, cone, plane};
use fearless_simd::{Simd, f32x16};
use umbrage_plane::{DepthRange, Footprint, Receiver, TexelRect, View};
use umbrage_sample::Taps;

/// Any of this crate's compared depths, chosen when the program runs: what a recipe's `depth=` becomes. The same bits as its own type.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub enum AnyDepth {
    /// [`Biased`].
    Biased(Biased),
    /// [`OnPlane`].
    OnPlane(OnPlane),
    /// [`BiasCone`].
    Cone(BiasCone),
    /// [`SlopeScaled`].
    Slope(SlopeScaled),
    /// [`NormalOffset`].
    Offset(NormalOffset),
}

impl AnyDepth {
    /// For one receiver.
    #[inline(always)]
    fn ready<'a>(&self, view: &'a View, receiver: &'a Receiver) -> Ready<'a> {
        match self {
            Self::Biased(depth) => Ready::Biased(depth.ready(view, receiver)),
            Self::OnPlane(depth) => Ready::OnPlane(depth.ready(view, receiver)),
            Self::Cone(depth) => Ready::Cone(depth.ready(view, receiver)),
            Self::Slope(depth) => Ready::Biased(depth.ready(view, receiver)),
            Self::Offset(depth) => Ready::Moved(depth.ready(view, receiver)),
        }
    }
}

by_what_is_ready!(AnyDepth, |depth| match depth {
    AnyDepth::Biased(depth) => depth.asks_tilt(),
    AnyDepth::OnPlane(depth) => depth.asks_tilt(),
    AnyDepth::Cone(depth) => depth.asks_tilt(),
    AnyDepth::Slope(depth) => depth.asks_tilt(),
    AnyDepth::Offset(depth) => depth.asks_tilt(),
});

/// [`AnyDepth`] of one receiver.
#[derive(Clone, Copy)]
enum Ready<'a> {
    Biased(biased::Ready),
    OnPlane(plane::Ready),
    Cone(cone::Ready<'a>),
    Moved(Moved),
}

impl Compared for Ready<'_> {
    #[inline(always)]
    fn region(&self, region: &Footprint) -> Footprint {
        if let Self::Moved(depth) = self { depth.region(region) } else { *region }
    }

    #[inline(always)]
    fn lanes<S: Simd>(&self, simd: S, taps: &Taps<S>) -> f32x16<S> {
        match self {
            Self::Biased(depth) => depth.lanes(simd, taps),
            Self::OnPlane(depth) => depth.lanes(simd, taps),
            Self::Cone(depth) => depth.lanes(simd, taps),
            Self::Moved(depth) => depth.lanes(simd, taps),
        }
    }

    #[inline(always)]
    fn bounds(&self, rect: TexelRect) -> DepthRange {
        match self {
            Self::Biased(depth) => depth.bounds(rect),
            Self::OnPlane(depth) => depth.bounds(rect),
            Self::Cone(depth) => depth.bounds(rect),
            Self::Moved(depth) => depth.bounds(rect),
        }
    }

    #[inline(always)]
    fn settled(&self, rect: TexelRect, stored: DepthRange) -> Option<bool> {
        match self {
            Self::Biased(depth) => depth.settled(rect, stored),
            Self::OnPlane(depth) => depth.settled(rect, stored),
            Self::Cone(depth) => depth.settled(rect, stored),
            Self::Moved(depth) => depth.settled(rect, stored),
        }
    }
}

impl From<Biased> for AnyDepth {
    fn from(depth: Biased) -> Self {
        Self::Biased(depth)
    }
}

impl From<OnPlane> for AnyDepth {
    fn from(depth: OnPlane) -> Self {
        Self::OnPlane(depth)
    }
}

impl From<BiasCone> for AnyDepth {
    fn from(depth: BiasCone) -> Self {
        Self::Cone(depth)
    }
}

impl From<SlopeScaled> for AnyDepth {
    fn from(depth: SlopeScaled) -> Self {
        Self::Slope(depth)
    }
}

impl From<NormalOffset> for AnyDepth {
    fn from(depth: NormalOffset) -> Self {
        Self::Offset(depth)
    }
}
