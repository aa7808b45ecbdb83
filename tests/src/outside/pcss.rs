// The one that `Filter`'s documentation shows.
include!("../../../crates/umbrage-shadow/examples/filter/pcss.rs");
