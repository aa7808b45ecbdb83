//! Pass 1: triangles to a map, beside `euc` and the memory's limit; then depth rules and facets of a knot.
//!
//! Ids: `pass1/<mesh>/<by>/<texels per side>` with elements the fragments, and `rules/<surface>/<texels per side>` with elements the
//! texels. One thread.
use criterion::{BenchmarkId, Criterion, Throughput, criterion_group, criterion_main};
use std::hint::black_box;
use umbrage_bench::in_pool;
use umbrage_bench::peers::memory::clear_and_min;
use umbrage_bench::peers::software::Software;
use umbrage_bench::raster::{Workload, facets, first, first_one_by_one, midpoint, refined, second};
use umbrage_bench::scene::Segments;
use umbrage_depth::DepthMap;

const SIDES: [u32; 2] = [1024, 4096];

fn meshes(criterion: &mut Criterion) {
    let make: [fn(u32) -> Workload; 6] = [
        Workload::back_to_front,
        Workload::front_to_back,
        |side| Workload::hundred(10_000, side),
        |side| Workload::tiny(724, side),
        |side| Workload::knot("knot-75k", Segments::MEDIUM, side),
        |side| Workload::knot("knot-1M", Segments::LARGE, side),
    ];
    for (make, side) in make.iter().flat_map(|make| SIDES.map(|side| (make, side))) {
        let workload = make(side);
        let baked = workload.checked();
        let mut software = Software::new(&workload.view);
        software.draw(&workload.mesh);
        workload.assert_drawn(&baked, &software);
        let (mut buffer, layers) = (vec![0.0; side as usize * side as usize], workload.limit_layers(&baked));
        clear_and_min(&mut buffer, layers);
        assert!(buffer.iter().all(|depth| *depth == 1.0), "the nearest layer is left");
        let mut group = criterion.benchmark_group(format!("pass1/{}", workload.name));
        group.sample_size(10).throughput(Throughput::Elements(baked.fragments));
        group.bench_function(BenchmarkId::new("ours", side), |bencher| {
            in_pool(1, || bencher.iter(|| black_box(&workload).first()));
        });
        let triangles = workload.mesh.one_by_one();
        group.bench_function(BenchmarkId::new("one-by-one", side), |bencher| {
            in_pool(1, || bencher.iter(|| first_one_by_one(&workload.view, black_box(&triangles))));
        });
        group.bench_function(BenchmarkId::new("euc", side), |bencher| {
            bencher.iter(|| software.draw(black_box(&workload.mesh)));
        });
        group.bench_function(BenchmarkId::new("memory", side), |bencher| {
            bencher.iter(|| clear_and_min(&mut buffer, layers));
        });
        group.finish();
    }
}

fn rules(criterion: &mut Criterion) {
    for side in SIDES {
        let knot = Workload::knot("knot-75k", Segments::MEDIUM, side);
        let (view, mesh) = (&knot.view, &knot.mesh);
        let depths = knot.checked().map;
        let (coarse, fine) = (facets(view, mesh).map, refined(view, mesh).map);
        for texel in umbrage_plane::TexelRect::of_size(view.size()).texels().step_by(97) {
            assert_eq!(coarse.depth(texel), depths.depth(texel), "facets at {texel}");
            // Samples of a refined map may share a plane that is nearly their own.
            let (found, own) = (fine.depth(texel), depths.depth(texel));
            assert!(
                found == own || (found - own).abs() < 1e-4 * own,
                "refined facets at {texel}: {found} beside {own}"
            );
        }
        println!(
            "{side}²: facets {} bytes, refined {} bytes, tiles {}",
            coarse.allocated(),
            fine.allocated(),
            depths.allocated()
        );
        let ways: [(&str, &(dyn Fn() + Sync)); 5] = [
            ("first", &|| drop(black_box(first(view, mesh)))),
            ("second", &|| drop(black_box(second(view, mesh)))),
            ("midpoint", &|| drop(black_box(midpoint(view, mesh)))),
            ("facets", &|| drop(black_box(facets(view, mesh)))),
            ("refined-facets", &|| drop(black_box(refined(view, mesh)))),
        ];
        let mut group = criterion.benchmark_group("rules");
        group.sample_size(10).throughput(Throughput::Elements(u64::from(side) * u64::from(side)));
        for (name, way) in ways {
            group.bench_function(BenchmarkId::new(name, side), |bencher| in_pool(1, || bencher.iter(way)));
        }
        group.finish();
    }
}

criterion_group!(benches, meshes, rules);
criterion_main!(benches);
