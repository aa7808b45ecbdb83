//! Maps of facets as what every other map is.

use super::{FacetMap, Facets, SHIFT, tile};
use crate::{DepthMap, Stored};
use glam::IVec2;
use umbrage_plane::{DepthRange, TexelRect, View};

/// More tiles than this are not asked for their range.
const MOST_ASKED: u32 = 16;

impl DepthMap for FacetMap {
    fn view(&self) -> &View {
        &self.depths.view
    }

    #[inline(always)]
    fn depth(&self, texel: IVec2) -> f32 {
        let Some((tile, middle, within)) = self.tile(texel) else { return f32::INFINITY };
        match tile.reader(middle).texel(within) {
            tile::Stored::Depth(depth) => depth,
            tile::Stored::Plane(plane) => self.depths.depth(texel, &plane),
        }
    }

    #[inline(always)]
    fn range(&self, rect: TexelRect) -> DepthRange {
        let whole = TexelRect::of_size(self.depths.view.size());
        let touched = whole.intersect(rect);
        if touched.is_empty() {
            return DepthRange::NOTHING;
        }
        let (low, high) = (touched.min.as_uvec2() >> SHIFT, (touched.max - 1).as_uvec2() >> SHIFT);
        if (high - low + 1).element_product() > MOST_ASKED {
            return DepthRange::UNKNOWN;
        }
        let mut range = (!whole.encloses(rect)).then_some(DepthRange::NOTHING);
        for y in low.y..=high.y {
            for x in low.x..=high.x {
                let tile = self.tiles.get((y * self.grid.x + x) as usize);
                let own = tile.map_or(DepthRange::NOTHING, |tile| tile.range);
                range = Some(range.map_or(own, |range| range.union(own)));
            }
        }
        range.unwrap_or(DepthRange::NOTHING)
    }

    fn stored(&self) -> Stored {
        self.stored
    }

    fn facets(&self) -> Option<Facets<'_>> {
        Some(Facets::Map(self))
    }

    fn bytes(&self) -> usize {
        self.tiles.bytes()
    }

    fn allocated(&self) -> usize {
        self.bytes() + self.tiles.directory() + size_of::<Self>()
    }
}
