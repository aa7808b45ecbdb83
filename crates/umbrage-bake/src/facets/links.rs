//! Where the first surface changes between neighbouring samples.

use super::casters::{Casters, bits};
use super::nearest::{Four, Grid, LANES, SUBTEXELS, numbers, place_of, texels};
use super::surface::Surface;
use fearless_simd::{Select, Simd, SimdBase, SimdFrom, SimdMask, f64x4};
use glam::{IVec2, USizeVec2};
use std::ops::Range;
use umbrage_depth::FacetBlock;
use umbrage_plane::Affine;
use umbrage_raster::{BIN, Lines, Runs};

/// The samples of a part, and what is seen on the links between them.
pub(super) struct Links<'a, S> {
    pub simd: S,
    pub casters: &'a Casters<'a>,
    pub surface: &'a Surface<'a>,
    pub samples: &'a [u32],
    pub grid: Grid,
    /// The part's first texel in the tile.
    pub first: IVec2,
    pub slots: i32,
    /// Samples along a texel's side.
    pub fine: usize,
}

/// Most samples along a side of a part.
const MOST: usize = 64;

/// Which links are stored: for each row and each column of samples, a bit for the link of each of its samples to the next.
pub(super) struct Stored([[u64; MOST]; 2]);

impl Stored {
    /// Whether any link of some lines is stored.
    pub fn any(&self, lines: Lines, among: Range<usize>) -> bool {
        self.0[usize::from(lines == Lines::Columns)].iter().take(among.end).skip(among.start).any(|line| *line != 0)
    }
}

/// The slots of the links of a part that see their sample's surface before another one is seen: for each row and each column, one number for each sample.
type Leading = [[[u8; MOST]; MOST]; 2];

