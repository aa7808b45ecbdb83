//! The kernels of engines, as their shaders make them of bilinear comparisons, held against the patterns that stand for them.

use glam::Vec2;
use proptest::prelude::*;
use std::collections::BTreeMap;
use umbrage_plane::Footprint;
use umbrage_sample::{AreaTent, Castano, Density, Key, Pattern, Spiral, Tent, Vogel, each_tap};

/// Texels by column and row, each with its share of all weight.
type Kernel = BTreeMap<(i64, i64), f64>;

/// A pattern over a square region, as shares of texels.
fn of(pattern: &impl Pattern, centre: Vec2, half: f32, key: Key) -> Kernel {
    let mut kernel = Kernel::new();
    each_tap(pattern, &Footprint::boxed(centre, Vec2::splat(half)), key, |tap| {
        let texel = tap.at.floor().as_i64vec2();
        *kernel.entry((texel.x, texel.y)).or_default() += f64::from(tap.weight);
    });
    shares(kernel)
}

fn shares(kernel: Kernel) -> Kernel {
    let all: f64 = kernel.values().sum();
    kernel.into_iter().map(|(texel, weight)| (texel, weight / all)).collect()
}

/// Bilinear comparisons, each at a place in texels with a weight, as shares of the texels that they read.
fn comparisons(all: impl IntoIterator<Item = (f64, f64, f64)>) -> Kernel {
    let mut kernel = Kernel::new();
    for (x, y, weight) in all {
        let (left, top) = ((x - 0.5).floor(), (y - 0.5).floor());
        let (right, below) = (x - 0.5 - left, y - 0.5 - top);
        for (column, across) in [(0, 1.0 - right), (1, right)] {
            for (row, down) in [(0, 1.0 - below), (1, below)] {
                *kernel.entry((left as i64 + column, top as i64 + row)).or_default() += weight * across * down;
            }
        }
    }
    shares(kernel)
}

/// The same of comparisons that are a product of those along both axes, from a place on each: offsets and weights.
fn product(at: Vec2, axis: impl Fn(f64) -> Vec<(f64, f64)>) -> Kernel {
    let [across, down] = [at.x, at.y].map(|at| axis(f64::from(at)));
    let pairs = across.iter().flat_map(|x| down.iter().map(move |y| (x.0, y.0, x.1 * y.1)));
    comparisons(pairs.collect::<Vec<_>>())
}

fn alike(name: &str, found: &Kernel, wanted: &Kernel) {
    for texel in found.keys().chain(wanted.keys()) {
        let [found, wanted] = [found, wanted].map(|kernel| kernel.get(texel).copied().unwrap_or(0.0));
        assert!((found - wanted).abs() < 3e-6, "{name}, texel {texel:?}: {found} instead of {wanted}");
    }
}

/// Castaño 2013, as Filament (`ShadowSample_PCF_Low`), Babylon.js (`computeShadowWithPCF3`, `computeShadowWithPCF5`) and Bevy
/// (`sample_shadow_map_castano_thirteen`) have it: weights and offsets by the place s within a texel, from the centre of the texel before.
fn castano(size: u32, at: f64) -> Vec<(f64, f64)> {
    let base = (at + 0.5).floor();
    let s = at + 0.5 - base;
    let weighted: Vec<(f64, f64)> = match size {
        3 => {
            let (first, second) = (3.0 - 2.0 * s, 1.0 + 2.0 * s);
            vec![((2.0 - s) / first - 1.0, first), (s / second + 1.0, second)]
        }
        5 => {
            let (first, last) = (4.0 - 3.0 * s, 1.0 + 3.0 * s);
            vec![((3.0 - 2.0 * s) / first - 2.0, first), ((3.0 + s) / 7.0, 7.0), (s / last + 2.0, last)]
        }
        _ => {
            let [a, b, c, d] = [5.0 * s - 6.0, 11.0 * s - 28.0, -(11.0 * s + 17.0), -(5.0 * s + 1.0)];
            let offsets =
                [(4.0 * s - 5.0) / a - 3.0, (4.0 * s - 16.0) / b - 1.0, -(7.0 * s + 5.0) / c + 1.0, -s / d + 3.0];
            offsets.into_iter().zip([a, b, c, d]).collect()
        }
    };
    weighted.into_iter().map(|(offset, weight)| (base - 0.5 + offset, weight)).collect()
}

