//! Maps of facets as what every other map is.

use super::planar::Planar;
use super::{FacetMap, Facets, SHIFT, tile};
use crate::{DepthMap, Stored, TILE};
use fearless_simd::{Simd, f32x16, prelude::*};
use glam::{DVec2, IVec2};
use umbrage_plane::{DepthRange, TexelRect, View, floor_texel};

/// More tiles than this are not asked for their range.
const MOST_ASKED: u32 = 16;

/// The last column and row of a tile.
const LAST: i32 = TILE as i32 - 1;

impl FacetMap {
    /// The keys at the samples of sixteen texels, all in a rectangle, whose positions are all x, all y; `None` where the rectangle reaches out of
    /// the map or over more than two by two tiles, or where one of them has no table of planes.
    #[inline(always)]
    fn keys(&self, within: TexelRect, [columns, rows]: [&[i32; 16]; 2], [x, y]: &[[f64; 16]; 2]) -> Option<[f32; 16]> {
        if within.is_empty() || !TexelRect::of_size(self.depths.view.size()).encloses(within) {
            return None;
        }
        let (low, high) = (within.min >> SHIFT as i32, (within.max - 1) >> SHIFT as i32);
        let texel = |i: usize| ((rows[i] & LAST) << SHIFT | (columns[i] & LAST)) as usize;
        let mut keys = [0.0; 16];
        let first = self.planar(low)?;
        if low == high {
            // A small region lies in one tile more often than not.
            for i in 0..16 {
                keys[i] = first.get(texel(i)).at(DVec2::new(x[i], y[i])) as f32;
            }
            return Some(keys);
        }
        if (high - low).cmpgt(IVec2::ONE).any() {
            return None;
        }
        let [right, below] = [IVec2::new(high.x, low.y), IVec2::new(low.x, high.y)];
        let tiles = [first, self.planar(right)?, self.planar(below)?, self.planar(high)?];
        for i in 0..16 {
            let (right, below) = ((columns[i] >> SHIFT) - low.x, (rows[i] >> SHIFT) - low.y);
            let tile = tiles[((right & 1) | ((below & 1) << 1)) as usize & 3];
            keys[i] = tile.get(texel(i)).at(DVec2::new(x[i], y[i])) as f32;
        }
        Some(keys)
    }

    /// The planes of a tile; `None` where it keeps something else.
    #[inline(always)]
    fn planar(&self, at: IVec2) -> Option<Planar<'_>> {
        match self.tiles.get((at.y as u32 * self.grid.x + at.x as u32) as usize) {
            None => Some(Planar::NOTHING),
            Some(tile) => Planar::of(tile),
        }
    }
}

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
    fn look<S: Simd>(&self, simd: S, within: TexelRect, x: f32x16<S>, y: f32x16<S>) -> f32x16<S> {
        let columns: [i32; 16] = floor_texel(simd, x).into();
        let rows: [i32; 16] = floor_texel(simd, y).into();
        let at = self.depths.view.sampling().positions(&columns, &rows);
        let mut depths = [0.0; 16];
        if let Some(keys) = self.keys(within, [&columns, &rows], &at) {
            self.depths.of_keys(&keys, &at, &mut depths);
        } else {
            for i in 0..16 {
                depths[i] = self.depth(IVec2::new(columns[i], rows[i]));
            }
        }
        f32x16::load_array(simd, depths)
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
