//! Williams 1978.

mod applied;
mod scenes;
mod shadow;
mod views;

use crate::figure::Figure;

/// The figures, in the order of the gallery.
pub const FIGURES: &[&Figure] = &[
    &views::F1,
    &views::F2,
    &shadow::F3,
    &shadow::F4,
    &shadow::F5,
    &applied::F6,
    &scenes::F7,
    &scenes::F8,
    &scenes::COST,
    &scenes::PLANE,
    &views::TEAPOT,
];
