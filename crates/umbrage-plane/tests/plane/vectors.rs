//! The published numbers of planes and projections: vectors V31, V35–V37, V40–V43 and V67, the units of bias (C-11, C-12), and the
//! six places of C-10. World and eye space are right-handed, rows go down (C-1, C-3).

use glam::{DMat4, DVec2, DVec3, DVec4, IVec2, UVec2, Vec2, Vec3};
use umbrage_plane::{Bias, Footprint, Kind, Place, Rules, SurfacePoint, TexelRect, Verdict, View, planar_shadow};

const P: Vec3 = Vec3::new(2.0, 1.0, -3.0);
const N: DVec3 = DVec3::new(0.2, 1.0, 0.3);

fn close(got: f64, want: f64, tolerance: f64) {
    assert!((got - want).abs() <= tolerance, "got {got}, want {want} ± {tolerance}");
}

fn lamp(size: u32) -> View {
    let eye = DVec3::new(0.0, 10.0, 0.0);
    let fov = 90f64.to_radians();
    View::perspective(eye, DVec3::ZERO, DVec3::NEG_Z, fov, 1.0, 100.0, UVec2::splat(size)).unwrap()
}

fn camera() -> View {
    let eye = DVec3::new(0.0, 5.0, 10.0);
    let fov = 60f64.to_radians();
    View::perspective(eye, eye + DVec3::new(0.0, -0.4, -1.0), DVec3::Y, fov, 1.0, 100.0, UVec2::splat(512)).unwrap()
}

fn surface() -> SurfacePoint {
    SurfacePoint::at(P, N.normalize().as_vec3())
}

#[test]
fn v31_texel_width_on_the_map() {
    let view = lamp(1024);
    close(view.texel_world(10.0).x, 0.019_531_25, 1e-15);
    // A half width of .5 world units at that depth is 25.6 texels.
    close(0.5 / view.texel_world(10.0).x, 25.6, 1e-12);
}

#[test]
fn v35_point_and_plane_in_light_space() {
    let view = lamp(64);
    let screen = view.world_to_screen() * P.as_dvec3().extend(1.0);
    close(screen.x / screen.w, 0.222_222_222, 1e-9);
    close(screen.y / screen.w, 0.333_333_333, 1e-9);
    close(screen.z / screen.w, 0.897_867_565, 1e-9);
    let receiver = view.receiver(&surface()).unwrap();
    assert_eq!(receiver.depth, 9.0);
    assert_eq!(receiver.footprint.centre.floor(), Vec2::new(39.0, 21.0));
    // T_L = M⁻ᵀ T_W, and T_L · p = 0 (D-2); c_L is the plane at the light over B (D-3).
    let plane = DVec4::new(0.2, 1.0, 0.3, -N.dot(P.as_dvec3()));
    let in_light = view.world_to_screen().inverse().transpose() * plane;
    for (got, want) in in_light.to_array().into_iter().zip([0.2, -0.3, -9.405, 8.5]) {
        close(got, want, 1e-12);
    }
    close(in_light.dot(screen), 0.0, 1e-12);
    close(-in_light.x / in_light.z, 0.021_265_284_4, 1e-10);
    close(-in_light.y / in_light.z, -0.031_897_926_6, 1e-10);
    close(-in_light.w / in_light.z, 0.903_774_588_0, 1e-10);
}

#[test]
fn v36_virtual_depths_at_texel_centres() {
    let expected = [
        (38, 20, 0.896_630_781_5, 8.901_903_367_5),
        (39, 20, 0.897_295_321_6, 8.954_344_624_4),
        (39, 21, 0.898_292_131_8, 9.034_175_334_3),
        (40, 21, 0.898_956_672_0, 9.088_191_330_3),
        (47, 21, 0.903_608_453_0, 9.485_179_407_2),
    ];
    let axial = lamp(64);
    let screen = axial.with_kind(Kind::Screen);
    for (x, y, z, zeta) in expected {
        let at = axial.sampling().position(IVec2::new(x, y));
        close(f64::from(axial.receiver(&surface()).unwrap().plane(&axial).at(at)), zeta, 2e-6);
        close(f64::from(screen.receiver(&surface()).unwrap().plane(&screen).at(at)), z, 2e-7);
    }
}

