use super::Grid;
use glam::DVec2;

/// A piece of a contour, pixels; the darker side is not told apart.
pub type Segment = [DVec2; 2];

/// The line on which an image passes `level`: marching squares between pixel centres, linear along their sides.
///
/// Squares with a NaN corner have none. In a square whose diagonals disagree the mean of its corners decides.
pub fn contour(image: Grid, level: f32) -> Vec<Segment> {
    let mut segments = Vec::new();
    for y in 1..image.height() {
        for x in 1..image.width {
            let corners = [(x - 1, y - 1), (x, y - 1), (x, y), (x - 1, y)];
            let values = corners.map(|(x, y)| image.at(x, y));
            if values.iter().any(|value| value.is_nan()) {
                continue;
            }
            let place = corners.map(|(x, y)| DVec2::new(x as f64 + 0.5, y as f64 + 0.5));
            let mut met = Vec::with_capacity(4);
            for i in 0..4 {
                let j = (i + 1) % 4;
                if (values[i] >= level) != (values[j] >= level) {
                    let t = f64::from(level - values[i]) / f64::from(values[j] - values[i]);
                    met.push(place[i].lerp(place[j], t));
                }
            }
            match met[..] {
                [a, b] => segments.push([a, b]),
                [a, b, c, d] => {
                    // Four crossings on sides 0..3: the corner that differs from the middle is cut off.
                    let middle_dark = values.iter().sum::<f32>() * 0.25 >= level;
                    let first_cut = (values[0] >= level) != middle_dark;
                    segments.extend(if first_cut { [[d, a], [b, c]] } else { [[a, b], [c, d]] });
                }
                _ => {}
            }
        }
    }
    segments
}

/// How far an image's ½-contour lies from truth's, pixels.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Deviation {
    /// Root mean square distance, each piece weighing by its length (Williams 1978).
    pub rms: f64,
    /// Mean signed distance; positive where the contour runs inside truth's shadow: the shadow is too small.
    pub mean: f64,
    /// Mean distance without its sign.
    pub absolute: f64,
    /// Length of contour that was measured, pixels.
    pub length: f64,
}

/// The distances of `image`'s ½-contour from `truth`'s, over the pieces within `reach` pixels of it (+∞: all).
///
/// `None` when one of the two has no contour, or no piece is within reach.
pub fn contour_deviation(image: Grid, truth: Grid, reach: f64) -> Option<Deviation> {
    deviation(&offsets(image, truth, reach))
}

/// What the pieces come to; `None` without any.
pub(crate) fn deviation(pieces: &[Offset]) -> Option<Deviation> {
    let length: f64 = pieces.iter().map(|piece| piece.length).sum();
    let weighted = |f: fn(f64) -> f64| pieces.iter().map(|piece| piece.length * f(piece.shift)).sum::<f64>() / length;
    (length > 0.0).then(|| Deviation {
        rms: weighted(|d| d * d).sqrt(),
        mean: weighted(|d| d),
        absolute: weighted(f64::abs),
        length,
    })
}

/// A piece of an image's contour and its signed distance from truth's.
pub(crate) struct Offset {
    pub middle: DVec2,
    pub length: f64,
    pub shift: f64,
}

pub(crate) fn offsets(image: Grid, truth: Grid, reach: f64) -> Vec<Offset> {
    let targets = Nearby::new(truth.width, truth.height(), contour(truth, 0.5));
    let pieces = contour(image, 0.5).into_iter().filter_map(|[a, b]| {
        let middle = (a + b) * 0.5;
        let distance = targets.distance(middle).filter(|distance| *distance <= reach)?;
        let inside = truth.between(middle).is_some_and(|truth| truth >= 0.5);
        Some(Offset { middle, length: a.distance(b), shift: if inside { distance } else { -distance } })
    });
    pieces.collect()
}

/// Segments by the squares of the image they touch, so that the nearest is found without asking all.
struct Nearby {
    squares: Vec<Vec<Segment>>,
    columns: i64,
    rows: i64,
}

const SQUARE: f64 = 8.0;

impl Nearby {
    fn new(width: usize, height: usize, segments: Vec<Segment>) -> Self {
        let (columns, rows) = square(DVec2::new(width as f64, height as f64));
        let (columns, rows) = (columns + 1, rows + 1);
        let mut squares = vec![Vec::new(); (columns * rows) as usize];
        for [a, b] in segments {
            let (first, last) = (square(a), square(b));
            squares[(first.1 * columns + first.0) as usize].push([a, b]);
            if last != first {
                squares[(last.1 * columns + last.0) as usize].push([a, b]);
            }
        }
        Self { squares, columns, rows }
    }

    fn distance(&self, at: DVec2) -> Option<f64> {
        let (x, y) = square(at);
        let mut best: Option<f64> = None;
        for ring in 0..=self.columns.max(self.rows) + x.abs().max(y.abs()) {
            // A segment may reach two pixels out of the squares that list it.
            if best.is_some_and(|best| best <= (ring - 1) as f64 * SQUARE - 2.0) {
                break;
            }
            for row in (y - ring).max(0)..=(y + ring).min(self.rows - 1) {
                let whole = row == y - ring || row == y + ring;
                let step = if whole { 1 } else { (2 * ring).max(1) };
                let columns = (0..=2 * ring / step).map(|i| x - ring + i * step);
                for column in columns.filter(|column| (0..self.columns).contains(column)) {
                    for segment in &self.squares[(row * self.columns + column) as usize] {
                        let distance = to_segment(at, segment);
                        best = Some(best.map_or(distance, |best| best.min(distance)));
                    }
                }
            }
        }
        best
    }
}

fn square(at: DVec2) -> (i64, i64) {
    ((at.x / SQUARE).floor() as i64, (at.y / SQUARE).floor() as i64)
}

pub(super) fn to_segment(at: DVec2, [a, b]: &Segment) -> f64 {
    let along = *b - *a;
    let length_squared = along.length_squared();
    let t = if length_squared > 0.0 { ((at - *a).dot(along) / length_squared).clamp(0.0, 1.0) } else { 0.0 };
    at.distance(*a + along * t)
}
