use crate::{Filter, Probe};
use fearless_simd::{Level, Simd, dispatch};
use glam::Vec3;
use umbrage_depth::DepthMap;
use umbrage_plane::{Receiver, SurfacePoint, Verdict};
use umbrage_sample::Key;

/// What shading sees of a shadow algorithm, and the one place where types are erased: a call answers a whole batch of regions.
///
/// `key` names the picture's light; the implementor adds each point's region to it.
pub trait Shadow: Sync {
    /// The fraction in shadow of each region: 0 lit, 1 dark (spec C-6). `out` is as long as `at`.
    fn fractions(&self, at: &[SurfacePoint], key: Key, out: &mut [f32]);

    /// What passes of each region's light, linear RGB in 0..=1, where casters colour it. `fractions` are the answers of
    /// [`Shadow::fractions`] to the same call; without colours, their complements.
    fn transmittances(&self, at: &[SurfacePoint], key: Key, fractions: &[f32], out: &mut [Vec3]) {
        let _ = (at, key);
        for (passes, fraction) in out.iter_mut().zip(fractions) {
            *passes = Vec3::splat(1.0 - fraction);
        }
    }

    /// The fraction of one region.
    fn fraction(&self, at: &SurfacePoint, key: Key) -> f32 {
        let mut out = [0.0];
        self.fractions(std::slice::from_ref(at), key, &mut out);
        out[0]
    }
}

/// A light that casts no shadow.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Unshadowed;

impl Shadow for Unshadowed {
    fn fractions(&self, _at: &[SurfacePoint], _key: Key, out: &mut [f32]) {
        out.fill(0.0);
    }
}

/// A filter over a map; the map owns its view.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ShadowMap<F, M> {
    /// How the map is asked.
    pub filter: F,
    /// What is asked.
    pub map: M,
}

impl<F: Filter, M: DepthMap> ShadowMap<F, M> {
    /// [`Shadow::fractions`] that also tells `probe` what was done (spec X-6).
    pub fn fractions_probed<P: Probe>(&self, at: &[SurfacePoint], key: Key, out: &mut [f32], probe: &mut P) {
        dispatch!(Level::new(), simd => batch(simd, &self.filter, &self.map, at, key, out, probe));
    }

    /// The fraction of a receiver that is already in the light's space, under its region's own key.
    ///
    /// # Panics
    /// When the receiver's depth is of another kind than the map's: the two cannot be compared (spec C-4).
    pub fn fraction_of(&self, receiver: &Receiver, key: Key) -> f32 {
        assert_eq!(receiver.kind, self.map.view().kind(), "kinds of a receiver's depth and of the map's");
        dispatch!(Level::new(), simd => self.filter.shadow(simd, &self.map, receiver, key, &mut ()))
    }
}

#[inline(always)]
fn batch<S: Simd, F: Filter, M: DepthMap, P: Probe>(
    simd: S,
    filter: &F,
    map: &M,
    at: &[SurfacePoint],
    key: Key,
    out: &mut [f32],
    probe: &mut P,
) {
    let view = map.view();
    for (point, fraction) in at.iter().zip(out) {
        *fraction = match view.receiver(point) {
            Ok(receiver) => filter.shadow(simd, map, &receiver, key.region(point.region), probe),
            Err(place) => {
                probe.placed(place);
                if view.rules().verdict(place) == Verdict::Shadowed { 1.0 } else { 0.0 }
            }
        };
    }
}

impl<F: Filter, M: DepthMap> Shadow for ShadowMap<F, M> {
    fn fractions(&self, at: &[SurfacePoint], key: Key, out: &mut [f32]) {
        self.fractions_probed(at, key, out, &mut ());
    }

    fn transmittances(&self, at: &[SurfacePoint], key: Key, fractions: &[f32], out: &mut [Vec3]) {
        let Some(maps) = self.map.colours() else {
            return Unshadowed.transmittances(at, key, fractions, out);
        };
        let mut dark = vec![0.0; at.len()];
        for (channel, map) in maps.iter().enumerate() {
            dispatch!(Level::new(), simd => batch(simd, &self.filter, map, at, key, &mut dark, &mut ()));
            for (passes, dark) in out.iter_mut().zip(&dark) {
                passes[channel] = 1.0 - dark;
            }
        }
    }
}
