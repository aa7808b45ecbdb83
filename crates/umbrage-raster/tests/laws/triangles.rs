//! Coverage of single triangles against exact arithmetic (design decision 4).

use crate::oracle::{bins, clearance, covers, each_in_tile, fragments, sample, snapped, solid, texel_view};
use crate::scenes::{samplings, sizes};
use glam::{IVec2, UVec2, Vec3};
use proptest::prelude::*;
use umbrage_plane::{Sampling, TexelRect};

/// A coordinate on the snapping grid, from within a texel to half the guard band; often a quarter texel, where samples lie on edges and corners.
fn coordinate() -> impl Strategy<Value = f32> {
    prop_oneof![
        (-160_i32..160).prop_map(|quarters| quarters as f32 / 4.0),
        (-160_i32..160).prop_map(|quarters| quarters as f32 / 4.0),
        (-1024_i32..1024).prop_map(|steps| steps as f32 / 256.0),
        (-8192_i32..8192).prop_map(|steps| steps as f32 / 256.0),
        (-2_000_i32..2_000).prop_map(|texels| texels as f32),
        (-1_048_576_i32..1_048_576).prop_map(|texels| texels as f32),
    ]
}

fn corner() -> impl Strategy<Value = Vec3> {
    (coordinate(), coordinate(), -90_f32..90.0).prop_map(Vec3::from)
}

/// Any triangle; a tiny one somewhere; a sliver.
fn triangle() -> impl Strategy<Value = [Vec3; 3]> {
    let step = || (-300_i32..300).prop_map(|steps| steps as f32 / 256.0);
    let offset = move || (step(), step()).prop_map(|(x, y)| Vec3::new(x, y, 0.5));
    let near = (-30_i32..30, -30_i32..30).prop_map(|(x, y)| Vec3::new(x as f32 / 2.0, y as f32 / 2.0, -5.0));
    prop_oneof![
        [corner(), corner(), corner()],
        (near, offset(), offset()).prop_map(|(a, b, c)| [a, a + b, a + c]),
        (corner(), corner(), offset()).prop_map(|(a, b, c)| {
            // Past 2¹⁶ an f32 has no room for the offset's 1/256ths.
            let grid = |v: f32| (v * 256.0).round() / 256.0;
            [a, b, Vec3::new(grid(b.x + c.x), grid(b.y + c.y), -3.0)]
        }),
    ]
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(12_000))]

    #[test]
    fn x2_coverage_is_the_exact_top_left_rule(
        size in sizes(), sampling in samplings(), corners in triangle(), first in 0_usize..3,
    ) {
        let view = texel_view(size, sampling);
        let exact = corners.map(|corner| snapped(size, corner));
        // The second triangle is the first with its corners in another order.
        let other = [corners[first], corners[(first + 2) % 3], corners[(first + 1) % 3]];
        let bins = bins(&view, [solid(corners), solid(other)]);
        let found = fragments(&bins);
        for texel in TexelRect::of_size(size).texels() {
            let facets = found.get(&(texel.y, texel.x)).map_or(&[][..], Vec::as_slice);
            let expected = if covers(exact, sample(sampling, texel)) { 2 } else { 0 };
            prop_assert_eq!(facets.len(), expected, "texel {}", texel);
            prop_assert!(expected == 0 || facets[0].facing != facets[1].facing);
        }
        let stats = bins.stats();
        prop_assert_eq!((stats.given, stats.clipped), (2, 0));
        prop_assert!(found.is_empty() || stats.kept() == 2);
    }

}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(2_500))]

    #[test]
    fn triangles_beyond_the_guard_band_are_exact_away_from_their_edges(
        sampling in samplings(),
        corners in [
            [-16_777_216_i32..16_777_216, -16_777_216..16_777_216],
            [-16_777_216..16_777_216, -16_777_216..16_777_216],
            [-40_000..40_000, -40_000..40_000],
        ],
    ) {
        let size = UVec2::new(67, 41);
        let view = texel_view(size, sampling);
        let corners = corners.map(|[x, y]| Vec3::new(x as f32, y as f32, -7.0));
        let exact = corners.map(|corner| snapped(size, corner));
        prop_assume!(corners[0] != corners[1]);
        let found = fragments(&bins(&view, [solid(corners)]));
        for texel in TexelRect::of_size(size).texels() {
            let at = sample(sampling, texel);
            // A new corner on the guard band is off by half a snapping step at most in each direction.
            if clearance(exact, at) > 1.0 {
                prop_assert_eq!(found.contains_key(&(texel.y, texel.x)), covers(exact, at), "texel {}", texel);
            }
        }
    }
}

