//! Each paper as one short choice of parts.

use crate::williams::Williams;
use crate::{Biased, Conditional, OccluderFalloff, Pcf, Soft};
use umbrage_plane::Bias;
use umbrage_sample::{Centre, Density, Disc, Jittered};

/// Williams 1978: nearest texel, no dither, two quanta of 16-bit depth (W78-2, W78-11, W78-12).
///
/// Meant for a 16-bit screen-depth map; the historical size is 512² in both views.
pub fn williams78() -> Williams {
    Williams::default()
}

/// Reeves, Salesin & Cook 1987 as their listing sets the parameters (R87-12; the `fig4` preset of E-R18).
pub fn reeves87() -> Pcf {
    Pcf::default()
}

/// Reeves' advice in the text: at least two samples an axis, from at least four texels (R87-12, E-R18).
pub fn reeves87_recommended() -> Pcf {
    Pcf::default().with_pattern(Jittered::default().with_min_samples(2)).with_min_size(1.0)
}

/// The ordinary depth buffer of Reeves' Figure 6a: one sample at the centre, no jitter, nearest texel (R87-15).
pub fn ordinary(bias: Bias) -> Pcf<Centre> {
    Pcf::default().with_pattern(Centre).with_depth(Biased::constant(bias)).with_res_factor(0.0).with_min_size(0.0)
}

/// Woo 1992: the listing of 1987 without any bias, over a map of midpoints (W92-3, W92-5, W92-8).
///
/// Meant for a spot light with [`Rules::SPOT`](umbrage_plane::Rules::SPOT), which are Woo's rule of the cone (W92-6); the paper's map is 256² under 75°.
pub fn woo92() -> Pcf {
    Pcf::default().with_depth(Biased::constant(Bias::ZERO))
}

/// Wang & Molnar 1994: the nearest four texels of a map of second surfaces, the tangent plane where they disagree, no bias (WM94-5 to WM94-15).
pub fn wang_molnar94() -> Conditional {
    Conditional::default()
}

/// Burley 2006: soft shadows from one map with the bias cone (B06-1 to B06-8).
pub fn burley() -> Soft {
    Soft::default()
}

/// Fernando 2005, as Burley describes it: search taps spread evenly, their plain mean, a constant bias (B06-9).
pub fn fernando(bias: Bias) -> Soft<Biased> {
    let search = Disc::default().with_density(Density::Uniform);
    burley().with_search(search).with_falloff(OccluderFalloff::Flat).with_depth(Biased::constant(bias))
}
