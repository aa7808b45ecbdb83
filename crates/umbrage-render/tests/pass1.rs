//! Pass 1 from triangles to map: what it stores, for every rule, sampling, size and number of threads.

use glam::{DVec3, IVec2, UVec2, Vec3};
use umbrage_depth::{BackFace, DepthMap, DepthRule, First, Midpoint, Raw, Second, Tiled};
use umbrage_plane::{Facing, Kind, Sampling, SurfacePoint, TexelRect, View};
use umbrage_raster::{Bins, Cull, Triangle};
use umbrage_render::{Soup, bake};
use umbrage_scene::{Mesh, Object, Scene, gallery};

/// A scene of solids and a sheet, and triangles of it through the near plane.
fn triangles() -> Vec<Triangle> {
    let mut all: Vec<Triangle> = Vec::new();
    let meshes = [
        (Mesh::sphere(Vec3::new(0.0, 0.0, -20.0), 5.0, 24), false),
        (Mesh::cuboid(Vec3::new(-9.0, -9.0, -40.0), Vec3::new(9.0, -4.0, -12.0)), false),
        (Mesh::cuboid(Vec3::new(1.0, 1.0, -3.0), Vec3::new(1.5, 2.5, 1.0)), false),
        (Mesh::cuboid(Vec3::new(-30.0, -30.0, -50.0), Vec3::new(30.0, 30.0, -48.0)), true),
    ];
    for (object, (mesh, sheet)) in meshes.into_iter().enumerate() {
        let corners = |triangle: &[u32; 3]| triangle.map(|vertex| mesh.positions[vertex as usize]);
        all.extend(mesh.triangles.iter().map(|triangle| Triangle::new(corners(triangle), object as u32, sheet)));
    }
    all
}

fn views() -> Vec<View> {
    let sizes = [UVec2::new(1, 1), UVec2::new(1, 37), UVec2::new(67, 1), UVec2::new(101, 53), UVec2::splat(64)];
    sizes
        .into_iter()
        .flat_map(|size| {
            let eye = |far| View::perspective(DVec3::ZERO, DVec3::NEG_Z, DVec3::Y, 1.2, 2.0, far, size).unwrap();
            let flat = View::orthographic(DVec3::ZERO, DVec3::NEG_Z, DVec3::Y, 8.0, 2.0, 60.0, size).unwrap();
            [
                eye(60.0),
                eye(60.0).with_sampling(Sampling::Jittered { seed: 7 }),
                eye(60.0).with_kind(Kind::Radial),
                eye(60.0).with_kind(Kind::Screen).with_sampling(Sampling::Jittered { seed: 1 }),
                flat,
                flat.with_kind(Kind::Screen),
            ]
        })
        .collect()
}

/// One texel at a time: all fragments of the whole map in the order of the triangles, then the rule's answer.
fn naive<R: DepthRule>(view: &View, triangles: &[Triangle], rule: &R, cull: Cull) -> Raw {
    let bins = Bins::new(view, TexelRect::of_size(view.size()), cull, triangles.iter().copied());
    let size = view.size();
    let mut cells = vec![R::EMPTY; size.element_product() as usize];
    for pass in 0..R::PASSES {
        for tile in TexelRect::of_size(bins.tiles()).texels() {
            bins.tile(tile.as_uvec2(), |facet, coverage| {
                for texel in TexelRect::of_size(size).texels() {
                    let at = texel - tile * 32;
                    let inside = at.cmpge(IVec2::ZERO).all() && at.cmplt(IVec2::splat(32)).all();
                    if inside && coverage.rows[at.y as usize] >> at.x & 1 == 1 {
                        let cell = &mut cells[(texel.y * size.x as i32 + texel.x) as usize];
                        rule.add(pass, cell, facet.key(view.sampling(), texel), facet.facing == Facing::Front, facet);
                    }
                }
            });
        }
    }
    let decode = view.decode();
    let depths = TexelRect::of_size(size).texels().zip(cells).map(|(texel, cell)| {
        let at = view.sampling().position(texel);
        rule.resolve(cell, &decode, at).max(decode.depth(view.key(view.near()) as f32, at))
    });
    Raw::new(*view, depths.collect()).unwrap()
}

fn law<R: DepthRule>(name: &str, rule: &R, cull: Cull) {
    let triangles = triangles();
    for view in views() {
        let expected = naive(&view, &triangles, rule, cull);
        for threads in [1, 2, 7] {
            let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
            let baked = pool.install(|| bake(&view, triangles.iter().copied(), rule, cull));
            assert!(Raw::from(&baked.map) == expected, "{name}, {:?}, {threads} threads", view.size());
            assert!(ranges_hold(&baked.map), "{name}, {:?}", view.size());
        }
    }
}

/// Every tile's range is the smallest and largest of its texels inside the map.
fn ranges_hold(map: &Tiled) -> bool {
    let whole = TexelRect::of_size(map.view().size());
    TexelRect::of_size(map.grid()).texels().all(|tile| {
        let texels = TexelRect::new(tile * 32, tile * 32 + 32).intersect(whole).texels();
        let depths: Vec<f32> = texels.map(|texel| map.depth(texel)).collect();
        let (low, high) = depths.iter().fold((f32::INFINITY, f32::NEG_INFINITY), |(l, h), &z| (l.min(z), h.max(z)));
        map.tile(tile.as_uvec2())
            .map_or(low == f32::INFINITY, |tile| tile.range().min == low && tile.range().max == high)
    })
}

