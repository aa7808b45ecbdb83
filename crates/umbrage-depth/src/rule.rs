use crate::{Hit, Stored};
use glam::{DVec2, IVec2};
use umbrage_plane::{Affine, Decode, Facet, Facing, View};

/// Makes one cell of all the fragments that meet a texel: what a map keeps while it is drawn.
///
/// The result does not depend on the fragments' order, so that neither threads nor tiling can change a bit. Reductions see keys
/// ([`Affine`]); a [`DepthRule`] makes a depth of the cell in the end, other maps (objects' ids, for one) use the cell as it is.
pub trait Reduction: Sync {
    /// What is kept per texel while fragments arrive.
    type Cell: Copy + Send;
    /// The cells of a tile's row together: `[Self::Cell; ROW]`, unless vector instructions want them in another order.
    type Row: Row<Self::Cell>;
    /// A texel that no fragment has met.
    const EMPTY: Self::Cell;
    /// How often all fragments are offered: render passes.
    const PASSES: u32 = 1;

    /// Offers one fragment in pass `pass`, counted from 0: its key at the texel's sample position and whether its outside is seen there. A key
    /// of NaN changes nothing.
    fn add(&self, pass: u32, cell: &mut Self::Cell, key: f32, front: bool, facet: &Facet);

    /// [`Reduction::add`] of one facet's fragments to the [`RUN`] cells of a row from `first` on, a multiple of [`RUN`], one each; another way
    /// to the same cells where there is one that becomes vector instructions more easily.
    #[inline(always)]
    fn add_run(&self, pass: u32, row: &mut Self::Row, first: usize, keys: &[f32; RUN], front: bool, facet: &Facet) {
        // It is so already; this shows that no index can be out of bounds.
        let first = first & (ROW - RUN);
        for (column, key) in (first..).zip(keys) {
            let mut cell = row.get(column);
            self.add(pass, &mut cell, *key, front, facet);
            row.set(column, cell);
        }
    }

    /// A key such that a fragment with a larger one would change no cell of a tile in this pass: then it may be left out. +∞ unless a reduction
    /// knows better.
    #[inline(always)]
    fn farthest(&self, _pass: u32, _rows: &[Self::Row; ROW]) -> f32 {
        f32::INFINITY
    }

    /// Whether the passes after the first, all of whose fragments these rows have met, would change no depth made of them: then the passes
    /// may be left out. False unless a reduction knows better.
    #[inline(always)]
    fn settled(&self, _rows: &[Self::Row]) -> bool {
        false
    }
}

/// Cells that [`Reduction::add_run`] takes at a time.
pub const RUN: usize = 8;

/// Cells of a [`Row`]: those of a row of a tile.
pub const ROW: usize = crate::TILE as usize;

/// The cells of a row of a tile: an array of them, or an array of each of their numbers.
pub trait Row<C>: Copy + Send {
    /// The same cell for each texel.
    fn all(cell: C) -> Self;
    /// The cell of a column of the tile. Panics from [`ROW`] on.
    fn get(&self, column: usize) -> C;
    /// Changes the cell of a column of the tile. Panics from [`ROW`] on.
    fn set(&mut self, column: usize, cell: C);
}

impl<C: Copy + Send> Row<C> for [C; ROW] {
    #[inline(always)]
    fn all(cell: C) -> Self {
        [cell; ROW]
    }

    #[inline(always)]
    fn get(&self, column: usize) -> C {
        self[column]
    }

    #[inline(always)]
    fn set(&mut self, column: usize, cell: C) {
        self[column] = cell;
    }
}

/// A key, or +∞ in place of NaN: neither changes a smallest key. The minimum of two numbers is a single instruction, whereas a choice that depends on whether the
/// key is NaN would become a masked store, which is slow on some processors.
#[inline(always)]
pub(crate) fn number(key: f32) -> f32 {
    if key.is_nan() { f32::INFINITY } else { key }
}

/// The largest of a tile's keys, none of which is NaN, by their rows.
#[inline(always)]
pub(crate) fn largest<'a>(rows: impl Iterator<Item = &'a [f32; ROW]>) -> f32 {
    // Column by column, so that rows are compared in vectors.
    let mut largest = [f32::NEG_INFINITY; ROW];
    for row in rows {
        for (largest, key) in largest.iter_mut().zip(row) {
            *largest = if *key > *largest { *key } else { *largest };
        }
    }
    largest.into_iter().fold(f32::NEG_INFINITY, f32::max)
}

/// Which of the surfaces behind a texel is stored: a [`Reduction`] whose cell becomes a depth.
pub trait DepthRule: Reduction {
    /// Which surface the depths of this rule belong to; [`Stored::Other`] for a rule that none of the others name.
    fn stored(&self) -> Stored;

    /// The depth to store, at the texel's sample position; +∞ where nothing is.
    fn resolve(&self, cell: Self::Cell, decode: &Decode, at: DVec2) -> f32;

    /// The depth that a map of `view` stores at `texel` if a ray through the texel's sample meets these surfaces, in any order: for maps made by
    /// one's own ray caster. +∞ where there is nothing to store.
    ///
    /// The hits go through the same [`Reduction`] as the rasteriser's fragments, and what is nearer than the near plane is stored at it as there:
    /// hits at a fragment's own distance store its very bits. Hits whose distance is NaN are ignored. All hits count, those behind the first too;
    /// ones behind the light (negative ζ in perspective) are the caller's to leave out.
    ///
    /// ```
    /// use glam::{DVec3, IVec2, UVec2};
    /// use umbrage_depth::{BackFace, DepthRule, First, Hit, Midpoint};
    /// use umbrage_plane::View;
    ///
    /// let lamp = View::perspective(DVec3::Z * 9.0, DVec3::ZERO, DVec3::Y, 1.0, 1.0, 99.0, UVec2::splat(8))?;
    /// // A ray through a box: its top 4 units from the lamp, its bottom 6.
    /// let hits = [Hit::back(6.0), Hit::front(4.0)];
    /// let texel = IVec2::new(3, 5);
    /// assert_eq!(First.of(&lamp, texel, hits), 4.0);
    /// assert_eq!(BackFace.of(&lamp, texel, hits), 6.0);
    /// assert_eq!(Midpoint::default().of(&lamp, texel, hits), 5.0);
    /// assert_eq!(First.of(&lamp, texel, []), f32::INFINITY);
    /// # Ok::<(), umbrage_plane::ViewError>(())
    /// ```
    fn of<H>(&self, view: &View, texel: IVec2, hits: H) -> f32
    where
        H: IntoIterator<Item = Hit, IntoIter: Clone>,
        Self: Sized,
    {
        let hits = hits.into_iter();
        let mut cell = Self::EMPTY;
        for pass in 0..Self::PASSES {
            for hit in hits.clone() {
                let plane = Affine::constant(view.key(hit.zeta));
                let facing = if hit.front { Facing::Front } else { Facing::Back };
                let facet = Facet { plane, facing, triangle: 0, object: hit.object, sheet: hit.sheet };
                self.add(pass, &mut cell, plane.c as f32, hit.front, &facet);
            }
        }
        let (decode, at) = (view.decode(), view.sampling().position(texel));
        self.resolve(cell, &decode, at).max(decode.depth(view.key(view.near()) as f32, at))
    }
}
