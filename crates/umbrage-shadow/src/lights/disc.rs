use super::{Mean, Shadow, same_length};
use crate::query::answer;
use glam::Vec3;
use umbrage_plane::{SurfacePoint, View};
use umbrage_sample::Key;

/// A light with a size: the mean of lights at several points of it ([`View::over_disc`]), which is what its penumbra is. Nothing is assumed
/// of casters, so that overlapping penumbrae, contacts and wide lights are right, up to steps of one over the number of points.
///
/// Where a point lies outside the light as a whole, behind it or beyond its cone, its centre's view says so by its rules.
pub struct DiscLight<'a> {
    /// The view from the light's centre.
    pub centre: View,
    /// The lights at points of it.
    pub mean: Mean<'a>,
}

impl DiscLight<'_> {
    /// The answer for a region whose place alone settles it.
    fn placed(&self, at: &SurfacePoint) -> Option<f32> {
        let place = match self.centre.receiver(at) {
            Ok(receiver) => self.centre.locate(receiver.texel.as_vec2()),
            Err(place) => place,
        };
        answer(self.centre.rules().verdict(place))
    }
}

impl Shadow for DiscLight<'_> {
    fn fractions(&self, at: &[SurfacePoint], key: Key, out: &mut [f32]) {
        self.mean.fractions(at, key, out);
        for (point, fraction) in at.iter().zip(out) {
            *fraction = self.placed(point).unwrap_or(*fraction);
        }
    }

    fn transmittances(&self, at: &[SurfacePoint], key: Key, fractions: &[f32], out: &mut [Vec3]) {
        same_length(at, fractions);
        self.mean.transmittances(at, key, fractions, out);
        for (point, passes) in at.iter().zip(out) {
            *passes = self.placed(point).map_or(*passes, |dark| Vec3::splat(1.0 - dark));
        }
    }
}

impl std::fmt::Debug for DiscLight<'_> {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.debug_struct("DiscLight").field("centre", &self.centre).field("points", &self.mean.0.len()).finish()
    }
}
