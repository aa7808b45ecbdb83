//! What theory says a shadow map gets wrong: closed forms to draw beside measurements (spec D-9..D-13, D-16, D-19).
//!
//! Lengths are in one unit of the caller's choice within a call (world units, or texels), angles in radians.

use umbrage_depth::Stored;
use umbrage_plane::View;

/// Share of a lit plane in false shadow under nearest look-up, bias drawn uniformly from `bias.0..=bias.1` (D-9).
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
/// 0 for a point look-up (D-9).
pub fn acne_free_bias(g1: f64, g2: f64, radius: f64) -> f64 {
    (radius + 0.5) * (g1 + g2)
}

/// Variance of the mean of `samples` independent samples of a region of which the share `dark` is in shadow (D-12).
pub fn uniform_variance(dark: f64, samples: u32) -> f64 {
    dark * (1.0 - dark) / f64::from(samples)
}

/// Variance of the mean of `n` × `n` jittered samples crossed by an axis-parallel edge that leaves the share `dark` in
/// shadow: f(1−f)/n³ with f the edge's place within its stratum (D-12).
pub fn jitter_variance(dark: f64, n: u32) -> f64 {
    let n = f64::from(n);
    let within = dark * n - (dark * n).floor();
    within * (1.0 - within) / n.powi(3)
}

/// [`jitter_variance`] averaged over all places of the edge: 1/(6n³) (D-12).
pub fn mean_jitter_variance(n: u32) -> f64 {
    1.0 / (6.0 * f64::from(n).powi(3))
}

/// Full width of the ramp that a box of half-extents `half_x`, `half_y` makes of a straight edge whose normal is at
/// `angle` to the map's x axis (D-13). Its 10–90 % width is .8 of this when the edge is parallel to an axis.
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
/// light: asin(bias / 2·radius) (D-11). NaN when the bias exceeds the diameter.
pub fn terminator_shift(radius: f64, bias: f64) -> f64 {
    (bias / (2.0 * radius)).asin()
}

/// Share of a sphere's disc that is lit, seen orthographically with the light at `angle` from the direction to the
/// observer (D-19).
pub fn lit_share(angle: f64) -> f64 {
    0.5 * (1.0 + angle.cos())
}

/// Where the terminator crosses the disc's equator, in radii from its centre, positive toward the lit side (D-19).
pub fn terminator_offset(angle: f64) -> f64 {
    -angle.cos()
}

/// World units that one quantum of `bits`-bit post-projective depth spans at the axial distance `zeta` (D-17, V46b):
/// ζ²(f − n)/(fn·(2^bits − 1)) in perspective, (f − n)/(2^bits − 1) in an orthographic view.
pub fn depth_step(view: &View, bits: u32, zeta: f64) -> f64 {
    let (n, f) = (view.near(), view.far());
    let share = if view.is_perspective() { zeta * zeta / (f * n) } else { 1.0 };
    share * (f - n) / ((1u64 << bits.min(63)) - 1) as f64
}

/// The quantisation step of integer depth at the farthest receiver, in world units, when it exceeds half the bias: the perspective is
/// too severe for so few bits, and surfaces there shadow themselves (Williams 1978; W78-9). `None` when all is well.
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

/// Lit gap on the floor behind an upright leg of `thickness` along the light, light at `elevation`, ≥ 0 (D-10).
pub fn expected_contact_gap(bias: f64, thickness: f64, elevation: f64, stored: Stored) -> f64 {
    (bias * elevation.cos() - slack(stored, thickness)).max(0.0)
}

/// True when no constant bias spares both the floor's acne and the contact of a leg of `thickness`: texels of
/// `texel_world`, filter half-extent `radius` texels, first surface stored (D-10).
pub fn no_bias_works(texel_world: f64, radius: f64, thickness: f64, elevation: f64) -> bool {
    texel_world * (radius + 0.5) / elevation.tan() > thickness / elevation.cos()
}

/// Width of the true penumbra of a disc light of `diameter`, at axial distances `occluder` < `receiver` (D-16).
pub fn expected_penumbra_width(diameter: f64, occluder: f64, receiver: f64) -> f64 {
    diameter * (receiver - occluder) / occluder
}

/// Half width of the penumbra of a directional light of angular radius `radians`, `gap` behind the occluder (D-16).
pub fn sky_penumbra_half_width(radians: f64, gap: f64) -> f64 {
    gap * radians.tan()
}

/// Half width of the same penumbra in the light's map, as a tangent: what a filter that is as wide as the truth has for
/// half-extent, in the unit of x_n/k (D-16).
pub fn penumbra_tangent(diameter: f64, occluder: f64, receiver: f64) -> f64 {
    0.5 * diameter * (1.0 / occluder - 1.0 / receiver)
}

