//! Triangles set up in blocks, by several threads.

use crate::Triangle;
use crate::setup::{Block, Setup};

/// log₂ of the triangles of a block: few enough for a processor's own cache.
const SHIFT: u32 = 10;
const SIZE: usize = 1 << SHIFT;
/// Blocks that wait for each thread at most.
const WAITING: usize = 4;

/// The block of a triangle, by its index.
pub(crate) fn block_of(triangle: u32) -> usize {
    (triangle >> SHIFT) as usize
}

/// The number of a piece, by its block and its place there: ascending in the order of the triangles.
pub(crate) fn number(block: usize, place: usize) -> u32 {
    (block << SHIFT | place) as u32
}

/// Block and place of a piece by its number.
#[inline(always)]
pub(crate) fn place(number: u32) -> (usize, usize) {
    ((number >> SHIFT) as usize, number as usize & (SIZE - 1))
}

/// Sets up all triangles, in their order. They are taken from the iterator on the calling thread; blocks do not depend on the number
/// of threads.
pub(crate) fn blocks(setup: &Setup<'_>, triangles: impl Iterator<Item = Triangle>) -> Vec<Block> {
    let mut triangles = triangles.fuse();
    let mut blocks = Vec::new();
    let threads = rayon::current_num_threads();
    let mut buffer = Vec::with_capacity(SIZE);
    loop {
        take(&mut triangles, &mut buffer);
        // What fits in one block is not worth waking a thread.
        if threads == 1 || buffer.len() < SIZE {
            blocks.push(setup.block(number(blocks.len(), 0), &buffer));
            if buffer.len() < SIZE {
                return blocks;
            }
            continue;
        }
        let done = blocks.len();
        blocks.resize_with(done + threads * WAITING, Block::default);
        let mut taken = 0;
        rayon::in_place_scope(|scope| {
            for (index, block) in (done..).zip(&mut blocks[done..]) {
                if taken > 0 {
                    take(&mut triangles, &mut buffer);
                }
                if buffer.is_empty() {
                    return;
                }
                taken += 1;
                let triangles = std::mem::take(&mut buffer);
                scope.spawn(move |_| *block = setup.block(number(index, 0), &triangles));
            }
        });
        blocks.truncate(done + taken);
    }
}

/// Fills a buffer with the next triangles.
fn take(triangles: &mut impl Iterator<Item = Triangle>, buffer: &mut Vec<Triangle>) {
    buffer.clear();
    // Not `extend`: an iterator of iterators is run through faster from within.
    triangles.take(SIZE).for_each(|triangle| buffer.push(triangle));
}
