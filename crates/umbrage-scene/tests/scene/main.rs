//! Laws and known answers of `umbrage-scene`.

mod figures;
mod framing;
mod gallery;
mod lights;
mod meshes;
mod patches;
mod rays;
mod reconstructions;
mod rolling;
mod textures;
mod trees;
mod turns;
