use crate::map::texels_of_row;
use crate::{DepthMap, Stored, TILE, no_surface};
use fearless_simd::{Simd, f32x16, prelude::*, u32x16};
use glam::{IVec2, UVec2};
use umbrage_plane::{DepthRange, TexelRect, View, floor_texel};

/// Texels of a tile.
const AREA: usize = (TILE * TILE) as usize;
/// log₂ of [`TILE`].
const SHIFT: u32 = TILE.trailing_zeros();
/// What a tile that is left out stands for.
static EMPTY: [f32; AREA] = [f32::INFINITY; AREA];
/// The ranges of more tiles than this are not looked at.
const MOST_ASKED: u32 = 64;
/// What the first range is united with; never leaves this module.
const NONE_YET: DepthRange = DepthRange { min: f32::INFINITY, max: f32::NEG_INFINITY };

/// The smallest and largest depth of every column of a tile: apart until the end, so that a row is worked on in vectors.
struct Extremes {
    low: [f32; TILE as usize],
    high: [f32; TILE as usize],
}

impl Extremes {
    const NONE_YET: Self = Self { low: [NONE_YET.min; TILE as usize], high: [NONE_YET.max; TILE as usize] };

    /// Makes the depths of a row those that a map [keeps](no_surface::kept), and counts them.
    #[inline(always)]
    fn keep(&mut self, row: &mut [f32]) {
        for ((depth, low), high) in row.iter_mut().zip(&mut self.low).zip(&mut self.high) {
            *depth = no_surface::kept(*depth);
            *low = low.min(*depth);
            *high = high.max(*depth);
        }
    }

    #[inline(always)]
    fn range(&self) -> DepthRange {
        let columns = self.low.iter().zip(&self.high).map(|(&min, &max)| DepthRange { min, max });
        columns.fold(NONE_YET, DepthRange::union)
    }
}

/// A square of a map that holds at least one surface.
#[derive(Clone, Debug, PartialEq)]
pub struct Tile {
    depths: Box<[f32; AREA]>,
    range: DepthRange,
}

impl Tile {
    /// From the depths of a tile, row by row from the top, of which the first `valid.x` columns and `valid.y` rows belong to the map
    /// (less than [`TILE`] only at its right and lower edge; more counts as [`TILE`]). `None` when no surface is among them.
    ///
    /// Values of 1e30 or more, NaN and −∞ become +∞, like all texels beyond `valid`, which never count.
    #[inline(always)]
    pub fn new(mut depths: Box<[f32; AREA]>, valid: UVec2) -> Option<Self> {
        let valid = valid.min(UVec2::splat(TILE)).as_usizevec2();
        let mut extremes = Extremes::NONE_YET;
        for (row, line) in depths.chunks_exact_mut(TILE as usize).enumerate() {
            let (inside, beyond) = line.split_at_mut(if row < valid.y { valid.x } else { 0 });
            extremes.keep(inside);
            beyond.fill(f32::INFINITY);
        }
        let range = extremes.range();
        (range.min < f32::INFINITY).then_some(Self { depths, range })
    }

    /// The depths, row by row from the top; +∞ where there is no surface or no map.
    pub fn depths(&self) -> &[f32; AREA] {
        &self.depths
    }

    /// The smallest and largest depth of the texels that belong to the map; the largest is +∞ when one of them has no surface
    /// (Reeves 1987).
    pub fn range(&self) -> DepthRange {
        self.range
    }
}

/// Tiles of 32×32 texels, those without a surface left out (Reeves 1987, §3.3): the native form of a map.
///
/// Every tile knows its nearest and farthest depth, so that [`DepthMap::range`] can settle regions without a look-up.
/// Small compact surfaces take more room than in a [`Bbox`](crate::Bbox), scattered ones less.
#[derive(Clone, Debug, PartialEq)]
pub struct Tiled {
    view: View,
    stored: Stored,
    /// Columns and rows of tiles.
    grid: UVec2,
    tiles: Vec<Option<Tile>>,
}

impl Tiled {
    /// The same depths, said to be those of another surface. A new map's are those of the nearest, a copy's those of the map it
    /// is made from.
    #[must_use]
    pub fn with_stored(self, stored: Stored) -> Self {
        Self { stored, ..self }
    }

