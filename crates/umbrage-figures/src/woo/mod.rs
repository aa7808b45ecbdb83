//! Woo 1992: the midpoint between the two nearest surfaces, the rule of the cone, whole units first.

mod cost;
mod profile;
mod rim;
mod room;

use crate::figure::Figure;

/// The figures, in the order of the gallery.
pub const FIGURES: &[&Figure] = &[&profile::F1, &room::F2, &room::F3, &rim::RIM, &cost::COST];
