//! Where the first surface changes between neighbouring samples.

use super::casters::Casters;
use super::nearest::{Grid, SUBTEXELS, Spans, place_of, points, texels};
use super::surface::Surface;
use glam::IVec2;
use umbrage_depth::FacetBlock;
use umbrage_raster::{BIN, Lines};

/// The samples of a part, and what is seen on the links between them.
pub(super) struct Links<'a> {
    pub casters: &'a Casters<'a>,
    pub surface: &'a Surface<'a>,
    pub samples: &'a [u32],
    pub grid: Grid,
    /// The part's first texel in the tile.
    pub first: IVec2,
    /// The coverage of the part's rows and columns.
    pub spans: [&'a Spans; 2],
    pub slots: i32,
    /// Samples along a texel's side.
    pub fine: usize,
}

impl Links<'_> {
    /// Finds the links of blocks.
    #[inline(always)]
    pub fn fill(&self, blocks: &mut [FacetBlock]) {
        let fine = self.fine;
        let mut found = Vec::new();
        for block in blocks {
            found.clear();
            let corner = (place_of(usize::from(block.texel), BIN as usize) - self.first).as_usizevec2() * fine;
            for number in 0..fine * fine {
                let sample = [corner.x + number % fine, corner.y + number / fine];
                let number = 2 * number as u16;
                found.extend(self.link(Lines::Rows, sample).map(|slots| (number, slots)));
                found.extend(self.link(Lines::Columns, sample).map(|slots| (number + 1, slots)));
            }
            block.links = found.as_slice().to_vec();
        }
    }

    /// The link of a sample to the next one, where it is stored: both are on the map, and their planes do not meet there.
    #[inline(always)]
    fn link(&self, lines: Lines, [x, y]: [usize; 2]) -> Option<u8> {
        let grid = self.grid;
        let sample = y * grid.side + x;
        let (next, beyond) =
            if lines == Lines::Rows { ([x + 1, y], sample + 1) } else { ([x, y + 1], sample + grid.side) };
        let [a, b] = [self.samples[sample], self.samples[beyond]];
        if a == b {
            return None;
        }
        let ends = [grid.place([x, y]), grid.place(next)];
        let map = self.surface.view.size().as_ivec2() * SUBTEXELS;
        if ends[1].cmpge(map).any() || self.surface.meet(a, b, ends.map(texels)) {
            return None;
        }
        Some(self.leading(lines, [a, b], ends[0]))
    }

    /// How many slots of the link of a sample to the next, but not all, see the sample's surface before another one is seen.
    #[inline(always)]
    fn leading(&self, lines: Lines, [a, b]: [u32; 2], sample: IVec2) -> u8 {
        let mut keys = [f64::INFINITY; MOST_SLOTS];
        let keys = &mut keys[..self.slots as usize];
        self.nearest(lines, sample, keys);
        let (a, b) = (self.surface.plane(a), self.surface.plane(b));
        let gap = self.grid.step / self.slots;
        let toward = if lines == Lines::Rows { IVec2::X } else { IVec2::Y };
        let first = sample + toward * (gap / 2);
        let off = |own: f64, key: f64| if own == key { 0.0 } else { (own - key).abs() };
        // One bit for each slot, and no end before the last, so that several are compared at a time.
        let mut own: u32 = 0;
        for (slot, key) in (0..).zip(&*keys) {
            let at = texels(first + toward * (gap * slot));
            own |= u32::from(off(a.at(at), *key) <= off(b.at(at), *key)) << slot;
        }
        let leading = own.trailing_ones() as u8;
        leading.min(keys.len() as u8 - 1)
    }

    /// The nearest keys at the slots of the link from a sample to the next.
    #[inline(always)]
    fn nearest(&self, lines: Lines, sample: IVec2, keys: &mut [f64]) {
        let Grid { first, step, .. } = self.grid;
        let turned = |at: IVec2| if lines == Lines::Rows { at } else { IVec2::new(at.y, at.x) };
        let (begin, across) = turned(sample).into();
        let line = (across - turned(first).y) / step;
        let gap = step / self.slots;
        let start = begin + gap / 2;
        let place = |slot: i32| texels(turned(IVec2::new(start + gap * slot, across)));
        for span in self.spans[usize::from(lines == Lines::Columns)].line(line as usize) {
            if span.along.start >= begin + step || span.along.end <= begin {
                continue;
            }
            let covered = points(&span.along, start, gap.ilog2(), keys.len());
            if covered.is_empty() {
                continue;
            }
            let plane = self.surface.plane(span.facet);
            let key = plane.at(place(0));
            let change = plane.at(place(1)) - key;
            let slots = (covered.start as i32..).zip(&mut keys[covered]);
            if span.masked {
                let facet = self.casters.gathered.facet(span.facet);
                for (slot, nearest) in slots {
                    let key = key + change * f64::from(slot);
                    if key < *nearest && self.casters.is_there(&facet, place(slot)) {
                        *nearest = key;
                    }
                }
                continue;
            }
            for (slot, nearest) in slots {
                let key = key + change * f64::from(slot);
                *nearest = if key < *nearest { key } else { *nearest };
            }
        }
    }
}

/// Most slots of a link.
const MOST_SLOTS: usize = 32;
