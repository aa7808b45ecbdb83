//! glTF 2.0 scenes with their lights and cameras, read with suspicion, and written.
//!
//! [`read`] makes an [`umbrage_scene::Scene`] of a `.glb` file, or of a `.gltf` file with the files beside it; [`decode`] does it
//! for bytes, and [`encode`] writes a scene.
//!
//! ```
//! use umbrage_gltf::{ReadOptions, decode, encode};
//! use umbrage_scene::gallery;
//!
//! let room = gallery::spot_room();
//! let import = decode(&encode(&room)?, None, "room", &ReadOptions::default().with_map_size(256))?;
//! assert_eq!(import.scene.objects.len(), room.objects.len());
//! assert_eq!(import.scene.lights[0].view.near(), room.lights[0].view.near());
//! # Ok::<(), umbrage_gltf::GltfError>(())
//! ```
//!
//! # What is read
//!
//! * **Nodes**, as translation, rotation and scale or as matrices, composed in f64; copies by `EXT_mesh_gpu_instancing`. Positions are rounded to
//!   f32 once, about an origin in the middle of scenes that lie far away. Where a transform mirrors, the winding of triangles is turned.
//! * **Meshes**: triangles, strips and fans, with indices or without, with normals or flat; accessors that are sparse, interleaved,
//!   normalised or quantised (`KHR_mesh_quantization`); skins and morph targets. Each primitive of each place is an object. It is
//!   solid when the mesh is closed by position, over all its primitives and before the transform. Every triangle casts from both sides.
//! * **Animations**, at one moment: linear, step and cubic. Without a moment all stands as the file has it.
//! * **Materials**: the base colour as a matt surface, by its factor, the colours of vertices (`COLOR_0`, without alpha), and its texture: PNG or JPEG,
//!   with `KHR_texture_transform`. `MASK` cuts holes where the
//!   texture's alpha says so. `BLEND` lets 1 − alpha of the light pass, by factor and texture, and is a hole where the texture's
//!   alpha is 0. An image that cannot be read is noted, unless it cuts holes: then the file is refused.
//! * **Cameras** of both kinds. They and lights look along the −z axis of their node, whatever mirrors or shears it.
//! * **Lights** of `KHR_lights_punctual`. A spot's edge is that of [`Cone`](umbrage_scene::tree::Cone), smooth between its two angles.
//!
//! A scene without a camera or without lights gets sensible ones, and a note says so. Nothing else is added.
//!
//! # How bright lights are
//!
//! Candela and lux of a file range over many powers of ten. One factor for all lights makes what arrives at the middle of the scene's box from all of
//! them together, unshadowed and on a surface that faces each, 1 in its brightest channel; cones and ranges do not count. A
//! lamp within half the box's radius of the middle counts as if it were that far away.
//!
//! # What `extras` add
//!
//! Of a light's node, else of the light:
//!
//! | field | of | meaning |
//! |---|---|---|
//! | `shadow: {"type": "perspective", "near": n, "far": f}` | spots, point lights | the range of the light's maps, world units along their axes; a spot's map is the square of twice its outer cone angle |
//! | `shadow: {.., "outside": "lit"}`, or `"dark"` | spots | there is no cone, and what lies outside the map is lit, or dark |
//! | `shadow: {"type": "orthographic", "half": h, "near": n, "far": f}` | suns | the map reaches `h` world units to every side of the node's −z axis |
//! | `radius: r` | spots, point lights | the radius of the light's body, world units, unscaled |
//! | `angle: a` | suns | the radius of the sun's disc, radians |
//! | `casts: false` | lights, and nodes with meshes | without shadows |
//! | `receives: false` | nodes with meshes | never in shadow |
//!
//! Without a window a lamp's maps reach from its nearest caster to the farthest point of the scene, and a sun's map holds all of it.
//!
//! # Files are not trusted
//!
//! Every number of a thing, offset, length and count is checked before it is used, sizes are counted against
//! [`ReadOptions::max_bytes`] before they are allocated, and every fault is one line that names the field, its value, and what was expected
//! ([`GltfError`]). Buffers are plain files below the scene's folder, or data URIs. A triangle with a position that is not
//! finite is skipped, counted and noted.
//!
//! The [conventions](umbrage_plane#conventions) are those of `umbrage-plane`; glTF's own are the same: right-handed, y up, metres. This crate
//! draws nothing. It has no features.

#![warn(missing_debug_implementations)]

mod accessor;
mod animation;
mod budget;
mod camera;
mod colours;
mod container;
mod encode;
mod error;
mod file;
mod image;
mod import;
mod json;
mod lights;
mod material;
mod nodes;
mod note;
mod objects;
mod options;
mod placed;
mod primitive;
mod sight;
mod skin;
mod source;
mod texture;
mod uri;
mod window;

pub use encode::encode;
pub use error::GltfError;
pub use import::{Import, decode, read};
pub use lights::Lamp;
pub use note::{Level, Note};
pub use options::ReadOptions;
