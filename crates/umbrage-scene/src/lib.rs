//! Meshes, bicubic patches, materials, textures, lights and the gallery of the papers' scenes.
//!
//! Pure data: a [`Scene`] is objects, lights and a camera, and nothing in it is drawn or cast here. Cameras and lights are
//! [`umbrage_plane::View`]s, whose [conventions](umbrage_plane#conventions) hold throughout; y is up in
//! the gallery's pictures.
//!
//! ```
//! use umbrage_scene::gallery;
//!
//! let scene = gallery::sphere_plane();
//! let mesh = scene.objects[0].shape.mesh_for(&scene.lights[0].view);
//! assert!(mesh.is_closed());
//! let (toward_light, arriving) = scene.lights[0].incident(glam::DVec3::ZERO);
//! assert!(toward_light.z > 0.0 && arriving.x > 0.0);
//! ```
//!
//! This crate opens no file: `umbrage-gltf` reads and writes scenes. It has no features.

mod cover;
mod dice;
mod framing;
pub mod gallery;
mod knot;
mod light;
mod mesh;
mod patch;
mod scene;
mod solids;
mod teapot;
mod texture;
pub mod tree;
mod turn;
mod turned;

pub use cover::Cover;
pub use dice::{MOST_PIECES, dice};
pub use framing::{Ball, FrameError, fit};
pub use light::Light;
pub use mesh::{Mesh, MeshError};
pub use patch::{Basis, Patch};
pub use scene::{Material, Object, Scene, Shape};
pub use teapot::utah_teapot;
pub use texture::{Interpolation, Texture, TextureError, Wrap};
pub use turn::Bearing;
