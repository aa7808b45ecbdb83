//! Truth by ray casting, and the measures of shadow faults.
//!
//! The oracle is one more [`Shadow`](umbrage_shadow::Shadow): [`RayCast`] answers exactly for a point, [`AreaRegion`]
//! for a pixel's region, [`AreaLight`] for a light with extent, [`Mean`](umbrage_shadow::Mean) of them for a time that the shutter is open. [`metrics`]
//! are the measures of the figures, [`faults`] gives the named faults of a picture with a heat map of each,
//! [`judge`] those of any scene without a place put by hand, [`predict`] what theory expects, [`BiasCase`], [`BiasSearch`] and [`BiasTrial`] whether a
//! bias works, [`diagnose`] what to mend.
//!
//! ```
//! use glam::{DVec4, Vec3};
//! use umbrage_oracle::{Body, Face, Geometry, RayCast};
//! use umbrage_plane::SurfacePoint;
//!
//! // A card above a floor that is not modelled, the sun at the zenith.
//! let card = Face { corners: [Vec3::new(-1., 1., -1.), Vec3::new(0., 1., 2.), Vec3::new(1., 1., -1.)], object: 0 };
//! let geometry = Geometry::from_faces(vec![card], vec![Body::default()]);
//! let truth = RayCast::everywhere(&geometry, DVec4::Y);
//! assert_eq!(truth.at(&SurfacePoint::at(Vec3::ZERO, Vec3::Y)), 1.0);
//! assert_eq!(truth.at(&SurfacePoint::at(Vec3::X * 3.0, Vec3::Y)), 0.0);
//! ```
//!
//! The [conventions](umbrage_plane#conventions) are those of `umbrage-plane`. Nothing here draws or opens a file. It has no
//! features.

mod bias;
mod diagnose;
mod diagnostic;
mod faults;
mod geometry;
pub mod judge;
pub mod metrics;
mod place;
mod plan;
pub mod predict;
mod ray;
mod thin;
mod trial;
mod triangle;
mod truth;

pub use bias::{BiasCase, BiasSearch, BiasWindow};
pub use diagnose::{diagnose, diagnose_recipe};
pub use diagnostic::Diagnostic;
pub use faults::{Contact, Evidence, Fault, Faults, faults, gap_on_surface, heat, penumbra_width, profile_on_surface};
pub use geometry::{Body, Face, Geometry, Hit};
pub use plan::Plan;
pub use trial::{BiasKind, BiasShares, BiasTrial, TriedBias, TruePixel, biased_fraction};
pub use truth::{AreaLight, AreaRegion, RayCast, Truth};