#[test]
fn largest_maps_are_exact_tile_by_tile() {
    for (side, sampling) in
        [(16_384, Sampling::Centre), (32_768, Sampling::Centre), (16_384, Sampling::Jittered { seed: 5 })]
    {
        let size = UVec2::splat(side);
        let half = side as f32 / 2.0;
        let view = texel_view(size, sampling);
        let triangles = [
            [Vec3::new(-half, -half, -2.0), Vec3::new(half, -half, -2.0), Vec3::new(half, half, -2.0)],
            [Vec3::new(-half, half, -3.0), Vec3::new(half, half - 1.75, -3.0), Vec3::new(half, half - 1.5, -3.0)],
            [Vec3::new(-900_000.0, 3.25, -4.0), Vec3::new(800_000.0, -70.5, -4.0), Vec3::new(12.0, 700_000.0, -4.0)],
        ];
        let exact = triangles.map(|corners| corners.map(|corner| snapped(size, corner)));
        let bins = bins(&view, triangles.map(solid));
        assert_eq!(bins.tiles(), UVec2::splat(side / 32));
        let last = side / 32 - 1;
        for tile in [[0, 0], [last, 0], [0, last], [last, last], [last / 2, last / 2], [last / 2 + 1, 0], [3, last - 3]]
        {
            let tile = UVec2::from(tile);
            let mut found = Vec::new();
            each_in_tile(&bins, tile, |texel, facet| found.push((facet.triangle, texel.y, texel.x)));
            let origin = (tile * 32).as_ivec2();
            let mut expected = Vec::new();
            for (index, corners) in exact.iter().enumerate() {
                for texel in TexelRect::new(origin, origin + 32).texels() {
                    if covers(*corners, sample(sampling, texel)) {
                        expected.push((index as u32, texel.y, texel.x));
                    }
                }
            }
            assert_eq!(found, expected, "{side} {sampling:?} {tile}");
        }
    }
}

#[test]
fn samples_on_the_outline_belong_to_top_and_left() {
    let size = UVec2::new(8, 8);
    let view = texel_view(size, Sampling::Centre);
    // A square from sample (1, 1) to sample (4, 4): its right column and bottom row belong to others.
    let [a, b, c, d] = [(1.5, 1.5), (1.5, 4.5), (4.5, 4.5), (4.5, 1.5)].map(|(x, y)| Vec3::new(x - 4.0, 4.0 - y, -2.0));
    let found = fragments(&bins(&view, [solid([a, b, c]), solid([a, c, d])]));
    let expected: Vec<_> = TexelRect::new(IVec2::ONE, IVec2::splat(4)).texels().map(|at| (at.y, at.x)).collect();
    assert_eq!(found.keys().copied().collect::<Vec<_>>(), expected);
    assert!(found.values().all(|facets| facets.len() == 1));
}

#[test]
fn crossings_a_hair_from_a_sample_fall_on_the_right_side() {
    // Edges over two rows that pass the second row's first sample at all distances from 0 to a few 512ths of a snapping step.
    let size = UVec2::new(4, 4);
    let view = texel_view(size, Sampling::Centre);
    let world = |x: i32, y: i32| Vec3::new(x as f32 / 256.0 - 2.0, 2.0 - y as f32 / 256.0, -2.0);
    for (dx, x, y) in (-2..=2).flat_map(|dx| (126..131).flat_map(move |x| (-136..-116).map(move |y| (dx, x, y)))) {
        for third in [world(-2000, 100), world(3000, 31)] {
            let corners = [world(x, y), world(x + dx, y + 512), third];
            let exact = corners.map(|corner| snapped(size, corner));
            let found = fragments(&bins(&view, [solid(corners)]));
            for texel in TexelRect::of_size(size).texels() {
                let expected = covers(exact, sample(Sampling::Centre, texel));
                assert_eq!(found.contains_key(&(texel.y, texel.x)), expected, "{dx} {x} {y} {texel}");
            }
        }
    }
}
