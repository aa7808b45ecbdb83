//! Laws and known answers of `umbrage-scene`.

mod gallery;
mod lights;
mod meshes;
mod patches;
