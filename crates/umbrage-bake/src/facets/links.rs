//! Where the first surface changes between neighbouring samples.

use super::casters::Casters;
use super::nearest::{SUBTEXELS, Samples, place_of, points, texels};
use super::surface::Surface;
use glam::IVec2;
use std::ops::Range;
use umbrage_depth::FacetBlock;
use umbrage_plane::{TexelRect, vectorized};
use umbrage_raster::{BIN, Lines};

const DIRECTIONS: [Lines; 2] = [Lines::Rows, Lines::Columns];

/// The samples of a tile, and what is seen on the links between them.
pub(super) struct Links<'a> {
    pub casters: &'a Casters<'a>,
    pub surface: &'a Surface<'a>,
    pub samples: &'a Samples,
    pub region: TexelRect,
    pub slots: i32,
    /// Samples along a texel's side.
    pub fine: usize,
}

/// The links of a tile that run one way, in order: line by line, and along each.
struct Way {
    lines: Lines,
    /// Words for each line.
    words: usize,
    /// Which samples of each line a link begins at, a bit each.
    begins: Vec<u64>,
    /// Links before each word, and after the last.
    before: Vec<u32>,
}

impl Way {
    fn new(lines: Lines, side: usize) -> Self {
        let words = side.div_ceil(64);
        Self { lines, words, begins: vec![0; words * side], before: Vec::new() }
    }

    fn insert(&mut self, line: usize, along: usize) {
        self.begins[line * self.words + along / 64] |= 1 << (along % 64);
    }

    /// Numbers the links.
    fn number(&mut self) {
        let mut links = 0;
        self.before = vec![0];
        self.before.extend(self.begins.iter().map(|word| {
            links += word.count_ones();
            links
        }));
    }

    /// How many there are.
    fn len(&self) -> usize {
        self.before.last().map_or(0, |links| *links as usize)
    }

    /// The number of the link that begins at a sample.
    #[inline(always)]
    fn find(&self, line: usize, along: usize) -> Option<usize> {
        let word = line * self.words + along / 64;
        let bit = 1 << (along % 64);
        (self.begins[word] & bit != 0).then(|| self.rank(word, bit))
    }

    /// The number of the first link among some of a word.
    #[inline(always)]
    fn rank(&self, word: usize, some: u64) -> usize {
        let before = self.begins[word] & (some & some.wrapping_neg()).wrapping_sub(1);
        (self.before[word] + before.count_ones()) as usize
    }

    /// The words of a line that hold samples of a range, which is not empty, each with the bits of those.
    #[inline(always)]
    fn words(&self, line: usize, along: Range<usize>) -> impl Iterator<Item = (usize, u64)> {
        let (first, last) = (along.start / 64, (along.end - 1) / 64);
        (first..=last).map(move |word| {
            let from = if word == first { u64::MAX << (along.start % 64) } else { u64::MAX };
            let to = if word == last { u64::MAX >> (63 - (along.end - 1) % 64) } else { u64::MAX };
            (word, self.begins[line * self.words + word] & from & to)
        })
    }
}

