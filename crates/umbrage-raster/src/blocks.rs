//! Triangles set up in blocks, by several threads.

use crate::job::{Job, Jobs, Scratch};
use crate::mesh::Geometry;
use crate::piece::{Block, number};
use crate::setup::Setup;
use std::sync::mpsc;

/// Jobs that wait for each other thread at most.
const WAITING: usize = 4;

/// Sets up all triangles, in their order, in place of those that `blocks` held, and in their memory. What they come in is taken on the
/// calling thread, which sets blocks up as well when enough of them wait for the others; blocks do not depend on the number of threads.
pub(crate) fn fill<'a>(blocks: &mut Vec<Block>, setup: &Setup, geometry: impl IntoIterator<Item: Into<Geometry<'a>>>) {
    let mut jobs = Jobs::of(geometry.into_iter().fuse());
    let most = (rayon::current_num_threads() - 1) * WAITING;
    let (finished, results) = mpsc::channel();
    let scratch = Scratch::default();
    let (mut done, mut waiting, mut count) = (Vec::new(), 0, 0);
    rayon::in_place_scope(|scope| {
        loop {
            let mut job: Job<'a> = jobs.next(done.pop().unwrap_or_default());
            let (first, last) = (count, job.is_last());
            count += job.blocks();
            if blocks.len() < count {
                blocks.resize_with(count, Block::default);
            }
            let mut made: Vec<Block> = blocks[first..count].iter_mut().map(std::mem::take).collect();
            for (first, made, job) in results.try_iter() {
                put(blocks, first, made);
                done.push(job);
                waiting -= 1;
            }
            // What fits in one block is not worth waking a thread.
            if last || waiting == most {
                job.run(setup, &scratch, number(first, 0), &mut made);
                put(blocks, first, made);
                done.push(job);
            } else {
                let (finished, scratch) = (finished.clone(), &scratch);
                scope.spawn(move |_| {
                    job.run(setup, scratch, number(first, 0), &mut made);
                    // The receiver outlives the scope.
                    let _ = finished.send((first, made, job));
                });
                waiting += 1;
            }
            if last {
                break;
            }
        }
    });
    for (first, made, _) in results.try_iter() {
        put(blocks, first, made);
    }
    blocks.truncate(count);
}

/// Puts blocks back where they were taken from.
fn put(blocks: &mut [Block], first: usize, made: Vec<Block>) {
    blocks[first..].iter_mut().zip(made).for_each(|(block, made)| *block = made);
}
