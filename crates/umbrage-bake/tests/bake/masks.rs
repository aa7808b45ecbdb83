//! Casters with holes: what an alpha test leaves of them, in every kind of map.

use crate::pass1::{naive, triangles, views};
use crate::shapes::quad;
use glam::{DMat3, DVec2, DVec3, IVec2, UVec2, Vec2, Vec3};
use std::sync::atomic::{AtomicU32, Ordering};
use std::sync::{Arc, Mutex};
use umbrage_bake::{
    Caster, Deep, MaskPlace, Refinement, bake, bake_by_normals, bake_deep, bake_facets, bake_multi, bake_refined,
    bake_tags,
};
use umbrage_depth::{
    BackFace, DeepMap, DepthMap, DepthRule, FacetMap, FacetRule, FacetSource, First, Midpoint, Raw, Second, TagMap,
    Tiled,
};
use umbrage_plane::{TexelRect, View};
use umbrage_raster::{Cull, Triangle};

/// Maps of every kind.
#[derive(PartialEq)]
struct Every {
    tiled: Vec<Arc<Tiled>>,
    facets: Vec<Arc<FacetMap>>,
    deep: DeepMap,
    tags: TagMap,
}

fn every(view: &View, casters: &[Caster<'_>]) -> Every {
    let all = || casters.iter().copied();
    let midpoint = Midpoint::default();
    let refined = |refinement| bake_refined(view, all(), &refinement).map;
    Every {
        tiled: vec![
            bake(view, all(), &First, Cull::None).map,
            bake(view, all(), &Second, Cull::None).map,
            bake(view, all(), &BackFace, Cull::Front).map,
            bake(view, all(), &midpoint, Cull::None).map,
            bake_multi(view, all(), &First, Cull::None, 2).unwrap().map,
            bake_by_normals(view, all(), &BackFace).map,
        ],
        facets: vec![
            bake_facets(view, all(), &First, Cull::None).map,
            bake_facets(view, all(), &Second, Cull::None).map,
            refined(Refinement::default()),
            refined(Refinement::default().with_fine(2).with_slots(32)),
        ],
        deep: bake_deep(view, [all()], &Deep::new(0.0, 4).unwrap()).map,
        tags: bake_tags(view, all()),
    }
}

/// `masked` of the triangles with a mask.
fn with_mask<'a>(
    triangles: &[Triangle],
    mask: &'a (dyn Fn(&MaskPlace) -> bool + Sync),
    masked: impl Fn(usize) -> bool,
) -> Vec<Caster<'a>> {
    let caster = |(index, triangle): (usize, &Triangle)| {
        let caster = Caster::from(*triangle);
        if masked(index) { caster.with_mask(mask) } else { caster }
    };
    triangles.iter().enumerate().map(caster).collect()
}

#[test]
fn who_is_nowhere_might_as_well_not_be_given() {
    for view in views() {
        let without: Vec<Caster<'_>> = triangles().into_iter().step_by(2).map(Caster::from).collect();
        // Others keep their order, of which ties are settled by the first.
        let masked = with_mask(&triangles(), &|_| false, |index| index % 2 == 1);
        assert!(every(&view, &masked) == every(&view, &without), "{view:?}");
        let nobody = with_mask(&triangles(), &|_| false, |_| true);
        assert!(every(&view, &nobody) == every(&view, &[]), "{view:?}");
    }
}

#[test]
fn who_is_everywhere_needs_no_mask() {
    for view in views() {
        let bare = every(&view, &with_mask(&triangles(), &|_| true, |_| false));
        assert!(every(&view, &with_mask(&triangles(), &|_| true, |index| index % 3 == 1)) == bare, "{view:?}");
        assert!(every(&view, &with_mask(&triangles(), &|_| true, |_| true)) == bare, "{view:?}");
    }
}

/// The weights of the corners where the ray through a place of a map meets a triangle.
fn weights(view: &View, corners: [DVec3; 3], at: DVec2) -> DVec3 {
    let (origin, direction) = view.ray(at);
    let (b, c) = (corners[1] - corners[0], corners[2] - corners[0]);
    let [second, third, _] = (DMat3::from_cols(b, c, -direction).inverse() * (origin - corners[0])).to_array();
    DVec3::new(1.0 - second - third, second, third)
}

/// Rings about a corner.
fn rings(weights: DVec3) -> bool {
    (weights.x * 3.7 + weights.y * weights.z * 11.0).rem_euclid(1.0) < 0.55
}

