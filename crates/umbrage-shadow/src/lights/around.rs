use super::parts::in_parts;
use super::{Shadow, Unshadowed, by_channel, same_length};
use crate::settled::answer;
use crate::surfaces::Channel;
use crate::{Explanation, Filter, Probe, Query};
use fearless_simd::Simd;
use glam::{DVec2, DVec3, IVec2, Vec3};
use std::borrow::Cow;
use umbrage_depth::{DepthMap, FacetSample, FacetSource, Facets, MomentSource, Step, Translucent};
use umbrage_plane::{DepthRange, Kind, Place, SurfacePoint, TexelRect, View, vectorized};
use umbrage_sample::Key;

/// Which of the views around a light a point is tested in (Williams 1978).
#[derive(Clone, Copy, Debug, PartialEq, Eq, Default)]
pub enum Evaluate {
    /// In its own: the one whose axis is nearest to the point's direction. Samples that fall outside are looked up in
    /// the neighbour, so that filters cross seams (Reeves 1987).
    #[default]
    Own,
    /// In every one that it falls into, as if each were a light of its own; the darkest result counts. Samples outside a view are
    /// settled by its rules.
    Every,
}

/// Why views do not surround one light.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum AroundError {
    /// No map at all.
    #[error("a light in all directions needs at least one map")]
    Empty,
    /// A view that is not in perspective, stands elsewhere than the first, or stores another kind of depth.
    #[error("map {index} of a light in all directions {problem}")]
    View {
        /// Which map, from 0.
        index: usize,
        /// What is wrong with its view.
        problem: &'static str,
    },
}

/// A light that shines in all directions, or in several: maps of one kind around one point (Reeves 1987,
/// Williams 1978). A cube's six faces cover everything, sectors a belt; what no view sees is lit.
#[derive(Clone, Debug, PartialEq)]
pub struct Around<F, M> {
    /// The filter over the maps.
    pub filter: F,
    /// Which map is looked up.
    pub evaluate: Evaluate,
    maps: Vec<M>,
}

impl<F: Filter, M: DepthMap> Around<F, M> {
    /// Over maps whose views stand at one place and store distance, axial ([`Kind::Axial`]) or Euclidean ([`Kind::Radial`]).
    ///
    /// # Errors
    /// [`AroundError`].
    pub fn new(filter: F, maps: Vec<M>) -> Result<Self, AroundError> {
        let first = *maps.first().ok_or(AroundError::Empty)?.view();
        for (index, map) in maps.iter().enumerate() {
            let view = map.view();
            let near = |a: DVec3, b: DVec3| a.abs_diff_eq(b, 1e-9 * (1.0 + b.length()));
            let problem = if !view.is_perspective() {
                "is not in perspective"
            } else if !near(view.light().truncate(), first.light().truncate()) {
                "stands elsewhere than the first"
            } else if view.kind() != first.kind() || view.kind() == Kind::Screen {
                "must store axial or Euclidean distance, as the first does"
            } else {
                continue;
            };
            return Err(AroundError::View { index, problem });
        }
        Ok(Self { filter, evaluate: Evaluate::default(), maps })
    }

    /// The maps, in their order.
    pub fn maps(&self) -> &[M] {
        &self.maps
    }

    /// Bytes held for the depths of all views (Williams 1978).
    pub fn bytes(&self) -> usize {
        self.maps.iter().map(DepthMap::bytes).sum()
    }

    /// [`Shadow::fractions`], observed by `probe`.
    ///
    /// # Panics
    /// As [`Shadow::fractions`].
    pub fn fractions_probed<P: Probe>(&self, at: &[SurfacePoint], key: Key, out: &mut [f32], probe: &mut P) {
        self.batch(Channel::All, at, key, out, probe);
    }

    fn batch<P: Probe>(&self, channel: Channel, at: &[SurfacePoint], key: Key, out: &mut [f32], probe: &mut P) {
        same_length(at, out);
        vectorized!(simd => self.batch_with(simd, channel, at, key, out, probe));
    }

    #[inline(always)]
    fn batch_with<S: Simd, P: Probe>(
        &self,
        simd: S,
        channel: Channel,
        at: &[SurfacePoint],
        key: Key,
        out: &mut [f32],
        probe: &mut P,
    ) {
        let eye = self.maps[0].view().light().truncate();
        for (point, fraction) in at.iter().zip(out) {
            let key = key.region(point.region);
            *fraction = match self.evaluate {
                Evaluate::Own => {
                    let own = nearest(&self.maps, point.position - eye);
                    self.ask(simd, &Face { maps: &self.maps, own }, channel, point, key, probe)
                }
                Evaluate::Every => {
                    let within = |map: &M| self.within(simd, map, channel, point, key, probe);
                    self.maps.iter().map(within).fold(0.0, f32::max)
                }
            };
        }
    }

