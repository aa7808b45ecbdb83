//! Geometry of a shadow map: views, footprints, tangent planes and receivers.
//!
//! An eye and a light are one type here, [`View`]: a rigid placement in the world, a perspective or
//! orthographic projection, and a grid of texels. Everything the other crates say about a place in a
//! map is said with the types of this crate, in the conventions below (and in `crates/README.md`).
//!
//! * World and eye space are right-handed; a view looks down its eye space's −z; ζ = −z is positive in front.
//! * Texel space: x to the right, y down, texel (i, j) covers \[i, i+1) × \[j, j+1), its centre is at +½.
//! * Depth grows away from the light; +∞ means *no surface*; at equal depth a point is lit.
//! * The *key* of a surface is what is affine in texel space on every plane: −1/ζ in perspective
//!   (it grows with ζ), ζ itself in an orthographic view.
//!
//! ```
//! use glam::{DVec3, UVec2, Vec3};
//! use umbrage_plane::{SurfacePoint, View};
//!
//! // A lamp ten units above the floor, looking straight down, 90 degrees wide.
//! let lamp = View::perspective(
//!     DVec3::new(0.0, 10.0, 0.0), DVec3::ZERO, DVec3::NEG_Z, 90f64.to_radians(), 1.0, 100.0, UVec2::splat(64),
//! ).unwrap();
//! let seen = lamp.receiver(&SurfacePoint::at(Vec3::new(2.0, 1.0, -3.0), Vec3::Y)).unwrap();
//! assert_eq!(seen.depth, 9.0);
//! assert_eq!(seen.footprint.centre.as_ivec2(), glam::IVec2::new(39, 21));
//! ```
//!
//! This crate knows no map, no sample and no shadow.

#![warn(missing_debug_implementations)]

mod affine;
mod altered;
mod around;
mod batch;
mod builders;
mod cells;
mod fitted;
mod footprint;
mod lanes;
mod look;
mod named;
mod planar;
mod policy;
mod receiver;
mod rect;
mod sampling;
mod simd;
mod spaces;
mod view;
mod view_error;

#[doc(hidden)]
pub use fearless_simd;
/// The vectors and matrices of every public signature.
pub use glam;

pub use affine::{Affine, Decode, DepthPlane, DepthRange, Facet, Facing, Kind};
pub use around::{Sectors, cube_face, cube_views, sector_views};
pub use cells::Cells;
pub use footprint::Footprint;
pub use lanes::{LANES, Lanes, Lanes3};
pub use look::up_for;
pub use named::SpotView;
pub use planar::planar_shadow;
pub use policy::{Place, Rules, Verdict};
pub use receiver::{Bias, Receiver, SurfacePoint};
pub use rect::TexelRect;
pub use sampling::{Sampling, mix32};
pub use simd::floor_texel;
pub use view::{Projection, View};
pub use view_error::ViewError;

pub(crate) use look::look_at;
