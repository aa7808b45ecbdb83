//! Which depth is compared: the third of the three choices.

/// [`ReceiverDepth`] of a type whose function `ready` prepares it for one receiver: the functions that compare are those of what that returns. `$tilt` is
/// [`ReceiverDepth::asks_tilt`] of a value of the type.
macro_rules! by_what_is_ready {
    ($type:ty, $tilt:expr) => {
        impl $crate::ReceiverDepth for $type {
            #[inline(always)]
            fn lanes<S: fearless_simd::Simd>(
                &self,
                simd: S,
                view: &umbrage_plane::View,
                receiver: &umbrage_plane::Receiver,
                taps: &umbrage_sample::Taps<S>,
            ) -> fearless_simd::f32x16<S> {
                $crate::Compared::lanes(&self.ready(view, receiver), simd, taps)
            }

            #[inline(always)]
            fn bounds(
                &self,
                view: &umbrage_plane::View,
                receiver: &umbrage_plane::Receiver,
                rect: umbrage_plane::TexelRect,
            ) -> umbrage_plane::DepthRange {
                $crate::Compared::bounds(&self.ready(view, receiver), rect)
            }

            #[inline(always)]
            fn prepared<'a>(
                &'a self,
                view: &'a umbrage_plane::View,
                receiver: &'a umbrage_plane::Receiver,
            ) -> impl $crate::Compared + 'a {
                self.ready(view, receiver)
            }

            #[inline(always)]
            fn asks_tilt(&self) -> bool {
                let tilt: fn(&Self) -> bool = $tilt;
                tilt(self)
            }
        }
    };
}

mod any;
mod biased;
mod cone;
mod offset;
mod plane;
mod slope;

pub use any::AnyDepth;
pub use biased::{Biased, Spread};
pub use cone::{BiasCone, Radius};
pub use offset::{Moved, NormalOffset, OffsetGrowth};
pub use plane::OnPlane;
pub use slope::SlopeScaled;

use fearless_simd::{Simd, f32x16};
use umbrage_plane::{DepthRange, Footprint, Receiver, TexelRect, View};
use umbrage_sample::Taps;

/// Which depth the receiver is given at a tap; a texel nearer than that shadows it.
pub trait ReceiverDepth: Send + Sync {
    /// The depth to compare at each of the taps, in the map's kind, bias included.
    fn lanes<S: Simd>(&self, simd: S, view: &View, receiver: &Receiver, taps: &Taps<S>) -> f32x16<S>;

    /// Encloses every value that [`ReceiverDepth::lanes`] can return for taps inside `rect`, rounding included.
    fn bounds(&self, view: &View, receiver: &Receiver, rect: TexelRect) -> DepthRange;

    /// The same for one receiver: what all of its taps and its bounds have in common is made once. A depth that has nothing to
    /// prepare does not override this; where it is overridden, the bits are those of the other two functions.
    #[inline(always)]
    fn prepared<'a>(&'a self, view: &'a View, receiver: &'a Receiver) -> impl Compared + 'a {
        Unprepared { depth: self, view, receiver }
    }

    /// Whether it uses a receiver's [`facing`](Receiver::facing) or its [`slope`](Receiver::slope), as [`Filter::asks_tilt`](crate::Filter::asks_tilt).
    #[inline(always)]
    fn asks_tilt(&self) -> bool {
        true
    }
}

/// A [`ReceiverDepth`] of one receiver.
pub trait Compared {
    /// The region that is looked up in place of `region`: the region itself, unless the receiver is moved sideways before it is looked up.
    /// Taps and rectangles are those of this region.
    #[inline(always)]
    fn region(&self, region: &Footprint) -> Footprint {
        *region
    }

    /// [`ReceiverDepth::lanes`].
    fn lanes<S: Simd>(&self, simd: S, taps: &Taps<S>) -> f32x16<S>;

    /// [`ReceiverDepth::bounds`].
    fn bounds(&self, rect: TexelRect) -> DepthRange;

    /// Whether all taps inside `rect` are in shadow, where none of `stored`'s depths leaves that open; `None` where the bounds and `stored`
    /// overlap. Overridden where that can be found without both bounds.
    #[inline(always)]
    fn settled(&self, rect: TexelRect, stored: DepthRange) -> Option<bool> {
        by_bounds(self.bounds(rect), stored)
    }
}

/// The result of comparing two ranges.
#[inline(always)]
fn by_bounds(compared: DepthRange, stored: DepthRange) -> Option<bool> {
    if compared.max <= stored.min {
        Some(false)
    } else if compared.min > stored.max {
        Some(true)
    } else {
        None
    }
}

/// A depth for which there is nothing to prepare.
struct Unprepared<'a, D: ?Sized> {
    depth: &'a D,
    view: &'a View,
    receiver: &'a Receiver,
}

impl<D: ReceiverDepth + ?Sized> Compared for Unprepared<'_, D> {
    #[inline(always)]
    fn lanes<S: Simd>(&self, simd: S, taps: &Taps<S>) -> f32x16<S> {
        self.depth.lanes(simd, self.view, self.receiver, taps)
    }

    #[inline(always)]
    fn bounds(&self, rect: TexelRect) -> DepthRange {
        self.depth.bounds(self.view, self.receiver, rect)
    }
}