impl<S: Simd> Links<'_, S> {
    /// A block's first sample among those of the part.
    #[inline(always)]
    fn corner(&self, block: &FacetBlock) -> USizeVec2 {
        (place_of(usize::from(block.texel), BIN as usize) - self.first).as_usizevec2() * self.fine
    }

    /// The links of blocks that are stored.
    #[inline(always)]
    pub fn stored(&self, blocks: &[FacetBlock]) -> Stored {
        let mut stored = [[0; MOST]; 2];
        for block in blocks {
            let corner = self.corner(block);
            for y in corner.y..corner.y + self.fine {
                for x in corner.x..corner.x + self.fine {
                    stored[0][y] |= u64::from(self.is_stored(Lines::Rows, [x, y])) << x;
                    stored[1][x] |= u64::from(self.is_stored(Lines::Columns, [x, y])) << y;
                }
            }
        }
        Stored(stored)
    }

    /// What the sample at the start of a link and that at its end see.
    #[inline(always)]
    fn ends(&self, lines: Lines, [x, y]: [usize; 2]) -> [u32; 2] {
        let sample = y * self.grid.side + x;
        let next = sample + if lines == Lines::Rows { 1 } else { self.grid.side };
        [self.samples[sample], self.samples[next]]
    }

    /// Whether the link of a sample to the next one is stored: both are on the map, and their planes do not meet there.
    #[inline(always)]
    fn is_stored(&self, lines: Lines, sample: [usize; 2]) -> bool {
        let [a, b] = self.ends(lines, sample);
        if a == b {
            return false;
        }
        let start = self.grid.place(sample);
        let end = start + toward(lines) * self.grid.step;
        let map = self.surface.view.size().as_ivec2() * SUBTEXELS;
        end.cmplt(map).all() && !self.surface.meet(a, b, [start, end].map(texels))
    }

    /// Fills the links of blocks, of which these are stored; `runs` are what is covered of the part's rows, and of those of its columns that have any; `keys` is room to work in.
    /// Whether no slot sees beyond `farthest`, a key; where one does, nothing is filled.
    #[inline(always)]
    pub fn fill(
        &self,
        blocks: &mut [FacetBlock],
        stored: &Stored,
        runs: [&Runs; 2],
        keys: &mut Vec<Four>,
        farthest: f64,
    ) -> bool {
        let mut leading = [[[0; MOST]; MOST]; 2];
        let is_within = match self.slots {
            // The number of vectors must be known where this is compiled; slots beyond the last are never read.
            ..=16 => self.find::<4>(stored, runs, keys, farthest, &mut leading),
            _ => self.find::<8>(stored, runs, keys, farthest, &mut leading),
        };
        if !is_within {
            return false;
        }
        let mut found = Vec::new();
        for block in blocks {
            found.clear();
            let corner = self.corner(block);
            for number in 0..self.fine * self.fine {
                let (x, y) = (corner.x + number % self.fine, corner.y + number / self.fine);
                let number = 2 * number as u16;
                if stored.0[0][y] >> x & 1 == 1 {
                    found.push((number, leading[0][y][x]));
                }
                if stored.0[1][x] >> y & 1 == 1 {
                    found.push((number + 1, leading[1][x][y]));
                }
            }
            block.links = found.as_slice().to_vec();
        }
        true
    }

    /// Finds the slots: each facet is gone through once for all of the links that it reaches.
    #[inline(always)]
    fn find<const N: usize>(
        &self,
        stored: &Stored,
        runs: [&Runs; 2],
        keys: &mut Vec<Four>,
        farthest: f64,
        leading: &mut Leading,
    ) -> bool {
        let directions = [Lines::Rows, Lines::Columns].into_iter().zip(runs).zip(stored.0.iter().zip(leading));
        for ((lines, runs), (stored, leading)) in directions {
            let mut before = [0; MOST + 1];
            for line in 0..MOST {
                before[line + 1] = before[line] + stored[line].count_ones() as usize;
            }
            keys.clear();
            keys.resize(before[MOST] * N, [f64::INFINITY; LANES]);
            let keys = keys.as_chunks_mut::<N>().0;
            self.nearest(lines, stored, &before, runs, keys);
            if farthest < f64::INFINITY && keys.as_flattened().as_flattened().iter().any(|key| *key > farthest) {
                return false;
            }
            for (line, leading) in leading.iter_mut().enumerate() {
                self.leading(lines, line, stored[line], &keys[before[line]..before[line + 1]], leading);
            }
        }
        true
    }

    /// The first slot of the first link of a line.
    #[inline(always)]
    fn first_slot(&self, lines: Lines, line: usize) -> IVec2 {
        let sample = if lines == Lines::Rows { [0, line] } else { [line, 0] };
        self.grid.place(sample) + toward(lines) * (self.gap() / 2)
    }

    /// From slot to slot, in 1/256 texel.
    #[inline(always)]
    fn gap(&self) -> i32 {
        self.grid.step / self.slots
    }

    /// The nearest keys at the slots of all links along some lines: those of a line follow the links `before` it.
    #[inline(always)]
    fn nearest<const N: usize>(
        &self,
        lines: Lines,
        stored: &[u64; MOST],
        before: &[usize; MOST + 1],
        runs: &Runs,
        keys: &mut [[Four; N]],
    ) {
        let (simd, gap, step) = (self.simd, self.gap(), self.grid.step);
        let toward = toward(lines);
        let start = self.grid.first.dot(toward);
        let infinite = f64x4::splat(simd, f64::INFINITY);
        for (facet, first, along) in runs.iter() {
            let plane = self.surface.planes[facet as usize];
            let masked = self.casters.is_masked(facet);
            // No link of the last line, which lies beyond the part, is stored.
            for ((line, stored), along) in stored.iter().enumerate().skip(first).zip(along) {
                // Those that begin before its end and end after its start.
                let (from, to) = (along.start - start, along.end - start + step - 1);
                let (from, to) = ((from >> step.ilog2()).max(0), to >> step.ilog2());
                let until = |link: i32| if link < MOST as i32 { (1 << link) - 1 } else { u64::MAX };
                let reached = stored & until(to) & !until(from);
                if reached == 0 || along.is_empty() {
                    continue;
                }
                let (from, to) = (f64x4::splat(simd, along.start.into()), f64x4::splat(simd, along.end.into()));
                let number = before[line] + (stored & until(reached.trailing_zeros() as i32)).count_ones() as usize;
                for (link, keys) in bits(reached).zip(&mut keys[number..]) {
                    let first = self.first_slot(lines, line) + toward * (step * link as i32);
                    let key = plane.at(texels(first));
                    let change = plane.at(texels(first + toward * gap)) - key;
                    let along = f64x4::splat(simd, first.dot(toward).into());
                    for (vector, nearest) in keys.iter_mut().enumerate() {
                        let slot = numbers(simd) + f64x4::splat(simd, (LANES * vector) as f64);
                        let key = change * slot + key;
                        let along = along + slot * f64x4::splat(simd, gap.into());
                        let before = f64x4::simd_from(simd, *nearest);
                        let mut is_there = along.simd_ge(from) & along.simd_lt(to);
                        if masked {
                            is_there &= key.simd_lt(before);
                            let place = |lane: usize| texels(first + toward * (gap * (LANES * vector + lane) as i32));
                            let there = self.casters.there(facet, is_there.to_bitmask(), place);
                            is_there = SimdMask::from_bitmask(simd, there);
                        }
                        *nearest = before.min(is_there.select(key, infinite)).into();
                    }
                }
            }
        }
    }

    /// Of each of a line's links how many slots, but not all, see the sample's surface before another one is seen.
    #[inline(always)]
    fn leading<const N: usize>(
        &self,
        lines: Lines,
        line: usize,
        stored: u64,
        keys: &[[Four; N]],
        leading: &mut [u8; MOST],
    ) {
        let simd = self.simd;
        let toward = toward(lines);
        let change = texels(toward * self.gap());
        let (dx, dy) = (f64x4::splat(simd, change.x), f64x4::splat(simd, change.y));
        for (link, keys) in bits(stored).zip(keys) {
            let [a, b] = self.ends(lines, if lines == Lines::Rows { [link, line] } else { [line, link] });
            let (a, b) = (self.surface.plane(a), self.surface.plane(b));
            let first = texels(self.first_slot(lines, line) + toward * (self.grid.step * link as i32));
            let (x, y) = (f64x4::splat(simd, first.x), f64x4::splat(simd, first.y));
            let mut own: u32 = 0;
            for (vector, keys) in keys.iter().enumerate() {
                let slot = numbers(simd) + f64x4::splat(simd, (LANES * vector) as f64);
                // Places are multiples of 1/256 texel: nothing is rounded.
                let at = [x + dx * slot, y + dy * slot];
                let keys = f64x4::simd_from(simd, *keys);
                let is_own = off(simd, a, at, keys).simd_le(off(simd, b, at, keys));
                own |= (is_own.to_bitmask() as u32) << (LANES * vector);
            }
            leading[link] = own.trailing_ones().min(self.slots as u32 - 1) as u8;
        }
    }
}

/// The direction of lines.
#[inline(always)]
fn toward(lines: Lines) -> IVec2 {
    if lines == Lines::Rows { IVec2::X } else { IVec2::Y }
}

/// How far keys are off a plane at some places; two that are infinite are equal.
#[inline(always)]
fn off<S: Simd>(simd: S, plane: Affine, [x, y]: [f64x4<S>; 2], keys: f64x4<S>) -> f64x4<S> {
    let own = (plane.dy * y + plane.c) + plane.dx * x;
    own.simd_eq(keys).select(f64x4::splat(simd, 0.0), (own - keys).abs())
}