#[test]
fn v37_inverse_distance_is_affine_and_distance_is_not() {
    let view = lamp(64);
    let receiver = view.receiver(&surface()).unwrap();
    let key = view.affine(receiver.eye, receiver.normal).unwrap();
    close(-key.at(DVec2::new(38.5, 20.5)), 0.112_335_526_3, 1e-9);
    close(-key.dx, -0.000_657_894_7, 1e-9);
    let zeta = |x: f64| -1.0 / key.at(DVec2::new(x + 0.5, 21.5));
    let linear = zeta(39.0) + 8.0 * 0.5 * (zeta(40.0) - zeta(38.0));
    close(linear - zeta(47.0), -0.021_429_3, 1e-6);
}

#[test]
fn v40_world_bias_in_screen_depth_d_8() {
    // The point stands at ζ = 9.3; moved .3 toward the light it would stand at 9.
    let view = lamp(64).with_kind(Kind::Screen);
    let receiver = view.receiver(&SurfacePoint::at(Vec3::new(0.0, 0.7, 0.0), Vec3::Y)).unwrap();
    let moved = f64::from(receiver.depth) - f64::from(receiver.nearer(&view, Bias::World(0.3)));
    close(moved, 0.003_620_433_7, 1e-7);
}

#[test]
fn v41_horizon_and_edge_on_d_5() {
    let view = lamp(64);
    let through = SurfacePoint::at(Vec3::new(-2.0, 0.0, 0.0), DVec3::new(1.0, 0.05, 0.0).normalize().as_vec3());
    let receiver = view.receiver(&through).unwrap();
    let key = view.affine(receiver.eye, DVec3::new(1.0, 0.0, 0.05)).unwrap();
    for (x_n, want) in [(-0.5, 0.22), (0.0, 0.02), (0.5, -0.18)] {
        close(-key.at(DVec2::new((x_n + 1.0) * 32.0, 32.0)), want, 1e-12);
    }
    // Behind its own horizon a plane is farther than anything that is stored: shadow against any finite depth.
    assert_eq!(receiver.plane(&view).at(DVec2::new(48.0, 32.0)), f32::INFINITY);
    let screen = view.with_kind(Kind::Screen);
    let plane = screen.receiver(&through).unwrap().plane(&screen);
    assert_eq!(plane.at(DVec2::new(48.0, 32.0)), f32::INFINITY);
    close(plane.key.at(DVec2::new(48.0, 32.0)), 1.191_919_2, 1e-6);
    assert_eq!(view.affine(DVec3::new(0.0, 1.0, -9.0), DVec3::X), None);
    let edge_on = view.receiver(&SurfacePoint::at(Vec3::new(0.0, 1.0, 0.0), Vec3::X)).unwrap();
    assert_eq!(edge_on.plane(&view).at(DVec2::new(40.0, 3.0)), edge_on.depth);
    assert_eq!(edge_on.slope, f32::INFINITY);
}

/// The corners of a camera pixel on the surface's tangent plane, exactly.
fn pixel_region(camera: &View, x: u32, y: u32) -> SurfacePoint {
    let eye = camera.world_to_eye().transform_point3(P.as_dvec3());
    let key = camera.affine(eye, camera.world_to_eye().transform_vector3(N)).unwrap();
    let on_plane = |dx: f64, dy: f64| {
        let at = DVec2::new(f64::from(x) + dx, f64::from(y) + dy);
        camera.world_at(at, key.at(at))
    };
    let corners = [on_plane(0.0, 0.0), on_plane(1.0, 0.0), on_plane(1.0, 1.0), on_plane(0.0, 1.0)];
    SurfacePoint { position: on_plane(0.5, 0.5), ..surface() }.with_corners(corners)
}

#[test]
fn v42_pixel_footprint_exact_and_by_derivatives_d_7() {
    let (camera, light) = (camera(), lamp(1024));
    let at = camera.eye_to_texel(camera.world_to_eye().transform_point3(P.as_dvec3()));
    close(at.x, 321.419_425_7, 1e-6);
    close(at.y, 219.555_752_9, 1e-6);
    let region = pixel_region(&camera, 321, 219);
    let footprint = light.receiver(&region).unwrap().footprint;
    close(f64::from(footprint.centre.x) / 1024.0, 0.611_286_218_7, 1e-6);
    close(f64::from(footprint.centre.y) / 1024.0, 0.333_100_609_1, 1e-6);
    close(f64::from(footprint.half.x), 1.180_915_4, 2e-4);
    close(f64::from(footprint.half.y), 1.969_160_4, 2e-4);
    close(f64::from(footprint.quad_share()), 0.621_014_7, 2e-4);
    let derivative = light.derivative_footprint(&region).unwrap();
    close(f64::from(derivative.half.x), 0.001_153_229_1 * 1024.0, 1e-3);
    close(f64::from(derivative.half.y), 0.001_922_993_8 * 1024.0, 1e-3);
    assert!((f64::from(light.receiver(&region).unwrap().depth) - 8.999_422_8).abs() < 1e-5);
}

