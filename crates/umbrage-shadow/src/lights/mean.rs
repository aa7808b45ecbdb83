use super::several::{add_fractions, add_passes};
use super::{Shadow, same_length};
use crate::Explanation;
use glam::Vec3;
use umbrage_plane::SurfacePoint;
use umbrage_sample::Key;

/// The mean of several shadows, each of equal weight: over several moments of a frame it is motion blur, over several points of a
/// light its penumbra (Haeberli & Akeley 1990).
///
/// All are given the same key. Without any shadow, everything is lit.
pub struct Mean<'a>(pub Vec<Box<dyn Shadow + 'a>>);

impl Shadow for Mean<'_> {
    fn explain(&self, at: &SurfacePoint, key: Key) -> Vec<Explanation> {
        self.0.iter().flat_map(|shadow| shadow.explain(at, key)).collect()
    }

    fn fractions(&self, at: &[SurfacePoint], key: Key, out: &mut [f32]) {
        out.fill(0.0);
        add_fractions(&self.0, at, key, out, |sum, fraction| *sum += fraction);
        for sum in out {
            *sum /= self.0.len().max(1) as f32;
        }
    }

    fn transmittances(&self, at: &[SurfacePoint], key: Key, fractions: &[f32], out: &mut [Vec3]) {
        same_length(at, fractions);
        out.fill(if self.0.is_empty() { Vec3::ONE } else { Vec3::ZERO });
        add_passes(&self.0, at, key, out, |sum, passes| *sum += passes);
        for sum in out {
            *sum /= self.0.len().max(1) as f32;
        }
    }
}

impl std::fmt::Debug for Mean<'_> {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.debug_tuple("Mean").field(&self.0.len()).finish()
    }
}
