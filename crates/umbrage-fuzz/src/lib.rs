//! Hostile input: where it comes from, and what must hold for every reader that is given it.
//!
//! * [`TARGETS`]: for each format that Umbrage reads, a function that takes any bytes as a file of it and panics when the reader breaks a promise.
//! * [`Mutants`]: damaged files near a good one. `tests/` gives tens of thousands of them to each target and bounds the memory that
//!   is allocated; `fuzz/` lets libFuzzer search with the same functions.
//! * [`ExrFile`]: a second reader of EXR, which checks what Umbrage writes, and a writer of EXR files that Umbrage never writes.
//!
//! Nothing here is used by other crates.

mod exr_bodies;
mod exr_file;
mod exr_part;
mod exr_seeds;
mod gltf;
mod mutate;
mod paging;
mod promises;
mod target;
mod text;
mod values;

pub use exr_bodies::{deep_exr, exr_blocks, exr_header};
pub use exr_file::ExrFile;
pub use exr_part::{Chunk, Part};
pub use exr_seeds::{cut_into_rows, cut_into_tiles, deep, facets, flat, foreign, map, view};
pub use gltf::gltf;
pub use mutate::{Dice, Mutants};
pub use paging::paging;
pub use promises::most_bytes;
pub use target::{TARGETS, Target};
pub use text::{lookup_lines, recipe};
pub use values::values;
