//! A crop of a view is a view: what it stores and where it sees things is what the whole stores and sees there.

use glam::{DVec2, DVec3, IVec2, UVec2, Vec2, Vec3};
use umbrage_plane::{Kind, Projection, SurfacePoint, TexelRect, View, ViewError};

fn wholes() -> [View; 2] {
    let (eye, up, size) = (DVec3::new(3.0, 10.0, -2.0), DVec3::NEG_Z, UVec2::new(96, 64));
    [
        View::perspective(eye, DVec3::ZERO, up, 1.2, 1.0, 100.0, size).unwrap(),
        View::orthographic(eye, DVec3::ZERO, up, 7.0, 1.0, 100.0, size).unwrap(),
    ]
}

const WINDOWS: [TexelRect; 4] = [
    TexelRect::new(IVec2::new(32, 16), IVec2::new(64, 48)),
    TexelRect::new(IVec2::new(5, 40), IVec2::new(16, 63)),
    TexelRect::new(IVec2::new(95, 63), IVec2::new(96, 64)),
    // Wider than the map.
    TexelRect::new(IVec2::new(-20, -7), IVec2::new(101, 70)),
];

fn points() -> impl Iterator<Item = SurfacePoint> {
    (0..200).map(|i| {
        let place = (DVec3::new(0.819_172_5, 0.671_043_6, 0.549_700_5) * f64::from(i)).fract() * 2.0 - 1.0;
        let normal = (DVec3::new(place.z, 1.5, place.x)).normalize().as_vec3();
        let across = Vec3::new(0.02, -0.02 * normal.x / normal.y, 0.0);
        let along = Vec3::new(0.0, -0.03 * normal.z / normal.y, 0.03);
        let position = place * DVec3::new(6.0, 3.0, 6.0);
        let corners = [-across - along, across - along, across + along, along - across];
        SurfacePoint::at(position, normal).with_corners(corners.map(|corner| position + corner.as_dvec3()))
    })
}

#[test]
fn a_crop_stores_the_bits_of_the_whole() {
    let (mut compared, mut differing) = (0, 0);
    for whole in
        wholes().into_iter().flat_map(|view| [Kind::Axial, Kind::Screen, Kind::Radial].map(|kind| view.with_kind(kind)))
    {
        for window in WINDOWS {
            let crop = whole.window(window).unwrap();
            assert_eq!((crop.size(), crop.kind()), (window.size(), whole.kind()));
            for point in points() {
                let plane = whole.receiver(&point).unwrap().plane(&whole);
                let cropped = crop.receiver(&point).unwrap().plane(&crop);
                for texel in TexelRect::of_size(crop.size()).texels().step_by(7) {
                    let at = crop.sampling().position(texel);
                    let (want, got) = (plane.at(at + window.min.as_dvec2()), cropped.at(at));
                    compared += 1;
                    differing += u32::from(want.to_bits() != got.to_bits());
                    // One step of f32 in the key is at most a few in the depth.
                    let step = want.abs().next_up() - want.abs();
                    assert!(
                        want == got || (want - got).abs() <= 4.0 * step * want.abs().max(1.0),
                        "{got:?} is not {want:?}"
                    );
                }
            }
        }
    }
    assert!(compared > 100_000 && differing * 1000 < compared, "{differing} of {compared} differ");
}

#[test]
fn receivers_rays_and_places_land_shifted_by_the_corner() {
    for whole in wholes() {
        for window in WINDOWS {
            let (crop, corner) = (whole.window(window).unwrap(), window.min.as_dvec2());
            for point in points() {
                let (want, got) = (whole.receiver(&point).unwrap(), crop.receiver(&point).unwrap());
                assert!((got.texel + corner - want.texel).abs().max_element() < 1e-9);
                // Small maps cap footprints lower; these are about a third of a texel.
                if crop.size().min_element() >= 8 {
                    for (got, want) in got.footprint.corners.into_iter().zip(want.footprint.corners) {
                        assert!((got.as_dvec2() + corner - want.as_dvec2()).abs().max_element() < 4e-5);
                    }
                    assert!(got.axes[0].distance(want.axes[0]) < 4e-5 && got.axes[1].distance(want.axes[1]) < 4e-5);
                }
                assert_eq!((got.depth, got.facing, got.slope), (want.depth, want.facing, want.slope));
                assert!(got.texel_world.distance(want.texel_world) <= 1e-6 * want.texel_world.x);
                let key = whole.key(-got.eye.z);
                assert!(crop.world_at(got.texel, key).distance(point.position) < 1e-10);
                let ((o, d), (from, ahead)) = (crop.ray(got.texel), whole.ray(want.texel));
                assert!(o.distance(from) < 1e-10 && d.distance(ahead) < 1e-10);
                let screen = crop.world_to_screen().project_point3(point.position);
                assert!((crop.screen_to_texel(screen.truncate()) - got.texel).abs().max_element() < 1e-9);
            }
        }
    }
}