    /// From all tiles of a map of `view`, row by row from the top; `None` for those without a surface.
    ///
    /// # Panics
    /// When there is not one entry for each tile: ⌈width/32⌉·⌈height/32⌉.
    pub fn from_tiles(view: View, tiles: Vec<Option<Tile>>) -> Self {
        let grid = (view.size() + (TILE - 1)) / TILE;
        assert_eq!(tiles.len(), grid.element_product() as usize, "tiles of a map of {} texels", view.size());
        Self { view, stored: Stored::First, grid, tiles }
    }

    /// The tiles of another map.
    pub fn copy_of(map: &impl DepthMap) -> Self {
        let size = map.view().size();
        let grid = (size + (TILE - 1)) / TILE;
        let tile = |index: u32| {
            let origin = UVec2::new(index % grid.x, index / grid.x) * TILE;
            let texel = |i: usize| (origin + UVec2::new(i as u32 % TILE, i as u32 / TILE)).as_ivec2();
            Tile::new(Box::new(std::array::from_fn(|i| map.depth(texel(i)))), size - origin)
        };
        Self { view: *map.view(), stored: map.stored(), grid, tiles: (0..grid.element_product()).map(tile).collect() }
    }

    /// Columns and rows of tiles.
    pub fn grid(&self) -> UVec2 {
        self.grid
    }

    /// The tile at a column and row of tiles; `None` where no surface is stored and outside the map.
    #[inline(always)]
    pub fn tile(&self, at: UVec2) -> Option<&Tile> {
        if at.x >= self.grid.x || at.y >= self.grid.y {
            return None;
        }
        self.tiles[(at.y * self.grid.x + at.x) as usize].as_ref()
    }

    /// [`Tiled::tile`] of a column and row that the map has.
    #[inline(always)]
    fn within(&self, x: i32, y: i32) -> Option<&Tile> {
        let index = y as u32 * self.grid.x + x as u32;
        if let Some(Some(tile)) = self.tiles.get(index as usize) { Some(tile) } else { None }
    }

    /// The depths there.
    #[inline(always)]
    fn depths_of(&self, x: i32, y: i32) -> &[f32; AREA] {
        if let Some(tile) = self.within(x, y) { &tile.depths } else { &EMPTY }
    }

    /// Their range.
    #[inline(always)]
    fn range_of(&self, x: i32, y: i32) -> DepthRange {
        if let Some(tile) = self.within(x, y) { tile.range } else { DepthRange::NOTHING }
    }

    /// Number of tiles that are kept.
    pub fn tile_count(&self) -> usize {
        self.tiles.iter().flatten().count()
    }

    /// Bytes held to find the tiles and their ranges, which [`DepthMap::bytes`] leaves out.
    pub fn directory_bytes(&self) -> usize {
        size_of_val(self.tiles.as_slice())
    }

    /// A rectangle around all kept tiles.
    pub(crate) fn kept(&self) -> TexelRect {
        let kept = self.tiles.iter().zip(0..).filter(|(tile, _)| tile.is_some());
        let all = kept.fold(TexelRect::EMPTY, |all, (_, index)| {
            let origin = (UVec2::new(index % self.grid.x, index / self.grid.x) * TILE).as_ivec2();
            all.union(TexelRect::new(origin, origin + TILE as i32))
        });
        all.intersect(TexelRect::of_size(self.view.size()))
    }
}

impl DepthMap for Tiled {
    fn view(&self) -> &View {
        &self.view
    }

    #[inline(always)]
    fn depth(&self, texel: IVec2) -> f32 {
        if !TexelRect::of_size(self.view.size()).contains(texel) {
            return f32::INFINITY;
        }
        let (tile, at) = (texel.as_uvec2() >> SHIFT, texel.as_uvec2() & (TILE - 1));
        self.tile(tile).map_or(f32::INFINITY, |tile| tile.depths[(at.y * TILE + at.x) as usize])
    }

