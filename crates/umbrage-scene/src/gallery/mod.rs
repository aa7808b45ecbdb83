//! The scenes behind the papers' figures. The papers give no coordinates; these are Umbrage's reconstructions (spec §9).
//!
//! Object and light ids are the indices named in each scene's documentation. World units are those of Reeves' biases: a
//! world about 100 wide, except for Williams' unit spheres.

mod four_spheres;
mod sphere_plane;
mod teapot;

pub use four_spheres::{four_spheres, four_spheres_lit_from};
pub use sphere_plane::{SLAB_THICKNESS, box_plane, sphere_plane, three_lights};
pub use teapot::teapot;

use crate::Scene;

/// Makes a scene, the same one each time.
pub type Make = fn() -> Scene;

/// Every scene by the name that people type.
pub const ALL: &[(&str, Make)] = &[
    ("four-spheres", four_spheres),
    ("sphere-plane", sphere_plane),
    ("box-plane", box_plane),
    ("three-lights", three_lights),
    ("teapot", teapot),
];
