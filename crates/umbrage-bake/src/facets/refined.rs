//! One tile of a refined map: texels, samples, and where the first surface changes between them.

use super::casters::Casters;
use super::hidden::Hidden;
use super::links::Links;
use super::nearest::{Four, Grid, SUBTEXELS, Seen, farthest, place_of, set, texels};
use super::refinement::Refinement;
use super::surface::Surface;
use crate::masks::Masks;
use fearless_simd::Simd;
use glam::{IVec2, UVec2};
use std::ops::Range;
use umbrage_depth::{FacetBlock, FacetCells, NO_FACET};
use umbrage_plane::{Affine, TexelRect, View, vectorized};
use umbrage_raster::{BIN, Bins, Lines, Runs, Shown};

const SIDE: usize = BIN as usize;
const CELLS: usize = SIDE * SIDE;

/// What is stored of a tile.
pub(super) struct Found {
    planes: Vec<Affine>,
    texels: Vec<u32>,
    blocks: Vec<FacetBlock>,
}

impl Found {
    pub fn cells(&self) -> FacetCells<'_> {
        FacetCells { planes: &self.planes, texels: &self.texels, blocks: &self.blocks }
    }
}

/// Texels along a side of a part that is processed together: where one facet covers all of it, nothing is sampled.
const PART: usize = 8;

/// In a tile that more triangles reach, the keys of all samples begin at the tile's left side, not at that of each part.
const CROWDED: usize = 64;

/// Parts along a tile's side.
const PARTS: usize = SIDE / PART;

/// What is computed of a tile.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Parts {
    /// Texels, and the samples and links of those that are refined.
    All,
    /// Texels alone.
    Texels,
}

/// Buffers that are written anew for each tile, and kept so that nothing is allocated for it.
#[derive(Default)]
pub(super) struct Scratch {
    shown: Vec<Shown>,
    /// The facets that may reach each part.
    lists: Vec<Vec<u32>>,
    hidden: Hidden,
    rows: Runs,
    columns: Runs,
    seen: Seen,
    /// The keys of the slots of links.
    keys: Vec<Four>,
    samples: Vec<u32>,
}

/// The inputs of a refined map.
pub(super) struct Refined<'a> {
    pub view: &'a View,
    pub bins: &'a Bins,
    pub masks: &'a Masks<'a>,
    pub refinement: &'a Refinement,
}

