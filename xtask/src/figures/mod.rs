//! The catalogue: one entry a row, in the order of the gallery.

mod curves;
mod reeves_idea;
mod reeves_parameters;
mod studio;
mod williams;

use crate::figure::Figure;

/// Every figure.
pub const FIGURES: &[&Figure] = &[
    &williams::F1,
    &williams::F2,
    &williams::F3,
    &williams::F4,
    &williams::F5,
    &williams::F6,
    &williams::TEAPOT,
    &reeves_idea::F1,
    &reeves_idea::F2,
    &reeves_idea::F3,
    &reeves_idea::F4,
    &reeves_idea::F5,
    &reeves_idea::F6,
    &reeves_parameters::F7,
    &reeves_parameters::F8,
    &reeves_parameters::F9,
    &reeves_parameters::F10,
    &reeves_parameters::FLOAT,
    &reeves_parameters::PASS1,
    &reeves_parameters::T2,
    &curves::ACNE,
    &curves::NOISE,
];
