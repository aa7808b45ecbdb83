//! What a shadow map stores: depth rules and storages.
//!
//! A [`DepthRule`] says which of the surfaces over a texel is kept while a map is drawn, as a [`Reduction`] whose cells become
//! depths; a [`DepthMap`] keeps the result and answers look-ups. All storages of one map give the same answers, bit for bit.
//!
//! | rule | stored depth | source |
//! |---|---|---|
//! | [`First`] | of the nearest surface | Williams 1978, Reeves 1987 |
//! | [`Midpoint`] | halfway between the two nearest | Woo 1992 |
//! | [`Second`] | of the second surface, by two buffers | Wang & Molnar 1994 |
//! | [`BackFace`] | of the nearest surface that faces away | Wang & Molnar 1994 |
//!
//! ```text
//! light   front          back        floor
//!   ●───────┃──────────────┃───────────┃────→ depth
//!         First         BackFace
//!                        Second
//!                 Midpoint
//! ```
//!
//! [`Stored`] names the surface that a rule keeps, whatever its parameters.
//!
//! | storage | keeps |
//! |---|---|
//! | [`Raw`] | every texel |
//! | [`Bbox`] | the rectangle around all surfaces |
//! | [`Tiled`] | 32×32 tiles that hold a surface, with their nearest and farthest depth |
//! | [`FacetMap`] | which facet each texel sees, and the facets' planes; where asked, finer where one plane does not do |
//! | [`DeepMap`] | several surfaces per texel, each letting part of the light through |
//! | [`MomentMap`] | every texel, and means of functions of the depths over regions of any size |
//!
//! [`Map`] is any of them, shared: the one type that the code above a filter knows. A [`Translucent`] is what a deep map lets through.
//!
//! [`TagMap`] keeps objects' ids instead of depths, the baseline of Hourcade & Nicolas.
//!
//! ```
//! use glam::{DVec3, IVec2, UVec2};
//! use umbrage_depth::{Bbox, DepthMap, Raw, Tiled};
//! use umbrage_plane::View;
//!
//! let lamp = View::orthographic(DVec3::Y, DVec3::ZERO, DVec3::X, 1.0, 0.0, 9.0, UVec2::new(100, 60))?;
//! let mut depths = vec![f32::INFINITY; 100 * 60];
//! depths[100 * 41 + 7] = 2.5; // one surface, over texel (7, 41)
//! let raw = Raw::new(lamp, depths)?;
//! assert_eq!((raw.bytes(), Bbox::from(&raw).bytes(), Tiled::from(&raw).bytes()), (24_000, 4, 4_096));
//! assert_eq!(Tiled::from(&raw).depth(IVec2::new(7, 41)), 2.5);
//! assert_eq!(Bbox::from(&raw).depth(IVec2::new(-1, 41)), f32::INFINITY);
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```
//!
//! The [conventions](umbrage_plane#conventions) are those of `umbrage-plane`. This crate draws no triangles and
//! computes no shadow. It has no features.

#![warn(missing_debug_implementations)]

mod back_face;
mod bandlimit;
mod bbox;
mod deep;
mod facet_rule;
mod facets;
mod first;
mod hit;
mod kept;
mod map;
mod midpoint;
mod moments;
mod no_surface;
mod quantise;
mod raw;
mod rows;
mod rule;
mod second;
mod stored;
mod tags;
mod tile_size;
mod tiled;
mod translucent;

pub use back_face::BackFace;
pub use bandlimit::bandlimit;
pub use bbox::Bbox;
pub use deep::{DeepMap, compress_steps};
pub use facet_rule::FacetRule;
pub use facets::{
    FacetBlock, FacetCells, FacetDepths, FacetMap, FacetSample, FacetSource, FacetTile, FacetWordsError, Facets,
    NO_FACET,
};
pub use first::First;
pub use hit::Hit;
pub use kept::{Map, Storage, StorageError};
pub use map::DepthMap;
pub use midpoint::{Midpoint, MidpointCell, MidpointRow, SameSurface};
pub use moments::{MomentMap, MomentSource, Moments};
pub use quantise::{quantise, quantum};
pub use raw::{MapError, Raw};
pub use rule::{DepthRule, ROW, RUN, Reduction, Row};
pub use second::{Second, SecondRow};
pub use stored::Stored;
pub use tags::TagMap;
pub use tile_size::TILE;
pub use tiled::{Tile, Tiled};
pub use translucent::{Step, Translucent};
