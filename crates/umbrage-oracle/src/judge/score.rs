//! The faults as numbers and as masks.

use super::Judge;
use super::marks::Where;
use crate::metrics::{Deviation, Grid, deviation, displacement, offsets, rms};
use crate::penumbra_width;
use glam::DVec2;
use umbrage_recipe::Recipe;

/// Edges of the result that are farther from truth's than this are not edges of its shadow, pixels. It is also the largest displacement along
/// each axis that is looked for.
const NEAR: u32 = 8;
/// Width in pixels of a hard shadow's edge as a picture shows it: a truth whose edges are no wider has no penumbra.
const SHARP: f64 = 1.5;

/// A shadow image to judge, and what is known of how it was made. All are pictures of the judge's camera, 1 dark.
#[derive(Clone, Copy, Debug)]
pub struct Drawn<'a> {
    /// The image.
    pub result: &'a [f32],
    /// By which recipe; `None` for a foreign image.
    pub recipe: Option<&'a Recipe>,
    /// The same without any bias ([`Recipe::unbiased`]); `None` where there is none to leave out.
    pub unbiased: Option<&'a [f32]>,
    /// The same under other keys of randomness; may be empty.
    pub again: &'a [&'a [f32]],
}

impl<'a> Drawn<'a> {
    /// An image of which nothing is known.
    pub fn foreign(result: &'a [f32]) -> Self {
        Self { result, recipe: None, unbiased: None, again: &[] }
    }
}

/// What is wrong with a shadow image, and how wrong. Shares are of the judged pixels, 0..=1. A number is `None` where the picture has nothing to measure
/// it by.
#[derive(Clone, Debug, PartialEq)]
pub struct Score {
    /// How many pixels are judged.
    pub judged: usize,
    /// Root mean square difference from truth, in units of shadow.
    pub rms: Option<f64>,
    /// Fraction of the judged pixels' area that is dark and should be lit.
    pub false_shadow: Option<f64>,
    /// Fraction of the judged pixels' area that is lit and should be dark.
    pub false_light: Option<f64>,
    /// The part of false shadow that is acne.
    pub acne: Option<f64>,
    /// The part of false light that is detachment; 0 for a recipe without bias, `None` for a foreign image.
    pub detachment: Option<f64>,
    /// How far blockers are from the receivers that were detached from them; `None` where none was.
    pub detached: Option<Size>,
    /// The part of false light that leaks; `None` for a foreign image.
    pub leak: Option<f64>,
    /// Standard deviation under several keys of randomness, mean over the judged pixels, in units of shadow; `None` with one key alone.
    pub noise: Option<f64>,
    /// The mean width of the result's edges, from a tenth to nine tenths, as a multiple of truth's; `None` where truth has no penumbra: its edges are
    /// no wider than a pixel makes them.
    pub penumbra_ratio: Option<f64>,
    /// How far the result's shadows are moved as a whole, pixels, +x right and +y down ([`displacement`]).
    pub displacement: Option<DVec2>,
    /// Distance of the result's edges from those of truth, pixels; `mean` is positive if the shadow is too small. `None` if no edge lies near an edge of
    /// truth.
    pub edge_shift: Option<Deviation>,
    /// The faulty pixels.
    pub places: Where,
}

/// Distances along the light's ray from receivers to blockers.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Size {
    /// Mean, world units.
    pub mean: f64,
    /// Largest, world units.
    pub most: f64,
    /// Mean, widths of a texel at the receiver.
    pub texels: f64,
}

impl Judge<'_> {
    /// What is wrong with a shadow image.
    ///
    /// # Panics
    /// When one of its pictures has another number of pixels than the camera.
    pub fn score(&self, drawn: &Drawn<'_>) -> Score {
        let Drawn { result, recipe, unbiased, again } = *drawn;
        let all = again.iter().copied().chain(unbiased).chain([result]);
        assert!(all.into_iter().all(|one| one.len() == self.truth.len()), "an image of another size than truth");
        let places = self.marks(result, unbiased, recipe);
        let judged = self.judged.iter().filter(|judged| **judged).count();
        let share = |mask: &Vec<bool>| (judged > 0).then(|| count(mask) as f64 / judged as f64);
        let (own, exact) = (self.masked(result), self.masked(self.truth));
        let width = self.camera.size().x as usize;
        let (own, exact) = (Grid::new(&own, width), Grid::new(&exact, width));
        let soft = penumbra_width(exact).filter(|width| *width > SHARP);
        Score {
            judged,
            rms: rms(result, self.truth, &self.judged),
            false_shadow: share(&places.false_shadow),
            false_light: share(&places.false_light),
            acne: share(&places.acne),
            detachment: places.detachment.as_ref().and_then(share),
            detached: places.detachment.as_ref().and_then(|mask| self.size_of(mask)),
            leak: places.leak.as_ref().and_then(share),
            noise: self.noise(result, again),
            penumbra_ratio: soft.and_then(|soft| Some(penumbra_width(own)? / soft)),
            displacement: displacement(Grid::new(result, width), Grid::new(self.truth, width), &self.judged, NEAR),
            edge_shift: deviation(&offsets(own, exact, f64::from(NEAR))),
            places,
        }
    }

    /// An image with NaN where it is not judged.
    fn masked(&self, image: &[f32]) -> Vec<f32> {
        image.iter().zip(&self.judged).map(|(value, judged)| if *judged { *value } else { f32::NAN }).collect()
    }

    fn size_of(&self, detached: &[bool]) -> Option<Size> {
        let pixels = (0..detached.len()).filter(|pixel| detached[*pixel]);
        let sizes: Vec<(f64, f64)> = pixels.filter_map(|pixel| self.blocked_at(pixel)).collect();
        let mean = |of: fn(&(f64, f64)) -> f64| sizes.iter().map(of).sum::<f64>() / sizes.len() as f64;
        let most = sizes.iter().map(|size| size.0).fold(0.0, f64::max);
        (!sizes.is_empty()).then(|| Size { mean: mean(|size| size.0), most, texels: mean(|size| size.1) })
    }

    /// The standard deviation of a pixel over all its images, of which these are a sample, mean over the judged ones.
    fn noise(&self, result: &[f32], again: &[&[f32]]) -> Option<f64> {
        let images = || again.iter().copied().chain([result]);
        let count = images().count() as f64;
        let spread = |pixel: usize| {
            let mean = images().map(|image| f64::from(image[pixel])).sum::<f64>() / count;
            let squares = images().map(|image| (f64::from(image[pixel]) - mean).powi(2)).sum::<f64>();
            (squares / (count - 1.0)).sqrt()
        };
        let spreads: Vec<f64> = (0..result.len()).filter(|pixel| self.judged[*pixel]).map(spread).collect();
        (count > 1.0 && !spreads.is_empty()).then(|| spreads.iter().sum::<f64>() / spreads.len() as f64)
    }
}

fn count(mask: &[bool]) -> usize {
    mask.iter().filter(|inside| **inside).count()
}
