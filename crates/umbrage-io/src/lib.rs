//! Shadow maps as EXR, flat and deep, pictures as PNG and EXR, one safe way to write a file.
//!
//! * [`write_shadow_map`] and [`read_shadow_map`]: a depth map with its view, bit for bit (Reeves 1987), in a file that other
//!   tools read: tiled, channel `Z`, `worldToCamera`, `worldToNDC`, `near`, `far`, `textureformat = "Shadow"`.
//! * [`write_deep_map`] and [`read_deep_map`]: all surfaces of each texel with what passes them (Burley 2006), bit for bit, as deep
//!   scan lines that other tools composite: channels `Z` and `A` or `AR`, `AG`, `AB`.
//! * [`write_facet_map`] and [`read_facet_map`]: a map of facets, bit for bit, as a shadow map that other tools read, with planes, indices,
//!   blocks and links in a second part.
//! * [`write_shadow_map_by_rows`]: the file of a map that is larger than memory, row of tiles by row of tiles.
//! * [`Paged`]: a shadow map's file with only the tiles looked at last in memory.
//! * [`write_png`], [`write_png_grey`], [`write_exr`]: pictures from linear light; [`read_png`] for comparing.
//! * [`encode_png_values`], [`encode_exr_values`]: a quantity for each pixel, such as a fraction in shadow, without a curve;
//!   [`read_values`] and [`decode_values`] read it.
//! * [`read_map`]: whichever of these maps a file holds.
//! * [`write_maps`] and [`read_maps`]: several of them in one file, a part for each, by name; [`MapOptions`] help with files of other makers.
//! * [`depth_view`] and [`replicate`]: a map as a grey picture, a zoom without invention.
//! * [`read_bytes`], [`create_folder`], [`remove_folder`] and [`file_bytes`]: files for those who open none themselves.
//! * [`write_atomic`]: the one path on which all of these write. A killed run leaves no torn file.
//!
//! Files are not trusted: sizes are checked against the file's length and a budget before memory is taken, and every fault
//! is one line that names file, field and value. Of the crates that know pictures and maps only this one opens files.
//!
//! The [conventions](umbrage_plane#conventions) are those of `umbrage-plane`. This crate computes no shadow and reads no scene. It has no features.
//!
//! ```
//! use glam::{UVec2, Vec3};
//!
//! let pixels = [Vec3::ZERO, Vec3::splat(0.5), Vec3::ONE, Vec3::new(1.0, 0.0, f32::NAN)];
//! let bytes = umbrage_io::encode_png(UVec2::new(2, 2), &pixels)?;
//! let codes = umbrage_io::decode_png(&bytes)?;
//! assert_eq!(codes.rgb, [[0; 3], [188; 3], [255; 3], [255, 0, 0]]);
//! # Ok::<(), umbrage_io::Fault>(())
//! ```

mod any_map;
mod cube;
mod deep_map;
mod depth_view;
mod error;
mod facet_map;
mod file;
mod map_options;
mod named;
mod paged;
mod picture;
mod shadow_map;
mod values;
mod write_file;

pub use any_map::{Maps, NamedMap, decode_map, decode_maps, encode_maps, read_map, read_maps, write_maps};
pub use cube::opengl_cube_face;
pub use deep_map::{
    DEFAULT_DEEP_BUDGET, decode_deep_map, encode_deep_map, read_deep_map, read_deep_map_within, write_deep_map,
};
pub use depth_view::depth_view;
pub use error::{Fault, IoError};
pub use facet_map::{
    DEFAULT_FACET_BUDGET, decode_facet_map, encode_facet_map, read_facet_map, read_facet_map_within, write_facet_map,
};
pub use file::{create_folder, file_bytes, machine_memory, peak_memory, read_bytes, remove_folder};
pub use map_options::{DEFAULT_BUDGET, GivenView, MapOptions};
pub use named::{CUBE_FACES, FACES_AHEAD, light_of};
pub use paged::{Paged, PagedHandle};
pub use picture::{
    Codes, decode_png, encode_exr, encode_exr_values, encode_png, encode_png_grey, encode_png_values, linear_to_srgb8,
    read_png, replicate, write_exr, write_png, write_png_grey,
};
pub use shadow_map::{
    TileRows, decode_shadow_map, encode_shadow_map, read_shadow_map, read_shadow_map_within, write_shadow_map,
    write_shadow_map_by_rows,
};
pub use values::{Values, decode_values, read_values};
pub use write_file::{write_atomic, write_bytes};
