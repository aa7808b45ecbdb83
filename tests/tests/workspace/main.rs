//! The laws that several crates keep together. One program: what it puts together is linked, and made of generic parts, once.

mod auto;
mod cut_outs;
mod facet_files;
mod far;
mod filters;
mod flat;
mod kernels;
mod lengths;
mod pictures;
mod reported;
mod second_depth;
mod union;
