use crate::Caster;
use crate::masks::Masks;
use glam::{DVec2, IVec2, UVec2};
use rayon::prelude::*;
use std::sync::Arc;
use umbrage_depth::{DepthRule, ROW, Reduction, Row, Stored, Tile, Tiled};
use umbrage_plane::{Facet, Facing, TexelRect, View, ViewError, vectorized};
use umbrage_raster::{BIN, Bins, Coverage, Cull, Stats, each_fragment, each_run};

/// A depth map, and what became of the triangles.
#[derive(Clone, Debug)]
pub struct Baked {
    /// The map in its native form, ready to be shared. It stores the rule's surface, or back faces where the nearest was drawn without its
    /// fronts.
    pub map: Arc<Tiled>,
    /// What the rasteriser did with the triangles.
    pub stats: Stats,
    /// Texels covered, counted once per facet: the fragments that were offered to the rule in one pass.
    pub fragments: u64,
}

/// Pass 1: draws the triangles from a light and stores one depth per texel by `rule`.
///
/// Works tile by tile: a tile's cells are made when its first fragment comes, and leave resolved, with their minimum and
/// maximum. Tiles that nobody touches are never allocated. What is nearer than the near plane is stored at the
/// near plane. The result does not depend on the number of threads.
///
/// `casters` are [`Triangle`](umbrage_raster::Triangle)s or [`Caster`]s.
pub fn bake<'a, R: DepthRule>(
    view: &View,
    casters: impl IntoIterator<Item: Into<Caster<'a>>>,
    rule: &R,
    cull: Cull,
) -> Baked {
    let mut masks = Masks::new(view);
    let triangles = casters.into_iter().map(|caster| masks.note(caster.into()));
    let bins = Bins::new(view, TexelRect::of_size(view.size()), cull, triangles);
    Pass { view, fine: view, rule, masks: &masks, front: BY_WINDING }.run(&bins, cull)
}

/// [`bake`] with `axis` × `axis` samples per texel, all of whose fragments count for the texel: what *hits* it, not what lies at one place
/// (Woo 1992).
///
/// First depths then are the nearest over the texel. Midpoints need [`SameSurface::Surface`](umbrage_depth::SameSurface::Surface), as one surface has several
/// depths there. Radial depths are taken along the ray of the texel's own sample.
///
/// # Errors
/// When the samples are more than a view may have: the map's sides times `axis`, 0 included.
pub fn bake_multi<'a, R: DepthRule>(
    view: &View,
    casters: impl IntoIterator<Item: Into<Caster<'a>>>,
    rule: &R,
    cull: Cull,
    axis: u32,
) -> Result<Baked, ViewError> {
    let fine = view.with_size(view.size().saturating_mul(UVec2::splat(axis)))?;
    let mut masks = Masks::new(&fine);
    let triangles = casters.into_iter().map(|caster| masks.note(caster.into()));
    let bins = Bins::new(&fine, TexelRect::of_size(fine.size()), cull, triangles);
    Ok(Pass { view, fine: &fine, rule, masks: &masks, front: BY_WINDING }.run(&bins, cull))
}

/// That a facet's own [`Facing`] says which side of it is seen, all over it.
pub(crate) const BY_WINDING: Option<fn(&Facet, DVec2) -> bool> = None;

/// What Reeves advises for a light's map: from once to twice the picture's resolution along each axis, starting with once.
/// As (least, most).
pub fn advised_map_sizes(picture: UVec2) -> (UVec2, UVec2) {
    (picture, picture * 2)
}

/// One pass 1: which depth rule, which samples, and which side of a facet is seen there.
pub(crate) struct Pass<'a, R, F> {
    /// The map's view.
    pub view: &'a View,
    /// The same with a whole number of samples along each side of a texel.
    pub fine: &'a View,
    pub rule: &'a R,
    /// Of `fine`.
    pub masks: &'a Masks<'a>,
    /// Whether a facet's outside is seen at a sample of `fine`, where that differs over the facet.
    pub front: Option<F>,
}

/// The surface that a rule stores of what was drawn.
pub(crate) fn stored(rule: &impl DepthRule, cull: Cull) -> Stored {
    match (rule.stored(), cull) {
        (Stored::First, Cull::Front) => Stored::BackFace,
        (stored, _) => stored,
    }
}

