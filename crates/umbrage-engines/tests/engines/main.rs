//! What the conversions of all engines are held to.

mod conditions;
mod data;
mod examples;
mod refusals;
mod round_trip;
mod text;
mod units;

use umbrage_engines::{Conditions, DepthFormat, WorldBias};

/// Whether two numbers agree to a millionth of the larger one.
fn near(a: f64, b: f64) -> bool {
    (a - b).abs() <= 1e-6 * a.abs().max(b.abs())
}

fn near_bias(a: &WorldBias, b: &WorldBias) -> bool {
    near(a.constant, b.constant) && near(a.slope, b.slope) && near(a.normal, b.normal)
}

/// The sun over 20 units with 1024 texels, from 0 to 100, 30 away on a surface tilted by 60 degrees.
fn sun() -> Conditions {
    Conditions::orthographic(20.0, 1024, 0.0, 100.0, 30.0).unwrap().with_light_at(0.5)
}

/// A spot light of 45 degrees on each side with 1000 texels, from 0.5 to 50, 10 away on a surface tilted by 60 degrees:
/// its texels are 20/1000 there.
fn spot() -> Conditions {
    Conditions::perspective(std::f64::consts::FRAC_PI_4, 1000, 0.5, 50.0, 10.0).unwrap().with_light_at(0.5)
}

/// Every format, either way round.
fn ways(conditions: Conditions) -> impl Iterator<Item = Conditions> {
    DepthFormat::ALL
        .into_iter()
        .flat_map(move |format| [false, true].map(|reversed| conditions.with_format(format).with_reversed(reversed)))
}
