//! The measures M1 to M9 on images whose answer is known.
use glam::DVec2;
use proptest::prelude::*;
use std::f64::consts::{PI, TAU};
use umbrage_oracle::metrics::*;
use umbrage_sample::Key;

const SIDE: usize = 96;

/// An image of a function of pixel centres.
fn image(side: usize, value: impl Fn(DVec2) -> f64) -> Vec<f32> {
    let pixels = (0..side * side).map(|i| DVec2::new((i % side) as f64 + 0.5, (i / side) as f64 + 0.5));
    pixels.map(|at| value(at) as f32).collect()
}

/// A ramp from light to dark across `band`'s edge, moved by `shift` toward the dark.
fn ramp(band: &Band, width: f64, shift: f64) -> Vec<f32> {
    image(SIDE, |at| (((at - band.point).dot(band.normal) - shift) / width + 0.5).clamp(0.0, 1.0))
}

fn band(angle: f64) -> Band {
    Band {
        point: DVec2::new(47.3, 49.1),
        normal: DVec2::from_angle(angle),
        half_length: 25.0,
        half_width: 20.0,
        bins_per_pixel: 4.0,
    }
}

proptest! {
    #[test]
    fn m1_m4_of_a_linear_ramp(angle in 0.0..TAU, width in 3.0..14.0f64, shift in -4.0..4.0f64) {
        let band = band(angle);
        let (truth, moved) = (ramp(&band, width, 0.0), ramp(&band, width, shift));
        let (truth, moved) = (profile(Grid::new(&truth, SIDE), &band), profile(Grid::new(&moved, SIDE), &band));
        let (found, expected) = (moved.width().unwrap(), 0.8 * width);
        // Along an axis the profile has one point a pixel: a tenth of a narrow ramp lies between kink and point.
        let tolerance = if width < 10.0 { 0.45 } else { 0.1 };
        prop_assert!((found - expected).abs() < tolerance, "{found} is not {expected}");
        prop_assert!((moved.midpoint().unwrap() - shift).abs() < 0.1);
        prop_assert!((moved.shift(&truth).unwrap() - shift).abs() < 0.1);
    }

    #[test]
    fn w78_f5_the_nearest_contour_is_the_nearest(seed in any::<u32>(), spots in 1u32..6) {
        let key = Key::new(seed, 0, 0);
        let spot = |i: u32| DVec2::new(f64::from(key.unit(i, 0)), f64::from(key.unit(i, 1))) * 60.0;
        let truth = image(60, |at| (0..spots).map(|i| 2.0 - at.distance(spot(i))).fold(0.0, f64::max).min(1.0));
        let dot = image(60, |at| (2.0 - at.distance(spot(99))).clamp(0.0, 1.0));
        let (truth, dot) = (Grid::new(&truth, 60), Grid::new(&dot, 60));
        let targets = contour(truth, 0.5);
        let (mut sum, mut length) = (0.0, 0.0);
        for [a, b] in contour(dot, 0.5) {
            let middle = (a + b) * 0.5;
            // Sixty-four points a segment are close enough to its nearest.
            let points = targets.iter().flat_map(|[a, b]| (0..=64).map(|i| a.lerp(*b, f64::from(i) / 64.0)));
            sum += a.distance(b) * points.map(|at| at.distance(middle)).fold(f64::INFINITY, f64::min).powi(2);
            length += a.distance(b);
        }
        let found = contour_deviation(dot, truth, f64::INFINITY);
        prop_assert_eq!(found.is_some(), length > 0.0 && !targets.is_empty());
        if let Some(found) = found {
            prop_assert!((found.rms - (sum / length).sqrt()).abs() < 0.02);
        }
    }

    #[test]
    fn growing_is_asking_every_neighbour(seed in any::<u32>(), width in 1usize..20, height in 1usize..20, reach in 0usize..6) {
        let key = Key::new(seed, 0, 0);
        let mask: Vec<bool> = (0..width * height).map(|i| key.unit(i as u32, 0) < 0.05).collect();
        let grown = grown(&mask, width, reach);
        for (i, &found) in grown.iter().enumerate() {
            let (x, y) = (i % width, i / width);
            let expected = (0..width * height).any(|j| mask[j] && (j % width).abs_diff(x) <= reach && (j / width).abs_diff(y) <= reach);
            prop_assert_eq!(found, expected);
        }
    }
}

