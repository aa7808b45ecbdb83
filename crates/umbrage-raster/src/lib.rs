//! Triangles to exact coverage, tile by tile.
//!
//! [`Bins`] takes the triangles of a scene as one view sees them, cuts off what lies behind the view, snaps the corners to
//! 1/256 texel and sorts the triangles into tiles of [`BIN`]² texels. [`Bins::tile`] then reports, for each triangle that
//! reaches a tile, exactly which texels' samples it covers, as often as it is called and from any thread.
//!
//! ```
//! use glam::{DVec3, UVec2};
//! use umbrage_plane::{TexelRect, View};
//! use umbrage_raster::{Bins, Cull, Triangle};
//!
//! // Looking along −z at the square −16..16: one world unit is one texel.
//! let view = View::orthographic(DVec3::ZERO, DVec3::NEG_Z, DVec3::Y, 16.0, 1.0, 9.0, UVec2::splat(32)).unwrap();
//! let corners = [(0.0, 0.0), (3.0, 0.0), (0.0, 3.0)].map(|(x, y)| DVec3::new(x, y, -5.0));
//! let triangle = Triangle { corners, object: 7, sheet: false };
//! let bins = Bins::new(&view, TexelRect::of_size(view.size()), Cull::None, [triangle]);
//! bins.tile(UVec2::ZERO, |facet, coverage| {
//!     assert_eq!((facet.triangle, facet.object), (0, 7));
//!     // Rows of 0, 1 and 2 texels: the samples on the hypotenuse belong to its other side.
//!     assert_eq!(coverage.rows[13..16], [0, 1 << 16, 3 << 16]);
//!     assert_eq!((coverage.first, coverage.end), (14, 16));
//! });
//! ```
//!
//! What holds:
//!
//! * A sample on the edge between two triangles belongs to exactly one of them, a sample on a corner to exactly one of the
//!   triangles around it: the top-left rule, in integers, without a rounding. Coverage does not depend on the order of the corners.
//! * At every sample, a closed mesh that is not cut has as many front as back facets. [`Facet::facing`](umbrage_plane::Facet) is the
//!   orientation of the *snapped* triangle for that reason: a sliver thinner than the snapping grid may be turned over by the
//!   snapping, its neighbours then overlap it, and only the snapped orientation cancels one of them.
//! * What a facet covers is a function of the view and the triangle; neither tiles, windows nor the order of calls change it.
//!
//! The [conventions](umbrage_plane#conventions) are those of `umbrage-plane`. This crate has no features.
//! It knows no depth test and no shadow; it does not clamp depths to the near plane
//! either: a facet's key nearer than `view.key(view.near())` is for the depth pass to clamp. In perspective nothing can be
//! projected at the light itself: what is nearer than 1/1024 of the near distance is cut off, and counted
//! ([`Stats::too_near`]).

#![warn(missing_debug_implementations)]

mod bins;
mod blocks;
mod clip;
mod coverage;
mod eight;
mod fragments;
mod gathered;
mod job;
mod lists;
mod mesh;
mod piece;
mod setup;
mod small;
mod spans;

pub use bins::Bins;
pub use coverage::Coverage;
pub use fragments::{RUN, each_fragment, each_run};
pub use gathered::{Gathered, Shown};
pub use mesh::{Geometry, IndexedMesh};
pub use spans::{Band, Lines, Runs};

use glam::DVec3;

/// Side of a tile, in texels.
pub const BIN: u32 = 32;

/// A triangle in world space, counter-clockwise as seen from its outside.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Triangle {
    /// World-space corners. NaN, infinite or ≥ 1e30 in size: the triangle is counted and skipped. Triangles that share a
    /// corner must give it by the same bits, so that nothing gapes between them.
    pub corners: [DVec3; 3],
    /// Id of the object it belongs to.
    pub object: u32,
    /// True for a piece of an open, two-sided surface.
    pub sheet: bool,
}

impl Triangle {
    /// From corners that are [`Vec3`](glam::Vec3)s or [`DVec3`]s.
    pub fn new(corners: [impl Into<DVec3>; 3], object: u32, sheet: bool) -> Self {
        Self { corners: corners.map(Into::into), object, sheet }
    }
}

/// Which triangles are left out by the side a view sees of them. Sheets are never culled.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Default)]
pub enum Cull {
    /// None.
    #[default]
    None,
    /// Those whose outside is seen.
    Front,
    /// Those whose inside is seen.
    Back,
}

/// What became of the triangles that were given.
///
/// Each is kept or counted in exactly one of `not_finite`, `zero_area`, `culled`, `outside` and `missed`;
/// `clipped` and `before_near` count some of those that were kept.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Default)]
pub struct Stats {
    /// Triangles given.
    pub given: u64,
    /// With a NaN, infinite or ≥ 1e30 coordinate: skipped.
    pub not_finite: u64,
    /// Without area (in the world, or after snapping): skipped.
    pub zero_area: u64,
    /// Culled by facing.
    pub culled: u64,
    /// Wholly outside the window or behind the view.
    pub outside: u64,
    /// So small that their bounding box lies between the texels' samples.
    pub missed: u64,
    /// Cut at the near limit or at the guard band.
    pub clipped: u64,
    /// Nearer than the near plane somewhere; the depth pass clamps their depths to it.
    pub before_near: u64,
    /// In front of a perspective view, but nearer than 1/1024 of its near distance somewhere: that part is cut off, and with it
    /// whatever shadow it throws. Also counted where they were kept or skipped.
    pub too_near: u64,
}

impl std::ops::AddAssign for Stats {
    /// Of two sets of triangles.
    fn add_assign(&mut self, other: Self) {
        self.given += other.given;
        self.not_finite += other.not_finite;
        self.zero_area += other.zero_area;
        self.culled += other.culled;
        self.outside += other.outside;
        self.missed += other.missed;
        self.clipped += other.clipped;
        self.before_near += other.before_near;
        self.too_near += other.too_near;
    }
}

impl std::fmt::Display for Stats {
    /// One line: how many were given and kept, then what became of the others and what happened to some, where it did.
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        write!(f, "{} triangles, {} drawn", self.given, self.kept())?;
        let parts = [
            (self.not_finite, "skipped for a coordinate that is not finite"),
            (self.zero_area, "without area"),
            (self.culled, "culled by facing"),
            (self.outside, "outside the view"),
            (self.missed, "too small for a sample"),
            (self.clipped, "cut at the view's limits"),
            (self.before_near, "nearer than the near plane and stored at it"),
            (
                self.too_near,
                "so near to the light that a part is lost, and with it its shadow: bring the near plane nearer",
            ),
        ];
        parts.iter().filter(|(count, _)| *count > 0).try_for_each(|(count, what)| write!(f, "; {count} {what}"))
    }
}

impl Stats {
    /// Triangles that were sorted into tiles.
    pub fn kept(&self) -> u64 {
        self.given - self.not_finite - self.zero_area - self.culled - self.outside - self.missed
    }
}
