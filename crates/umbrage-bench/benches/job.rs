//! The whole job: a map and a million look-ups beside a tree and a million rays, or sixteen. Percentage-closer filtering does not model an area light.
//!
//! Ids: `job/<way>/<triangles>`, elements are receivers; rays go through a tree of two or of eight children. Maps have 1024² texels. One thread.
use criterion::{BenchmarkId, Criterion, Throughput, criterion_group, criterion_main};
use umbrage_bench::in_pool;
use umbrage_bench::look_ups::{KEY, closer, mean};
use umbrage_bench::peers::rays::Tree;
use umbrage_bench::raster::{first, refined};
use umbrage_bench::scene::{Scene, Segments};
use umbrage_shadow::{DualPlane, Shadow, ShadowMap};

/// Fills fractions in shadow.
type Way<'a> = &'a (dyn Fn(&mut [f32]) + Sync);

fn jobs(criterion: &mut Criterion) {
    for (triangles, segments) in [("75k", Segments::MEDIUM), ("1M", Segments::LARGE)] {
        let scene = Scene::new(segments, 1024);
        let (mesh, points, view, light) = (&scene.mesh, &scene.points, Scene::view(1024), Scene::disc());
        let ways: [(&str, Way<'_>); 5] = [
            ("pcf", &|out| {
                let map = first(&view, mesh).map;
                ShadowMap { filter: closer(&view), map }.fractions(points, KEY, out);
            }),
            ("auto", &|out| {
                let map = refined(&view, mesh).map;
                ShadowMap { filter: DualPlane::default(), map }.fractions(points, KEY, out);
            }),
            ("1-ray-of-two", &|out| Tree::of_two(mesh).one_ray(points, light, out)),
            ("1-ray-of-eight", &|out| Tree::of_eight(mesh).one_ray(points, light, out)),
            ("16-rays", &|out| Tree::of_eight(mesh).sixteen_rays(points, light, out)),
        ];
        let mut group = criterion.benchmark_group("job");
        group.sample_size(10).throughput(Throughput::Elements(points.len() as u64));
        let mut out = vec![f32::NAN; points.len()];
        let means = ways.map(|(_, run)| {
            run(&mut out);
            mean(&out)
        });
        assert!(means.iter().all(|found| (found - means[2]).abs() < 0.02), "fractions in shadow by way: {means:?}");
        for (way, run) in ways {
            group.bench_function(BenchmarkId::new(way, triangles), |bencher| {
                in_pool(1, || bencher.iter(|| run(&mut out)));
            });
        }
        group.finish();
    }
}

criterion_group!(benches, jobs);
criterion_main!(benches);