#[test]
fn v43_orthographic_plane() {
    let eye = DVec3::new(0.0, 30.0, 0.0);
    let view = View::orthographic(eye, DVec3::ZERO, DVec3::NEG_Z, 20.0, 0.0, 50.0, UVec2::splat(64)).unwrap();
    let screen = view.with_kind(Kind::Screen);
    let receiver = screen.receiver(&surface()).unwrap();
    close(f64::from(receiver.depth), 0.58, 1e-7);
    assert_eq!(view.receiver(&surface()).unwrap().depth, 29.0);
    let key = view.affine(receiver.eye, receiver.normal).unwrap();
    // ζ over the depth range is z_s; 32 texels are one unit of x_n.
    close(key.dx * 32.0 / 50.0, 0.08, 1e-7);
    close(-key.dy * 32.0 / 50.0, -0.12, 1e-7);
}

#[test]
fn v67_effective_slope_and_cone_guarantee_d_15() {
    let view = lamp(64);
    let receiver = view.receiver(&surface()).unwrap();
    close(f64::from(receiver.slope), 0.341_578_5, 1e-6);
    let sigma = f64::from(receiver.slope);
    let plane = view.affine(receiver.eye, receiver.normal).unwrap();
    let centre = view.eye_to_texel(receiver.eye);
    for step in 0..360 {
        for radius in [0.1, 0.5, 1.0, 2.0, 3.0] {
            let offset = DVec2::from_angle(f64::from(step).to_radians()) * radius / view.texel_world(9.0);
            let drop = 9.0 + 1.0 / plane.at(centre + offset);
            assert!(drop <= sigma * radius + 1e-6, "drop {drop} at radius {radius}");
        }
    }
}

#[test]
fn c_10_places_and_rules() {
    let view = lamp(64).with_rules(Rules::SPOT).with_cone(Some(1.0_f64.atan().cos())).unwrap();
    assert_eq!(view.receiver(&SurfacePoint::at(Vec3::new(0.0, 11.0, 0.0), Vec3::Y)), Err(Place::Behind));
    assert_eq!(view.locate(Vec2::new(-0.001, 5.0)), Place::Outside);
    assert_eq!(view.locate(Vec2::new(64.0, 5.0)), Place::Outside);
    assert_eq!(view.locate(Vec2::new(1.0, 1.0)), Place::BeyondCone);
    assert_eq!(view.locate(Vec2::new(32.0, 1.0)), Place::Inside);
    assert_eq!(view.locate(Vec2::NAN), Place::Outside);
    // Near and far still compare unless the rules say otherwise (T-18).
    let below_far = SurfacePoint::at(Vec3::new(0.0, -200.0, 0.0), Vec3::Y);
    let before_near = SurfacePoint::at(Vec3::new(0.0, 9.5, 0.0), Vec3::Y);
    assert!(view.receiver(&below_far).is_ok() && view.receiver(&before_near).is_ok());
    let strict = view.with_rules(Rules::VOLUME);
    assert_eq!(strict.receiver(&below_far), Err(Place::Far));
    assert_eq!(strict.receiver(&before_near), Err(Place::Near));
    assert_eq!(Rules::SPOT.verdict(Place::BeyondCone), Verdict::Shadowed);
    assert_eq!(Rules::OPEN.verdict(Place::Outside), Verdict::Lit);
    assert_eq!(Rules::OPEN.verdict(Place::Inside), Verdict::Compare);
}

#[test]
fn c_12_texels_need_not_be_square() {
    let view = lamp(64).with_size(UVec2::new(128, 32)).unwrap();
    assert!(view.texel_world(8.0).abs_diff_eq(DVec2::new(0.125, 0.5), 1e-15));
    let receiver = view.receiver(&surface()).unwrap();
    close(f64::from(receiver.footprint.centre.x), 2.0 * 39.111_111_1, 1e-5);
    close(f64::from(receiver.footprint.centre.y), 0.5 * 21.333_333_3, 1e-5);
}