impl Links<'_> {
    /// Finds the links of all blocks.
    pub fn fill(&self, blocks: &mut [FacetBlock]) {
        let [rows, columns] = self.wanted(blocks);
        let ways = [(self.nearest(&rows), rows), (self.nearest(&columns), columns)];
        let mut found = Vec::new();
        for block in blocks {
            found.clear();
            for (number, [x, y]) in self.samples_of(block) {
                for ((keys, way), down) in ways.iter().zip(0..) {
                    let (line, along) = if way.lines == Lines::Rows { (y, x) } else { (x, y) };
                    if let Some(link) = way.find(line, along) {
                        let keys = &keys[link * self.slots as usize..][..self.slots as usize];
                        found.push((2 * number + down, self.leading(way.lines, [x, y], keys)));
                    }
                }
            }
            block.links = found.as_slice().to_vec();
        }
    }

    /// The number of each sample of a block, with its column and row in the tile.
    fn samples_of(&self, block: &FacetBlock) -> impl Iterator<Item = (u16, [usize; 2])> + use<> {
        let fine = self.fine;
        let texel = place_of(usize::from(block.texel), BIN as usize).as_usizevec2() * fine;
        (0..fine * fine).map(move |number| (number as u16, [texel.x + number % fine, texel.y + number / fine]))
    }

    /// Where the links of blocks begin: between samples on the map whose planes do not meet there.
    fn wanted(&self, blocks: &[FacetBlock]) -> [Way; 2] {
        let grid = self.samples.grid;
        let mut ways = DIRECTIONS.map(|lines| Way::new(lines, grid.parts * grid.side()));
        let map = self.surface.view.size().as_ivec2() * SUBTEXELS;
        for block in blocks {
            for (_, [x, y]) in self.samples_of(block) {
                for way in &mut ways {
                    let [a, b] = self.samples.neighbours(way.lines, [x, y]);
                    if a == b {
                        continue;
                    }
                    let (line, along, next) =
                        if way.lines == Lines::Rows { (y, x, [x + 1, y]) } else { (x, y, [x, y + 1]) };
                    let ends = [grid.place([x, y]), grid.place(next)];
                    if ends[1].cmpge(map).any() || self.surface.meet(a, b, [texels(ends[0]), texels(ends[1])]) {
                        continue;
                    }
                    way.insert(line, along);
                }
            }
        }
        ways.iter_mut().for_each(Way::number);
        ways
    }

    /// The nearest keys at the slots of all links, link by link.
    fn nearest(&self, way: &Way) -> Vec<f64> {
        vectorized!(_ => self.found(way))
    }

    #[inline(always)]
    fn found(&self, way: &Way) -> Vec<f64> {
        let grid = self.samples.grid;
        let (lines, slots, side) = (way.lines, self.slots as usize, grid.parts * grid.side());
        let mut keys = vec![f64::INFINITY; way.len() * slots];
        // Nothing behind this is nearest at any slot of a link.
        let mut farthest = vec![f64::INFINITY; way.len()];
        if keys.is_empty() {
            return keys;
        }
        let turned = |at: IVec2| if lines == Lines::Rows { at } else { IVec2::new(at.y, at.x) };
        let (first, gap) = (turned(grid.first), grid.step / self.slots);
        let (step, shift) = (grid.step.ilog2(), gap.ilog2());
        // Links that begin before the span's end, and end behind its start.
        let reached = |along: Range<i32>| {
            let from = ((along.start - first.x) >> step).max(0) as usize;
            let to = (((along.end - 1 - first.x) >> step) + 1).clamp(0, side as i32) as usize;
            from..to.max(from)
        };
        let wanted = |bounds: TexelRect| {
            let (low, high) = (turned(bounds.min), turned(bounds.max));
            let along = reached(low.x..high.x);
            let across = points(&(low.y..high.y), first.y, step, side);
            !along.is_empty()
                && across.into_iter().any(|line| way.words(line, along.clone()).any(|(_, begins)| begins != 0))
        };
        self.casters.gathered.spans(
            self.region,
            lines,
            grid.step,
            wanted,
            #[inline(always)]
            |_, facet, across, span| {
                let masked = self.casters.masks.of(facet);
                let (along, line) = (reached(span.clone()), ((across - first.y) >> step) as usize);
                // No link begins on the line beyond the tile.
                if along.is_empty() || line >= side {
                    return;
                }
                for (word, mut begins) in way.words(line, along) {
                    // One after the other: those between the first and the last all begin in the span.
                    let mut link = way.rank(line * way.words + word, begins);
                    while begins != 0 {
                        let begin = first.x + grid.step * (64 * word + begins.trailing_zeros() as usize) as i32;
                        begins &= begins - 1;
                        let own = link;
                        link += 1;
                        let start = begin + gap / 2;
                        let covered = points(&span, start, shift, slots);
                        if covered.is_empty() {
                            continue;
                        }
                        let key = facet.plane.at(texels(turned(IVec2::new(start, across))));
                        let change = facet.plane.at(texels(turned(IVec2::new(start + gap, across)))) - key;
                        let farthest = &mut farthest[own];
                        let at = |slot: usize| key + change * f64::from(slot as i32);
                        let ends = [at(covered.start), at(covered.end - 1)];
                        if ends[0] >= *farthest && ends[1] >= *farthest {
                            continue;
                        }
                        let keys = &mut keys[own * slots..][covered.clone()];
                        if let Some(masked) = masked {
                            let place = |slot: i32| texels(turned(IVec2::new(start + gap * slot, across)));
                            for (nearest, slot) in keys.iter_mut().zip(covered.start as i32..) {
                                let key = key + change * f64::from(slot);
                                if key < *nearest && self.casters.masks.is_there(masked, facet, place(slot)) {
                                    *nearest = key;
                                }
                            }
                            continue;
                        }
                        if covered.len() == slots && ends[0] < *farthest && ends[1] < *farthest {
                            *farthest = ends[0].max(ends[1]);
                        }
                        for (nearest, slot) in keys.iter_mut().zip(covered.start as i32..) {
                            let key = key + change * f64::from(slot);
                            *nearest = if key < *nearest { key } else { *nearest };
                        }
                    }
                }
            },
        );
        keys
    }

    /// How many of a link's slots, but not all, see its sample's surface before another one is seen.
    #[inline(always)]
    fn leading(&self, lines: Lines, [x, y]: [usize; 2], keys: &[f64]) -> u8 {
        let [a, b] = self.samples.neighbours(lines, [x, y]);
        let (a, b) = (self.surface.plane(a), self.surface.plane(b));
        let gap = self.samples.grid.step / self.slots;
        let toward = if lines == Lines::Rows { IVec2::X } else { IVec2::Y };
        let first = self.samples.grid.place([x, y]) + toward * (gap / 2);
        let off = |own: f64, key: f64| if own == key { 0.0 } else { (own - key).abs() };
        let mut leading = 0;
        for (slot, key) in (0..).zip(keys) {
            let at = texels(first + toward * (gap * slot));
            if off(a.at(at), *key) <= off(b.at(at), *key) {
                leading += 1;
            } else {
                break;
            }
        }
        leading.min(keys.len() as u8 - 1)
    }
}
