//! Bad input, culling, and what is counted.

use crate::oracle::{bins, fragments, solid, texel_view};
use glam::{DVec3, UVec2, Vec3};
use proptest::prelude::*;
use umbrage_plane::{Facing, Sampling, TexelRect, View};
use umbrage_raster::{Bins, Cull, Stats, Triangle};

const SIZE: UVec2 = UVec2::new(16, 16);

fn lamp() -> View {
    View::perspective(DVec3::ZERO, DVec3::NEG_Z, DVec3::Y, 1.5, 0.5, 50.0, SIZE).unwrap()
}

fn fine() -> [Vec3; 3] {
    [Vec3::new(-3.0, -3.0, -5.0), Vec3::new(3.0, -3.0, -5.0), Vec3::new(0.0, 3.0, -5.0)]
}

#[test]
fn triangles_that_are_no_triangles_are_counted_and_skipped() {
    let view = lamp();
    let mut triangles = Vec::new();
    for bad in [f32::NAN, f32::INFINITY, f32::NEG_INFINITY, 1e30, -1e30, f32::MAX] {
        for place in 0..9 {
            let mut corners = fine();
            corners[place / 3][place % 3] = bad;
            triangles.push(solid(corners));
        }
    }
    let [a, b, _] = fine();
    let flat = [[a; 3], [a, b, b], [a, b, a + (b - a) * 0.5], [a, (a + b) * 0.5, b]];
    triangles.extend(flat.map(solid));
    // Ten thousandths of a texel across: all corners snap to one point.
    triangles.push(solid(fine().map(|corner| corner * Vec3::new(1e-5, 1e-5, 1.0))));
    triangles.push(solid(fine()));
    let bins = bins(&view, triangles);
    let expected = Stats { given: 60, not_finite: 54, zero_area: 5, ..Stats::default() };
    assert_eq!(bins.stats(), expected);
    assert_eq!(bins.facet(58), None);
    let facet = bins.facet(59).expect("the last triangle is a good one, and skipped ones count");
    assert!(fragments(&bins).values().all(|facets| *facets == [facet]));
    assert_eq!(bins.facets().collect::<Vec<_>>(), [facet]);
}

#[test]
fn sides_are_culled_and_sheets_are_not() {
    use Facing::{Back, Front};
    let view = texel_view(SIZE, Sampling::Centre);
    let [a, b, c] = fine();
    let triangles = [([a, b, c], false), ([a, c, b], false), ([b, c, a], true), ([c, b, a], true)]
        .map(|(corners, sheet)| Triangle::new(corners, 3, sheet));
    let kept = |cull| {
        let bins = Bins::new(&view, TexelRect::of_size(SIZE), cull, triangles);
        let kept: Vec<_> = bins.facets().map(|facet| (facet.triangle, facet.facing)).collect();
        assert_eq!(bins.stats().culled, 4 - kept.len() as u64);
        kept
    };
    assert_eq!(kept(Cull::None), [(0, Front), (1, Back), (2, Front), (3, Back)]);
    assert_eq!(kept(Cull::Front), [(1, Back), (2, Front), (3, Back)]);
    assert_eq!(kept(Cull::Back), [(0, Front), (2, Front), (3, Back)]);
}

#[test]
fn each_triangle_is_counted_once() {
    let view = texel_view(SIZE, Sampling::Centre);
    let moved = |x: f32, y: f32| solid(fine().map(|corner| corner + Vec3::new(x, y, 0.0)));
    let tiny = |x: f32, y: f32| solid(fine().map(|corner| corner * Vec3::new(0.05, 0.05, 1.0) + Vec3::new(x, y, 0.0)));
    // A texel's corner is 0.5 from its sample; a tenth of that is the tiny triangle's reach.
    let bins = bins(&view, [moved(0.0, 0.0), moved(30.0, 0.0), moved(0.0, -30.0), tiny(0.0, 0.0), tiny(0.5, 0.5)]);
    assert_eq!(bins.stats(), Stats { given: 5, outside: 2, missed: 1, ..Stats::default() });
    assert_eq!(bins.stats().kept(), 2);
    assert!(!bins.is_empty_tile(UVec2::ZERO));
    assert!(bins.is_empty_tile(UVec2::new(1, 0)));
    bins.tile(UVec2::new(u32::MAX, 0), |_, _| panic!("there is no such tile"));
}

#[test]
fn nothing_gives_nothing() {
    let view = texel_view(UVec2::new(1, 65), Sampling::Centre);
    assert_eq!(bins(&view, []).stats(), Stats::default());
    assert_eq!(bins(&view, []).tiles(), UVec2::new(1, 3));
    let empty = Bins::new(&view, TexelRect::EMPTY, Cull::None, [solid(fine())]);
    assert_eq!((empty.stats().outside, empty.facets().len()), (1, 0));
}

fn anything() -> impl Strategy<Value = f32> {
    prop_oneof![
        any::<f32>(),
        any::<i16>().prop_map(|v| f32::from(v) / 64.0),
        (-150_i32..150).prop_map(|exponent| 2_f32.powi(exponent)),
        Just(0.0),
    ]
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(20_000))]

    #[test]
    fn no_input_panics_and_all_is_accounted_for(
        corners in proptest::array::uniform9(anything()), near in prop_oneof![Just(0.5), Just(1e-300), Just(1e-9)],
        perspective in any::<bool>(), seed in any::<u32>(),
    ) {
        let view = if perspective {
            View::perspective(DVec3::ONE, DVec3::NEG_Z, DVec3::Y, 1.5, near, 50.0, SIZE)
        } else {
            View::orthographic(DVec3::ONE, DVec3::NEG_Z, DVec3::Y, near, 0.0, 50.0, SIZE)
        };
        let view = view.unwrap().with_sampling(Sampling::Jittered { seed });
        let [a, b, c, d, e, f, g, h, i] = corners;
        let bins = bins(&view, [solid([Vec3::new(a, b, c), Vec3::new(d, e, f), Vec3::new(g, h, i)])]);
        let stats = bins.stats();
        prop_assert_eq!(stats.kept(), bins.facets().len() as u64);
        prop_assert!(stats.clipped <= stats.kept() && stats.before_near <= stats.kept());
        for facet in bins.facets() {
            prop_assert!(facet.plane.c.is_finite() && facet.plane.dx.is_finite() && facet.plane.dy.is_finite());
        }
        prop_assert!(fragments(&bins).values().all(|facets| facets.len() == 1));
    }
}
