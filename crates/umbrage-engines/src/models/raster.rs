use super::{Formulas, Model, Span, exactly};
use crate::{Conditions, EngineError, WorldBias, WorldRange, data};

pub(crate) const D3D: Model = Model {
    about: &data::D3D,
    formulas: Some(Formulas {
        settings: |wanted, conditions| settings(wanted, conditions, d3d_unit),
        world: |values, conditions| world(values, conditions, d3d_unit),
    }),
    unit: Some(d3d_unit),
};

pub(crate) const VULKAN: Model = Model {
    about: &data::VULKAN,
    formulas: Some(Formulas {
        settings: |wanted, conditions| settings(wanted, conditions, vulkan_unit),
        world: |values, conditions| world(values, conditions, vulkan_unit),
    }),
    unit: Some(vulkan_unit),
};

pub(crate) const WEB_GPU: Model = Model {
    about: &data::WEB_GPU,
    formulas: Some(Formulas {
        settings: |wanted, conditions| settings(wanted, conditions, d3d_unit),
        world: |values, conditions| world(values, conditions, d3d_unit),
    }),
    unit: Some(d3d_unit),
};

/// Bits of a 32-bit float's mantissa, without the hidden one.
const MANTISSA: i32 = 23;

/// r: the smallest depth above 0 of a format of whole numbers; for floating point 2^(exponent of the primitive's largest depth − 23)
/// (Direct3D 11, *Depth Bias*).
fn d3d_unit(conditions: &Conditions) -> Span {
    match conditions.format.bits() {
        Some(bits) => exactly(1.0 / (2f64.powi(bits) - 1.0)),
        None => float_unit(conditions),
    }
}

/// r: at most 2 · 2^−n for whole numbers of n bits, 2^−n where it is exact; for floating point 2^(e − 23) (Vulkan 1.3, *Depth Bias
/// Computation*).
pub(super) fn vulkan_unit(conditions: &Conditions) -> Span {
    match conditions.format.bits() {
        Some(bits) => [2f64.powi(-bits), 2f64.powi(1 - bits)],
        None => float_unit(conditions),
    }
}

/// The primitive reaches the receiver's depth at least and 1 at most.
fn float_unit(conditions: &Conditions) -> Span {
    [2f64.powi(exponent(conditions.depth()) - MANTISSA), 2f64.powi(-MANTISSA)]
}

/// The exponent of a depth from 0 to 1 as a 32-bit float: that of the smallest normal number for 0 and for what is smaller.
fn exponent(depth: f64) -> i32 {
    let biased = ((depth as f32).to_bits() >> MANTISSA) & 0xff;
    (biased as i32).max(1) - 127
}

/// The way that depth runs: 1 where it grows away from the light.
fn away(conditions: &Conditions) -> f64 {
    if conditions.reversed { -1.0 } else { 1.0 }
}

/// Bias = constant · r + slope · m, where m is the change of depth from texel to texel, added to what casters store. No clamp is wanted.
fn settings(
    wanted: &WorldBias,
    conditions: &Conditions,
    unit: fn(&Conditions) -> Span,
) -> Result<Vec<Span>, EngineError> {
    let step = conditions.depth_step(wanted.constant)?;
    let [less, more] = unit(conditions);
    let away = away(conditions);
    // The same number of units moves by most where a unit is largest.
    let (least, most) = if step < 0.0 { (step / less, step / more) } else { (step / more, step / less) };
    // No −0 where nothing is wanted.
    let signed = |value: f64| away * value + 0.0;
    Ok(vec![[signed(least), signed(most)], exactly(signed(wanted.slope)), exactly(0.0)])
}

/// A clamp limits the sum. Where it does so, the bias is the clamp itself, and no longer grows with the slope.
fn world(values: &[f64], conditions: &Conditions, unit: fn(&Conditions) -> Span) -> Result<WorldRange, EngineError> {
    let (constant, slope, clamp) = (values[0], values[1], values[2]);
    let away = away(conditions);
    let bias = |unit: f64| -> Result<WorldBias, EngineError> {
        let sum = constant * unit + slope * conditions.depth_slope();
        let limited = if clamp > 0.0 {
            sum.min(clamp)
        } else if clamp < 0.0 {
            sum.max(clamp)
        } else {
            sum
        };
        if limited == sum {
            let constant = conditions.world_step(away * constant * unit)?;
            Ok(WorldBias { constant, slope: away * slope, normal: 0.0 })
        } else {
            Ok(WorldBias::constant(conditions.world_step(away * limited)?))
        }
    };
    let [first, second] = unit(conditions);
    let (first, second) = (bias(first)?, bias(second)?);
    let turned = first.constant > second.constant;
    let (least, most) = if turned { (second, first) } else { (first, second) };
    Ok(WorldRange { least, most })
}
