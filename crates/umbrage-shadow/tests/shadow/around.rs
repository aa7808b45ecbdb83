//! Lights in all directions: cube faces, sectors, latitude and longitude (R87-17, W78-10, T-16).

use glam::{DVec2, DVec3, UVec2};
use umbrage_depth::Raw;
use umbrage_plane::{Bias, Kind, Sectors, SurfacePoint, TexelRect, View, cube_face, cube_views, sector_views};
use umbrage_sample::{EveryTexel, Key, Pattern, Uniform};
use umbrage_shadow::{Around, AroundError, Biased, Evaluate, LatLong, Pcf, Shadow, presets};

const KEY: Key = Key::new(5, 0, 0);
const EYE: DVec3 = DVec3::new(1.0, -2.0, 3.0);

/// A map of a view that sees, in the direction `d`, a surface at the distance `seen(d)`.
fn map(view: &View, seen: impl Fn(DVec3) -> f64) -> Raw {
    let depths = TexelRect::of_size(view.size()).texels().map(|texel| {
        let at = view.sampling().position(texel);
        let direction = (view.world_at(at, view.key(1.0)) - EYE).normalize();
        let axial = if view.kind() == Kind::Axial { view.ahead().dot(direction) } else { 1.0 };
        (seen(direction) * axial) as f32
    });
    Raw::new(*view, depths.collect()).unwrap()
}

fn cube(side: u32, kind: Kind, seen: impl Fn(DVec3) -> f64 + Copy) -> Vec<Raw> {
    cube_views(EYE, 0.1, 100.0, side).unwrap().map(|view| map(&view.with_kind(kind), seen)).to_vec()
}

/// A region `size` world units wide in the direction `d`, ten units away, facing the light.
fn facing(direction: DVec3, size: f64, region: u32) -> SurfacePoint {
    let direction = direction.normalize();
    let across = direction.any_orthonormal_vector() * size * 0.5;
    let down = direction.cross(across);
    let centre = EYE + direction * 10.0;
    let corners = [across + down, across - down, -across - down, down - across].map(|step| (centre + step).as_vec3());
    SurfacePoint { region, ..SurfacePoint::at(centre.as_vec3(), -direction.as_vec3()).with_corners(corners) }
}

fn exact<P: Pattern>(pattern: P) -> Pcf<P, Biased> {
    Pcf::default()
        .with_pattern(pattern)
        .with_depth(Biased::constant(Bias::World(0.01)))
        .with_res_factor(1.0)
        .with_min_size(0.0)
}

/// A cap of 30° about a corner of the cube hides all behind it: its edge crosses three faces and three seams.
fn cap(direction: DVec3) -> f64 {
    if direction.dot(DVec3::ONE.normalize()) > 30f64.to_radians().cos() { 5.0 } else { 20.0 }
}

#[test]
fn v49_r87_17_faces_of_directions() {
    let (face, st) = cube_face(DVec3::new(1.0, 0.2, -0.3));
    assert_eq!(face, 0);
    assert!(st.abs_diff_eq(DVec2::new(0.35, 0.4), 1e-12), "{st}");
    let views = cube_views(EYE, 0.1, 9.0, 64).unwrap();
    for step in 0..5000 {
        let d =
            DVec3::new(f64::from(KEY.signed(step, 0)), f64::from(KEY.signed(step, 1)), f64::from(KEY.signed(step, 2)));
        let (face, st) = cube_face(d);
        assert!(st.cmpge(DVec2::ZERO).all() && st.cmple(DVec2::ONE).all());
        let eye = views[face].world_to_eye().transform_vector3(d);
        assert!(views[face].eye_to_texel(eye).abs_diff_eq(st * 64.0, 1e-9));
    }
}

