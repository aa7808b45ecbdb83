//! The programs are in `examples/`: run one with `cargo run -p umbrage-examples --example soft_shadows`.
