//! Hostile input: what is done with it, and where it comes from.
//!
//! * [`TARGETS`]: for each format that Umbrage reads, a function that takes any bytes as a file of it and panics when a promise is broken.
//! * [`Mutants`]: damaged files near a good one. `tests/` puts tens of thousands of them through each target and holds the memory that
//!   is taken; `fuzz/` puts libFuzzer's own through the same functions.
//! * [`ExrFile`]: a second reader of EXR, to which what we write is held, and the writer of EXR files that we do not write.
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
