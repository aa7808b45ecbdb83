//! Williams 1978: matrices, bias in the matrix, bilinear z, dither, order-preserving depth.

use glam::{DVec3, UVec2, Vec2, Vec3};
use umbrage_depth::{DepthMap, Raw};
use umbrage_plane::{Bias, Kind, SurfacePoint, View};
use umbrage_sample::Key;
use umbrage_shadow::williams::{
    Dither, DitherLaw, Guard, Lookup, bilinear, fold_bias, observer_to_light, transform, transform_all,
};
use umbrage_shadow::{Shadow, ShadowMap, presets};

const KEY: Key = Key::new(3, 0, 0);

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

fn near(got: DVec3, want: [f64; 3], tolerance: f64) {
    assert!(got.abs_diff_eq(DVec3::from_array(want), tolerance), "{got} against {want:?}");
}

#[test]
fn v38_w78_3_d_6_one_matrix_takes_the_observer_s_screen_to_the_light_s() {
    let point = DVec3::new(2.0, 1.0, -3.0);
    let seen = transform(&camera().world_to_screen(), point).unwrap();
    near(seen, [0.255_544_631_6, 0.142_360_340_3, 0.935_586_483_9], 1e-9);
    let matrix = observer_to_light(&camera(), &lamp(64));
    let wanted = [0.222_222_222_2, 0.333_333_333_3, 0.897_867_564_5];
    near(transform(&matrix, seen).unwrap(), wanted, 1e-9);
    let mut batch = [seen, seen, DVec3::new(0.0, 0.9, 0.5)];
    transform_all(&matrix, &mut batch);
    near(batch[1], wanted, 1e-9);
}

#[test]
fn v39_w78_11_bias_is_one_row_of_the_matrix_d_8() {
    let seen = DVec3::new(0.255_544_631_591_474_4, 0.142_360_340_348_126_83, 0.935_586_483_919_544_9);
    let matrix = observer_to_light(&camera(), &lamp(64));
    let (plain, biased) = (transform(&matrix, seen).unwrap(), transform(&fold_bias(matrix, 0.001), seen).unwrap());
    near(plain - biased, [0.0, 0.0, 0.001], 1e-14);
    // V39b: rounding the observer's z to 16 bits first moves the point on a 512² map.
    let rounded = DVec3::new(seen.x, seen.y, (seen.z * 65_535.0 + 0.5).floor() / 65_535.0);
    let moved = (transform(&matrix, rounded).unwrap() - plain).abs();
    near(moved * DVec3::new(256.0, 256.0, 65_535.0), [0.002_199_1, 0.023_090_8, 0.227_461_9], 1e-6);
}

fn raw(view: &View, depth: impl Fn(u32, u32) -> f32) -> Raw {
    let size = view.size();
    Raw::new(*view, (0..size.x * size.y).map(|i| depth(i % size.x, i / size.x)).collect()).unwrap()
}

#[test]
fn v44_w78_13_bilinear_depth_is_exact_on_planes() {
    let view = lamp(64);
    let surface = SurfacePoint::at(Vec3::new(2.0, 1.0, -3.0), DVec3::new(0.2, 1.0, 0.3).normalize().as_vec3());
    let four = raw(&view.with_kind(Kind::Screen), |x, y| match (x, y) {
        (10, 20) => 10.0,
        (11, 20) => 12.0,
        (10, 21) => 14.0,
        (11, 21) => 20.0,
        _ => 0.0,
    });
    let receiver = four.view().receiver(&surface).unwrap();
    assert_eq!(bilinear(&four, Vec2::new(10.75, 21.0), Guard::Steps(1e9), &receiver), 13.0);
    for kind in [Kind::Screen, Kind::Axial] {
        let view = view.with_kind(kind);
        let receiver = view.receiver(&surface).unwrap();
        let plane = receiver.plane(&view);
        let map = raw(&view, |x, y| plane.at(view.sampling().position(glam::IVec2::new(x as i32, y as i32))));
        for step in 0..1000 {
            let at = Vec2::new(35.0 + KEY.unit(step, 0) * 9.0, 17.0 + KEY.unit(step, 1) * 9.0);
            let exact = plane.at(at.as_dvec2());
            let error = (bilinear(&map, at, Guard::Faithful, &receiver) - exact).abs() / exact;
            let nearest = (map.depth(at.floor().as_ivec2()) - exact).abs();
            assert!(error < 4e-7, "{kind:?} {error}");
            assert!(kind == Kind::Axial || nearest <= 0.000_830_675 + 1e-6);
        }
    }
}

