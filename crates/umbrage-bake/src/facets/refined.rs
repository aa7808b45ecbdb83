//! One tile of a refined map: texels, samples, and where the first surface changes between them.

use super::refinement::Refinement;
use glam::{DVec2, IVec2, UVec2};
use std::collections::HashMap;
use std::ops::Range;
use umbrage_depth::{FacetBlock, FacetCells, NO_FACET};
use umbrage_plane::{Affine, Facet, TexelRect, View};
use umbrage_raster::{BIN, Bins, Lines, Seen};

/// 1/256 texel: what corners are snapped to, and all places here are multiples of.
const SUBTEXELS: i32 = 256;
const SIDE: usize = BIN as usize;
const CELLS: usize = SIDE * SIDE;

/// Planes of a tile, each once.
#[derive(Default)]
struct Planes {
    planes: Vec<Affine>,
    /// From triangles to planes.
    index: HashMap<u32, u32>,
}

impl Planes {
    /// The index of a facet's plane, were it added; whether it has been is for [`Planes::add`].
    fn of(&self, facet: &Facet) -> u32 {
        self.index.get(&facet.triangle).copied().unwrap_or(self.planes.len() as u32)
    }

    /// Adds a facet's plane, unless it is there.
    fn add(&mut self, facet: &Facet, index: u32) {
        if index as usize == self.planes.len() {
            self.planes.push(facet.plane);
            self.index.insert(facet.triangle, index);
        }
    }
}

/// What is kept of a tile.
pub(super) struct Found {
    planes: Planes,
    texels: Vec<u32>,
    blocks: Vec<FacetBlock>,
}

impl Found {
    pub fn cells(&self) -> FacetCells<'_> {
        FacetCells { planes: &self.planes.planes, texels: &self.texels, blocks: &self.blocks }
    }
}

/// The nearest facets at the points of a square grid.
struct Nearest {
    /// Points along a side.
    side: usize,
    keys: Vec<f64>,
    facets: Vec<u32>,
}

impl Nearest {
    fn new(side: usize) -> Self {
        Self { side, keys: vec![f64::INFINITY; side * side], facets: vec![NO_FACET; side * side] }
    }

    /// Offers a plane to the points from `from` to `to` of a row; `key` is its key at the first point of the row, `dx` its change from point
    /// to point.
    #[inline(always)]
    fn offer(&mut self, row: usize, points: Range<usize>, key: f64, dx: f64, facet: u32) -> bool {
        let first = row * self.side;
        let keys = &mut self.keys[first + points.start..first + points.end];
        let facets = &mut self.facets[first + points.start..first + points.end];
        let mut any = 0;
        // Signed 32-bit counters become floats several at a time.
        for (i, (nearest, own)) in (points.start as i32..).zip(keys.iter_mut().zip(facets)) {
            let key = key + dx * f64::from(i);
            let nearer = key < *nearest;
            *nearest = if nearer { key } else { *nearest };
            *own = if nearer { facet } else { *own };
            any |= u32::from(nearer);
        }
        any != 0
    }
}

/// The points of a grid that lie in an interval: those at first + k·2^`shift`, k from 0 to count.
#[inline(always)]
fn points(along: &Range<i32>, first: i32, shift: u32, count: usize) -> Range<usize> {
    // Shifts round down, below 0 too.
    let index = |at: i32| ((at - first + (1 << shift) - 1) >> shift).clamp(0, count as i32) as usize;
    index(along.start)..index(along.end)
}

/// A place of the map in texels, of one in 1/256 texel.
fn texels(at: IVec2) -> DVec2 {
    at.as_dvec2() * (1.0 / f64::from(SUBTEXELS))
}

/// Texels along a side of what is looked at together, in a tile that few triangles reach: where one facet is seen all over, nothing is sampled.
const PART: usize = 8;

/// A tile of more triangles is not looked at by parts, each of which would go through them all.
const MOST_FOR_PARTS: usize = 64;

