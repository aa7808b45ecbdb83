//! Pass 1: triangles to a depth map.
//!
//! Ids: `pass1/bake/<scene>/<texels a side>`, elements are fragments.
use criterion::{BenchmarkId, Criterion, Throughput, criterion_group, criterion_main};
use glam::UVec2;
use std::hint::black_box;
use umbrage_bake::bake;
use umbrage_depth::First;
use umbrage_raster::{Cull, Triangle};
use umbrage_render::Soup;
use umbrage_scene::gallery;

fn bakes(criterion: &mut Criterion) {
    let mut group = criterion.benchmark_group("pass1/bake");
    group.sample_size(20);
    for (name, make) in [("sphere-plane", gallery::sphere_plane as fn() -> _), ("box-plane", gallery::box_plane)] {
        for side in [1024, 4096] {
            let scene = make();
            let view = scene.lights[0].view.with_size(UVec2::splat(side)).expect("a valid size");
            let triangles: Vec<Triangle> = Soup::casters(&scene, &view).triangles().collect();
            let baked = bake(&view, triangles.iter().copied(), &First, Cull::None);
            assert!(baked.fragments > u64::from(side) * u64::from(side) / 4, "{} fragments", baked.fragments);
            group.throughput(Throughput::Elements(baked.fragments));
            group.bench_function(BenchmarkId::new(name, side), |bencher| {
                bencher.iter(|| bake(&view, black_box(&triangles).iter().copied(), &First, Cull::None));
            });
        }
    }
    group.finish();
}

criterion_group!(benches, bakes);
criterion_main!(benches);
