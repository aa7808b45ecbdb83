//! Windows about what is looked at, and views around a light too wide for one.

use glam::{DVec2, DVec3, UVec2};
use proptest::prelude::*;
use umbrage_plane::{Kind, Place, Rules, SpotView, View};

fn spot() -> View {
    let (eye, target) = (DVec3::new(4.0, 9.0, -3.0), DVec3::new(0.5, 0.0, 0.25));
    let spot = SpotView { eye, target, full_angle_radians: 1.2, near: 1.0, far: 40.0, ..SpotView::default() };
    View::spot(SpotView { size: UVec2::new(320, 256), ..spot }).unwrap()
}

fn sun() -> View {
    let toward = DVec3::new(0.4, 1.0, 0.3);
    View::directional(toward, [DVec3::splat(-8.0), DVec3::splat(8.0)], UVec2::new(200, 256)).unwrap()
}

/// A place over a view's map in the unit square, at a share of its range.
fn place(view: &View, at: DVec2, depth: f64) -> DVec3 {
    let zeta = view.near() + (view.far() - view.near()) * depth;
    view.world_at(at * view.size().as_dvec2(), view.key(zeta))
}

prop_compose! {
    /// Places of a part of the map, from a corner on and some share of it wide, turned by an angle.
    fn patch()(low in (0.1f64..0.6, 0.1f64..0.6), size in (0.02f64..0.3, 0.02f64..0.3), turn in 0.0f64..3.0,
               within in prop::collection::vec((0.0f64..1.0, 0.0f64..1.0, 0.2f64..0.9), 3..40)) -> Vec<(DVec2, f64)> {
        let turned = DVec2::from_angle(turn);
        within.into_iter().map(|(u, v, depth)| {
            let at = DVec2::new(low.0, low.1) + 0.5 * (turned.rotate(DVec2::new(u * size.0, v * size.1)) + 0.1);
            (at.clamp(DVec2::splat(0.02), DVec2::splat(0.98)), depth)
        }).collect()
    }
}

proptest! {
    #[test]
    fn a_fitted_window_holds_what_it_is_fitted_to(patch in patch(), spotted in any::<bool>()) {
        let view = if spotted { spot() } else { sun() };
        let all: Vec<DVec3> = patch.iter().map(|(at, depth)| place(&view, *at, *depth)).collect();
        let held: Vec<DVec3> = all
            .iter()
            .copied()
            .filter(|at| view.locate(view.eye_to_texel(view.world_to_eye().transform_point3(*at)).as_vec2()) == Place::Inside)
            .collect();
        let fitted = view.fitted(all.iter().copied()).unwrap();
        prop_assert_eq!(fitted.size(), view.size());
        prop_assert!(fitted.ahead().abs_diff_eq(view.ahead(), 1e-12) && fitted.light().abs_diff_eq(view.light(), 1e-9));
        prop_assert_eq!((fitted.cone(), fitted.rules(), fitted.kind()), (view.cone(), view.rules(), view.kind()));
        let size = view.size().as_dvec2();
        for at in &held {
            let texel = fitted.eye_to_texel(fitted.world_to_eye().transform_point3(*at));
            prop_assert!(texel.cmpge(DVec2::splat(1.49)).all() && texel.cmple(size - 1.49).all(), "{}", texel);
            // The cone is where it was.
            prop_assert_eq!(fitted.locate(texel.as_vec2()), Place::Inside);
        }
        let area = |view: &View| view.texel_world(1.0).element_product();
        prop_assert!(area(&fitted) <= area(&view));
        if fitted != view {
            // Widths are eighths of an octave, and the window's corner is a whole number of them from the axis.
            let texel = fitted.texel_world(1.0);
            let steps = DVec2::new(texel.x.log2(), texel.y.log2()) * 8.0;
            prop_assert!((steps - steps.round()).abs().max_element() < 1e-9);
            let axis = fitted.eye_to_texel(DVec3::NEG_Z);
            prop_assert!((axis - axis.round()).abs().max_element() < 1e-6, "{}", axis);
            // It is not much wider than it must be: the same box on its own axes, a step of the ladder and four texels more.
            let texels: Vec<DVec2> =
                held.iter().map(|at| fitted.eye_to_texel(fitted.world_to_eye().transform_point3(*at))).collect();
            let low = texels.iter().fold(DVec2::INFINITY, |low, at| low.min(*at));
            let high = texels.iter().fold(DVec2::NEG_INFINITY, |high, at| high.max(*at));
            prop_assert!((high - low).cmpge((size - 4.0) / 1.091 - 1e-6).any() || area(&fitted) < 1e-3 * area(&view));
        }
    }

    /// What looks at the same things from a little beside keeps the places of its samples: texels of one width at multiples of it.
    #[test]
    fn a_window_that_moves_samples_the_same_places(patch in patch(), by in (-0.01f64..0.01, -0.01f64..0.01)) {
        let view = sun();
        let moved = |by: DVec2| patch.iter().map(move |(at, depth)| (*at + by, *depth)).collect::<Vec<_>>();
        let fitted = |patch: Vec<(DVec2, f64)>| view.fitted(patch.iter().map(|(at, depth)| place(&view, *at, *depth))).unwrap();
        let (a, b) = (fitted(moved(DVec2::ZERO)), fitted(moved(DVec2::new(by.0, by.1))));
        let turned = a.world_to_eye().x_axis.abs_diff_eq(b.world_to_eye().x_axis, 1e-12);
        if turned && a.texel_world(1.0).abs_diff_eq(b.texel_world(1.0), 1e-12) {
            let origin = |view: &View| view.eye_to_texel(DVec3::NEG_Z);
            let apart = origin(&a) - origin(&b);
            prop_assert!((apart - apart.round()).abs().max_element() < 1e-6, "{}", apart);
        }
    }
}