#[test]
fn e_r15_corners_behind_the_light_are_cut_off() {
    let view = lamp(64);
    let corners = [(-2.0, 10.5), (2.0, 10.5), (2.0, 5.0), (-2.0, 5.0)].map(|(x, y)| Vec3::new(x, y, 0.0));
    let region = SurfacePoint { position: DVec3::new(0.0, 7.0, 0.0), ..surface() }.with_corners(corners);
    // Two corners stand at ζ = 5 and x = ±2: at x_n = ±.4, texels 32 ± 12.8. The others, behind the light, are cut at a
    // sixteenth of the centre's ζ = 3 on their way from it: far outside, so that the quarter of the map is what is left.
    let cut = view.receiver(&region).unwrap().footprint;
    assert_eq!((cut.centre, cut.half), (Vec2::splat(32.0), Vec2::new(16.0, 0.0)));
    // Nearer the axis nothing need be capped: x = ±.01 at ζ = .1875, 32 · .01 · (t = 2.8125 / 3.5) / .1875 texels.
    let corners = [(-0.01, 10.5), (0.01, 10.5), (0.01, 5.0), (-0.01, 5.0)].map(|(x, y)| Vec3::new(x, y, 0.0));
    let thin = region.with_corners(corners);
    close(f64::from(view.receiver(&thin).unwrap().footprint.half.x), 32.0 * 0.01 * (2.8125 / 3.5) / 0.1875, 1e-5);
}

#[test]
fn a_capped_footprint_still_lies_around_its_point() {
    let view = lamp(64);
    let corners = [(-0.5, 9.0), (40.0, 9.0), (40.0, 9.0), (-0.5, 9.0)].map(|(x, y)| Vec3::new(x, y, 0.0));
    let region = SurfacePoint { position: DVec3::new(0.0, 9.0, 0.0), ..surface() }.with_corners(corners);
    let footprint = view.receiver(&region).unwrap().footprint;
    assert_eq!(footprint.half.x, 16.0);
    assert!((footprint.centre.x - 32.0).abs() <= 16.0, "{footprint:?}");
}

#[test]
fn a_step_of_screen_depth_is_the_same_step_in_space_in_every_kind_of_map() {
    let sun = View::orthographic(DVec3::Y * 9.0, DVec3::ZERO, DVec3::X, 8.0, -3.0, 30.0, UVec2::splat(64)).unwrap();
    for (view, x) in [(lamp(64), 0.0), (lamp(64), 4.0), (sun, 2.0)] {
        let at = SurfacePoint::at(Vec3::new(x, 0.5, 1.0), Vec3::Y);
        let eye = view.world_to_eye().transform_point3(at.position);
        for amount in [0.0, 1e-5, 2.0 / 65_535.0, 0.01, 0.2] {
            let ends = [Kind::Screen, Kind::Axial, Kind::Radial].map(|kind| {
                let view = view.with_kind(kind);
                let moved = f64::from(view.receiver(&at).unwrap().nearer(&view, Bias::Map(amount)));
                match kind {
                    Kind::Screen => view.decode().zeta(moved as f32),
                    Kind::Radial if view.is_perspective() => moved * -eye.z / eye.length(),
                    Kind::Axial | Kind::Radial => moved,
                }
            });
            // A screen map's own numbers are rounded to f32, which is coarse far from the near plane.
            assert!((ends[1] - ends[2]).abs() < 1e-5 && (ends[0] - ends[1]).abs() < 2e-4, "{x} {amount}: {ends:?}");
        }
        let back = |amount: f32| view.receiver(&at).unwrap().nearer(&view, Bias::Map(amount));
        assert!(back(-0.5) > back(0.0) && back(f32::INFINITY) == f32::NEG_INFINITY);
    }
}

