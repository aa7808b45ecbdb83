//! One depth per texel.

use crate::shapes::{ball, cuboid, quad};
use glam::{DVec2, DVec3, IVec2, UVec2, Vec3};
use umbrage_bake::bake;
use umbrage_depth::{BackFace, DepthMap, DepthRule, First, Midpoint, Raw, SameSurface, Second, Stored, Tiled};
use umbrage_plane::{Facing, Kind, Sampling, SurfacePoint, TexelRect, View};
use umbrage_raster::{Bins, Cull, Triangle};

/// Solids and a sheet, some of them through the near plane.
pub fn triangles() -> Vec<Triangle> {
    let ball = ball(Vec3::new(0.0, 0.0, -20.0), 5.0, 12, 0).into_iter().map(|(triangle, _)| triangle);
    let boxes = [
        (Vec3::new(-9.0, -9.0, -40.0), Vec3::new(9.0, -4.0, -12.0), false),
        (Vec3::new(1.0, 1.0, -3.0), Vec3::new(1.5, 2.5, 1.0), false),
        (Vec3::new(-30.0, -30.0, -50.0), Vec3::new(30.0, 30.0, -48.0), true),
    ];
    let boxes = boxes.iter().zip(1..).flat_map(|(&(min, max, sheet), object)| cuboid(min, max, object, sheet));
    ball.chain(boxes).collect()
}

pub fn views() -> Vec<View> {
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

/// One texel at a time: all fragments of the whole map in the order of the triangles, then the rule's answer. What is not `there`, by the
/// index of its triangle and the place of a sample in texels, is left out.
pub fn naive<R: DepthRule>(
    view: &View,
    triangles: &[Triangle],
    rule: &R,
    cull: Cull,
    there: impl Fn(u32, DVec2) -> bool,
) -> Raw {
    let bins = Bins::new(view, TexelRect::of_size(view.size()), cull, triangles.iter().copied());
    let size = view.size();
    let mut cells = vec![R::EMPTY; size.element_product() as usize];
    for pass in 0..R::PASSES {
        for tile in TexelRect::of_size(bins.tiles()).texels() {
            bins.tile(tile.as_uvec2(), |facet, coverage| {
                for texel in TexelRect::of_size(size).texels() {
                    let at = texel - tile * 32;
                    let inside = at.cmpge(IVec2::ZERO).all() && at.cmplt(IVec2::splat(32)).all();
                    let covered = inside && coverage.rows[at.y as usize] >> at.x & 1 == 1;
                    if covered && there(facet.triangle, view.sampling().position(texel)) {
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
    // The nearest surface without its fronts is the nearest back face.
    let stored = if cull == Cull::Front && rule.stored() == Stored::First { Stored::BackFace } else { rule.stored() };
    Raw::new(*view, depths.collect()).unwrap().with_stored(stored)
}

fn law<R: DepthRule>(name: &str, rule: &R, cull: Cull) {
    let triangles = triangles();
    for view in views() {
        let expected = naive(&view, &triangles, rule, cull, |_, _| true);
        for threads in [1, 2, 7] {
            let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
            let baked = pool.install(|| bake(&view, triangles.iter().copied(), rule, cull));
            assert!(Raw::from(&*baked.map) == expected, "{name}, {:?}, {threads} threads", view.size());
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

#[track_caller]
fn same<R: DepthRule>(view: &View, triangles: &[Triangle], rule: &R) {
    let baked = bake(view, triangles.iter().copied(), rule, Cull::None);
    assert!(Raw::from(&*baked.map) == naive(view, triangles, rule, Cull::None, |_, _| true), "{:?}", rule.stored());
}

#[test]
fn x3_what_lies_behind_whole_tiles_is_left_out_without_a_trace() {
    // Large sheets, level and tilted so that some reach through others, each twice at one place, with small solids among them.
    let mut layers: Vec<Vec<Triangle>> = Vec::new();
    for (object, (depth, tilt)) in
        (0..).zip([(4.0, 0.0), (5.0, 0.3), (5.2, -0.3), (7.0, 0.0), (9.0, 0.5), (12.0, -0.1)])
    {
        let corner = |x: f32, y: f32| Vec3::new(x, y, -depth + tilt * (x + y));
        let corners = [corner(-40.0, -40.0), corner(40.0, -40.0), corner(40.0, 40.0), corner(-40.0, 40.0)];
        let sheet = quad(corners, object, object % 3 == 1);
        layers.push([sheet, sheet].concat());
        let low = Vec3::new(object as f32 - 3.0, -1.0, -depth - 0.4);
        layers.push(cuboid(low, low + 0.7, 10 + object, false));
    }
    let nearest_first = layers.concat();
    layers.reverse();
    let size = UVec2::new(96, 70);
    let flat = View::orthographic(DVec3::ZERO, DVec3::NEG_Z, DVec3::Y, 5.0, 1.0, 60.0, size).unwrap();
    let lamp = View::perspective(DVec3::ZERO, DVec3::NEG_Z, DVec3::Y, 0.5, 1.0, 60.0, size).unwrap();
    for view in [flat, lamp, lamp.with_sampling(Sampling::Jittered { seed: 5 }), flat.with_kind(Kind::Screen)] {
        for triangles in [&nearest_first, &layers.concat()] {
            same(&view, triangles, &First);
            same(&view, triangles, &Second);
            same(&view, triangles, &BackFace);
            for surface in [SameSurface::Depth, SameSurface::Object, SameSurface::Surface] {
                same(&view, triangles, &Midpoint::default().with_same(surface));
            }
        }
    }
}

#[test]
fn a_baked_texel_is_the_receiver_s_own_plane_to_two_ulp() {
    // A floor alone: what is stored at a texel is what a receiver's tangent plane says there (the virtual sample).
    let triangles = cuboid(Vec3::new(-5000.0, -30.0, -9000.0), Vec3::new(5000.0, -10.0, -4.0), 0, false);
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
    let triangles = cuboid(Vec3::new(-0.4, -0.4, -0.8), Vec3::new(0.4, 0.4, -0.5), 0, false);
    let view = View::perspective(DVec3::ZERO, DVec3::NEG_Z, DVec3::Y, 1.0, 1.0, 50.0, UVec2::splat(33)).unwrap();
    let kept = (1.0, 12);
    assert_eq!(at_the_middle(&view, &triangles, &First), kept);
    assert_eq!(at_the_middle(&view, &triangles, &Second), kept);
    assert_eq!(at_the_middle(&view, &triangles, &BackFace), kept);
    assert_eq!(at_the_middle(&view, &triangles, &Midpoint::default()), kept);
}

#[test]
fn a_baked_map_says_which_surface_it_stores() {
    let view = views()[0];
    let stored = |rule: &dyn Fn(Cull) -> Stored| [Cull::None, Cull::Front].map(rule);
    let of = |name: Stored| [name; 2];
    assert_eq!(stored(&|cull| bake(&view, triangles(), &First, cull).map.stored()), [Stored::First, Stored::BackFace]);
    assert_eq!(stored(&|cull| bake(&view, triangles(), &Second, cull).map.stored()), of(Stored::Second));
    assert_eq!(stored(&|cull| bake(&view, triangles(), &BackFace, cull).map.stored()), of(Stored::BackFace));
    assert_eq!(stored(&|cull| bake(&view, triangles(), &Midpoint::default(), cull).map.stored()), of(Stored::Midpoint));
}
