use super::raster::vulkan_unit;
use super::{Formulas, Model, Span, exactly, share};
use crate::{Conditions, EngineError, WorldBias, WorldRange, data};
use std::f64::consts::SQRT_2;

pub(crate) const URP: Model =
    Model { about: &data::URP, formulas: Some(Formulas { settings: urp_settings, world: urp_world }), unit: None };

pub(crate) const HDRP: Model =
    Model { about: &data::HDRP, formulas: Some(Formulas { settings: hdrp_settings, world: hdrp_world }), unit: None };

/// What `SetGlobalDepthBias(1.0f, 2.5f)` adds by itself (`ShadowUtils.RenderShadowSlice`).
const URP_SLOPE: f64 = 2.5;

/// The most that the pipeline asset takes (`UniversalRenderPipelineAsset.ValidateShadowBias`).
const URP_MOST: f64 = 10.0;

/// What a slope bias of 1 is (`HDShadowUtils.GetSlopeBias`, and `baseBias` in `SetCommonShadowRequestSettings`) where the filter is not PCSS.
const HDRP_SLOPE: f64 = 5.0;

/// What every comparison is moved by, a depth from 0 to 1 (`FIXED_UNIFORM_BIAS` in `HDShadowAlgorithms.hlsl`).
const HDRP_FIXED: f64 = 1.0 / 65_536.0;

/// Casters are moved by the depth bias in texels along the ray away from the light, and along their normals inward by the normal bias
/// in texels times 1 − N·L (`ApplyShadowBias` in `Shadows.hlsl`). Both are multiplied by the filter's radius, and a spot light's
/// texel is half of one at its far plane (`ShadowUtils.GetShadowBias`). One unit of the depth format and a slope of 2.5 are added
/// whatever is set.
fn urp_settings(wanted: &WorldBias, conditions: &Conditions) -> Result<Vec<Span>, EngineError> {
    let texel = urp_texel(conditions);
    let [less, more] = vulkan_unit(conditions);
    let depth = |unit: f64| -> Result<f64, EngineError> {
        let left = wanted.constant - conditions.world_step(unit)?;
        Ok((left / (texel * conditions.ray)).clamp(0.0, URP_MOST))
    };
    let normal = share(wanted.normal, texel * (1.0 - conditions.facing)).clamp(0.0, URP_MOST);
    Ok(vec![[depth(more)?, depth(less)?], exactly(normal)])
}

fn urp_world(values: &[f64], conditions: &Conditions) -> Result<WorldRange, EngineError> {
    let texel = urp_texel(conditions);
    let depth = values[0].clamp(0.0, URP_MOST) * texel * conditions.ray;
    let normal = values[1].clamp(0.0, URP_MOST) * texel * (1.0 - conditions.facing);
    let [least, most] = vulkan_unit(conditions);
    let bias = |unit: f64| Ok(WorldBias { constant: depth + conditions.world_step(unit)?, slope: URP_SLOPE, normal });
    Ok(WorldRange { least: bias(least)?, most: bias(most)? })
}

/// World units that URP takes for a texel, times the filter's radius.
fn urp_texel(conditions: &Conditions) -> f64 {
    let texels = if conditions.perspective { 0.5 * conditions.far / conditions.distance } else { 1.0 };
    texels * conditions.texel * conditions.filter_radius.unwrap_or(1.0)
}

/// The receiver is moved along its normal by the normal bias times √2 texels, a spot light's at its distance from the light itself
/// (`EvalShadow_NormalBiasProj` in `HDShadowAlgorithms.hlsl`; the √2 is in `SetCommonShadowRequestSettings`). Casters are drawn with
/// a depth bias of one unit and a slope of five times the slope bias (`SetGlobalDepthBias(1.0f, slopeBias)`).
fn hdrp_settings(wanted: &WorldBias, conditions: &Conditions) -> Result<Vec<Span>, EngineError> {
    Ok(vec![exactly(wanted.normal / hdrp_offset(conditions)), exactly(wanted.slope / HDRP_SLOPE)])
}

fn hdrp_world(values: &[f64], conditions: &Conditions) -> Result<WorldRange, EngineError> {
    let normal = values[0] * hdrp_offset(conditions);
    let slope = values[1] * HDRP_SLOPE;
    let [least, most] = vulkan_unit(conditions);
    let bias = |unit: f64| Ok(WorldBias { constant: conditions.world_step(HDRP_FIXED + unit)?, slope, normal });
    Ok(WorldRange { least: bias(least)?, most: bias(most)? })
}

/// World units along the normal that a normal bias of 1 is.
fn hdrp_offset(conditions: &Conditions) -> f64 {
    SQRT_2 * conditions.texel / conditions.ray
}
