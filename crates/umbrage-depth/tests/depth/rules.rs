//! The laws that every depth rule obeys, and the published results: V47, V47b, V50 to V54 (W92-1 to W92-4, WM94-1 to WM94-3, T-2).

use glam::{DVec2, DVec3, IVec2, UVec2};
use proptest::prelude::*;
use std::fmt::Debug;
use umbrage_depth::{BackFace, DepthRule, First, Hit, Midpoint, ROW, RUN, Row, SameSurface, Second, Stored};
use umbrage_plane::{Affine, Facet, Facing, Kind, View};

/// One surface over a texel.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Fragment {
    zeta: f64,
    front: bool,
    sheet: bool,
    object: u32,
}

const INF: f32 = f32::INFINITY;
const AT: DVec2 = DVec2::new(3.5, 2.5);

fn front(zeta: f64) -> Fragment {
    Fragment { zeta, front: true, sheet: false, object: 0 }
}

fn back(zeta: f64) -> Fragment {
    Fragment { front: false, ..front(zeta) }
}

fn sheet(fragment: Fragment) -> Fragment {
    Fragment { sheet: true, ..fragment }
}

fn orthographic() -> View {
    View::orthographic(DVec3::Z * 9.0, DVec3::ZERO, DVec3::Y, 1.0, 0.0, 100.0, UVec2::splat(8)).unwrap()
}

fn perspective() -> View {
    View::perspective(DVec3::Z * 9.0, DVec3::ZERO, DVec3::Y, 1.0, 1.0, 100.0, UVec2::splat(8)).unwrap()
}

fn stored<R: DepthRule>(rule: &R, view: &View, fragments: &[Fragment]) -> f32 {
    let mut cell = R::EMPTY;
    for pass in 0..R::PASSES {
        for fragment in fragments {
            let facing = if fragment.front { Facing::Front } else { Facing::Back };
            let plane = Affine::constant(view.key(fragment.zeta));
            let facet = Facet { plane, facing, triangle: 0, object: fragment.object, sheet: fragment.sheet };
            rule.add(pass, &mut cell, plane.at(AT) as f32, fragment.front, &facet);
        }
    }
    rule.resolve(cell, &view.decode(), AT)
}

/// All orders of arrival, by Heap's method.
fn orders(fragments: &[Fragment]) -> Vec<Vec<Fragment>> {
    fn heap(length: usize, order: &mut Vec<Fragment>, all: &mut Vec<Vec<Fragment>>) {
        if length <= 1 {
            all.push(order.clone());
            return;
        }
        for i in 0..length {
            heap(length - 1, order, all);
            order.swap(if length.is_multiple_of(2) { i } else { 0 }, length - 1);
        }
    }
    let mut all = Vec::new();
    heap(fragments.len(), &mut fragments.to_vec(), &mut all);
    all
}

/// First, second, back face and midpoint, in every order of arrival and both projections (V54).
#[track_caller]
fn check(fragments: &[Fragment], want: [f32; 4]) {
    for order in orders(fragments) {
        for view in [orthographic(), perspective()] {
            let found = [
                stored(&First, &view, &order),
                stored(&Second, &view, &order),
                stored(&BackFace, &view, &order),
                stored(&Midpoint::default(), &view, &order),
            ];
            for (found, want) in found.into_iter().zip(want) {
                let near = found == want || (found - want).abs() <= 1e-6 * want;
                assert!(near, "{found}, want {want} of {order:?}");
            }
        }
    }
}

#[test]
fn v50_two_solids_apart() {
    check(&[front(3.0), back(5.0), front(8.0), back(9.0)], [3.0, 5.0, 5.0, 4.0]);
}

#[test]
fn v51_two_solids_in_each_other_wm94_2() {
    check(&[front(1.0), front(3.0), back(4.0), back(5.0)], [1.0, 3.0, 4.0, 2.0]);
}

#[test]
fn v52_a_two_sided_sheet_wm94_3() {
    check(&[sheet(front(2.0))], [2.0, 2.0, 2.0, INF]);
    check(&[sheet(front(2.0)), sheet(back(2.0))], [2.0, 2.0, 2.0, INF]);
}

#[test]
fn v53_an_open_sheet_passed_off_as_solid_t_9() {
    check(&[front(4.0)], [4.0, INF, INF, INF]);
}

