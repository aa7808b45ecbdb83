//! Triangles sorted into tiles.

use crate::blocks::{block_of, fill, number, place};
use crate::coverage::{Coverage, Samples};
use crate::piece::{Block, NOWHERE, Patch, Piece, SEVERAL};
use crate::setup::{Reach, SUBTEXELS, Setup, bounds};
use crate::{BIN, Cull, Stats, Triangle};
use glam::{IVec2, UVec2};
use umbrage_plane::{Facet, TexelRect, View};

const SIDE: i32 = BIN as i32;

/// Triangles sorted into the tiles of a view.
///
/// Tile (i, j) holds texels 32 i ≤ x < 32 (i + 1), 32 j ≤ y < 32 (j + 1), whatever the window. About 68 bytes for each triangle that is kept, and 4 for each tile it reaches.
#[derive(Clone, Debug)]
pub struct Bins {
    setup: Setup,
    tiles: UVec2,
    blocks: Vec<Block>,
    /// Where each tile's list begins in `lists`, and where the last one ends.
    starts: Vec<usize>,
    /// Numbers of pieces, ascending within a tile.
    lists: Vec<u32>,
    stats: Stats,
}

impl Bins {
    /// Projects, cuts, snaps and sorts `triangles`; at most 2²⁸ of them (indices are 32 bits wide).
    ///
    /// Only texels inside `window` (in texels; what of it is outside the view's rectangle is ignored) are ever covered. An empty window gives
    /// bins without a facet. Perspective triangles are cut at 1/1024 of the near distance, not at the near plane: what is between
    /// is kept with its true key, and counted in [`Stats::before_near`]. Orthographic ones are not cut in depth at all.
    ///
    /// `triangles` is run through on the calling thread; the threads of its rayon pool share the work on what it gives. The bins do not
    /// depend on their number.
    pub fn new(view: &View, window: TexelRect, cull: Cull, triangles: impl IntoIterator<Item = Triangle>) -> Self {
        Self::within_reach(Reach::Samples(view.sampling()), view, window, cull, triangles)
    }

    /// [`Bins::new`] for finer grids too ([`Bins::spans`]): it keeps what lies between the texels' samples as well. What reaches a tile includes what
    /// reaches no farther than one texel beyond its right and its lower side.
    pub fn for_spans(
        view: &View,
        window: TexelRect,
        cull: Cull,
        triangles: impl IntoIterator<Item = Triangle>,
    ) -> Self {
        Self::within_reach(Reach::Around, view, window, cull, triangles)
    }

    fn within_reach(
        reach: Reach,
        view: &View,
        window: TexelRect,
        cull: Cull,
        triangles: impl IntoIterator<Item = Triangle>,
    ) -> Self {
        let window = TexelRect::of_size(view.size()).intersect(window);
        let mut bins = Self {
            setup: Setup { view: *view, window, cull, reach },
            tiles: view.size().map(|side| side.div_ceil(BIN)),
            blocks: Vec::new(),
            starts: Vec::new(),
            lists: Vec::new(),
            stats: Stats::default(),
        };
        bins.refill(triangles);
        bins
    }

    /// Takes other triangles in place of its own, with the same view, window and culling and in the same memory: what [`Bins::new`] makes of
    /// them, without asking the system for memory again. For more triangles than are held at a time.
    pub fn refill(&mut self, triangles: impl IntoIterator<Item = Triangle>) {
        fill(&mut self.blocks, &self.setup, triangles.into_iter());
        self.stats = Stats::default();
        for block in &self.blocks {
            self.stats += block.stats;
        }
        self.sort();
    }

    /// Number of tiles across and down: the view's size over [`BIN`], rounded up.
    pub fn tiles(&self) -> UVec2 {
        self.tiles
    }

    /// Calls `sink` for each facet that covers a texel of the tile, in the order of the triangles. A tile outside [`Bins::tiles`] has none.
    ///
    /// The facet's key is exact on the triangle's plane. Only where the plane is so edge-on that 1/256 texel leads out of the triangle's range of
    /// keys, it is the mean of its corners' keys everywhere. Keys nearer than the near plane are not clamped here.
    #[inline(always)]
    pub fn tile(&self, tile: UVec2, mut sink: impl FnMut(&Facet, &Coverage)) {
        let list = self.list(tile);
        if list.is_empty() {
            return;
        }
        let Some(samples) = Samples::of(tile, self.setup.window, self.setup.view.sampling()) else { return };
        let mut coverage = Coverage::NOTHING;
        for &number in list {
            let (piece, corners) = self.piece(number);
            let patch = piece.patch();
            if patch != Patch::NONE {
                coverage.set(patch);
            } else if !samples.inside(corners, &mut coverage) {
                continue;
            }
            sink(&piece.facet(), &coverage);
        }
    }

    /// True when surely no facet covers a texel of the tile. Tiles of which it is false may still turn out to be bare.
    pub fn is_empty_tile(&self, tile: UVec2) -> bool {
        self.list(tile).is_empty()
    }

    /// How many facets may reach a tile; each is given to [`Bins::tile`]'s `sink` if it covers a sample.
    pub fn reaching(&self, tile: UVec2) -> usize {
        self.list(tile).len()
    }

