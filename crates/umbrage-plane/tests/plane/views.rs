//! How views are made: each fault is named, lights by named fields, rays through texels.

use glam::{DVec2, DVec3, UVec2, Vec3};
use umbrage_plane::{Kind, Place, Rules, Sectors, SpotView, SurfacePoint, View, ViewError, sector_views, up_for};

const SIZE: UVec2 = UVec2::splat(64);
const NAN: f64 = f64::NAN;
const INF: f64 = f64::INFINITY;

fn lamp() -> SpotView {
    SpotView {
        eye: DVec3::new(0.0, 10.0, 0.0),
        target: DVec3::ZERO,
        near: 1.0,
        far: 100.0,
        size: SIZE,
        ..SpotView::default()
    }
}

/// What is said of a lamp with one thing changed, which every way to make such a view must say alike.
fn said(change: impl Fn(&mut SpotView)) -> String {
    let mut spot = lamp();
    change(&mut spot);
    let SpotView { eye, target, up, full_angle_radians, near, far, size } = spot;
    let named = View::spot(spot).unwrap_err();
    let up = up.unwrap_or_else(|| up_for(target - eye));
    assert_eq!(
        View::perspective(eye, target, up, full_angle_radians, near, far, size).unwrap_err().to_string(),
        named.to_string()
    );
    named.to_string()
}

#[test]
fn a_size_that_cannot_be_is_named_whatever_else_it_spoils() {
    for (size, want) in [
        (UVec2::new(64, 0), "view size 64 x 0 is not within 1..=32768 texels on each side"),
        (UVec2::new(0, 64), "view size 0 x 64 is not within 1..=32768 texels on each side"),
        (UVec2::new(32_769, 1), "view size 32769 x 1 is not within 1..=32768 texels on each side"),
    ] {
        assert_eq!(said(|spot| spot.size = size), want);
        let sun = View::orthographic(DVec3::Y, DVec3::ZERO, DVec3::Z, 1.0, 0.0, 2.0, size);
        assert_eq!(sun.unwrap_err().to_string(), want);
        assert_eq!(View::directional(DVec3::Y, [DVec3::ZERO, DVec3::ONE], size).unwrap_err().to_string(), want);
        assert_eq!(View::spot(lamp()).unwrap().with_size(size).unwrap_err().to_string(), want);
    }
    assert!(View::spot(SpotView { size: UVec2::new(1, 32_768), ..lamp() }).is_ok());
}

#[test]
fn a_placement_that_cannot_be_is_named_by_its_part() {
    assert_eq!(said(|spot| spot.eye.y = NAN), "view eye [0, NaN, 0] is not finite");
    assert_eq!(said(|spot| spot.target.x = INF), "view target [inf, 0, 0] is not finite");
    assert_eq!(said(|spot| spot.up = Some(DVec3::new(0.0, 0.0, -INF))), "view up [0, 0, -inf] is not finite");
    let equal = "view eye [0, 10, 0] and target [0, 10, 0] give no direction of view: they are equal";
    assert_eq!(said(|spot| spot.target = spot.eye), equal);
    assert!(
        said(|spot| spot.target = spot.eye + DVec3::X * 1e-320)
            .ends_with("they are too close together or too far apart")
    );
    let parallel = "view up [0, 3, 0] is parallel to the direction of view [0, -1, 0]";
    assert_eq!(said(|spot| spot.up = Some(DVec3::Y * 3.0)), parallel);
    assert_eq!(said(|spot| spot.up = Some(DVec3::ZERO)), "view up [0, 0, 0] has no direction");
}

#[test]
fn a_field_of_view_that_cannot_be_is_named_and_degrees_are_recognised() {
    let degrees = "view field of view 90 is not within (0, π) radians; it looks like degrees: use .to_radians()";
    assert_eq!(said(|spot| spot.full_angle_radians = 90.0), degrees);
    for bad in [0.0, -1.0, std::f64::consts::PI, NAN, INF] {
        let want = format!("view field of view {bad} is not within (0, π) radians");
        assert_eq!(said(|spot| spot.full_angle_radians = bad), want);
    }
    for bad in [0.0, -1.0, NAN, INF] {
        let sun = View::orthographic(DVec3::Y, DVec3::ZERO, DVec3::Z, bad, 0.0, 2.0, SIZE);
        assert_eq!(sun.unwrap_err().to_string(), format!("view half height {bad} is not positive and finite"));
    }
}

