//! What an explanation lists adds up to the answer.

use glam::{DVec3, UVec2, Vec3};
use umbrage_depth::Raw;
use umbrage_plane::{Bias, SurfacePoint, View};
use umbrage_sample::{AnyPattern, EveryTexel, InsideQuadWarp, Jittered, Key, Tent};
use umbrage_shadow::{Biased, Conditional, Filter, OnPlane, Pcf, Shadow, ShadowMap, VirtualWhen, Williams, presets};

/// A lamp above a floor with steps under it, and regions all over the floor.
fn stage() -> (Raw, Vec<SurfacePoint>) {
    let size = UVec2::splat(64);
    let lamp = View::perspective(DVec3::Y * 10.0, DVec3::ZERO, DVec3::NEG_Z, 1.0, 1.0, 100.0, size).expect("a view");
    let stored = |i: u32| [9.0, 9.9, 10.0, f32::INFINITY][(i % 64 / 5 + i / 64 / 7) as usize % 4];
    let map = Raw::new(lamp, (0..64 * 64).map(stored).collect()).expect("a map");
    let points = (0..400u32).map(|i| {
        let at = Vec3::new((i % 20) as f32 * 0.55 - 5.2, 0.0, (i / 20) as f32 * 0.55 - 5.2);
        let corners = [(-0.3, -0.2), (0.3, -0.2), (0.3, 0.2), (-0.3, 0.2)].map(|(x, z)| at + Vec3::new(x, 0.0, z));
        SurfacePoint { region: i, ..SurfacePoint::at(at, Vec3::Y).with_corners(corners) }
    });
    (map, points.collect())
}

#[track_caller]
fn adds_up<F: Filter>(filter: F) {
    let (map, points) = stage();
    let (shadow, key) = (ShadowMap { filter, map }, Key::new(3, 0, 0));
    let mut asked = 0;
    for point in &points {
        let [explained] = shadow.explain(point, key).try_into().expect("one map");
        let fraction = shadow.fraction(point, key);
        assert_eq!(explained.fraction.to_bits(), fraction.to_bits());
        if explained.placed.is_some() || explained.culled.is_some() {
            continue;
        }
        let last = explained.questions.last().expect("a question");
        assert_eq!(last.share().to_bits(), fraction.to_bits(), "{point:?}");
        assert_eq!(
            explained.questions.iter().map(|question| question.taps.len() as u32).sum::<u32>(),
            explained.texels
        );
        asked += 1;
        // Each verdict follows from its own numbers.
        for tap in last.taps.iter().filter(|tap| tap.ruled.is_none()) {
            assert_eq!(tap.dark, f32::from(u8::from(tap.compared > tap.stored)));
        }
    }
    assert!(asked > 100, "{asked}");
}

#[test]
fn weights_and_verdicts_add_up_to_the_answer_bit_for_bit() {
    let pcf = |pattern: AnyPattern| Pcf::default().with_pattern(pattern).with_res_factor(1.0).with_min_size(1.0);
    adds_up(pcf(Jittered::default().into()).with_depth(Biased::world(0.05, 0.2)).with_cull(false));
    adds_up(pcf(EveryTexel.into()).with_depth(OnPlane::biased(Bias::World(0.01))).with_cull(false));
    adds_up(pcf(Tent.into()).with_cull(false));
    adds_up(pcf(InsideQuadWarp::default().into()).with_cull(false));
    adds_up(Conditional::default().with_when(VirtualWhen::Never));
    adds_up(Williams::default());
}

#[test]
fn a_second_test_is_a_second_question_on_the_tangent_plane() {
    let (map, points) = stage();
    let shadow = ShadowMap { filter: Conditional::default().with_min_size(2.0), map };
    let explained = points.iter().flat_map(|point| shadow.explain(point, Key::new(3, 0, 0)));
    let two: Vec<_> = explained.filter(|explained| explained.questions.len() == 2).collect();
    assert!(two.len() > 10 && two.iter().all(|explained| explained.on_plane), "{}", two.len());
    assert!(two.iter().all(|explained| explained.questions[1].share() == explained.fraction));
}

#[test]
fn soft_shadows_search_and_then_look() {
    let (map, points) = stage();
    let shadow = ShadowMap { filter: presets::burley().filter, map };
    let explained = points.iter().flat_map(|point| shadow.explain(point, Key::new(3, 0, 0)));
    assert!(explained.filter(|explained| explained.questions.len() >= 2).count() > 10);
}
