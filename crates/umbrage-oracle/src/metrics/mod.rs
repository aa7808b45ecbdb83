//! Measures of shadow images beside the truth, each a pure function of numbers.
//!
//! Images are [`Grid`]s of shadow, 1 dark, rows from the top; masks are `&[bool]` of the same layout. Lengths are
//! pixels, and pixel (i, j) has its centre at (i + ½, j + ½). What cannot be measured (an empty mask, no edge) is
//! `None`, never a number.
//!
//! | measure | function |
//! |---|---|
//! | edge width | [`profile`], [`Profile::width`] |
//! | false shadow | [`lit_mask`], [`false_shadow`] |
//! | regularity | [`spectrum`] |
//! | midpoint shift | [`Profile::midpoint`], [`Profile::shift`] |
//! | levels | [`distinct_levels`], [`levels_per_region`] |
//! | noise | [`penumbra_mask`], [`rms`] |
//! | contact gap | [`contact_gap`] |
//! | leak | [`dark_mask`], [`leak`] |
//! | where second depth is judged | [`silhouette_distance`] |
//! | fraction of pixels | [`share`] |
//! | how far a shadow is moved | [`displacement`] |

mod contour;
mod displacement;
mod edge;
mod fit;
mod mask;
mod silhouette;
mod spectrum;
mod statistics;

use glam::DVec2;

pub use contour::{Deviation, Segment, contour, contour_deviation};
pub(crate) use contour::{deviation, offsets};
pub use displacement::displacement;
pub use edge::{Band, Profile, contact_gap, profile};
pub use fit::{Fit, linear_fit, log_log_fit};
pub use mask::{both, centroid, dark_mask, edge_mask, grown, iou, lit_mask, penumbra_mask, share};
pub use silhouette::silhouette_distance;
pub use spectrum::{Spectrum, spectrum};
pub use statistics::{distinct_levels, false_shadow, leak, levels_per_region, lone_pixels, mean, rms};

/// An image of one number per pixel, rows from the top.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Grid<'a> {
    /// The pixels. What does not fill a last row is ignored.
    pub values: &'a [f32],
    /// Pixels a row. 0 means an empty image.
    pub width: usize,
}

impl<'a> Grid<'a> {
    /// `values` in rows of `width`.
    pub const fn new(values: &'a [f32], width: usize) -> Self {
        Self { values, width }
    }

    /// Whole rows.
    pub const fn height(&self) -> usize {
        match self.values.len().checked_div(self.width) {
            Some(height) => height,
            None => 0,
        }
    }

    /// The pixel at column `x` of row `y`; NaN outside.
    pub fn at(&self, x: usize, y: usize) -> f32 {
        if x < self.width { self.values.get(y * self.width + x).copied().unwrap_or(f32::NAN) } else { f32::NAN }
    }

    /// The image between pixel centres, bilinear; in the outer half pixel as at the centres. `None` outside, and beside a NaN.
    pub fn between(&self, at: DVec2) -> Option<f64> {
        let size = DVec2::new(self.width as f64, self.height() as f64);
        if !(at.cmpge(DVec2::ZERO).all() && at.cmplt(size).all()) {
            return None;
        }
        let at = (at - 0.5).clamp(DVec2::ZERO, size - 1.0);
        let (low, part) = (at.floor(), at - at.floor());
        let high = (low + 1.0).min(size - 1.0);
        let value = |x: f64, y: f64| f64::from(self.at(x as usize, y as usize));
        let row = |y: f64| value(low.x, y) * (1.0 - part.x) + value(high.x, y) * part.x;
        Some(row(low.y) * (1.0 - part.y) + row(high.y) * part.y).filter(|value| !value.is_nan())
    }

    /// The rectangle of `width` × `height` pixels at column `x`, row `y`, cut off at the image's border.
    pub fn window(&self, x: usize, y: usize, width: usize, height: usize) -> Vec<f32> {
        let columns = x.min(self.width)..(x + width).min(self.width);
        let rows = y.min(self.height())..(y + height).min(self.height());
        rows.flat_map(|row| self.values[row * self.width..][columns.clone()].iter().copied()).collect()
    }
}