#[test]
fn a_range_that_cannot_be_is_named_by_its_end() {
    for bad in [NAN, INF, -INF] {
        assert_eq!(said(|spot| spot.near = bad), format!("view near distance {bad} is not finite"));
        assert_eq!(said(|spot| spot.far = bad), format!("view far distance {bad} is not finite"));
    }
    for bad in [0.0, -1.0] {
        assert_eq!(
            said(|spot| spot.near = bad),
            format!("view near distance {bad} is not above 0, as it must be in perspective")
        );
    }
    assert_eq!(said(|spot| spot.near = 100.0), "view near distance 100 is not below its far distance 100");
    assert_eq!(said(|spot| spot.far = 0.5), "view near distance 1 is not below its far distance 0.5");
    // An orthographic view may begin behind its eye.
    assert!(View::orthographic(DVec3::Y, DVec3::ZERO, DVec3::Z, 1.0, -2.0, 2.0, SIZE).is_ok());
}

#[test]
fn other_faults_are_named_too() {
    let view = View::spot(lamp()).unwrap();
    assert_eq!(view.scaled(-2.0).unwrap_err(), ViewError::Factor(-2.0));
    let around = |count, margin| {
        sector_views(DVec3::ZERO, 1.0, 2.0, &Sectors { count, margin, tan_elevation: 1.0, size: SIZE }).map(|_| ())
    };
    assert!(around(3, 0.0).is_ok());
    assert!(matches!(around(2, 0.0), Err(ViewError::Sectors { count: 2, .. })));
    assert!(matches!(around(0, 0.0), Err(ViewError::Sectors { count: 0, .. })));
    assert!(matches!(around(3, 1.0), Err(ViewError::Sectors { count: 3, .. })));
    let (low, high) = (DVec3::ZERO, DVec3::ONE);
    for bad in [[high, low], [low, low], [low, DVec3::splat(INF)], [DVec3::splat(NAN), high]] {
        assert!(matches!(View::directional(DVec3::Y, bad, SIZE), Err(ViewError::Bounds { .. })), "{bad:?}");
    }
    assert!(matches!(View::directional(DVec3::ZERO, [low, high], SIZE), Err(ViewError::NoDirection { .. })));
    let not_finite = View::directional(DVec3::X * NAN, [low, high], SIZE).unwrap_err().to_string();
    assert_eq!(not_finite, "view direction [NaN, NaN, NaN] is not finite");
}

#[test]
fn a_spot_is_a_perspective_view_with_its_cone() {
    let spot = lamp();
    let plain = View::perspective(spot.eye, spot.target, DVec3::Z, spot.full_angle_radians, 1.0, 100.0, SIZE).unwrap();
    let view = View::spot(spot).unwrap();
    assert_eq!((view.world_to_eye(), view.projection()), (plain.world_to_eye(), plain.projection()));
    assert_eq!(*view.rules(), Rules::SPOT);
    assert_eq!(view.cone(), Some((0.5 * spot.full_angle_radians).cos()));
    // The middle of a side is on the cone; the corners are beyond it.
    assert_eq!(view.locate(glam::Vec2::new(32.0, 0.01)), Place::Inside);
    assert_eq!(view.locate(glam::Vec2::new(1.0, 1.0)), Place::BeyondCone);
    // A half-angle of 90° leaves nothing out that is in the map.
    assert_eq!(view.with_cone(Some(0.0)).unwrap().locate(glam::Vec2::new(1.0, 1.0)), Place::Inside);
}

#[test]
fn a_directional_light_sees_all_of_its_box_and_little_more() {
    let boxes = [
        [DVec3::new(-3.0, 0.0, 2.0), DVec3::new(5.0, 4.0, 9.0)],
        [DVec3::new(-8.0, 1.0, -8.0), DVec3::new(8.0, 1.0, 8.0)],
        [DVec3::new(1e6, 1e6, -1e6), DVec3::new(1e6 + 1.0, 1e6 + 2.0, 3.0 - 1e6)],
    ];
    for toward in [DVec3::Y, DVec3::NEG_Y * 5.0, DVec3::new(1.0, 2.0, 3.0), DVec3::X, DVec3::new(-0.01, 1.0, 0.0)] {
        for [min, max] in boxes {
            let view = View::directional(toward, [min, max], UVec2::new(64, 32)).unwrap();
            assert!((view.ahead() + toward.normalize()).length() < 1e-12);
            assert!(view.near() > 0.0);
            let mut reach = [DVec3::INFINITY, DVec3::NEG_INFINITY];
            for corner in 0..8u32 {
                let pick = |bit: u32, low: f64, high: f64| if corner >> bit & 1 == 1 { high } else { low };
                let at = DVec3::new(pick(0, min.x, max.x), pick(1, min.y, max.y), pick(2, min.z, max.z));
                let eye = view.world_to_eye().transform_point3(at);
                assert_eq!(view.locate(view.eye_to_texel(eye).as_vec2()), Place::Inside, "{toward} {at}");
                assert!(-eye.z > view.near() && -eye.z < view.far());
                let seen = view.eye_to_texel(eye).extend(-eye.z);
                reach = [reach[0].min(seen), reach[1].max(seen)];
            }
            // The margins are 1/1024 of the diagonal; the box fills the rest.
            let waste = 2.1 / 1024.0 * (max - min).length();
            let texel = view.texel_world(1.0);
            assert!((DVec2::new(64.0, 32.0) - (reach[1] - reach[0]).truncate()).cmple(waste / texel).all());
            assert!(view.far() - view.near() - (reach[1].z - reach[0].z) <= waste);
        }
    }
}

