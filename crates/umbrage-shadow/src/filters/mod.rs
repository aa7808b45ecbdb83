//! How results are combined: each filter is one way to use a [`Query`](crate::Query).

mod conditional;
mod dual_plane;
mod filtered_depth;
mod hdrp_pcss;
pub mod integer_first;
pub mod moments;
mod pcf;
mod soft;
pub mod williams;

pub use conditional::{Conditional, VirtualWhen};
pub use dual_plane::DualPlane;
pub use filtered_depth::FilteredDepth;
pub use hdrp_pcss::HdrpPcss;
pub use integer_first::IntegerFirst;
pub use moments::FromMoments;
pub use pcf::Pcf;
pub use soft::{MapRadius, OccluderFalloff, Opacity, Soft, Softness};
pub use williams::Williams;