#[test]
fn every_rule_stores_what_one_texel_at_a_time_stores_of_what_is_there() {
    fn law<R: DepthRule>(rule: &R, cull: Cull) {
        let (triangles, asked) = (triangles(), AtomicU32::new(0));
        let mask = |at: &MaskPlace| {
            asked.fetch_add(1, Ordering::Relaxed);
            rings(at.weights)
        };
        for view in views() {
            let casters = with_mask(&triangles, &mask, |index| index % 2 == 0);
            let there = |index: u32, at: DVec2| {
                index % 2 == 1
                    || rings(weights(&view, triangles[index as usize].corners, at).clamp(DVec3::ZERO, DVec3::ONE))
            };
            let expected = naive(&view, &triangles, rule, cull, there);
            for threads in [1, 2] {
                let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
                let baked = pool.install(|| bake(&view, casters.iter().copied(), rule, cull));
                assert!(Raw::from(&*baked.map) == expected, "{:?}, {threads} threads", view.size());
            }
        }
        assert!(asked.into_inner() > 10_000);
    }
    law(&First, Cull::None);
    law(&Second, Cull::None);
    law(&BackFace, Cull::None);
    law(&BackFace, Cull::Front);
    law(&Midpoint::default(), Cull::None);
}

#[test]
fn plain_maps_of_facets_with_holes_are_what_every_other_map_is() {
    fn law<R: FacetRule>(rule: &R, cull: Cull) {
        let mask = |at: &MaskPlace| rings(at.weights);
        let casters = with_mask(&triangles(), &mask, |index| index % 2 == 0);
        for view in views() {
            let map = bake(&view, casters.iter().copied(), rule, cull).map;
            let facets = bake_facets(&view, casters.iter().copied(), rule, cull).map;
            for texel in TexelRect::of_size(view.size()).texels() {
                assert_eq!(facets.depth(texel).to_bits(), map.depth(texel).to_bits(), "{texel} of {view:?}");
            }
        }
    }
    law(&First, Cull::None);
    law(&Second, Cull::None);
    law(&BackFace, Cull::Front);
}

#[test]
fn no_number_of_threads_changes_a_bit_of_what_has_holes() {
    let mask = |at: &MaskPlace| rings(at.weights);
    let casters = with_mask(&triangles(), &mask, |index| index % 2 == 0);
    let view = View::perspective(DVec3::ZERO, DVec3::NEG_Z, DVec3::Y, 1.2, 2.0, 60.0, UVec2::new(130, 97)).unwrap();
    let [alone, many] = [1, 2].map(|threads| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
        pool.install(|| every(&view, &casters))
    });
    assert!(alone == many);
    assert!(alone.facets[2].refined() > 100);
}

/// Texels of the map below along each side, and the checkerboard's squares.
const SIZE: i32 = 64;
const SQUARES: i32 = 9;

/// Where the squares of the checkerboard begin along an axis, in texels: at odd multiples of 1/256, which snapping keeps and which lie
/// between all samples and slots.
fn border(square: i32) -> f32 {
    (square * (7 * 256 - 54) + 101) as f32 / 256.0
}

/// Straight down on a world whose unit is a texel; (0, 0) is the map's upper left corner.
fn above() -> View {
    let middle = DVec3::new(f64::from(SIZE / 2), f64::from(-SIZE / 2), 0.0);
    let size = UVec2::splat(SIZE as u32);
    View::orthographic(middle + DVec3::Z * 10.0, middle, DVec3::Y, f64::from(SIZE / 2), 1.0, 40.0, size).unwrap()
}

/// A level square from a place of the map to another, seen from above or, turned over, from below.
fn level(from: Vec2, to: Vec2, height: f32, object: u32, turned: bool) -> [Triangle; 2] {
    let [a, b, c, d] =
        [from, Vec2::new(from.x, to.y), to, Vec2::new(to.x, from.y)].map(|place| Vec3::new(place.x, -place.y, height));
    quad(if turned { [a, d, c, b] } else { [a, b, c, d] }, object, false)
}

