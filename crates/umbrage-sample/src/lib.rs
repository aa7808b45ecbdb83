//! Where to look in a shadow map: sample patterns and keyed randomness.
//!
//! A [`Pattern`] spreads *taps* over a region of a map (a [`Footprint`](umbrage_plane::Footprint), in texel space,
//! y down), sixteen at a time. A [`Key`] names the region and gives it its random numbers, so that the same region
//! gets the same taps whatever the thread, the storage or the order of work.
//!
//! | pattern | source | taps |
//! |---|---|---|
//! | [`Centre`] | Reeves 1987, Fig. 6a | one, at the centre |
//! | [`EveryTexel`] | Reeves 1987, Fig. 2 | every texel, exhaustively |
//! | [`Tent`] | Wang & Molnar 1994 | every texel, weighted by nearness |
//! | [`Uniform`], [`Gaussian`] | Reeves 1987, Fig. 3a, 3b | random in the bounding box |
//! | [`Jittered`] | Reeves 1987, Fig. 3c and 4 | one in each cell of a grid over the box: the default |
//! | [`Table`] | | the same with stored numbers, a hash for sixteen taps |
//! | [`InsideQuadReject`], [`InsideQuadWarp`] | Reeves 1987, Fig. 3d | inside the region's quadrilateral |
//! | [`Disc`] | Burley 2006 | Hammersley points on a disc |
//! | [`Castano`] | Castaño 2013; Bevy, Babylon.js | every texel, weighted by a bell of straight lines |
//! | [`AreaTent`] | Unity's pipelines | every texel, weighted by the area of a triangle over it |
//! | [`Vogel`] | three.js, Godot, Unity's HDRP | bilinear comparisons on a disc |
//! | [`Spiral`] | Unity's HDRP | single taps on the same disc |
//! | [`AnyPattern`] | | any of them, chosen when the program runs |
//!
//! ```
//! use glam::Vec2;
//! use umbrage_plane::Footprint;
//! use umbrage_sample::{Jittered, Key, each_tap};
//!
//! let region = Footprint::boxed(Vec2::new(100.25, 40.0), Vec2::splat(2.0));
//! let key = Key::new(7, 0, 0).region(1234);
//! let mut taps = 0;
//! each_tap(&Jittered::default(), &region, key, |tap| {
//!     taps += 1;
//!     assert!((tap.at - region.centre).abs().cmple(region.half).all());
//! });
//! assert_eq!(taps, 16);
//! ```
//!
//! ```text
//! EveryTexel      Jittered        Uniform         Disc
//! ┌─┬─┬─┬─┐       ┌───┬───┐       ┌───────┐       ┌───────┐
//! │·│·│·│·│       │ · │  ·│       │ · ·   │       │  · ·  │
//! ├─┼─┼─┼─┤       ├───┼───┤       │     · │       │·  ·  ·│
//! │·│·│·│·│       │·  │ · │       │·  ·   │       │  ·  · │
//! └─┴─┴─┴─┘       └───┴───┘       └───────┘       └───────┘
//! ```
//!
//! The [conventions](umbrage_plane#conventions) are those of `umbrage-plane`. This crate knows no map and no depth: what a tap
//! finds is its caller's business. It has no features.

#![warn(missing_debug_implementations)]

mod any;
mod area_tent;
mod castano;
mod centre;
mod disc;
mod every_texel;
mod gaussian;
mod grid;
mod inside_quad;
mod jittered;
mod key;
mod spiral;
mod table;
mod taps;
mod tent;
mod uniform;
mod vogel;

pub use any::AnyPattern;
pub use area_tent::AreaTent;
pub use castano::Castano;
pub use centre::Centre;
pub use disc::{Density, Disc, hammersley, radical_inverse, radical_inverses};
pub use every_texel::EveryTexel;
pub use gaussian::Gaussian;
pub use inside_quad::{InsideQuadReject, InsideQuadWarp};
pub use jittered::Jittered;
pub use key::Key;
pub use spiral::Spiral;
pub use table::Table;
pub use taps::{Pattern, Tap, Taps, each_tap};
pub use tent::Tent;
pub use uniform::Uniform;
pub use vogel::Vogel;
