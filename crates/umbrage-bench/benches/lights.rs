//! Light trees: the same lamp as data that is walked and as one composed type (R87-18).
//!
//! Ids: `light-tree/<form>`, elements are points.
use criterion::{Criterion, Throughput, criterion_group, criterion_main};
use glam::Vec3;
use std::hint::black_box;
use umbrage_sample::Key;
use umbrage_scene::tree::{Colour, Cone, Emission, Falloff, Mix, Passing, Product, Sight, Tree};

fn trees(criterion: &mut Criterion) {
    let (warm, cool) = (Vec3::new(1.3, 0.9, 0.4), Vec3::new(0.1, 0.2, 0.5));
    let falloff = Falloff { exponent: 2.0, reference: 12.0, most: 9.0 };
    let cone = Cone { inner_deg: 17.0, outer_deg: 61.0 };
    let data = Tree::Product(vec![
        Tree::Mix(Box::new([Tree::Cone(cone), Tree::colour(cool), Tree::colour(warm)])),
        Tree::Falloff(falloff),
        Tree::Shadow { recipe: String::new() },
    ]);
    let composed = Product(Product(Mix(cone, Colour(cool), Colour(warm)), falloff), Passing);
    let key = Key::new(1, 0, 0);
    let sights: Vec<Sight> = (0..65_536)
        .map(|i| Sight {
            distance: 1.0 + 30.0 * key.unit(i, 0),
            cos_axis: key.signed(i, 1),
            transmittance: Vec3::splat(key.unit(i, 2)),
        })
        .collect();
    let sum = |lamp: &dyn Fn(&Sight) -> Vec3| sights.iter().map(lamp).sum::<Vec3>();
    assert_eq!(sum(&|at| data.light(at)), sum(&|at| composed.light(at)));
    let mut group = criterion.benchmark_group("light-tree");
    group.throughput(Throughput::Elements(sights.len() as u64));
    group.bench_function("data", |bencher| {
        bencher.iter(|| black_box(&sights).iter().map(|at| data.light(at)).sum::<Vec3>());
    });
    group.bench_function("composed", |bencher| {
        bencher.iter(|| black_box(&sights).iter().map(|at| composed.light(at)).sum::<Vec3>());
    });
    group.finish();
}

criterion_group!(benches, trees);
criterion_main!(benches);
