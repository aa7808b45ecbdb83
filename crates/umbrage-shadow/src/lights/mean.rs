use super::{Shadow, same_length};
use glam::Vec3;
use umbrage_plane::SurfacePoint;
use umbrage_sample::Key;

/// The mean of several shadows, each of equal weight: over several times of a frame it is motion blur (EXT-2), over several points of a
/// light its penumbra (Haeberli & Akeley 1990).
///
/// All are asked with the same key. Without any, everything is lit.
pub struct Mean<'a>(pub Vec<Box<dyn Shadow + 'a>>);

impl Shadow for Mean<'_> {
    fn fractions(&self, at: &[SurfacePoint], key: Key, out: &mut [f32]) {
        same_length(at, out);
        let mut one = vec![0.0; at.len()];
        out.fill(0.0);
        for shadow in &self.0 {
            shadow.fractions(at, key, &mut one);
            for (sum, fraction) in out.iter_mut().zip(&one) {
                *sum += fraction;
            }
        }
        for sum in out {
            *sum /= self.0.len().max(1) as f32;
        }
    }

    fn transmittances(&self, at: &[SurfacePoint], key: Key, fractions: &[f32], out: &mut [Vec3]) {
        same_length(at, fractions);
        same_length(at, out);
        // One shadow's passes need its own fractions; the mean of them all will not do.
        let (mut dark, mut one) = (vec![0.0; at.len()], vec![Vec3::ONE; at.len()]);
        out.fill(if self.0.is_empty() { Vec3::ONE } else { Vec3::ZERO });
        for shadow in &self.0 {
            shadow.fractions(at, key, &mut dark);
            shadow.transmittances(at, key, &dark, &mut one);
            for (sum, passes) in out.iter_mut().zip(&one) {
                *sum += *passes;
            }
        }
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