impl Refined<'_> {
    /// A tile's texels, samples and links; `None` when nothing reaches it.
    pub fn tile(&self, tile: UVec2, parts: Parts, scratch: &mut Scratch) -> Option<Found> {
        if self.bins.is_empty_tile(tile) {
            return None;
        }
        vectorized!(simd => self.found(simd, tile, parts, scratch))
    }

    #[inline(always)]
    fn found<S: Simd>(&self, simd: S, tile: UVec2, parts: Parts, scratch: &mut Scratch) -> Option<Found> {
        let Self { view, bins, masks, refinement } = *self;
        let origin = (tile * BIN).as_ivec2();
        let own = TexelRect::new(origin * SUBTEXELS, (origin + BIN as i32) * SUBTEXELS);
        let (step, fine) = (SUBTEXELS / refinement.fine as i32, refinement.fine as usize);
        let whole = TexelRect::new(own.min, own.max + step);
        let casters = Casters { gathered: bins.gathered(whole), masks };
        let all = 0..casters.gathered.len() as u32;
        if !all.clone().any(|number| casters.gathered.bounds(number).0.cmplt(own.max).all()) {
            return None;
        }
        let Scratch { shown, lists, hidden, rows, columns, seen, keys, samples } = scratch;
        casters.shown(whole, all.clone(), shown);
        let on_map = |texel: IVec2| (origin + texel).cmplt(view.size().as_ivec2()).all();
        if let Some(one) = casters.one(shown) {
            let plane = casters.gathered.facet(one).plane;
            let texel = |texel: usize| if on_map(place_of(texel, SIDE)) { 0 } else { NO_FACET };
            let is_whole = on_map(IVec2::splat(SIDE as i32 - 1));
            let texels = if is_whole { vec![0; CELLS] } else { (0..CELLS).map(texel).collect() };
            return Some(Found { planes: vec![plane], texels, blocks: Vec::new() });
        }
        let planes: Vec<Affine> = all.map(|number| casters.gathered.facet(number).plane).collect();
        lists.resize_with(PARTS * PARTS, Vec::new);
        lists.iter_mut().for_each(Vec::clear);
        for Shown { number, .. } in shown.drain(..) {
            let (low, high) = casters.gathered.bounds(number);
            let part = |at: IVec2| (at - own.min) / (PART as i32 * SUBTEXELS);
            let (from, to) =
                (part(low.max(own.min) - step).max(IVec2::ZERO), part(high).min(IVec2::splat(PARTS as i32 - 1)));
            for part in TexelRect::new(from, to + 1).texels() {
                lists[part.y as usize * PARTS + part.x as usize].push(number);
            }
        }
        let crowded = bins.reaching(tile) > CROWDED;
        let mut texels = vec![NO_FACET; CELLS];
        let mut blocks = Vec::new();
        let surface = Surface { view, planes: &planes, tolerance: refinement.tolerance };
        let side = PART * fine + 1;
        samples.resize(side * side, NO_FACET);
        for (part, list) in lists.iter().enumerate() {
            let first = place_of(part, PARTS) * PART as i32;
            let min = (origin + first) * SUBTEXELS;
            let region = TexelRect::new(min, min + PART as i32 * SUBTEXELS);
            let beyond = TexelRect::new(min, region.max + step);
            casters.shown(beyond, list.iter().copied(), shown);
            if shown.is_empty() {
                continue;
            }
            let mut put = |y: usize, facets: &[u32]| {
                texels[(first.y as usize + y) * SIDE + first.x as usize..][..PART].copy_from_slice(facets);
            };
            if let Some(one) = casters.one(shown) {
                for y in 0..PART {
                    let row: [u32; PART] = std::array::from_fn(|x| {
                        if on_map(first + IVec2::new(x as i32, y as i32)) { one } else { NO_FACET }
                    });
                    put(y, &row);
                }
                continue;
            }
            let at_centres = shown.iter().filter(|shown| holds_centre(casters.gathered.bounds(shown.number)));
            let band = casters.gathered.band(region, Lines::Rows, SUBTEXELS);
            set(simd, rows, band, |_| true, at_centres);
            let centres =
                Grid { first: min + SUBTEXELS / 2, step: SUBTEXELS, side: PART, from: own.min.x + SUBTEXELS / 2 };
            let [mut near, mut far] = [f64::INFINITY, f64::NEG_INFINITY];
            centres.nearest(
                simd,
                &casters,
                &planes,
                rows,
                seen,
                #[inline(always)]
                |y, facets, keys| {
                    put(y, facets);
                    far = far.max(farthest(simd, keys, PART));
                    near = near.min(keys[0][0]);
                },
            );
            if parts == Parts::Texels {
                continue;
            }
            hidden.take(&casters, beyond, shown, [near, far]);
            let band = |lines| casters.gathered.band(beyond, lines, step);
            let from = if crowded { own.min.x } else { min.x } + step / 2;
            let grid = Grid { first: min + step / 2, step, side, from };
            loop {
                set(simd, rows, band(Lines::Rows), |_| true, &*shown);
                let mut is_hidden = true;
                grid.nearest(
                    simd,
                    &casters,
                    &planes,
                    rows,
                    seen,
                    #[inline(always)]
                    |y, facets, keys| {
                        samples[y * side..][..side].copy_from_slice(facets);
                        is_hidden &= hidden.least == f64::INFINITY || farthest(simd, keys, side) < hidden.least;
                    },
                );
                if is_hidden {
                    break;
                }
                hidden.put_back(shown);
            }
            let before = blocks.len();
            let refine = Refine { surface: &surface, samples, grid, texels: &texels, origin, first, fine };
            refine.part(&mut blocks);
            if blocks.len() > before {
                let slots = refinement.slots as i32;
                let links = Links { simd, casters: &casters, surface: &surface, samples, grid, first, slots, fine };
                let stored = links.stored(&blocks[before..]);
                let wants = |lines: Range<usize>| stored.any(Lines::Columns, lines);
                loop {
                    set(simd, columns, band(Lines::Columns), wants, &*shown);
                    if links.fill(&mut blocks[before..], &stored, [rows, columns], keys, hidden.least) {
                        break;
                    }
                    hidden.put_back(shown);
                    set(simd, rows, band(Lines::Rows), |_| true, &*shown);
                }
            }
        }
        blocks.sort_unstable_by_key(|block: &FacetBlock| block.texel);
        let nothing = blocks.is_empty() && texels.iter().all(|facet| *facet == NO_FACET);
        (!nothing).then_some(Found { planes, texels, blocks })
    }
}

