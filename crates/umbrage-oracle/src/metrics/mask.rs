use super::Grid;
use glam::DVec2;

/// Pixels on which shadow would be false: truth is 0, the cosine to the light exceeds `min_facing` (the figures use .05),
/// and nothing darker than 0 in truth lies within `border` pixels, the filter's width.
pub fn lit_mask(truth: Grid, facing: &[f32], border: usize, min_facing: f32) -> Vec<bool> {
    settled(truth, facing, border, min_facing, |truth| truth == 0.0)
}

/// Pixels on which light would leak: truth is 1, the surface faces the light (cosine above `min_facing`), and
/// nothing lighter than 1 in truth lies within `border` pixels, 0 for all of them.
///
/// Background counts as lit surroundings: pictures hold 0 there.
pub fn dark_mask(truth: Grid, facing: &[f32], border: usize, min_facing: f32) -> Vec<bool> {
    settled(truth, facing, border, min_facing, |truth| truth >= 1.0)
}

fn settled(truth: Grid, facing: &[f32], border: usize, min_facing: f32, is: impl Fn(f32) -> bool) -> Vec<bool> {
    let other: Vec<bool> = truth.values.iter().map(|&value| !is(value)).collect();
    let near_other = grown(&other, truth.width, border);
    near_other.iter().zip(facing).map(|(&other, &facing)| !other && facing > min_facing).collect()
}

/// Pixels within `pixels` of a true one, counted along rows, columns or diagonals (a square neighbourhood).
pub fn grown(mask: &[bool], width: usize, pixels: usize) -> Vec<bool> {
    if width == 0 || pixels == 0 {
        return mask.to_vec();
    }
    let height = mask.len() / width;
    let mut rows = mask.to_vec();
    for y in 0..height {
        spread(pixels, width, |x| mask[y * width + x], |x| rows[y * width + x] = true);
    }
    let mut both = rows.clone();
    for x in 0..width {
        spread(pixels, height, |y| rows[y * width + x], |y| both[y * width + x] = true);
    }
    both
}

/// Calls `set` for every index of 0..count within `reach` of one that `is` true.
fn spread(reach: usize, count: usize, is: impl Fn(usize) -> bool, mut set: impl FnMut(usize)) {
    let mut done = 0;
    for i in (0..count).filter(|&i| is(i)) {
        let end = (i + reach + 1).min(count);
        for j in done.max(i.saturating_sub(reach))..end {
            set(j);
        }
        done = end;
    }
}

/// Pixels with a part in shadow: 0 < reference < 1.
pub fn penumbra_mask(reference: &[f32]) -> Vec<bool> {
    reference.iter().map(|&value| value > 0.0 && value < 1.0).collect()
}

/// Pixels within `pixels` of truth's edge: of a pair of neighbours on different sides of ½. With [`rms`](super::rms)
/// by which the figures after Reeves 1987 measure jaggedness.
pub fn edge_mask(truth: Grid, pixels: usize) -> Vec<bool> {
    let mut at_edge = vec![false; truth.values.len()];
    let (width, height) = (truth.width, truth.height());
    for y in 0..height {
        for x in 0..width {
            let here = truth.at(x, y) >= 0.5;
            for (beside, inside) in [((x + 1, y), x + 1 < width), ((x, y + 1), y + 1 < height)] {
                if inside && (truth.at(beside.0, beside.1) >= 0.5) != here {
                    at_edge[y * width + x] = true;
                    at_edge[beside.1 * width + beside.0] = true;
                }
            }
        }
    }
    grown(&at_edge, width, pixels)
}

/// Pixels in both masks.
pub fn both(a: &[bool], b: &[bool]) -> Vec<bool> {
    a.iter().zip(b).map(|(&a, &b)| a && b).collect()
}

/// The fraction of `of`'s pixels that are in `mask` too. `None` when `of` is empty.
pub fn share(mask: &[bool], of: &[bool]) -> Option<f64> {
    let all = count(of);
    (all > 0).then(|| count(&both(mask, of)) as f64 / all as f64)
}

/// Intersection over union of two masks. `None` when both are empty.
pub fn iou(a: &[bool], b: &[bool]) -> Option<f64> {
    let common = count(&both(a, b));
    let union = count(a) + count(b) - common;
    (union > 0).then(|| common as f64 / union as f64)
}

fn count(mask: &[bool]) -> usize {
    mask.iter().filter(|&&inside| inside).count()
}

/// The centre of the shadow inside a mask, each pixel's centre weighing as much as it is dark. `None` without shadow.
pub fn centroid(shadow: Grid, mask: &[bool]) -> Option<DVec2> {
    let (mut sum, mut weight) = (DVec2::ZERO, 0.0);
    for (index, (&value, &inside)) in shadow.values.iter().zip(mask).enumerate() {
        if inside && value > 0.0 {
            let value = f64::from(value);
            sum += DVec2::new((index % shadow.width) as f64 + 0.5, (index / shadow.width) as f64 + 0.5) * value;
            weight += value;
        }
    }
    (weight > 0.0).then(|| sum / weight)
}