    #[inline(always)]
    fn ask<S: Simd, N: DepthMap, P: Probe>(
        &self,
        simd: S,
        map: &N,
        channel: Channel,
        point: &SurfacePoint,
        key: Key,
        probe: &mut P,
    ) -> f32 {
        match map.view().receiver(point) {
            Ok(receiver) => Query::new(simd, map, &receiver, key, probe).of_channel(channel).ask(&self.filter),
            Err(place) => {
                probe.placed(place);
                answer(map.view().rules().verdict(place)).unwrap_or(0.0)
            }
        }
    }

    /// The result of one view, 0 for a point that it does not see.
    #[inline(always)]
    fn within<S: Simd, P: Probe>(
        &self,
        simd: S,
        map: &M,
        channel: Channel,
        point: &SurfacePoint,
        key: Key,
        probe: &mut P,
    ) -> f32 {
        match map.view().receiver(point) {
            Ok(receiver) if map.view().locate(receiver.texel.as_vec2()) == Place::Inside => {
                Query::new(simd, map, &receiver, key, probe).of_channel(channel).ask(&self.filter)
            }
            _ => 0.0,
        }
    }
}

impl<F: Filter, M: DepthMap> Shadow for Around<F, M> {
    fn fractions(&self, at: &[SurfacePoint], key: Key, out: &mut [f32]) {
        in_parts(at, out, |at, out| self.batch(Channel::All, at, key, out, &mut ()));
    }

    fn transmittances(&self, at: &[SurfacePoint], key: Key, fractions: &[f32], out: &mut [Vec3]) {
        if grey(&self.maps) {
            return Unshadowed.transmittances(at, key, fractions, out);
        }
        same_length(at, fractions);
        by_channel(at, out, |channel, dark| self.batch(channel, at, key, dark, &mut ()));
    }

    /// By the map whose axis is nearest to the point's direction.
    fn explain(&self, at: &SurfacePoint, key: Key) -> Vec<Explanation> {
        let own = nearest(&self.maps, at.position - self.maps[0].view().light().truncate());
        let view = self.maps[own].view();
        let (mut explanation, mut out) = (Explanation::of(view, view.receiver(at).ok()), [0.0]);
        let at = std::slice::from_ref(at);
        plainly!(simd => self.batch_with(simd, Channel::All, at, key, &mut out, &mut explanation));
        explanation.fraction = out[0];
        vec![explanation]
    }
}

/// Whether all maps let red, green and blue light pass alike.
fn grey<M: DepthMap>(maps: &[M]) -> bool {
    maps.iter().all(|map| map.translucent().is_none_or(Translucent::is_grey))
}

/// The map whose axis is nearest to a direction; the first of several.
#[inline(always)]
pub(crate) fn nearest<M: DepthMap>(maps: &[M], direction: DVec3) -> usize {
    let (mut own, mut most) = (0, f64::NEG_INFINITY);
    for (index, map) in maps.iter().enumerate() {
        let along = map.view().ahead().dot(direction);
        if along > most {
            (own, most) = (index, along);
        }
    }
    own
}

/// One of several maps around a light, whose texels outside are taken from its neighbours: every filter crosses the seams
/// unchanged (Reeves 1987).
struct Face<'a, M> {
    maps: &'a [M],
    own: usize,
}

impl<M: DepthMap> Face<'_, M> {
    /// The neighbour and its texel in the direction of a texel outside, and by what its depths are multiplied to be this view's.
    fn beyond(&self, texel: IVec2) -> Option<(&M, IVec2, f32)> {
        let view: &View = self.view();
        let eye = view.light().truncate();
        let direction = view.world_at(view.sampling().position(texel), view.key(1.0)) - eye;
        let other = nearest(self.maps, direction);
        if other == self.own {
            return None;
        }
        let map = &self.maps[other];
        let there = map.view();
        let seen = there.world_to_eye().transform_vector3(direction);
        let scale = match view.kind() {
            Kind::Axial => (view.ahead().dot(direction) / there.ahead().dot(direction)) as f32,
            Kind::Radial | Kind::Screen => 1.0,
        };
        // On the border between two views rounding may give the texel past the last; farther out nothing is seen.
        let (at, size) = (there.eye_to_texel(seen), there.size());
        let texel = at.floor().as_ivec2();
        let border = at.clamp(DVec2::ZERO, size.as_dvec2()).abs_diff_eq(at, 1e-6);
        let texel = if border { texel.clamp(IVec2::ZERO, size.as_ivec2() - 1) } else { texel };
        Some((map, texel, scale))
    }

    fn inside(&self, texel: IVec2) -> bool {
        TexelRect::of_size(self.view().size()).contains(texel)
    }
}

