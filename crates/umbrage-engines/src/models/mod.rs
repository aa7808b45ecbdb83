//! The formulas: an engine's settings to a world bias, and back.

#![expect(clippy::unnecessary_wraps, reason = "one signature for all engines, though only some can fail")]

mod native;
mod offline;
mod raster;
mod unity;
mod web;

use crate::data;
use crate::{About, Conditions, EngineError, WorldBias, WorldRange};

pub(crate) use native::{BEVY, FILAMENT, GODOT};
pub(crate) use offline::RSL;
pub(crate) use raster::{D3D, VULKAN, WEB_GPU};
pub(crate) use unity::{HDRP, URP};
pub(crate) use web::{BABYLON, THREE};

/// The least and the most value of a setting (see [`Setting`](crate::Setting)).
pub(crate) type Span = [f64; 2];

/// An engine as this crate knows it.
pub(crate) struct Model {
    pub(crate) about: &'static About,
    /// `None` where no public text has them.
    pub(crate) formulas: Option<Formulas>,
    /// How much depth one unit of its constant setting adds, at least and at most; `None` where the setting is not counted in steps of depth.
    pub(crate) unit: Option<fn(&Conditions) -> Span>,
}

/// Both directions. Values and spans are in the order of [`About::settings`]; conditions and values have been checked.
pub(crate) struct Formulas {
    pub(crate) settings: fn(&WorldBias, &Conditions) -> Result<Vec<Span>, EngineError>,
    pub(crate) world: fn(&[f64], &Conditions) -> Result<WorldRange, EngineError>,
}

/// Epic publishes what the settings are for, and no formula.
pub(crate) const UNREAL: Model = Model { about: &data::UNREAL, formulas: None, unit: None };

/// A setting that nothing is left open of.
const fn exactly(value: f64) -> Span {
    [value, value]
}

/// What a factor must be multiplied by to give an amount: 0 where the factor is 0, so that nothing is to be had.
fn share(amount: f64, factor: f64) -> f64 {
    if factor == 0.0 { 0.0 } else { amount / factor }
}
