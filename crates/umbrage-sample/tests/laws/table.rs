//! What a table of numbers may change of the jittered pattern: which taps the region has, not how they are spread over many regions.

use glam::Vec2;
use umbrage_plane::Footprint;
use umbrage_sample::{Jittered, Key, Pattern, Table, each_tap};

const REGIONS: u32 = 60_000;

/// Mean and variance over many regions of the fraction of taps for which something holds.
fn spread(pattern: &impl Pattern, region: &Footprint, holds: impl Fn(Vec2, f32) -> bool) -> (f64, f64) {
    let (mut sum, mut squares) = (0.0, 0.0);
    for k in 0..REGIONS {
        let (mut taps, mut held) = (0.0, 0.0);
        each_tap(pattern, region, Key::new(5, 0, 0).region(k), |tap| {
            taps += 1.0;
            held += f64::from(u8::from(holds(tap.at - region.centre, tap.u)));
        });
        sum += held / taps;
        squares += (held / taps).powi(2);
    }
    let mean = sum / f64::from(REGIONS);
    (mean, squares / f64::from(REGIONS) - mean * mean)
}

/// Edges in sixteen directions at several distances from the centre, and biases by `u` alone: means are within 10⁻³, variances within 15 %.
#[test]
fn a_table_spreads_taps_as_hashes_do() {
    let region = Footprint::boxed(Vec2::new(40.2, 17.7), Vec2::splat(3.0));
    let (mut least, mut most) = (f64::INFINITY, 0.0f64);
    let mut check = |name: String, holds: &dyn Fn(Vec2, f32) -> bool| {
        let [(mean, variance), (other, others)] =
            [spread(&Table::default(), &region, holds), spread(&Jittered::default(), &region, holds)];
        assert!((mean - other).abs() < 1e-3, "{name}: mean {mean}, by hashes {other}");
        assert!(others > 1e-4, "{name}: nothing varies");
        (least, most) = (least.min(variance / others), most.max(variance / others));
        assert!((0.85..1.15).contains(&(variance / others)), "{name}: variance {variance}, by hashes {others}");
    };
    for direction in 0..16u8 {
        let across = Vec2::from_angle(f32::from(direction) * std::f32::consts::TAU / 16.0 + 0.1);
        for away in [0.0, 0.9, 1.7] {
            check(format!("edge {direction} at {away}"), &|at, _| at.dot(across) > away);
        }
    }
    for level in [0.1, 0.5, 0.75] {
        check(format!("u above {level}"), &|_, u| u > level);
    }
    check("place and u".into(), &|at, u| at.x > 3.0 - 6.0 * u);
    println!("variances are {least:.3} to {most:.3} of those by hashes");
}
