use crate::{
    Key, Pattern, Taps,
    grid::{Area, Grid},
};
use fearless_simd::Simd;
use glam::Vec2;
use umbrage_plane::{Footprint, TexelRect};

/// Every texel of the region once: the reference that sampling approximates (Reeves 1987, Fig. 2b).
///
/// A texel belongs to the region when its centre lies in `[centre − half, centre + half)` on both axes; an axis on
/// which none does has the one texel under the region's centre. Taps are texel centres, row by row (that one texel's
/// tap is moved into the region, should its centre lie outside), and so has an axis whose extent is not finite. Of regions wider than 65,536 texels only the first
/// 65,536 columns or rows are visited: no map is larger than half of that.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct EveryTexel;

/// More columns than any map has, and no more than a [`Grid`] takes.
const MOST: f32 = 65_536.0;

impl Pattern for EveryTexel {
    /// Unless an axis has only the texel under the region's centre, whose tap may lie elsewhere in it.
    #[inline(always)]
    fn window(&self, region: &Footprint) -> Option<TexelRect> {
        let area = Area::of(region);
        let first = (area.low - 0.5).ceil();
        let size = (area.high - 0.5).ceil() - first;
        let near = size.cmpge(Vec2::ONE).all() && first.abs().max_element() < MOST && size.max_element() < MOST;
        near.then(|| TexelRect::new(first.as_ivec2(), (first + size).as_ivec2()))
    }

    #[inline(always)]
    fn taps<S: Simd>(&self, simd: S, region: &Footprint, key: Key, mut each: impl FnMut(&Taps<S>)) {
        let area = Area::of(region);
        let (left, columns) = span(area.low.x, area.high.x, region.centre.x);
        let (top, rows) = span(area.low.y, area.high.y, region.centre.y);
        let grid = Grid { columns, rows };
        for batch in grid.batches() {
            let (i, j) = grid.cells(simd, batch.0);
            each(&area.taps(simd, key, batch, (i + (left + 0.5), j + (top + 0.5))));
        }
    }
}

/// The first texel whose centre is in `[low, high)`, and how many there are, at least the one under `centre`.
#[inline(always)]
fn span(low: f32, high: f32, centre: f32) -> (f32, u32) {
    let first = (low - 0.5).ceil();
    let count = (high - 0.5).ceil() - first;
    if count >= 1.0 && count.is_finite() { (first, count.min(MOST) as u32) } else { (centre.floor(), 1) }
}
