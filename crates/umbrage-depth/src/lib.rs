//! What a shadow map stores: depth rules and storages.

mod map;
mod rule;

pub use map::DepthMap;
pub use rule::DepthRule;
