//! What light is left behind leaves and glass and behind what moves.

use crate::shapes::{ball, cuboid, quad};
use glam::{DVec3, IVec2, UVec2, Vec2, Vec3};
use umbrage_bake::{Caster, Deep, MaskPlace, bake, bake_deep, mix_moments};
use umbrage_depth::{DeepMap, DepthMap, First, Raw};
use umbrage_plane::{TexelRect, View};
use umbrage_raster::{Cull, Triangle};

/// Looks down −z from (0, 0, 100) at 32 × 32 world units, half a unit per texel.
fn above() -> View {
    View::orthographic(DVec3::Z * 100.0, DVec3::ZERO, DVec3::Y, 16.0, 1.0, 200.0, UVec2::splat(64)).unwrap()
}

fn flat(height: f32, left: f32, object: u32) -> [Triangle; 2] {
    let corners = [(left, -16.0), (16.0, -16.0), (16.0, 16.0), (left, 16.0)].map(|(x, y)| Vec3::new(x, y, height));
    quad(corners, object, true)
}

/// A square sheet at a height that lets `passes` through, from x = `left` to 16.
fn sheet(height: f32, left: f32, passes: Vec3) -> [Caster<'static>; 2] {
    flat(height, left, 0).map(|triangle| Caster::from(triangle).with_passes(passes))
}

fn lossless(axis: u32) -> Deep {
    Deep::new(0.0, axis).unwrap()
}

#[test]
fn v56_b06_11_light_is_multiplied_from_surface_to_surface() {
    let colours = [Vec3::new(0.8, 0.4, 0.2), Vec3::splat(0.5), Vec3::ZERO];
    let stack = [sheet(30.0, -16.0, colours[0]), sheet(20.0, -16.0, colours[1]), sheet(0.0, 0.0, colours[2])];
    let map = bake_deep(&above(), [stack.concat()], &lossless(2)).map;
    let eye = map.view().depth(map.view().world_to_eye().transform_point3(DVec3::ZERO));
    let behind = |texel, height: f32| map.transmittance(texel, eye - height);
    let (left, right) = (IVec2::new(10, 30), IVec2::new(50, 30));
    assert_eq!(behind(left, 30.0), Vec3::ONE, "a surface does not shadow itself");
    assert_eq!(behind(left, 25.0), colours[0]);
    assert!((behind(left, 10.0) - colours[0] * 0.5).abs().max_element() < 1e-6);
    assert!((behind(left, -50.0) - colours[0] * 0.5).abs().max_element() < 1e-6);
    assert_eq!(behind(right, -1.0), Vec3::ZERO, "opaque behind the third");
    assert_eq!(map.steps(right).len(), 3);
}

#[test]
fn what_passes_is_each_triangle_s_own_and_is_kept_within_0_and_1() {
    // The two triangles of one sheet, split along the diagonal from (−16, −16) to (16, 16).
    let behind = |passes: [f32; 2]| {
        let [below, over] = flat(10.0, -16.0, 0).map(Caster::from);
        let halves = [below.with_passes(Vec3::splat(passes[0])), over.with_passes(Vec3::splat(passes[1]))];
        let map = bake_deep(&above(), [halves], &lossless(1)).map;
        [IVec2::new(50, 55), IVec2::new(10, 5)].map(|texel| map.transmittance(texel, f32::INFINITY).x)
    };
    assert_eq!(behind([0.5, 0.25]), [0.5, 0.25]);
    assert_eq!(behind([7.0, -1.0]), [1.0, 0.0]);
    assert_eq!(behind([f32::NAN, 1.0]), [0.0, 1.0]);
    let shade =
        bake_deep(&above(), [flat(10.0, -16.0, 0).map(|t| Caster::from(t).with_opacity(0.75))], &lossless(1)).map;
    assert_eq!(shade.transmittance(IVec2::ONE, f32::INFINITY), Vec3::splat(0.25));
}

