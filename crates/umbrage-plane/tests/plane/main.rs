//! Views, receivers and footprints: published numbers, and laws. One program, so that it is linked once.

mod batches;
mod cells;
mod fitted;
mod vectors;
mod views;
mod windows;