#[test]
fn nothing_to_look_at_leaves_the_window() {
    for view in [spot(), sun()] {
        assert_eq!(view.fitted([]).unwrap(), view);
        // Beside its map, nowhere, and behind it.
        let beside = place(&view, DVec2::new(-0.1, 0.4), 0.5);
        let behind = spot().light().truncate() - view.ahead() * 500.0;
        let away = [beside, DVec3::NAN, DVec3::INFINITY, if view.is_perspective() { behind } else { beside }];
        assert_eq!(view.fitted(away).unwrap(), view);
        // All of the map.
        let corners = [(0.002, 0.002), (0.998, 0.002), (0.998, 0.998), (0.002, 0.998)];
        let whole = corners.map(|(x, y)| place(&view.with_cone(None).unwrap(), DVec2::new(x, y), 0.5));
        assert_eq!(view.with_cone(None).unwrap().fitted(whole).unwrap(), view.with_cone(None).unwrap());
        // One point has a window of a few texels.
        let one = view.fitted([place(&view, DVec2::splat(0.45), 0.5)]).unwrap();
        assert!(one.texel_world(1.0).max_element() < view.texel_world(1.0).max_element() / 900.0);
    }
}

#[test]
fn five_faces_see_all_that_is_ahead() {
    for kind in [Kind::Axial, Kind::Radial, Kind::Screen] {
        let view = spot().with_kind(kind);
        let faces = view.faces_ahead().unwrap();
        let texels: u32 = faces.iter().map(|face| face.size().element_product()).sum();
        assert!(texels.abs_diff(320 * 256) < 2000, "{texels}");
        for i in 0..4000u32 {
            let unit = |k: u32| f64::from((i * 7919 + k * 104_729) % 10_007) / 10_007.0;
            let direction = DVec3::new(2.0 * unit(1) - 1.0, 2.0 * unit(2) - 1.0, -unit(3) - 1e-6);
            let at = view.eye_to_world().transform_point3(direction * 5.0);
            let own = faces.iter().max_by(|a, b| {
                let along = |view: &View| view.ahead().dot(at - view.light().truncate());
                along(a).total_cmp(&along(b))
            });
            let own = own.unwrap();
            let eye = own.world_to_eye().transform_point3(at);
            let texel = own.eye_to_texel(eye);
            assert!(texel.cmpge(DVec2::splat(-1e-9)).all() && texel.cmple(own.size().as_dvec2() + 1e-9).all());
            assert_eq!((own.rules(), own.cone()), (&Rules::AROUND, None));
            assert_eq!(own.kind(), if kind == Kind::Screen { Kind::Radial } else { kind });
            assert!(own.light().abs_diff_eq(view.light(), 1e-9));
        }
    }
    assert!(sun().faces_ahead().is_err());
}

#[test]
fn cones_are_bounds_without_a_map() {
    let view = spot();
    for i in 0..2000u32 {
        let unit = |k: u32| f64::from((i * 7919 + k * 104_729) % 10_007) / 10_007.0;
        let eye = DVec3::new(6.0 * unit(1) - 3.0, 6.0 * unit(2) - 3.0, 4.0 * unit(3) - 3.0);
        let at = view.eye_to_world().transform_point3(eye);
        let cos = -eye.z / eye.length();
        let inside = cos >= 0.6f64.cos();
        if (cos - 0.6f64.cos()).abs() > 1e-9 {
            assert_eq!(view.beyond_cone(at), !inside);
        }
        assert!(!sun().beyond_cone(at));
    }
}
