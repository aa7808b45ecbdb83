//! Where to look in a shadow map: sample patterns and keyed randomness.

mod key;
mod taps;

pub use key::Key;
pub use taps::{Pattern, Taps};