#[test]
fn up_is_y_unless_the_light_shines_along_it() {
    assert_eq!(up_for(DVec3::new(1.0, 2.0, 3.0)), DVec3::Y);
    assert_eq!((up_for(DVec3::Y * 7.0), up_for(DVec3::new(0.01, -1.0, 0.0))), (DVec3::Z, DVec3::Z));
}

#[test]
fn rays_are_the_inverse_of_projection() {
    let sun = View::directional(DVec3::new(1.0, 2.0, 3.0), [DVec3::splat(-4.0), DVec3::splat(4.0)], SIZE).unwrap();
    let lamp = View::spot(SpotView { eye: DVec3::new(3.0, 10.0, -2.0), ..lamp() }).unwrap();
    for view in [lamp, sun, lamp.with_size(UVec2::new(128, 16)).unwrap()] {
        for place in 0..400 {
            // Places of a low-discrepancy sequence, a little beyond the map too.
            let turn = DVec2::new(0.754_877_666, 0.569_840_291) * f64::from(place);
            let texel = (turn.fract() * 1.2 - 0.1) * view.size().as_dvec2();
            let (origin, direction) = view.ray(texel);
            assert!((direction.length() - 1.0).abs() < 1e-15);
            for step in [0.5, 3.0, 40.0] {
                let at = origin + direction * step;
                let eye = view.world_to_eye().transform_point3(at);
                assert!((view.eye_to_texel(eye) - texel).abs().max_element() < 1e-10, "{texel} at {step}");
                let known = view.world_at(texel, view.key(-eye.z));
                assert!((known - at).length() < 1e-10, "{known} is not {at}");
            }
            let from = -view.world_to_eye().transform_point3(origin).z;
            let want = if view.is_perspective() { 0.0 } else { view.near() };
            assert!((from - want).abs() < 1e-12, "{from} is not {want}");
        }
    }
    // Distances along a ray are radial depths in perspective.
    let (origin, direction) = lamp.ray(DVec2::new(10.0, 20.0));
    let radial = lamp.with_kind(Kind::Radial);
    let seen = radial.receiver(&SurfacePoint::at(origin + direction * 7.0, Vec3::Y)).unwrap();
    assert!((seen.depth - 7.0).abs() < 1e-6);
}

#[test]
fn points_of_a_light_see_what_its_centre_sees_at_the_far_plane() {
    let spot = View::perspective(DVec3::new(1.0, 9.0, 2.0), DVec3::ZERO, DVec3::Z, 0.8, 2.0, 20.0, SIZE).unwrap();
    let spot = spot.with_rules(Rules::SPOT).with_cone(Some(0.9)).unwrap().with_kind(Kind::Radial);
    let sun = View::orthographic(DVec3::new(1.0, 9.0, 2.0), DVec3::ZERO, DVec3::Z, 5.0, 2.0, 20.0, SIZE).unwrap();
    for (view, radius) in [(spot, 0.5), (sun, 0.05)] {
        let views = view.over_disc(radius, 32).unwrap();
        let mut farthest = 0.0f64;
        let mut sum = DVec3::ZERO;
        for point in &views {
            assert_eq!(
                (point.rules(), point.cone(), point.size(), point.kind()),
                (&Rules::OPEN, None, view.size(), view.kind())
            );
            let by = if view.is_perspective() {
                let by = point.light().truncate() - view.light().truncate();
                assert!(by.dot(view.ahead()).abs() < 1e-12, "square to the axis");
                // What a corner of the map shows at the far plane.
                for texel in [DVec2::ZERO, DVec2::new(64.0, 20.0), DVec2::splat(31.5)] {
                    let (a, b) = (view.world_at(texel, view.key(20.0)), point.world_at(texel, point.key(20.0)));
                    assert!(a.abs_diff_eq(b, 1e-9), "{a} {b}");
                }
                by
            } else {
                let middle = view.world_at(DVec2::splat(32.0), view.key(11.0));
                assert!(
                    middle.abs_diff_eq(point.world_at(DVec2::splat(32.0), point.key(11.0)), 1e-9),
                    "turned about the middle"
                );
                let way = point.ahead() / point.ahead().dot(view.ahead());
                way - view.ahead()
            };
            farthest = farthest.max(by.length());
            sum += by;
        }
        assert!(farthest <= radius && farthest > 0.95 * radius, "{farthest}");
        assert!(sum.length() / 32.0 < 0.05 * radius, "even about the centre");
        assert!(view.over_disc(f64::NAN, 3).is_err() && view.over_disc(-1.0, 3).is_err());
        assert_eq!(view.over_disc(0.0, 1).unwrap()[0].world_to_eye(), view.world_to_eye());
    }
}

