use super::{Formulas, Model, Span, exactly, share};
use crate::{Conditions, EngineError, WorldBias, WorldRange, data};

pub(crate) const THREE: Model = Model {
    about: &data::THREE,
    formulas: Some(Formulas { settings: three_settings, world: three_world }),
    unit: None,
};

pub(crate) const BABYLON: Model = Model {
    about: &data::BABYLON,
    formulas: Some(Formulas { settings: babylon_settings, world: babylon_world }),
    unit: None,
};

/// `shadowCoord.z += shadowBias`, a depth from 0 to 1 and −= where it is reversed: negative toward the light. `normalBias` moves the
/// receiver in world space (three.js r187, `shadowmap_pars_fragment.glsl.js`, `shadowmap_vertex.glsl.js`).
fn three_settings(wanted: &WorldBias, conditions: &Conditions) -> Result<Vec<Span>, EngineError> {
    Ok(vec![exactly(-conditions.depth_step(wanted.constant)?), exactly(wanted.normal)])
}

fn three_world(values: &[f64], conditions: &Conditions) -> Result<WorldRange, EngineError> {
    let constant = conditions.world_step(-values[0])?;
    Ok(WorldRange::exactly(WorldBias { constant, slope: 0.0, normal: values[1] }))
}

/// Without a depth texture the map stores (z + min)/(min + max) of the clip space before it is divided, plus `bias`: linear in the
/// distance for a spot light as well, 1/(far − near) per unit. A depth texture has `bias` added to z from −1 to 1, so half of it to a
/// depth from 0 to 1; where z is from 0 to 1, `BIASFACTOR` is ½ (Babylon.js 9.35, `shadowMapVertexMetric`).
///
/// Casters shrink by `normalBias` times the sine of the angle to the light (`shadowMapVertexNormalBias`).
fn babylon_settings(wanted: &WorldBias, conditions: &Conditions) -> Result<Vec<Span>, EngineError> {
    let bias = if conditions.depth_texture {
        2.0 * conditions.depth_step(wanted.constant)?
    } else {
        wanted.constant / (conditions.far - conditions.near)
    };
    Ok(vec![exactly(bias), exactly(share(wanted.normal, conditions.sine()))])
}

fn babylon_world(values: &[f64], conditions: &Conditions) -> Result<WorldRange, EngineError> {
    let constant = if conditions.depth_texture {
        conditions.world_step(0.5 * values[0])?
    } else {
        values[0] * (conditions.far - conditions.near)
    };
    Ok(WorldRange::exactly(WorldBias { constant, slope: 0.0, normal: values[1] * conditions.sine() }))
}
