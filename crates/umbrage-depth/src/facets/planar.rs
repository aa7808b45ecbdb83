//! Tiles of which every texel is read alike.

use super::packed::Numbers;
use super::tile::{Cells, FacetTile, NOTHING, Planes};
use umbrage_plane::Affine;

/// The unrounded planes of a tile's texels, where it has them in a table.
#[derive(Clone, Copy)]
pub(super) struct Planar<'a> {
    planes: &'a [Affine],
    texels: Numbers<'a>,
}

impl<'a> Planar<'a> {
    /// Of a tile without a surface.
    pub const NOTHING: Self = Self { planes: &[NOTHING], texels: Numbers::ZERO };

    /// Of a tile; `None` where it keeps something else.
    #[inline(always)]
    pub fn of(tile: &'a FacetTile) -> Option<Self> {
        match &tile.cells {
            Cells::Table { planes: Planes::Exact(planes), texels } => Some(Self { planes, texels: texels.numbers() }),
            _ => None,
        }
    }

    /// The plane of a texel by its index: row · [`TILE`](crate::TILE) + column.
    #[inline(always)]
    pub fn get(&self, texel: usize) -> &'a Affine {
        &self.planes[self.texels.get(texel) as usize]
    }
}