#[test]
fn the_order_of_triangles_changes_no_bit_of_a_deep_map() {
    // Three sheets in one place, of one object and of two.
    let tints = [(0, Vec3::new(0.3, 0.7, 0.9)), (0, Vec3::new(0.7, 0.1, 0.55)), (1, Vec3::new(0.9, 0.33, 0.21))];
    let sheets: Vec<Caster> = tints
        .iter()
        .flat_map(|&(object, passes)| flat(10.0, -3.3, object).map(|t| Caster::from(t).with_passes(passes)))
        .collect();
    let map = |order: &[usize]| bake_deep(&above(), [order.iter().map(|&i| sheets[i])], &Deep::default()).map;
    let forward = map(&[0, 1, 2, 3, 4, 5]);
    for order in [[5, 4, 3, 2, 1, 0], [2, 3, 0, 1, 4, 5], [4, 1, 2, 0, 5, 3]] {
        assert_eq!(map(&order), forward);
    }
}

#[test]
fn a_deep_map_of_opaque_things_is_the_first_depth() {
    let view = above();
    let mut things = cuboid(Vec3::new(-12.0, -12.0, -2.0), Vec3::new(12.0, 12.0, 0.0), 0, false);
    things.extend(ball(Vec3::new(2.0, 1.0, 8.0), 6.0, 12, 1).into_iter().map(|(triangle, _)| triangle));
    let first = bake(&view, things.iter().copied(), &First, Cull::None).map;
    let deep = bake_deep(&view, [things], &lossless(1)).map;
    for texel in TexelRect::of_size(view.size()).texels() {
        assert_eq!(deep.depth(texel), first.depth(texel), "{texel}");
        assert!(deep.steps(texel).iter().all(|step| step.passes == Vec3::ZERO), "{texel}");
    }
}

#[test]
fn ext_3_half_a_texel_under_a_sheet_is_half_dark() {
    // The sheet's edge runs through the middle of column 32.
    let map = bake_deep(&above(), [sheet(10.0, 0.25, Vec3::ZERO)], &lossless(4)).map;
    let light_behind = |x| map.transmittance(IVec2::new(x, 20), f32::INFINITY).x;
    assert_eq!([31, 32, 33].map(light_behind), [1.0, 0.5, 0.0]);
}

#[test]
fn ext_2_moments_share_the_light_between_them() {
    let view = above();
    let moments: Vec<[Triangle; 2]> = (0..4u8).map(|i| flat(10.0, f32::from(i) * 4.0, 0)).collect();
    let map = bake_deep(&view, moments.iter().copied(), &lossless(1)).map;
    let light_behind = |world: f32| map.transmittance(IVec2::new(((world + 16.0) * 2.0) as i32, 9), 1e9).x;
    assert_eq!([-1.0, 1.0, 5.0, 9.0, 13.0].map(light_behind), [1.0, 0.75, 0.5, 0.25, 0.0]);
    let none = bake_deep(&view, Vec::<[Caster; 1]>::new(), &lossless(1)).map;
    assert!(TexelRect::of_size(view.size()).texels().all(|texel| none.steps(texel).is_empty()));
    // A single depth per texel sees each moment in its own fraction of the texels.
    let maps: Vec<_> = moments.iter().map(|moment| bake(&view, *moment, &First, Cull::None).map).collect();
    let drawn = mix_moments(&view, &maps, 3);
    let dark = |from: i32, to: i32| {
        let all: Vec<IVec2> = TexelRect::new(IVec2::new(from, 0), IVec2::new(to, 64)).texels().collect();
        all.iter().filter(|texel| drawn.depth(**texel).is_finite()).count() as f64 / all.len() as f64
    };
    for (from, to, share) in [(0, 32, 0.0), (32, 40, 0.25), (40, 48, 0.5), (48, 56, 0.75), (56, 64, 1.0)] {
        assert!((dark(from, to) - share).abs() < 0.08, "columns {from} to {to}: {}", dark(from, to));
    }
    assert_eq!(Raw::from(&drawn), Raw::from(&mix_moments(&view, &maps, 3)), "the same again");
    assert_ne!(Raw::from(&drawn), Raw::from(&mix_moments(&view, &maps, 4)), "another seed");
    assert_eq!(mix_moments::<Raw>(&view, &[], 3).tile_count(), 0);
}

