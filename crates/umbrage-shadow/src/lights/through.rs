use super::{Shadow, same_length};
use glam::Vec3;
use umbrage_plane::SurfacePoint;
use umbrage_sample::Key;

/// A light through several sets of casters, one after another: what passes all of them. Opaque casters may then be kept in another kind of map than
/// transparent ones.
///
/// Exact where all are uniform over a region; where two edges meet in one region it takes them to be independent. Without any, everything is lit.
pub struct Through<'a>(pub Vec<Box<dyn Shadow + 'a>>);

impl Shadow for Through<'_> {
    fn fractions(&self, at: &[SurfacePoint], key: Key, out: &mut [f32]) {
        same_length(at, out);
        let mut one = vec![0.0; at.len()];
        out.fill(0.0);
        for shadow in &self.0 {
            shadow.fractions(at, key, &mut one);
            for (dark, more) in out.iter_mut().zip(&one) {
                *dark += (1.0 - *dark) * more;
            }
        }
    }

    fn transmittances(&self, at: &[SurfacePoint], key: Key, fractions: &[f32], out: &mut [Vec3]) {
        same_length(at, fractions);
        same_length(at, out);
        let (mut dark, mut one) = (vec![0.0; at.len()], vec![Vec3::ONE; at.len()]);
        out.fill(Vec3::ONE);
        for shadow in &self.0 {
            shadow.fractions(at, key, &mut dark);
            shadow.transmittances(at, key, &dark, &mut one);
            for (passes, more) in out.iter_mut().zip(&one) {
                *passes *= *more;
            }
        }
    }
}

impl std::fmt::Debug for Through<'_> {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.debug_tuple("Through").field(&self.0.len()).finish()
    }
}