#[test]
fn c_11_c_12_every_unit_of_bias_is_the_same_distance_by_another_name() {
    // 128 × 32 texels over 90° in height: at ζ = 8 a texel is .5 high and, with square texels kept, .5 wide.
    let eye = DVec3::new(0.0, 8.0, 0.0);
    let make = |size| View::perspective(eye, DVec3::ZERO, DVec3::NEG_Z, 90f64.to_radians(), 1.0, 100.0, size).unwrap();
    let view = make(UVec2::new(128, 32));
    let at = SurfacePoint::at(Vec3::ZERO, DVec3::new(3.0, 4.0, 0.0).normalize().as_vec3());
    let receiver = view.receiver(&at).unwrap();
    assert_eq!(receiver.texel_world, Vec2::splat(0.5));
    close(f64::from(receiver.slope), 0.75, 1e-6);
    let moved = |view: &View, bias| {
        f64::from(view.receiver(&at).unwrap().depth - view.receiver(&at).unwrap().nearer(view, bias))
    };
    close(moved(&view, Bias::World(0.25)), 0.25, 1e-6);
    close(moved(&view, Bias::Texels(2.0)), 1.0, 1e-6);
    close(moved(&view, Bias::Steps(2.0)), 0.75, 1e-6);
    // Screen depth is linear in 1/ζ: an eighth of the range nearer than 8, of 1 to 100.
    close(moved(&view, Bias::Map(0.125)), 8.0 - 1.0 / (1.0 / 8.0 + 0.125 * 0.99), 1e-6);
    // Half the columns over the same field: texels are twice as wide as high, and the larger side counts.
    let wide = view.with_size(UVec2::new(64, 32)).unwrap();
    assert_eq!(wide.receiver(&at).unwrap().texel_world, Vec2::new(1.0, 0.5));
    close(moved(&wide, Bias::Texels(2.0)), 2.0, 1e-6);
    // Edge-on a step has no end, but none is still none.
    let edge_on = SurfacePoint::at(Vec3::ZERO, Vec3::X);
    let receiver = view.receiver(&edge_on).unwrap();
    assert_eq!(receiver.nearer(&view, Bias::Steps(0.0)), receiver.depth);
    assert_eq!(receiver.nearer(&view, Bias::Steps(1.0)), f32::NEG_INFINITY);
}

#[test]
fn d_17_screen_keys_are_the_depths_however_far_and_narrow_the_range() {
    let view = View::orthographic(DVec3::ZERO, DVec3::NEG_Z, DVec3::Y, 1.0, 1000.0, 1001.0, UVec2::splat(8)).unwrap();
    let screen = view.with_kind(Kind::Screen);
    for step in 0..=64 {
        let zeta = 1000.0 + f64::from(step) / 64.0;
        let depth = screen.decode().depth(screen.key(zeta) as f32, DVec2::ZERO);
        assert_eq!(depth, (f64::from(step) / 64.0) as f32);
        close(screen.decode().zeta(screen.key(zeta) as f32), zeta, 1e-6);
    }
    let lamp = lamp(64).with_kind(Kind::Screen);
    for zeta in [1.0, 1.001, 1.5, 9.0, 99.0] {
        close(lamp.decode().zeta(lamp.key(zeta) as f32) / zeta, 1.0, 1e-5);
        let at = lamp.world_at(DVec2::new(20.0, 40.0), lamp.key(zeta));
        close(-lamp.world_to_eye().transform_point3(at).z, zeta, 1e-9);
    }
}

#[test]
fn footprints_scale_about_their_centre_and_keep_their_minimum() {
    let thin = Footprint::boxed(Vec2::splat(8.0), Vec2::new(2.0, 0.0));
    let scaled = thin.scaled(thin.centre, 3.0, 1.0, Vec2::splat(100.0));
    assert_eq!((scaled.half, scaled.corners[2]), (Vec2::new(6.0, 1.0), Vec2::new(14.0, 9.0)));
    assert_eq!(Footprint::point(Vec2::ONE).scaled(Vec2::ONE, 3.0, 0.0, Vec2::splat(9.0)), Footprint::point(Vec2::ONE));
    assert_eq!(TexelRect::around(Vec2::splat(1.5), Vec2::splat(1.25)), TexelRect::new(IVec2::ZERO, IVec2::splat(3)));
}

