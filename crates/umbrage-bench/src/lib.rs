//! The workloads that Umbrage is measured with, and the peers that it is measured beside.
//!
//! Criterion's benches and the program behind `cargo xtask bench-report` share them, so that both measure the same triangles,
//! maps and receivers.
//!
//! * [`meshes`]: triangles for the rasteriser, from eight layers that fill the map to a million of one texel each.
//! * [`scene`]: a torus knot on a ground, its light, and the regions of it that a camera sees.
//! * [`look_ups`]: every filter over every storage, with and without the way into the light's space.
//! * [`peers`]: other ways to the same answers.
//! * [`timing`]: interleaved medians, and how far two threads get on this machine.
//! * [`report`]: the rows of the report, each beside its peer and its goal.
//! * [`scale`]: how time and memory grow with triangles, maps and pictures.
//! * [`kernels`]: the six hottest loops, alone, for counting instructions.

#![warn(missing_debug_implementations)]

pub mod kernels;
pub mod look_ups;
pub mod meshes;
pub mod peers;
pub mod raster;
pub mod report;
pub mod scale;
pub mod scene;
pub mod timing;

/// Runs something in a pool of so many threads.
///
/// # Panics
/// When the system gives no thread.
pub fn in_pool<T: Send>(threads: usize, run: impl FnOnce() -> T + Send) -> T {
    rayon::ThreadPoolBuilder::new().num_threads(threads).build().expect("threads").install(run)
}
