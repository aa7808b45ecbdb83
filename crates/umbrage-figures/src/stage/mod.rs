//! What figures are made of: scenes set up, truths, masks, panels, and places to measure at.

pub mod four_spheres;
pub mod lights;
pub mod many;
pub mod masks;
pub mod memo;
pub mod panels;
pub mod penumbra;
pub mod set;
pub mod slices;
pub mod sphere_plane;
pub mod tilted_plane;
pub mod truths;

use glam::UVec2;
use umbrage_plane::View;

/// The same view with this number of columns, and rows in proportion.
fn sized(view: &View, across: u32) -> View {
    let size = view.size();
    let height = (u64::from(across) * u64::from(size.y) / u64::from(size.x.max(1))).max(1) as u32;
    view.with_size(UVec2::new(across, height)).unwrap_or(*view)
}

/// A light of which the place matters, not its map's resolution.
fn without_map(light: &View) -> View {
    sized(light, 1)
}