#[test]
fn m1_without_an_edge() {
    let band = band(0.3);
    assert_eq!(profile(Grid::new(&vec![0.5; SIDE * SIDE], SIDE), &band).width(), None);
    assert_eq!(profile(Grid::new(&[], SIDE), &band), Profile::default());
    assert_eq!(profile(Grid::new(&vec![f32::NAN; SIDE * SIDE], SIDE), &band).midpoint(), None);
    let step = image(SIDE, |at| f64::from(u8::from(at.x > 48.0)));
    let across = Band { point: DVec2::new(48.0, 48.0), normal: DVec2::X, ..band };
    let profile_of_step = profile(Grid::new(&step, SIDE), &across);
    assert!((profile_of_step.midpoint().unwrap()).abs() < 1e-9);
    assert!((profile_of_step.width().unwrap() - 0.8).abs() < 1e-9, "pixel centres are one pixel apart");
    let backward = Band { normal: DVec2::NEG_X, ..across };
    assert_eq!(profile(Grid::new(&step, SIDE), &backward).width(), None, "the dark side is said");
}

#[test]
fn m1_band_between_two_points() {
    let band = Band::between(DVec2::new(10.0, 20.0), DVec2::new(30.0, 20.0), DVec2::new(0.0, 90.0), 7.0);
    assert_eq!((band.point, band.normal, band.half_length), (DVec2::new(20.0, 20.0), DVec2::Y, 10.0));
    assert_eq!(Band::between(DVec2::ZERO, DVec2::X, DVec2::NEG_Y, 1.0).normal, DVec2::NEG_Y);
}

#[test]
fn m2_m8_masks_and_means() {
    // A dark square in the middle of 12 × 12, with one acne pixel far away, one at its border, and one leak inside.
    let inside = |at: DVec2| at.cmpge(DVec2::splat(4.0)).all() && at.cmplt(DVec2::splat(9.0)).all();
    let truth = image(12, |at| f64::from(u8::from(inside(at))));
    let mut result = truth.clone();
    result[0] = 1.0;
    result[3 * 12 + 6] = 1.0;
    result[6 * 12 + 6] = 0.25;
    let mut facing = vec![0.5; 144];
    facing[11] = 0.04;
    let truth = Grid::new(&truth, 12);
    let lit = lit_mask(truth, &facing, 1, 0.05);
    assert_eq!(lit.iter().filter(|&&lit| lit).count(), 144 - 49 - 1);
    assert_eq!(false_shadow(&result, &lit), Some(1.0 / 94.0));
    let dark = dark_mask(truth, &facing, 2, 0.0);
    assert_eq!(dark.iter().filter(|&&dark| dark).count(), 1);
    assert_eq!(leak(&result, &dark), Some(0.75));
    assert_eq!(leak(&result, &dark_mask(truth, &facing, 9, 0.0)), None);
    assert_eq!(mean(&result, &[false; 144]), None);
}

#[test]
fn m3_of_waves_and_noise() {
    let wave = image(64, |at| 0.5 + 0.5 * (TAU * (5.0 * at.x + 3.0 * at.y) / 64.0).sin());
    let found = spectrum(Grid::new(&wave, 64));
    assert!((found.peak - 0.25 * 64.0 * 64.0).abs() < 1e-3, "half of amplitude times pixels: {}", found.peak);
    assert!(found.ratio() > 1e5);
    let key = Key::new(1, 0, 0);
    let noise = image(64, |at| f64::from(key.unit(at.x as u32 + 64 * at.y as u32, 0)));
    let ratio = spectrum(Grid::new(&noise, 64)).ratio();
    assert!((2.5..5.0).contains(&ratio), "{ratio}");
    let both: Vec<f32> = wave.iter().zip(&noise).map(|(wave, noise)| wave + 0.2 * noise).collect();
    assert!(spectrum(Grid::new(&both, 64)).ratio() > 10.0 * ratio);
    assert_eq!(spectrum(Grid::new(&[0.3; 100], 10)).ratio(), 0.0);
    assert_eq!(spectrum(Grid::new(&[], 10)).ratio(), 0.0);
    assert_eq!(spectrum(Grid::new(&[0.1, f32::NAN, 0.2, 0.3], 2)).ratio(), 0.0);
}

#[test]
fn m3_is_the_sum_it_says() {
    let key = Key::new(2, 0, 0);
    let (width, height) = (8, 4);
    let values: Vec<f32> = (0..width * height).map(|i| key.unit(i as u32, 0)).collect();
    let mean = values.iter().map(|&value| f64::from(value)).sum::<f64>() / values.len() as f64;
    let mut magnitudes = Vec::new();
    for term in 1..width * height {
        let (u, v) = ((term % width) as f64 / width as f64, (term / width) as f64 / height as f64);
        let sum = values.iter().enumerate().fold(DVec2::ZERO, |sum, (i, &value)| {
            let phase = -2.0 * PI * (u * (i % width) as f64 + v * (i / width) as f64);
            sum + DVec2::from_angle(phase) * (f64::from(value) - mean)
        });
        magnitudes.push(sum.length());
    }
    magnitudes.sort_by(f64::total_cmp);
    let found = spectrum(Grid::new(&values, width));
    assert!((found.peak - magnitudes[magnitudes.len() - 1]).abs() < 1e-9);
    assert!((found.median - magnitudes[magnitudes.len() / 2]).abs() < 1e-9);
}

