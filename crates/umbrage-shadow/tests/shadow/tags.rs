//! Object tags (Hourcade & Nicolas 1985; WM94-16).

use glam::{DVec3, UVec2, Vec3};
use umbrage_depth::TagMap;
use umbrage_plane::{Rules, SurfacePoint, View};
use umbrage_sample::Key;
use umbrage_shadow::{Shadow, Tags};

#[test]
fn wm94_16_own_and_empty_texels_are_lit_others_dark_and_the_rules_answer_outside() {
    let view = View::orthographic(DVec3::Z * 9.0, DVec3::ZERO, DVec3::Y, 1.0, 1.0, 20.0, UVec2::new(3, 1));
    let view = view.unwrap().with_rules(Rules::SPOT);
    let tags = Tags(TagMap::new(view, [Some(4), None, Some(5)]));
    let ask = |x: f32| {
        let point = SurfacePoint { object: 4, ..SurfacePoint::at(Vec3::new(x, 0.0, 0.0), Vec3::Z) };
        tags.fraction(&point, Key::new(0, 0, 0))
    };
    assert_eq!([-2.0, 0.0, 2.0, 4.0].map(ask), [0.0, 0.0, 1.0, 1.0]);
}
