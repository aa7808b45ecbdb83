//! Known answers, round trips and hostile files of `umbrage-gltf`.

mod animations;
mod build;
mod cameras;
mod files;
mod hostile;
mod images;
mod lights;
mod materials;
mod meshes;
mod places;
mod round_trips;
mod skins;
mod textures;
