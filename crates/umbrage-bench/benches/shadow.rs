//! Look-ups as recipes bind them, with patterns and storages that are known only at run time: receivers of a camera's sweep to
//! fractions in shadow. `pass2` has filters whose types are known.
//!
//! Ids: `shadow/<recipe>/<storage>/<samples>`, elements are receivers.
use criterion::{BenchmarkId, Criterion, Throughput, criterion_group, criterion_main};
use glam::{UVec2, Vec3};
use std::hint::black_box;
use umbrage_depth::Storage;
use umbrage_plane::SurfacePoint;
use umbrage_recipe::Recipe;
use umbrage_render::light_map;
use umbrage_sample::Key;
use umbrage_scene::gallery;

const SIDE: u32 = 256;

/// Points of the plane row by row, each with the footprint of a pixel.
fn receivers() -> Vec<SurfacePoint> {
    (0..SIDE * SIDE)
        .map(|i| {
            let at = |x: f32, y: f32| Vec3::new(x - 0.5, 0.5 - y, 0.0) * 80.0;
            let (x, y, step) = ((i % SIDE) as f32 / SIDE as f32, (i / SIDE) as f32 / SIDE as f32, 1.0 / SIDE as f32);
            let corners = [at(x, y), at(x + step, y), at(x + step, y + step), at(x, y + step)];
            let centre = at(x + 0.5 * step, y + 0.5 * step);
            SurfacePoint { region: i, object: 1, ..SurfacePoint::at(centre, Vec3::Z).with_corners(corners) }
        })
        .collect()
}

fn filters(criterion: &mut Criterion) {
    let (points, key) = (receivers(), Key::new(1, 0, 0));
    let scene = gallery::sphere_plane();
    let view = scene.lights[0].view.with_size(UVec2::splat(1024)).expect("a valid size");
    let mut out = vec![f32::NAN; points.len()];
    let recipes = [
        ("pcf", "reeves87", 16),
        ("pcf-plane", "reeves87,depth=plane,bias=0.3", 16),
        ("pcf-every", "reeves87,pattern=every,min-size=8,depth=plane,bias=0.3", 256),
        ("ordinary", "reeves87,pattern=centre,bias=0.35", 1),
        ("williams", "williams78,bias=0.35,lookup=bilinear", 4),
        ("midpoint", "woo92", 16),
        ("midpoint-integers", "woo92,compare=integer", 16),
        ("midpoint-cone", "woo92,depth=cone", 16),
        ("conditional", "wang-molnar94", 4),
        ("soft", "burley", 64),
        ("pcf-deep", "reeves87,stored=deep,sub-samples=1", 16),
        ("auto", "auto", 16),
        ("moments", "msm", 8),
    ];
    for (name, text, samples) in recipes {
        let mut group = criterion.benchmark_group(format!("shadow/{name}"));
        group.throughput(Throughput::Elements(points.len() as u64));
        let recipe: Recipe = text.parse().expect("a recipe");
        let map = light_map(&recipe, &scene, &view);
        for (kept, storage) in [("raw", Storage::Raw), ("bbox", Storage::Bbox), ("tiled32", Storage::Tiled)] {
            let shadow = recipe.bind(&map, storage).expect("the recipe's own map");
            shadow.fractions(&points, key, &mut out);
            let dark = out.iter().sum::<f32>() / out.len() as f32;
            assert!((0.12..0.3).contains(&dark), "{name}: {dark} of the plane is dark");
            group.bench_function(BenchmarkId::new(kept, samples), |bencher| {
                bencher.iter(|| shadow.fractions(black_box(&points), key, &mut out));
            });
        }
        group.finish();
    }
}

criterion_group!(benches, filters);
criterion_main!(benches);
