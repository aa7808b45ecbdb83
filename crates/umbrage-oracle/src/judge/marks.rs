//! Which pixels are which fault.

use super::region::Reach;
use super::{DARK, Judge, LIT};
use rayon::prelude::*;
use umbrage_recipe::Recipe;

/// The pixels of each fault, rows from the top. The default is of an image without pixels.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Where {
    /// Dark that should be lit.
    pub false_shadow: Vec<bool>,
    /// Lit that should be dark.
    pub false_light: Vec<bool>,
    /// Those of the first that are acne.
    pub acne: Vec<bool>,
    /// Those of the second that are detached; `None` for a foreign image.
    pub detachment: Option<Vec<bool>>,
    /// Those of the second that are leaks; `None` for a foreign image.
    pub leak: Option<Vec<bool>>,
}

/// What truth says around a pixel.
enum Around {
    /// All of it is lit, or all of it dark.
    Alike,
    /// An edge goes through it, and more than half is dark: the mean.
    MostlyDark(f32),
    /// An edge goes through it.
    Mixed,
}

impl Judge<'_> {
    /// Marks the faults of a result of a recipe; `unbiased` is the same without any bias, where it has one.
    pub(super) fn marks(&self, result: &[f32], unbiased: Option<&[f32]>, recipe: Option<&Recipe>) -> Where {
        let reach = recipe.map(|recipe| move |view: &_, receiver: &_| recipe.reach(view, receiver));
        let reach = reach.as_ref().map(|reach| reach as &Reach<'_>);
        let pixels = self.truth.len();
        let judged = |pixel: usize| self.judged[pixel];
        let dark = |pixel: usize| judged(pixel) && self.truth[pixel] < LIT && result[pixel] > 0.5;
        let light = |pixel: usize| judged(pixel) && self.truth[pixel] > DARK && result[pixel] < 0.5;
        let false_shadow: Vec<bool> = (0..pixels).map(dark).collect();
        let false_light: Vec<bool> = (0..pixels).map(light).collect();
        let kind = |pixel: usize| {
            let around =
                if false_shadow[pixel] || false_light[pixel] { self.alike(pixel, reach) } else { Around::Mixed };
            if false_shadow[pixel] {
                return [matches!(around, Around::Alike), false, false];
            }
            let without = unbiased.is_some_and(|unbiased| unbiased[pixel] > 0.5);
            let detached = without
                && match around {
                    Around::Alike => true,
                    // What the filter's width makes light is about as dark as all of the box.
                    Around::MostlyDark(mean) => result[pixel] < 0.5 * mean,
                    Around::Mixed => false,
                }
                && recipe.is_some_and(|recipe| self.bias_passes(pixel, recipe));
            [false, detached, matches!(around, Around::Alike) && !detached]
        };
        let kinds: Vec<[bool; 3]> = (0..pixels).into_par_iter().map(kind).collect();
        let [acne, detachment, leak] = [0, 1, 2].map(|fault| kinds.iter().map(|kinds| kinds[fault]).collect());
        let knows = reach.is_some();
        Where { false_shadow, false_light, acne, detachment: knows.then_some(detachment), leak: knows.then_some(leak) }
    }

    fn alike(&self, pixel: usize, reach: Option<&Reach<'_>>) -> Around {
        let Some(truth) = self.around(pixel, reach).filter(|truth| !truth.is_empty()) else { return Around::Mixed };
        let own = self.truth[pixel];
        if truth.iter().all(|truth| if own < LIT { *truth < LIT } else { *truth > DARK }) {
            return Around::Alike;
        }
        let mean = truth.iter().sum::<f32>() / truth.len() as f32;
        if mean > 0.5 { Around::MostlyDark(mean) } else { Around::Mixed }
    }
}
