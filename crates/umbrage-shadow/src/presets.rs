//! Each paper as one short choice of parts.

use crate::williams::{Dither, Lookup, Williams};
use crate::{Biased, Pcf};
use umbrage_plane::Bias;
use umbrage_sample::{Centre, Jittered};

/// Williams 1978: nearest texel, no dither, two quanta of 16-bit depth (W78-2, W78-11, W78-12).
///
/// Meant for a 16-bit screen-depth map; the historical size is 512² in both views.
pub const fn williams78() -> Williams {
    Williams { bias: Bias::Map(2.0 / 65_535.0), lookup: Lookup::Nearest, dither: Dither::OFF }
}

/// Reeves, Salesin & Cook 1987 as their listing sets the parameters (R87-12; the `fig4` preset of E-R18).
pub fn reeves87() -> Pcf {
    Pcf::default()
}

/// Reeves' advice in the text: at least two samples an axis, from at least four texels (R87-12, E-R18).
pub fn reeves87_recommended() -> Pcf {
    Pcf { pattern: Jittered { min_samples: 2, ..Jittered::default() }, min_size: 1.0, ..Pcf::default() }
}

/// The ordinary depth buffer of Reeves' Figure 6a: one sample at the centre, no jitter, nearest texel (R87-15).
pub fn ordinary(bias: Bias) -> Pcf<Centre> {
    Pcf { pattern: Centre, depth: Biased::constant(bias), res_factor: 0.0, min_size: 0.0, cull: true }
}
