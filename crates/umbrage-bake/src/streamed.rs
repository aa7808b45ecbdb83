//! Pass 1 of more triangles, or of a larger map, than memory holds.

use crate::chunks::each_chunk;
use crate::masks::Masks;
use crate::pass1::{BY_WINDING, Cells, Pass};
use crate::{Casting, Streaming};
use glam::{IVec2, UVec2};
use rayon::prelude::*;
use umbrage_depth::{DepthRule, Tile};
use umbrage_plane::{TexelRect, View, vectorized};
use umbrage_raster::{BIN, Cull, Stats};

/// What became of the triangles of [`bake_streamed`].
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Streamed {
    /// What the rasteriser did with the triangles.
    pub stats: Stats,
    /// As [`Baked::fragments`](crate::Baked::fragments).
    pub fragments: u64,
    /// How many bands the map was drawn in.
    pub bands: u32,
    /// How many chunks the triangles were taken in.
    pub chunks: u64,
}

/// [`bake`](crate::bake) with memory bounded by `streaming`, whatever the number of triangles and the size of the map: the map is drawn in
/// bands of whole rows of tiles, the triangles come in chunks, and neither the map nor the triangles are ever held as a whole.
///
/// `casters` is called for every walk over the triangles and must give the same ones each time: once for each band and each pass of the rule,
/// and once more where there are several bands, to count. A renderer gives an iterator over its own scene, or one that reads a file.
///
/// `each` is given the rows of tiles from the top, ⌈height/32⌉ in all, with one entry for each of the ⌈width/32⌉ tiles of a row and `None` for those
/// without a surface. All of them in a row make the map of [`bake`](crate::bake), bit for bit:
///
/// ```
/// use glam::{DVec3, UVec2};
/// use std::convert::Infallible;
/// use umbrage_bake::{Streaming, bake, bake_streamed};
/// use umbrage_depth::{First, Tiled};
/// use umbrage_plane::View;
/// use umbrage_raster::{Cull, Triangle};
///
/// let lamp = View::perspective(DVec3::Z * 10.0, DVec3::ZERO, DVec3::Y, 1.0, 1.0, 20.0, UVec2::splat(256))?;
/// // A strip of many triangles, none of which is kept.
/// let strip = || {
///     (0..10_000).map(|i| {
///         let x = f64::from(i) * 1e-3 - 5.0;
///         Triangle::new([(x, -1.0), (x + 1e-3, -1.0), (x, 1.0)].map(|(x, y)| DVec3::new(x, y, 0.0)), 0, true)
///     })
/// };
/// let mut tiles = Vec::new();
/// let baked = bake_streamed(&lamp, strip, &First, Cull::None, Streaming::within(1 << 20), |row| {
///     tiles.extend(row);
///     Ok::<(), Infallible>(())
/// })?;
/// assert_eq!(baked.stats.given, 10_000);
/// assert_eq!(Tiled::from_tiles(lamp, tiles), *bake(&lamp, strip(), &First, Cull::None).map);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
///
/// The surface that is stored is the one that the rule [stores](DepthRule::stored), or the back face where the nearest is drawn without its
/// fronts, as in [`bake`](crate::bake).
///
/// # Errors
/// The first error of `each`, after which nothing more is drawn.
pub fn bake_streamed<'a, R: DepthRule, I, E>(
    view: &View,
    mut casters: impl FnMut() -> I,
    rule: &R,
    cull: Cull,
    streaming: Streaming,
    mut each: impl FnMut(Vec<Option<Tile>>) -> Result<(), E>,
) -> Result<Streamed, E>
where
    I: IntoIterator<Item: Into<Casting<'a>>>,
{
    let grid = view.size().map(|side| side.div_ceil(BIN));
    let rows = streaming.rows(grid, size_of::<R::Row>());
    let band = |top: u32| Band { view, rule, grid, top, rows: rows.min(grid.y - top) };
    let mut streamed = Streamed { stats: Stats::default(), fragments: 0, bands: 0, chunks: 0 };
    if rows < grid.y {
        // A triangle counts once, however many bands it reaches.
        let whole = TexelRect::of_size(view.size());
        each_chunk(view, whole, cull, streaming.triangles, casters(), |bins, _, _| streamed.stats += bins.stats());
    }
    for top in (0..grid.y).step_by(rows as usize) {
        let band = band(top);
        let mut cells: Vec<Option<Cells<R>>> = vec![None; (grid.x * band.rows) as usize];
        for pass in 0..R::PASSES {
            if pass > 0 && !band.wants_more(&cells) {
                break;
            }
            each_chunk(view, band.window(), cull, streaming.triangles, casters(), |bins, masks, _| {
                let fragments = band.pass(masks).draw_rows(pass, bins, band.top, &mut cells);
                if pass == 0 {
                    streamed.fragments += fragments;
                    streamed.chunks += 1;
                    if rows == grid.y {
                        streamed.stats += bins.stats();
                    }
                }
            });
        }
        streamed.bands += 1;
        let mut tiles = band.resolve(cells).into_iter();
        for _ in 0..band.rows {
            each(tiles.by_ref().take(grid.x as usize).collect())?;
        }
    }
    Ok(streamed)
}

/// Whole rows of tiles of a map that is drawn.
struct Band<'a, R> {
    view: &'a View,
    rule: &'a R,
    /// Columns and rows of tiles of the whole map.
    grid: UVec2,
    /// Its first row of tiles, and how many it has.
    top: u32,
    rows: u32,
}

impl<R: DepthRule> Band<'_, R> {
    /// Its texels.
    fn window(&self) -> TexelRect {
        let rows = UVec2::new(self.top, self.top + self.rows) * BIN;
        let window = TexelRect::new(IVec2::new(0, rows.x as i32), IVec2::new(self.view.size().x as i32, rows.y as i32));
        window.intersect(TexelRect::of_size(self.view.size()))
    }

    /// A tile of the map, by its place in the band.
    fn tile(&self, index: usize) -> UVec2 {
        UVec2::new(index as u32 % self.grid.x, self.top + index as u32 / self.grid.x)
    }

    fn pass<'p>(&'p self, masks: &'p Masks<'p>) -> Pass<'p, R, fn(&umbrage_plane::Facet, glam::DVec2) -> bool> {
        Pass { view: self.view, fine: self.view, rule: self.rule, masks, front: BY_WINDING }
    }

    fn wants_more(&self, cells: &[Option<Cells<R>>]) -> bool {
        let masks = Masks::new(self.view);
        let pass = self.pass(&masks);
        cells.iter().any(|cells| pass.wants_more(cells.as_ref()))
    }

    /// The tiles that the cells become.
    fn resolve(&self, cells: Vec<Option<Cells<R>>>) -> Vec<Option<Tile>> {
        let masks = Masks::new(self.view);
        let pass = self.pass(&masks);
        let tiles = cells.into_par_iter().enumerate();
        tiles
            .map(|(index, cells)| {
                let cells = cells?;
                vectorized!(_ => pass.resolve(&cells, self.tile(index)))
            })
            .collect()
    }
}
