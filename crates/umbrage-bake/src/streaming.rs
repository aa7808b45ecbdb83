use glam::UVec2;
use umbrage_depth::TILE;

/// Bytes that a triangle takes while it is drawn, those of the places where it is sorted in included.
const PER_TRIANGLE: usize = 256;
/// Fewer triangles are not worth a walk over the map's tiles, and more have no use.
const TRIANGLES: (usize, usize) = (1 << 12, 1 << 24);

/// How much of a map and of its triangles is held at once while it is drawn ([`bake_streamed`](crate::bake_streamed)).
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Streaming {
    /// Bytes for the part of the map that is drawn.
    pub map_bytes: usize,
    /// Triangles that are drawn together; 0 counts as 1.
    pub triangles: usize,
}

impl Streaming {
    /// Within about so many bytes, half of them for the map and half for triangles, at 256 bytes each. One row of tiles and 4,096 triangles are
    /// held whatever the budget. A triangle that reaches very many tiles takes four more bytes for each of them.
    pub fn within(bytes: usize) -> Self {
        let triangles = (bytes / 2 / PER_TRIANGLE).clamp(TRIANGLES.0, TRIANGLES.1);
        Self { map_bytes: bytes / 2, triangles }
    }

    /// How many rows of tiles are drawn together, at most those of the map, with rows of texels whose cells take `row_bytes` in each tile.
    pub(crate) fn rows(&self, grid: UVec2, row_bytes: usize) -> u32 {
        // Of a tile there are cells, then depths; both while cells become depths.
        let tile = TILE as usize * row_bytes + (TILE * TILE) as usize * size_of::<f32>();
        let rows = self.map_bytes / (tile * grid.x as usize);
        u32::try_from(rows).unwrap_or(u32::MAX).clamp(1, grid.y)
    }
}