/// Share of its largest radius that Bunnell & Pellacini's soft shadow uses, 0..1 (B06-6). With a largest radius of
/// diameter / 2·occluder it is [`penumbra_tangent`] (D-16).
pub fn soft_radius_share(occluder: f64, receiver: f64) -> f64 {
    ((receiver - occluder) / receiver).clamp(0.0, 1.0)
}

/// Shadow behind a straight edge under a disc light, `offset` from the middle of the penumbra in halves of its width,
/// positive into the light: 1 up to −1, 0 from 1 on. The circle's part beyond a chord.
pub fn disc_edge(offset: f64) -> f64 {
    let x = offset.clamp(-1.0, 1.0);
    (x.acos() - x * (1.0 - x * x).sqrt()) / std::f64::consts::PI
}

/// 10–90 % width of the penumbra of a straight edge under a disc light, as a share of its full width: where
/// [`disc_edge`] is a tenth.
pub const DISC_EDGE_10_90: f64 = 0.687_048_826_132_540_5;

#[cfg(test)]
mod tests {
    use super::*;
    use umbrage_sample::Key;

    fn near(a: f64, b: f64) {
        assert!((a - b).abs() < 1e-6, "{a} is not {b}");
    }

    #[test]
    fn v46b_d_17_w78_9_quantisation_steps_and_severe_perspective() {
        let size = glam::UVec2::splat(512);
        let (eye, ahead, up) = (glam::DVec3::ZERO, glam::DVec3::NEG_Z, glam::DVec3::Y);
        let flat = View::orthographic(eye, ahead, up, 1.0, 0.0, 100.0, size).unwrap();
        let lamp = View::perspective(eye, ahead, up, 1.0, 1.0, 100.0, size).unwrap();
        near(depth_step(&flat, 16, 7.0), 0.001_525_90);
        near(depth_step(&lamp, 16, 50.0), 0.037_766_08);
        assert_eq!(severe_perspective(&lamp, 16, 50.0, 0.1), None);
        near(severe_perspective(&lamp, 16, 50.0, 0.05).unwrap(), 0.037_766_08);
        assert_eq!(severe_perspective(&lamp, 24, 50.0, 0.05), None);
    }

    #[test]
    fn v16_v17_false_shadow() {
        for ((low, high), share) in
            [((0.0, 0.0), 0.5), ((0.2, 0.2), 0.3), ((0.2, 0.4), 0.2), ((0.3, 0.4), 0.15), ((0.3, 0.7), 0.05)]
        {
            near(false_shadow_share(1.0, 0.0, (low, high)), share);
            near(false_shadow_share(0.0, 1.0, (high, low)), share);
        }
        near(false_shadow_share(2.0, 0.0, (0.3, 0.4)), 0.325);
        near(false_shadow_share(1.0, 0.5, (0.3, 0.3)), 0.2025);
        near(false_shadow_share(1.0, 0.5, (0.1, 0.1)), 0.4);
        near(false_shadow_share(1.0, 0.5, (0.75, 0.75)), 0.0);
        near(false_shadow_share(0.0, 0.0, (0.0, 0.1)), 0.0);
    }

    #[test]
    fn d9_agrees_with_drawn_look_ups() {
        let key = Key::new(9, 0, 0);
        for (g1, g2, low, high) in
            [(1.0, 0.5, 0.1, 0.6), (0.4, 0.4, 0.0, 0.5), (1.0, 0.2, -0.3, 0.3), (0.7, 0.0, 0.1, 0.2)]
        {
            let draws = 200_000;
            let mut false_shadows = 0u32;
            for i in 0..draws {
                let error = g1 * 0.5 * f64::from(key.signed(i, 0)) + g2 * 0.5 * f64::from(key.signed(i, 1));
                let bias = low + (high - low) * f64::from(key.unit(i, 2));
                false_shadows += u32::from(error > bias);
            }
            let (drawn, predicted) =
                (f64::from(false_shadows) / f64::from(draws), false_shadow_share(g1, g2, (low, high)));
            assert!((drawn - predicted).abs() < 4e-3, "{g1} {g2} {low}..{high}: {drawn} is not {predicted}");
        }
    }

    #[test]
    fn v18_acne_free_bias() {
        let step = 0.5 * 2.0;
        near(acne_free_bias(step, 0.0, 0.0), 0.5);
        near(acne_free_bias(step, 0.0, 3.0), 3.5);
        near(false_shadow_share(0.9, 0.3, (acne_free_bias(0.9, 0.3, 0.0), 9.0)), 0.0);
    }

    #[test]
    fn v19_variances() {
        for (n, dark, uniform, jitter) in [
            (4, 0.625, 0.014_648_44, 0.003_906_25),
            (4, 0.5, 0.015_625, 0.0),
            (4, 0.55, 0.015_468_75, 0.0025),
            (8, 0.5625, 0.003_845_215, 0.000_488_281_25),
        ] {
            near(uniform_variance(dark, n * n), uniform);
            near(jitter_variance(dark, n), jitter);
        }
    }

