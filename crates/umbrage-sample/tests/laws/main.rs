//! The laws that every pattern obeys, each over every pattern (C-9, R87-11).

mod engines;
mod key;
mod table;
mod twins;
mod vectors;

use fearless_simd::{Level, Simd, dispatch};
use glam::{IVec2, Vec2};
use proptest::prelude::*;
use twins::Twin;
use umbrage_plane::Footprint;
use umbrage_sample::{
    AreaTent, Castano, Centre, Density, Disc, EveryTexel, Gaussian, InsideQuadReject, InsideQuadWarp, Jittered, Key,
    Pattern, Spiral, Table, Tap, Taps, Tent, Uniform, Vogel, each_tap, hammersley,
};

/// The one list. A new pattern is added here, and its twin in `twins`.
macro_rules! every_pattern {
    ($law:ident $(, $more:expr)*) => {
        $law("centre", &Centre $(, $more)*);
        $law("every texel", &EveryTexel $(, $more)*);
        $law("tent", &Tent $(, $more)*);
        $law("uniform", &Uniform::default() $(, $more)*);
        $law("uniform 37", &Uniform::default().with_num_samples(37) $(, $more)*);
        $law("gaussian", &Gaussian::default() $(, $more)*);
        $law("gaussian 3", &Gaussian::default().with_num_samples(3) $(, $more)*);
        let jittered = Jittered::default();
        $law("jittered", &jittered $(, $more)*);
        $law("jittered 100", &jittered.with_num_samples(100).with_min_samples(3) $(, $more)*);
        $law("jittered capped", &jittered.with_min_samples(2).with_hard_cap(true) $(, $more)*);
        $law("regular", &jittered.with_num_samples(25).with_jitter(0.0) $(, $more)*);
        $law("table", &Table::default() $(, $more)*);
        $law("table 100", &Table(jittered.with_num_samples(100).with_min_samples(3)) $(, $more)*);
        $law("inside, rejecting", &InsideQuadReject(jittered) $(, $more)*);
        $law("inside, rejecting 4", &InsideQuadReject(jittered.with_num_samples(4)) $(, $more)*);
        $law("inside, warping", &InsideQuadWarp(jittered) $(, $more)*);
        $law("disc", &Disc::default() $(, $more)*);
        let plain = Disc::default().with_num_samples(20).with_density(Density::Centred).with_rotate(false).with_half_offset(true);
        $law("disc, centred", &plain $(, $more)*);
        $law("castano 5", &Castano::Five $(, $more)*);
        $law("castano 7", &Castano::Seven $(, $more)*);
        $law("area tent", &AreaTent $(, $more)*);
        $law("vogel", &Vogel::default() $(, $more)*);
        $law("vogel 13", &Vogel::default().with_num_samples(13).with_rotate(false) $(, $more)*);
        $law("spiral", &Spiral::default() $(, $more)*);
        let centred = Spiral::default().with_num_samples(37).with_density(Density::Centred).with_rotate(false);
        $law("spiral, centred", &centred $(, $more)*);
    };
}

/// Batches as they came: first index, mask, and all sixteen taps.
type Batch = (u32, u32, [Tap; 16]);

fn batches<P: Pattern>(level: Level, pattern: &P, region: &Footprint, key: Key) -> Vec<Batch> {
    #[inline(always)]
    fn gather<S: Simd, P: Pattern>(simd: S, pattern: &P, region: &Footprint, key: Key) -> Vec<Batch> {
        let mut batches = Vec::new();
        pattern.taps(simd, region, key, |taps| {
            let tap = |i: usize| Tap { at: Vec2::new(taps.x[i], taps.y[i]), u: taps.u[i], weight: taps.weight[i] };
            batches.push((taps.first, taps.mask, std::array::from_fn(tap)));
        });
        batches
    }
    dispatch!(level, simd => gather(simd, pattern, region, key))
}

/// Index and tap of those that take part.
fn taps_at(level: Level, pattern: &impl Pattern, region: &Footprint, key: Key) -> Vec<(u32, Tap)> {
    let batches = batches(level, pattern, region, key);
    let present = |(first, mask, taps): Batch| {
        (0..16).filter(move |i| mask >> i & 1 == 1).map(move |i| (first + i, taps[i as usize]))
    };
    batches.into_iter().flat_map(present).collect()
}

fn taps(pattern: &impl Pattern, region: &Footprint, key: Key) -> Vec<Tap> {
    taps_at(Level::new(), pattern, region, key).into_iter().map(|(_, tap)| tap).collect()
}

