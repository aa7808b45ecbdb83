//! Windows, the order of calls, threads: nothing of that changes a bit (design decisions 1 and 2).

use crate::oracle::{Camera, bins, each_in_tile};
use crate::scenes::{ball, samplings, sizes, turns};
use glam::{DVec3, IVec2, Quat, UVec2, Vec3};
use proptest::prelude::*;
use umbrage_plane::{Facet, Sampling, TexelRect, View};
use umbrage_raster::{Bins, Coverage, Cull, RUN, Stats, Triangle, each_fragment, each_run};

fn camera(size: UVec2) -> View {
    Camera::new(DVec3::new(1.0, 2.0, 6.0), DVec3::ZERO, 0.5, true, size).view(1.0, 100.0)
}

fn bumpy(turn: Quat) -> Vec<Triangle> {
    ball(Vec3::ZERO, &[2.0, 1.2, 2.6, 0.7, 1.9], 9, 11, turn)
}

type Tile = Vec<(Facet, Coverage)>;

fn tile(bins: &Bins, index: u32) -> Tile {
    let mut found = Vec::new();
    let across = bins.tiles().x;
    bins.tile(UVec2::new(index % across, index / across), |facet, coverage| found.push((*facet, *coverage)));
    found
}

fn texels(bins: &Bins) -> Vec<(u32, i32, i32)> {
    let tiles = bins.tiles();
    let mut found = Vec::new();
    for index in 0..tiles.x * tiles.y {
        let tile = UVec2::new(index % tiles.x, index / tiles.x);
        each_in_tile(bins, tile, |texel, facet| found.push((facet.triangle, texel.y, texel.x)));
    }
    found.sort_unstable();
    found
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(300))]

    #[test]
    fn windows_add_up_to_the_whole(
        size in sizes(), sampling in samplings(), turn in turns(), cut in (0.0_f64..1.0, 0.0_f64..1.0),
    ) {
        let view = camera(size).with_sampling(sampling);
        let whole = bins(&view, bumpy(turn));
        let at = (size.as_dvec2() * DVec3::new(cut.0, cut.1, 0.0).truncate()).as_ivec2();
        let low = IVec2::splat(-7);
        let high = size.as_ivec2() + 9;
        let windows = [
            TexelRect::new(low, at),
            TexelRect::new(IVec2::new(at.x, low.y), IVec2::new(high.x, at.y)),
            TexelRect::new(IVec2::new(low.x, at.y), IVec2::new(at.x, high.y)),
            TexelRect::new(at, high),
        ];
        let mut parts = Vec::new();
        for window in windows {
            let part = Bins::new(&view, window, Cull::None, bumpy(turn));
            prop_assert_eq!(part.tiles(), whole.tiles());
            for (triangle, y, x) in texels(&part) {
                prop_assert!(window.contains(IVec2::new(x, y)));
                prop_assert_eq!(part.facet(triangle), whole.facet(triangle));
                parts.push((triangle, y, x));
            }
        }
        parts.sort_unstable();
        prop_assert_eq!(parts, texels(&whole));
    }
}

#[test]
fn no_order_of_calls_and_no_thread_changes_a_tile() {
    for sampling in [Sampling::Centre, Sampling::Jittered { seed: 77 }] {
        let view = camera(UVec2::new(193, 131)).with_sampling(sampling);
        let bins = bins(&view, bumpy(Quat::from_rotation_x(0.4)));
        let count = bins.tiles().x * bins.tiles().y;
        let ordered: Vec<Tile> = (0..count).map(|index| tile(&bins, index)).collect();
        assert!(ordered.iter().map(Vec::len).sum::<usize>() > 100);
        // 35 tiles: 11 is prime to them, so every tile comes up once.
        for step in 0..count {
            let index = step * 11 % count;
            assert_eq!(tile(&bins, index), ordered[index as usize]);
        }
        std::thread::scope(|scope| {
            for start in 0..4 {
                let (bins, ordered) = (&bins, &ordered);
                scope.spawn(move || {
                    for step in 0..count {
                        let index = (start * 9 + step) % count;
                        assert_eq!(tile(bins, index), ordered[index as usize]);
                    }
                });
            }
        });
    }
}

