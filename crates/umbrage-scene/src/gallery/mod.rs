//! The scenes behind the papers' figures. The papers give no coordinates; these are Umbrage's reconstructions.
//!
//! Object and light ids are the indices named in each scene's documentation. World units are those of Reeves' biases: a
//! world about 100 wide, except for Williams' unit spheres, the table of Wang & Molnar, 2000 wide, and Burley's box, 120 high.

mod bicycle;
mod bicycle_shop;
mod bowling;
mod boxes;
mod contacts;
mod curved;
mod desk_lamps;
mod everyday;
mod foliage;
mod four_spheres;
mod glass_pane;
mod hall;
mod interior;
mod kind;
mod kinds;
mod knot;
mod lamp;
mod marched;
mod moving_ball;
mod pins;
mod pipes;
mod plant;
mod robot;
mod rough;
mod scan;
mod sculpt;
mod smile;
mod sphere_plane;
mod spot_room;
mod table;
mod teapot;
mod terrain;
mod thin;
mod tubes;
mod views;
mod walkthrough;
mod workshop;

pub use bicycle_shop::bicycle_shop;
pub use bowling::{BOWLING_FRAMES, bowling};
pub use boxes::{contact_box, overlapping_boxes, single_occluder, two_heights};
pub use contacts::contacts;
pub use desk_lamps::desk_lamps;
pub use everyday::{leaves, solids, spheres};
pub use four_spheres::{four_spheres, four_spheres_lit_from};
pub use glass_pane::glass_pane;
pub use interior::interior;
pub use kinds::{city, fence, gears, hair, letters, louvres, pergola, stairs, wheels};
pub use knot::knot;
pub use moving_ball::moving_ball;
pub use pipes::{pipe_segments, pipes};
pub use plant::{BLADES, plant};
pub use robot::robot;
pub use scan::scan;
pub use smile::smile;
pub use sphere_plane::{SLAB_THICKNESS, box_plane, sphere_plane, three_lights};
pub use spot_room::spot_room;
pub use table::{table, table_close_up};
pub use teapot::teapot;
pub use terrain::terrain;
pub use thin::{THIN, grazing, occluder_sphere, sheets, thin_slab};
pub use tubes::tubes;
pub use walkthrough::walkthrough;

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
    ("table", table),
    ("table-close-up", table_close_up),
    ("spot-room", spot_room),
    ("contact-box", contact_box),
    ("overlapping-boxes", overlapping_boxes),
    ("two-heights", two_heights),
    ("single-occluder", single_occluder),
    ("pipes", pipes),
    ("walkthrough", walkthrough),
    ("bowling", || bowling(0)),
    ("plant", plant),
    ("glass-pane", glass_pane),
    ("moving-ball", || moving_ball(0.5)),
    ("thin-slab", thin_slab),
    ("sheets-planar", || sheets(false)),
    ("sheets-curved", || sheets(true)),
    ("occluder-sphere", occluder_sphere),
    ("grazing", grazing),
    ("fence", || fence(0)),
    ("fence-2", || fence(1)),
    ("letters", || letters(0)),
    ("letters-2", || letters(1)),
    ("stairs", || stairs(0)),
    ("stairs-2", || stairs(1)),
    ("louvres", || louvres(0)),
    ("louvres-2", || louvres(1)),
    ("city", || city(0)),
    ("city-2", || city(1)),
    ("gears", || gears(0)),
    ("gears-2", || gears(1)),
    ("hair", || hair(0)),
    ("hair-2", || hair(1)),
    ("wheels", || wheels(0)),
    ("wheels-2", || wheels(1)),
    ("pergola", || pergola(0)),
    ("pergola-2", || pergola(1)),
    ("interior", || interior(0)),
    ("interior-2", || interior(1)),
    ("solids", || solids(0)),
    ("solids-2", || solids(1)),
    ("spheres", || spheres(0)),
    ("spheres-2", || spheres(1)),
    ("terrain", || terrain(0)),
    ("terrain-2", || terrain(1)),
    ("leaves", || leaves(0)),
    ("leaves-2", || leaves(1)),
    ("tubes", || tubes(0)),
    ("tubes-2", || tubes(1)),
    ("contacts", || contacts(0)),
    ("contacts-2", || contacts(1)),
    ("scan", || scan(0)),
    ("scan-2", || scan(1)),
    ("knot", knot),
];

/// How many bicubic patches a scene has.
pub fn patch_count(scene: &Scene) -> usize {
    let patches = |shape: &Shape| match shape {
        Shape::Mesh(_) => 0,
        Shape::Patches(patches) => patches.len(),
    };
    scene.objects.iter().map(|object| patches(&object.shape)).sum()
}
