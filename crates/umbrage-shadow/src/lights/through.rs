use super::several::{add_fractions, add_passes};
use super::{Shadow, same_length};
use crate::Explanation;
use glam::Vec3;
use umbrage_plane::SurfacePoint;
use umbrage_sample::Key;

/// A light through several sets of casters, one after another: what passes all of them. Opaque casters can then be kept in another kind of map than
/// transparent ones.
///
/// Exact where all are uniform over a region; where two edges meet in one region it takes them to be independent. Without any set, everything is lit.
pub struct Through<'a>(pub Vec<Box<dyn Shadow + 'a>>);

impl Shadow for Through<'_> {
    fn explain(&self, at: &SurfacePoint, key: Key) -> Vec<Explanation> {
        self.0.iter().flat_map(|shadow| shadow.explain(at, key)).collect()
    }

    fn fractions(&self, at: &[SurfacePoint], key: Key, out: &mut [f32]) {
        out.fill(0.0);
        add_fractions(&self.0, at, key, out, |dark, more| *dark += (1.0 - *dark) * more);
    }

    fn transmittances(&self, at: &[SurfacePoint], key: Key, fractions: &[f32], out: &mut [Vec3]) {
        same_length(at, fractions);
        out.fill(Vec3::ONE);
        add_passes(&self.0, at, key, out, |passes, more| *passes *= more);
    }
}

impl std::fmt::Debug for Through<'_> {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.debug_tuple("Through").field(&self.0.len()).finish()
    }
}
