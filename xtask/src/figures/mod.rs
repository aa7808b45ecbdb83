//! The catalogue: one entry a row, in the order of the gallery.

mod all_round;
mod bump;
mod burley;
mod burley_bias;
mod burley_deep;
mod burley_opacity;
mod curves;
mod faults;
mod heights;
mod methods;
mod paging;
mod penumbra;
mod reeves_idea;
mod reeves_listing;
mod reeves_parameters;
mod reeves_scenes;
mod reeves_tables;
mod slice;
mod softness;
mod sphere_plane;
mod spheres;
mod studio;
mod wang_molnar_bias;
mod wang_molnar_cost;
mod wang_molnar_failures;
mod wang_molnar_ideas;
mod wang_molnar_listing;
mod wang_molnar_others;
mod wang_molnar_planes;
mod wang_molnar_scenes;
mod wang_molnar_second;
mod wang_molnar_spaces;
mod wang_molnar_table;
mod williams_scenes;
mod williams_shadow;
mod williams_views;
mod woo;

use crate::figure::Figure;

/// Every figure.
pub const FIGURES: &[&Figure] = &[
    &williams_views::F1,
    &williams_views::F2,
    &williams_shadow::F3,
    &williams_shadow::F4,
    &williams_shadow::F5,
    &williams_shadow::F6,
    &williams_scenes::F7,
    &williams_scenes::F8,
    &williams_scenes::COST,
    &williams_scenes::PLANE,
    &williams_views::TEAPOT,
    &reeves_idea::F1,
    &reeves_idea::F2,
    &reeves_idea::F3,
    &reeves_listing::F4,
    &reeves_idea::F5,
    &reeves_idea::F6,
    &reeves_parameters::F7,
    &reeves_parameters::F8,
    &reeves_parameters::F9,
    &reeves_parameters::F10,
    &reeves_scenes::F11,
    &reeves_scenes::F12,
    &reeves_scenes::F13,
    &reeves_scenes::F14,
    &reeves_parameters::FLOAT,
    &reeves_parameters::PASS1,
    &all_round::OMNI,
    &bump::BUMP,
    &reeves_tables::T1,
    &reeves_tables::T2,
    &heights::NOPEN,
    &woo::F1,
    &woo::F2,
    &woo::F3,
    &woo::RIM,
    &woo::COST,
    &wang_molnar_ideas::F1,
    &wang_molnar_ideas::F2,
    &wang_molnar_bias::F3,
    &wang_molnar_table::F4,
    &wang_molnar_second::F5,
    &wang_molnar_second::F6,
    &wang_molnar_failures::F7,
    &wang_molnar_planes::F8,
    &wang_molnar_failures::F9,
    &wang_molnar_listing::F10,
    &wang_molnar_spaces::F11,
    &wang_molnar_cost::F12,
    &wang_molnar_scenes::F13,
    &wang_molnar_scenes::F14,
    &wang_molnar_scenes::F15,
    &wang_molnar_failures::SHEETS,
    &wang_molnar_others::TAGS,
    &wang_molnar_others::PCF_BIAS,
    &wang_molnar_cost::COST,
    &burley_bias::I75,
    &burley::I76,
    &burley_opacity::I77,
    &burley_deep::DEEP,
    &curves::ACNE,
    &curves::NOISE,
    &faults::FAULTS,
    &methods::SIZES,
    &methods::GRAZING,
    &methods::PRESETS,
    &paging::PAGING,
    &softness::SOFTNESS,
];
