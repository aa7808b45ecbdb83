//! Laws of deep maps.

use super::places::{flat, lamp, point};
use super::subject::{Found, KEY, Subject, check, same};
use glam::{Vec2, Vec3};
use umbrage_depth::{DeepMap, Map, Raw, Step};
use umbrage_plane::{Rules, SurfacePoint};

/// The same surfaces over every texel.
fn deep(steps: &[Step]) -> Map {
    let view = lamp(Rules::OPEN);
    let texels = view.size().element_product() as usize;
    DeepMap::new(view, 0.0, std::iter::repeat_n(steps.to_vec(), texels)).expect("a deep map").into()
}

fn step(depth: f32, passes: impl Into<Vec3>) -> Step {
    Step { depth, passes: passes.into() }
}

/// Points well inside the map, at an axial distance of 10.
fn points() -> impl Iterator<Item = SurfacePoint> {
    (0..60).map(|i| {
        let texel = Vec2::new(KEY.unit(i, 0), KEY.unit(i, 1)) * 16.0 + 24.0;
        SurfacePoint { region: i, ..point(&lamp(Rules::OPEN), texel, 10.0, KEY.unit(i, 2) * 2.0) }
    })
}

/// Whatever is stored, holes included.
pub fn opaque(subject: &Subject) -> Found {
    let view = lamp(Rules::OPEN);
    let texels = view.size().element_product();
    let stored = |i: u32| [3.0, 9.0, 12.0, f32::INFINITY][(KEY.bits(i / 5, 3) % 4) as usize];
    let plain: Map = Raw::new(view, (0..texels).map(stored).collect()).expect("a map").into();
    let steps = |i| (stored(i) < f32::INFINITY).then(|| step(stored(i), Vec3::ZERO)).into_iter().collect();
    let deep: Map = DeepMap::new(view, 0.0, (0..texels).map(steps)).expect("a deep map").into();
    let (plain, deep) = (subject.over(&plain), subject.over(&deep));
    for (i, at) in points().enumerate() {
        same("plain and deep at point", i, &[plain.fraction(&at, KEY), deep.fraction(&at, KEY)])?;
    }
    Ok(())
}

/// Before the receiver, behind it, before a wall behind it, and without effect.
pub fn veil(subject: &Subject) -> Found {
    let red = Vec3::new(0.9, 0.3, 0.0);
    let cases = [
        (vec![step(3.0, Vec3::splat(0.25))], Vec3::splat(0.25)),
        (vec![step(3.0, Vec3::splat(0.5)), step(4.0, Vec3::splat(0.125))], Vec3::splat(0.125)),
        (vec![step(3.0, Vec3::ONE)], Vec3::ONE),
        (vec![step(3.0, Vec3::splat(0.5)), step(4.0, Vec3::ZERO)], Vec3::ZERO),
        (vec![step(3.0, red)], red),
    ];
    for (steps, wanted) in cases {
        let shadow = subject.over(&deep(&steps));
        for at in points().take(20) {
            let (mut dark, mut passes) = ([f32::NAN], [Vec3::NAN]);
            shadow.fractions(&[at], KEY, &mut dark);
            shadow.transmittances(&[at], KEY, &dark, &mut passes);
            let mean = 1.0 - wanted.element_sum() / 3.0;
            check((dark[0] - mean).abs() < 2e-6, || format!("{} instead of {mean} behind {steps:?}", dark[0]))?;
            check(passes[0].abs_diff_eq(wanted, 2e-6), || format!("{} passes {steps:?}", passes[0]))?;
        }
    }
    let behind = subject.over(&deep(&[step(30.0, Vec3::splat(0.5))]));
    let plain = subject.over(&flat(&lamp(Rules::OPEN), 30.0));
    for at in points().take(20) {
        let (deep, plain) = (behind.fraction(&at, KEY), plain.fraction(&at, KEY));
        check(deep == 0.0 && plain == 0.0, || format!("{deep} and {plain} before a surface"))?;
    }
    Ok(())
}
