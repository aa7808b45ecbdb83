use glam::{IVec2, UVec2};
use rayon::prelude::*;
use umbrage_depth::{DepthRule, Tile, Tiled};
use umbrage_plane::{Facet, Facing, TexelRect, View};
use umbrage_raster::{Bins, Coverage, Cull, Stats, TILE, Triangle};

/// A depth map, and what became of the triangles.
#[derive(Clone, Debug)]
pub struct Baked {
    /// The map in its native form.
    pub map: Tiled,
    /// What the rasteriser did with the triangles.
    pub stats: Stats,
    /// Texels covered, counted once per facet: the fragments that were offered to the rule in one pass.
    pub fragments: u64,
}

/// Pass 1: draws the triangles from a light and stores one depth a texel by `rule` (R87-1; W78-1).
///
/// Works tile by tile: a tile's cells are made when its first fragment comes, and leave resolved, with their minimum and
/// maximum. Tiles that nobody touches are never allocated. What is nearer than the near plane is stored at the
/// near plane (C-10). The result does not depend on the number of threads.
pub fn bake<R: DepthRule>(view: &View, triangles: impl IntoIterator<Item = Triangle>, rule: &R, cull: Cull) -> Baked {
    let bins = Bins::new(view, TexelRect::of_size(view.size()), cull, triangles);
    let tiles = bins.tiles();
    let (made, fragments): (Vec<Option<Tile>>, Vec<u64>) = (0..tiles.x * tiles.y)
        .into_par_iter()
        .map(|index| tile(view, &bins, UVec2::new(index % tiles.x, index / tiles.x), rule))
        .unzip();
    Baked { map: Tiled::from_tiles(*view, made), stats: bins.stats(), fragments: fragments.iter().sum() }
}

/// What Reeves advises for a light's map: from once to twice the picture's resolution along each axis, starting with once
/// (R87-6). As (least, most).
pub fn advised_map_sizes(picture: UVec2) -> (UVec2, UVec2) {
    (picture, picture * 2)
}

fn tile<R: DepthRule>(view: &View, bins: &Bins, tile: UVec2, rule: &R) -> (Option<Tile>, u64) {
    const CELLS: usize = (TILE * TILE) as usize;
    let origin = (tile * TILE).as_ivec2();
    let mut cells: Option<Box<[R::Cell; CELLS]>> = None;
    let mut fragments = 0;
    for pass in 0..R::PASSES {
        bins.tile(tile, |facet, coverage| {
            let cells = cells.get_or_insert_with(|| Box::new([R::EMPTY; CELLS]));
            let front = facet.facing == Facing::Front;
            each_fragment(view, origin, facet, coverage, |cell, key| {
                rule.add(pass, &mut cells[cell], key, front, facet);
                fragments += u64::from(pass == 0);
            });
        });
    }
    let Some(cells) = cells else { return (None, 0) };
    let decode = view.decode();
    let nearest = view.key(view.near()) as f32;
    let mut depths = Box::new([f32::INFINITY; CELLS]);
    for (index, depth) in depths.iter_mut().enumerate() {
        let texel = origin + IVec2::new(index as i32 % TILE as i32, index as i32 / TILE as i32);
        let at = view.sampling().position(texel);
        // Clamped only now: a rule must tell surfaces apart that are all nearer than the near plane.
        *depth = rule.resolve(cells[index], &decode, at).max(decode.depth(nearest, at));
    }
    let valid = (view.size() - tile * TILE).min(UVec2::splat(TILE));
    (Tile::new(depths, valid), fragments)
}

/// Calls `each` with every covered texel of a tile: its index in the tile and its key.
#[inline(always)]
pub(crate) fn each_fragment(
    view: &View,
    origin: IVec2,
    facet: &Facet,
    coverage: &Coverage,
    mut each: impl FnMut(usize, f32),
) {
    for row in coverage.first..coverage.end {
        let mut bits = coverage.rows[usize::from(row)];
        while bits != 0 {
            let column = bits.trailing_zeros();
            bits &= bits - 1;
            let texel = origin + IVec2::new(column as i32, i32::from(row));
            each(usize::from(row) * TILE as usize + column as usize, facet.key(view.sampling(), texel));
        }
    }
}
