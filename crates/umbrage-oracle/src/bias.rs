//! Is there a bias that does? Predicted from a scene's numbers, or found by trying (Wang & Molnar 1994).

use crate::predict::{acne_free_bias, slack};
use std::fmt;
use umbrage_depth::Stored;

/// The biases between false shadow and shadows that come off their casters, world units.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct BiasWindow {
    /// The smallest without false shadow; `None` when none was found.
    pub acne_free: Option<f64>,
    /// The largest under which shadows begin at their casters; +∞ when any does, `None` when none does.
    pub keeps_contact: Option<f64>,
}

impl BiasWindow {
    /// True when some bias has neither fault. It lies between the two, both included.
    pub fn works(&self) -> bool {
        matches!((self.acne_free, self.keeps_contact), (Some(low), Some(high)) if low <= high)
    }
}

impl fmt::Display for BiasWindow {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        match self.acne_free {
            Some(low) => write!(f, "false shadow ends at a bias of {low:.4} world units, ")?,
            None => write!(f, "false shadow ends at no bias, ")?,
        }
        match self.keeps_contact {
            Some(high) if high == f64::INFINITY => write!(f, "contact holds at any")?,
            Some(high) => write!(f, "contact holds up to {high:.4} world units")?,
            None => write!(f, "contact holds at none")?,
        }
        write!(f, ": {}", if self.works() { "a bias works" } else { "no bias works" })
    }
}

/// A receiver with something thin standing on it, as far as a constant bias cares.
///
/// The thinnest part bounds both casters and receivers: where the midpoint or the second surface is stored, a receiver is
/// taken to be a solid of the map at least that thick, and what lies between its front and what is stored guards it
/// from its own texels.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct BiasCase {
    /// Width of a texel at the receiver, world units.
    pub texel_world: f64,
    /// Half-extent of the filter, texels; 0 for a point look-up.
    pub radius: f64,
    /// Tangent of the angle between the receiver and the map's plane, ≥ 0 (in perspective the slope as the light's rays see it). For a level floor
    /// 1 / tan of the light's elevation.
    pub slope: f64,
    /// Of the thinnest part along the light, world units.
    pub thickness: f64,
    /// Of the light above the receiver, radians in 0..=π/2.
    pub elevation: f64,
    /// What the map keeps.
    pub stored: Stored,
}

impl BiasCase {
    /// The predicted window.
    pub fn window(&self) -> BiasWindow {
        let slack = slack(self.stored, self.thickness);
        let guard = self.thickness - slack;
        let step = acne_free_bias(self.texel_world * self.slope, 0.0, self.radius);
        let across = self.elevation.cos();
        // Under a light at the zenith, where rounding leaves a cosine, nothing leaves its foot.
        let high = if across > 1e-12 { slack / across } else { f64::INFINITY };
        BiasWindow { acne_free: Some((step - guard).max(0.0)), keeps_contact: Some(high) }
    }

    /// The widest texel with which a bias works, world units; +∞ where the receiver faces the light squarely. With it
    /// the smallest bias without acne is the largest that keeps the contact.
    pub fn widest_texel(&self) -> f64 {
        let guard = self.thickness - slack(self.stored, self.thickness);
        let allowed = guard + self.window().keeps_contact.unwrap_or(0.0);
        let per_texel = acne_free_bias(self.slope, 0.0, self.radius);
        if per_texel > 0.0 { allowed / per_texel } else { f64::INFINITY }
    }

    /// Texels a side that a map of `side` texels needs instead for a bias to work, the same part of the world in it;
    /// `None` when no map is large enough.
    pub fn side_needed(&self, side: u32) -> Option<u32> {
        let needed = (f64::from(side) * self.texel_world / self.widest_texel()).ceil().max(1.0);
        (needed <= f64::from(u32::MAX)).then_some(needed as u32)
    }
}

/// Looks for the window by trying biases.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct BiasSearch {
    /// Smallest and largest bias to try, both included; any unit.
    pub range: (f64, f64),
    /// Biases tried evenly over the range before any is refined; below 2 counts as 2.
    pub sweep: u32,
    /// How often the step at which the answer lies is halved.
    pub halvings: u32,
    /// False shadow up to which a bias counts as free of it, inclusive.
    pub most_acne: f64,
    /// Gap up to which contact counts as kept, inclusive.
    pub most_gap: f64,
}

impl Default for BiasSearch {
    /// 17 biases in 0..=40, the bounds of the papers' table (Wang & Molnar 1994, Fig. 4).
    fn default() -> Self {
        Self { range: (0.0, 40.0), sweep: 17, halvings: 8, most_acne: 0.02, most_gap: 1.0 }
    }
}

impl BiasSearch {
    /// The window of a `measure` that gives a bias's false shadow and its gap. NaN counts as too much.
    ///
    /// False shadow should shrink with the bias and gaps grow. The sweep makes sure: the answers hold for all swept biases
    /// from `acne_free` on, and up to `keeps_contact`. An answer at the end of the range may hold beyond it.
    pub fn run(&self, mut measure: impl FnMut(f64) -> (f64, f64)) -> BiasWindow {
        let last = self.sweep.max(2) - 1;
        let (low, high) = self.range;
        let bias = |index: u32| low + (high - low) * f64::from(index) / f64::from(last);
        let mut fine = |bias: f64| {
            let (acne, gap) = measure(bias);
            (acne <= self.most_acne, gap <= self.most_gap)
        };
        let swept: Vec<(bool, bool)> = (0..=last).map(|index| fine(bias(index))).collect();
        let mut between = |mut bad: f64, mut good: f64, is_fine: fn((bool, bool)) -> bool| {
            for _ in 0..self.halvings {
                let middle = 0.5 * (bad + good);
                if is_fine(fine(middle)) { good = middle } else { bad = middle }
            }
            good
        };
        let acne_free = match (0..=last).rev().find(|&index| !swept[index as usize].0) {
            None => Some(low),
            Some(bad) if bad == last => None,
            Some(bad) => Some(between(bias(bad), bias(bad + 1), |fine| fine.0)),
        };
        let keeps_contact = match (0..=last).find(|&index| !swept[index as usize].1) {
            None => Some(high),
            Some(0) => None,
            Some(bad) => Some(between(bias(bad), bias(bad - 1), |fine| fine.1)),
        };
        BiasWindow { acne_free, keeps_contact }
    }
}
