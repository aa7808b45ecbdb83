//! Pictures from scenes, and the maps of a scene's lights: the library crate that joins scenes, maps and shadows.
//!
//! The reading path: a [`Soup`] is a scene's triangles for one view; [`bake`](umbrage_bake::bake) makes a light's depth map of it;
//! [`bind`](umbrage_recipe::bind) puts a filter over the map in the storage that is given; [`picture`] draws the camera's image with it.
//!
//! ```
//! use umbrage_bake::bake;
//! use umbrage_depth::{First, Storage};
//! use umbrage_raster::Cull;
//! use umbrage_recipe::bind;
//! use umbrage_render::{Frame, Soup, picture};
//! use umbrage_scene::gallery;
//! use umbrage_shadow::presets;
//!
//! let mut scene = gallery::sphere_plane();
//! scene.camera = scene.camera.with_size(glam::UVec2::splat(48))?;
//! let light = scene.lights[0].view.with_size(glam::UVec2::splat(64))?;
//! let baked = bake(&light, Soup::casters(&scene, &light).triangles(), &First, Cull::None);
//! let shadow = bind(presets::reeves87().filter, &baked.map, Storage::Tiled);
//! let image = picture(&scene, &[&*shadow], &Frame::default());
//! assert!(image.shadow[0].iter().any(|&fraction| fraction > 0.9));
//! # Ok::<(), umbrage_plane::ViewError>(())
//! ```
//!
//! The [conventions](umbrage_plane#conventions) are those of `umbrage-plane`. A pinhole camera, direct light, diffuse and specular
//! shading: enough of a renderer to judge a shadow by, and no more. It opens no file and has no features.

mod camera;
mod exposure;
mod lights;
mod picture;
mod planar;
pub mod post;
mod receivers;
mod shade;
mod soup;
mod weights;

pub use exposure::{expose, expose_deep, exposed_map, light_map, light_shadow};
pub use lights::{bind_lights, light_maps, light_shadows};
pub use picture::{Frame, NOTHING, Picture, Sight, picture, picture_where, rays_where};
pub use planar::{Ground, Planar};
pub use receivers::receivers;

pub use soup::{Soup, alpha_blend, alpha_test};
