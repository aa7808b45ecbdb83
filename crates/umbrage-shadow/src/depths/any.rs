use crate::{BiasCone, Biased, OnPlane, ReceiverDepth};
use fearless_simd::{Simd, f32x16};
use umbrage_plane::{DepthRange, Receiver, TexelRect, View};
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
}

impl ReceiverDepth for AnyDepth {
    #[inline(always)]
    fn lanes<S: Simd>(&self, simd: S, view: &View, receiver: &Receiver, taps: &Taps<S>) -> f32x16<S> {
        match self {
            Self::Biased(depth) => depth.lanes(simd, view, receiver, taps),
            Self::OnPlane(depth) => depth.lanes(simd, view, receiver, taps),
            Self::Cone(depth) => depth.lanes(simd, view, receiver, taps),
        }
    }

    #[inline(always)]
    fn bounds(&self, view: &View, receiver: &Receiver, rect: TexelRect) -> DepthRange {
        match self {
            Self::Biased(depth) => depth.bounds(view, receiver, rect),
            Self::OnPlane(depth) => depth.bounds(view, receiver, rect),
            Self::Cone(depth) => depth.bounds(view, receiver, rect),
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
