//! The programs are in `examples/`: run one with `cargo run -p umbrage-examples --example soft_shadows`.

#[doc = include_str!("../../crates/GUIDE.md")]
pub mod guide {}
