use crate::depth::lane;
use crate::{Biased, Filter, Probe, ReceiverDepth};
use fearless_simd::{Simd, prelude::*};
use umbrage_depth::DepthMap;
use umbrage_plane::{Receiver, TexelRect, Verdict, View};
use umbrage_sample::{Jittered, Key, Pattern, Taps};

/// Percentage-closer filtering (Reeves, Salesin & Cook 1987, §2, §3.2 and Fig. 4; R87-9, R87-13).
///
/// Each texel under the region becomes "nearer or not", and those answers are averaged.
///
/// Departures from the printed listing, by the errata of [`as_printed`](crate::as_printed): (1) both half-extents get their minimum
/// (E-R4); (2) sample counts are clamped in an order that cannot divide by zero (E-R5, E-R6); (3) jitter spans whole cells
/// (E-R9); (4) positions are floored (E-R10); (5) samples outside the map or the cone answer by the view's rules (E-R13, E-R14);
/// (6) the cull uses depth ranges and never changes a result (R87-22).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Pcf<P = Jittered, D = Biased> {
    /// Where to look.
    pub pattern: P,
    /// Which depth to compare.
    pub depth: D,
    /// Multiplies the region's size: softness. Reeves advises 2 to 4; below 1 the map's own aliases appear.
    pub res_factor: f32,
    /// Least half-extent of the region after `res_factor`, in texels.
    pub min_size: f32,
    /// Whether depth ranges may settle a region without a look-up. Changes no result.
    pub cull: bool,
}

impl Default for Pcf {
    /// The printed listing's values.
    fn default() -> Self {
        Self { pattern: Jittered::default(), depth: Biased::default(), res_factor: 3.0, min_size: 0.0, cull: true }
    }
}

impl<P: Pattern, D: ReceiverDepth> Filter for Pcf<P, D> {
    #[inline(always)]
    fn shadow<S: Simd, M: DepthMap, Q: Probe>(
        &self,
        simd: S,
        map: &M,
        receiver: &Receiver,
        key: Key,
        probe: &mut Q,
    ) -> f32 {
        let view = map.view();
        let region = receiver.footprint.scaled(self.res_factor, self.min_size, view.size().as_vec2() * 0.25);
        let rect = TexelRect::around(region.centre, region.half);
        let inside = view.holds(region.centre, region.half);
        if self.cull && inside {
            let (stored, compared) = (map.range(rect), self.depth.bounds(view, receiver, rect));
            if compared.max <= stored.min {
                probe.culled(false);
                return 0.0;
            }
            if compared.min > stored.max {
                probe.culled(true);
                return 1.0;
            }
        }
        let (mut hits, mut count, mut looked) = (0.0, 0.0, 0);
        self.pattern.taps(simd, &region, key, |taps| {
            let compared = self.depth.lanes(simd, view, receiver, taps);
            let mut nearer = compared.simd_gt(map.look(simd, rect, taps.x, taps.y)).to_bitmask() as u32 & taps.mask;
            if !inside {
                nearer = by_rules(view, taps, nearer);
            }
            looked += taps.mask.count_ones();
            if P::WEIGHTED {
                for i in 0..16 {
                    let weight = if taps.mask >> i & 1 == 1 { taps.weight[i] } else { 0.0 };
                    count += weight;
                    hits += if nearer >> i & 1 == 1 { weight } else { 0.0 };
                }
            } else {
                count += taps.mask.count_ones() as f32;
                hits += nearer.count_ones() as f32;
            }
        });
        probe.looked(looked);
        if count > 0.0 { hits / count } else { 0.0 }
    }
}

/// The hits of a batch of taps with those outside the map or the cone answered by the view's rules (spec C-10, W92-6).
#[inline(always)]
fn by_rules<S: Simd>(view: &View, taps: &Taps<S>, mut nearer: u32) -> u32 {
    for i in 0..16 {
        let bit = 1 << i;
        if taps.mask & bit != 0 {
            match view.rules().verdict(view.locate(lane(taps, i))) {
                Verdict::Lit => nearer &= !bit,
                Verdict::Shadowed => nearer |= bit,
                Verdict::Compare => {}
            }
        }
    }
    nearer
}