/// A tile's texels, samples and links; `None` when nothing reaches it.
pub(super) fn tile(view: &View, bins: &Bins, tile: UVec2, refinement: &Refinement) -> Option<Found> {
    if bins.is_empty_tile(tile) {
        return None;
    }
    let origin = (tile * BIN).as_ivec2();
    let own = TexelRect::new(origin * SUBTEXELS, (origin + BIN as i32) * SUBTEXELS);
    let step = SUBTEXELS / refinement.fine as i32;
    let mut planes = Planes::default();
    if let Seen::One(facet) = bins.seen(TexelRect::new(own.min, own.max + step)) {
        planes.add(&facet, 0);
        let on_map = |texel: usize| (origin + place_of(texel, SIDE)).cmplt(view.size().as_ivec2()).all();
        let texels = (0..CELLS).map(|texel| if on_map(texel) { 0 } else { NO_FACET }).collect();
        return Some(Found { planes, texels, blocks: Vec::new() });
    }
    let texels = nearest(bins, own, SUBTEXELS, SIDE, &mut planes).facets;
    let mut found = Found { planes, texels, blocks: Vec::new() };
    let side = if bins.reaching(tile) > MOST_FOR_PARTS { SIDE } else { PART };
    for part in 0..(SIDE / side).pow(2) {
        let first = place_of(part, SIDE / side) * side as i32;
        Part { view, bins, refinement, origin, first, side }.refine(&mut found);
    }
    found.blocks.sort_unstable_by_key(|block| block.texel);
    let nothing = found.blocks.is_empty() && found.texels.iter().all(|facet| *facet == NO_FACET);
    (!nothing).then_some(found)
}

/// Column and row of an index, row by row.
fn place_of(index: usize, columns: usize) -> IVec2 {
    IVec2::new((index % columns) as i32, (index / columns) as i32)
}

/// A square of a tile's texels.
struct Part<'a> {
    view: &'a View,
    bins: &'a Bins,
    refinement: &'a Refinement,
    /// The tile's first texel, and the square's first in it.
    origin: IVec2,
    first: IVec2,
    /// Texels along a side.
    side: usize,
}

impl Part<'_> {
    /// Adds the blocks of those texels that one plane does not do for.
    fn refine(&self, found: &mut Found) {
        let fine = self.refinement.fine as usize;
        let step = SUBTEXELS / fine as i32;
        let min = (self.origin + self.first) * SUBTEXELS;
        // One sample more to the right and downward: what lies just beyond a texel belongs to the question whether it is refined.
        let region = TexelRect::new(min, min + self.side as i32 * SUBTEXELS + step);
        if self.bins.seen(region) != Seen::Several {
            return;
        }
        let samples = nearest(self.bins, region, step, self.side * fine + 1, &mut found.planes);
        let Found { planes, texels: facets, blocks } = found;
        let surface = Surface { view: self.view, planes: &planes.planes, tolerance: self.refinement.tolerance };
        let place = |sample: usize| texels(min + step / 2 + step * place_of(sample, samples.side));
        let map = self.view.size();
        let before = blocks.len();
        for within in TexelRect::of_size(UVec2::splat(self.side as u32)).texels() {
            let texel = self.first + within;
            if (self.origin + texel).cmpge(map.as_ivec2()).any() {
                continue;
            }
            let texel = (texel.y * BIN as i32 + texel.x) as usize;
            let first = within.as_usizevec2() * fine;
            let grid =
                |side: usize| (0..side * side).map(move |k| (first.y + k / side) * samples.side + first.x + k % side);
            // Nothing lies beyond the map, and its border does not count as an edge.
            let on_map = |sample: &usize| place(*sample).cmplt(map.as_dvec2()).all();
            let own = facets[texel];
            let mut width = None;
            let mut agrees = |sample: usize| {
                let seen = samples.facets[sample];
                seen == own || !on_map(&sample) || surface.agree(own, seen, place(sample), &mut width)
            };
            if grid(fine + 1).all(&mut agrees) {
                continue;
            }
            let samples = grid(fine).map(|sample| samples.facets[sample]).collect();
            blocks.push(FacetBlock { texel: texel as u16, samples, links: Vec::new() });
        }
        if blocks.len() > before {
            let slots = self.refinement.slots as i32;
            let links = Links { bins: self.bins, region, step, slots, samples: &samples, first: self.first };
            links.fill(&surface, &mut blocks[before..], fine);
        }
    }
}

