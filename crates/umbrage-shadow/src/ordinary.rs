use crate::{Filter, Probe};
use fearless_simd::Simd;
use umbrage_depth::DepthMap;
use umbrage_plane::{Bias, Receiver, TexelRect, Verdict};
use umbrage_sample::{EveryTexel, Key, Pattern};

/// The control of Reeves' Figure 2a: filter the depths, then compare once (R87-10). The answer is 0 or 1, and near an edge it means nothing.
///
/// A region that holds an empty texel has a mean of +∞ and is lit; one whose centre lies outside the map or the cone answers by the
/// view's rules (spec C-10).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Ordinary<P = EveryTexel> {
    /// Where to look.
    pub pattern: P,
    /// Moves the receiver toward the light.
    pub bias: Bias,
    /// Multiplies the region's size.
    pub res_factor: f32,
}

impl<P: Pattern> Filter for Ordinary<P> {
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
        let place = view.locate(receiver.footprint.centre);
        match view.rules().verdict(place) {
            Verdict::Compare => {}
            settled => {
                probe.placed(place);
                return if settled == Verdict::Shadowed { 1.0 } else { 0.0 };
            }
        }
        let region = receiver.footprint.scaled(self.res_factor, 0.0, view.size().as_vec2() * 0.25);
        let rect = TexelRect::around(region.centre, region.half);
        let (mut sum, mut count) = (0.0f64, 0.0f64);
        self.pattern.taps(simd, &region, key, |taps| {
            let depth = map.look(simd, rect, taps.x, taps.y);
            for i in 0..16 {
                if taps.mask >> i & 1 == 1 {
                    let weight = if P::WEIGHTED { f64::from(taps.weight[i]) } else { 1.0 };
                    sum += f64::from(depth[i]) * weight;
                    count += weight;
                }
            }
        });
        probe.looked(count as u32);
        let mean = sum / count;
        if f64::from(receiver.nearer(view, self.bias)) > mean { 1.0 } else { 0.0 }
    }
}
