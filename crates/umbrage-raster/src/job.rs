//! What one thread sets up at a time, in memory that is used again.

use crate::Triangle;
use crate::eight::{Corner, Shared, by_eights, project_all};
use crate::mesh::{Geometry, IndexedMesh};
use crate::piece::{Block, SIZE};
use crate::setup::Setup;
use glam::Vec3;
use std::ops::ControlFlow;
use std::sync::{Mutex, PoisonError};
use umbrage_plane::vectorized;

/// Blocks of a mesh that are set up together: the more triangles, the more of their corners are shared, and the more memory they take.
const TOGETHER: usize = 8;

/// Consecutive triangles that are set up together: whole blocks of a mesh, or those of one block.
#[derive(Default)]
pub(crate) struct Job<'a> {
    mesh: Option<IndexedMesh<'a>>,
    /// Those of one block: [`SIZE`] of them, or fewer where they are the last.
    triangles: Vec<Triangle>,
}

/// The memory for corners that triangles of a mesh share: as much as threads work in, which is less than there are jobs.
#[derive(Default)]
pub(crate) struct Scratch(Mutex<Vec<Vec<Corner>>>);

impl Scratch {
    fn take(&self) -> Vec<Corner> {
        self.0.lock().unwrap_or_else(PoisonError::into_inner).pop().unwrap_or_default()
    }

    fn give(&self, corners: Vec<Corner>) {
        self.0.lock().unwrap_or_else(PoisonError::into_inner).push(corners);
    }
}

impl Job<'_> {
    /// How many blocks they fill.
    pub fn blocks(&self) -> usize {
        self.mesh.as_ref().map_or(1, |mesh| mesh.len() / SIZE)
    }

    /// Whether they are known to be the last.
    pub fn is_last(&self) -> bool {
        self.mesh.is_none() && self.triangles.len() < SIZE
    }

    /// Sets them up in place of those that the blocks hold; `first` is the index of the first of them.
    pub fn run(&mut self, setup: &Setup, scratch: &Scratch, first: u32, blocks: &mut [Block]) {
        let Self { mesh, triangles } = self;
        let Some(mesh) = mesh else {
            let [block] = blocks else { unreachable!("they are those of one block") };
            return setup.fill(block, first, triangles.len(), |making| vectorized!(_ => making.add_all(triangles)));
        };
        // Where corners are mostly a triangle's own, or lie far apart, each triangle computes its own.
        let near = |(_, positions): &(u32, &[Vec3])| positions.len() <= 2 * mesh.len() && by_eights(&setup.view);
        let mut corners = scratch.take();
        let shared = mesh.positions().filter(near).map(|(first, positions)| {
            vectorized!(_ => project_all(&setup.view, mesh.origin(), positions, &mut corners));
            Shared { first, corners: &corners }
        });
        for (block, start) in blocks.iter_mut().zip((0..).step_by(SIZE)) {
            let range = start..start + SIZE;
            setup.fill(block, first + start as u32, SIZE, |making| {
                if let Some(shared) = shared {
                    vectorized!(_ => making.add_shared(mesh, range, shared));
                } else {
                    triangles.clear();
                    triangles.extend(range.map(|index| mesh.triangle(index)));
                    vectorized!(_ => making.add_all(triangles));
                }
            });
        }
        scratch.give(corners);
    }
}

/// Cuts what triangles come in into jobs.
pub(crate) struct Jobs<'a, I> {
    geometry: I,
    /// What is left of a mesh.
    rest: Option<IndexedMesh<'a>>,
}

impl<'a, I: Iterator<Item: Into<Geometry<'a>>>> Jobs<'a, I> {
    /// Of an iterator that goes on ending once it has ended.
    pub fn of(geometry: I) -> Self {
        Self { geometry, rest: None }
    }

    /// The next job, in the memory of one that has been run.
    pub fn next(&mut self, mut job: Job<'a>) -> Job<'a> {
        job.mesh = self.fill(&mut job.triangles);
        job
    }

    /// Whole blocks of a mesh, or the next triangles, which take the place of those before.
    fn fill(&mut self, triangles: &mut Vec<Triangle>) -> Option<IndexedMesh<'a>> {
        triangles.clear();
        triangles.reserve(SIZE);
        loop {
            if let Some(mesh) = &mut self.rest {
                if triangles.is_empty() && mesh.len() >= SIZE {
                    return Some(mesh.split_to((mesh.len() / SIZE).min(TOGETHER) * SIZE));
                }
                triangles.extend(mesh.split_to(SIZE - triangles.len()).triangles());
                self.rest.take_if(|mesh| mesh.is_empty());
            }
            if triangles.len() == SIZE {
                return None;
            }
            // From within, as an iterator of iterators is run through faster so.
            let next = self.geometry.try_for_each(|geometry| match geometry.into() {
                Geometry::Mesh(mesh) => ControlFlow::Break(Some(mesh)),
                Geometry::Triangle(triangle) => {
                    triangles.push(triangle);
                    if triangles.len() == SIZE { ControlFlow::Break(None) } else { ControlFlow::Continue(()) }
                }
            });
            match next {
                ControlFlow::Break(Some(mesh)) => self.rest = Some(mesh),
                _ => return None,
            }
        }
    }
}
