//! One tile of a refined map: texels, samples, and where the first surface changes between them.

use super::casters::Casters;
use super::links::Links;
use super::nearest::{Grid, Planes, SUBTEXELS, Samples, place_of, texels};
use super::refinement::Refinement;
use super::surface::Surface;
use crate::masks::Masks;
use glam::{IVec2, UVec2};
use umbrage_depth::{FacetBlock, FacetCells, NO_FACET};
use umbrage_plane::{Affine, TexelRect, View};
use umbrage_raster::{BIN, Bins, Seen};

const SIDE: usize = BIN as usize;
const CELLS: usize = SIDE * SIDE;

/// What is kept of a tile.
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

/// Texels along a side of what is looked at together, in a tile that few triangles reach: where one facet is seen all over, nothing is sampled.
const PART: usize = 8;

/// A tile of more triangles is not looked at by parts, each of which would go through them all.
const MOST_FOR_PARTS: usize = 64;

/// What of a tile is looked for.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Parts {
    /// Texels, and the samples and links of those that are refined.
    All,
    /// Texels alone.
    Texels,
}

/// What a refined map is made of.
pub(super) struct Refined<'a> {
    pub view: &'a View,
    pub bins: &'a Bins,
    pub masks: &'a Masks<'a>,
    pub refinement: &'a Refinement,
}

impl Refined<'_> {
    /// A tile's texels, samples and links; `None` when nothing reaches it.
    pub fn tile(&self, tile: UVec2, parts: Parts) -> Option<Found> {
        let Self { view, bins, masks, refinement } = *self;
        if bins.is_empty_tile(tile) {
            return None;
        }
        let origin = (tile * BIN).as_ivec2();
        let own = TexelRect::new(origin * SUBTEXELS, (origin + BIN as i32) * SUBTEXELS);
        let whole = TexelRect::new(own.min, own.max + SUBTEXELS / refinement.fine as i32);
        let casters = Casters { gathered: bins.gathered(whole), masks };
        if let Seen::One(facet) = casters.seen(whole) {
            let on_map = |texel: usize| (origin + place_of(texel, SIDE)).cmplt(view.size().as_ivec2()).all();
            let texels = (0..CELLS).map(|texel| if on_map(texel) { 0 } else { NO_FACET }).collect();
            return Some(Found { planes: vec![facet.plane], texels, blocks: Vec::new() });
        }
        let mut planes = Planes::of(casters.gathered.len());
        let first = own.min + SUBTEXELS / 2;
        let centres = Grid { first, step: SUBTEXELS, parts: 1, shift: SIDE.ilog2(), beyond: 0 };
        let texels = Samples::of(&casters, own, centres, |_| true, &mut planes);
        let texels = texels.part(0).map_or_else(Vec::new, |(facets, _)| facets.to_vec());
        let mut blocks = Vec::new();
        if parts == Parts::All {
            let (step, fine) = (SUBTEXELS / refinement.fine as i32, refinement.fine as usize);
            let side = if bins.reaching(tile) > MOST_FOR_PARTS { SIDE } else { PART };
            // One sample more to the right and downward: what lies just beyond a texel belongs to the question whether it is refined.
            let grid =
                Grid { first: own.min + step / 2, step, parts: SIDE / side, shift: (side * fine).ilog2(), beyond: 1 };
            let several = |part: usize| {
                let min = own.min + SUBTEXELS * side as i32 * place_of(part, grid.parts);
                casters.seen(TexelRect::new(min, min + SUBTEXELS * side as i32 + step)) == Seen::Several
            };
            let samples = Samples::of(&casters, whole, grid, several, &mut planes);
            let surface = Surface { view, planes: &planes.planes, tolerance: refinement.tolerance };
            let refine = Refine { surface: &surface, samples: &samples, texels: &texels, origin, fine };
            (0..grid.parts.pow(2)).for_each(|part| refine.part(part, &mut blocks));
            blocks.sort_unstable_by_key(|block: &FacetBlock| block.texel);
            let slots = refinement.slots as i32;
            let links = Links { casters: &casters, surface: &surface, samples: &samples, region: whole, slots, fine };
            links.fill(&mut blocks);
        }
        let nothing = blocks.is_empty() && texels.iter().all(|facet| *facet == NO_FACET);
        (!nothing).then_some(Found { planes: planes.planes, texels, blocks })
    }
}

/// A tile's texels and samples.
struct Refine<'a> {
    surface: &'a Surface<'a>,
    samples: &'a Samples,
    /// The planes of the texels.
    texels: &'a [u32],
    /// The tile's first texel.
    origin: IVec2,
    /// Samples along a texel's side.
    fine: usize,
}

impl Refine<'_> {
    /// Adds the blocks of those texels of a part that one plane does not do for.
    fn part(&self, part: usize, blocks: &mut Vec<FacetBlock>) {
        let Some((samples, columns)) = self.samples.part(part) else { return };
        let (grid, fine, map) = (self.samples.grid, self.fine, self.surface.view.size());
        // The part's first sample and texel in the tile, and its texels along a side.
        let corner = place_of(part, grid.parts).as_usizevec2() * grid.side();
        let (first, side) = (corner.as_ivec2() / fine as i32, grid.side() / fine);
        let place = |sample: usize| texels(grid.place([corner.x + sample % columns, corner.y + sample / columns]));
        for within in TexelRect::of_size(UVec2::splat(side as u32)).texels() {
            let texel = first + within;
            if (self.origin + texel).cmpge(map.as_ivec2()).any() {
                continue;
            }
            let texel = (texel.y * BIN as i32 + texel.x) as usize;
            let own = self.texels[texel];
            let first = within.as_usizevec2() * fine;
            let row = |y: usize, count: usize| &samples[(first.y + y) * columns + first.x..][..count];
            // The texel's samples, and the first beyond its right and lower side.
            let around = fine + 1;
            if (0..around).all(|y| row(y, around).iter().all(|seen| *seen == own)) {
                continue;
            }
            // Nothing lies beyond the map, and its border does not count as an edge.
            let on_map = |sample: usize| place(sample).cmplt(map.as_dvec2()).all();
            let mut width = None;
            let mut agrees = |k: usize| {
                let sample = (first.y + k / around) * columns + first.x + k % around;
                let seen = samples[sample];
                seen == own || !on_map(sample) || self.surface.agree(own, seen, place(sample), &mut width)
            };
            if (0..around.pow(2)).all(&mut agrees) {
                continue;
            }
            let samples = (0..fine).flat_map(|y| row(y, fine)).copied().collect();
            blocks.push(FacetBlock { texel: texel as u16, samples, links: Vec::new() });
        }
    }
}
