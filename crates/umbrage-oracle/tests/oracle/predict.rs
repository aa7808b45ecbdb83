//! What formulae say will go wrong.

use umbrage_depth::Stored;
use umbrage_oracle::predict::*;
use umbrage_plane::View;
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
    for (g1, g2, low, high) in [(1.0, 0.5, 0.1, 0.6), (0.4, 0.4, 0.0, 0.5), (1.0, 0.2, -0.3, 0.3), (0.7, 0.0, 0.1, 0.2)]
    {
        let draws = 200_000;
        let mut false_shadows = 0u32;
        for i in 0..draws {
            let error = g1 * 0.5 * f64::from(key.signed(i, 0)) + g2 * 0.5 * f64::from(key.signed(i, 1));
            let bias = low + (high - low) * f64::from(key.unit(i, 2));
            false_shadows += u32::from(error > bias);
        }
        let (drawn, predicted) = (f64::from(false_shadows) / f64::from(draws), false_shadow_share(g1, g2, (low, high)));
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
