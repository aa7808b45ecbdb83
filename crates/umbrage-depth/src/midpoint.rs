use crate::rule::{largest, number};
use crate::{DepthRule, ROW, RUN, Reduction, Row, Stored};
use glam::DVec2;
use umbrage_plane::{Decode, Facet};

/// Between the two nearest surfaces, so that the nearest is lit and the second shadowed without any bias
/// (Woo 1992). A texel with fewer than two stores nothing.
///
/// The depth is averaged in world distance along the axis whatever the map's kind. Surfaces that coincide count as one,
/// or shared edges and sheets would store their own depth and shadow themselves. Whether two coincide is
/// tested with the nearest alone, in a second pass; merging them as they arrive would depend on their order. Where the two smallest
/// keys already are apart, no second pass is needed.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub struct Midpoint {
    /// Where between the two: 0 excluded, ½ is Woo's, 1 is the second surface.
    pub ratio: f32,
    /// Surfaces whose distances differ by no more than this fraction of the larger are one.
    pub merge: f32,
    /// Which fragments belong to one surface.
    pub same: SameSurface,
}

/// Which fragments of a texel belong to one surface (Woo 1992).
#[derive(Clone, Copy, Debug, PartialEq, Eq, Default)]
pub enum SameSurface {
    /// Those at one depth, whatever their objects.
    #[default]
    Depth,
    /// Those at one depth, of one object.
    Object,
    /// Those of one object that face the same way, at any depth: for texels that are sampled at several places, where one surface has
    /// several depths (Woo 1992). An object that folds over itself loses shadow between its own folds.
    Surface,
}

umbrage_plane::builders!([] Midpoint { with_ratio ratio: f32, with_merge merge: f32, with_same same: SameSurface });

impl Default for Midpoint {
    fn default() -> Self {
        Self { ratio: 0.5, merge: 1e-6, same: SameSurface::Depth }
    }
}

/// What [`Midpoint`] keeps of a texel while fragments arrive.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct MidpointCell {
    /// The smallest key.
    first: f32,
    /// The smallest key among other surfaces. Of [`SameSurface::Depth`] it is the second smallest key of all before a second pass has found
    /// another; if it coincides with `first`, no other surface has been found yet.
    second: f32,
    /// The smallest object id at `first`, and whether its outside is seen there; [`SameSurface::Depth`] leaves it alone.
    object: (u32, bool),
}

/// What [`Midpoint`] keeps of a tile's row.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct MidpointRow {
    first: [f32; ROW],
    second: [f32; ROW],
    object: [(u32, bool); ROW],
}

impl Row<MidpointCell> for MidpointRow {
    #[inline(always)]
    fn all(MidpointCell { first, second, object }: MidpointCell) -> Self {
        Self { first: [first; ROW], second: [second; ROW], object: [object; ROW] }
    }

    #[inline(always)]
    fn get(&self, column: usize) -> MidpointCell {
        MidpointCell { first: self.first[column], second: self.second[column], object: self.object[column] }
    }

    #[inline(always)]
    fn set(&mut self, column: usize, cell: MidpointCell) {
        (self.first[column], self.second[column], self.object[column]) = (cell.first, cell.second, cell.object);
    }
}

impl Reduction for Midpoint {
    type Cell = MidpointCell;
    type Row = MidpointRow;
    const EMPTY: MidpointCell = MidpointCell { first: f32::INFINITY, second: f32::INFINITY, object: (u32::MAX, true) };
    const PASSES: u32 = 2;

    #[inline(always)]
    fn add(&self, pass: u32, cell: &mut MidpointCell, key: f32, front: bool, facet: &Facet) {
        let object = (facet.object, front);
        if pass == 0 {
            if self.same == SameSurface::Depth {
                (cell.first, cell.second) = two_smallest(cell.first, cell.second, key);
            } else if key < cell.first {
                (cell.first, cell.object) = (key, object);
            } else if key == cell.first {
                cell.object = cell.object.min(object);
            }
        } else if key < self.second(cell) && !self.is_first(cell, key, object) {
            cell.second = key;
        }
    }

    #[inline(always)]
    fn add_run(&self, pass: u32, row: &mut MidpointRow, first: usize, keys: &[f32; RUN], front: bool, facet: &Facet) {
        let first = first & (ROW - RUN);
        if pass > 0 || self.same != SameSurface::Depth {
            for (column, key) in (first..).zip(keys) {
                let mut cell = row.get(column);
                self.add(pass, &mut cell, *key, front, facet);
                row.set(column, cell);
            }
            return;
        }
        for (column, key) in (first..).zip(keys) {
            (row.first[column], row.second[column]) = two_smallest(row.first[column], row.second[column], *key);
        }
    }

    #[inline(always)]
    fn farthest(&self, pass: u32, rows: &[MidpointRow; ROW]) -> f32 {
        if pass == 0 && self.same == SameSurface::Depth {
            largest(rows.iter().map(|row| &row.second))
        } else {
            f32::INFINITY
        }
    }

    #[inline(always)]
    fn settled(&self, rows: &[MidpointRow]) -> bool {
        // Of a negative or missing `merge`, not even equal keys coincide.
        let mut settled = self.same == SameSurface::Depth && self.merge >= 0.0;
        for row in rows {
            for i in 0..ROW {
                settled &= (row.second[i] == f32::INFINITY) | !self.coincide(row.first[i], row.second[i]);
            }
        }
        settled
    }
}

/// The two smallest different keys, in order, once another has come; NaN changes nothing.
#[inline(always)]
fn two_smallest(first: f32, second: f32, key: f32) -> (f32, f32) {
    let key = number(key);
    let farther = if key > first { key } else { first };
    let other = if key == first { f32::INFINITY } else { farther };
    // Minima, because choices would become masked stores, which are slow on some processors.
    (first.min(key), second.min(other))
}

impl DepthRule for Midpoint {
    fn stored(&self) -> Stored {
        Stored::Midpoint
    }

    #[inline(always)]
    fn resolve(&self, cell: MidpointCell, decode: &Decode, at: DVec2) -> f32 {
        let second = self.second(&cell);
        let ratio = f64::from(self.ratio);
        let zeta = decode.zeta(cell.first) * (1.0 - ratio) + decode.zeta(second) * ratio;
        if second == f32::INFINITY { f32::INFINITY } else { decode.depth_of_zeta(zeta, at) }
    }
}

impl Midpoint {
    /// The smallest key that is known of another surface; +∞ where none is.
    #[inline(always)]
    fn second(&self, cell: &MidpointCell) -> f32 {
        let stale = self.same == SameSurface::Depth && self.coincide(cell.first, cell.second);
        if stale { f32::INFINITY } else { cell.second }
    }

    /// Whether a fragment belongs to the nearest surface.
    #[inline(always)]
    fn is_first(&self, cell: &MidpointCell, key: f32, object: (u32, bool)) -> bool {
        match self.same {
            SameSurface::Depth => self.coincide(cell.first, key),
            SameSurface::Object => self.coincide(cell.first, key) && object.0 == cell.object.0,
            SameSurface::Surface => object == cell.object,
        }
    }

    /// Whether a key is at the depth of the smallest.
    ///
    /// Keys are ζ or −1/ζ; of both, a difference relative to the larger key is one of ζ relative to the larger ζ.
    #[inline(always)]
    fn coincide(&self, first: f32, key: f32) -> bool {
        let (first, key) = (f64::from(first), f64::from(key));
        key - first <= f64::from(self.merge) * first.abs().max(key.abs())
    }
}