#[test]
fn views_refuse_what_they_cannot_mean() {
    let make = |fov, near, far, side| {
        View::perspective(DVec3::Y, DVec3::ZERO, DVec3::X, fov, near, far, UVec2::splat(side))
            .map_err(|e| e.to_string())
    };
    assert!(make(1.0, 1.0, 2.0, 1).is_ok());
    for bad in [make(1.0, 0.0, 2.0, 1), make(1.0, 2.0, 1.0, 1), make(4.0, 1.0, 2.0, 1), make(1.0, 1.0, 2.0, 0)] {
        assert!(bad.is_err());
    }
    assert!(View::perspective(DVec3::Y, DVec3::ZERO, DVec3::Y, 1.0, 1.0, 2.0, UVec2::ONE).is_err());
    let projection = make(1.0, 1.0, 2.0, 1).unwrap().projection();
    let with = |matrix| View::new(matrix, projection, 1.0, 2.0, UVec2::ONE);
    let turned = DMat4::from_rotation_y(0.3) * DMat4::from_translation(DVec3::new(3.0, -2.0, 7.0));
    assert!(with(turned).is_ok());
    let sheared = DMat4::from_cols(DVec4::X, DVec4::new(0.5, 1.0, 0.0, 0.0), DVec4::Z, DVec4::W);
    let projecting = DMat4::from_cols(DVec4::X, DVec4::Y, DVec4::new(0.0, 0.0, 1.0, 1.0), DVec4::W);
    let mirrored = DMat4::from_scale(DVec3::new(1.0, 1.0, -1.0));
    for bad in [DMat4::from_scale(DVec3::splat(2.0)), mirrored, sheared, projecting, DMat4::ZERO] {
        assert!(with(bad * turned).is_err(), "{bad}");
    }
    let view = with(turned).unwrap();
    assert!([Some(0.0), Some(0.5), None].into_iter().all(|cone| view.with_cone(cone).is_ok()));
    for bad in [1.0, -0.1, f64::NAN, f64::INFINITY] {
        assert!(view.with_cone(Some(bad)).is_err(), "{bad}");
    }
}

#[test]
fn v45_v46_w78_24_planar_projection() {
    let floor = DVec4::new(0.0, 1.0, 0.0, 0.0);
    let onto = |light: DVec4, point: DVec3| {
        let flat = planar_shadow(floor, light) * point.extend(1.0);
        flat.truncate() / flat.w
    };
    assert!(
        onto(DVec4::new(0.0, 10.0, 0.0, 1.0), DVec3::new(1.0, 2.0, 3.0))
            .abs_diff_eq(DVec3::new(1.25, 0.0, 3.75), 1e-12)
    );
    assert!(
        onto(DVec4::new(1.0, 2.0, 0.0, 0.0), DVec3::new(1.0, 2.0, 3.0)).abs_diff_eq(DVec3::new(0.0, 0.0, 3.0), 1e-12)
    );
}

#[test]
fn wm94_9_forward_differences_are_direct_evaluation_over_sixteen_texels_in_every_kind() {
    for kind in [Kind::Screen, Kind::Axial, Kind::Radial] {
        let view = lamp(64).with_kind(kind);
        let plane = view.receiver(&surface()).unwrap().plane(&view);
        for y in 14..30 {
            let from = DVec2::new(32.5, f64::from(y) + 0.5);
            for (step, depth) in plane.row(from).take(16).enumerate() {
                let direct = plane.at(from + DVec2::X * step as f64);
                // 1e-6 of z_s, which is no larger than 1; of other depths the same share.
                close(f64::from(depth), f64::from(direct), 1e-6 * f64::from(direct).max(1.0));
            }
        }
    }
    // Beyond the horizon the row stays at +∞, as the plane does.
    let wall = SurfacePoint::at(Vec3::new(-2.0, 0.0, 0.0), DVec3::new(1.0, 0.05, 0.0).normalize().as_vec3());
    let view = lamp(64);
    let plane = view.receiver(&wall).unwrap().plane(&view);
    assert_eq!(plane.row(DVec2::new(0.5, 32.5)).nth(60), Some(f32::INFINITY));
}

#[test]
fn wm94_8_normals_of_a_camera_s_space_give_the_same_plane() {
    let (eye, light) = (camera(), lamp(64));
    let in_camera = eye.world_to_eye().transform_vector3(N.normalize());
    let at = SurfacePoint { normal: eye.direction_to_world(in_camera).as_vec3(), ..surface() };
    let (given, known) = (light.receiver(&at).unwrap(), light.receiver(&surface()).unwrap());
    close(given.normal.distance(known.normal), 0.0, 1e-7);
    let texel = DVec2::new(39.5, 21.5);
    close(f64::from(given.plane(&light).at(texel)), f64::from(known.plane(&light).at(texel)), 1e-5);
}
