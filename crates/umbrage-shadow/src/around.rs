use crate::{Filter, Shadow, Unshadowed, channel::Channel};
use fearless_simd::{Level, Simd, dispatch};
use glam::{DVec2, DVec3, IVec2, Vec3};
use umbrage_depth::DepthMap;
use umbrage_plane::{DepthRange, Kind, SurfacePoint, TexelRect, Verdict, View, Where};
use umbrage_sample::Key;

/// Which of the views around a light a point is tested in (Williams 1978; W78-10).
#[derive(Clone, Copy, Debug, PartialEq, Eq, Default)]
pub enum Evaluate {
    /// In its own: the one whose axis is nearest to the point's direction. Samples that fall outside are answered by the
    /// neighbour, so that filters cross seams (R87-17).
    #[default]
    Own,
    /// In every one that it falls into, as if each were a light of its own; the darkest answer counts. Samples outside a view are
    /// answered by its rules.
    Every,
}

/// Why views do not stand around one light.
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

/// A light that shines in all directions, or in several: maps of one kind around one point (Reeves 1987, Williams 1978; R87-17,
/// W78-10). A cube's six faces cover everything, sectors a belt; what no view sees is lit.
#[derive(Clone, Debug, PartialEq)]
pub struct Around<F, M> {
    /// How the maps are asked.
    pub filter: F,
    /// Which map is asked.
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

    /// Bytes held for the depths of all views (W78-10, X-6).
    pub fn bytes(&self) -> usize {
        self.maps.iter().map(DepthMap::bytes).sum()
    }

    #[inline(always)]
    fn batch<S: Simd, N: DepthMap>(&self, simd: S, maps: &[N], at: &[SurfacePoint], key: Key, out: &mut [f32]) {
        let eye = maps[0].view().light().truncate();
        for (point, fraction) in at.iter().zip(out) {
            let key = key.region(point.region);
            *fraction = match self.evaluate {
                Evaluate::Own => {
                    let own = nearest(maps, point.position - eye);
                    self.ask(simd, &Face { maps, own }, point, key)
                }
                Evaluate::Every => maps.iter().map(|map| self.within(simd, map, point, key)).fold(0.0, f32::max),
            };
        }
    }

    #[inline(always)]
    fn ask<S: Simd, N: DepthMap>(&self, simd: S, map: &N, point: &SurfacePoint, key: Key) -> f32 {
        match map.view().receiver(point) {
            Ok(receiver) => self.filter.shadow(simd, map, &receiver, key, &mut ()),
            Err(place) => f32::from(u8::from(map.view().rules().verdict(place) == Verdict::Shadowed)),
        }
    }

    /// The answer of one view, 0 for a point that it does not see.
    #[inline(always)]
    fn within<S: Simd, N: DepthMap>(&self, simd: S, map: &N, point: &SurfacePoint, key: Key) -> f32 {
        match map.view().receiver(point) {
            Ok(receiver) if map.view().locate(receiver.footprint.centre) == Where::Inside => {
                self.filter.shadow(simd, map, &receiver, key, &mut ())
            }
            _ => 0.0,
        }
    }
}

impl<F: Filter, M: DepthMap> Shadow for Around<F, M> {
    fn fractions(&self, at: &[SurfacePoint], key: Key, out: &mut [f32]) {
        dispatch!(Level::new(), simd => self.batch(simd, &self.maps, at, key, out));
    }

    fn transmittances(&self, at: &[SurfacePoint], key: Key, fractions: &[f32], out: &mut [Vec3]) {
        let colours: Vec<_> = self.maps.iter().map(Channel::of).collect();
        if colours.iter().all(Option::is_none) {
            return Unshadowed.transmittances(at, key, fractions, out);
        }
        let mut channels = [Vec::new(), Vec::new(), Vec::new()];
        for (map, colours) in self.maps.iter().zip(colours) {
            let colours = colours.unwrap_or_else(|| [0; 3].map(|_| Channel::Alike(map)));
            channels.iter_mut().zip(colours).for_each(|(channel, map)| channel.push(map));
        }
        let mut dark = vec![0.0; at.len()];
        for (channel, maps) in channels.iter().enumerate() {
            dispatch!(Level::new(), simd => self.batch(simd, maps, at, key, &mut dark));
            for (passes, dark) in out.iter_mut().zip(&dark) {
                passes[channel] = 1.0 - dark;
            }
        }
    }
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

/// One of several maps around a light, whose texels outside are answered by its neighbours: every filter crosses the seams
/// unchanged (R87-17, T-16).
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
        // On the border between two views rounding may name the texel past the last; farther out nothing is seen.
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
    fn is_deep(&self) -> bool {
        self.maps[self.own].is_deep()
    }

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

    #[inline(always)]
    fn passes(&self, texel: IVec2, depth: f32) -> f32 {
        if self.inside(texel) {
            self.maps[self.own].passes(texel, depth)
        } else {
            self.beyond(texel).map_or(1.0, |(map, texel, scale)| map.passes(texel, depth / scale))
        }
    }

    #[inline(always)]
    fn range(&self, rect: TexelRect) -> DepthRange {
        let inside = TexelRect::of_size(self.view().size()).encloses(rect);
        if inside { self.maps[self.own].range(rect) } else { DepthRange::UNKNOWN }
    }

    fn bytes(&self) -> usize {
        self.maps[self.own].bytes()
    }
}