#[test]
fn m5_levels() {
    let values = [0.0, -0.0, 0.5, 0.25, 0.5, 1.0, f32::NAN, f32::NAN];
    assert_eq!(distinct_levels(&values, &[true; 8]), 5);
    assert_eq!(distinct_levels(&values, &[true, true, false, false, false, false, false, false]), 1);
    let thirds = [0.0, 1.0 / 3.0, 2.0 / 3.0, 0.5];
    assert_eq!(levels_per_region(&thirds, 16), Some(4));
    assert_eq!(levels_per_region(&[0.0, 1.0], 16), Some(2));
    assert_eq!(levels_per_region(&[7.0 / 16.0], 16), Some(17));
    assert_eq!(levels_per_region(&[7.0 / 17.0], 16), None);
    assert_eq!(levels_per_region(&[1.5], 16), None);
    assert_eq!(levels_per_region(&[], 16), None);
}

#[test]
fn m6_rms_inside_the_penumbra() {
    let reference = [0.0, 0.25, 0.75, 1.0];
    let mask = penumbra_mask(&reference);
    assert_eq!(mask, [false, true, true, false]);
    assert_eq!(rms(&[9.0, 0.25, 0.25, 9.0], &reference, &mask), Some((0.25f64 / 2.0).sqrt()));
    assert_eq!(rms(&[0.0], &[1.0], &[false]), None);
}

#[test]
fn m7_contact_gap_along_a_line() {
    let soft = image(32, |at| ((at.x - 10.0) / 4.0 + 0.5).clamp(0.0, 1.0));
    let soft = Grid::new(&soft, 32);
    let gap = contact_gap(soft, DVec2::new(4.0, 16.0), DVec2::X * 3.0).unwrap();
    assert!((gap - 6.0).abs() < 0.01, "{gap}");
    let aslant = contact_gap(soft, DVec2::new(4.0, 16.0), DVec2::ONE).unwrap();
    assert!((aslant - 6.0 * 2f64.sqrt()).abs() < 0.02, "{aslant}");
    assert_eq!(contact_gap(soft, DVec2::new(20.0, 3.0), DVec2::Y), Some(0.0));
    assert_eq!(contact_gap(soft, DVec2::new(4.0, 3.0), DVec2::NEG_X), None);
    assert_eq!(contact_gap(soft, DVec2::new(-4.0, 3.0), DVec2::X), None);
    assert_eq!(contact_gap(soft, DVec2::new(4.0, 3.0), DVec2::ZERO), None);
}

#[test]
fn m9_shares_unions_and_centres() {
    let (a, b) = ([true, true, false, false], [true, false, true, false]);
    assert_eq!(share(&a, &b), Some(0.5));
    assert_eq!(share(&a, &[false; 4]), None);
    assert_eq!(iou(&a, &b), Some(1.0 / 3.0));
    assert_eq!(iou(&[false], &[false]), None);
    let disc = image(64, |at| (10.0 - at.distance(DVec2::new(30.25, 20.75)) + 0.5).clamp(0.0, 1.0));
    let centre = centroid(Grid::new(&disc, 64), &[true; 64 * 64]).unwrap();
    assert!(centre.distance(DVec2::new(30.25, 20.75)) < 0.02, "{centre}");
    assert_eq!(centroid(Grid::new(&disc, 64), &[false; 64 * 64]), None);
}

#[test]
fn w78_f5_contours_of_discs() {
    let disc = |radius: f64| {
        image(128, move |at| (0.5 + (radius - at.distance(DVec2::new(64.2, 63.7))) / 3.0).clamp(0.0, 1.0))
    };
    let (truth, small, large) = (disc(40.0), disc(38.5), disc(43.0));
    let (truth, small, large) = (Grid::new(&truth, 128), Grid::new(&small, 128), Grid::new(&large, 128));
    let length: f64 = contour(truth, 0.5).iter().map(|[a, b]| a.distance(*b)).sum();
    assert!((length / (TAU * 40.0) - 1.0).abs() < 0.002, "{length}");
    for (image, shift) in [(small, 1.5), (large, -3.0), (truth, 0.0)] {
        let found = contour_deviation(image, truth, 8.0).unwrap();
        assert!((found.mean - shift).abs() < 0.02 && (found.rms - shift.abs()).abs() < 0.02, "{found:?}");
    }
    assert_eq!(contour_deviation(large, truth, 1.0), None, "nothing that near");
    assert_eq!(contour_deviation(truth, Grid::new(&vec![0.0; 128 * 128], 128), f64::INFINITY), None);
}

