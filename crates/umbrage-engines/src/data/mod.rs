//! What is known of each engine: settings, units, defaults, filters and sources.

mod native;
mod offline;
mod raster;
mod unity;
mod unreal;
mod web;

pub(crate) use native::{BEVY, FILAMENT, GODOT};
pub(crate) use offline::RSL;
pub(crate) use raster::{D3D, VULKAN, WEB_GPU};
pub(crate) use unity::{HDRP, URP};
pub(crate) use unreal::UNREAL;
pub(crate) use web::{BABYLON, THREE};

/// Why an interface that biases depths has no offset along normals.
const NO_NORMAL: &str = "casters and receivers are not moved along their normals";

/// Why an engine that moves points has nothing that grows with the slope.
const NO_SLOPE: &str = "no setting grows with the slope";
