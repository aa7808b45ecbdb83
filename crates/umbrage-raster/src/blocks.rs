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

/// Sets up all triangles, in their order, in place of those that `blocks` held, and in their memory. They are taken from the iterator on the
/// calling thread; blocks do not depend on the number of threads.
pub(crate) fn fill(blocks: &mut Vec<Block>, setup: &Setup, triangles: impl Iterator<Item = Triangle>) {
    let mut triangles = triangles.fuse();
    let threads = rayon::current_num_threads();
    let mut buffers = vec![Vec::new(); if threads == 1 { 1 } else { threads * WAITING }];
    let mut done = 0;
    loop {
        take(&mut triangles, &mut buffers[0]);
        // What fits in one block is not worth waking a thread.
        let alone = threads == 1 || buffers[0].len() < SIZE;
        let wanted = done + if alone { 1 } else { buffers.len() };
        if blocks.len() < wanted {
            blocks.resize_with(wanted, Block::default);
        }
        if alone {
            setup.fill(&mut blocks[done], number(done, 0), &buffers[0]);
            done += 1;
            if buffers[0].len() < SIZE {
                break;
            }
            continue;
        }
        let first = done;
        rayon::in_place_scope(|scope| {
            for (block, buffer) in blocks[first..].iter_mut().zip(&mut buffers) {
                if done > first {
                    take(&mut triangles, buffer);
                }
                if buffer.is_empty() {
                    return;
                }
                let index = number(done, 0);
                scope.spawn(move |_| setup.fill(block, index, buffer));
                done += 1;
            }
        });
    }
    blocks.truncate(done);
}

/// Fills a buffer with the next triangles.
fn take(triangles: &mut impl Iterator<Item = Triangle>, buffer: &mut Vec<Triangle>) {
    buffer.clear();
    buffer.reserve(SIZE);
    // Not `extend`: an iterator of iterators is run through faster from within.
    triangles.take(SIZE).for_each(|triangle| buffer.push(triangle));
}
