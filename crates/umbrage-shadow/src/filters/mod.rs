//! How the answers are combined: each filter is one way to ask a [`Query`](crate::Query).

mod conditional;
pub mod integer_first;
mod ordinary;
mod pcf;
mod soft;
pub mod williams;

pub use conditional::{Conditional, VirtualWhen};
pub use integer_first::IntegerFirst;
pub use ordinary::Ordinary;
pub use pcf::Pcf;
pub use soft::{Extent, Falloff, Opacity, Soft, Softness, factor};
pub use williams::Williams;
