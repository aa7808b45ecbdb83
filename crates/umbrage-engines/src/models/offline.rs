use super::{Formulas, Model, Span, exactly};
use crate::{Conditions, EngineError, WorldBias, WorldRange, data};

pub(crate) const RSL: Model = Model { about: &data::RSL, formulas: Some(Formulas { settings, world }), unit: None };

/// Depths of a shadow file are distances in the light's own space, so that `bias0` and `bias1` are world units along its axis as they are.
fn settings(wanted: &WorldBias, _: &Conditions) -> Result<Vec<Span>, EngineError> {
    Ok(vec![exactly(wanted.constant); 2])
}

/// A sample is lit below `bias0`, dark from `bias1` on, and between both a ramp (Aqsis, `CqPcfAccum::accumulate` in `sampleaccum.h`).
fn world(values: &[f64], _: &Conditions) -> Result<WorldRange, EngineError> {
    let (least, most) = (values[0].min(values[1]), values[0].max(values[1]));
    Ok(WorldRange { least: WorldBias::constant(least), most: WorldBias::constant(most) })
}
