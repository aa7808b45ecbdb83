//! What the report is made of: each row is ours beside a peer, measured in turn in this program, with the goal that it has.

mod filters;
mod job;
mod pass1;
mod pictures;
mod rows;
mod threads;

pub use rows::{Goal, Row, Settings};

use crate::in_pool;

/// Measures everything, and calls `print` with a line of text for each row as soon as it is known, then for each other fact.
pub fn measure(settings: Settings, mut print: impl FnMut(String)) {
    let mut rows = |rows: Vec<Row>| rows.into_iter().for_each(|row| print(row.to_string()));
    let mut memory = Vec::new();
    for &side in settings.sides() {
        rows(in_pool(1, || pass1::raster(settings, side)));
        let (bytes, taken) = in_pool(1, || pass1::rules(settings, side)).into_iter().partition(|row| row.unit == "KiB");
        rows(taken);
        memory.extend::<Vec<Row>>(bytes);
    }
    rows(memory);
    for &side in settings.sides() {
        rows(in_pool(1, || filters::look_ups(settings, side)));
    }
    rows(in_pool(1, || job::whole(settings)));
    rows(in_pool(1, || pictures::shadowed(settings)));
    let (spin, scaling) = threads::two(settings);
    rows(scaling);
    print(format!("fact\tspin\t{spin:.2}"));
    print(format!("fact\tinstructions\t{}", crate::kernels::instruction_set()));
}
