//! The project's chores: `figures`, `ci`, `tidy`.
fn main() {}