#[test]
fn texels_without_a_fragment_hold_nothing() {
    check(&[], [INF; 4]);
}

#[test]
fn v47_w92_1_w92_2_midpoints() {
    let half = |zetas: &[f64]| {
        let fragments: Vec<_> = zetas.iter().map(|&zeta| front(zeta)).collect();
        let found: Vec<f32> =
            orders(&fragments).iter().map(|order| stored(&Midpoint::default(), &orthographic(), order)).collect();
        assert!(found.iter().all(|depth| *depth == found[0]), "{zetas:?} gave {found:?}");
        found[0]
    };
    assert_eq!(half(&[]), INF);
    assert_eq!(half(&[5.0]), INF);
    assert_eq!(half(&[9.0, 5.0]), 7.0);
    assert_eq!(half(&[20.0, 9.0, 5.0]), 7.0);
    assert_eq!(half(&[5.0, 5.0]), INF);
    assert_eq!(half(&[5.0, 5.0, 9.0]), 7.0);
    let quarter = Midpoint::default().with_ratio(0.25);
    assert_eq!(stored(&quarter, &orthographic(), &[front(9.0), front(5.0)]), 6.0);
}

/// W92-1b: halfway in world distance, not in the map's own depth, which would store ζ = 6.428571.
#[test]
fn v47b_w92_1b_midpoints_are_halfway_in_the_world_whatever_the_kind() {
    let pair = [front(5.0), back(9.0)];
    let screen = perspective().with_kind(Kind::Screen);
    let z_of = |zeta: f64| screen.decode().depth(screen.key(zeta) as f32, AT);
    assert_eq!(stored(&Midpoint::default(), &screen, &pair), z_of(7.0));
    let harmonic = 0.5 * (z_of(5.0) + z_of(9.0));
    assert!((harmonic - z_of(6.428_571)).abs() < 1e-7 && harmonic < z_of(6.9));
    let radial = perspective().with_kind(Kind::Radial);
    let along = |zeta: f64| radial.decode().depth(radial.key(zeta) as f32, AT);
    assert!((stored(&Midpoint::default(), &radial, &pair) - 0.5 * (along(5.0) + along(9.0))).abs() < 1e-6);
}

#[test]
fn w92_4_surfaces_merge_within_the_tolerance_and_by_object_if_asked() {
    let (same, near, far) = (Midpoint::default(), 5.0 * (1.0 + 0.8e-6), 5.0 * (1.0 + 1.3e-6));
    for view in [orthographic(), perspective()] {
        assert_eq!(stored(&same, &view, &[front(5.0), front(near)]), INF);
        assert!(stored(&same, &view, &[front(5.0), front(far)]) < 5.1);
        assert!(stored(&same.with_merge(0.0), &view, &[front(5.0), front(near)]) < 5.1);
    }
    let of = |object: u32, zeta: f64| Fragment { object, ..front(zeta) };
    let by_object = same.with_same(SameSurface::Object);
    for order in orders(&[of(1, 5.0), of(2, 5.0), of(1, 9.0)]) {
        assert_eq!(stored(&same, &orthographic(), &order), 7.0);
        assert_eq!(stored(&by_object, &orthographic(), &order), 5.0);
    }
    for order in orders(&[of(3, 5.0), of(3, 5.0), of(3, 9.0)]) {
        assert_eq!(stored(&by_object, &orthographic(), &order), 7.0);
    }
}

/// Up to six fragments, many of them equal or a few last bits apart, in front of and at the light's plane.
fn fragments() -> impl Strategy<Value = Vec<Fragment>> {
    let zeta = prop_oneof![
        Just(5.0f64),
        (-4i32..5).prop_map(|bits| f64::from(f32::from_bits(5f32.to_bits().wrapping_add_signed(bits)))),
        (-20i32..21).prop_map(|steps| 5.0 + f64::from(steps) * 5e-7),
        1.0f64..90.0,
    ];
    let fragment = (zeta, any::<bool>(), any::<bool>(), 0u32..3).prop_map(|(zeta, front, sheet, object)| Fragment {
        zeta,
        front,
        sheet,
        object,
    });
    proptest::collection::vec(fragment, 0..6)
}

