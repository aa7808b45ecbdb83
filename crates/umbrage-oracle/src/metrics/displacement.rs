use super::Grid;
use glam::{DMat2, DVec2, IVec2};
use rayon::prelude::*;

/// A direction in which an image changes less than this fraction of the one in which it changes most says nothing of how far it was moved.
const FLAT: f64 = 1e-3;

/// How far `image` is moved against `truth`, pixels, +x right and +y down: the translation d of least squared difference between the image
/// and truth moved by d.
///
/// Only pixels of the mask are compared, with such of truth's that are in the mask too. Whole pixels up to `most` along each axis are tried
/// first; the best of them is then refined by Gauss–Newton steps (Lucas & Kanade 1981) over both images, each smoothed by the same
/// kernel of five by five pixels. Along a direction in which truth does not change, as along a single straight edge, the displacement is 0.
///
/// `None` where truth does not change at all within the mask.
pub fn displacement(image: Grid, truth: Grid, mask: &[bool], most: u32) -> Option<DVec2> {
    let (image, truth) = (smoothed(image, mask), smoothed(truth, mask));
    let (image, truth) = (image.grid(), truth.grid());
    let most = most as i32;
    let tried = (-most..=most).flat_map(|y| (-most..=most).map(move |x| IVec2::new(x, y)));
    // Of equals the shortest.
    let mut tried: Vec<IVec2> = tried.collect();
    tried.sort_by_key(|by| (by.length_squared(), by.y, by.x));
    let errors: Vec<f64> = tried.par_iter().map(|by| error(image, truth, *by)).collect();
    let best = (0..tried.len()).min_by(|a, b| errors[*a].total_cmp(&errors[*b]))?;
    let mut by = tried[best].as_dvec2();
    step(image, truth, by)?;
    for _ in 0..32 {
        let Some(step) = step(image, truth, by) else { break };
        // A step that is longer than the neighbourhood it was computed in is none.
        by += step.clamp_length_max(0.5);
        if step.length() < 1e-4 {
            break;
        }
    }
    // Where it ran away from the best of the whole pixels, that is known at least.
    Some(if by.distance(tried[best].as_dvec2()) <= 1.5 { by } else { tried[best].as_dvec2() })
}

/// An image of its own pixels.
struct Own {
    values: Vec<f32>,
    width: usize,
}

impl Own {
    fn grid(&self) -> Grid<'_> {
        Grid::new(&self.values, self.width)
    }
}

/// The image under the binomial kernel 1 4 6 4 1 along both axes, of the pixels in the mask alone; NaN outside it.
fn smoothed(image: Grid, mask: &[bool]) -> Own {
    const KERNEL: [f64; 5] = [1.0, 4.0, 6.0, 4.0, 1.0];
    let (width, height) = (image.width, image.height());
    let pass = |values: &[(f64, f64)], across: bool| -> Vec<(f64, f64)> {
        let sum = |index: usize| {
            let (x, y) = (index % width, index / width);
            let (at, count) = if across { (x, width) } else { (y, height) };
            let taps = (0..5).filter_map(|tap| Some((KERNEL[tap], (at + tap).checked_sub(2).filter(|i| *i < count)?)));
            taps.fold((0.0, 0.0), |sum, (weight, i)| {
                let (value, of) = values[if across { y * width + i } else { i * width + x }];
                (sum.0 + weight * value, sum.1 + weight * of)
            })
        };
        (0..width * height).into_par_iter().map(sum).collect()
    };
    let own = |(value, inside): (&f32, &bool)| if *inside { (f64::from(*value), 1.0) } else { (0.0, 0.0) };
    let start: Vec<(f64, f64)> = image.values[..width * height].iter().zip(mask).map(own).collect();
    let both = pass(&pass(&start, true), false);
    let value = |((sum, weight), inside): ((f64, f64), &bool)| if *inside { (sum / weight) as f32 } else { f32::NAN };
    Own { values: both.into_iter().zip(mask).map(value).collect(), width }
}

/// The mean squared difference between the image and truth moved by whole pixels; +∞ where less than half of the image is left to
/// compare.
fn error(image: Grid, truth: Grid, by: IVec2) -> f64 {
    let (width, height) = (image.width as i32, image.height() as i32);
    let (mut sum, mut count, mut all) = (0.0, 0u64, 0u64);
    for y in 0..height {
        for x in 0..width {
            let value = image.at(x as usize, y as usize);
            if value.is_nan() {
                continue;
            }
            all += 1;
            let (x, y) = (x - by.x, y - by.y);
            if x < 0 || y < 0 || x >= width || y >= height {
                continue;
            }
            let difference = f64::from(value - truth.at(x as usize, y as usize));
            if !difference.is_nan() {
                sum += difference * difference;
                count += 1;
            }
        }
    }
    if count > 0 && 2 * count >= all { sum / count as f64 } else { f64::INFINITY }
}

/// What a displacement is to be changed by; `None` where truth does not change.
fn step(image: Grid, truth: Grid, by: DVec2) -> Option<DVec2> {
    let (width, height) = (image.width, image.height());
    let row = |y: usize| {
        let (mut matrix, mut right) = (DMat2::ZERO, DVec2::ZERO);
        for x in 0..width {
            let value = image.at(x, y);
            if value.is_nan() {
                continue;
            }
            let at = DVec2::new(x as f64 + 0.5, y as f64 + 0.5) - by;
            let beside = |x: f64, y: f64| truth.between(at + DVec2::new(x, y));
            let around = [beside(1.0, 0.0), beside(-1.0, 0.0), beside(0.0, 1.0), beside(0.0, -1.0)];
            let (Some(here), [Some(right_of), Some(left_of), Some(below), Some(above)]) = (beside(0.0, 0.0), around)
            else {
                continue;
            };
            // Truth moved by more is less by its gradient.
            let slope = DVec2::new(right_of - left_of, below - above) * -0.5;
            matrix += DMat2::from_cols(slope * slope.x, slope * slope.y);
            right += slope * (f64::from(value) - here);
        }
        (matrix, right)
    };
    let rows: Vec<(DMat2, DVec2)> = (0..height).into_par_iter().map(row).collect();
    let (matrix, right) = rows.iter().fold((DMat2::ZERO, DVec2::ZERO), |sum, row| (sum.0 + row.0, sum.1 + row.1));
    let (a, b, c) = (matrix.x_axis.x, matrix.x_axis.y, matrix.y_axis.y);
    let (middle, spread) = (0.5 * (a + c), (0.25 * (a - c) * (a - c) + b * b).sqrt());
    let (large, small) = (middle + spread, middle - spread);
    if large <= 0.0 || large.is_nan() {
        return None;
    }
    let axis = if b == 0.0 { if a >= c { DVec2::X } else { DVec2::Y } } else { DVec2::new(large - c, b).normalize() };
    let along = axis * (right.dot(axis) / large);
    let across = axis.perp();
    Some(if small > FLAT * large { along + across * (right.dot(across) / small) } else { along })
}
