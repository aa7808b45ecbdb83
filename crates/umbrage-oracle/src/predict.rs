//! What theory says a shadow map gets wrong: closed forms to draw beside measurements.
//!
//! Lengths are in one unit of the caller's choice within a call (world units, or texels), angles in radians.

use umbrage_depth::Stored;
use umbrage_plane::{Kind, View};

/// Fraction of a lit plane in false shadow under nearest look-up, bias drawn uniformly from `bias.0..=bias.1`.
///
/// `g1`, `g2` ≥ 0 are the plane's depth steps per texel along the map's axes (τ·tanθ·|cosφ|, τ·tanθ·|sinφ|), in either
/// order. Equal biases mean a constant one. On a plane square to the light (both steps 0) nothing is false unless the
/// bias is negative.
pub fn false_shadow_share(g1: f64, g2: f64, bias: (f64, f64)) -> f64 {
    let (low, high) = (bias.0.min(bias.1), bias.0.max(bias.1));
    if high > low {
        (share_integral(g1, g2, high) - share_integral(g1, g2, low)) / (high - low)
    } else {
        share_at(g1, g2, low)
    }
}

/// [`false_shadow_share`] for one bias.
fn share_at(g1: f64, g2: f64, bias: f64) -> f64 {
    let (large, small) = (g1.max(g2), g1.min(g2));
    if bias < 0.0 {
        1.0 - share_at(g1, g2, -bias)
    } else if bias >= 0.5 * (large + small) {
        0.0
    } else if bias <= 0.5 * (large - small) {
        0.5 - bias / large
    } else {
        (0.5 * (large + small) - bias).powi(2) / (2.0 * large * small)
    }
}

/// ∫ of [`share_at`] from 0 to `bias`; negative biases mirror it (share(−b) = 1 − share(b)).
fn share_integral(g1: f64, g2: f64, bias: f64) -> f64 {
    if bias < 0.0 {
        return bias + share_integral(g1, g2, -bias);
    }
    let (large, small) = (g1.max(g2), g1.min(g2));
    if large <= 0.0 {
        return 0.0;
    }
    let straight = bias.min(0.5 * (large - small));
    let flat = 0.5 * straight - straight * straight / (2.0 * large);
    if bias <= straight || small <= 0.0 {
        return flat;
    }
    let rest = |b: f64| (0.5 * (large + small) - b).powi(3) / (6.0 * large * small);
    flat + rest(straight) - rest(bias.min(0.5 * (large + small)))
}

/// The smallest bias without false shadow on a plane of steps `g1`, `g2`, for a filter of half-extent `radius` texels;
/// 0 for a point look-up.
pub fn acne_free_bias(g1: f64, g2: f64, radius: f64) -> f64 {
    (radius + 0.5) * (g1 + g2)
}

/// From one stored float to the next at an axial distance, in world units along the axis: what a view's kind of depth rounds
/// to on its axis of view.
pub fn float_step(view: &View, zeta: f64) -> f64 {
    let ulp = |stored: f64| (stored as f32).abs().next_up() - (stored as f32).abs();
    match view.kind() {
        Kind::Axial | Kind::Radial => f64::from(ulp(zeta)),
        Kind::Screen => {
            let (near, far) = (view.near(), view.far());
            let steps = f64::from(ulp(view.key(zeta)));
            // The inverse of dz_s/dζ.
            steps * (far - near) * if view.is_perspective() { zeta * zeta / (far * near) } else { 1.0 }
        }
    }
}

/// Variance of the mean of `samples` independent samples of a region of which the fraction `dark` is in shadow.
pub fn uniform_variance(dark: f64, samples: u32) -> f64 {
    dark * (1.0 - dark) / f64::from(samples)
}

/// Variance of the mean of `n` × `n` jittered samples crossed by an axis-parallel edge that leaves the fraction `dark` in
/// shadow: f(1−f)/n³ with f the edge's place within its stratum.
pub fn jitter_variance(dark: f64, n: u32) -> f64 {
    let n = f64::from(n);
    let within = dark * n - (dark * n).floor();
    within * (1.0 - within) / n.powi(3)
}

/// [`jitter_variance`] averaged over all places of the edge: 1/(6n³).
pub fn mean_jitter_variance(n: u32) -> f64 {
    1.0 / (6.0 * f64::from(n).powi(3))
}

/// Full width of the ramp that a box of half-extents `half_x`, `half_y` makes of a straight edge whose normal is at
/// `angle` to the map's x axis. Its 10–90 % width is .8 of this when the edge is parallel to an axis.
pub fn ramp_width(half_x: f64, half_y: f64, angle: f64) -> f64 {
    2.0 * (half_x * angle.cos().abs() + half_y * angle.sin().abs())
}

