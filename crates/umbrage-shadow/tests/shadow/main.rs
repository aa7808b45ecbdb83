//! The algorithms against the papers' figures and numbers. One program: what it puts together from filters, patterns and maps is
//! compiled once for all.

mod around;
mod biases;
mod burley;
mod deep;
mod explained;
mod hdrp_pcss;
mod moments;
mod reeves;
mod tags;
mod traps;
mod wang_molnar;
mod williams;
mod woo;