/// The area of an isosceles triangle with a base of `size` texels and a slope of 45° over each texel, by its definition: added up in small steps.
fn triangle(size: u32, at: Vec2) -> Kernel {
    let half = f64::from(size) * 0.5;
    let axis = |at: f64| {
        let steps = 2000;
        let first = (at - half).floor() as i64;
        (first..=(at + half).floor() as i64).map(move |texel| {
            let height = |step: i32| half - (texel as f64 + (f64::from(step) + 0.5) / f64::from(steps) - at).abs();
            (texel, (0..steps).map(|step| height(step).max(0.0)).sum::<f64>())
        })
    };
    let [across, down] = [at.x, at.y].map(|at| axis(f64::from(at)).collect::<Vec<_>>());
    let pairs = across.iter().flat_map(|x| down.iter().map(move |y| ((x.0, y.0), x.1 * y.1)));
    shares(pairs.collect())
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(300))]

    #[test]
    fn one_bilinear_comparison_is_a_tent_of_one_texel(x in 100.0f32..102.0, y in 50.0f32..52.0) {
        let wanted = comparisons([(f64::from(x), f64::from(y), 1.0)]);
        alike("2 x 2", &of(&Tent, Vec2::new(x, y), 1.0, Key::new(0, 0, 0)), &wanted);
    }

    #[test]
    fn castanos_comparisons_are_a_tent_and_two_bells(x in 100.0f32..102.0, y in 50.0f32..52.0) {
        let (at, key) = (Vec2::new(x, y), Key::new(0, 0, 0));
        alike("3 x 3", &of(&Tent, at, 2.0, key), &product(at, |at| castano(3, at)));
        alike("5 x 5", &of(&Castano::Five, at, 3.0, key), &product(at, |at| castano(5, at)));
        alike("7 x 7", &of(&Castano::Seven, at, 4.0, key), &product(at, |at| castano(7, at)));
    }

    #[test]
    fn unitys_tents_are_areas_of_a_triangle(x in 100.0f32..102.0, y in 50.0f32..52.0) {
        let at = Vec2::new(x, y);
        for (size, half) in [(3, 2.0), (5, 3.0), (7, 4.0)] {
            alike("a tent", &of(&AreaTent, at, half, Key::new(0, 0, 0)), &triangle(size, at));
        }
    }

    /// `vogelDiskSample` of three.js and `get_vogel_disk` of Godot, both turned by the same angle as the pattern.
    #[test]
    fn discs_of_three_and_godot_are_bilinear_comparisons_on_vogels_disc(x in 100.0f32..102.0, y in 50.0f32..52.0, seed: u32) {
        let key = Key::new(seed, 0, 0);
        let turn = f64::from(key.unit(0, 0)) * std::f64::consts::TAU;
        for (n, radius, golden, most) in [(5, 1.0, 2.399_963_229_728_653, 3e-6), (4, 2.0, 2.4, 3e-4)] {
            let sample = |k: u32| {
                let (r, angle) = (((f64::from(k) + 0.5) / f64::from(n)).sqrt() * radius, f64::from(k) * golden + turn);
                (f64::from(x) + r * angle.cos(), f64::from(y) + r * angle.sin(), 1.0)
            };
            let wanted = comparisons((0..n).map(sample));
            let found = of(&Vogel::default().with_num_samples(n), Vec2::new(x, y), radius as f32 + 1.0, key);
            for texel in found.keys().chain(wanted.keys()) {
                let [found, wanted] = [&found, &wanted].map(|kernel| kernel.get(texel).copied().unwrap_or(0.0));
                prop_assert!((found - wanted).abs() < most + 2e-5, "{} samples, texel {:?}: {} instead of {}", n, texel, found, wanted);
            }
        }
    }
}

/// `ComputeFibonacciSpiralDiskSample` and `ComputeFibonacciSpiralDiskSampleClumped_Directional` of Unity's HDRP (`HDPCSS.hlsl`), whose table of 64 directions is
/// (cos θ, sin θ) of i·π(3 − √5): some of it as it is printed there.
#[test]
fn hdrp_s_spirals_have_the_directions_of_its_table() {
    let printed = [
        (0, 1.0, 0.0),
        (1, -0.737_368_878_078_319_7, 0.675_490_294_261_523_8),
        (2, 0.087_425_724_716_959_88, -0.996_171_040_864_827_8),
        (23, 0.219_481_369_246_378_65, -0.975_616_691_407_919_1),
        (63, 0.920_578_930_215_781_7, 0.390_556_568_556_677_7),
    ];
    for (density, sample) in
        [(Density::Uniform, (|i, n| (i / n + 0.5 / n).sqrt()) as fn(f64, f64) -> f64), (Density::Centred, |i, n| i / n)]
    {
        let spiral = Spiral::default().with_num_samples(64).with_density(density).with_rotate(false);
        let mut taps = Vec::new();
        let region = Footprint::boxed(Vec2::ZERO, Vec2::splat(1.0));
        each_tap(&spiral, &region, Key::new(0, 0, 0), |tap| taps.push(tap.at.as_dvec2()));
        assert_eq!(taps.len(), 64);
        for (i, x, y) in printed {
            let radius = sample(i as f64, 64.0);
            let wanted = glam::DVec2::new(x, y) * radius;
            assert!(taps[i].abs_diff_eq(wanted, 5e-5), "{density:?}, {i}: {} instead of {wanted}", taps[i]);
        }
    }
}

#[test]
fn whole_distances_have_castanos_whole_numbers() {
    for (pattern, half, wanted) in [
        (Castano::Five, 3.0, &[1.0, 3.0, 4.0, 3.0, 1.0][..]),
        (Castano::Seven, 4.0, &[1.0, 5.0, 12.0, 16.0, 12.0, 5.0, 1.0]),
    ] {
        let kernel = of(&pattern, Vec2::splat(20.5), half, Key::new(0, 0, 0));
        let all: f64 = wanted.iter().sum();
        let first = 20 - wanted.len() as i64 / 2;
        for (column, across) in wanted.iter().enumerate() {
            let row: f64 =
                kernel.iter().filter(|(texel, _)| texel.0 == first + column as i64).map(|(_, share)| share).sum();
            assert!((row - across / all).abs() < 1e-6, "{pattern:?}, column {column}: {row}");
        }
    }
}