#[test]
fn x2_x3_tiles_and_threads_store_what_one_texel_at_a_time_stores() {
    law("first", &First, Cull::None);
    law("second", &Second, Cull::None);
    law("back face", &BackFace, Cull::None);
    law("midpoint", &Midpoint::default(), Cull::None);
    law("first of the far sides", &First, Cull::Front);
}

#[test]
fn a_baked_texel_is_the_receiver_s_own_plane_to_two_ulp() {
    // A floor alone: what is stored at a texel is what a receiver's tangent plane says there (the virtual sample).
    let floor = Mesh::cuboid(Vec3::new(-5000.0, -30.0, -9000.0), Vec3::new(5000.0, -10.0, -4.0));
    let triangles: Vec<Triangle> =
        floor.triangles.iter().map(|t| Triangle::new(t.map(|v| floor.positions[v as usize]), 0, false)).collect();
    for sampling in [Sampling::Centre, Sampling::Jittered { seed: 3 }] {
        for kind in [Kind::Axial, Kind::Screen, Kind::Radial] {
            let size = UVec2::new(96, 64);
            let view = View::perspective(DVec3::ZERO, DVec3::new(0.0, -10.0, -30.0), DVec3::Y, 0.6, 1.0, 300.0, size);
            let view = view.unwrap().with_sampling(sampling).with_kind(kind);
            let map = bake(&view, triangles.iter().copied(), &First, Cull::None).map;
            let receiver = view.receiver(&SurfacePoint::at(Vec3::new(0.5, -10.0, -31.0), Vec3::Y)).unwrap();
            let plane = receiver.plane(&view);
            for texel in TexelRect::of_size(size).texels() {
                let (stored, exact) = (map.depth(texel), plane.at(sampling.position(texel)));
                let apart = (stored.to_bits() as i32 - exact.to_bits() as i32).abs();
                assert!(stored.is_finite() && apart <= 2, "{kind:?}, {texel}: {stored} {exact}");
            }
        }
    }
}

/// What a map's middle texel holds, and how many triangles were before the near plane.
fn at_the_middle<R: DepthRule>(view: &View, triangles: &[Triangle], rule: &R) -> (f32, u64) {
    let baked = bake(view, triangles.iter().copied(), rule, Cull::None);
    (baked.map.depth(IVec2::splat(16)), baked.stats.before_near)
}

#[test]
fn c10_a_solid_before_the_near_plane_keeps_its_shadow_under_every_rule() {
    // A box wholly between the light and the near plane, and no receiver in pass 1 (T-1).
    let mesh = Mesh::cuboid(Vec3::new(-0.4, -0.4, -0.8), Vec3::new(0.4, 0.4, -0.5));
    let triangles: Vec<Triangle> =
        mesh.triangles.iter().map(|t| Triangle::new(t.map(|v| mesh.positions[v as usize]), 0, false)).collect();
    let view = View::perspective(DVec3::ZERO, DVec3::NEG_Z, DVec3::Y, 1.0, 1.0, 50.0, UVec2::splat(33)).unwrap();
    let kept = (1.0, 12);
    assert_eq!(at_the_middle(&view, &triangles, &First), kept);
    assert_eq!(at_the_middle(&view, &triangles, &Second), kept);
    assert_eq!(at_the_middle(&view, &triangles, &BackFace), kept);
    assert_eq!(at_the_middle(&view, &triangles, &Midpoint::default()), kept);
}

#[test]
fn r87_5_only_casters_are_drawn_and_ids_and_sheets_reach_the_facets() {
    let mut scene: Scene = gallery::sphere_plane();
    scene.objects[0] = Object { solid: false, ..scene.objects[0].clone() };
    scene.objects[1].casts = false;
    let view = scene.lights[0].view;
    let drawn: Vec<Triangle> = Soup::casters(&scene, &view).triangles().collect();
    assert!(!drawn.is_empty() && drawn.iter().all(|triangle| triangle.object == 0 && triangle.sheet));
    assert!(Soup::all(&scene, &view).triangles().any(|triangle| triangle.object == 1 && !triangle.sheet));
}

#[test]
fn r87_21_a_map_of_16384_keeps_only_the_tiles_that_something_touched() {
    let scene = gallery::sphere_plane();
    let view = scene.lights[0].view.with_size(UVec2::splat(16_384)).unwrap();
    let mut sphere = scene;
    sphere.objects[1].casts = false;
    let map = bake(&view, Soup::casters(&sphere, &view).triangles(), &First, Cull::None).map;
    let share = map.bytes() as f64 / (16_384.0 * 16_384.0 * 4.0);
    assert!(share > 0.01 && share < 0.1, "{share}");
    let middle = view.receiver(&SurfacePoint::at(Vec3::new(0.0, 0.0, 25.0), Vec3::Z)).unwrap();
    assert!(map.depth(middle.footprint.centre.as_ivec2()) < middle.depth);
}
