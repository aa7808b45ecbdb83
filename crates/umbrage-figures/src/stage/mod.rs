//! What figures are made of: scenes set up, truths, masks, panels, and places to measure at.

pub mod four_spheres;
pub mod lights;
pub mod masks;
pub mod panels;
pub mod penumbra;
pub mod set;
pub mod slices;
pub mod sphere_plane;
pub mod tilted_plane;
pub mod truths;