/// Whether every key of a facet in a tile is larger than one.
#[inline(always)]
fn lies_behind(facet: &Facet, tile: UVec2, key: f32) -> bool {
    // Products and sums grow with what they are made of, rounded as well: no place in the tile has a smaller key than all its corners.
    let (low, high) = ((tile * BIN).as_dvec2(), ((tile + 1) * BIN).as_dvec2());
    let corners = [low, DVec2::new(high.x, low.y), DVec2::new(low.x, high.y), high];
    corners.iter().all(|corner| facet.plane.at(*corner) as f32 > key)
}

/// Cells of a tile.
const CELLS: usize = (BIN * BIN) as usize;

/// What a reduction keeps of a tile.
pub(crate) type Cells<R> = Box<[<R as Reduction>::Row; ROW]>;

/// Fragments that take less time one by one than in runs.
const FEW: u32 = 4;

impl<R: DepthRule, F: Fn(&Facet, DVec2) -> bool + Sync> Pass<'_, R, F> {
    /// Reduces and resolves what was drawn with `fine` and `cull`.
    pub fn run(&self, bins: &Bins, cull: Cull) -> Baked {
        let grid = self.view.size().map(|side| side.div_ceil(BIN));
        let (made, fragments): (Vec<Option<Tile>>, Vec<u64>) = (0..grid.x * grid.y)
            .into_par_iter()
            .map(|index| {
                let tile = UVec2::new(index % grid.x, index / grid.x);
                vectorized!(_ => {
                    let (cells, fragments) = self.draw(bins, tile);
                    (cells.and_then(|cells| self.resolve(&cells, tile)), fragments)
                })
            })
            .unzip();
        let map = Arc::new(Tiled::from_tiles(*self.view, made).with_stored(stored(self.rule, cull)));
        Baked { map, stats: bins.stats(), fragments: fragments.iter().sum() }
    }

    /// The tile that cells become; `None` where no surface is among them.
    #[inline(always)]
    pub fn resolve(&self, rows: &[R::Row; ROW], tile: UVec2) -> Option<Tile> {
        let (sampling, origin) = (self.view.sampling(), (tile * BIN).as_ivec2());
        let nearest = self.view.key(self.view.near()) as f32;
        let mut depths = Box::new([f32::INFINITY; CELLS]);
        self.view.decode().in_loops(
            #[inline(always)]
            |decode| {
                for (y, (cells, depths)) in (0..).zip(rows.iter().zip(depths.as_chunks_mut::<ROW>().0)) {
                    // Nothing but this loop knows the row, so that what the rule holds need not be read again for each texel.
                    let mut row = [f32::INFINITY; ROW];
                    for (x, depth) in (0..).zip(&mut row) {
                        let at = sampling.position(origin + IVec2::new(x, y));
                        // Clamped only now: a rule must tell surfaces apart that are all nearer than the near plane.
                        *depth = self.rule.resolve(cells.get(x as usize), decode, at).max(decode.depth(nearest, at));
                    }
                    *depths = row;
                }
            },
        );
        Tile::new(depths, (self.view.size() - tile * BIN).min(UVec2::splat(BIN)))
    }
}