/// 10–90 % width of the same ramp for any direction of the edge: the profile is the convolution of two boxes.
pub fn ramp_width_10_90(half_x: f64, half_y: f64, angle: f64) -> f64 {
    let (a, b) = (2.0 * half_x * angle.cos().abs(), 2.0 * half_y * angle.sin().abs());
    let (large, small) = (a.max(b), a.min(b));
    // Where the trapezoid's tail of area d²/(2·large·small) reaches a tenth, unless its sloping part ends before.
    let tail = (0.2 * large * small).sqrt();
    let inset = if tail < small { tail } else { 0.5 * small + 0.1 * large };
    large + small - 2.0 * inset
}

/// How far past the true terminator a sphere of radius `radius` stays lit under a bias in the same unit, parallel
/// light: asin(bias / 2·radius). NaN when the bias exceeds the diameter.
pub fn terminator_shift(radius: f64, bias: f64) -> f64 {
    (bias / (2.0 * radius)).asin()
}

/// Fraction of a sphere's disc that is lit, seen orthographically with the light at `angle` from the direction to the
/// observer.
pub fn lit_share(angle: f64) -> f64 {
    0.5 * (1.0 + angle.cos())
}

/// Where the terminator crosses the disc's equator, in radii from its centre, positive toward the lit side.
pub fn terminator_offset(angle: f64) -> f64 {
    -angle.cos()
}

/// World units that one quantum of `bits`-bit post-projective depth spans at the axial distance `zeta`:
/// ζ²(f − n)/(fn·(2^bits − 1)) in perspective, (f − n)/(2^bits − 1) in an orthographic view.
pub fn depth_step(view: &View, bits: u32, zeta: f64) -> f64 {
    let (n, f) = (view.near(), view.far());
    let share = if view.is_perspective() { zeta * zeta / (f * n) } else { 1.0 };
    share * (f - n) / ((1u64 << bits.min(63)) - 1) as f64
}

/// The quantisation step of integer depth at the farthest receiver, in world units, when it exceeds half the bias: the perspective is
/// too severe for so few bits, and surfaces there shadow themselves (Williams 1978). `None` when all is well.
pub fn severe_perspective(view: &View, bits: u32, farthest_zeta: f64, bias_world: f64) -> Option<f64> {
    Some(depth_step(view, bits, farthest_zeta)).filter(|step| *step > 0.5 * bias_world)
}

/// How far behind what is stored a caster of `thickness` along the light ends, in the same unit: as far as a receiver that touches it may be
/// moved toward the light and stay dark. The rest of the thickness guards the caster from its own texels. 0 for a rule that is not published.
pub fn slack(stored: Stored, thickness: f64) -> f64 {
    match stored {
        Stored::First => thickness,
        Stored::Midpoint => 0.5 * thickness,
        _ => 0.0,
    }
}

/// Lit gap on the floor behind an upright leg of `thickness` along the light, light at `elevation`, ≥ 0.
pub fn expected_contact_gap(bias: f64, thickness: f64, elevation: f64, stored: Stored) -> f64 {
    (bias * elevation.cos() - slack(stored, thickness)).max(0.0)
}

/// True when no constant bias spares both the floor's acne and the contact of a leg of `thickness`: texels of
/// `texel_world`, filter half-extent `radius` texels, first surface stored.
pub fn no_bias_works(texel_world: f64, radius: f64, thickness: f64, elevation: f64) -> bool {
    texel_world * (radius + 0.5) / elevation.tan() > thickness / elevation.cos()
}

/// Width of the true penumbra of a disc light of `diameter`, at axial distances `occluder` < `receiver`.
pub fn expected_penumbra_width(diameter: f64, occluder: f64, receiver: f64) -> f64 {
    diameter * (receiver - occluder) / occluder
}

/// Half width of the penumbra of a directional light of angular radius `radians`, `gap` behind the occluder.
pub fn sky_penumbra_half_width(radians: f64, gap: f64) -> f64 {
    gap * radians.tan()
}

/// Half width of the same penumbra in the light's map, as a tangent: what a filter that is as wide as the truth has for
/// half-extent, in the unit of x_n/k.
pub fn penumbra_tangent(diameter: f64, occluder: f64, receiver: f64) -> f64 {
    0.5 * diameter * (1.0 / occluder - 1.0 / receiver)
}

/// Fraction of its largest radius that Bunnell & Pellacini's soft shadow uses, 0..1 (Burley 2006). With a largest radius of
/// diameter / 2·occluder it is [`penumbra_tangent`].
pub fn soft_radius_share(occluder: f64, receiver: f64) -> f64 {
    ((receiver - occluder) / receiver).clamp(0.0, 1.0)
}

/// Shadow behind a straight edge under a disc light, `offset` from the middle of the penumbra in halves of its width,
/// positive into the light: 1 up to −1, 0 from 1 on. The circle's part beyond a chord.
pub fn disc_edge(offset: f64) -> f64 {
    let x = offset.clamp(-1.0, 1.0);
    (x.acos() - x * (1.0 - x * x).sqrt()) / std::f64::consts::PI
}

/// 10–90 % width of the penumbra of a straight edge under a disc light, as a fraction of its full width: where
/// [`disc_edge`] is a tenth.
pub const DISC_EDGE_10_90: f64 = 0.687_048_826_132_540_5;