fn ignores_order(name: &str, rule: &impl DepthRule, view: &View, fragments: &[Fragment]) {
    let first = stored(rule, view, fragments);
    assert!(!first.is_nan(), "{name}");
    for order in orders(fragments) {
        let found = stored(rule, view, &order);
        assert_eq!(found.to_bits(), first.to_bits(), "{name}: {found} or {first} of {order:?}");
    }
}

fn ignores_nan(name: &str, rule: &impl DepthRule, view: &View, fragments: &[Fragment]) {
    let with = [&[front(f64::NAN)], fragments, &[sheet(back(f64::NAN))]].concat();
    assert_eq!(stored(rule, view, &with), stored(rule, view, fragments), "{name}");
}

/// The one list of rules.
macro_rules! every_rule {
    ($law:ident $(, $more:expr)*) => {
        $law("first", &First $(, $more)*);
        $law("second", &Second $(, $more)*);
        $law("back face", &BackFace $(, $more)*);
        $law("midpoint", &Midpoint::default() $(, $more)*);
        $law("midpoint by object", &Midpoint::default().with_same(SameSurface::Object) $(, $more)*);
        $law("midpoint by surface", &Midpoint::default().with_same(SameSurface::Surface) $(, $more)*);
        $law("quarter point, unmerged", &Midpoint::default().with_ratio(0.25).with_merge(0.0).with_same(SameSurface::Depth) $(, $more)*);
    };
}

/// Hits go through the same reduction as fragments, and are clamped to the near plane as pass 1 clamps.
fn takes_hits(name: &str, rule: &impl DepthRule, view: &View, fragments: &[Fragment]) {
    let hits = fragments.iter().map(|fragment| {
        let side = if fragment.front { Hit::front(fragment.zeta) } else { Hit::back(fragment.zeta) };
        let hit = side.of_object(fragment.object);
        if fragment.sheet { hit.of_sheet() } else { hit }
    });
    let nearest = view.decode().depth(view.key(view.near()) as f32, AT);
    let (found, want) = (rule.of(view, IVec2::new(3, 2), hits), stored(rule, view, fragments).max(nearest));
    assert_eq!(found.to_bits(), want.to_bits(), "{name}: {found}, want {want} of {fragments:?}");
}

proptest! {
    #[test]
    fn hits_store_what_fragments_store(fragments in fragments()) {
        for view in [orthographic(), perspective(), perspective().with_kind(Kind::Screen), perspective().with_kind(Kind::Radial)] {
            every_rule!(takes_hits, &view, &fragments);
        }
    }

    #[test]
    fn v54_no_rule_depends_on_the_order_of_arrival(fragments in fragments()) {
        for view in [orthographic(), perspective(), perspective().with_kind(Kind::Screen), perspective().with_kind(Kind::Radial)] {
            every_rule!(ignores_order, &view, &fragments);
        }
    }

    #[test]
    fn no_rule_stores_nan(fragments in fragments()) {
        every_rule!(ignores_nan, &perspective(), &fragments);
    }

    /// WM94-2: for solids apart from each other, each of the builders stores the same.
    #[test]
    fn wm94_2_second_and_back_face_agree_on_disjoint_solids(mut zetas in proptest::collection::vec(1.0f64..90.0, 0..4)) {
        zetas.sort_by(f64::total_cmp);
        let solids: Vec<_> = zetas.chunks_exact(2).flat_map(|pair| [front(pair[0]), back(pair[1])]).collect();
        for view in [orthographic(), perspective()] {
            prop_assert_eq!(stored(&Second, &view, &solids), stored(&BackFace, &view, &solids));
        }
    }

    /// WM94-13: a scene of nothing but sheets stores the nearest.
    #[test]
    fn wm94_3_sheets_alone_store_the_first_depth(fragments in fragments()) {
        let sheets: Vec<_> = fragments.into_iter().map(sheet).collect();
        let first = stored(&First, &perspective(), &sheets);
        prop_assert_eq!(stored(&Second, &perspective(), &sheets), first);
        prop_assert_eq!(stored(&BackFace, &perspective(), &sheets), first);
    }

    /// W92-3: the nearest surface is lit and the next shadowed, without a bias (C-7).
    #[test]
    fn w92_3_midpoint_separates_the_two_nearest(fragments in fragments()) {
        let mut solid: Vec<_> = fragments.into_iter().map(|f| Fragment { sheet: false, ..f }).collect();
        for view in [orthographic(), perspective()] {
            let (first, mid) = (stored(&First, &view, &solid), stored(&Midpoint::default(), &view, &solid));
            prop_assert!(first <= mid);
            solid.retain(|f| f.zeta > f64::from(first) * (1.0 + 1.5e-6));
            prop_assert!(solid.is_empty() || stored(&First, &view, &solid) > mid);
        }
    }

    /// W92-2: at ratio 1 it is the second surface; T-2: surfaces drawn twice change nothing.
    #[test]
    fn t_2_midpoint_does_not_see_what_is_drawn_twice(mut zetas in proptest::collection::vec(1.0f64..90.0, 2..5)) {
        zetas.dedup();
        let once: Vec<_> = zetas.iter().map(|&zeta| front(zeta)).collect();
        let twice: Vec<_> = once.iter().chain(&once).copied().collect();
        for view in [orthographic(), perspective()] {
            let whole = Midpoint::default().with_ratio(1.0).with_merge(0.0).with_same(SameSurface::Depth);
            prop_assert_eq!(stored(&whole, &view, &once), stored(&Second, &view, &once));
            let mid = Midpoint::default();
            prop_assert_eq!(stored(&mid, &view, &once), stored(&mid, &view, &twice));
        }
    }
}

