/// A straight line through points, by least squares.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Fit {
    /// Change of y per unit of x.
    pub slope: f64,
    /// y at x = 0.
    pub intercept: f64,
    /// Fraction of y's variance that the line explains, 0..1; 1 when y does not vary.
    pub r2: f64,
}

/// The line of least squares through (x, y). `None` with fewer than two different x, or a number that is not finite.
pub fn linear_fit(points: &[(f64, f64)]) -> Option<Fit> {
    let count = points.len() as f64;
    let (mean_x, mean_y) =
        (points.iter().map(|p| p.0).sum::<f64>() / count, points.iter().map(|p| p.1).sum::<f64>() / count);
    let sum = |f: &dyn Fn(f64, f64) -> f64| points.iter().map(|p| f(p.0 - mean_x, p.1 - mean_y)).sum::<f64>();
    let (xx, xy, yy) = (sum(&|x, _| x * x), sum(&|x, y| x * y), sum(&|_, y| y * y));
    if !(xx > 0.0 && xx.is_finite() && xy.is_finite() && yy.is_finite()) {
        return None;
    }
    let slope = xy / xx;
    let r2 = if yy > 0.0 { (xy * xy / (xx * yy)).min(1.0) } else { 1.0 };
    Some(Fit { slope, intercept: mean_y - slope * mean_x, r2 })
}

/// The power law y = e^intercept · x^slope through points, a straight line in natural logarithms. `None` when a
/// coordinate is not positive, and as [`linear_fit`].
pub fn log_log_fit(points: &[(f64, f64)]) -> Option<Fit> {
    if points.iter().any(|&(x, y)| !(x > 0.0 && y > 0.0)) {
        return None;
    }
    let logs: Vec<(f64, f64)> = points.iter().map(|&(x, y)| (x.ln(), y.ln())).collect();
    linear_fit(&logs)
}
