//! Reeves, Salesin & Cook 1987.

mod all_round;
mod bias;
mod bump;
mod hammered;
mod heights;
mod idea;
mod listing;
mod parameters;
mod scenes;
mod tables;

use crate::figure::Figure;

/// The figures, in the order of the gallery.
pub const FIGURES: &[&Figure] = &[
    &idea::F1,
    &idea::F2,
    &idea::F3,
    &listing::F4,
    &idea::F5,
    &idea::F6,
    &parameters::F7,
    &parameters::F8,
    &bias::F9,
    &parameters::F10,
    &scenes::F11,
    &scenes::F12,
    &scenes::F13,
    &scenes::F14,
    &parameters::FLOAT,
    &parameters::PASS1,
    &all_round::OMNI,
    &bump::BUMP,
    &tables::T1,
    &tables::T2,
    &heights::NOPEN,
];
