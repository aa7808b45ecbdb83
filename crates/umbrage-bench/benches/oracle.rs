//! Rays of the oracle and the dearer measures.
//!
//! Ids: `oracle/rays/<triangles>`, `metrics/<measure>/<pixels a side>`.
use criterion::{BenchmarkId, Criterion, Throughput, criterion_group, criterion_main};
use glam::{DVec3, DVec4, Vec3};
use std::hint::black_box;
use umbrage_oracle::metrics::{Grid, contour_deviation, spectrum};
use umbrage_oracle::{Body, Face, Geometry, RayCast};
use umbrage_plane::SurfacePoint;
use umbrage_sample::Key;
use umbrage_shadow::Shadow;

/// A ball of unit radius, `slices` around, three above the floor it shadows.
fn ball(slices: u32) -> Vec<Face> {
    let vertex = |i: u32, j: u32| {
        let (up, around) = (f64::from(2 * j) / f64::from(slices), f64::from(2 * i) / f64::from(slices));
        let (sin, cos) = (up * std::f64::consts::PI).sin_cos();
        let (z, x) = (around * std::f64::consts::PI).sin_cos();
        (DVec3::new(sin * x, cos, sin * z) + DVec3::Y * 3.0).as_vec3()
    };
    let quads = (0..slices / 2).flat_map(|j| (0..slices).map(move |i| (i, j)));
    quads
        .flat_map(|(i, j)| {
            let [a, b, c, d] = [vertex(i, j), vertex(i + 1, j), vertex(i + 1, j + 1), vertex(i, j + 1)];
            [Face { corners: [a, b, c], object: 0 }, Face { corners: [a, c, d], object: 0 }]
        })
        .collect()
}

fn rays(criterion: &mut Criterion) {
    let mut group = criterion.benchmark_group("oracle/rays");
    let key = Key::new(1, 0, 0);
    let points: Vec<SurfacePoint> = (0..65_536)
        .map(|i| SurfacePoint {
            object: 1,
            ..SurfacePoint::at(Vec3::new(key.signed(i, 0), 0.0, key.signed(i, 1)) * 3.0, Vec3::Y)
        })
        .collect();
    group.throughput(Throughput::Elements(points.len() as u64));
    for slices in [32, 256] {
        let faces = ball(slices);
        let triangles = faces.len();
        let geometry = Geometry::from_faces(faces, vec![Body { casts: true, solid: true, passes: Vec3::ZERO }]);
        let truth = RayCast::everywhere(&geometry, DVec4::new(0.0, 12.0, 0.0, 1.0));
        let mut out = vec![f32::NAN; points.len()];
        truth.fractions(&points, key, &mut out);
        // The ball's shadow is a disc of radius 12 / √(9² − 1); the square it lies in is 6 wide.
        let dark = out.iter().sum::<f32>() / points.len() as f32;
        assert!((dark - std::f32::consts::PI * 1.8 / 36.0).abs() < 0.01, "{dark} of the floor is dark");
        group.bench_function(BenchmarkId::from_parameter(triangles), |bencher| {
            bencher.iter(|| truth.fractions(black_box(&points), key, &mut out));
        });
    }
    group.finish();
}

fn measures(criterion: &mut Criterion) {
    const SIDE: usize = 512;
    let mut group = criterion.benchmark_group("metrics");
    group.throughput(Throughput::Elements((SIDE * SIDE) as u64));
    let key = Key::new(2, 0, 0);
    let centre = Vec3::splat(256.0).truncate();
    let disc = |noise: f32| -> Vec<f32> {
        (0..(SIDE * SIDE) as u32)
            .map(|i| {
                let at = glam::Vec2::new((i % SIDE as u32) as f32, (i / SIDE as u32) as f32);
                (200.0 - at.distance(centre) + noise * key.signed(i, 0)).clamp(0.0, 1.0)
            })
            .collect()
    };
    let (truth, noisy) = (disc(0.0), disc(8.0));
    let (truth, noisy) = (Grid::new(&truth, SIDE), Grid::new(&noisy, SIDE));
    assert!(contour_deviation(noisy, truth, f64::INFINITY).is_some_and(|found| found.rms > 1.0 && found.rms < 8.0));
    group.bench_function(BenchmarkId::new("contour_deviation", SIDE), |bencher| {
        bencher.iter(|| contour_deviation(black_box(noisy), truth, f64::INFINITY));
    });
    assert!(spectrum(noisy).ratio() > 100.0);
    group.bench_function(BenchmarkId::new("spectrum", SIDE), |bencher| bencher.iter(|| spectrum(black_box(noisy))));
    group.finish();
}

criterion_group!(benches, rays, measures);
criterion_main!(benches);