/// The nearest facets at the points of a region's grid, `side` points a side. Planes that are nearest somewhere are added to `planes`.
fn nearest(bins: &Bins, region: TexelRect, step: i32, side: usize, planes: &mut Planes) -> Nearest {
    let mut nearest = Nearest::new(side);
    let (first, shift) = (region.min + step / 2, step.ilog2());
    // Spans come facet by facet.
    let mut last = (u32::MAX, 0);
    bins.spans(region, Lines::Rows, step, |facet, y, along| {
        let points = points(&along, first.x, shift, side);
        if points.is_empty() {
            return;
        }
        if last.0 != facet.triangle {
            last = (facet.triangle, planes.of(facet));
        }
        let index = last.1;
        let key = facet.plane.at(texels(IVec2::new(first.x, y)));
        let dx = facet.plane.dx * (f64::from(step) / f64::from(SUBTEXELS));
        let row = ((y - first.y) >> shift) as usize;
        if nearest.offer(row, points, key, dx, index) {
            planes.add(facet, index);
        }
    });
    nearest
}

/// Planes over texels, and which of them are one surface.
struct Surface<'a> {
    view: &'a View,
    planes: &'a [Affine],
    tolerance: f64,
}

impl Surface<'_> {
    /// The key of a facet at a place; +∞ for none.
    fn key(&self, facet: u32, at: DVec2) -> f64 {
        self.planes.get(facet as usize).map_or(f64::INFINITY, |plane| plane.at(at))
    }

    /// Whether a sample lies on its texel's own plane, to the tolerance; `width` is that of the texel, as a key, once it is known.
    fn agree(&self, texel: u32, sample: u32, at: DVec2, width: &mut Option<f64>) -> bool {
        if texel == sample {
            return true;
        }
        if texel == NO_FACET || sample == NO_FACET {
            return false;
        }
        let (own, found) = (self.key(texel, at), self.key(sample, at));
        let width = *width.get_or_insert_with(|| self.view.key_width(own.min(found)));
        (own - found).abs() <= self.tolerance * width
    }

    /// Whether two planes meet between two places: at both they are one, but for roundings.
    fn meet(&self, a: u32, b: u32, places: [DVec2; 2]) -> bool {
        places.into_iter().all(|at| {
            let (a, b) = (self.key(a, at), self.key(b, at));
            (a - b).abs() <= 4.0 * f64::EPSILON.sqrt() * self.view.key_width(a.min(b))
        })
    }
}

/// Links between samples, and what is seen along them.
struct Links<'a> {
    bins: &'a Bins,
    region: TexelRect,
    step: i32,
    slots: i32,
    samples: &'a Nearest,
    /// Where in the tile the region begins, texels.
    first: IVec2,
}

/// A link from a sample to its neighbour.
struct Link {
    /// Which block, and its number there.
    block: usize,
    number: u16,
    /// Index of the sample in the grid.
    sample: usize,
}