impl<R: Reduction, F: Fn(&Facet, DVec2) -> bool + Sync> Pass<'_, R, F> {
    /// A tile's cells after all fragments, `None` where there were none, and the number of fragments.
    pub fn cells(&self, bins: &Bins, tile: UVec2) -> (Option<Box<[R::Cell; CELLS]>>, u64) {
        let (cells, fragments) = vectorized!(_ => self.draw(bins, tile));
        let each = |cells: Box<[R::Row; ROW]>| Box::new(std::array::from_fn(|i| cells[i / ROW].get(i % ROW)));
        (cells.map(each), fragments)
    }

    #[inline(always)]
    fn draw(&self, bins: &Bins, tile: UVec2) -> (Option<Cells<R>>, u64) {
        let (mut cells, mut fragments) = (None, 0);
        for pass in 0..R::PASSES {
            if pass > 0 && !self.wants_more(cells.as_ref()) {
                break;
            }
            let offered = self.draw_once(pass, bins, tile, &mut cells);
            if pass == 0 {
                fragments = offered;
            }
        }
        (cells, fragments)
    }

    /// Whether a pass after the first may change a depth of a tile.
    #[inline(always)]
    pub fn wants_more(&self, cells: Option<&Cells<R>>) -> bool {
        cells.is_some_and(|cells| !self.rule.settled(cells.as_slice()))
    }

    /// One pass over what bins hold of a tile; the number of its fragments.
    #[inline(always)]
    pub fn draw_once(&self, pass: u32, bins: &Bins, tile: UVec2, cells: &mut Option<Cells<R>>) -> u64 {
        let axis = self.fine.size().x / self.view.size().x;
        let mut fragments = 0;
        // What lies behind `farthest` all over the tile need not be offered. It is looked for anew whenever twice as much has been offered
        // as the last time, so that the search takes little time where it finds nothing.
        let (mut farthest, mut offered, mut due) = (f32::INFINITY, 0, CELLS as u32);
        for part in 0..axis * axis {
            let part = tile * axis + UVec2::new(part % axis, part / axis);
            self.masks.tile(
                bins,
                part,
                #[inline(always)]
                |facet, coverage| {
                    let cells = cells.get_or_insert_with(|| Box::new([R::Row::all(R::EMPTY); ROW]));
                    let count = coverage.count();
                    fragments += u64::from(count);
                    if axis > 1 || self.front.is_some() {
                        self.add_each(pass, cells, tile, part, facet, coverage);
                    } else if count <= FEW {
                        self.add_few(pass, cells, part, facet, coverage);
                    } else if farthest == f32::INFINITY || !lies_behind(facet, part, farthest) {
                        self.add_runs(pass, cells, part, facet, coverage);
                        offered += count;
                        if offered >= due {
                            (farthest, due) = (self.rule.farthest(pass, cells), offered.saturating_mul(2));
                        }
                    }
                },
            );
        }
        fragments
    }

    /// Offers a fragment to one of the cells of a tile.
    #[inline(always)]
    fn add(&self, pass: u32, cells: &mut [R::Row; ROW], index: usize, key: f32, front: bool, facet: &Facet) {
        let (row, column) = (&mut cells[index / ROW], index % ROW);
        let mut cell = row.get(column);
        self.rule.add(pass, &mut cell, key, front, facet);
        row.set(column, cell);
    }

    /// Offers a facet to the cells of a tile, one by one.
    #[inline(always)]
    fn add_few(&self, pass: u32, cells: &mut [R::Row; ROW], tile: UVec2, facet: &Facet, coverage: &Coverage) {
        let front = facet.facing == Facing::Front;
        each_fragment(
            self.fine,
            (tile * BIN).as_ivec2(),
            facet,
            coverage,
            #[inline(always)]
            |cell, _, key| self.add(pass, cells, cell, key, front, facet),
        );
    }

    /// Offers a facet to the cells of a tile, several at a time.
    #[inline(always)]
    fn add_runs(&self, pass: u32, cells: &mut [R::Row; ROW], tile: UVec2, facet: &Facet, coverage: &Coverage) {
        let front = facet.facing == Facing::Front;
        each_run(
            self.fine,
            (tile * BIN).as_ivec2(),
            facet,
            coverage,
            #[inline(always)]
            |first, keys| {
                // Keys of NaN, which are those of the texels that are not covered, change nothing.
                self.rule.add_run(pass, &mut cells[first / ROW % ROW], first % ROW, keys, front, facet);
            },
        );
    }

    /// Offers a facet to the cells of a tile, as one of the `parts` of which it is drawn sees it.
    fn add_each(
        &self,
        pass: u32,
        cells: &mut [R::Row; ROW],
        tile: UVec2,
        part: UVec2,
        facet: &Facet,
        coverage: &Coverage,
    ) {
        let axis = self.fine.size().x / self.view.size().x;
        let (origin, first) = ((part * BIN).as_ivec2(), (tile * BIN).as_ivec2());
        each_fragment(self.fine, origin, facet, coverage, |_, at, key| {
            let front = self.front.as_ref().map_or(facet.facing == Facing::Front, |front| front(facet, at));
            let texel = (at / f64::from(axis)).as_ivec2() - first;
            let cell = (texel.y * BIN as i32 + texel.x) as usize;
            self.add(pass, cells, cell, key, front, facet);
        });
    }
}