#[test]
fn triangles_are_set_up_the_same_alone_among_others_and_by_any_thread() {
    // Small and large ones, behind the eye and around it, and some that are none, over several blocks whose last is not full.
    let mut triangles = Vec::new();
    for (radius, turn) in [(2.0, 0.1), (9.0, 0.2), (0.3, 0.3), (40.0, 0.4)] {
        triangles.extend(ball(Vec3::ZERO, &[radius, radius * 0.7, radius * 1.1], 33, 47, Quat::from_rotation_z(turn)));
    }
    for (index, triangle) in triangles.iter_mut().enumerate().step_by(11) {
        let next = triangle.corners[(index + 1) % 3];
        let corner = &mut triangle.corners[index % 3];
        match index % 5 {
            0 => corner.x = f64::NAN,
            1 => corner.y = 1e30,
            2 => corner.z = -1e29,
            3 => *corner = next,
            _ => corner.x *= 1e9,
        }
    }
    assert!(triangles.len() > 11_000 && !triangles.len().is_multiple_of(1024));
    for perspective in [true, false] {
        let half = if perspective { 0.5 } else { 5.0 };
        let eye = DVec3::new(1.0, 2.0, 6.0);
        let view = Camera::new(eye, DVec3::ZERO, half, perspective, UVec2::new(193, 131)).view(1.0, 100.0);
        let made = |threads: usize| {
            let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
            pool.install(|| bins(&view, triangles.iter().copied()))
        };
        let one = made(1);
        assert!(one.stats().kept() > 1000 && one.facets().len() as u64 == one.stats().kept());
        // A triangle among eight of a block is not set up the way that one alone is.
        let (mut facets, mut stats) = (Vec::new(), Stats::default());
        for (triangle, index) in triangles.iter().zip(0..) {
            let alone = bins(&view, [*triangle]);
            stats += alone.stats();
            let facet = alone.facet(0).map(|facet| Facet { triangle: index, ..facet });
            assert_eq!(one.facet(index), facet);
            facets.extend(facet);
        }
        assert_eq!(one.stats(), stats);
        assert!(one.facets().eq(facets.iter().copied()));
        let count = one.tiles().element_product();
        for several in [2, 5].map(made) {
            assert_eq!(several.stats(), stats);
            assert!(several.facets().eq(facets.iter().copied()));
            assert!((0..count).all(|index| tile(&several, index) == tile(&one, index)));
        }
    }
}

#[test]
fn bins_that_are_refilled_are_those_of_the_new_triangles_alone() {
    // Every fifth begins behind the eye and is cut; more, fewer and none, over several blocks and less than one.
    let mut many = ball(Vec3::ZERO, &[2.0, 1.4, 2.2], 33, 47, Quat::from_rotation_z(0.4));
    many.iter_mut().step_by(5).for_each(|triangle| triangle.corners[0] = DVec3::new(1.0, 2.2, 9.0));
    let fills = [&many[..], &many[..1500], &[], &bumpy(Quat::IDENTITY), &many[700..], &many[..1024]];
    let view = camera(UVec2::new(193, 131));
    for threads in [1, 2] {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
        pool.install(|| {
            let (mut refilled, mut clipped) = (bins(&view, many[..100].iter().copied()), 0);
            for (index, triangles) in fills.iter().enumerate() {
                refilled.refill(triangles.iter().copied());
                let new = bins(&view, triangles.iter().copied());
                clipped += new.stats().clipped;
                assert_eq!(refilled.stats(), new.stats(), "fill {index}");
                assert!(refilled.facets().eq(new.facets()), "fill {index}");
                let count = new.tiles().element_product();
                assert!((0..count).all(|at| tile(&refilled, at) == tile(&new, at)), "fill {index}");
            }
            assert!(clipped > 500, "{clipped} triangles are cut");
        });
    }
}

#[test]
fn runs_are_the_fragments_eight_at_a_time() {
    for sampling in [Sampling::Centre, Sampling::Jittered { seed: 77 }] {
        let view = camera(UVec2::new(193, 131)).with_sampling(sampling);
        let bins = bins(&view, bumpy(Quat::from_rotation_x(0.4)));
        let mut counted = 0;
        for at in TexelRect::of_size(bins.tiles()).texels() {
            bins.tile(at.as_uvec2(), |facet, coverage| {
                let (mut single, mut runs) = (Vec::new(), Vec::new());
                each_fragment(&view, at * 32, facet, coverage, |cell, _, key| single.push((cell, key.to_bits())));
                each_run(&view, at * 32, facet, coverage, |first, keys| {
                    assert!(first % RUN == 0 && keys.iter().any(|key| !key.is_nan()));
                    let covered = (first..).zip(keys).filter(|(_, key)| !key.is_nan());
                    runs.extend(covered.map(|(cell, key)| (cell, key.to_bits())));
                });
                runs.sort_unstable();
                assert_eq!(runs, single);
                assert_eq!(coverage.count() as usize, single.len());
                counted += single.len();
            });
        }
        assert!(counted > 10_000, "{counted} fragments");
    }
}
