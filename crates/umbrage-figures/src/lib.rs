//! The papers' figures, each beside the truth and with a measured verdict: a folder for each paper, one catalogue, and what the
//! repository keeps of them. `cargo xtask figures` starts the program of this package.
//!
//! A figure is a function from a [`Context`] to what [`umbrage_report`] writes. Where to add one: a constant in a module of
//! its paper, and its line in the `FIGURES` of that paper's `mod.rs`.

#![expect(clippy::unnecessary_wraps, reason = "all figures are made by functions of one type")]

pub mod catalogue;
mod figure;
pub mod goldens;
mod run;
mod stage;

mod burley;
mod questions;
mod reeves;
mod umbrage;
mod wang_molnar;
mod williams;
mod woo;

pub use figure::{Context, Figure, Paper};
pub use run::Run;
pub use stage::truths::Truths;
