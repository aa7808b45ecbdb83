//! Triangles set up in blocks, by several threads.

use crate::Triangle;
use crate::piece::Block;
use crate::setup::Setup;
use std::sync::mpsc;

/// log₂ of the triangles of a block: few enough for a processor's own cache.
const SHIFT: u32 = 10;
const SIZE: usize = 1 << SHIFT;
/// Blocks that wait for each other thread at most.
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

/// Sets up all triangles, in their order, in place of those that `blocks` held, and in their memory. They are taken from the iterator on the
/// calling thread, which sets blocks up as well when enough of them wait for the others; blocks do not depend on the number of threads.
pub(crate) fn fill(blocks: &mut Vec<Block>, setup: &Setup, triangles: impl Iterator<Item = Triangle>) {
    let mut triangles = triangles.fuse();
    let most = (rayon::current_num_threads() - 1) * WAITING;
    let (finished, results) = mpsc::channel();
    let (mut buffers, mut waiting, mut count) = (Vec::new(), 0, 0);
    rayon::in_place_scope(|scope| {
        loop {
            let mut buffer = buffers.pop().unwrap_or_default();
            take(&mut triangles, &mut buffer);
            let (index, last) = (count, buffer.len() < SIZE);
            if blocks.len() == index {
                blocks.push(Block::default());
            }
            let mut block = std::mem::take(&mut blocks[index]);
            for (index, block, buffer) in results.try_iter() {
                blocks[index] = block;
                buffers.push(buffer);
                waiting -= 1;
            }
            // What fits in one block is not worth waking a thread.
            if last || waiting == most {
                setup.fill(&mut block, number(index, 0), &buffer);
                blocks[index] = block;
                buffers.push(buffer);
            } else {
                let finished = finished.clone();
                scope.spawn(move |_| {
                    setup.fill(&mut block, number(index, 0), &buffer);
                    // The receiver outlives the scope.
                    let _ = finished.send((index, block, buffer));
                });
                waiting += 1;
            }
            count += 1;
            if last {
                break;
            }
        }
    });
    for (index, block, _) in results.try_iter() {
        blocks[index] = block;
    }
    blocks.truncate(count);
}

/// Fills a buffer with the next triangles.
fn take(triangles: &mut impl Iterator<Item = Triangle>, buffer: &mut Vec<Triangle>) {
    buffer.clear();
    buffer.reserve(SIZE);
    // Not `extend`: an iterator of iterators is run through faster from within.
    triangles.take(SIZE).for_each(|triangle| buffer.push(triangle));
}