#[test]
fn t_16_filters_cross_cube_seams_and_corners_without_a_step() {
    // Every texel stores its distance to one sphere; the same region is looked up all along a great circle over seams and corners.
    for kind in [Kind::Radial, Kind::Axial] {
        let around = Around::new(exact(EveryTexel), cube(128, kind, cap)).unwrap();
        for step in 0..720 {
            let turn = f64::from(step) * 0.5f64.to_radians();
            // Well inside the cap, and well outside it.
            let (axis, side) = (DVec3::ONE.normalize(), DVec3::new(1.0, -1.0, 0.0).normalize());
            let about = side * turn.cos() + axis.cross(side) * turn.sin();
            let ring = |degrees: f64| axis * degrees.to_radians().cos() + about * degrees.to_radians().sin();
            assert_eq!(around.fraction(&facing(ring(26.0), 0.6, step), KEY), 1.0, "{kind:?} inside, {step}");
            assert_eq!(around.fraction(&facing(ring(34.0), 0.6, step), KEY), 0.0, "{kind:?} outside, {step}");
            // On the edge half of the region is dark, on a face as on a seam.
            let edge = around.fraction(&facing(ring(30.0), 1.2, step), KEY);
            assert!((edge - 0.5).abs() < 0.2, "{kind:?} edge, {step}: {edge}");
        }
    }
}

#[test]
fn t_16_virtual_samples_cross_cube_seams() {
    // A wall through the seam of +X and +Z, stored in the map: its own tangent plane must not shadow it.
    let wall = |d: DVec3| {
        let along = d.dot(DVec3::new(1.0, 0.0, 1.0).normalize());
        if along > 0.01 { 10.0 / along } else { f64::INFINITY }
    };
    let maps = cube(256, Kind::Radial, wall);
    let depth = umbrage_shadow::OnPlane::biased(Bias::World(0.12));
    let filter = Pcf::default()
        .with_pattern(Uniform::default().with_num_samples(64))
        .with_depth(depth)
        .with_res_factor(1.0)
        .with_min_size(0.0);
    let around = Around::new(filter, maps).unwrap();
    let normal = DVec3::new(1.0, 0.0, 1.0).normalize();
    for step in 0..400 {
        let (across, up) = (f64::from(KEY.signed(step, 0)) * 0.4, f64::from(KEY.signed(step, 1)) * 6.0);
        let centre = normal * 10.0 + DVec3::new(1.0, 0.0, -1.0).normalize() * across + DVec3::Y * up;
        let at = SurfacePoint { region: step, ..facing(centre, 0.5, step) };
        let at = SurfacePoint { position: EYE + centre, normal: -normal.as_vec3(), ..at };
        let corners = [(1.0, 1.0), (1.0, -1.0), (-1.0, -1.0), (-1.0, 1.0)].map(|(a, b)| {
            (EYE + centre + DVec3::new(1.0, 0.0, -1.0).normalize() * 0.25 * a + DVec3::Y * 0.25 * b).as_vec3()
        });
        assert_eq!(around.fraction(&at.with_corners(corners), KEY), 0.0, "{step}");
    }
}

fn sectors() -> Vec<Raw> {
    let cut = Sectors { count: 5, margin: 0.05, tan_elevation: 0.9, size: UVec2::new(200, 180) };
    sector_views(EYE, 0.1, 100.0, &cut).unwrap().iter().map(|view| map(view, cap)).collect()
}

#[test]
fn w78_10_both_evaluators_agree_and_sectors_see_what_the_cube_sees() {
    let cube = Around::new(presets::ordinary(Bias::World(0.01)).filter, cube(256, Kind::Radial, cap)).unwrap();
    let own = Around::new(presets::ordinary(Bias::World(0.01)).filter, sectors()).unwrap();
    assert_eq!((own.bytes(), own.evaluate), (5 * 200 * 180 * 4, Evaluate::Own));
    let mut every = own.clone();
    every.evaluate = Evaluate::Every;
    let (mut dark, mut differ) = (0, [0, 0]);
    for step in 0..4000 {
        let elevation = f64::from(KEY.signed(step, 0)) * 0.7;
        let (sin, cos) = (f64::from(KEY.unit(step, 1)) * std::f64::consts::TAU).sin_cos();
        let at = facing(DVec3::new(cos, elevation, sin), 0.0, step);
        let answers = [own.fraction(&at, KEY), every.fraction(&at, KEY), cube.fraction(&at, KEY)];
        dark += u32::from(answers[0] == 1.0);
        differ[0] += u32::from(answers[0] != answers[1]);
        differ[1] += u32::from(answers[0] != answers[2]);
    }
    // Away from edges that fall between texels they agree: the cap's edge is met by one in some hundred points.
    assert!(dark > 200 && differ[0] <= 10 && differ[1] <= 60, "{dark} dark, {differ:?} differ");
}