/// Kinds choose themselves: floats of the natural kind are never coarser than twice those of the distance from the near plane.
#[test]
fn a_view_stores_the_kind_of_depth_that_suits_its_range() {
    let of = |near: f64, far: f64| {
        View::perspective(DVec3::ZERO, DVec3::X, DVec3::Y, 1.0, near, far, UVec2::splat(8)).unwrap()
    };
    let sun = |near: f64, far: f64| {
        View::orthographic(DVec3::ZERO, DVec3::X, DVec3::Y, 1.0, near, far, UVec2::splat(8)).unwrap()
    };
    for (near, far) in [(0.1, 1e4), (1.0, 60.0), (9.0, 10.0), (150.0, 160.0)] {
        assert_eq!((of(near, far).kind(), sun(near, far).kind()), (Kind::Axial, Kind::Axial), "{near} {far}");
    }
    for (near, far) in [(151.0, 160.0), (1e7 - 100.0, 1e7 + 100.0)] {
        assert_eq!((of(near, far).kind(), sun(near, far).kind()), (Kind::Screen, Kind::Screen), "{near} {far}");
    }
    assert_eq!([sun(-20.0, 20.0), sun(-1e7, -1e7 + 9.0)].map(|view| view.kind()), [Kind::Axial, Kind::Screen]);
    for (near, far) in [(0.01, 1e4), (1.0, 2.0), (15.0, 16.0), (15.1, 16.0), (1e6, 1e6 + 8.0)] {
        let view = of(near, far);
        let step = |zeta: f64| match view.kind() {
            Kind::Screen => {
                let depth = view.key(zeta) as f32;
                view.decode().zeta(depth.next_up()) - view.decode().zeta(depth)
            }
            Kind::Axial | Kind::Radial => f64::from((zeta as f32).next_up()) - f64::from(zeta as f32),
        };
        // What a float of the distance from the near plane would make of the largest distance, twice.
        let offset = (far - near) * 2f64.powi(-23);
        let worst = step(far).max(step(near)) * 0.999;
        let most = if view.kind() == Kind::Screen { 2.0 * offset } else { 16.0 * 2.0 * offset };
        assert!(worst <= most, "{near} {far}: {worst} > {most}");
    }
    // Whoever has chosen is not corrected, whatever else changes.
    let chosen = of(1e6, 1e6 + 8.0).with_kind(Kind::Radial);
    assert_eq!(chosen.with_size(UVec2::splat(9)).unwrap().scaled(2.0).unwrap().kind(), Kind::Radial);
}

/// Points of a sphere lie evenly over its disc, seen from any side: of those within a part of the radius there are as many as of its area.
#[test]
fn points_of_a_sphere_fill_its_disc_from_every_side() {
    let lamp = View::perspective(DVec3::new(1.0, 9.0, 2.0), DVec3::ZERO, DVec3::Z, 0.8, 2.0, 20.0, SIZE).unwrap();
    let (count, radius) = (4096, 0.25);
    let views = lamp.over_sphere(radius, count).unwrap();
    for side in [DVec3::X, DVec3::Y, DVec3::Z, DVec3::new(3.0, -1.0, 2.0).normalize()] {
        let off = |view: &View| (view.light().truncate() - lamp.light().truncate()).reject_from_normalized(side);
        for part in [0.25, 0.5, 0.75, 1.0 + 1e-9] {
            let within = views.iter().filter(|view| off(view).length() <= radius * part).count();
            let share = within as f64 / f64::from(count);
            assert!((share - (part * part).min(1.0)).abs() < 0.01, "{share} within {part} of the radius, from {side}");
        }
        let middle = views.iter().map(off).sum::<DVec3>() / f64::from(count);
        assert!(middle.length() < 0.01 * radius, "{middle}");
    }
    assert!(views.iter().all(|view| view.ahead().abs_diff_eq(lamp.ahead(), 1e-12) && view.size() == lamp.size()));
    assert!(lamp.over_sphere(f64::INFINITY, 3).is_err() && lamp.over_sphere(-1.0, 3).is_err());
    assert_eq!(lamp.over_sphere(0.0, 1).unwrap()[0], lamp);
}