/// Boxes and quadrilaterals of all sizes: points, lines, slivers, slanted, crossed, far away, across the map's corner.
fn regions() -> impl Strategy<Value = Footprint> {
    let centre = prop_oneof![
        (-3.0f32..3.0, -3.0f32..3.0),
        (0.0f32..4096.0, 0.0f32..4096.0),
        (-32_768.0f32..32_768.0, -32_768.0f32..32_768.0),
    ];
    let extent = || prop_oneof![Just(0.0f32), Just(1.5), Just(2.0), 0.0f32..1e-3, 0.0f32..4.0, 0.0f32..40.0];
    let corner = || (-6.0f32..6.0, -6.0f32..6.0);
    prop_oneof![
        (centre.clone(), extent(), extent())
            .prop_map(|(centre, a, b)| Footprint::boxed(centre.into(), Vec2::new(a, b))),
        (centre, [corner(), corner(), corner(), corner()], 0.0f32..1.0).prop_map(|(centre, corners, slant)| {
            let square = [Vec2::new(-5.0, -5.0), Vec2::new(5.0, -5.0), Vec2::new(5.0, 5.0), Vec2::new(-5.0, 5.0)];
            let corner = |k: usize| Vec2::from(centre) + square[k].lerp(corners[k].into(), slant);
            Footprint::around(std::array::from_fn(corner))
        }),
    ]
}

fn key(seed: u32) -> Key {
    Key::new(seed, 0, 0)
}

fn stays_inside(name: &str, pattern: &impl Pattern, region: &Footprint, key: Key) {
    let (low, high) = (region.centre - region.half, region.centre + region.half);
    let taps = taps(pattern, region, key);
    assert!(!taps.is_empty(), "{name}: no tap at all");
    for tap in taps {
        assert!(tap.at.cmpge(low).all() && tap.at.cmple(high).all(), "{name}: {} not in {low}..={high}", tap.at);
        assert!((0.0..1.0).contains(&tap.u), "{name}: u = {}", tap.u);
        assert!(tap.weight >= 0.0 && tap.weight.is_finite(), "{name}: weight {}", tap.weight);
    }
}

fn counts_in_order<P: Pattern>(name: &str, pattern: &P, region: &Footprint, key: Key) {
    let mut next = 0;
    for (first, mask, taps) in batches(Level::new(), pattern, region, key) {
        assert_eq!(first, next, "{name}: index of a batch's first tap");
        assert!(mask <= 0xFFFF, "{name}: mask {mask:#x}");
        assert!(pattern.weighted() || taps.iter().all(|tap| tap.weight == 1.0), "{name}: weights nobody reads");
        next += 16;
    }
}

fn equals_its_twin<P: Twin>(name: &str, pattern: &P, region: &Footprint, key: Key) {
    let bits = |(index, tap): (u32, Tap)| {
        [index, tap.at.x.to_bits(), tap.at.y.to_bits(), tap.u.to_bits(), tap.weight.to_bits()]
    };
    let naive: Vec<_> = pattern.naive(region, key).into_iter().map(bits).collect();
    for level in [Level::new(), Level::baseline()] {
        let found: Vec<_> = taps_at(level, pattern, region, key).into_iter().map(bits).collect();
        assert_eq!(found, naive, "{name} at {level:?} of {region:?}");
    }
}

fn is_keyed(name: &str, pattern: &impl Pattern, region: &Footprint, key: Key) {
    let first = taps(pattern, region, key);
    assert_eq!(first, taps(pattern, region, key), "{name}: the same key gave other taps");
    for other in [key.region(1), key.region(2)] {
        assert_ne!(first, taps(pattern, region, other), "{name}: another region's key gave the same taps");
    }
}

fn comes_one_by_one(name: &str, pattern: &impl Pattern, region: &Footprint, key: Key) {
    let mut single = Vec::new();
    each_tap(pattern, region, key, |tap| single.push(*tap));
    assert_eq!(single, taps(pattern, region, key), "{name}");
}

