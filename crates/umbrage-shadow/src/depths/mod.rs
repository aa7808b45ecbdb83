//! Which depth is compared: the third of the three choices.

mod any;
mod biased;
mod cone;
mod plane;

pub use any::AnyDepth;
pub use biased::{Biased, Spread};
pub use cone::{BiasCone, Radius};
pub use plane::OnPlane;

use fearless_simd::{Simd, f32x16};
use umbrage_plane::{DepthRange, Receiver, TexelRect, View};
use umbrage_sample::Taps;

/// Which depth the receiver is given at a tap; a texel nearer than that shadows it.
pub trait ReceiverDepth: Send + Sync {
    /// The depth to compare at each of the taps, in the map's kind, bias included.
    fn lanes<S: Simd>(&self, simd: S, view: &View, receiver: &Receiver, taps: &Taps<S>) -> f32x16<S>;

    /// Encloses every value that [`ReceiverDepth::lanes`] can return for taps inside `rect`, rounding included.
    fn bounds(&self, view: &View, receiver: &Receiver, rect: TexelRect) -> DepthRange;
}
