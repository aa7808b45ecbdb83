//! Figures that no paper has: methods side by side, fault by fault, on all scenes.

mod area;
mod auto;
mod curves;
mod engines;
mod faults;
mod judge;
mod kinds;
mod matrix;
mod methods;
mod offsets;
mod paging;
mod sheet;
mod softness;
mod storage;
mod where_wrong;

use crate::figure::Figure;

/// The figures, in the order of the gallery.
pub const FIGURES: &[&Figure] = &[
    &curves::ACNE,
    &curves::NOISE,
    &faults::FAULTS,
    &engines::BIAS,
    &offsets::OFFSETS,
    &methods::SIZES,
    &methods::GRAZING,
    &matrix::PRESETS,
    &paging::PAGING,
    &storage::STORAGE,
    &softness::SOFTNESS,
    &auto::SHOWN,
    &auto::LADDER_OF_PARTS,
    &auto::BYTES,
    &area::AREA,
    &kinds::COMMON,
    &kinds::KINDS,
    &where_wrong::WHERE,
];
