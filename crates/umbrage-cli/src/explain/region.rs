//! A surface that a pixel sees, and everything known about its shadow.

use super::asked::Asked;
use super::fault::{Answers, Fault};
use super::owners::Owners;
use super::svg;
use umbrage_shadow::Explanation;

/// One surface that a pixel sees.
pub struct Region {
    pub asked: Asked,
    /// Its object's name.
    pub object: String,
    /// The filter's result.
    pub fraction: f32,
    /// The look-up of each map.
    pub maps: Vec<(Explanation, Owners)>,
    /// What lies between its point and the light by rays, nearest to the point first: the object's name and the distance, world units.
    pub blockers: Vec<(String, f64)>,
    /// The truth of its point, 0 lit to 1 dark.
    pub truth: f32,
    /// Cosine of its normal and the direction to the light. Where it is not positive the surface is dark, whatever the filter answers.
    pub cosine: f64,
    /// What is wrong with the pixel, if anything.
    pub fault: Option<Fault>,
}

impl Region {
    /// The texels of the first map that was looked up; `None` where none was.
    pub fn drawn(&self) -> Option<String> {
        self.maps.iter().find_map(|(explanation, owners)| svg::drawn(explanation, owners))
    }

    /// The evidence by which the fault of its pixel, of a value and a truth, is named.
    pub fn answers(&self, value: f32, truth: f32) -> Answers {
        let maps = self.maps.iter().map(|(explanation, _)| explanation);
        Answers::new(value, truth, maps, self.blockers.first().map(|(_, distance)| *distance))
    }

    /// The filter's answer, if the surface faces away from the light and so is dark although the filter says otherwise.
    pub fn overruled(&self) -> Option<f32> {
        (self.cosine <= 0.0 && self.fraction != 1.0).then_some(self.fraction)
    }
}
