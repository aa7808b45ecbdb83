//! Laws of batches, threads and counters.

use super::places::lamp;
use super::subject::{Found, KEY, Subject, check, same};
use glam::Vec2;
use rayon::prelude::*;
use umbrage_depth::{Map, Raw, Storage};
use umbrage_plane::{Rules, SurfacePoint};

/// A map of blocks at three depths with holes, and points before, between and behind them, inside and outside.
fn scene() -> (Map, Vec<SurfacePoint>) {
    let view = lamp(Rules::SPOT).with_cone(Some(0.26_f64.atan().cos())).expect("a cone");
    let block = |i: u32| (i / 64 / 16) * 4 + i % 64 / 16;
    let stored = |i: u32| [4.0, 9.0, 14.0, f32::INFINITY][(KEY.bits(block(i), 3) % 4) as usize];
    let map = Raw::new(view, (0..64 * 64).map(stored).collect()).expect("a map");
    let point = |i: u32| {
        let texel = Vec2::new(KEY.unit(i, 0), KEY.unit(i, 1)) * 80.0 - 8.0;
        let zeta = 2.0 + 16.0 * f64::from(KEY.unit(i, 2));
        SurfacePoint { region: i, ..super::places::point(&view, texel, zeta, KEY.unit(i, 4) * 3.0) }
    };
    (map.into(), (0..500).map(point).collect())
}

pub fn counts(subject: &Subject) -> Found {
    let (map, points) = scene();
    for storage in [Storage::Raw, Storage::Tiled] {
        let map = map.clone().kept(storage);
        let (mut plain, mut watched) = (vec![f32::NAN; points.len()], vec![f32::NAN; points.len()]);
        subject.over(&map).fractions(&points, KEY, &mut plain);
        let counted = subject.counted(&map, &points, &mut watched);
        for (i, (plain, watched)) in plain.iter().zip(&watched).enumerate() {
            same("point", i, &[*plain, *watched])?;
        }
        let answered = counted.placed + counted.culled_lit + counted.culled_dark + counted.sampled;
        check(answered == points.len() as u64, || format!("{answered} of {} answers counted", points.len()))?;
        check(counted.lookups >= counted.sampled && counted.sampled > 0, || format!("{counted:?}"))?;
    }
    Ok(())
}

pub fn explained(subject: &Subject) -> Found {
    let (map, points) = scene();
    let shadow = subject.over(&map.kept(Storage::Tiled));
    for (i, point) in points.iter().step_by(5).enumerate() {
        let explained = shadow.explain(point, KEY);
        check(explained.len() == 1, || format!("point {i}: {} explanations of one map", explained.len()))?;
        same("point", i, &[shadow.fraction(point, KEY), explained[0].fraction])?;
        for tap in explained[0].questions.iter().flat_map(|question| &question.taps) {
            let by_rule = tap.ruled.is_none_or(|dark| dark == tap.dark);
            check(by_rule && (0.0..=1.0).contains(&tap.dark) && tap.weight >= 0.0, || format!("point {i}: {tap:?}"))?;
        }
    }
    Ok(())
}

pub fn splits(subject: &Subject) -> Found {
    let (map, points) = scene();
    let shadow = subject.over(&map.kept(Storage::Tiled));
    let mut whole = vec![f32::NAN; points.len()];
    shadow.fractions(&points, KEY, &mut whole);
    for part in [1, 7, 256] {
        let mut parts = vec![f32::NAN; points.len()];
        let pairs = points.par_chunks(part).zip(parts.par_chunks_mut(part));
        pairs.for_each(|(points, out)| shadow.fractions(points, KEY, out));
        for (i, (whole, part)) in whole.iter().zip(&parts).enumerate() {
            same("point", i, &[*whole, *part])?;
        }
    }
    Ok(())
}
