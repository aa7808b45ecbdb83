use super::raster::vulkan_unit;
use super::{Formulas, Model, Span, exactly, share};
use crate::{Conditions, EngineError, WorldBias, WorldRange, data};
use std::f64::consts::SQRT_2;

pub(crate) const FILAMENT: Model = Model {
    about: &data::FILAMENT,
    formulas: Some(Formulas { settings: filament_settings, world: filament_world }),
    unit: None,
};

pub(crate) const BEVY: Model =
    Model { about: &data::BEVY, formulas: Some(Formulas { settings: bevy_settings, world: bevy_world }), unit: None };

pub(crate) const GODOT: Model = Model {
    about: &data::GODOT,
    formulas: Some(Formulas { settings: godot_settings, world: godot_world }),
    unit: None,
};

/// Casters are moved by `constantBias` world units along the light's axis (`ShadowMap.cpp`, `updateDirectional`, `updatePunctual`), and
/// their depths by a polygon offset, away from the light whatever way depth runs (`ShadowMapManager.cpp`).
///
/// The receiver moves along its normal by `normalBias` texels times the sine of the angle to the light (`surface_shadowing.glsl`), by
/// half of that for directional lights (`ShadowMapManager.cpp`); a spot's texel is taken at the receiver's distance along the axis
/// (`surface_getters.fs`). `constantBias` is clamped to 0 to 2 and `normalBias` to 0 to 3 (`components/LightManager.cpp`).
fn filament_settings(wanted: &WorldBias, conditions: &Conditions) -> Result<Vec<Span>, EngineError> {
    let normal = share(wanted.normal, filament_offset(conditions)).clamp(0.0, 3.0);
    Ok(vec![exactly(wanted.constant.clamp(0.0, 2.0)), exactly(normal), exactly(0.0), exactly(wanted.slope)])
}

fn filament_world(values: &[f64], conditions: &Conditions) -> Result<WorldRange, EngineError> {
    // Its maps are reversed, always.
    let [least, most] = vulkan_unit(&conditions.with_reversed(true));
    let normal = values[1].clamp(0.0, 3.0) * filament_offset(conditions);
    let bias = |unit: f64| {
        // A caster's depth after both is z(ζ + constant) + units: what is left of the receiver's is the sum of both steps.
        let constant = values[0].clamp(0.0, 2.0) + conditions.world_step(values[2] * unit)?;
        Ok(WorldBias { constant, slope: values[3], normal })
    };
    let ends = if values[2] < 0.0 { [most, least] } else { [least, most] };
    Ok(WorldRange { least: bias(ends[0])?, most: bias(ends[1])? })
}

/// World units that a `normalBias` of 1 moves the receiver.
fn filament_offset(conditions: &Conditions) -> f64 {
    let texels = if conditions.perspective { 1.0 } else { 0.5 };
    texels * conditions.texel * conditions.sine()
}

/// The receiver is moved by `shadow_depth_bias` world units along the ray to the light, and by `shadow_normal_bias` times √2 texels at
/// its distance along the axis, along its normal (Bevy 0.20, `shadows.wesl`; the √2 is in `light.rs`).
fn bevy_settings(wanted: &WorldBias, conditions: &Conditions) -> Result<Vec<Span>, EngineError> {
    let normal = wanted.normal / (SQRT_2 * conditions.texel);
    Ok(vec![exactly(wanted.constant / conditions.ray), exactly(normal)])
}

fn bevy_world(values: &[f64], conditions: &Conditions) -> Result<WorldRange, EngineError> {
    let (constant, normal) = (values[0] * conditions.ray, values[1] * SQRT_2 * conditions.texel);
    Ok(WorldRange::exactly(WorldBias { constant, slope: 0.0, normal }))
}

/// A directional light's receiver is moved by a hundredth of `shadow_bias` times the depth range times the filter's radius, along the
/// light's direction; and by `shadow_normal_bias` texels along its normal, less what of that lies along the light's direction
/// (`BIAS_FUNC` in `scene_forward_clustered.glsl`; the factors are in `light_storage.cpp`, the range and the texel in
/// `renderer_scene_cull.cpp`). N·s without its part along L is N·s and a constant part of −s N·L.
///
/// A spot light's receiver is moved by 10/`map_size` of its distance from the light times `shadow_normal_bias` times 1 − N·L, along
/// its normal; and its depth, before it is divided by the distance along the axis, by a hundredth of `shadow_bias` times the
/// light's range over its distance (`light_process_spot` in `scene_forward_lights_inc.glsl`, `light_storage.cpp`).
fn godot_settings(wanted: &WorldBias, conditions: &Conditions) -> Result<Vec<Span>, EngineError> {
    let normal = share(wanted.normal, godot_offset(conditions));
    let bias = if conditions.perspective {
        conditions.depth_step(wanted.constant)? / godot_spot_step(conditions)
    } else {
        (wanted.constant + wanted.normal * conditions.facing) / godot_range(conditions)
    };
    Ok(vec![exactly(bias), exactly(normal)])
}

fn godot_world(values: &[f64], conditions: &Conditions) -> Result<WorldRange, EngineError> {
    let normal = values[1] * godot_offset(conditions);
    let constant = if conditions.perspective {
        conditions.world_step(values[0] * godot_spot_step(conditions))?
    } else {
        values[0] * godot_range(conditions) - normal * conditions.facing
    };
    Ok(WorldRange::exactly(WorldBias { constant, slope: 0.0, normal }))
}

/// World units along the normal that a `shadow_normal_bias` of 1 is.
fn godot_offset(conditions: &Conditions) -> f64 {
    if conditions.perspective {
        10.0 / f64::from(conditions.map_size) * godot_length(conditions) * (1.0 - conditions.facing)
    } else {
        conditions.texel
    }
}

/// World units along a directional light's axis that a `shadow_bias` of 1 is.
fn godot_range(conditions: &Conditions) -> f64 {
    conditions.filter_radius.unwrap_or(2.0) * (conditions.far - conditions.near) / 100.0
}

/// The step of depth that a `shadow_bias` of 1 is for a spot light, whose range is its far plane.
fn godot_spot_step(conditions: &Conditions) -> f64 {
    conditions.far / godot_length(conditions) / conditions.distance / 100.0
}

/// The receiver's distance from the light itself.
fn godot_length(conditions: &Conditions) -> f64 {
    conditions.distance / conditions.ray
}