impl Links<'_> {
    fn fill(&self, surface: &Surface<'_>, blocks: &mut [FacetBlock], fine: usize) {
        for lines in [Lines::Rows, Lines::Columns] {
            self.fill_lines(lines, surface, blocks, fine);
        }
        for block in blocks {
            block.links.sort_unstable();
        }
    }

    /// All links along rows, or along columns.
    fn fill_lines(&self, lines: Lines, surface: &Surface<'_>, blocks: &mut [FacetBlock], fine: usize) {
        let side = self.samples.side;
        let (next, down) = if lines == Lines::Rows { (1, 0) } else { (side, 1) };
        // By line, then along it.
        let mut links: Vec<Vec<Link>> = (0..side).map(|_| Vec::new()).collect();
        let map = surface.view.size().as_dvec2();
        for (index, block) in blocks.iter().enumerate() {
            let texel = (place_of(usize::from(block.texel), SIDE) - self.first).as_usizevec2() * fine;
            for number in 0..fine * fine {
                let (x, y) = (texel.x + number % fine, texel.y + number / fine);
                let sample = y * side + x;
                let (a, b) = (self.samples.facets[sample], self.samples.facets[sample + next]);
                let ends = [self.place(sample), self.place(sample + next)];
                if a == b || ends[1].cmpge(map).any() || surface.meet(a, b, ends) {
                    continue;
                }
                let line = if lines == Lines::Rows { y } else { x };
                links[line].push(Link { block: index, number: (2 * number + down) as u16, sample });
            }
        }
        let along = |sample: usize| if lines == Lines::Rows { sample % side } else { sample / side };
        for line in &mut links {
            line.sort_unstable_by_key(|link| along(link.sample));
        }
        // By line and sample: the first link that begins there or later.
        let mut later = vec![0_u16; side * (side + 1)];
        for (line, later) in links.iter().zip(later.chunks_exact_mut(side + 1)) {
            let mut next = 0;
            for (sample, later) in later.iter_mut().enumerate() {
                next += line[next..].iter().take_while(|link| along(link.sample) < sample).count();
                *later = next as u16;
            }
        }
        let slots = self.slots as usize;
        let mut seen: Vec<Vec<f64>> = links.iter().map(|line| vec![f64::INFINITY; line.len() * slots]).collect();
        let min = if lines == Lines::Rows { self.region.min } else { IVec2::new(self.region.min.y, self.region.min.x) };
        let (first, gap) = (min + self.step / 2, self.step / self.slots);
        let (step, shift) = (self.step.ilog2(), gap.ilog2());
        self.bins.spans(self.region, lines, self.step, |facet, across, span| {
            let line = ((across - first.y) >> step) as usize;
            if links[line].is_empty() {
                return;
            }
            // Links whose end lies behind the span's start, as far as they begin before its end.
            let sample = ((span.start - first.x) >> step).max(0) as usize;
            let from = usize::from(later[line * (side + 1) + sample.min(side)]);
            for (link, keys) in links[line].iter().zip(seen[line].chunks_exact_mut(slots)).skip(from) {
                let begin = first.x + self.step * along(link.sample) as i32;
                if begin >= span.end {
                    break;
                }
                let start = begin + gap / 2;
                let at = |at: i32| {
                    texels(if lines == Lines::Rows { IVec2::new(at, across) } else { IVec2::new(across, at) })
                };
                let key = facet.plane.at(at(start));
                let change = facet.plane.at(at(start + gap)) - key;
                let slots = points(&span, start, shift, slots);
                for (nearest, index) in keys[slots.clone()].iter_mut().zip(slots.start as i32..) {
                    let key = key + change * f64::from(index);
                    *nearest = if key < *nearest { key } else { *nearest };
                }
            }
        });
        for (line, seen) in links.iter().zip(&seen) {
            for (link, keys) in line.iter().zip(seen.chunks_exact(slots)) {
                let (a, b) = (self.samples.facets[link.sample], self.samples.facets[link.sample + next]);
                let ends = [self.place(link.sample), self.place(link.sample + next)];
                let own = |(index, key): (usize, &f64)| {
                    let at = ends[0].lerp(ends[1], (index as f64 + 0.5) / slots as f64);
                    let off = |facet: u32| {
                        let own = surface.key(facet, at);
                        if own == *key { 0.0 } else { (own - key).abs() }
                    };
                    off(a) <= off(b)
                };
                let leading = keys.iter().enumerate().take_while(|slot| own(*slot)).count().min(slots - 1);
                blocks[link.block].links.push((link.number, leading as u8));
            }
        }
    }

    fn place(&self, sample: usize) -> DVec2 {
        let side = self.samples.side;
        let at = IVec2::new((sample % side) as i32, (sample / side) as i32);
        texels(self.region.min + self.step / 2 + self.step * at)
    }
}
