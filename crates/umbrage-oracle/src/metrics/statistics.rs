use super::Grid;

/// The mean over a mask. `None` when the mask is empty.
pub fn mean(values: &[f32], mask: &[bool]) -> Option<f64> {
    mean_of(values.iter().zip(mask).filter(|(_, inside)| **inside).map(|(value, _)| f64::from(*value)))
}

/// The mean shadow, 0..1, where truth says lit; the mask is [`lit_mask`](super::lit_mask)'s.
pub fn false_shadow(shadow: &[f32], lit: &[bool]) -> Option<f64> {
    mean(shadow, lit)
}

/// The mean light, 0..1, where truth says shadowed; the mask is [`dark_mask`](super::dark_mask)'s.
pub fn leak(shadow: &[f32], dark: &[bool]) -> Option<f64> {
    mean(shadow, dark).map(|shadow| 1.0 - shadow)
}

/// Root mean square difference of two images over a mask, in units of shadow. `None` when the mask is empty.
pub fn rms(values: &[f32], reference: &[f32], mask: &[bool]) -> Option<f64> {
    let differences = values.iter().zip(reference).zip(mask).filter(|(_, inside)| **inside);
    mean_of(differences.map(|((a, b), _)| (f64::from(*a) - f64::from(*b)).powi(2))).map(f64::sqrt)
}

fn mean_of(values: impl Iterator<Item = f64>) -> Option<f64> {
    let (sum, count) = values.fold((0.0, 0u64), |(sum, count), value| (sum + value, count + 1));
    (count > 0).then(|| sum / count as f64)
}

/// How many different numbers an image holds inside a mask. All NaNs are one, and −0 is 0.
pub fn distinct_levels(values: &[f32], mask: &[bool]) -> usize {
    let inside = values.iter().zip(mask).filter(|(_, inside)| **inside).map(|(value, _)| *value);
    let mut levels: Vec<u32> =
        inside.map(|value| if value.is_nan() { f32::NAN.to_bits() } else { (value + 0.0).to_bits() }).collect();
    levels.sort_unstable();
    levels.dedup();
    levels.len()
}

/// The largest number of levels that a single region's sampling can have: one more than the largest denominator n ≤
/// `most` needed to write the values as k/n (a region of ns·nt samples has ns·nt + 1 levels).
///
/// Fractions in lowest terms: .5 from 16 samples needs 2. `None` when a value is no such fraction (within 1e−6), or
/// there is none.
pub fn levels_per_region(values: &[f32], most: u32) -> Option<u32> {
    let denominator = |value: f32| {
        (1..=most).find(|&n| {
            let numerator = f64::from(value) * f64::from(n);
            (0.0..=1.0).contains(&value) && (numerator - numerator.round()).abs() <= 1e-6 * f64::from(n)
        })
    };
    let mut largest = None;
    for &value in values {
        largest = largest.max(Some(denominator(value)?));
    }
    largest.map(|n| n + 1)
}

/// How many pixels stand alone: on the other side of ½ than all their neighbours, diagonal ones included (Williams 1978).
///
/// Lone dark pixels on light and lone light ones on dark both count. Only pixels of the mask can; their neighbours are
/// looked at wherever they lie.
pub fn lone_pixels(shadow: Grid, mask: &[bool]) -> usize {
    let (width, height) = (shadow.width, shadow.height());
    let dark = |x: usize, y: usize| shadow.at(x, y) >= 0.5;
    (0..width * height)
        .filter(|&index| {
            let (x, y) = (index % width, index / width);
            let rows = y.saturating_sub(1)..(y + 2).min(height);
            let mut others = rows
                .flat_map(|row| (x.saturating_sub(1)..(x + 2).min(width)).map(move |column| (column, row)))
                .filter(|&beside| beside != (x, y))
                .peekable();
            mask.get(index) == Some(&true)
                && others.peek().is_some()
                && others.all(|(column, row)| dark(column, row) != dark(x, y))
        })
        .count()
}
