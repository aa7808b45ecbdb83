//! What shading sees: lights of one map, of several around them, and of one over all directions.

/// [`vectorized!`](umbrage_plane::vectorized) with only the instructions that every machine has: for look-ups so rare that a second
/// compiled body of each filter would be a waste. The results are the same bits.
macro_rules! plainly {
    ($simd:pat => $body:expr) => {{
        #[cfg(any(target_arch = "x86", target_arch = "x86_64"))]
        let answer = umbrage_plane::vectorized!(@baseline $simd => $body);
        #[cfg(not(any(target_arch = "x86", target_arch = "x86_64")))]
        let answer = umbrage_plane::vectorized!($simd => $body);
        answer
    }};
}

mod around;
mod bounded;
mod lat_long;
mod mean;
mod parts;
mod several;
mod shadow_map;
mod tags;
mod through;

pub use around::{Around, AroundError, Evaluate};
pub use bounded::Bounded;
pub use lat_long::{LatLong, LatLongError};
pub use mean::Mean;
pub use shadow_map::ShadowMap;
pub use tags::Tags;
pub use through::Through;

use crate::Explanation;
use crate::surfaces::Channel;
use glam::Vec3;
use std::sync::Arc;
use umbrage_plane::SurfacePoint;
use umbrage_sample::Key;

/// What shading sees of a shadow algorithm, and the one place where types are erased: a call handles a whole batch of regions.
/// With the feature `rayon`, shadows over maps split batches of thousands of points over the threads of the current pool; the results are
/// the same bits.
///
/// `key` identifies the picture's light; the implementor adds each point's region to it, and refuses slices of different lengths by
/// [`same_length`].
pub trait Shadow: Send + Sync {
    /// The fraction in shadow of each region: 0 lit, 1 dark.
    ///
    /// # Panics
    /// When `out` is not as long as `at`.
    fn fractions(&self, at: &[SurfacePoint], key: Key, out: &mut [f32]);

    /// What passes of each region's light, linear RGB in 0..=1, where casters colour it. `fractions` are the results of
    /// [`Shadow::fractions`] for the same call; without colours, their complements.
    ///
    /// # Panics
    /// When `fractions` or `out` is not as long as `at`.
    fn transmittances(&self, at: &[SurfacePoint], key: Key, fractions: &[f32], out: &mut [Vec3]) {
        let _ = key;
        same_length(at, fractions);
        same_length(at, out);
        for (passes, fraction) in out.iter_mut().zip(fractions) {
            *passes = Vec3::splat(1.0 - fraction);
        }
    }

    /// What is done for one region, by each map that takes part: in the order of the maps where a light has several, of which some may
    /// count only in part. Nothing for shadows that have no map.
    fn explain(&self, at: &SurfacePoint, key: Key) -> Vec<Explanation> {
        let _ = (at, key);
        Vec::new()
    }

    /// The fraction of one region.
    fn fraction(&self, at: &SurfacePoint, key: Key) -> f32 {
        let mut out = [0.0];
        self.fractions(std::slice::from_ref(at), key, &mut out);
        out[0]
    }
}

/// [`Shadow`] of something that wraps another one.
macro_rules! forward {
    ($type:ty) => {
        impl<T: Shadow + ?Sized> Shadow for $type {
            fn fractions(&self, at: &[SurfacePoint], key: Key, out: &mut [f32]) {
                (**self).fractions(at, key, out);
            }

            fn transmittances(&self, at: &[SurfacePoint], key: Key, fractions: &[f32], out: &mut [Vec3]) {
                (**self).transmittances(at, key, fractions, out);
            }

            fn explain(&self, at: &SurfacePoint, key: Key) -> Vec<Explanation> {
                (**self).explain(at, key)
            }

            fn fraction(&self, at: &SurfacePoint, key: Key) -> f32 {
                (**self).fraction(at, key)
            }
        }
    };
}

forward!(&T);
forward!(Box<T>);
forward!(Arc<T>);

/// A light that casts no shadow.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Unshadowed;

impl Shadow for Unshadowed {
    fn fractions(&self, at: &[SurfacePoint], _key: Key, out: &mut [f32]) {
        same_length(at, out);
        out.fill(0.0);
    }
}

/// What passes of red, green and blue light, by the fraction in shadow that `ask` returns for each.
fn by_channel(at: &[SurfacePoint], out: &mut [Vec3], mut ask: impl FnMut(Channel, &mut [f32])) {
    same_length(at, out);
    let mut dark = vec![0.0; at.len()];
    for channel in 0..3 {
        ask(Channel::One(channel), &mut dark);
        for (passes, dark) in out.iter_mut().zip(&dark) {
            passes[channel] = 1.0 - dark;
        }
    }
}

/// Refuses a batch that does not have one result for each point, as [`Shadow`] promises: the first line of any implementor's functions.
///
/// # Panics
/// When `answers` is not as long as `at`. The message states both lengths.
#[track_caller]
pub fn same_length<T>(at: &[SurfacePoint], answers: &[T]) {
    let (points, answers) = (at.len(), answers.len());
    assert!(answers == points, "{points} surface points need {points} answers, but the slice given holds {answers}");
}
