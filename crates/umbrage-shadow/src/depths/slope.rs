use super::biased;
use umbrage_plane::{Bias, Receiver, View};

/// The receiver's own depth, moved toward the light by a constant part and by one that grows with its slope: the depth bias of rasterisers (Direct3D 11,
/// *Depth Bias*; Vulkan 1.3, *Depth Bias Computation*), but of the receiver and in linear depth.
///
/// The slope is [`Receiver::steeper_steps`]: the change of the receiver's plane from texel to texel, a row's or a column's, whichever is larger. For a point
/// that
/// is compared with its own texel alone, 1 is free of false shadow at any tilt up to the clamp: within half a texel along both axes a plane
/// changes by no more than that. A filter that looks `half` texels to each side of its point, and reads texels whose centres lie as far from it, takes 2 × `half`.
/// Rounding of stored depths needs a little more, which is what `constant` is for.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub struct SlopeScaled {
    /// The constant part, by which every receiver is moved.
    pub constant: Bias,
    /// Texels: steps of depth from one to the next, from 0.
    pub slope: f32,
    /// Both parts together move no farther than this, world units; +∞ does not limit them (`DepthBiasClamp`).
    pub most: f32,
}

impl Default for SlopeScaled {
    /// One texel, and nothing else.
    fn default() -> Self {
        Self { constant: Bias::ZERO, slope: 1.0, most: f32::INFINITY }
    }
}

umbrage_plane::builders!([] SlopeScaled { with_constant constant: Bias, with_slope slope: f32, with_most most: f32 });

impl SlopeScaled {
    /// How far a receiver is moved toward the light, world units.
    #[inline(always)]
    pub fn world(&self, view: &View, receiver: &Receiver) -> f32 {
        (receiver.in_world(view, self.constant) + receiver.steeper_steps(view, self.slope)).min(self.most)
    }

    /// For one receiver.
    #[inline(always)]
    pub(super) fn ready(&self, view: &View, receiver: &Receiver) -> biased::Ready {
        biased::Ready::at(receiver.nearer(view, Bias::World(self.world(view, receiver))))
    }
}

by_what_is_ready!(SlopeScaled, |depth| depth.constant.asks_tilt());
