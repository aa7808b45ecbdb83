//! Several shadows of the same points, one after another.

use super::{Shadow, same_length};
use glam::Vec3;
use umbrage_plane::SurfacePoint;
use umbrage_sample::Key;

/// Adds the fraction of each shadow to what is in `out`, by `add`.
pub(super) fn add_fractions(
    shadows: &[Box<dyn Shadow + '_>],
    at: &[SurfacePoint],
    key: Key,
    out: &mut [f32],
    add: impl Fn(&mut f32, f32),
) {
    same_length(at, out);
    let mut one = vec![0.0; at.len()];
    for shadow in shadows {
        shadow.fractions(at, key, &mut one);
        for (all, fraction) in out.iter_mut().zip(&one) {
            add(all, *fraction);
        }
    }
}

/// Adds what passes each shadow to what is in `out`, by `add`. The light that passes a shadow is computed from its own fractions, not from those of all
/// together.
pub(super) fn add_passes(
    shadows: &[Box<dyn Shadow + '_>],
    at: &[SurfacePoint],
    key: Key,
    out: &mut [Vec3],
    add: impl Fn(&mut Vec3, Vec3),
) {
    same_length(at, out);
    let (mut dark, mut one) = (vec![0.0; at.len()], vec![Vec3::ONE; at.len()]);
    for shadow in shadows {
        shadow.fractions(at, key, &mut dark);
        shadow.transmittances(at, key, &dark, &mut one);
        for (all, passes) in out.iter_mut().zip(&one) {
            add(all, *passes);
        }
    }
}