impl<M: DepthMap> DepthMap for Face<'_, M> {
    #[inline(always)]
    fn view(&self) -> &View {
        self.maps[self.own].view()
    }

    #[inline(always)]
    fn depth(&self, texel: IVec2) -> f32 {
        if self.inside(texel) {
            self.maps[self.own].depth(texel)
        } else {
            self.beyond(texel).map_or(f32::INFINITY, |(map, texel, scale)| map.depth(texel) * scale)
        }
    }

    /// As in the own view's map: beyond a plain map only nearest surfaces are compared.
    #[inline(always)]
    fn translucent(&self) -> Option<&dyn Translucent> {
        self.maps[self.own].translucent().map(|_| self as &dyn Translucent)
    }

    /// Where the own view's map has some.
    fn facets(&self) -> Option<Facets<'_>> {
        self.maps[self.own].facets().map(|_| Facets::Several(self))
    }

    /// Those of the own view's map, which end at its edge.
    fn moments(&self) -> Option<&dyn MomentSource> {
        self.maps[self.own].moments()
    }

    #[inline(always)]
    fn range(&self, rect: TexelRect) -> DepthRange {
        let inside = TexelRect::of_size(self.view().size()).encloses(rect);
        if inside { self.maps[self.own].range(rect) } else { DepthRange::UNKNOWN }
    }

    fn bytes(&self) -> usize {
        self.maps[self.own].bytes()
    }

    fn allocated(&self) -> usize {
        self.maps[self.own].allocated()
    }
}

/// What a map of facets holds at a place of its finer grid.
fn facet_sample(map: &impl DepthMap, at: IVec2) -> Option<FacetSample> {
    match map.facets()? {
        Facets::Map(map) => Some(map.sample(at)),
        Facets::Several(maps) => Some(maps.sample(at)),
    }
}

impl<M: DepthMap> FacetSource for Face<'_, M> {
    fn fine(&self) -> u32 {
        match self.maps[self.own].facets() {
            Some(Facets::Map(map)) => map.fine(),
            Some(Facets::Several(maps)) => maps.fine(),
            None => 1,
        }
    }

    /// Beyond the own view's map, the neighbour's sample in that direction: its facet's plane as this view sees it.
    fn sample(&self, at: IVec2) -> FacetSample {
        let (view, fine) = (self.view(), f64::from(self.fine()));
        let place = (at.as_dvec2() + 0.5) / fine;
        let nothing = FacetSample::nothing(place);
        if self.inside(place.floor().as_ivec2()) {
            return facet_sample(&self.maps[self.own], at).unwrap_or(nothing);
        }
        let direction = view.world_at(place, view.key(1.0)) - view.light().truncate();
        let other = &self.maps[nearest(self.maps, direction)];
        let there = other.view();
        let seen = there.eye_to_texel(there.world_to_eye().transform_vector3(direction));
        let Some(sample) = facet_sample(other, (seen * fine).floor().as_ivec2()) else { return nothing };
        if sample.plane.c == f64::INFINITY {
            return nothing;
        }
        let taken = there.world_at(sample.at, there.key(1.0));
        let taken = view.world_to_eye().transform_point3(taken);
        let Some(plane) = view.affine_of(there, &sample.plane).filter(|_| taken.z < 0.0) else { return nothing };
        FacetSample { plane, at: view.eye_to_texel(taken), ..sample }
    }

    fn link(&self, at: IVec2, down: bool) -> Option<f64> {
        match self.maps[self.own].facets()? {
            Facets::Map(map) => map.link(at, down),
            Facets::Several(maps) => maps.link(at, down),
        }
    }
}

impl<M: DepthMap> Translucent for Face<'_, M> {
    fn steps(&self, texel: IVec2) -> Cow<'_, [Step]> {
        if self.inside(texel) {
            return steps(&self.maps[self.own], texel);
        }
        let Some((map, texel, scale)) = self.beyond(texel) else { return Cow::Borrowed(&[]) };
        steps(map, texel).iter().map(|step| Step { depth: step.depth * scale, ..*step }).collect()
    }

    fn is_grey(&self) -> bool {
        grey(self.maps)
    }

    fn transmittance(&self, texel: IVec2, depth: f32) -> Vec3 {
        let (map, texel, depth) = if self.inside(texel) {
            (&self.maps[self.own], texel, depth)
        } else {
            let Some((map, texel, scale)) = self.beyond(texel) else { return Vec3::ONE };
            (map, texel, depth / scale)
        };
        match map.translucent() {
            Some(deep) => deep.transmittance(texel, depth),
            None => Vec3::splat(f32::from(u8::from(depth <= map.depth(texel)))),
        }
    }
}

/// The surfaces of a texel; the one of a plain map lets nothing pass.
fn steps<M: DepthMap>(map: &M, texel: IVec2) -> Cow<'_, [Step]> {
    if let Some(deep) = map.translucent() {
        return deep.steps(texel);
    }
    let depth = map.depth(texel);
    let seen = (depth < f32::INFINITY).then_some(Step { depth, passes: Vec3::ZERO });
    Cow::Owned(seen.into_iter().collect())
}