#[test]
fn w78_f5_contours_are_found_however_far() {
    let left = image(128, |at| f64::from(u8::from(at.x < 3.0)));
    let right = image(128, |at| f64::from(u8::from(at.x < 120.0)));
    let found = contour_deviation(Grid::new(&left, 128), Grid::new(&right, 128), f64::INFINITY).unwrap();
    assert!((found.rms - 117.0).abs() < 1e-6 && (found.mean - 117.0).abs() < 1e-6);
}

#[test]
fn contours_of_saddles_and_gaps() {
    let saddle = [1.0, 0.0, 0.0, 1.0];
    assert_eq!(contour(Grid::new(&saddle, 2), 0.5).len(), 2);
    let at = |level| contour(Grid::new(&saddle, 2), level)[0];
    // The mean, ½, is on the dark side of a lower level: the light corners are cut off then, the dark ones otherwise.
    assert!(
        at(0.4).iter().all(|end| end.distance(DVec2::new(1.5, 0.5)) < 0.7 || end.distance(DVec2::new(0.5, 1.5)) < 0.7)
    );
    assert!(
        at(0.6).iter().all(|end| end.distance(DVec2::new(0.5, 0.5)) < 0.7 || end.distance(DVec2::new(1.5, 1.5)) < 0.7)
    );
    assert!(contour(Grid::new(&[1.0, 0.0, f32::NAN, 1.0], 2), 0.5).is_empty());
}

#[test]
fn w78_f5_lone_pixels() {
    let mut picture = image(16, |at| f64::from(u8::from(at.x > 8.0)));
    for (x, y) in [(3, 3), (12, 5), (0, 9), (5, 12), (6, 13)] {
        picture[y * 16 + x] = 1.0 - picture[y * 16 + x];
    }
    assert_eq!(lone_pixels(Grid::new(&picture, 16), &[true; 256]), 3, "two that touch at a corner are not alone");
    assert_eq!(lone_pixels(Grid::new(&picture, 16), &[false; 256]), 0);
    assert_eq!(lone_pixels(Grid::new(&[1.0], 1), &[true]), 0);
}

#[test]
fn r87_f10_edge_mask() {
    let step = image(16, |at| f64::from(u8::from(at.x > 8.0)));
    let near = edge_mask(Grid::new(&step, 16), 2);
    let columns: Vec<usize> = (0..16).filter(|&x| near[5 * 16 + x]).collect();
    assert_eq!(columns, [5, 6, 7, 8, 9, 10]);
    assert!(edge_mask(Grid::new(&[1.0; 4], 2), 2).iter().all(|&near| !near));
}

#[test]
fn r87_f7_f8_fits() {
    let line = linear_fit(&[(2.0, 2.9), (3.0, 3.7), (4.0, 4.5), (8.0, 7.7)]).unwrap();
    assert!((line.slope - 0.8).abs() < 1e-12 && (line.intercept - 1.3).abs() < 1e-12 && line.r2 > 1.0 - 1e-12);
    // The spec's measured noise of R87-F7.
    let noise = log_log_fit(&[(1.0, 0.383), (4.0, 0.135), (16.0, 0.049), (64.0, 0.018)]).unwrap();
    assert!((noise.slope + 0.735).abs() < 0.002, "{noise:?}");
    let scattered = linear_fit(&[(0.0, 0.0), (1.0, 1.0), (2.0, 0.0)]).unwrap();
    assert!(scattered.r2.abs() < 1e-12);
    assert_eq!(linear_fit(&[(1.0, 2.0), (1.0, 3.0)]), None);
    assert_eq!(linear_fit(&[(1.0, 2.0), (2.0, f64::NAN)]), None);
    assert_eq!(linear_fit(&[]), None);
    assert_eq!(log_log_fit(&[(1.0, 0.0), (2.0, 1.0)]), None);
    assert_eq!(linear_fit(&[(1.0, 2.0), (2.0, 2.0)]).unwrap().r2, 1.0);
}

#[test]
fn grids_are_total() {
    let values = [1.0, 2.0, 3.0, 4.0, 5.0];
    let grid = Grid::new(&values, 2);
    assert_eq!(grid.height(), 2);
    assert_eq!(grid.at(1, 1), 4.0);
    assert!(grid.at(2, 0).is_nan() && grid.at(0, 9).is_nan());
    assert_eq!(grid.window(1, 0, 9, 9), [2.0, 4.0]);
    assert_eq!(grid.between(DVec2::ONE), Some(2.5));
    assert_eq!(grid.between(DVec2::ZERO), Some(1.0));
    assert_eq!(grid.between(DVec2::splat(2.0)), None);
    assert_eq!(Grid::new(&values, 0).height(), 0);
    assert!(Grid::new(&values, 0).window(0, 0, 3, 3).is_empty());
}