    #[test]
    fn d12_agrees_with_drawn_jitter() {
        let key = Key::new(12, 0, 0);
        for (n, dark) in [(4u32, 0.625), (4, 0.55), (8, 0.5625)] {
            let trials = 40_000;
            let mut squares = 0.0;
            for trial in 0..trials {
                let dark_samples = (0..n * n).filter(|cell| {
                    let x = (f64::from(cell % n) + f64::from(key.region(trial).unit(*cell, 0))) / f64::from(n);
                    x < dark
                });
                squares += (dark_samples.count() as f64 / f64::from(n * n) - dark).powi(2);
            }
            let (drawn, predicted) = (squares / f64::from(trials), jitter_variance(dark, n));
            assert!((drawn / predicted - 1.0).abs() < 0.03, "n = {n}, p = {dark}: {drawn} is not {predicted}");
        }
        let places = 1000;
        let mean = (0..places).map(|i| jitter_variance((f64::from(i) + 0.5) / f64::from(places), 4)).sum::<f64>();
        assert!((mean / f64::from(places) - mean_jitter_variance(4)).abs() < 1e-5);
    }

    #[test]
    fn v20_v46c_sphere() {
        near(terminator_shift(20.0, 0.35).to_degrees(), 0.501_344_5);
        near(lit_share(100f64.to_radians()), 0.413_175_9);
        near(terminator_offset(100f64.to_radians()), 0.173_648_2);
    }

    #[test]
    fn v21_ramp() {
        near(ramp_width(1.0, 1.0, 0.0), 2.0);
        near(ramp_width_10_90(1.0, 1.0, 0.0), 1.6);
        near(ramp_width(1.0, 1.0, 45f64.to_radians()), 2.828_427_1);
    }

    #[test]
    fn d13_ten_to_ninety_by_sampling() {
        for (half_x, half_y, angle) in [(1.0, 1.0, 45f64), (3.0, 1.0, 20.0), (2.0, 0.1, 60.0)] {
            let angle = angle.to_radians();
            let mut offsets = Vec::new();
            for i in 0..400 {
                for j in 0..400 {
                    let (x, y) = (f64::from(i) / 200.0 - 0.9975, f64::from(j) / 200.0 - 0.9975);
                    offsets.push(half_x * x * angle.cos() + half_y * y * angle.sin());
                }
            }
            offsets.sort_by(f64::total_cmp);
            let width = offsets[offsets.len() * 9 / 10] - offsets[offsets.len() / 10];
            assert!((width - ramp_width_10_90(half_x, half_y, angle)).abs() < 0.02 * half_x);
        }
    }

    #[test]
    fn d10_contact_and_the_impossible_bias() {
        // SC-D: legs of 8, elevation 25°, texels of 3.92 at 512².
        let (elevation, texel) = (25f64.to_radians(), 3.92);
        assert!((expected_contact_gap(15.0, 8.0, elevation, Stored::First) - 5.6).abs() < 0.05);
        assert_eq!(expected_contact_gap(5.0, 8.0, elevation, Stored::First), 0.0);
        assert_eq!(expected_contact_gap(0.0, 8.0, elevation, Stored::Second), 0.0);
        assert!(no_bias_works(texel, 2.0, 8.0, elevation));
        assert!(!no_bias_works(texel / 4.0, 0.5, 8.0, elevation));
    }

    #[test]
    fn d16_penumbra() {
        near(expected_penumbra_width(2.0, 10.0, 15.0), 1.0);
        near(sky_penumbra_half_width(0.1, 5.0), 0.501_673_36);
    }

    #[test]
    fn v65_d16_penumbra_in_the_map() {
        near(expected_penumbra_width(2.0, 5.0, 10.0), 2.0);
        near(penumbra_tangent(2.0, 5.0, 10.0), 0.1);
        near(soft_radius_share(5.0, 10.0), 0.5);
        // A largest radius of l / 2·occluder makes B06's radius the true one.
        near(2.0 / (2.0 * 5.0) * soft_radius_share(5.0, 10.0), penumbra_tangent(2.0, 5.0, 10.0));
    }

    #[test]
    fn d16_disc_edge_is_the_circle_s_part() {
        near(disc_edge(-3.0), 1.0);
        near(disc_edge(0.0), 0.5);
        near(disc_edge(2.0), 0.0);
        near(disc_edge(DISC_EDGE_10_90), 0.1);
        near(disc_edge(-DISC_EDGE_10_90), 0.9);
        let inside = |x: f64| 2.0 * (1.0 - x * x).sqrt() / std::f64::consts::PI;
        let strips = 100_000;
        let beyond: f64 = (0..strips).map(|i| inside(0.3 + 0.7 * (f64::from(i) + 0.5) / f64::from(strips))).sum();
        assert!((disc_edge(0.3) - beyond * 0.7 / f64::from(strips)).abs() < 1e-6);
    }
}
