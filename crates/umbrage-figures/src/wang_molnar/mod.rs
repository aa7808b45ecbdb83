//! Wang & Molnar 1994.

mod bias;
mod cost;
mod failures;
mod ideas;
mod listing;
mod others;
mod planes;
mod scenes;
mod second;
mod spaces;
mod table;

use crate::figure::Figure;

/// The figures, in the order of the gallery.
pub const FIGURES: &[&Figure] = &[
    &ideas::F1,
    &ideas::F2,
    &bias::F3,
    &table::F4,
    &second::F5,
    &second::F6,
    &failures::F7,
    &planes::F8,
    &failures::F9,
    &listing::F10,
    &spaces::F11,
    &cost::F12,
    &scenes::F13,
    &scenes::F14,
    &scenes::F15,
    &failures::SHEETS,
    &others::TAGS,
    &others::PCF_BIAS,
    &cost::COST,
];