    /// All facets that were kept, in the order of their triangles; some may cover no texel.
    pub fn facets(&self) -> impl ExactSizeIterator<Item = Facet> + '_ {
        let (mut block, mut place) = (0, 0);
        (0..self.stats.kept() as usize).map(move |_| {
            while place == self.blocks[block].pieces.len() {
                (block, place) = (block + 1, 0);
            }
            place += 1;
            self.blocks[block].pieces[place - 1].facet()
        })
    }

    /// The facet of the triangle with that index, 0-based among all given; `None` when it was skipped, culled or out of sight.
    pub fn facet(&self, triangle: u32) -> Option<Facet> {
        let pieces = &self.blocks.get(block_of(triangle))?.pieces;
        let index = pieces.binary_search_by_key(&triangle, |piece| piece.triangle).ok()?;
        Some(pieces[index].facet())
    }

    /// Counts.
    pub fn stats(&self) -> Stats {
        self.stats
    }

    /// How far beyond a tile's right and lower side what is in its list may be, in 1/256 texel.
    pub(crate) fn beyond(&self) -> i32 {
        self.setup.reach.beyond()
    }

    pub(crate) fn window(&self) -> TexelRect {
        self.setup.window
    }

    /// A piece by its number, and its corners.
    #[inline(always)]
    pub(crate) fn piece(&self, number: u32) -> (&Piece, &[IVec2]) {
        let (block, place) = place(number);
        let block = &self.blocks[block];
        let piece = &block.pieces[place];
        (piece, block.corners(piece))
    }

    /// Numbers of the pieces that may reach a tile, ascending; none outside [`Bins::tiles`].
    pub(crate) fn list(&self, tile: UVec2) -> &[u32] {
        if tile.cmpge(self.tiles).any() {
            return &[];
        }
        let index = tile.y as usize * self.tiles.x as usize + tile.x as usize;
        &self.lists[self.starts[index]..self.starts[index + 1]]
    }

    /// Makes the lists: counts, adds up, fills.
    fn sort(&mut self) {
        let (mut starts, mut lists) = (std::mem::take(&mut self.starts), std::mem::take(&mut self.lists));
        let tiles = self.tiles.x as usize * self.tiles.y as usize;
        // A tile's count stands two places behind it. Once they are added up, the list of each begins at the place behind it, which moves on
        // with each entry, and so becomes the place where the next one begins.
        starts.clear();
        starts.resize(tiles + 2, 0);
        let counts = &mut starts[2..];
        self.each_home(|_, tile| counts[tile] += 1);
        for tile in 0..tiles {
            starts[tile + 2] += starts[tile + 1];
        }
        lists.clear();
        lists.resize(starts[tiles + 1], 0);
        let begins = &mut starts[1..];
        self.each_home(|number, tile| {
            lists[begins[tile]] = number;
            begins[tile] += 1;
        });
        (self.starts, self.lists) = (starts, lists);
    }

    /// Calls `each` with the number of every piece, in their order, and the index of every tile that it may cover.
    #[inline(always)]
    fn each_home(&self, mut each: impl FnMut(u32, usize)) {
        for (index, block) in self.blocks.iter().enumerate() {
            for (place, &home) in block.homes.iter().enumerate() {
                let number = number(index, place);
                match home {
                    NOWHERE => {}
                    SEVERAL => self.each_tile(block.corners(&block.pieces[place]), |tile| each(number, tile)),
                    _ => each(number, home as usize),
                }
            }
        }
    }

    /// Calls `each` with the index of every tile that a polygon may cover.
    fn each_tile(&self, corners: &[IVec2], mut each: impl FnMut(usize)) {
        let texels = self.setup.reach.texels(bounds(corners)).intersect(self.setup.window);
        let (first, last) = (texels.min.map(|v| v / SIDE), texels.max.map(|v| (v - 1) / SIDE));
        let narrow = last.x - first.x < 2 || last.y == first.y;
        let beyond = self.beyond();
        for row in first.y..=last.y {
            let (mut from, mut to) = (first.x, last.x);
            if !narrow {
                let (left, right) = extent(corners, row * SIDE * SUBTEXELS, (row + 1) * SIDE * SUBTEXELS + beyond);
                from = from.max(left.saturating_sub(beyond).div_euclid(SIDE * SUBTEXELS));
                to = to.min(right.div_euclid(SIDE * SUBTEXELS));
            }
            let start = row as usize * self.tiles.x as usize;
            for column in from..=to {
                each(start + column as usize);
            }
        }
    }
}

/// Encloses x of what of the outline lies between two heights (inclusive), in 1/256 texel; (`i32::MAX`, `i32::MIN`) when nothing does.
fn extent(corners: &[IVec2], top: i32, bottom: i32) -> (i32, i32) {
    let (mut left, mut right) = (i32::MAX, i32::MIN);
    for (&a, &b) in corners.iter().zip(corners.iter().cycle().skip(1)) {
        let (a, b) = if a.y <= b.y { (a, b) } else { (b, a) };
        if a.y > bottom || b.y < top {
            continue;
        }
        let (dx, dy) = (i64::from(b.x - a.x), i64::from(b.y - a.y));
        for y in [a.y.max(top), b.y.min(bottom)] {
            let x = if dy == 0 { i64::from(a.x) } else { i64::from(a.x) + (dx * i64::from(y - a.y)).div_euclid(dy) };
            left = left.min(x as i32);
            right = right.max(x as i32 + 1);
        }
        if dy == 0 {
            left = left.min(b.x);
            right = right.max(b.x);
        }
    }
    (left, right)
}
