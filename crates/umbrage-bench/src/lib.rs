//! Criterion benches, kept apart so that no other crate pays for criterion.