#[test]
fn w78_14_silhouettes_are_not_blended_unless_asked() {
    let view = lamp(64).with_kind(Kind::Screen);
    let map = raw(&view, |x, _| if x < 32 { 0.5 } else { f32::INFINITY });
    let receiver = view.receiver(&SurfacePoint::at(Vec3::new(0.0, 1.0, 0.0), Vec3::Y)).unwrap();
    let at = Vec2::new(32.25, 10.0);
    assert_eq!(bilinear(&map, at, Guard::default(), &receiver), f32::INFINITY);
    assert_eq!(bilinear(&map, at, Guard::Faithful, &receiver), 0.875);
}

#[test]
fn v46d_w78_15_dither_laws() {
    for (law, want) in [(DitherLaw::TruncatedNormal, 0.164_429_7), (DitherLaw::ThreeUniforms, 1.0 / 6.0)] {
        let draws: Vec<f64> = (0..200_000).map(|i| f64::from(Dither::draw(law, KEY.region(i), 1))).collect();
        assert!(draws.iter().all(|d| d.abs() <= 0.5));
        let mean = draws.iter().sum::<f64>() / 2e5;
        let deviation = (draws.iter().map(|d| (d - mean).powi(2)).sum::<f64>() / 2e5).sqrt();
        // Four standard errors: σ/√n of the mean, σ/√(2n) of the deviation.
        assert!(mean.abs() < 4.0 * want / 447.0 && (deviation - want).abs() < 4.0 * want / 632.0, "{mean} {deviation}");
    }
}

#[test]
fn w78_25_only_the_order_of_depths_matters_at_bias_zero() {
    let view = lamp(32);
    let map = raw(&view, |x, y| 5.0 + ((x * 5 + y * 13) % 17) as f32 * 0.5);
    let warped = raw(&view, |x, y| map.depth(glam::IVec2::new(x as i32, y as i32)).powi(3) * 0.01 - 7.0);
    let filter = presets::williams78().filter.with_bias(Bias::ZERO);
    for step in 0..2000 {
        let zeta = 5.0 + KEY.unit(step, 0) * 9.0;
        let at = glam::DVec2::new(f64::from(KEY.unit(step, 1)), f64::from(KEY.unit(step, 2))) * 32.0;
        let world = view.world_at(at, -1.0 / f64::from(zeta)).as_vec3();
        let receiver = view.receiver(&SurfacePoint::at(world, Vec3::Y)).unwrap();
        let remapped = umbrage_plane::Receiver { depth: receiver.depth.powi(3) * 0.01 - 7.0, ..receiver };
        let one = ShadowMap { filter, map: &map }.fraction_of(&receiver, KEY);
        let two = ShadowMap { filter, map: &warped }.fraction_of(&remapped, KEY);
        assert_eq!(one, two, "at ζ = {zeta}");
    }
}

#[test]
fn w78_8_outside_the_light_s_volume_everything_is_lit() {
    let view = lamp(32).with_rules(umbrage_plane::Rules::VOLUME);
    let shadow =
        ShadowMap { filter: presets::williams78().filter.with_lookup(Lookup::Nearest), map: raw(&view, |_, _| 2.0) };
    let at = |x: f32, y: f32| shadow.fraction(&SurfacePoint::at(Vec3::new(x, y, 0.0), Vec3::Y), KEY);
    assert_eq!([at(0.0, 0.0), at(30.0, 0.0), at(0.0, -95.0), at(0.0, 9.5)], [1.0, 0.0, 0.0, 0.0]);
}
