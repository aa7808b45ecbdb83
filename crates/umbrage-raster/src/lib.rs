//! Triangles to exact coverage, tile by tile.
use glam::{UVec2, Vec3};
use umbrage_plane::{Facet, TexelRect, View};

/// Side of a tile, in texels.
pub const TILE: u32 = 32;

/// A triangle in world space, counter-clockwise as seen from its outside.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Triangle {
    /// World-space corners.
    pub corners: [Vec3; 3],
    /// Id of the object it belongs to.
    pub object: u32,
    /// True for a piece of an open, two-sided surface.
    pub sheet: bool,
}

/// Which triangles are left out by the side a view sees of them. Sheets are never culled.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Default)]
pub enum Cull {
    /// None.
    #[default]
    None,
    /// Those whose outside is seen.
    Front,
    /// Those whose inside is seen.
    Back,
}

/// The texels of one tile that a facet covers.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Coverage {
    /// Bit x of row y: texel (x, y) of the tile is covered.
    pub rows: [u32; 32],
    /// First row with a bit set.
    pub first: u8,
    /// One past the last row with a bit set.
    pub end: u8,
}

/// What became of the triangles that were given.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Default)]
pub struct Stats {
    /// Triangles given.
    pub given: u64,
    /// With a NaN, infinite or ≥ 1e30 coordinate: skipped.
    pub not_finite: u64,
    /// Without area (in the world, or after snapping): skipped.
    pub zero_area: u64,
    /// Culled by facing.
    pub culled: u64,
    /// Wholly outside the window or behind the view.
    pub outside: u64,
    /// Cut at the near limit or at the guard band.
    pub clipped: u64,
    /// Nearer than the near plane somewhere; their depths are clamped to it.
    pub before_near: u64,
}

/// Triangles sorted into the tiles of a view.
pub struct Bins {}

impl Bins {
    /// Sorts.
    pub fn new(_view: &View, _window: TexelRect, _cull: Cull, _triangles: impl IntoIterator<Item = Triangle>) -> Self {
        todo!()
    }
    /// Number of tiles across and down.
    pub fn tiles(&self) -> UVec2 {
        todo!()
    }
    /// Calls `sink` for each facet that covers a texel of the tile.
    pub fn tile(&self, _tile: UVec2, _sink: impl FnMut(&Facet, &Coverage)) {
        todo!()
    }
    /// Counts.
    pub fn stats(&self) -> Stats {
        todo!()
    }
}
