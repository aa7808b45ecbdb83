use crate::Casting;
use crate::chunks::each_chunk;
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

impl Baked {
    pub(crate) fn of(view: &View, tiles: Vec<Option<Tile>>, stored: Stored, stats: Stats, fragments: u64) -> Self {
        Self { map: Arc::new(Tiled::from_tiles(*view, tiles).with_stored(stored)), stats, fragments }
    }
}

/// Pass 1: draws the triangles from a light and stores one depth per texel by `rule`.
///
/// Works tile by tile: a tile's cells are made when its first fragment comes, and leave resolved, with their minimum and
/// maximum. Tiles that nobody touches are never allocated. What is nearer than the near plane is stored at the
/// near plane. The result does not depend on the number of threads.
///
/// Triangles are taken and drawn in chunks of 65,536, or of sixteen for each tile of the map if that is more, so that any number of them
/// takes little memory. A rule of several passes, such as [`Midpoint`](umbrage_depth::Midpoint), needs all of them again, and holds them
/// until the map is done. [`bake_streamed`](crate::bake_streamed) bounds the memory of the map as well.
///
/// `casters` are [`Triangle`](umbrage_raster::Triangle)s, [`Caster`](crate::Caster)s, or meshes of either ([`IndexedMesh`](umbrage_raster::IndexedMesh),
/// [`CasterMesh`](crate::CasterMesh)), which take less time.
pub fn bake<'a, R: DepthRule>(
    view: &View,
    casters: impl IntoIterator<Item: Into<Casting<'a>>>,
    rule: &R,
    cull: Cull,
) -> Baked {
    draw(view, view, casters, rule, cull)
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
    casters: impl IntoIterator<Item: Into<Casting<'a>>>,
    rule: &R,
    cull: Cull,
    axis: u32,
) -> Result<Baked, ViewError> {
    let fine = view.with_size(view.size().saturating_mul(UVec2::splat(axis)))?;
    Ok(draw(view, &fine, casters, rule, cull))
}

/// Triangles that are drawn before the next ones are taken, at least; they take four megabytes.
const CHUNK: usize = 1 << 16;
/// Triangles for each tile of the map that are drawn together, at least: fewer take less time than one more walk over the map.
const PER_TILE: usize = 16;

/// Draws a map with the samples of `fine`.
///
/// By chunks, as triangles that the next ones overwrite take little memory, and a system gives new memory slowly: a million small triangles
/// are drawn in half the time. A rule of several passes needs all of them again in each.
fn draw<'a, R: DepthRule>(
    view: &View,
    fine: &View,
    casters: impl IntoIterator<Item: Into<Casting<'a>>>,
    rule: &R,
    cull: Cull,
) -> Baked {
    let (mut cells, mut tiles) = (without_cells(view), Vec::new());
    let most = if R::PASSES == 1 { CHUNK.max(PER_TILE * cells.len()) } else { usize::MAX };
    let (mut stats, mut fragments) = (Stats::default(), 0);
    each_chunk(fine, TexelRect::of_size(fine.size()), cull, most, casters, |bins, masks, last| {
        let pass = Pass { view, fine, rule, masks, front: BY_WINDING };
        stats += bins.stats();
        if last {
            let (made, offered) = pass.finish(bins, std::mem::take(&mut cells));
            tiles = made;
            fragments += offered;
        } else {
            fragments += pass.draw_rows(0, bins, 0, &mut cells);
        }
    });
    Baked::of(view, tiles, stored(rule, cull), stats, fragments)
}

/// The tiles of a map in which nothing was drawn yet.
pub(crate) fn without_cells<T: Clone>(view: &View) -> Vec<Option<T>> {
    vec![None; view.size().map(|side| side.div_ceil(BIN)).element_product() as usize]
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
    /// The tiles of a map once the last triangles are drawn over what earlier ones left in all its cells, and the number of fragments.
    pub fn finish(&self, bins: &Bins, cells: Vec<Option<Cells<R>>>) -> (Vec<Option<Tile>>, u64) {
        let across = self.view.size().x.div_ceil(BIN);
        let (tiles, fragments): (_, Vec<u64>) = cells
            .into_par_iter()
            .enumerate()
            .map(|(index, mut cells)| {
                let tile = UVec2::new(index as u32 % across, index as u32 / across);
                vectorized!(_ => {
                    let fragments = self.draw(bins, tile, &mut cells);
                    (cells.and_then(|cells| self.resolve(&cells, tile)), fragments)
                })
            })
            .unzip();
        (tiles, fragments.iter().sum())
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
        let mut cells = None;
        let fragments = vectorized!(_ => self.draw(bins, tile, &mut cells));
        let each = |cells: Box<[R::Row; ROW]>| Box::new(std::array::from_fn(|i| cells[i / ROW].get(i % ROW)));
        (cells.map(each), fragments)
    }

    /// One pass over what bins hold of whole rows of tiles, whose cells are given, from row `top` down; the number of its fragments.
    pub fn draw_rows(&self, pass: u32, bins: &Bins, top: u32, cells: &mut [Option<Cells<R>>]) -> u64 {
        let across = self.view.size().x.div_ceil(BIN);
        let tiles = cells.par_iter_mut().enumerate();
        tiles
            .map(|(index, cells)| {
                let tile = UVec2::new(index as u32 % across, top + index as u32 / across);
                if pass > 0 && !self.wants_more(cells.as_ref()) {
                    return 0;
                }
                vectorized!(_ => self.draw_once(pass, bins, tile, cells))
            })
            .sum()
    }

    /// All passes over what bins hold of a tile; the number of fragments of the first.
    #[inline(always)]
    fn draw(&self, bins: &Bins, tile: UVec2, cells: &mut Option<Cells<R>>) -> u64 {
        let fragments = self.draw_once(0, bins, tile, cells);
        for pass in 1..R::PASSES {
            if !self.wants_more(cells.as_ref()) {
                break;
            }
            self.draw_once(pass, bins, tile, cells);
        }
        fragments
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