#[test]
fn r87_17_latitude_and_longitude_agree_with_the_cube_across_the_date_line_and_at_the_poles() {
    let about = DVec3::new(-1.0, 0.0, 0.02).normalize();
    for middle in [about, DVec3::Y, DVec3::NEG_Y, DVec3::new(0.3, 0.5, -0.8).normalize()] {
        let spot = move |d: DVec3| if d.dot(middle) > 20f64.to_radians().cos() { 5.0 } else { 20.0 };
        let maps = cube(512, Kind::Radial, spot);
        let lat_long =
            LatLong::from_maps(exact(Uniform::default().with_num_samples(256)), &maps, UVec2::new(1024, 512)).unwrap();
        let cube = Around::new(exact(Uniform::default().with_num_samples(256)), maps).unwrap();
        let mut worst = 0f32;
        for step in 0..600 {
            let turn = f64::from(KEY.unit(step, 0)) * std::f64::consts::TAU;
            let away = (f64::from(KEY.unit(step, 1)) * 40.0).to_radians();
            let side = middle.any_orthonormal_vector();
            let about = side * turn.cos() + middle.cross(side) * turn.sin();
            let at = facing(middle * away.cos() + about * away.sin(), 0.5, step);
            // Near a pole a region's box in latitude and longitude is wider than the region.
            if at.position.distance(EYE + DVec3::Y * 10.0).min(at.position.distance(EYE - DVec3::Y * 10.0)) > 1.5 {
                worst = worst.max((lat_long.fraction(&at, KEY) - cube.fraction(&at, KEY)).abs());
            }
        }
        assert!(worst < 0.3, "{middle}: {worst}");
        // Deep inside and far outside there is no doubt, at the pole itself neither.
        assert_eq!(lat_long.fraction(&facing(middle, 0.1, 0), KEY), 1.0);
        assert_eq!(lat_long.fraction(&facing(-middle, 0.1, 0), KEY), 0.0);
    }
}

#[test]
fn views_that_do_not_stand_around_one_light_are_refused() {
    let new = |maps: Vec<Raw>| Around::new(presets::reeves87().filter, maps).map(|_| ()).unwrap_err();
    assert_eq!(new(Vec::new()), AroundError::Empty);
    let flat = View::orthographic(EYE, EYE + DVec3::X, DVec3::Y, 1.0, 0.1, 9.0, UVec2::ONE).unwrap();
    let empty = |view: View| Raw::new(view, vec![f32::INFINITY; view.size().element_product() as usize]).unwrap();
    assert!(matches!(new(vec![empty(flat)]), AroundError::View { index: 0, .. }));
    let [a, b, ..] = cube_views(EYE, 0.1, 9.0, 4).unwrap();
    let [elsewhere, ..] = cube_views(EYE + DVec3::X, 0.1, 9.0, 4).unwrap();
    assert!(matches!(new(vec![empty(a), empty(elsewhere)]), AroundError::View { index: 1, .. }));
    assert!(matches!(new(vec![empty(a), empty(b.with_kind(Kind::Axial))]), AroundError::View { index: 1, .. }));
    assert!(matches!(new(vec![empty(a.with_kind(Kind::Screen))]), AroundError::View { index: 0, .. }));
    assert!(
        sector_views(EYE, 0.1, 9.0, &Sectors { count: 2, margin: 0.0, tan_elevation: 1.0, size: UVec2::ONE }).is_err()
    );
}
