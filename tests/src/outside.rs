//! Filters as a stranger writes them: with nothing but what the crates make public.

mod pcss;
mod variance;

pub use pcss::Pcss;
pub use variance::Variance;
