/// What remains of a moment's 32-bit roundings in a squared difference of depths within 0..=1: the smallest that counts as one.
const ROUNDING: f64 = 1.0 / 4_194_304.0;

/// The largest fraction of any distribution of this mean and variance that can lie at `place` or beyond it: Chebyshev's inequality for one side, also
/// named after Cantelli. 1 for places up to the mean, and where one of the numbers is NaN.
///
/// For d = place − mean > 0 and any t ≥ 0, whatever lies at the place or beyond is at least d + t away from mean − t, so that by Markov's
/// inequality its fraction is at most (variance + t²) / (d + t)². The best t is variance / d, which gives variance / (variance + d²).
/// A distribution of two values reaches it at the larger one.
#[must_use]
pub fn at_or_beyond(mean: f64, variance: f64, place: f64) -> f64 {
    let beyond = place - mean;
    let share = variance / (variance + beyond * beyond);
    if beyond > 0.0 && share < 1.0 { share } else { 1.0 }
}

/// The largest fraction of any distribution of positive values of this mean that can lie at `value` or beyond it: Markov's inequality, by which
/// each of them contributes `value` at least to the mean. At most 1, and 1 where one of the numbers is NaN.
#[must_use]
pub fn at_or_beyond_by_mean(mean: f64, value: f64) -> f64 {
    let share = mean / value;
    if share < 1.0 { share } else { 1.0 }
}

/// The smallest fraction of any distribution of these four moments, the means of the first four powers, that can lie before `place`. It is a sharp bound:
/// there is a distribution of three values that has the moments, `place` among its values, and just this fraction before it.
///
/// Let y = x − mean, and v, c₃ and c₄ the means of its second, third and fourth power. The moments define a scalar product of
/// quadratic polynomials, ⟨p, q⟩ = mean of p·q, under which
///
/// p₀ = 1, p₁ = y and p₂ = y² − v − (c₃/v)·y
///
/// are orthogonal, with the squared lengths 1, v and w = c₄ − v² − c₃²/v. Their kernel is K(x, z) = 1 + p₁(x)·p₁(z)/v + p₂(x)·p₂(z)/w. The two roots
/// of K(place, ·) are the other two values of the three-point distribution, and a value x of it has the fraction 1/K(x, x), which is the
/// most that any distribution of these moments has in one place (the classical moment problem; Akhiezer 1965, ch. 2). The bound was brought to
/// shadows by Peters & Klein 2015, §4.
///
/// Roundings can leave moments that no distribution has. Where v or w falls below what they leave open, it is raised to that: as if
/// a fraction of that size were far away on both sides, by which the bound stays one. NaN gives 0.
#[must_use]
pub fn before(moments: [f64; 4], place: f64) -> f64 {
    let quadratics = Quadratics::of(moments);
    let place = place - moments[0];
    let partners = quadratics.partners(place);
    let of = |y: f64| if y < place { quadratics.share(y) } else { 0.0 };
    let share = of(partners[0]) + of(partners[1]);
    // By rounding, two fractions may add up to more than 1.
    if share > 0.0 { share.min(1.0) } else { 0.0 }
}

/// The orthogonal polynomials of four moments, about their mean.
struct Quadratics {
    variance: f64,
    /// c₃/v.
    skew: f64,
    /// w.
    rest: f64,
}

impl Quadratics {
    fn of([mean, square, cube, fourth]: [f64; 4]) -> Self {
        let variance = (square - mean * mean).max(ROUNDING);
        let third = cube - mean * (3.0 * square - 2.0 * mean * mean);
        let fourth = fourth - mean * (4.0 * cube - mean * (6.0 * square - 3.0 * mean * mean));
        let skew = third / variance;
        Self { variance, skew, rest: (fourth - variance * variance - skew * third).max(ROUNDING) }
    }

    /// p₂.
    fn quadratic(&self, y: f64) -> f64 {
        y * (y - self.skew) - self.variance
    }

    /// 1/K(y, y); none infinitely far away.
    fn share(&self, y: f64) -> f64 {
        let quadratic = self.quadratic(y);
        let kernel = 1.0 + y * y / self.variance + quadratic * quadratic / self.rest;
        if kernel.is_finite() { 1.0 / kernel } else { 0.0 }
    }

    /// The roots of K(place, ·), which is a·y² + b·y + c. One that lies infinitely far away is not finite.
    fn partners(&self, place: f64) -> [f64; 2] {
        let a = self.quadratic(place) / self.rest;
        let b = place / self.variance - a * self.skew;
        let c = 1.0 - a * self.variance;
        // Both roots without a difference of numbers that are nearly equal.
        let half = -0.5 * (b + (b * b - 4.0 * a * c).max(0.0).sqrt().copysign(b));
        [half / a, c / half]
    }
}
