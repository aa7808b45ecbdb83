//! Burley 2006.

mod bias;
mod deep;
mod opacity;
mod soft;

use crate::figure::Figure;

/// The figures, in the order of the gallery.
pub const FIGURES: &[&Figure] = &[&bias::I75, &soft::I76, &opacity::I77, &deep::DEEP];
