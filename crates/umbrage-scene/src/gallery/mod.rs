//! The scenes behind the papers' figures. The papers give no coordinates; these are Umbrage's reconstructions (spec §9).
//!
//! Object and light ids are the indices named in each scene's documentation. World units are those of Reeves' biases: a
//! world about 100 wide, except for Williams' unit spheres.

mod bicycle;
mod bicycle_shop;
mod desk_lamps;
mod four_spheres;
mod lamp;
mod robot;
mod sculpt;
mod smile;
mod sphere_plane;
mod teapot;
mod workshop;

pub use bicycle_shop::bicycle_shop;
pub use desk_lamps::desk_lamps;
pub use four_spheres::{four_spheres, four_spheres_lit_from};
pub use robot::robot;
pub use smile::smile;
pub use sphere_plane::{SLAB_THICKNESS, box_plane, sphere_plane, three_lights};
pub use teapot::teapot;

use crate::{Scene, Shape};

/// Makes a scene, the same one each time.
pub type Make = fn() -> Scene;

/// Every scene by the name that people type.
pub const ALL: &[(&str, Make)] = &[
    ("four-spheres", four_spheres),
    ("sphere-plane", sphere_plane),
    ("box-plane", box_plane),
    ("three-lights", three_lights),
    ("teapot", teapot),
    ("smile", smile),
    ("robot", robot),
    ("desk-lamps", desk_lamps),
    ("bicycle-shop", bicycle_shop),
];

/// How many bicubic patches a scene has.
pub fn patch_count(scene: &Scene) -> usize {
    let patches = |shape: &Shape| match shape {
        Shape::Mesh(_) => 0,
        Shape::Patches(patches) => patches.len(),
    };
    scene.objects.iter().map(|object| patches(&object.shape)).sum()
}