/// The rows of a pattern's window are its taps, in their order.
fn reads_its_window(name: &str, pattern: &impl Pattern, region: &Footprint, key: Key) {
    #[inline(always)]
    fn row<S: Simd>(simd: S, key: Key, first: u32, texel: IVec2, count: u32) -> Vec<(u32, Tap)> {
        let taps = Taps::in_row(simd, key, first, texel, count);
        assert_eq!(taps.mask.count_ones(), count);
        (0..16).filter(|i| taps.mask >> i & 1 == 1).map(|i| (taps.first + i, taps.tap(i as usize))).collect()
    }
    let Some(window) = pattern.window(region) else { return };
    for level in [Level::new(), Level::baseline()] {
        let mut rows = Vec::new();
        for y in window.min.y..window.max.y {
            for x in (window.min.x..window.max.x).step_by(16) {
                let (first, count) = (rows.len() as u32, (window.max.x - x).min(16) as u32);
                rows.extend(dispatch!(level, simd => row(simd, key, first, IVec2::new(x, y), count)));
            }
        }
        assert_eq!(rows, taps_at(level, pattern, region, key), "{name} of {region:?}");
    }
}

fn survives(name: &str, pattern: &impl Pattern, region: &Footprint) {
    let all = batches(Level::new(), pattern, region, key(0));
    let window = pattern.window(region);
    assert!(window.is_none_or(|window| window.size().max_element() <= 1 << 16), "{name}: {window:?}");
    assert!(!all.is_empty(), "{name} of {region:?}");
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(2000))]

    #[test]
    fn taps_stay_inside_the_region(region in regions(), seed: u32) {
        every_pattern!(stays_inside, &region, key(seed));
    }

    #[test]
    fn batches_are_numbered_in_order(region in regions(), seed: u32) {
        every_pattern!(counts_in_order, &region, key(seed));
    }

    #[test]
    fn sixteen_at_a_time_equals_one_at_a_time(region in regions(), seed: u32) {
        every_pattern!(equals_its_twin, &region, key(seed));
    }

    #[test]
    fn c_9_the_same_key_gives_the_same_taps_and_no_other_does(region in regions(), seed: u32) {
        every_pattern!(is_keyed, &region, key(seed));
    }

    #[test]
    fn single_taps_are_those_of_the_batches(region in regions(), seed: u32) {
        every_pattern!(comes_one_by_one, &region, key(seed));
    }

    #[test]
    fn a_window_has_the_taps_of_its_region(region in regions(), seed: u32) {
        every_pattern!(reads_its_window, &region, key(seed));
        // Half-extents of one texel and more reach at least two rows and columns of centres.
        let wide = region.half.cmpge(Vec2::ONE).all();
        prop_assert!(!wide || EveryTexel.window(&region).is_some(), "no window");
    }

    #[test]
    fn r87_13_counts_follow_the_definition(a in 0.0f32..60.0, b in 0.0f32..60.0, n in 1u32..300, m in 1u32..6, hard_cap: bool) {
        let pattern = Jittered::default().with_num_samples(n).with_min_samples(m.min(n)).with_hard_cap(hard_cap);
        let counts = pattern.counts(Vec2::new(a, b));
        prop_assert_eq!((counts.x, counts.y), twins::counts(&pattern, Vec2::new(a, b)));
        prop_assert!(counts.min_element() >= 1);
        prop_assert!(!hard_cap || counts.element_product() <= n, "{} taps of {}", counts.element_product(), n);
        prop_assert!(hard_cap || counts.min_element() >= m.min(n));
        prop_assert!(counts.element_product() <= n * pattern.min_samples.max(2));
    }

    /// Each cell of the grid holds exactly its own tap.
    #[test]
    fn r87_11_jittered_is_stratified(a in 0.1f32..40.0, b in 0.1f32..40.0, n in 1u32..200, seed: u32) {
        let pattern = Jittered::default().with_num_samples(n);
        let region = Footprint::boxed(Vec2::new(70.3, 99.9), Vec2::new(a, b));
        let counts = pattern.counts(region.half);
        let cell = 2.0 * region.half / counts.as_vec2();
        let all = taps(&pattern, &region, key(seed));
        prop_assert_eq!(all.len() as u32, counts.element_product());
        for (tap, k) in all.iter().zip(0..) {
            let middle = region.centre - region.half + (Vec2::new((k % counts.x) as f32, (k / counts.x) as f32) + 0.5) * cell;
            let away = (tap.at - middle).abs();
            prop_assert!(away.cmple(0.5 * cell + 2e-5).all(), "tap {} is {} from the middle of its cell {}", k, away, cell);
        }
    }
}

