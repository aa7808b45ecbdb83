//! The shadow algorithms: a receiver and a map give the fraction of the receiver that is in shadow.
//!
//! An algorithm is three choices: **which surface is stored** (a depth rule, `umbrage-depth`), **where the map is
//! looked up** (a [`Pattern`](umbrage_sample::Pattern)) and **which depth is compared there** (a [`ReceiverDepth`]). A [`Filter`]
//! combines the results, and [`ShadowMap`] binds a filter to a map so that a renderer sees one thing: [`Shadow`].
//!
//! ```
//! use glam::{DVec3, UVec2, Vec3};
//! use umbrage_depth::Raw;
//! use umbrage_plane::{SurfacePoint, View};
//! use umbrage_sample::Key;
//! use umbrage_shadow::{Shadow, ShadowMap, presets};
//!
//! // A lamp above the floor, and what it sees: a card at distance 5 on the left half, nothing on the right.
//! let size = UVec2::splat(64);
//! let lamp = View::perspective(DVec3::Y * 10.0, DVec3::ZERO, DVec3::NEG_Z, 1.0, 1.0, 100.0, size)?;
//! let depths = (0..64 * 64).map(|i| if i % 64 < 32 { 5.0 } else { f32::INFINITY }).collect();
//! let shadow = ShadowMap { filter: presets::reeves87().filter, map: Raw::new(lamp, depths)? };
//!
//! let key = Key::new(0, 0, 0);
//! assert_eq!(shadow.fraction(&SurfacePoint::at(Vec3::new(-2.0, 0.0, 0.0), Vec3::Y), key), 1.0);
//! assert_eq!(shadow.fraction(&SurfacePoint::at(Vec3::new(2.0, 0.0, 0.0), Vec3::Y), key), 0.0);
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```
//!
//! [`presets`] has the algorithms of the papers, each with its limits, and [`presets::auto`], which needs no bias. For a light in
//! all directions there are [`Around`] and [`LatLong`], for casters that let light pass the deep maps of `umbrage-depth`, for an area
//! light [`Soft`], or [`Mean`] over several maps. A filter of your own is one function of a [`Query`].
//!
//! The [conventions](umbrage_plane#conventions) are those of `umbrage-plane`: 1 is dark, equality is lit, and a sample outside the map
//! is settled by the view's [`Rules`](umbrage_plane::Rules). This crate draws nothing and opens no file.
//!
//! # Features
//!
//! * `rayon`: large batches of points are split over the threads of the current pool; the results are the same bits. Off by default.

#![warn(missing_debug_implementations)]

mod area;
pub mod as_printed;
mod depths;
mod explained;
mod explanation;
mod filters;
mod lights;
mod mean;
pub mod presets;
mod probe;
mod query;
mod settled;
mod surfaces;

pub use depths::{
    AnyDepth, BiasCone, Biased, Compared, Moved, NormalOffset, OffsetGrowth, OnPlane, Radius, ReceiverDepth,
    SlopeScaled, Spread,
};
pub use explanation::{Explanation, Question};
pub use fearless_simd::{Simd, f32x16};
pub use filters::{
    Conditional, DualPlane, FilteredDepth, FromMoments, HdrpPcss, IntegerFirst, MapRadius, OccluderFalloff, Opacity,
    Pcf, Soft, Softness, VirtualWhen, Williams, integer_first, moments, williams,
};
pub use lights::{
    Around, AroundError, Bounded, Evaluate, LatLong, LatLongError, Mean, Shadow, ShadowMap, Tags, Through, Unshadowed,
    same_length,
};
pub use mean::weighted_mean;
pub use presets::{Preset, StoredError};
pub use probe::{Counters, Crossing, PlaceJudged, Probe, TapJudged, Vote};
pub use query::{Filter, Query};
pub use surfaces::{Met, Seen, Surfaces};