/// Whether the centre of a texel lies between the least and the greatest coordinates of a facet, in 1/256 texel. Of facets that are smaller than texels,
/// few are at any.
#[inline(always)]
fn holds_centre((low, high): (IVec2, IVec2)) -> bool {
    let before = |at: IVec2| (at + (SUBTEXELS / 2 - 1)) >> SUBTEXELS.ilog2();
    before(low).cmplt(before(high)).all()
}

/// A part's samples, and its tile's texels.
struct Refine<'a> {
    surface: &'a Surface<'a>,
    samples: &'a [u32],
    grid: Grid,
    /// The planes of the texels.
    texels: &'a [u32],
    /// The tile's first texel, and the part's in the tile.
    origin: IVec2,
    first: IVec2,
    /// Samples along a texel's side.
    fine: usize,
}

impl Refine<'_> {
    /// One bit for each texel of a row, set where the texel differs from one of its `FINE`² samples or from one of the first beyond its right and lower
    /// side. Most do not differ, so all samples are compared without a branch for each.
    #[inline(always)]
    fn differing<const FINE: usize>(&self, row: usize) -> u32 {
        let texels = (self.first.y as usize + row) * SIDE + self.first.x as usize;
        let own: &[u32; PART] = self.texels[texels..].first_chunk().expect("a part of a tile");
        let (mut all, side) = ([0; PART], PART * FINE + 1);
        for row in row * FINE..=(row + 1) * FINE {
            let samples = &self.samples[row * side..][..side];
            for (x, all) in all.iter_mut().enumerate() {
                *all = samples[x * FINE..=(x + 1) * FINE].iter().fold(*all, |all, seen| all | (seen ^ own[x]));
            }
        }
        (0..).zip(all).fold(0, |bits, (x, differing)| bits | u32::from(differing != 0) << x)
    }

    /// Adds the blocks of those texels of a part for which one plane is not enough.
    #[inline(always)]
    fn part(&self, blocks: &mut Vec<FacetBlock>) {
        let (grid, fine, map) = (self.grid, self.fine, self.surface.view.size());
        let columns = grid.side;
        let differing: [u32; PART] = std::array::from_fn(|row| match fine {
            2 => self.differing::<2>(row),
            4 => self.differing::<4>(row),
            _ => self.differing::<8>(row),
        });
        for within in TexelRect::of_size(UVec2::splat(PART as u32)).texels() {
            if differing[within.y as usize] >> within.x & 1 == 0 {
                continue;
            }
            let texel = self.first + within;
            if (self.origin + texel).cmpge(map.as_ivec2()).any() {
                continue;
            }
            let texel = (texel.y * BIN as i32 + texel.x) as usize;
            let own = self.texels[texel];
            let first = within.as_usizevec2() * fine;
            let row = |y: usize, count: usize| &self.samples[(first.y + y) * columns + first.x..][..count];
            // The texel's samples, and the first beyond its right and lower side.
            let around = fine + 1;
            let mut width = None;
            let mut agrees = |x: usize, y: usize, seen: u32| {
                let place = grid.place([first.x + x, first.y + y]);
                // Nothing lies beyond the map, and its border does not count as an edge.
                let on_map = place.cmplt(map.as_ivec2() * SUBTEXELS).all();
                !on_map || self.surface.agree(own, seen, texels(place), &mut width)
            };
            let mut is_flat = true;
            for y in 0..around {
                for (x, &seen) in row(y, around).iter().enumerate() {
                    is_flat = is_flat && (seen == own || agrees(x, y, seen));
                }
            }
            if is_flat {
                continue;
            }
            let mut samples = Vec::with_capacity(fine * fine);
            (0..fine).for_each(|y| samples.extend_from_slice(row(y, fine)));
            blocks.push(FacetBlock { texel: texel as u16, samples, links: Vec::new() });
        }
    }
}
