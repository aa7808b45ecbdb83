//! Channels of all texels, blurred and in ever coarser levels.

use crate::Moments;
use glam::{DVec2, UVec2};
use half::f16;

/// Largest standard deviation of the blur, texels.
pub(super) const MOST_BLUR: f32 = 64.0;

/// One level: the moments of its texels, row by row, the channels of a texel side by side.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Level {
    pub size: UVec2,
    channels: usize,
    values: Vec<f32>,
}

impl Level {
    /// The finest level, of scaled depths that are given row by row, blurred by a normal law of this standard deviation (texels).
    pub fn finest(size: UVec2, depths: &[f64], kind: Moments, blur: f32) -> Self {
        let channels = kind.channels();
        let mut values = vec![0.0; depths.len() * channels];
        if blur > 0.0 {
            let weights = weights(blur);
            for channel in 0..channels {
                let plane: Vec<f64> = depths.iter().map(|depth| kind.of(*depth)[channel]).collect();
                let blurred = blurred(&plane, size, &weights);
                for (value, blurred) in values[channel..].iter_mut().step_by(channels).zip(blurred) {
                    *value = blurred as f32;
                }
            }
        } else {
            for (texel, depth) in values.chunks_exact_mut(channels).zip(depths) {
                for (value, moment) in texel.iter_mut().zip(kind.of(*depth)) {
                    *value = moment as f32;
                }
            }
        }
        Self { size, channels, values }
    }

    /// The only level of [`Moments::Deviation`], of screen depths that are given row by row: a box of `reach` texels to each side.
    pub fn deviations(size: UVec2, depths: &[f64], reach: f32, samples: u32) -> Self {
        let (width, height) = (size.x as usize, size.y as usize);
        let last = (size - 1).as_dvec2();
        let rounded = |[mean, square]: [f64; 2]| {
            let [mean, square] = [mean, square].map(|sum| sum / f64::from(samples));
            [mean, (square - mean * mean).max(0.0).sqrt()].map(|value| f64::from(f16::from_f64(value)))
        };
        // From one side of the box to the other, in texels; its middle alone where there is one sample.
        let ways = || {
            let share = |i: u32| if samples > 1 { 2.0 * f64::from(i) / f64::from(samples - 1) - 1.0 } else { 0.0 };
            (0..samples).map(move |i| share(i) * f64::from(reach))
        };
        let mut columns = Vec::with_capacity(depths.len());
        for y in 0..height {
            let rows: Vec<usize> =
                ways().map(|way| (y as f64 + 0.5 + way).floor().clamp(0.0, last.y) as usize).collect();
            for x in 0..width {
                let of = |row: &usize| depths[row * width + x];
                let sum = |[mean, square]: [f64; 2], depth: f64| [mean + depth, square + depth * depth];
                columns.push(rounded(rows.iter().map(of).fold([0.0; 2], sum)));
            }
        }
        let mut values = Vec::with_capacity(2 * depths.len());
        for row in columns.chunks_exact(width) {
            for x in 0..width {
                let of = |way: f64| {
                    let place = (x as f64 + way).clamp(0.0, last.x);
                    let left = place as usize;
                    let right = (left + 1).min(width - 1);
                    let share = place - place.floor();
                    [0, 1].map(|channel| row[left][channel] + (row[right][channel] - row[left][channel]) * share)
                };
                let sum = |[mean, square]: [f64; 2], [depth, deviation]: [f64; 2]| {
                    [mean + depth, square + (deviation * deviation + depth * depth)]
                };
                values.extend(rounded(ways().map(of).fold([0.0; 2], sum)).map(|value| value as f32));
            }
        }
        Self { size, channels: 2, values }
    }

