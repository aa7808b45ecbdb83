//! What is baked as facets can be looked up from its file, bit for bit.

use glam::{DVec3, IVec2, UVec2};
use umbrage_bake::{Refinement, bake_facets, bake_refined};
use umbrage_depth::{BackFace, DepthMap, FacetMap, FacetRule, FacetSource, First, Raw, Second};
use umbrage_io::{decode_facet_map, decode_shadow_map, encode_facet_map, encode_shadow_map};
use umbrage_plane::{Kind, Rules, Sampling, TexelRect, View, cube_views};
use umbrage_raster::{Cull, Triangle};
use umbrage_render::Soup;
use umbrage_scene::gallery;

const TEXELS: u64 = 1 << 20;

/// The same answers to everything: a map may equal another only if it gives them.
fn same(read: &FacetMap, map: &FacetMap, what: &str) {
    assert!(read == map, "{what}");
    assert_eq!((read.fine(), read.slots(), read.bytes()), (map.fine(), map.slots(), map.bytes()), "{what}");
    let size = map.view().size().as_ivec2();
    for texel in TexelRect::new(IVec2::splat(-1), size + 1).texels() {
        assert_eq!(read.depth(texel).to_bits(), map.depth(texel).to_bits(), "{what}: depth at {texel}");
    }
    let bits = |map: &FacetMap, at: IVec2| {
        let sample = map.sample(at);
        let numbers = [sample.plane.c, sample.plane.dx, sample.plane.dy, sample.at.x, sample.at.y, sample.side];
        (numbers.map(f64::to_bits), [false, true].map(|down| map.link(at, down).map(f64::to_bits)))
    };
    for at in TexelRect::new(IVec2::splat(-3), size * map.fine() as i32 + 3).texels() {
        assert_eq!(bits(read, at), bits(map, at), "{what}: sample at {at}");
    }
}

/// Holds a map to its file; how many bytes that has beside the file of its depths.
fn law(map: &FacetMap, what: &str) -> (usize, usize) {
    let bytes = encode_facet_map(map).unwrap();
    same(&decode_facet_map(&bytes, TEXELS).unwrap(), map, what);
    let raw = Raw::copy_of(map);
    assert!(decode_shadow_map(&bytes, TEXELS).unwrap() == raw, "{what}: depths");
    (bytes.len(), encode_shadow_map(&raw).unwrap().len())
}

fn every_map(view: &View, triangles: &[Triangle], what: &str) {
    fn plain<R: FacetRule>(view: &View, triangles: &[Triangle], rule: &R, cull: Cull, what: &str) {
        law(&bake_facets(view, triangles.iter().copied(), rule, cull).map, what);
    }
    plain(view, triangles, &First, Cull::None, &format!("{what}, first"));
    plain(view, triangles, &First, Cull::Front, &format!("{what}, back faces by culling"));
    plain(view, triangles, &Second, Cull::None, &format!("{what}, second"));
    plain(view, triangles, &BackFace, Cull::None, &format!("{what}, back-face"));
    for (fine, slots) in [(2, 32), (4, 16), (8, 8)] {
        let refinement = Refinement::default().with_fine(fine).with_slots(slots);
        law(&bake_refined(view, triangles.iter().copied(), &refinement).map, &format!("{what}, fine {fine}"));
    }
}

/// Random numbers from a seed, within −½..½.
fn random(seed: &mut u64) -> f64 {
    *seed = seed.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
    (*seed >> 33) as f64 / f64::from(1_u32 << 31) - 0.5
}

/// Large and small triangles in front of a wall that does not fill the map.
fn soup(seed: u64, count: u32) -> Vec<Triangle> {
    let mut seed = 2 * seed + 1;
    let mut corner = |size: f64| DVec3::new(random(&mut seed), random(&mut seed), random(&mut seed)) * size;
    let one = |object: u32| {
        let middle = corner(14.0) + DVec3::NEG_Z * 20.0;
        let size = if object.is_multiple_of(3) { 9.0 } else { 0.7 };
        Triangle { corners: [(); 3].map(|()| middle + corner(size)), object, sheet: object.is_multiple_of(2) }
    };
    let wall = [(-20.0, -6.0), (20.0, -6.0), (0.0, 5.0)].map(|(x, y)| DVec3::new(x, y, -35.0));
    (0..count).map(one).chain([Triangle { corners: wall, object: count, sheet: true }]).collect()
}

#[test]
fn random_triangles_in_every_kind_of_view() {
    let sizes = [UVec2::new(1, 1), UVec2::new(45, 70), UVec2::splat(64)];
    for (seed, size) in sizes.into_iter().enumerate() {
        let perspective = View::perspective(DVec3::ZERO, DVec3::NEG_Z, DVec3::Y, 0.8, 2.0, 60.0, size).unwrap();
        let flat = View::orthographic(DVec3::ZERO, DVec3::NEG_Z, DVec3::Y, 11.0, -1.0, 60.0, size).unwrap();
        let corner = IVec2::new(5, -9);
        for view in [
            perspective.with_rules(Rules::SPOT),
            perspective.with_kind(Kind::Radial).with_sampling(Sampling::Jittered { seed: 5 }),
            perspective.with_kind(Kind::Screen),
            perspective.window(TexelRect::new(corner, corner + size.as_ivec2())).unwrap(),
            flat,
            flat.with_kind(Kind::Screen).with_sampling(Sampling::Jittered { seed: 6 }),
        ] {
            for count in [0, 30, 4000] {
                let what = format!("{size}, {count} triangles, {:?}", view.kind());
                every_map(&view, &soup(seed as u64, count), &what);
            }
        }
    }
    for view in cube_views(DVec3::new(0.5, 0.2, -18.0), 0.05, 60.0, 48).unwrap() {
        every_map(&view, &soup(3, 300), "a face of a cube");
    }
}

#[test]
fn scenes_of_the_gallery() {
    for (_, make) in gallery::ALL {
        let scene = make();
        for (light, number) in scene.lights.iter().zip(0..) {
            let view = light.view.with_size(UVec2::splat(100)).unwrap();
            let triangles: Vec<Triangle> = Soup::casters(&scene, &view).triangles().collect();
            let what = format!("{}, light {number}", scene.name);
            let plain = bake_facets(&view, triangles.iter().copied(), &First, Cull::None).map;
            let refined = bake_refined(&view, triangles.iter().copied(), &Refinement::default()).map;
            for (map, form) in [(plain, "plain"), (refined, "refined")] {
                let (facets, depths) = law(&map, &format!("{what}, {form}"));
                assert!(facets <= depths + map.bytes() + map.bytes() / 8 + 4096, "{what}, {form}: {facets} bytes");
            }
        }
    }
}