#[test]
fn a_crop_keeps_the_cone_and_moves_with_its_view() {
    let whole = wholes()[0].with_cone(Some(0.5_f64.atan().cos())).unwrap();
    for window in WINDOWS {
        let crop = whole.window(window).unwrap();
        let inside = TexelRect::of_size(whole.size()).intersect(window);
        for texel in inside.texels() {
            let at = texel.as_vec2() + 0.25;
            assert_eq!(crop.locate(at - window.min.as_vec2()), whole.locate(at), "{texel}");
        }
        let (by, point) = (DVec3::new(4.0, -8.0, 2.0), SurfacePoint::at(Vec3::new(0.5, 1.0, 0.25), Vec3::Y));
        let there = SurfacePoint { position: point.position + by, ..point };
        let (here, moved) = (crop.receiver(&point).unwrap(), crop.moved(by).unwrap().receiver(&there).unwrap());
        assert!((here.texel - moved.texel).length() < 1e-9);
    }
    for whole in wholes() {
        let (crop, point) = (whole.window(WINDOWS[1]).unwrap(), SurfacePoint::at(Vec3::new(0.5, 1.0, 0.25), Vec3::Y));
        let twice = SurfacePoint { position: point.position * 2.0, ..point };
        assert_eq!(crop.receiver(&point).unwrap().texel, crop.scaled(2.0).unwrap().receiver(&twice).unwrap().texel);
    }
}

#[test]
fn windows_of_windows_and_of_the_whole_are_views() {
    for whole in wholes() {
        assert_eq!(whole.window(TexelRect::of_size(whole.size())).unwrap(), whole);
        let (first, second) = (WINDOWS[0], TexelRect::new(IVec2::new(3, 5), IVec2::new(20, 9)));
        let twice = whole.window(first).unwrap().window(second).unwrap();
        let once = whole.window(TexelRect::new(first.min + second.min, first.min + second.max)).unwrap();
        let apart = (twice.projection().shift() - once.projection().shift()).abs().max_element();
        assert!(apart < 1e-13, "{apart}");
        assert_eq!(whole.window(TexelRect::EMPTY).unwrap_err(), ViewError::Size { width: 0, height: 0 });
        let vast = TexelRect::new(IVec2::splat(i32::MIN), IVec2::splat(i32::MAX));
        assert!(matches!(whole.window(vast), Err(ViewError::Size { .. })));
        let shift = DVec2::new(f64::NAN, 0.0);
        let unusable = Projection::Perspective { k: DVec2::ONE, shift };
        let made = View::new(whole.world_to_eye(), unusable, 1.0, 2.0, UVec2::ONE);
        assert!(matches!(made, Err(ViewError::Shift { .. })));
    }
}

#[test]
fn a_receiver_has_its_own_texel_and_axes() {
    let view = wholes()[0];
    for point in points() {
        let receiver = view.receiver(&point).unwrap();
        assert_eq!(receiver.texel, view.eye_to_texel(receiver.eye));
        let [across, along] = receiver.axes;
        let [a, b, c, d] = receiver.footprint.corners;
        assert!(across.distance((b - a + c - d) * 0.25) < 1e-5 && along.distance((d - a + c - b) * 0.25) < 1e-5);
        let around = across.abs() + along.abs();
        assert!(
            (around - receiver.footprint.half).abs().max_element() < 1e-3,
            "{around} about {}",
            receiver.footprint.half
        );
        let alone = view.receiver(&SurfacePoint::at(point.position, point.normal)).unwrap();
        assert_eq!((alone.axes, alone.texel), ([Vec2::ZERO; 2], receiver.texel));
    }
}
