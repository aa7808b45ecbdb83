use crate::area::{Area, LONG, reads_well};
use crate::explained::{look, report};
use crate::settled::{Passing, answer, by_rule, by_rules, ruled};
use crate::surfaces::{Channel, Met, Seen, Surfaces};
use crate::{Compared, Probe, ReceiverDepth};
use fearless_simd::{Simd, f32x16, prelude::*};
use glam::{IVec2, Vec2};
use std::fmt;
use std::sync::Arc;
use umbrage_depth::DepthMap;
use umbrage_plane::{DepthRange, Footprint, Receiver, TexelRect, View};
use umbrage_sample::{Centre, Key, Pattern, Taps};

/// Combines what a map stores around a receiver into a fraction in shadow.
///
/// A filter of your own is a struct with its parameters and this one function, which uses the [`Query`]: for a region, for the fraction in shadow of a
/// pattern's taps, or for each tap. Here are percentage-closer soft shadows (Fernando 2005):
///
/// ```
#[doc = include_str!("../examples/filter/pcss.rs")]
/// ```
///
/// Mark the function `#[inline(always)]`, so that it is compiled for the machine's own instructions.
pub trait Filter: Send + Sync {
    /// The fraction of the receiver's region that is in shadow, in 0..=1.
    fn shadow<S: Simd, M: DepthMap, P: Probe>(&self, query: &mut Query<'_, S, M, P>) -> f32;

    /// Whether it uses how a receiver is tilted over this map, its [`facing`](Receiver::facing) or its [`slope`](Receiver::slope). One that says it does
    /// not may be given receivers that have NaN for both, in less time.
    #[inline(always)]
    fn asks_tilt<M: DepthMap>(&self, map: &M) -> bool {
        let _ = map;
        true
    }
}

/// [`Filter`] of something that wraps another filter.
macro_rules! forward {
    ($type:ty) => {
        impl<F: Filter> Filter for $type {
            #[inline(always)]
            fn shadow<S: Simd, M: DepthMap, P: Probe>(&self, query: &mut Query<'_, S, M, P>) -> f32 {
                (**self).shadow(query)
            }

            #[inline(always)]
            fn asks_tilt<M: DepthMap>(&self, map: &M) -> bool {
                (**self).asks_tilt(map)
            }
        }
    };
}

forward!(&F);
forward!(Arc<F>);

/// One receiver to look up in one map: everything that a [`Filter`] works with.
///
/// What every filter must get right is here once: the limit on a region's size, the rules for places outside the map and the
/// cone, what deep maps let through, weights, counts and culling. A filter that computes its result by [`share`](Self::share), or
/// that honours what [`each`](Self::each) reports, has all of it.
pub struct Query<'a, S: Simd, M, P> {
    simd: S,
    map: &'a M,
    receiver: &'a Receiver,
    key: Key,
    channel: Channel,
    probe: &'a mut P,
    /// Texels read; `None` before the first look-up.
    looked: Option<u32>,
}

impl<'a, S: Simd, M: DepthMap, P: Probe> Query<'a, S, M, P> {
    /// A query of `map` for `receiver`, whose depth is of the map's kind. `key` is the region's own, and `probe` observes.
    #[inline(always)]
    pub fn new(simd: S, map: &'a M, receiver: &'a Receiver, key: Key, probe: &'a mut P) -> Self {
        Self { simd, map, receiver, key, channel: Channel::All, probe, looked: None }
    }

    /// The same for one colour of light.
    #[inline(always)]
    pub(crate) fn of_channel(self, channel: Channel) -> Self {
        Self { channel, ..self }
    }

    /// The result of a filter; `probe` is given the count of texels.
    #[inline(always)]
    pub fn ask(mut self, filter: &impl Filter) -> f32 {
        let dark = filter.shadow(&mut self);
        if let Some(texels) = self.looked {
            self.probe.looked(texels);
        }
        dark
    }

