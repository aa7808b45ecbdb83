//! What is kept of triangles until tiles are filled from it.

use crate::{BIN, Stats, Triangle};
use glam::IVec2;
use umbrage_plane::{Affine, Facet, Facing};

/// The home of a piece that may reach several tiles.
pub(crate) const SEVERAL: u32 = u32::MAX;
/// The home of a piece that is known to cover no sample.
pub(crate) const NOWHERE: u32 = u32::MAX - 1;

/// Side of a patch, in texels.
pub(crate) const PATCH: i32 = 4;

/// The texels of a tile that a small triangle covers, inside a square of [`PATCH`]² whose upper left texel is the first of the triangle's
/// bounding box.
///
/// Bits 0 to 4 are that texel's column in the tile, bits 8 to 12 its row, and bit 16 + 4·y + x is set where texel (x, y) of the square is covered.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Patch(pub u32);

impl Patch {
    /// Of whatever is not known to be small.
    pub const NONE: Self = Self(0);

    /// Column and row of the upper left texel in its tile.
    #[inline(always)]
    pub fn at(self) -> (u32, u32) {
        (self.0 & (BIN - 1), self.0 >> 8 & (BIN - 1))
    }

    /// Bit 4·y + x is set where texel (x, y) is covered.
    #[inline(always)]
    pub fn covered(self) -> u32 {
        self.0 >> 16
    }
}

/// Whose a triangle is.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Owner {
    pub object: u32,
    pub sheet: bool,
}

impl Triangle {
    #[inline(always)]
    pub(crate) fn owner(&self) -> Owner {
        Owner { object: self.object, sheet: self.sheet }
    }
}

/// What is kept of a triangle: a line of a processor's cache, as pieces are read one here, one there.
#[derive(Clone, Copy, Debug)]
#[repr(align(64))]
pub(crate) struct Piece {
    pub plane: Affine,
    /// Its corners where it has three.
    pub corners: [IVec2; 3],
    /// Its [`Patch`] where it has three, otherwise the index of its first corner among those of its block.
    pub extra: u32,
    pub triangle: u32,
    pub object: u32,
    pub sides: u8,
    pub front: bool,
    pub sheet: bool,
}

impl Piece {
    #[inline(always)]
    pub fn facet(&self) -> Facet {
        Facet {
            plane: self.plane,
            facing: if self.front { Facing::Front } else { Facing::Back },
            triangle: self.triangle,
            object: self.object,
            sheet: self.sheet,
        }
    }

    /// What it covers, where that is known.
    #[inline(always)]
    pub fn patch(&self) -> Patch {
        if self.sides == 3 { Patch(self.extra) } else { Patch::NONE }
    }
}

/// log₂ of the triangles of a block: few enough for a processor's own cache.
const SHIFT: u32 = 10;
/// The triangles of a block; the last one may have fewer.
pub(crate) const SIZE: usize = 1 << SHIFT;

/// The block of a triangle, by its index.
pub(crate) fn block_of(triangle: u32) -> usize {
    (triangle >> SHIFT) as usize
}

/// The number of a piece, by its block and its place there: ascending in the order of the triangles.
pub(crate) fn number(block: usize, place: usize) -> u32 {
    (block << SHIFT | place) as u32
}

/// Block and place of a piece by its number.
#[inline(always)]
pub(crate) fn place(number: u32) -> (usize, usize) {
    ((number >> SHIFT) as usize, number as usize & (SIZE - 1))
}

/// Consecutive triangles that were set up together.
#[derive(Clone, Debug, Default)]
pub(crate) struct Block {
    /// In the order of their triangles.
    pub pieces: Vec<Piece>,
    /// Corners of those pieces that have more than three, in 1/256 texel.
    pub corners: Vec<IVec2>,
    /// The index of the only tile that each piece may reach, [`SEVERAL`] or [`NOWHERE`].
    pub homes: Vec<u32>,
    pub stats: Stats,
}

impl Block {
    /// A block without pieces, in the memory of this one, which is left without any.
    pub fn emptied(&mut self) -> Self {
        let mut block = std::mem::take(self);
        block.pieces.clear();
        block.corners.clear();
        block.homes.clear();
        block.stats = Stats::default();
        block
    }

    /// The snapped corners of one of its pieces.
    #[inline(always)]
    pub fn corners<'a>(&'a self, piece: &'a Piece) -> &'a [IVec2] {
        if piece.sides == 3 {
            &piece.corners
        } else {
            &self.corners[piece.extra as usize..][..usize::from(piece.sides)]
        }
    }
}
