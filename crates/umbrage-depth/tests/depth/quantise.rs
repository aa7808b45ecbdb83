//! Integer depth as Williams kept it: V46b and W78-6.

use glam::{DVec3, UVec2};
use proptest::prelude::*;
use umbrage_depth::{Raw, bandlimit, quantise, quantum};
use umbrage_plane::{Kind, View};

fn screen(depths: &[f32]) -> Raw {
    let size = UVec2::new(depths.len() as u32, 1);
    let view = View::orthographic(DVec3::Y, DVec3::ZERO, DVec3::X, 1.0, 0.0, 100.0, size).unwrap();
    Raw::new(view.with_kind(Kind::Screen), depths.to_vec()).unwrap()
}

#[test]
fn v46b_codes_of_sixteen_bits() {
    for (z, code) in [(0.0, 0), (0.5, 32_768), (1.0, 65_535), (0.123_456, 8091), (-3.0, 0), (7.0, 65_535)] {
        assert_eq!(quantum(z, 16), code, "z_s {z}");
    }
    assert_eq!((quantum(f64::INFINITY, 16), quantum(f64::NAN, 16)), (65_535, 0));
    assert_eq!((quantum(1.0, 8), quantum(1.0, 24)), (255, 16_777_215));
    assert_eq!((quantum(1.0, 3), quantum(1.0, 40)), (255, 16_777_215));
}

#[test]
fn w78_6_the_top_code_is_nothing_unless_faithful() {
    let map = screen(&[0.0, 0.5, 0.999_99, 1.0, f32::INFINITY, -0.25]);
    let half = (32_768.0 / 65_535.0f64) as f32;
    let below = (65_534.0 / 65_535.0f64) as f32;
    let inf = f32::INFINITY;
    assert_eq!(quantise(&map, 16, false).depths(), [0.0, half, below, inf, inf, 0.0]);
    assert_eq!(quantise(&map, 16, true).depths(), [0.0, half, below, 1.0, 1.0, 0.0]);
}

#[test]
#[should_panic(expected = "kind of a map to be quantised")]
fn w78_6_only_screen_depth_has_a_fixed_range_c_4() {
    let map = screen(&[0.5]);
    let axial = Raw::new(umbrage_depth::DepthMap::view(&map).with_kind(Kind::Axial), vec![0.5]).unwrap();
    let _ = quantise(&axial, 16, false);
}

proptest! {
    /// Rounding moves a depth by half a quantum at most, keeps order, and does nothing the second time.
    #[test]
    fn w78_6_rounding_is_close_ordered_and_final(a in 0.0f32..=1.0, b in 0.0f32..=1.0, bits in 8u32..=24) {
        let once = quantise(&screen(&[a.min(b), a.max(b)]), bits, true);
        let [low, high] = *once.depths() else { unreachable!() };
        prop_assert!(low <= high);
        let quantum = 1.0 / f64::from((1u32 << bits) - 1);
        prop_assert!((f64::from(low) - f64::from(a.min(b))).abs() <= 0.5 * quantum + 3e-8);
        prop_assert_eq!(&quantise(&once, bits, true), &once);
    }
}

#[test]
fn w78_21_a_bandlimited_depth_is_the_depth_of_no_surface() {
    let inf = f32::INFINITY;
    let map = screen(&[0.25, 0.25, 0.75, 0.75, inf, 0.5]);
    assert_eq!(bandlimit(&map, 0).depths(), map.depths());
    let third = |a: f64, b: f64, c: f64| ((a + b + c) / 3.0) as f32;
    let wanted = [0.25, third(0.25, 0.25, 0.75), third(0.25, 0.75, 0.75), 0.75, inf, 0.5];
    assert_eq!(bandlimit(&map, 1).depths(), wanted);
}
