//! Burley's note of 2006 on the bias cone and on soft shadows.

use glam::{IVec2, Vec2, Vec3};
use umbrage_depth::DepthMap;
use umbrage_sample::hammersley;

/// The listing's parameters.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct BurleyListing {
    /// `baseBias`, added to the receiver's depth: a negative one moves it toward the light.
    pub base: f32,
    /// `biasSlope`, depth per unit of the map; the note sets it to 1.
    pub slope: f32,
    /// Samples of each pass; the listing does not say how many.
    pub samples: u32,
}

impl Default for BurleyListing {
    /// No base, the note's slope of 1, 32 samples.
    fn default() -> Self {
        Self { base: 0.0, slope: 1.0, samples: 32 }
    }
}

impl BurleyListing {
    /// `sample.z`: the receiver's depth *plus* the bias, so that a positive bias shadows more, not less.
    pub fn compared(&self, depth: f32, radius: f32) -> f32 {
        depth + self.base + self.slope * radius
    }

    /// Samples around a point of the map, within `radius` texels; radius by `shape` of the second Hammersley number. Without rotation and
    /// offset, the first lies on the point itself.
    fn around<'a, M: DepthMap>(
        &'a self,
        map: &'a M,
        point: Vec2,
        radius: f32,
        shape: impl Fn(f32) -> f32 + 'a,
    ) -> impl Iterator<Item = Sample> + 'a {
        let count = self.samples.max(1);
        (0..count).map(move |index| {
            let unit = hammersley(index, count);
            let radius = shape(unit.y) * radius;
            let at: IVec2 = (point + Vec2::from_angle(unit.x * std::f32::consts::TAU) * radius).floor().as_ivec2();
            Sample { radius, depth: map.depth(at) }
        })
    }
}

/// One texel that is read.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Sample {
    /// Distance of the sample from the point, in the unit of the search radius.
    pub radius: f32,
    /// The map's depth there.
    pub depth: f32,
}

/// `sampleDepth`: the weighted mean depth of the occluders, and 0 for none, although 0 can also be a depth.
pub fn sample_depth(
    listing: &BurleyListing,
    depth: f32,
    search: f32,
    samples: impl IntoIterator<Item = Sample>,
) -> f32 {
    let (mut sum, mut total) = (0.0, 0.0);
    for sample in samples.into_iter().filter(|sample| sample.depth < listing.compared(depth, sample.radius)) {
        // A search without extent has its samples at its centre.
        let weight = if search > 0.0 { 1.0 - 0.9 * (sample.radius / search) } else { 1.0 };
        sum += sample.depth * weight;
        total += weight;
    }
    if total > 0.0 { sum / total } else { sum }
}

/// `sampleBlur`: the fraction of the samples that are nearer. The listing omits the point from the call; 0 without samples.
pub fn sample_blur(listing: &BurleyListing, depth: f32, samples: impl IntoIterator<Item = Sample>) -> f32 {
    let (mut occluded, mut count) = (0u32, 0u32);
    for sample in samples {
        occluded += u32::from(sample.depth < listing.compared(depth, sample.radius));
        count += 1;
    }
    if count > 0 { occluded as f32 / count as f32 } else { 0.0 }
}

/// The blur's radius, not clamped: occluders behind the point, which the added bias lets in, make it negative. A point at depth 0 has the radius `min`.
pub fn soft_radius(min: f32, max: f32, occluder: f32, depth: f32) -> f32 {
    if depth == 0.0 { min } else { min + (max - min) * (1.0 - occluder / depth) }
}

/// `softShadow` for a point at (x, y) texels and depth z of a map, radii in texels. Negative radii are used by their absolute value; without an
/// occluder in the search the point is lit, whatever the blur would have met.
pub fn soft_shadow<M: DepthMap>(listing: &BurleyListing, map: &M, point: Vec3, min: f32, max: f32) -> f32 {
    let at = point.truncate();
    let occluder = sample_depth(listing, point.z, max, listing.around(map, at, max, |y| y));
    if occluder > 0.0 {
        let radius = soft_radius(min, max, occluder, point.z).abs();
        sample_blur(listing, point.z, listing.around(map, at, radius, f32::sqrt))
    } else {
        0.0
    }
}