    /// The next coarser level: means over two by two texels. Where the last column or row has no neighbour, it counts twice. `None` for a single texel.
    pub fn coarser(&self) -> Option<Self> {
        if self.size == UVec2::ONE {
            return None;
        }
        let size = self.size.map(|side| side.div_ceil(2));
        let mut values = Vec::with_capacity(size.element_product() as usize * self.channels);
        for y in 0..size.y {
            for x in 0..size.x {
                let last = self.size - 1;
                let (left, top) = (2 * x, 2 * y);
                let (right, bottom) = ((left + 1).min(last.x), (top + 1).min(last.y));
                let texels = [(left, top), (right, top), (left, bottom), (right, bottom)];
                let texels = texels.map(|(x, y)| self.texel(x as usize, y as usize));
                for channel in 0..self.channels {
                    let sum: f64 = texels.iter().map(|texel| f64::from(texel[channel])).sum();
                    values.push((0.25 * sum) as f32);
                }
            }
        }
        Some(Self { size, channels: self.channels, values })
    }

    fn texel(&self, x: usize, y: usize) -> &[f32] {
        let at = (y * self.size.x as usize + x) * self.channels;
        &self.values[at..at + self.channels]
    }

    /// The moments at a place in this level's texels, between the four nearest centres; beyond the outermost centres those of the border.
    pub fn at(&self, place: DVec2) -> [f64; 4] {
        let last = (self.size - 1).as_dvec2();
        // NaN becomes 0.
        let place = (place - 0.5).max(DVec2::ZERO).min(last);
        let corner = place.floor();
        let share = place - corner;
        let (left, top) = (corner.x as usize, corner.y as usize);
        let (right, bottom) = ((left + 1).min(last.x as usize), (top + 1).min(last.y as usize));
        let [a, b, c, d] = [(left, top), (right, top), (left, bottom), (right, bottom)].map(|(x, y)| self.texel(x, y));
        let mut found = [0.0; 4];
        for (channel, found) in found.iter_mut().enumerate().take(self.channels) {
            let [a, b, c, d] = [a, b, c, d].map(|texel| f64::from(texel[channel]));
            let (above, below) = (a + (b - a) * share.x, c + (d - c) * share.x);
            *found = above + (below - above) * share.y;
        }
        found
    }

    /// Bytes of its floats.
    pub fn bytes(&self) -> usize {
        size_of_val(self.values.as_slice())
    }
}

/// Weights of a normal law at 0, 1, 2 .. texels from its middle, as far as three standard deviations reach. Counted on both sides, they add
/// up to 1.
fn weights(blur: f32) -> Vec<f64> {
    let blur = f64::from(blur);
    let at = |texels: i32| (-0.5 * (f64::from(texels) / blur).powi(2)).exp();
    let mut weights: Vec<f64> = (0..=(3.0 * blur).ceil() as i32).map(at).collect();
    let sum = 2.0 * weights.iter().sum::<f64>() - weights[0];
    for weight in &mut weights {
        *weight /= sum;
    }
    weights
}

/// A channel blurred along rows and then along columns; what lies beyond an edge is what lies on it.
fn blurred(plane: &[f64], size: UVec2, weights: &[f64]) -> Vec<f64> {
    let (width, height) = (size.x as usize, size.y as usize);
    let taps = || weights.iter().enumerate();
    let mut along = vec![0.0; plane.len()];
    for (row, out) in plane.chunks_exact(width).zip(along.chunks_exact_mut(width)) {
        for (x, out) in out.iter_mut().enumerate() {
            *out = weights[0] * row[x];
            for (far, weight) in taps().skip(1) {
                *out += weight * (row[x.saturating_sub(far)] + row[(x + far).min(width - 1)]);
            }
        }
    }
    let row = |y: usize| &along[y * width..(y + 1) * width];
    let mut both = vec![0.0; plane.len()];
    for (y, out) in both.chunks_exact_mut(width).enumerate() {
        for (far, weight) in taps() {
            // The middle counts once.
            let weight = if far == 0 { 0.5 * weight } else { *weight };
            let (above, below) = (row(y.saturating_sub(far)), row((y + far).min(height - 1)));
            for ((out, above), below) in out.iter_mut().zip(above).zip(below) {
                *out += weight * (above + below);
            }
        }
    }
    both
}
