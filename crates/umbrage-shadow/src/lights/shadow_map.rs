use super::parts::in_parts;
use super::{Shadow, Unshadowed, by_channel, same_length};
use crate::settled::answer;
use crate::surfaces::Channel;
use crate::{Explanation, Filter, Probe, Query};
use fearless_simd::Simd;
use glam::Vec3;
use umbrage_depth::{DepthMap, Translucent};
use umbrage_plane::{Place, Receiver, SurfacePoint, vectorized};
use umbrage_sample::Key;

/// Points that are transformed to the light's space together: enough that a call costs little, few enough to stay in the cache.
const TOGETHER: usize = 16;

/// A filter over a map; the map owns its view.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ShadowMap<F, M> {
    /// The filter over the map.
    pub filter: F,
    /// The map.
    pub map: M,
}

impl<F: Filter, M: DepthMap> ShadowMap<F, M> {
    /// [`Shadow::fractions`], observed by `probe`.
    ///
    /// # Panics
    /// As [`Shadow::fractions`].
    pub fn fractions_probed<P: Probe>(&self, at: &[SurfacePoint], key: Key, out: &mut [f32], probe: &mut P) {
        self.batch(Channel::All, at, key, out, probe);
    }

    /// The fraction of a receiver that is already in the light's space, under its region's own key.
    ///
    /// # Panics
    /// When the receiver's depth is of another kind than the map's: the two cannot be compared.
    pub fn fraction_of(&self, receiver: &Receiver, key: Key) -> f32 {
        self.fraction_of_probed(receiver, key, &mut ())
    }

    /// [`ShadowMap::fraction_of`], observed by `probe`.
    ///
    /// # Panics
    /// As [`ShadowMap::fraction_of`].
    pub fn fraction_of_probed<P: Probe>(&self, receiver: &Receiver, key: Key, probe: &mut P) -> f32 {
        assert_eq!(receiver.kind, self.map.view().kind(), "kinds of a receiver's depth and of the map's");
        vectorized!(simd => Query::new(simd, &self.map, receiver, key, probe).ask(&self.filter))
    }

    /// The one place where a filter over a map is compiled.
    fn batch<P: Probe>(&self, channel: Channel, at: &[SurfacePoint], key: Key, out: &mut [f32], probe: &mut P) {
        same_length(at, out);
        vectorized!(simd => batch(simd, self, channel, at, key, out, probe));
    }
}

#[inline(always)]
fn batch<S: Simd, F: Filter, M: DepthMap, P: Probe>(
    simd: S,
    shadow: &ShadowMap<F, M>,
    channel: Channel,
    at: &[SurfacePoint],
    key: Key,
    out: &mut [f32],
    probe: &mut P,
) {
    let (filter, map) = (&shadow.filter, &shadow.map);
    let view = map.view();
    let tilted = filter.asks_tilt(map);
    let mut seen = [Err(Place::Behind); TOGETHER];
    for (points, fractions) in at.chunks(TOGETHER).zip(out.chunks_mut(TOGETHER)) {
        let seen = &mut seen[..points.len()];
        view.receivers_for(points, tilted, seen);
        for ((point, seen), fraction) in points.iter().zip(seen).zip(fractions) {
            *fraction = match seen {
                Ok(receiver) => {
                    let key = key.region(point.region);
                    Query::new(simd, map, receiver, key, probe).of_channel(channel).ask(filter)
                }
                Err(place) => {
                    probe.placed(*place);
                    answer(view.rules().verdict(*place)).unwrap_or(0.0)
                }
            };
        }
    }
}

impl<F: Filter, M: DepthMap> Shadow for ShadowMap<F, M> {
    fn fractions(&self, at: &[SurfacePoint], key: Key, out: &mut [f32]) {
        in_parts(at, out, |at, out| self.batch(Channel::All, at, key, out, &mut ()));
    }

    fn transmittances(&self, at: &[SurfacePoint], key: Key, fractions: &[f32], out: &mut [Vec3]) {
        if self.map.translucent().is_none_or(Translucent::is_grey) {
            return Unshadowed.transmittances(at, key, fractions, out);
        }
        same_length(at, fractions);
        by_channel(at, out, |channel, dark| self.batch(channel, at, key, dark, &mut ()));
    }

    fn explain(&self, at: &SurfacePoint, key: Key) -> Vec<Explanation> {
        let view = self.map.view();
        let (mut explanation, mut out) = (Explanation::of(view, view.receiver(at).ok()), [0.0]);
        let at = std::slice::from_ref(at);
        plainly!(simd => batch(simd, self, Channel::All, at, key, &mut out, &mut explanation));
        explanation.fraction = out[0];
        vec![explanation]
    }
}
