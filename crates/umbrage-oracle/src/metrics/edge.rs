use super::Grid;
use glam::DVec2;

/// A strip of pixels across a known straight edge.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Band {
    /// A point of the edge, pixels; the strip's middle.
    pub point: DVec2,
    /// Unit vector across the edge, from light to shadow.
    pub normal: DVec2,
    /// How far the strip reaches along the edge to either side of `point`, pixels.
    pub half_length: f64,
    /// How far it reaches across the edge to either side, pixels. Wide enough for light and shadow to level out.
    pub half_width: f64,
    /// Bins of the profile per pixel of distance.
    pub bins_per_pixel: f64,
}

impl Band {
    /// The strip about the edge from `a` to `b` (pixels), the shadow on the side that `dark` lies on; four bins per pixel.
    pub fn between(a: DVec2, b: DVec2, dark: DVec2, half_width: f64) -> Self {
        let across = (b - a).perp().normalize_or(DVec2::X);
        let normal = if across.dot(dark - a) < 0.0 { -across } else { across };
        Self { point: (a + b) * 0.5, normal, half_length: 0.5 * a.distance(b), half_width, bins_per_pixel: 4.0 }
    }
}

/// The mean shadow as a function of the distance across an edge.
#[derive(Clone, Debug, PartialEq, Default)]
pub struct Profile {
    /// (mean distance of the bin's pixel centres from the edge, mean shadow), by increasing distance; empty bins are
    /// left out. Pixels (world units from [`profile_on_surface`](crate::profile_on_surface)), as are all that is measured
    /// on it; positive on the shadow's side.
    pub points: Vec<(f64, f64)>,
}

/// The mean profile across an edge. Pixels are binned by the distance of their centres; NaN pixels are left out.
pub fn profile(image: Grid, band: &Band) -> Profile {
    let bins = (2.0 * band.half_width * band.bins_per_pixel).ceil().clamp(0.0, 1e6) as usize;
    let mut sums = vec![(0.0, 0.0, 0u32); bins];
    for y in 0..image.height() {
        for x in 0..image.width {
            let from_edge = DVec2::new(x as f64 + 0.5, y as f64 + 0.5) - band.point;
            let (across, along) = (from_edge.dot(band.normal), from_edge.dot(band.normal.perp()));
            let value = f64::from(image.at(x, y));
            let bin = ((across + band.half_width) * band.bins_per_pixel).floor();
            if along.abs() <= band.half_length && bin >= 0.0 && bin < bins as f64 && !value.is_nan() {
                let sum = &mut sums[bin as usize];
                *sum = (sum.0 + across, sum.1 + value, sum.2 + 1);
            }
        }
    }
    let points = sums.into_iter().filter(|sum| sum.2 > 0);
    Profile { points: points.map(|(d, v, n)| (d / f64::from(n), v / f64::from(n))).collect() }
}

impl Profile {
    /// Mean shadow of the outer eighths: the light and the dark level. `None` with fewer than 8 points.
    pub fn levels(&self) -> Option<(f64, f64)> {
        let outer = self.points.len() / 8;
        let mean = |points: &[(f64, f64)]| points.iter().map(|p| p.1).sum::<f64>() / points.len() as f64;
        (outer > 0).then(|| (mean(&self.points[..outer]), mean(&self.points[self.points.len() - outer..])))
    }

    /// The 10–90 % width in pixels, between the light and the dark level. `None` where those differ by less than
    /// .05, or a crossing is missing.
    ///
    /// The crossings are the first ones met going outward from the midpoint.
    pub fn width(&self) -> Option<f64> {
        let (middle, (low, high)) = (self.middle()?, self.levels()?);
        let level = |share: f64| low + share * (high - low);
        let light = self.points[..=middle + 1].windows(2).rev().find_map(|pair| crossing(pair, level(0.1)));
        let dark = self.points[middle..].windows(2).find_map(|pair| crossing(pair, level(0.9)));
        Some(dark? - light?)
    }

    /// Where the profile crosses half-way between its levels, pixels from the band's edge; the crossing nearest to
    /// that edge. Positive: into the shadow.
    pub fn midpoint(&self) -> Option<f64> {
        let middle = self.middle()?;
        let (low, high) = self.levels()?;
        crossing(&self.points[middle..middle + 2], 0.5 * (low + high))
    }

    /// How far this profile's midpoint lies from truth's, pixels. Positive: the shadow is smaller than it should be.
    pub fn shift(&self, truth: &Self) -> Option<f64> {
        Some(self.midpoint()? - truth.midpoint()?)
    }

    /// Index of the point before the mid crossing that is nearest to the edge.
    fn middle(&self) -> Option<usize> {
        let (low, high) = self.levels()?;
        if high - low < 0.05 {
            return None;
        }
        let half = 0.5 * (low + high);
        let crossings = self.points.windows(2).enumerate();
        let found = crossings.filter_map(|(index, pair)| crossing(pair, half).map(|at| (at.abs(), index)));
        found.min_by(|a, b| a.0.total_cmp(&b.0)).map(|(_, index)| index)
    }
}

/// Where the line between two points passes `level` upward.
fn crossing(pair: &[(f64, f64)], level: f64) -> Option<f64> {
    let [(x0, y0), (x1, y1)] = *pair else { return None };
    (y0 <= level && y1 >= level && y1 > y0).then(|| x0 + (x1 - x0) * (level - y0) / (y1 - y0))
}

/// The distance in pixels from `foot`, going along `toward` (need not be unit), to the first shadow ≥ ½.
///
/// Shadow between pixel centres is bilinear. 0 when `foot` itself is in shadow; `None` when the way leaves the image,
/// or meets a NaN, before any. For world units take the picture's positions at both ends.
pub fn contact_gap(shadow: Grid, foot: DVec2, toward: DVec2) -> Option<f64> {
    const STEP: f64 = 0.125;
    let direction = toward.try_normalize()?;
    let value = |distance: f64| shadow.between(foot + direction * distance);
    let mut before = value(0.0)?;
    let mut distance = 0.0;
    while before < 0.5 {
        let here = value(distance + STEP)?;
        if here >= 0.5 {
            return Some(distance + STEP * (0.5 - before) / (here - before));
        }
        before = here;
        distance += STEP;
    }
    Some(distance)
}