    /// The map's view.
    #[inline(always)]
    pub fn view(&self) -> &'a View {
        self.map.view()
    }

    /// The receiver.
    #[inline(always)]
    pub fn receiver(&self) -> &'a Receiver {
        self.receiver
    }

    /// Identifies the region; random numbers are drawn by it.
    #[inline(always)]
    pub fn key(&self) -> Key {
        self.key
    }

    /// Observes what the filter does.
    #[inline(always)]
    pub fn probe(&mut self) -> &mut P {
        self.probe
    }

    /// The instructions that the query is compiled for.
    #[inline(always)]
    pub(crate) fn simd(&self) -> S {
        self.simd
    }

    /// The map itself, for what neither a region nor a texel provides.
    #[inline(always)]
    pub(crate) fn map(&self) -> &'a M {
        self.map
    }

    /// The receiver's own footprint, enlarged about the point: its half-extents times `res_factor`, at least `min_size` texels, and at
    /// most a quarter of the map to each side.
    #[inline(always)]
    pub fn region(&self, res_factor: f32, min_size: f32) -> Footprint {
        self.receiver.footprint.scaled(self.receiver.texel.as_vec2(), res_factor, min_size, self.limit())
    }

    /// A box of half-extents `half` (texels) about the point, no narrower than the receiver's footprint and at most a quarter of the map to
    /// each side.
    #[inline(always)]
    pub fn region_around(&self, half: Vec2) -> Footprint {
        let own = self.receiver.footprint;
        let centre = self.receiver.texel.as_vec2();
        Footprint::boxed(centre, half.max(own.half + (own.centre - centre).abs()).min(self.limit()))
    }

    /// A box of half-extents `half` (texels) about the point, whatever the receiver's footprint, at most a quarter of the map to each side.
    #[inline(always)]
    pub(crate) fn boxed(&self, half: Vec2) -> Footprint {
        Footprint::boxed(self.receiver.texel.as_vec2(), half.min(self.limit()))
    }

    /// Greatest half-extents of any region: a quarter of the map.
    #[inline(always)]
    fn limit(&self) -> Vec2 {
        self.view().size().as_vec2() * 0.25
    }

    /// Where the receiver's own point is looked up, and the depth that is compared there.
    #[inline(always)]
    pub(crate) fn at_point(&self, depth: &impl ReceiverDepth) -> (Vec2, f32) {
        let compared = depth.prepared(self.view(), self.receiver);
        let region = compared.region(&Footprint::boxed(self.receiver.texel.as_vec2(), Vec2::ZERO));
        let mut found = (region.centre, f32::NAN);
        let one = |taps: &Taps<S>| found.1 = compared.lanes(self.simd, taps)[0];
        Centre.taps(self.simd, &region, self.key, one);
        found
    }

    /// The result where the place of a texel position alone settles it by the view's rules: 0 lit, 1 in shadow.
    #[inline(always)]
    pub fn placed(&mut self, texel: Vec2) -> Option<f32> {
        let place = self.view().locate(texel);
        let dark = answer(self.view().rules().verdict(place))?;
        self.probe.placed(place);
        Some(dark)
    }

    /// The result for a whole region where depth ranges settle it without a look-up: 0 lit, 1 in shadow. `None` where they do not, and
    /// always `None` over deep maps and for regions that reach out of the map or the cone.
    ///
    /// It never differs from the result of [`share`](Self::share).
    #[inline(always)]
    pub fn settled(&mut self, region: &Footprint, depth: &impl ReceiverDepth) -> Option<f32> {
        let compared = depth.prepared(self.view(), self.receiver);
        let area = Area::of(self.simd, self.view(), &compared.region(region));
        self.settled_in(area, &compared)
    }

    #[inline(always)]
    fn settled_in(&mut self, area: Area, compared: &impl Compared) -> Option<f32> {
        if self.map.translucent().is_some() || !area.inside {
            return None;
        }
        let stored = self.map.range(area.rect);
        if stored == DepthRange::UNKNOWN {
            // Then nothing is settled, whatever is compared.
            return None;
        }
        let dark = compared.settled(area.rect, stored)?;
        self.probe.culled(dark);
        Some(f32::from(u8::from(dark)))
    }

    /// The result of [`settled`](Self::settled), and where that is `None`, the result of [`share`](Self::share), in less time than one after
    /// the other. Without `cull` only the second is used, with the same result.
    #[inline(always)]
    pub fn settled_or_share(
        &mut self,
        region: &Footprint,
        pattern: &impl Pattern,
        depth: &impl ReceiverDepth,
        cull: bool,
    ) -> f32 {
        let compared = depth.prepared(self.view(), self.receiver);
        let region = &compared.region(region);
        let area = Area::of(self.simd, self.view(), region);
        let settled = if cull { self.settled_in(area, &compared) } else { None };
        settled.unwrap_or_else(
            #[inline(always)]
            || self.share_in(area, region, (pattern, &compared), nearer),
        )
    }

    /// The fraction of a region's taps that are in shadow, weights included; 0 where there is no tap.
    ///
    /// Taps outside the map or the cone are settled by the view's rules, texels of deep maps by the light that passes them (Burley 2006).
    #[inline(always)]
    pub fn share(&mut self, region: &Footprint, pattern: &impl Pattern, depth: &impl ReceiverDepth) -> f32 {
        self.share_by(region, pattern, depth, nearer)
    }

    /// [`Query::share`] with another way to compare: `behind` reports, of sixteen compared and stored depths and the mask of those that
    /// count, which are behind what is stored. Deep maps are not compared by it.
    #[inline(always)]
    pub(crate) fn share_by(
        &mut self,
        region: &Footprint,
        pattern: &impl Pattern,
        depth: &impl ReceiverDepth,
        behind: impl FnMut(&mut P, f32x16<S>, f32x16<S>, u32) -> u32,
    ) -> f32 {
        let compared = depth.prepared(self.view(), self.receiver);
        let region = &compared.region(region);
        self.share_in(Area::of(self.simd, self.view(), region), region, (pattern, &compared), behind)
    }

    #[inline(always)]
    fn share_in(
        &mut self,
        Area { rect, inside }: Area,
        region: &Footprint,
        (pattern, compared): (&impl Pattern, &impl Compared),
        mut behind: impl FnMut(&mut P, f32x16<S>, f32x16<S>, u32) -> u32,
    ) -> f32 {
        let (simd, map, view, channel) = (self.simd, self.map, self.view(), self.channel);
        let (deep, weighted) = (map.translucent(), pattern.weighted());
        if region.half.x > LONG
            && inside
            && deep.is_none()
            && !P::EXPLAINS
            && let Some(window) = pattern.window(region)
            && reads_well(window)
        {
            return self.share_of_rows(window, compared, behind);
        }
        let probe = &mut *self.probe;
        if P::EXPLAINS {
            probe.asked();
        }
        let (mut hits, mut count) = (0.0, 0.0);
        let looked = Self::visit(
            (simd, self.key),
            region,
            (pattern, compared),
            #[inline(always)]
            |taps, compared| {
                if let Some(deep) = deep {
                    let from = Passing { deep, channel, view, inside, weighted };
                    // A copy is passed: the taps themselves stay in registers if no other function is given them.
                    from.add(simd, &{ *taps }, &compared.into(), (&mut hits, &mut count));
                    if P::EXPLAINS {
                        let compared: [f32; 16] = compared.into();
                        let dark = std::array::from_fn(|i| from.dark(taps.tap(i).at, compared[i]));
                        let stored = look::<_, _, P>(simd, map, rect, taps).into();
                        report(
                            probe,
                            (|at| ruled(view, inside, at), weighted),
                            &{ *taps },
                            [&compared, &stored, &dark],
                        );
                    }
                    return;
                }
                let stored = look::<_, _, P>(simd, map, rect, taps);
                let mut nearer = behind(probe, compared, stored, taps.mask) & taps.mask;
                if !inside {
                    nearer = by_rules(view, &{ *taps }, nearer);
                }
                if P::EXPLAINS {
                    let dark = std::array::from_fn(|i| (nearer >> i & 1) as f32);
                    report(
                        probe,
                        (|at| ruled(view, inside, at), weighted),
                        &{ *taps },
                        [&compared.into(), &stored.into(), &dark],
                    );
                }
                if weighted {
                    for i in 0..16 {
                        let weight = if taps.mask >> i & 1 == 1 { taps.weight[i] } else { 0.0 };
                        count += weight;
                        hits += if nearer >> i & 1 == 1 { weight } else { 0.0 };
                    }
                } else {
                    count += taps.mask.count_ones() as f32;
                    hits += nearer.count_ones() as f32;
                }
            },
        );
        self.count(looked);
        if count > 0.0 { hits / count } else { 0.0 }
    }

    /// [`Query::share`] of all texels of a window on the map, row by row.
    #[inline(always)]
    fn share_of_rows(
        &mut self,
        window: TexelRect,
        compared: &impl Compared,
        mut behind: impl FnMut(&mut P, f32x16<S>, f32x16<S>, u32) -> u32,
    ) -> f32 {
        let (mut hits, mut first) = (0, 0);
        for y in window.min.y..window.max.y {
            for x in (window.min.x..window.max.x).step_by(16) {
                let (texel, count) = (IVec2::new(x, y), (window.max.x - x).min(16) as u32);
                let taps = Taps::in_row(self.simd, self.key, first, texel, count);
                let stored = self.map.in_row(self.simd, texel, count);
                let compared = compared.lanes(self.simd, &taps);
                hits += (behind(self.probe, compared, stored, taps.mask) & taps.mask).count_ones();
                first += count;
            }
        }
        self.count(first);
        hits as f32 / first as f32
    }

    /// Calls `f` with every tap of a region: what it meets, and the depth that is compared there. This is for transforms other than
    /// "is it nearer?" (Reeves 1987, §6); mean [`Seen::dark`], weighted by [`Tap::weight`](umbrage_sample::Tap::weight), is what [`Query::share`] gives.
    ///
    /// ```
    /// # use umbrage_shadow::{Biased, Filter, Met, Probe, Query, Simd};
    /// # use umbrage_depth::DepthMap;
    /// /// The mean depth of what the map stores nearer than the receiver, or +∞: the first half of a soft shadow.
    /// fn blockers<S: Simd, M: DepthMap, P: Probe>(query: &mut Query<'_, S, M, P>) -> f32 {
    ///     let (mut sum, mut weight) = (0.0, 0.0);
    ///     let region = query.region(1.0, 4.0);
    ///     query.each(&region, &umbrage_sample::EveryTexel, &Biased::default(), |seen| {
    ///         let Met::Surfaces(surfaces) = &seen.met else { return };
    ///         for (depth, stopped) in surfaces.iter().filter(|(depth, _)| *depth < seen.compared) {
    ///             sum += depth * stopped;
    ///             weight += stopped;
    ///         }
    ///     });
    ///     if weight > 0.0 { sum / weight } else { f32::INFINITY }
    /// }
    /// ```
    #[inline(always)]
    pub fn each(
        &mut self,
        region: &Footprint,
        pattern: &impl Pattern,
        depth: &impl ReceiverDepth,
        mut f: impl FnMut(&Seen<'_>),
    ) {
        let (simd, map, view) = (self.simd, self.map, self.view());
        let compared = depth.prepared(view, self.receiver);
        let region = &compared.region(region);
        let Area { rect, inside } = Area::of(simd, view, region);
        if P::EXPLAINS {
            self.probe.asked();
        }
        let mut explained = Vec::new();
        let this = &*self;
        let looked = Self::visit(
            (simd, self.key),
            region,
            (pattern, &compared),
            #[inline(always)]
            |taps, compared| {
                let stored = look::<_, _, P>(simd, map, rect, taps);
                for i in (0..16).filter(|i| taps.mask >> i & 1 == 1) {
                    let tap = taps.tap(i);
                    let ruled = if inside { None } else { by_rule(view, tap.at) };
                    let met = ruled.map_or_else(
                        || Met::Surfaces(this.surfaces(tap.at.floor().as_ivec2(), stored[i])),
                        Met::Settled,
                    );
                    let seen = Seen { tap, compared: compared[i], met };
                    if P::EXPLAINS {
                        explained.push(seen.judged(stored[i]));
                    }
                    f(&seen);
                }
            },
        );
        for tap in &explained {
            self.probe.tapped(tap);
        }
        self.count(looked);
    }

    /// The nearest surfaces under sixteen taps at a time, whether or not light passes them: `f` is given the region where they lie, the taps, the
    /// compared and the stored depths. Rules are left to the caller.
    #[inline(always)]
    pub(crate) fn nearest(
        &mut self,
        region: &Footprint,
        pattern: &impl Pattern,
        depth: &impl ReceiverDepth,
        mut f: impl FnMut(&Footprint, &Taps<S>, f32x16<S>, f32x16<S>),
    ) {
        let (simd, map, view) = (self.simd, self.map, self.view());
        let compared = depth.prepared(view, self.receiver);
        let region = &compared.region(region);
        let Area { rect, .. } = Area::of(simd, view, region);
        let probe = &mut *self.probe;
        if P::EXPLAINS {
            probe.asked();
        }
        let looked = Self::visit(
            (simd, self.key),
            region,
            (pattern, &compared),
            #[inline(always)]
            |taps, compared| {
                let stored = look::<_, _, P>(simd, map, rect, taps);
                if P::EXPLAINS {
                    let nearer = compared.simd_gt(stored).to_bitmask() as u32;
                    let dark = std::array::from_fn(|i| (nearer >> i & 1) as f32);
                    report(probe, (|_| None, false), &{ *taps }, [&compared.into(), &stored.into(), &dark]);
                }
                f(region, taps, compared, stored);
            },
        );
        self.count(looked);
    }

    /// Calls `f` with sixteen taps of a region at a time and the depths that are compared there. Returns the number of taps.
    #[inline(always)]
    fn visit(
        (simd, key): (S, Key),
        region: &Footprint,
        (pattern, compared): (&impl Pattern, &impl Compared),
        mut f: impl FnMut(&Taps<S>, f32x16<S>),
    ) -> u32 {
        let mut looked = 0;
        pattern.taps(
            simd,
            region,
            key,
            #[inline(always)]
            |taps| {
                looked += taps.mask.count_ones();
                f(taps, compared.lanes(simd, taps));
            },
        );
        looked
    }

    /// What one texel stores. Places outside the map hold nothing; [`Query::placed`] determines whether they are lit.
    #[inline(always)]
    pub fn texel(&mut self, texel: IVec2) -> Surfaces<'a> {
        self.count(1);
        self.surfaces(texel, self.map.depth(texel))
    }

    #[inline(always)]
    fn surfaces(&self, texel: IVec2, stored: f32) -> Surfaces<'a> {
        match self.map.translucent() {
            None => Surfaces::opaque(stored),
            Some(deep) => Surfaces::deep(deep, texel, self.channel),
        }
    }

    #[inline(always)]
    pub(crate) fn count(&mut self, texels: u32) {
        self.looked = Some(self.looked.unwrap_or(0) + texels);
    }
}

impl<S: Simd, M, P> fmt::Debug for Query<'_, S, M, P> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("Query").field("receiver", self.receiver).field("key", &self.key).finish_non_exhaustive()
    }
}

/// Which of sixteen compared depths lie behind what is stored.
#[inline(always)]
fn nearer<S: Simd, P>(_: &mut P, compared: f32x16<S>, stored: f32x16<S>, _: u32) -> u32 {
    compared.simd_gt(stored).to_bitmask() as u32
}
