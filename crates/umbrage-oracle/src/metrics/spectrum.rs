use super::Grid;
use std::f64::consts::PI;

/// How regular an image's deviations from its mean are.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Spectrum {
    /// Largest magnitude of the discrete Fourier transform, the mean's own term left out.
    pub peak: f64,
    /// Median magnitude of the same terms.
    pub median: f64,
}

impl Spectrum {
    /// Peak over median magnitude. Moiré is large, noise near 3–5; 0 for a uniform window; +∞ for a pure wave.
    pub fn ratio(&self) -> f64 {
        if self.peak > 0.0 { self.peak / self.median } else { 0.0 }
    }

    /// The same of powers, the ratio's square. That is what the recorded figures of Williams' moiré are: hundreds and more,
    /// against about 10 to 25 for noise.
    pub fn power_ratio(&self) -> f64 {
        self.ratio() * self.ratio()
    }
}

/// The spectrum of a window, mean removed, no taper. Each side is cut to the largest power of two that fits, from
/// the upper left. A window of fewer than two pixels, a uniform one or one with NaN has peak and median 0.
pub fn spectrum(window: Grid) -> Spectrum {
    let (width, height) = (power_of_two(window.width), power_of_two(window.height()));
    let pixels = (0..height).flat_map(|y| (0..width).map(move |x| f64::from(window.at(x, y))));
    let mut terms: Vec<Complex> = pixels.map(|value| (value, 0.0)).collect();
    let mean = terms.iter().map(|term| term.0).sum::<f64>() / terms.len().max(1) as f64;
    let uniform = terms.iter().all(|term| term.0 == terms[0].0);
    if terms.len() < 2 || uniform || mean.is_nan() {
        return Spectrum { peak: 0.0, median: 0.0 };
    }
    for term in &mut terms {
        term.0 -= mean;
    }
    for row in terms.chunks_exact_mut(width) {
        transform(row);
    }
    let mut column = vec![(0.0, 0.0); height];
    for x in 0..width {
        for (y, term) in column.iter_mut().enumerate() {
            *term = terms[y * width + x];
        }
        transform(&mut column);
        for (y, term) in column.iter().enumerate() {
            terms[y * width + x] = *term;
        }
    }
    let mut magnitudes: Vec<f64> = terms[1..].iter().map(|term| term.0.hypot(term.1)).collect();
    magnitudes.sort_by(f64::total_cmp);
    Spectrum { peak: magnitudes[magnitudes.len() - 1], median: magnitudes[magnitudes.len() / 2] }
}

type Complex = (f64, f64);

fn power_of_two(side: usize) -> usize {
    if side == 0 { 0 } else { 1 << side.ilog2() }
}

/// Discrete Fourier transform in place, radix 2 (Cooley & Tukey 1965). The length is a power of two.
fn transform(values: &mut [Complex]) {
    let count = values.len();
    if count < 2 {
        return;
    }
    let shift = usize::BITS - count.ilog2();
    for i in 0..count {
        let mirrored = i.reverse_bits() >> shift;
        if i < mirrored {
            values.swap(i, mirrored);
        }
    }
    let mut half = 1;
    while half < count {
        for block in values.chunks_exact_mut(2 * half) {
            let (low, high) = block.split_at_mut(half);
            for (k, (a, b)) in low.iter_mut().zip(high).enumerate() {
                let (sin, cos) = (-PI * k as f64 / half as f64).sin_cos();
                let turned = (b.0 * cos - b.1 * sin, b.0 * sin + b.1 * cos);
                *b = (a.0 - turned.0, a.1 - turned.1);
                *a = (a.0 + turned.0, a.1 + turned.1);
            }
        }
        half *= 2;
    }
}