    #[inline(always)]
    fn look<S: Simd>(&self, simd: S, within: TexelRect, x: f32x16<S>, y: f32x16<S>) -> f32x16<S> {
        let column: u32x16<S> = floor_texel(simd, x).bitcast();
        let row: u32x16<S> = floor_texel(simd, y).bitcast();
        let place = ((row & (TILE - 1)) << SHIFT) | (column & (TILE - 1));
        let whole = TexelRect::of_size(self.view.size());
        // Masks of AREA − 1 and of 3 are of no effect but to show that no index can be out of bounds.
        let mut found = [f32::INFINITY; 16];
        let (low, high) = (within.min >> SHIFT, within.max.wrapping_sub(IVec2::ONE) >> SHIFT);
        if (high - low).cmple(IVec2::ONE).all() && whole.encloses(within) {
            let first = self.depths_of(low.x, low.y);
            if low == high {
                // A small region lies in one tile more often than not.
                for i in 0..16 {
                    found[i] = first[place[i] as usize & (AREA - 1)];
                }
                return f32x16::load_array(simd, found);
            }
            let tiles =
                [first, self.depths_of(high.x, low.y), self.depths_of(low.x, high.y), self.depths_of(high.x, high.y)];
            let (right, below) = (column >> SHIFT, row >> SHIFT);
            let tile = ((right - low.x as u32) & 1) | (((below - low.y as u32) & 1) << 1);
            for i in 0..16 {
                found[i] = tiles[tile[i] as usize & 3][place[i] as usize & (AREA - 1)];
            }
            return f32x16::load_array(simd, found);
        }
        let size = whole.size();
        let inside = column.simd_lt(u32x16::splat(simd, size.x)) & row.simd_lt(u32x16::splat(simd, size.y));
        let tile = (row >> SHIFT) * self.grid.x + (column >> SHIFT);
        let tile = inside.select(tile, u32x16::splat(simd, u32::MAX));
        for i in 0..16 {
            if let Some(Some(tile)) = self.tiles.get(tile[i] as usize) {
                found[i] = tile.depths[place[i] as usize & (AREA - 1)];
            }
        }
        f32x16::load_array(simd, found)
    }

    #[inline(always)]
    fn in_row<S: Simd>(&self, simd: S, texel: IVec2, count: u32) -> f32x16<S> {
        let texels = TexelRect { min: texel, max: texel + IVec2::new(count as i32, 1) };
        if !TexelRect::of_size(self.view.size()).encloses(texels) {
            return f32x16::load_array(simd, texels_of_row(self, texel, count));
        }
        let (tile, at) = (texel >> SHIFT, texel.as_uvec2() & (TILE - 1));
        let (own, first) = (self.depths_of(tile.x, tile.y), (at.y * TILE + at.x) as usize);
        if at.x + count <= TILE
            && let Some((_, row)) = own.split_at_checked(first)
            && let Some(row) = row.first_chunk()
        {
            return f32x16::load_array(simd, *row);
        }
        // The row crosses a side of the tile, or sixteen lanes end after the tile's last row.
        let tiles = [own, self.depths_of((texel.x + count as i32 - 1) >> SHIFT, tile.y)];
        let mut found = [f32::INFINITY; 16];
        for (i, found) in found.iter_mut().enumerate() {
            let x = at.x as usize + i;
            *found = tiles[x >> SHIFT & 1][(at.y as usize) << SHIFT & (AREA - 1) | x & (TILE as usize - 1)];
        }
        f32x16::load_array(simd, found)
    }

    /// The union over the tiles that `rect` touches; [`DepthRange::UNKNOWN`] when they are more than 64.
    #[inline(always)]
    fn range(&self, rect: TexelRect) -> DepthRange {
        let whole = TexelRect::of_size(self.view.size());
        let inside = whole.encloses(rect);
        let touched = if inside { rect } else { whole.intersect(rect) };
        if touched.is_empty() {
            return DepthRange::NOTHING;
        }
        let (low, high) = (touched.min >> SHIFT, (touched.max - 1) >> SHIFT);
        let first = self.range_of(low.x, low.y);
        if low == high && inside {
            // A small region lies in one tile more often than not.
            return first;
        }
        let tiles = (high - low + 1).as_uvec2();
        if tiles.element_product() > MOST_ASKED {
            return DepthRange::UNKNOWN;
        }
        let mut all = if inside { first } else { first.union(DepthRange::NOTHING) };
        for y in low.y..=high.y {
            for x in low.x..=high.x {
                all = all.union(self.range_of(x, y));
            }
        }
        all
    }

    fn stored(&self) -> Stored {
        self.stored
    }

    fn bytes(&self) -> usize {
        self.tile_count() * AREA * size_of::<f32>()
    }

    fn allocated(&self) -> usize {
        self.bytes() + self.directory_bytes() + size_of::<Self>()
    }
}