/// Zero has two signs and one depth: the order of equal keys must not show.
#[test]
fn v54_the_sign_of_zero_does_not_show() {
    let zeros = [front(0.0), front(-0.0), back(0.0), back(-0.0)];
    every_rule!(ignores_order, &orthographic(), &zeros);
}

#[test]
fn hits_are_made_of_places_in_the_world() {
    // 9 units below the lamp, a floor seen from above and a roof seen from inside.
    for view in [orthographic(), perspective()] {
        let floor = Hit::at(&view, DVec3::new(0.3, -0.2, 0.0), DVec3::Z);
        assert!((floor.zeta - 9.0).abs() < 1e-12 && floor.front && !floor.sheet && floor.object == 0);
        assert!(!Hit::at(&view, DVec3::new(0.3, -0.2, 4.0), DVec3::NEG_Z * 7.0).front);
        let before = Hit::front(0.5);
        let nearest = view.near().max(0.5) as f32;
        assert_eq!(First.of(&view, IVec2::ZERO, [before, floor]), nearest, "stored at the near plane");
        assert_eq!(First.of(&view, IVec2::ZERO, [Hit::front(f64::NAN), Hit::front(f64::INFINITY)]), INF);
    }
}

#[test]
fn rules_name_the_surface_they_store() {
    let names = [First.stored(), Second.stored(), BackFace.stored(), Midpoint::default().stored()];
    assert_eq!(names, [Stored::First, Stored::Second, Stored::BackFace, Stored::Midpoint]);
}

/// What one facet offers to a run of cells.
type Offer = ([f32; RUN], u32, bool, bool);

/// Keys in perspective, some of them equal, a last bit apart, or not there.
fn keys() -> impl Strategy<Value = [f32; RUN]> {
    let key = || {
        prop_oneof![
            Just(f32::NAN),
            Just(-0.25_f32),
            Just((-0.25_f32).next_up()),
            Just((-0.25_f32).next_down()),
            -0.25_f32..-0.2499,
            -1.0_f32..0.0,
        ]
    };
    proptest::array::uniform8(key())
}

fn offers() -> impl Strategy<Value = Vec<Offer>> {
    proptest::collection::vec((keys(), 0_u32..3, any::<bool>(), any::<bool>()), 0..9)
}

/// A run of cells after all passes: cell by cell, or as a whole and only as long as it is not settled.
fn run<R: DepthRule>(rule: &R, offers: &[Offer], whole: bool) -> [f32; RUN] {
    let (mut cells, mut row) = ([R::EMPTY; RUN], R::Row::all(R::EMPTY));
    for pass in 0..R::PASSES {
        if whole && pass > 0 && rule.settled(&[row]) {
            break;
        }
        for &(keys, object, front, sheet) in offers {
            let facing = if front { Facing::Front } else { Facing::Back };
            let facet = Facet { plane: Affine::constant(0.0), facing, triangle: 0, object, sheet };
            if whole {
                rule.add_run(pass, &mut row, 2 * RUN, &keys, front, &facet);
            } else {
                for (cell, key) in cells.iter_mut().zip(keys) {
                    rule.add(pass, cell, key, front, &facet);
                }
            }
        }
    }
    let cell = |lane: usize| if whole { row.get(2 * RUN + lane) } else { cells[lane] };
    std::array::from_fn(|lane| rule.resolve(cell(lane), &perspective().decode(), AT))
}

