//! Which pieces may reach each tile.

use crate::BIN;
use crate::piece::{Block, NOWHERE, SEVERAL, SIZE, number};
use crate::setup::{SUBTEXELS, Setup, bounds};
use glam::IVec2;
use rayon::prelude::*;

const SIDE: i32 = BIN as i32;
/// Blocks that are worth a thread of their own, at least.
const BLOCKS: usize = 8;
/// Triangles for each tile that are worth lists of their own, at least.
const PER_TILE: usize = 4;

/// Numbers of pieces, ascending within a tile: those of some consecutive blocks.
#[derive(Clone, Debug, Default)]
pub(crate) struct Lists {
    /// Where each tile's list begins in `numbers`, and where the last one ends.
    starts: Vec<usize>,
    numbers: Vec<u32>,
}

impl Lists {
    /// The list of a tile, by the tile's index.
    #[inline(always)]
    pub fn of(&self, tile: usize) -> &[u32] {
        &self.numbers[self.starts[tile]..self.starts[tile + 1]]
    }

    /// Makes the lists of some blocks, the first of which has that index: counts, adds up, fills.
    fn sort(&mut self, setup: &Setup, first: usize, blocks: &[Block]) {
        let Self { starts, numbers } = self;
        let tiles = number_of_tiles(setup);
        // A tile's count stands two places behind it. Once they are added up, the list of each begins at the place behind it, which moves on
        // with each entry, and so becomes the place where the next one begins.
        starts.clear();
        starts.resize(tiles + 2, 0);
        let counts = &mut starts[2..];
        each_home(setup, first, blocks, |_, tile| counts[tile] += 1);
        for tile in 0..tiles {
            starts[tile + 2] += starts[tile + 1];
        }
        numbers.clear();
        numbers.resize(starts[tiles + 1], 0);
        let begins = &mut starts[1..];
        each_home(setup, first, blocks, |number, tile| {
            numbers[begins[tile]] = number;
            begins[tile] += 1;
        });
    }
}

fn number_of_tiles(setup: &Setup) -> usize {
    setup.tiles().element_product() as usize
}

/// Sorts blocks into tiles, in the memory of earlier lists: one after another they hold the pieces of each tile in their
/// order. Each thread makes lists of its own, as far as there are blocks enough; so nothing need be put together.
pub(crate) fn sort(lists: &mut Vec<Lists>, setup: &Setup, blocks: &[Block]) {
    let least = BLOCKS.max(PER_TILE * number_of_tiles(setup) / SIZE);
    let parts = (blocks.len() / least).clamp(1, rayon::current_num_threads());
    lists.resize_with(parts, Lists::default);
    let bound = |part: usize| blocks.len() * part / parts;
    let sort = |(part, lists): (usize, &mut Lists)| {
        lists.sort(setup, bound(part), &blocks[bound(part)..bound(part + 1)]);
    };
    if let [lists] = &mut lists[..] {
        return sort((0, lists));
    }
    lists.par_iter_mut().enumerate().for_each(sort);
}

/// Calls `each` with the number of every piece of some blocks, in their order, and the index of every tile that it may cover.
#[inline(always)]
fn each_home(setup: &Setup, first: usize, blocks: &[Block], mut each: impl FnMut(u32, usize)) {
    for (index, block) in (first..).zip(blocks) {
        for (place, &home) in block.homes.iter().enumerate() {
            let number = number(index, place);
            match home {
                NOWHERE => {}
                SEVERAL => each_tile(setup, block.corners(&block.pieces[place]), |tile| each(number, tile)),
                _ => each(number, home as usize),
            }
        }
    }
}

/// Calls `each` with the index of every tile that a polygon may cover.
fn each_tile(setup: &Setup, corners: &[IVec2], mut each: impl FnMut(usize)) {
    let texels = setup.reach.texels(bounds(corners)).intersect(setup.window);
    let (first, last) = (texels.min.map(|v| v / SIDE), texels.max.map(|v| (v - 1) / SIDE));
    let narrow = last.x - first.x < 2 || last.y == first.y;
    let (beyond, across) = (setup.reach.beyond(), setup.tiles().x as usize);
    for row in first.y..=last.y {
        let (mut from, mut to) = (first.x, last.x);
        if !narrow {
            let (left, right) = extent(corners, row * SIDE * SUBTEXELS, (row + 1) * SIDE * SUBTEXELS + beyond);
            from = from.max(left.saturating_sub(beyond).div_euclid(SIDE * SUBTEXELS));
            to = to.min(right.div_euclid(SIDE * SUBTEXELS));
        }
        for column in from..=to {
            each(row as usize * across + column as usize);
        }
    }
}

/// Encloses x of what of the outline lies between two heights (inclusive), in 1/256 texel; (`i32::MAX`, `i32::MIN`) when nothing does.
fn extent(corners: &[IVec2], top: i32, bottom: i32) -> (i32, i32) {
    let (mut left, mut right) = (i32::MAX, i32::MIN);
    for (&a, &b) in corners.iter().zip(corners.iter().cycle().skip(1)) {
        let (a, b) = if a.y <= b.y { (a, b) } else { (b, a) };
        if a.y > bottom || b.y < top {
            continue;
        }
        let (dx, dy) = (i64::from(b.x - a.x), i64::from(b.y - a.y));
        for y in [a.y.max(top), b.y.min(bottom)] {
            let x = if dy == 0 { i64::from(a.x) } else { i64::from(a.x) + (dx * i64::from(y - a.y)).div_euclid(dy) };
            left = left.min(x as i32);
            right = right.max(x as i32 + 1);
        }
        if dy == 0 {
            left = left.min(b.x);
            right = right.max(b.x);
        }
    }
    (left, right)
}
