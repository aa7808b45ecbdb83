//! Pass 2: the look-ups of a whole picture, 1024² regions of three texels to each side, and the listing of 1987 beside them.
//!
//! Ids: `pass2/<filter>/<storage>/<from>/<texels per side>`, elements are receivers. *From* is `world` with the way into the light's
//! space, and `light` without it. One thread.
use criterion::{BenchmarkId, Criterion, Throughput, criterion_group, criterion_main};
use std::hint::black_box;
use umbrage_bench::look_ups::{all, mean};
use umbrage_bench::peers::listing;
use umbrage_bench::raster::first;
use umbrage_bench::scene::{HALF, Scene, Segments, bias};
use umbrage_depth::Raw;
use umbrage_plane::Place;

fn picture(criterion: &mut Criterion) {
    let scene = Scene::new(Segments::MEDIUM, 1024);
    let points = &scene.points;
    for side in [1024, 4096] {
        let view = Scene::view(side);
        let receivers = scene.receivers(&view);
        let mut group = criterion.benchmark_group("pass2");
        group.sample_size(10).throughput(Throughput::Elements(points.len() as u64));

        let places = listing::places(&receivers, side);
        let map = Raw::copy_of(&first(&view, &scene.mesh).map);
        let mut out = vec![f32::NAN; points.len()];
        listing::fractions(&map, &places, HALF, bias(&view), &mut out);
        listing::assert_as_printed(&map, &places, HALF, bias(&view), &out);
        let dark = mean(&out);
        group.bench_function(BenchmarkId::new("listing/raw/light", side), |bencher| {
            bencher.iter(|| listing::fractions(&map, black_box(&places), HALF, bias(&view), &mut out));
        });
        let mut seen = vec![Err(Place::Behind); points.len()];
        view.receivers(points, &mut seen);
        assert!(seen.iter().zip(&receivers).all(|(seen, receiver)| *seen == Ok(*receiver)), "the same receivers");
        group.bench_function(BenchmarkId::new("transform", side), |bencher| {
            bencher.iter(|| view.receivers(black_box(points), &mut seen));
        });
        let mut other = vec![f32::NAN; points.len()];
        for look_up in all(&scene, &view) {
            look_up.of_points(points, &mut out);
            look_up.of_receivers(&receivers, &mut other);
            assert_eq!(out, other, "{look_up:?} from both spaces");
            let found = mean(&out);
            assert!((found - dark).abs() < 0.03, "{look_up:?} finds {found} in shadow, the listing {dark}");
            let id = |from| BenchmarkId::new(format!("{}/{}/{from}", look_up.filter, look_up.storage), side);
            group.bench_function(id("world"), |bencher| {
                bencher.iter(|| look_up.of_points(black_box(points), &mut out));
            });
            group.bench_function(id("light"), |bencher| {
                bencher.iter(|| look_up.of_receivers(black_box(&receivers), &mut out));
            });
        }
        group.finish();
    }
}

criterion_group!(benches, picture);
criterion_main!(benches);