/// Offers `last` after the others, made larger than what the rule leaves out.
fn left_out<R: DepthRule<Cell: PartialEq + Debug>>(
    rule: &R,
    offers: &[Offer],
    last: Offer,
) -> Result<(), TestCaseError> {
    for pass in 0..R::PASSES {
        let mut row = R::Row::all(R::EMPTY);
        let add = |row: &mut R::Row, pass: u32, (keys, object, front, sheet): Offer| {
            let facing = if front { Facing::Front } else { Facing::Back };
            let facet = Facet { plane: Affine::constant(0.0), facing, triangle: 0, object, sheet };
            (0..ROW / RUN).for_each(|run| rule.add_run(pass, row, run * RUN, &keys, front, &facet));
        };
        for before in 0..=pass {
            for offer in offers {
                add(&mut row, before, *offer);
            }
        }
        let farthest = rule.farthest(pass, &[row; ROW]);
        let larger = last.0.map(|key| if key > farthest { key } else { farthest.next_up() });
        let mut after = row;
        add(&mut after, pass, (larger, last.1, last.2, last.3));
        for column in 0..ROW {
            prop_assert!(
                farthest == f32::INFINITY || row.get(column) == after.get(column),
                "{farthest}: {:?}",
                row.get(column)
            );
        }
    }
    Ok(())
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(2_000))]

    #[test]
    fn whole_runs_and_passes_left_out_change_no_depth(offers in offers(), merge in prop_oneof![Just(1e-6_f32), Just(0.0), Just(-1.0), Just(0.3)]) {
        let law = |name: &str, [cells, whole]: [[f32; RUN]; 2]| {
            prop_assert_eq!(cells.map(f32::to_bits), whole.map(f32::to_bits), "{}: {:?}", name, offers);
            Ok(())
        };
        law("first", [false, true].map(|whole| run(&First, &offers, whole)))?;
        law("second", [false, true].map(|whole| run(&Second, &offers, whole)))?;
        law("back face", [false, true].map(|whole| run(&BackFace, &offers, whole)))?;
        for same in [SameSurface::Depth, SameSurface::Object, SameSurface::Surface] {
            let rule = Midpoint::default().with_same(same).with_merge(merge);
            law("midpoint", [false, true].map(|whole| run(&rule, &offers, whole)))?;
        }
    }

    #[test]
    fn keys_beyond_the_farthest_change_no_cell(offers in offers(), beyond in keys(), object in 0_u32..3, front in any::<bool>(), sheet in any::<bool>()) {
        let offer = (beyond, object, front, sheet);
        left_out(&First, &offers, offer)?;
        left_out(&Second, &offers, offer)?;
        left_out(&BackFace, &offers, offer)?;
        for same in [SameSurface::Depth, SameSurface::Object, SameSurface::Surface] {
            left_out(&Midpoint::default().with_same(same), &offers, offer)?;
        }
    }

    #[test]
    fn w92_4_the_second_surface_is_the_nearest_that_does_not_coincide_with_the_first(
        offers in offers(), merge in prop_oneof![Just(1e-6_f32), Just(0.0), Just(-1.0), Just(0.3)],
    ) {
        let rule = Midpoint::default().with_merge(merge).with_ratio(1.0);
        let found = run(&rule, &offers, true);
        for (lane, found) in found.into_iter().enumerate() {
            let keys = || offers.iter().map(|offer| offer.0[lane]).filter(|key| !key.is_nan());
            let first = keys().fold(INF, f32::min);
            let apart = |key: &f32| {
                let (first, key) = (f64::from(first), f64::from(*key));
                key - first > f64::from(merge) * first.abs().max(key.abs())
            };
            let second = keys().filter(apart).fold(INF, f32::min);
            let expected = if second == INF { INF } else { (-1.0 / f64::from(second)) as f32 };
            prop_assert_eq!(found, expected, "{:?}", offers);
        }
    }
}
