//! Geometry of a shadow map: views, footprints, tangent planes and receivers.
//!
//! An eye and a light are one type here, [`View`]: a rigid placement in the world, a perspective or
//! orthographic projection, and a grid of texels. Everything that the other crates of Umbrage say about a place in a
//! map is said with the types of this crate, in the [conventions](#conventions) below.
//!
//! | you have | you get | by |
//! |---|---|---|
//! | a light | its [`View`] | [`View::spot`], [`View::directional`], [`View::perspective`], [`cube_views`], [`sector_views`] |
//! | a shading point, as a [`SurfacePoint`] | its [`Receiver`]: depth, [`Footprint`] in texels, tangent plane | [`View::receiver`], and [`View::receivers`] for many |
//! | a place on a map | the world's point there, or the ray through it | [`View::world_at`], [`View::ray`] |
//! | a bias in some unit, as a [`Bias`] | a depth that is nearer by it | [`Receiver::nearer`] |
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
//! # Conventions
//!
//! They hold in all crates of Umbrage.
//!
//! ```text
//!    the light                        a map of 4 × 3 texels
//!        ●  ζ = 0                     x 0   1   2   3   4
//!       ╱|╲                         y 0 ┌───┬───┬───┬───┐
//!      ╱ | ╲                            │   │   │   │   │  row 0 is on top
//!     ╱──┼──╲   near: ζ = n           1 ├───┼───┼───┼───┤
//!    ╱   |   ╲                          │   │ ● │   │   │  ● is the centre of texel (1, 1): (1.5, 1.5)
//!   ╱    ↓    ╲                       2 ├───┼───┼───┼───┤
//!  ╱     ζ     ╲                        │   │   │   │   │
//! ╱─────────────╲  far: ζ = f         3 └───┴───┴───┴───┘
//! ```
//!
//! | thing | convention |
//! |---|---|
//! | world, eye space | right-handed; a view looks down −z of its eye space; ζ = −z is positive in front |
//! | lengths | world units, of your choice; positions in f64, normals in f32, of unit length |
//! | angles | radians |
//! | texel space | x to the right, y down; texel (i, j) covers \[i, i+1) × \[j, j+1), its centre is at +½ |
//! | rectangles | half-open: the minimum is inside, the maximum is outside |
//! | footprints | half-extents in texels, not full sizes |
//! | depth | grows away from the light; +∞ is *no surface*; stored as the [`Kind`] of the view says, axial (ζ, in world units) unless chosen otherwise |
//! | key | what is affine over the texels on every plane: −1/ζ in perspective, ζ in an orthographic view, the stored depth itself in views of screen depth |
//! | comparison | in shadow where the receiver's depth less its bias is greater than the stored depth; equal is lit |
//! | results | `shadow` and `fraction`: 1 is dark; `transmittance`: 1 is lit |
//! | bias | a [`Bias`], whose variant is its unit |
//! | colour | linear light |
//!
//! This crate knows no map, no sample and no shadow. It has no features.

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
pub use simd::{floor_texel, integers};
pub use view::{Projection, View};
pub use view_error::ViewError;

pub(crate) use look::look_at;
