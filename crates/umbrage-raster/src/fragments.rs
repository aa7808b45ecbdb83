use crate::{BIN, Coverage};
use glam::{DVec2, IVec2};
use umbrage_plane::{Facet, View};

/// Calls `each` with every covered texel of a tile, row by row: its index in the tile (row × [`BIN`] + column), the place of its sample in
/// texels of the map, and the facet's key there, rounded once.
///
/// `origin` is the tile's upper left texel; `facet` and `coverage` are what [`Bins::tile`](crate::Bins::tile) gives of it, and `view` is the one
/// that its [`Bins`](crate::Bins) were made for.
#[inline(always)]
pub fn each_fragment(
    view: &View,
    origin: IVec2,
    facet: &Facet,
    coverage: &Coverage,
    mut each: impl FnMut(usize, DVec2, f32),
) {
    for row in coverage.first..coverage.end {
        let mut bits = coverage.rows[usize::from(row)];
        while bits != 0 {
            let column = bits.trailing_zeros();
            bits &= bits - 1;
            let texel = origin + IVec2::new(column as i32, i32::from(row));
            let at = view.sampling().position(texel);
            each(usize::from(row) * BIN as usize + column as usize, at, facet.plane.at(at) as f32);
        }
    }
}
