use crate::ReceiverDepth;
use crate::depth::lane;
use fearless_simd::{Simd, f32x16, prelude::*};
use umbrage_depth::DepthMap;
use umbrage_plane::{Footprint, Receiver, TexelRect, Verdict, View, floor_texel};
use umbrage_sample::{Key, Pattern, Taps};

/// What every comparing filter is made of: the share of a region's taps that are in shadow, weights included, 0 without a tap, and how many
/// texels were read for it.
///
/// Taps outside the map or the cone answer by the view's rules (C-10); texels of deep maps by what passes them (B06-11).
#[inline(always)]
pub(crate) fn share<S: Simd, M: DepthMap, P: Pattern, D: ReceiverDepth>(
    simd: S,
    map: &M,
    receiver: &Receiver,
    region: &Footprint,
    parts: (&P, &D),
    key: Key,
) -> (f32, u32) {
    share_by(simd, map, receiver, region, parts, key, |compared, stored, _| {
        compared.simd_gt(stored).to_bitmask() as u32
    })
}

/// [`share`] with another way to compare: `behind` tells, of sixteen compared and stored depths and the mask of those that count, which are
/// behind what is stored. Deep maps are not asked by it.
#[inline(always)]
pub(crate) fn share_by<S: Simd, M: DepthMap, P: Pattern, D: ReceiverDepth>(
    simd: S,
    map: &M,
    receiver: &Receiver,
    region: &Footprint,
    (pattern, depth): (&P, &D),
    key: Key,
    mut behind: impl FnMut(f32x16<S>, f32x16<S>, u32) -> u32,
) -> (f32, u32) {
    let view = map.view();
    let rect = TexelRect::around(region.centre, region.half);
    let inside = view.holds(region.centre, region.half);
    let (mut hits, mut count, mut looked) = (0.0, 0.0, 0);
    pattern.taps(simd, region, key, |taps| {
        let compared = depth.lanes(simd, view, receiver, taps);
        looked += taps.mask.count_ones();
        if map.is_deep() {
            let (column, row) = (floor_texel(simd, taps.x), floor_texel(simd, taps.y));
            for i in (0..16).filter(|i| taps.mask >> i & 1 == 1) {
                let weight = if P::WEIGHTED { taps.weight[i] } else { 1.0 };
                let by_map = || 1.0 - map.passes(glam::IVec2::new(column[i], row[i]), compared[i]);
                count += weight;
                hits += weight * if inside { by_map() } else { by_rule(view, taps, i).unwrap_or_else(by_map) };
            }
            return;
        }
        let mut nearer = behind(compared, map.look(simd, rect, taps.x, taps.y), taps.mask) & taps.mask;
        if !inside {
            nearer = by_rules(view, taps, nearer);
        }
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
    (if count > 0.0 { hits / count } else { 0.0 }, looked)
}

/// The hits of a batch of taps with those outside the map or the cone answered by the view's rules (spec C-10, W92-6).
#[inline(always)]
fn by_rules<S: Simd>(view: &View, taps: &Taps<S>, mut nearer: u32) -> u32 {
    for i in (0..16).filter(|i| taps.mask >> i & 1 == 1) {
        match by_rule(view, taps, i) {
            Some(dark) if dark > 0.0 => nearer |= 1 << i,
            Some(_) => nearer &= !(1 << i),
            None => {}
        }
    }
    nearer
}

/// The answer of one tap whose place settles it.
#[inline(always)]
fn by_rule<S: Simd>(view: &View, taps: &Taps<S>, i: usize) -> Option<f32> {
    match view.rules().verdict(view.locate(lane(taps, i))) {
        Verdict::Lit => Some(0.0),
        Verdict::Shadowed => Some(1.0),
        Verdict::Compare => None,
    }
}
