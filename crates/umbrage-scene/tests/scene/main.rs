//! Laws and known answers of `umbrage-scene`.

mod framing;
mod figures;
mod gallery;
mod lights;
mod meshes;
mod patches;
mod trees;