#[test]
fn a_checkerboard_is_its_squares() {
    let (first, last) = (Vec2::splat(border(0)), Vec2::splat(border(SQUARES)));
    // Two boards, the lower of which is seen from below, over a floor.
    let board = [level(first, last, 4.0, 0, false), level(first, last, 3.0, 0, true)];
    let whole = || level(Vec2::ZERO, Vec2::splat(SIZE as f32), -5.0, 9, false).map(Caster::from);
    let places: Vec<[Vec2; 3]> = board
        .iter()
        .flatten()
        .map(|triangle| triangle.corners.map(|corner| Vec2::new(corner.x as f32, -corner.y as f32)))
        .collect();
    let black = |at: DVec2| {
        let square = |at: f64| (0..SQUARES).rev().find(|square| f64::from(border(*square)) < at).unwrap_or(0);
        (square(at.x) + square(at.y)) % 2 == 0
    };
    let mask = |at: &MaskPlace| black(at.mix(places[at.triangle as usize]));
    let boards = board.iter().flatten().map(|triangle| Caster::from(*triangle).with_mask(&mask));
    let masked: Vec<Caster<'_>> = boards.chain(whole()).collect();
    let squares =
        TexelRect::of_size(UVec2::splat(SQUARES as u32)).texels().filter(|square| (square.x + square.y) % 2 == 0);
    let cut = squares.flat_map(|square| {
        let (from, to) = (square.to_array().map(border), (square + 1).to_array().map(border));
        [level(from.into(), to.into(), 4.0, 0, false), level(from.into(), to.into(), 3.0, 0, true)].concat()
    });
    let cut: Vec<Caster<'_>> = cut.map(Caster::from).chain(whole()).collect();
    let view = above();
    let (masked, cut) = (every(&view, &masked), every(&view, &cut));
    for (index, (masked, cut)) in masked.tiled.iter().zip(&cut.tiled).enumerate() {
        assert!(masked == cut, "map {index}");
    }
    assert!(masked.deep == cut.deep && masked.tags == cut.tags);
    let depth = |map: &Tiled, x: i32| map.depth(IVec2::new(x, 3));
    // Through a hole one sees the floor, whose second surface is none.
    let [on, off] = [3, 10];
    assert_eq!([on, off].map(|x| depth(&masked.tiled[0], x)), [6.0, 15.0]);
    assert_eq!([on, off].map(|x| depth(&masked.tiled[1], x)), [7.0, f32::INFINITY]);
    let mut links = 0;
    for (masked, cut) in masked.facets.iter().zip(&cut.facets) {
        assert_eq!((masked.refined(), masked.fine()), (cut.refined(), cut.fine()));
        for at in TexelRect::of_size(view.size() * masked.fine()).texels() {
            assert_eq!(masked.sample(at), cut.sample(at), "sample {at}");
            for down in [false, true] {
                assert_eq!(masked.link(at, down), cut.link(at, down), "link {at}, {down}");
                links += u32::from(masked.link(at, down).is_some());
            }
        }
    }
    assert!(links > 1000, "{links} links");
}

#[test]
fn a_mask_is_asked_where_the_ray_of_a_sample_meets_the_triangle() {
    // One goes through the near limit, one is edge-on to the light, the others lean.
    let corners = [
        [[-9.0, -3.0, -3.0], [8.0, -5.0, -50.0], [0.0, 7.0, -20.0]],
        [[-4.0, 2.0, 1.0], [5.0, 3.0, -30.0], [1.0, -8.0, -12.0]],
        [[0.0, -1.0, -5.0], [0.0, -2.0, -20.0], [0.001, 6.0, -30.0]],
    ];
    let triangles = corners.map(|corners| Triangle::new(corners.map(DVec3::from), 5, true));
    let views = views().into_iter().filter(|view| view.size().min_element() > 32);
    for view in views {
        let places: Mutex<Vec<MaskPlace>> = Mutex::default();
        let mask = |at: &MaskPlace| {
            places.lock().unwrap().push(*at);
            true
        };
        bake(&view, with_mask(&triangles, &mask, |_| true), &First, Cull::None);
        bake_refined(&view, with_mask(&triangles, &mask, |_| true), &Refinement::default());
        let places = places.into_inner().unwrap();
        assert!(places.len() > 3000, "{}", places.len());
        for MaskPlace { triangle, object, weights, .. } in places {
            assert_eq!(object, 5);
            assert!(weights.min_element() >= 0.0 && (weights.element_sum() - 1.0).abs() < 1e-12, "{weights}");
            if triangle == 2 {
                continue;
            }
            // A point that a sample sees is at a multiple of 1/256 texel.
            let [a, b, c] = triangles[triangle as usize].corners;
            let world = a * weights.x + b * weights.y + c * weights.z;
            let texel = view.eye_to_texel(view.world_to_eye().transform_point3(world)) * 256.0;
            let off = (texel - texel.round()).abs().max_element();
            let border = weights.min_element() == 0.0;
            assert!(off < 1e-6 || border, "{off} of 1/256 texel at {texel}");
        }
    }
}

#[test]
fn a_mask_is_given_the_place_in_the_texture_between_those_of_the_corners() {
    for view in views() {
        let triangles = triangles();
        let uvs = |triangle: u32| [Vec2::new(triangle as f32, 0.0), Vec2::new(-1.0, 0.5), Vec2::new(0.25, 7.0)];
        let asked = AtomicU32::new(0);
        let mask = |at: &MaskPlace| {
            asked.fetch_add(1, Ordering::Relaxed);
            assert_eq!(at.uv, at.mix(uvs(at.triangle)));
            at.uv.y < 3.0
        };
        let casters = || (0..).zip(&triangles).map(|(i, triangle)| Caster::from(*triangle).with_uvs(uvs(i)));
        let by_uv: Vec<Caster<'_>> = casters().map(|caster| caster.with_mask(&mask)).collect();
        let by_weights = |at: &MaskPlace| at.weights.y * 0.5 + at.weights.z * 7.0 < 3.0;
        let by_weights: Vec<Caster<'_>> = casters().map(|caster| caster.with_mask(&by_weights)).collect();
        assert!(every(&view, &by_uv) == every(&view, &by_weights));
        assert!(asked.into_inner() > 0);
    }
}