#[test]
fn regions_that_are_no_regions_are_survived() {
    for bad in [f32::NAN, f32::INFINITY, f32::NEG_INFINITY, -1.0, f32::MAX] {
        for good in [0.0, 7.5] {
            for region in [
                Footprint::boxed(Vec2::new(bad, good), Vec2::splat(2.0)),
                Footprint {
                    half: Vec2::new(2.0, if bad.abs() > 1.0 { f32::NAN } else { bad }),
                    ..Footprint::point(Vec2::splat(good))
                },
                Footprint { corners: [Vec2::new(good, bad); 4], ..Footprint::boxed(Vec2::ZERO, Vec2::ONE) },
            ] {
                every_pattern!(survives, &region);
            }
        }
    }
}

/// Every box of 2⁻ᵏ × 2ᵏ⁻ᵐ holds exactly one of 2ᵐ points.
#[test]
fn b06_7_hammersley_points_fill_every_elementary_interval() {
    for m in 0..=10u32 {
        let n = 1 << m;
        for k in 0..=m {
            let (columns, rows) = (1 << k, 1 << (m - k));
            let mut held = vec![0; n as usize];
            for point in (0..n).map(|i| hammersley(i, n)) {
                let (column, row) = ((point.x * columns as f32) as usize, (point.y * rows as f32) as usize);
                held[row * columns as usize + column] += 1;
            }
            assert!(held.iter().all(|&points| points == 1), "{columns} x {rows} boxes of {n} points");
        }
    }
}

/// The weighted mean of all taps over many keys, and the number of keys that it takes for a deviation of `sigma` texels.
fn mean(pattern: &impl Pattern, region: &Footprint, keys: u32) -> Vec2 {
    let (mut sum, mut weight) = (Vec2::ZERO, 0.0);
    for k in 0..keys {
        each_tap(pattern, region, key(99).region(k), |tap| {
            sum += (tap.at - region.centre) * tap.weight;
            weight += tap.weight;
        });
    }
    region.centre + sum / weight
}

/// One tap deviates by less than a half-extent; patterns are symmetric; so means over 4,000 keys stay within 4·half/√4000.
#[test]
fn taps_are_centred_on_the_region() {
    let region = Footprint::boxed(Vec2::new(20.5, 31.5), Vec2::new(3.5, 1.5));
    let within = region.half * (4.0 / 4000f32.sqrt());
    let check = |name: &str, found: Vec2| {
        assert!((found - region.centre).abs().cmple(within).all(), "{name}: mean {found} ± {within}");
    };
    check("centre", mean(&Centre, &region, 1));
    check("every texel", mean(&EveryTexel, &region, 1));
    check("tent", mean(&Tent, &region, 1));
    check("uniform", mean(&Uniform::default(), &region, 4000));
    check("gaussian", mean(&Gaussian::default(), &region, 4000));
    check("jittered", mean(&Jittered::default(), &region, 4000));
    check("table", mean(&Table::default(), &region, 4000));
    check("inside, rejecting", mean(&InsideQuadReject::default(), &region, 4000));
    check("inside, warping", mean(&InsideQuadWarp::default(), &region, 4000));
    check("disc", mean(&Disc::default(), &region, 4000));
    check("castano 5", mean(&Castano::Five, &region, 1));
    check("castano 7", mean(&Castano::Seven, &region, 1));
    check("area tent", mean(&AreaTent, &region, 1));
    check("vogel", mean(&Vogel::default(), &region, 4000));
    check("spiral", mean(&Spiral::default(), &region, 4000));
}

/// Both methods of sampling inside the boundary weigh area alike: their mean is the quadrilateral's centroid.
#[test]
fn r87_11_inside_patterns_find_the_centroid() {
    let corners = [Vec2::new(10.0, 10.0), Vec2::new(22.0, 13.0), Vec2::new(17.0, 20.0), Vec2::new(9.0, 16.0)];
    let [a, b, c, d] = corners;
    let (abc, acd) = ((b - a).perp_dot(c - a), (c - a).perp_dot(d - a));
    let centroid = ((a + b + c) * abc + (a + c + d) * acd) / (3.0 * (abc + acd));
    let region = Footprint::around(corners);
    assert!((region.centre - centroid).length() > 0.3, "the case must tell the box from the quadrilateral");
    let within = region.half * (4.0 / 20_000f32.sqrt());
    let jittered = Jittered::default();
    for (name, found) in [
        ("rejecting", mean(&InsideQuadReject(jittered), &region, 20_000)),
        ("warping", mean(&InsideQuadWarp(jittered), &region, 20_000)),
    ] {
        assert!((found - centroid).abs().cmple(within).all(), "{name}: {found}, want {centroid} ± {within}");
    }
}
