/// Columns and rows of a tile, in every storage that has tiles.
pub const TILE: u32 = 32;
