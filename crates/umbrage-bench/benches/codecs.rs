//! Maps to bytes of a file and back.
//!
//! Ids: `codec/<kind>/<direction>/<texels per side>`, elements are texels.
use criterion::{BenchmarkId, Criterion, Throughput, criterion_group, criterion_main};
use std::hint::black_box;
use umbrage_bake::{Deep, bake_deep};
use umbrage_bench::raster::{first, refined};
use umbrage_bench::scene::{Scene, Segments};
use umbrage_depth::{DepthMap, Raw};
use umbrage_io::{
    decode_deep_map, decode_facet_map, decode_shadow_map, encode_deep_map, encode_facet_map, encode_shadow_map,
};
use umbrage_plane::TexelRect;

const SIDE: u32 = 1024;
const TEXELS: u64 = SIDE as u64 * SIDE as u64;

/// One kind of map: both ways, and that what is read is what was written.
fn both<M: DepthMap>(
    criterion: &mut Criterion,
    kind: &str,
    map: &M,
    encode: impl Fn(&M) -> Vec<u8>,
    decode: impl Fn(&[u8]) -> Box<dyn Fn(glam::IVec2) -> f32>,
) {
    let bytes = encode(map);
    let back = decode(&bytes);
    let mut texels = TexelRect::of_size(map.view().size()).texels();
    assert!(texels.all(|texel| back(texel) == map.depth(texel)), "{kind}: every texel is read as it was written");
    println!("{kind}: {} bytes in a file", bytes.len());
    let mut group = criterion.benchmark_group(format!("codec/{kind}"));
    group.sample_size(10).throughput(Throughput::Elements(TEXELS));
    group.bench_function(BenchmarkId::new("encode", SIDE), |bencher| bencher.iter(|| encode(black_box(map))));
    group.bench_function(BenchmarkId::new("decode", SIDE), |bencher| {
        bencher.iter(|| drop(black_box(decode(black_box(&bytes)))));
    });
    group.finish();
}

fn codecs(criterion: &mut Criterion) {
    let view = Scene::view(SIDE);
    let mesh = umbrage_bench::meshes::knot_on_ground(Segments::MEDIUM.0, Segments::MEDIUM.1);
    let raw = Raw::copy_of(&first(&view, &mesh).map);
    let encode = |map: &Raw| encode_shadow_map(map).expect("a map");
    both(criterion, "flat", &raw, encode, |bytes| {
        let map = decode_shadow_map(bytes, TEXELS).expect("a map");
        Box::new(move |texel| map.depth(texel))
    });
    let facets = refined(&view, &mesh).map;
    both(
        criterion,
        "facets",
        &facets,
        |map| encode_facet_map(map).expect("a map"),
        |bytes| {
            let map = decode_facet_map(bytes, TEXELS).expect("a map");
            Box::new(move |texel| map.depth(texel))
        },
    );
    let deep = bake_deep(&view, [mesh.indexed()], &Deep::default().with_axis(1)).map;
    both(
        criterion,
        "deep",
        &deep,
        |map| encode_deep_map(map).expect("a map"),
        |bytes| {
            let map = decode_deep_map(bytes, 64 * TEXELS).expect("a map");
            Box::new(move |texel| map.depth(texel))
        },
    );
}

criterion_group!(benches, codecs);
criterion_main!(benches);
