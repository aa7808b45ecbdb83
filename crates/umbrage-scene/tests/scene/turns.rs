//! Lights that are turned about what they shine at.

use glam::{DVec3, UVec2};
use umbrage_plane::{Projection, View};
use umbrage_scene::{Bearing, gallery};

fn bearing(azimuth_deg: f64, elevation_deg: f64) -> Bearing {
    Bearing { azimuth_deg, elevation_deg }
}

#[test]
fn a_bearing_is_a_direction() {
    for (to, direction) in [
        (bearing(0.0, 0.0), DVec3::X),
        (bearing(90.0, 0.0), DVec3::Z),
        (bearing(180.0, 0.0), DVec3::NEG_X),
        (bearing(0.0, 90.0), DVec3::Y),
        (bearing(-90.0, -45.0), DVec3::new(0.0, -0.5f64.sqrt(), -0.5f64.sqrt())),
    ] {
        assert!(to.direction().abs_diff_eq(direction, 1e-12), "{to:?}");
        let back = Bearing::of(direction * 7.0);
        assert!(back.direction().abs_diff_eq(direction, 1e-12), "{back:?}");
    }
    assert_eq!(Bearing::of(DVec3::Y), bearing(0.0, 90.0));
}

#[test]
fn a_turned_light_stands_there_at_its_old_distance_and_shines_at_the_same_place() {
    for (name, make) in gallery::ALL {
        let scene = make();
        for light in scene.lights.iter().filter(|light| light.casts) {
            let (view, pivot) = (&light.view, scene.pivot(&light.view));
            assert_eq!(scene.turned(view, Bearing::of(-view.ahead())).expect("a view"), *view, "{name}");
            for to in [bearing(0.0, 90.0), bearing(200.0, 35.0), bearing(-20.0, 5.0)] {
                let turned = scene.turned(view, to).expect("a view");
                assert!((-turned.ahead()).abs_diff_eq(to.direction(), 1e-9), "{name} {to:?}");
                let place = |view: &View| view.eye_to_world().w_axis.truncate();
                let (old, new) = (place(view).distance(pivot), place(&turned).distance(pivot));
                assert!((old - new).abs() < 1e-9 * old, "{name} {to:?}: {old} {new}");
                assert!(scene.about_origin(&turned).ahead().dot(pivot - place(&turned)) > 0.0);
                assert_eq!((turned.size(), turned.cone(), *turned.rules()), (view.size(), view.cone(), *view.rules()));
            }
        }
    }
}

/// A small turn moves a map a little: the light can be dragged over the pole.
#[test]
fn turning_is_smooth_even_straight_above() {
    let scene = gallery::knot();
    let view = &scene.lights[0].view;
    for azimuth in [0.0, 77.0] {
        for elevation in [40.0, 89.8, 89.99] {
            let [a, b] =
                [elevation, elevation + 0.01].map(|el| scene.turned(view, bearing(azimuth, el)).expect("a view"));
            let apart = a.eye_to_world() - b.eye_to_world();
            let most =
                [apart.x_axis, apart.y_axis, apart.z_axis].map(glam::DVec4::length).into_iter().fold(0.0, f64::max);
            assert!(most < 2e-4, "{azimuth} {elevation}: {most}");
        }
    }
}

/// What a map held before it holds after a turn, and what it left out stays out.
#[test]
fn maps_are_widened_for_what_they_held() {
    let (mut wider, mut cut) = (0, 0);
    for (name, make) in gallery::ALL {
        let scene = make();
        let suns = scene.lights.iter().filter(|light| light.casts && !light.view.is_perspective());
        let closed_in = suns.clone().map(|light| scene.framed(light).expect("a view"));
        for light in suns.cloned().chain(closed_in.collect::<Vec<_>>()) {
            let outside = scene.casters_outside(&light.view);
            for to in [bearing(10.0, 80.0), bearing(120.0, 20.0)] {
                let turned = scene.turned(&light.view, to).expect("a view");
                let now = scene.casters_outside(&turned);
                assert!(now.iter().all(|id| outside.contains(id)), "{name} {to:?}: {now:?} and before {outside:?}");
                let area = |view: &View| match view.projection() {
                    Projection::Orthographic { half, .. } => half.x * half.y,
                    Projection::Perspective { .. } => 0.0,
                };
                wider += usize::from(area(&turned) > area(&light.view));
                cut += outside.len();
            }
        }
    }
    assert!(wider > 0 && cut > 0, "both cases are there: {wider} {cut}");

    // A lamp whose near plane just holds a slab: at a low bearing the slab comes nearer.
    let mut scene = gallery::knot();
    let light = scene.lights[0].view;
    let near = 70.0;
    let light = View::new(light.world_to_eye(), light.projection(), near, light.far(), UVec2::splat(64));
    let light = light.expect("a view").alike(&scene.lights[0].view);
    let low = scene.turned(&light, bearing(0.0, 2.0)).expect("a view");
    assert!(low.near() < near, "{}", low.near());
    // A lamp whose shade is before its near plane keeps it for the shade.
    let shade = umbrage_scene::Mesh::sphere(light.light().truncate().as_vec3(), 5.0, 12);
    scene.objects = vec![umbrage_scene::Object::solid("shade", shade, scene.objects[0].material)];
    assert_eq!(scene.turned(&light, bearing(0.0, 2.0)).expect("a view").near(), near);
    assert!(scene.turned(&scene.lights[0].view, bearing(f64::NAN, 0.0)).is_err());
}