#[test]
fn threads_change_no_bit_of_a_deep_map() {
    let view = above().with_size(UVec2::splat(80)).unwrap();
    let glass: Vec<Caster> = (0..6u8)
        .flat_map(|i| sheet(f32::from(i), f32::from(i) * 3.3 - 14.0, Vec3::new(0.9, 0.8, 0.7)))
        .chain(ball(Vec3::ZERO, 9.0, 10, 1).into_iter().map(|(triangle, _)| triangle.into()))
        .collect();
    let with = |threads: usize| -> DeepMap {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
        pool.install(|| bake_deep(&view, [glass.iter().copied()], &Deep::default()).map)
    };
    assert_eq!(with(1), with(3));
}

#[test]
fn bad_bounds_are_refused_by_value() {
    assert_eq!(Deep::new(1.0, 4).unwrap_err().to_string(), "deep map error bound 1 is not within 0..1");
    assert!(Deep::new(f32::NAN, 4).is_err() && Deep::new(-0.1, 4).is_err());
}

#[test]
fn depths_that_are_none_are_no_surfaces_of_a_deep_map() {
    // Along (1, 1, 1), corners that are each within bounds lie beyond them together.
    let far = 9e29f32;
    let corners = [Vec3::new(far, far, 0.0), Vec3::new(far, 0.0, far), Vec3::new(0.0, far, far), Vec3::splat(far)];
    let view = View::orthographic(DVec3::ZERO, DVec3::ONE, DVec3::Y, 1e30, 0.0, 1e31, UVec2::splat(16)).unwrap();
    let map = bake_deep(&view, [quad(corners, 0, true)], &lossless(1)).map;
    for texel in TexelRect::of_size(view.size()).texels() {
        assert!(map.steps(texel).iter().all(|step| step.depth < 1e30), "{texel}");
    }
}

#[test]
fn a_film_says_place_by_place_what_passes() {
    // From 1 at the left to 0 at the right of a sheet of 32 units, and less blue; over its left half a pane that lets half pass.
    let uvs = [Vec2::Y, Vec2::ONE, Vec2::X, Vec2::ZERO];
    let clear = |u: f32| Vec3::new(1.0, 1.0, 0.5) * (1.0 - u);
    let film = |at: &MaskPlace| clear(at.uv.x as f32);
    let sheet =
        quad([(-16.0, -16.0), (16.0, -16.0), (16.0, 16.0), (-16.0, 16.0)].map(|(x, y)| Vec3::new(x, y, 10.0)), 1, true);
    let corners = [[uvs[0], uvs[1], uvs[2]], [uvs[0], uvs[2], uvs[3]]];
    let filmed: Vec<_> =
        sheet.into_iter().zip(corners).map(|(t, uvs)| Caster::from(t).with_uvs(uvs).with_film(&film)).collect();
    assert!(filmed.iter().all(Caster::is_transparent), "whatever `passes` says");
    let pane = flat(20.0, 0.0, 0).map(|triangle| Caster::from(triangle).with_passes(Vec3::splat(0.5)));
    let map = bake_deep(&above(), [[&pane[..], &filmed].concat()], &lossless(4)).map;
    for x in 0..64 {
        let u = (x as f32 + 0.5) / 64.0;
        let expected = clear(u) * if x < 32 { 1.0 } else { 0.5 };
        let found = map.transmittance(IVec2::new(x, 30), f32::INFINITY);
        assert!((found - expected).abs().max_element() < 1e-5, "{x}: {found} {expected}");
    }
    // Beyond 0..=1 and NaN are as elsewhere, and holes stay holes.
    for (says, passes) in [(7.0, 1.0), (-1.0, 0.0), (f32::NAN, 0.0)] {
        let film = |_: &MaskPlace| Vec3::splat(says);
        let hole = |at: &MaskPlace| at.uv.x > 0.5;
        let casters = filmed.iter().map(|caster| caster.with_film(&film).with_mask(&hole));
        let map = bake_deep(&above(), [casters], &lossless(1)).map;
        let behind = [10, 50].map(|x| map.transmittance(IVec2::new(x, 30), f32::INFINITY).x);
        assert_eq!(behind, [1.0, passes], "{says}");
    }
}
