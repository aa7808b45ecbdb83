//! Triangles to shadow maps: pass 1 of every depth rule.
//!
//! A renderer gives its own triangles and a light's [`View`](umbrage_plane::View), and is given a map. No scene, no file and no shadow is
//! known here.
//!
//! | function | makes | source |
//! |---|---|---|
//! | [`bake`] | one depth per texel, by any [`DepthRule`](umbrage_depth::DepthRule) | Williams 1978, Reeves 1987, Wang & Molnar 1994 |
//! | [`bake_streamed`] | the same, row of tiles by row of tiles, of more triangles or a larger map than memory holds | |
//! | [`bake_multi`] | the same from several samples per texel | Woo 1992 |
//! | [`bake_by_normals`] | the same, with sides seen by interpolated normals | Wang & Molnar 1994 |
//! | [`bake_deep`] | all surfaces of a texel, and what passes them | Burley 2006 |
//! | [`bake_tags`] | the nearest object's id per texel | Hourcade & Nicolas 1985 |
//! | [`mix_moments`] | one map of an exposure from the maps of its moments | |
//!
//! A triangle's corners are all that most of them need, and they take bare [`Triangle`](umbrage_raster::Triangle)s, or in less time
//! [`IndexedMesh`](umbrage_raster::IndexedMesh)es, whose triangles share corners. What some need beyond that comes with a [`Caster`] or a [`CasterMesh`],
//! which all of them take as well ([`Casting`]): what light it lets through, the normals of its vertices, and a [`Mask`] that says where it has
//! holes, which every function evaluates at every sample.
//!
//! ```
//! use glam::{DVec3, IVec2, UVec2, Vec3};
//! use umbrage_bake::{Caster, Deep, bake, bake_deep};
//! use umbrage_depth::{DepthMap, First};
//! use umbrage_plane::View;
//! use umbrage_raster::{Cull, Triangle};
//!
//! // A lamp at (0, 0, 10) that looks down on a pane 4 units below it.
//! let lamp = View::perspective(DVec3::Z * 10.0, DVec3::ZERO, DVec3::Y, 1.0, 1.0, 20.0, UVec2::splat(64))?;
//! let corners = [(-9.0, -9.0), (9.0, -9.0), (0.0, 9.0)].map(|(x, y)| DVec3::new(x, y, 6.0));
//! let pane = Triangle { corners, object: 0, sheet: true };
//!
//! let baked = bake(&lamp, [pane], &First, Cull::None);
//! assert_eq!(baked.map.depth(IVec2::splat(32)), 4.0);
//! assert_eq!(baked.stats.kept(), 1);
//!
//! // The same pane in red glass: a deep map keeps what passes it.
//! let red = Caster::from(pane).with_passes(Vec3::new(0.9, 0.1, 0.1));
//! let deep = bake_deep(&lamp, [[red]], &Deep::default()).map;
//! assert_eq!(deep.transmittance(IVec2::splat(32), 5.0), Vec3::new(0.9, 0.1, 0.1));
//! # Ok::<(), umbrage_plane::ViewError>(())
//! ```
//!
//! The results depend neither on the number of threads nor on the order of the triangles. The [conventions](umbrage_plane#conventions)
//! are those of `umbrage-plane`. This crate has no features.

#![warn(missing_debug_implementations)]

mod caster;
mod casting;
mod chunks;
mod deep;
mod facets;
mod mask;
mod masks;
mod moments;
mod normals;
mod pass1;
mod rays;
mod streamed;
mod streaming;
mod tags;

pub use caster::Caster;
pub use casting::{CasterMesh, Casting};
pub use deep::{BakedDeep, Deep, bake_deep};
pub use facets::{BakedFacets, Refinement, bake_facets, bake_refined};
pub use mask::{Film, Mask, MaskPlace};
pub use masks::Masks;
pub use moments::mix_moments;
pub use normals::bake_by_normals;
pub use pass1::{Baked, advised_map_sizes, bake, bake_multi};
pub use streamed::{Streamed, bake_streamed};
pub use streaming::Streaming;
pub use tags::bake_tags;
