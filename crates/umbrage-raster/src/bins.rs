//! Triangles sorted into tiles.

use crate::blocks::fill;
use crate::coverage::{Coverage, Samples};
use crate::lists::{self, Lists};
use crate::piece::{Block, Patch, Piece, block_of, place};
use crate::setup::{Reach, Setup};
use crate::{Cull, Geometry, Stats};
use glam::{IVec2, UVec2};
use umbrage_plane::{Facet, TexelRect, View};

/// Triangles sorted into the tiles of a view.
///
/// Tile (i, j) holds texels 32 i ≤ x < 32 (i + 1), 32 j ≤ y < 32 (j + 1), whatever the window. About 68 bytes for each triangle that is kept, and 4 for each tile it reaches.
#[derive(Clone, Debug)]
pub struct Bins {
    setup: Setup,
    blocks: Vec<Block>,
    lists: Vec<Lists>,
    stats: Stats,
}

impl Bins {
    /// Projects, cuts, snaps and sorts triangles, one by one or in meshes; at most 2²⁸ of them (indices are 32 bits wide).
    ///
    /// Only texels inside `window` (in texels; what of it is outside the view's rectangle is ignored) are ever covered. An empty window gives
    /// bins without a facet. Perspective triangles are cut at 1/1024 of the near distance, not at the near plane: what is between
    /// is kept with its true key, and counted in [`Stats::before_near`]. Orthographic ones are not cut in depth at all.
    ///
    /// `geometry` is run through on the calling thread; the threads of its rayon pool share the work on what it gives. The bins do not
    /// depend on their number.
    pub fn new<'a>(
        view: &View,
        window: TexelRect,
        cull: Cull,
        geometry: impl IntoIterator<Item: Into<Geometry<'a>>>,
    ) -> Self {
        Self::within_reach(Reach::Samples(view.sampling()), view, window, cull, geometry)
    }

    /// [`Bins::new`] for finer grids too ([`Bins::spans`]): it keeps what lies between the texels' samples as well. What reaches a tile includes what
    /// reaches no farther than one texel beyond its right and its lower side.
    pub fn for_spans<'a>(
        view: &View,
        window: TexelRect,
        cull: Cull,
        geometry: impl IntoIterator<Item: Into<Geometry<'a>>>,
    ) -> Self {
        Self::within_reach(Reach::Around, view, window, cull, geometry)
    }

    fn within_reach<'a>(
        reach: Reach,
        view: &View,
        window: TexelRect,
        cull: Cull,
        geometry: impl IntoIterator<Item: Into<Geometry<'a>>>,
    ) -> Self {
        let window = TexelRect::of_size(view.size()).intersect(window);
        let mut bins = Self {
            setup: Setup { view: *view, window, cull, reach },
            blocks: Vec::new(),
            lists: Vec::new(),
            stats: Stats::default(),
        };
        bins.refill(geometry);
        bins
    }

    /// Takes other triangles in place of its own, with the same view, window and culling and in the same memory: what [`Bins::new`] makes of
    /// them, without asking the system for memory again. For more triangles than are held at a time.
    pub fn refill<'a>(&mut self, geometry: impl IntoIterator<Item: Into<Geometry<'a>>>) {
        fill(&mut self.blocks, &self.setup, geometry);
        self.stats = Stats::default();
        for block in &self.blocks {
            self.stats += block.stats;
        }
        lists::sort(&mut self.lists, &self.setup, &self.blocks);
    }

    /// Number of tiles across and down: the view's size over [`BIN`](crate::BIN), rounded up.
    pub fn tiles(&self) -> UVec2 {
        self.setup.tiles()
    }

    /// Calls `sink` for each facet that covers a texel of the tile, in the order of the triangles. A tile outside [`Bins::tiles`] has none.
    ///
    /// The facet's key is exact on the triangle's plane. Only where the plane is so edge-on that 1/256 texel leads out of the triangle's range of
    /// keys, it is the mean of its corners' keys everywhere. Keys nearer than the near plane are not clamped here.
    #[inline(always)]
    pub fn tile(&self, tile: UVec2, mut sink: impl FnMut(&Facet, &Coverage)) {
        if self.is_empty_tile(tile) {
            return;
        }
        let Some(samples) = Samples::of(tile, self.setup.window, self.setup.view.sampling()) else { return };
        let mut coverage = Coverage::NOTHING;
        for list in self.lists(tile) {
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
    }

    /// True when surely no facet covers a texel of the tile. Tiles of which it is false may still turn out to be bare.
    pub fn is_empty_tile(&self, tile: UVec2) -> bool {
        self.lists(tile).all(<[u32]>::is_empty)
    }

    /// How many facets may reach a tile; each is given to [`Bins::tile`]'s `sink` if it covers a sample.
    pub fn reaching(&self, tile: UVec2) -> usize {
        self.lists(tile).map(<[u32]>::len).sum()
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

    /// Numbers of the pieces that may reach a tile, ascending from list to list; none outside [`Bins::tiles`].
    #[inline(always)]
    pub(crate) fn lists(&self, tile: UVec2) -> impl Iterator<Item = &[u32]> {
        let tiles = self.tiles();
        let lists = if tile.cmplt(tiles).all() { &self.lists[..] } else { &[] };
        let index = tile.y as usize * tiles.x as usize + tile.x as usize;
        lists.iter().map(move |lists| lists.of(index))
    }
}
