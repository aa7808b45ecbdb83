//! Truth against integers, and what must not change it: where a scene lies, how large it is, and what no ray meets.

use crate::bodies::{cuboid, floor, normal, rectangle};
use glam::{DMat3, DVec3, DVec4, I64Vec3, Vec3};
use proptest::prelude::*;
use umbrage_oracle::{Body, Face, Geometry, RayCast};
use umbrage_plane::SurfacePoint;
use umbrage_sample::Key;

const SOLID: Body = Body { casts: true, solid: true, passes: Vec3::ZERO };
const SHEET: Body = Body { casts: true, solid: false, passes: Vec3::ZERO };

/// Whether an open segment crosses a face, decided without rounding.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Crossing {
    Missed,
    Inside,
    /// Through its border.
    Border,
}

/// Six times the volume of a tetrahedron.
fn volume(a: I64Vec3, b: I64Vec3, c: I64Vec3, d: I64Vec3) -> i64 {
    (b - a).dot((c - a).cross(d - a))
}

fn crossing(from: I64Vec3, to: I64Vec3, [a, b, c]: [I64Vec3; 3]) -> Crossing {
    let (before, behind) = (volume(a, b, c, from).signum(), volume(a, b, c, to).signum());
    if before * behind >= 0 {
        return Crossing::Missed;
    }
    let sides = [volume(from, to, a, b), volume(from, to, b, c), volume(from, to, c, a)].map(i64::signum);
    match (sides.contains(&1), sides.contains(&-1), sides.contains(&0)) {
        (true, true, _) => Crossing::Missed,
        (_, _, true) => Crossing::Border,
        _ => Crossing::Inside,
    }
}

/// Corners and ends are integers within ±512: every number on the way fits 64 bits.
fn lattice(key: Key, index: u32, first: u32) -> I64Vec3 {
    let at = |axis: u32| (f64::from(key.signed(index, first + axis)) * 512.0) as i64;
    I64Vec3::new(at(0), at(1), at(2))
}

/// Ordinary triangles, slivers, and quadrilaterals of two triangles.
fn soup(key: Key) -> Vec<[I64Vec3; 3]> {
    let mut soup = Vec::new();
    for index in 0..24 {
        let (a, b, c) = (lattice(key, index, 0), lattice(key, index, 3), lattice(key, index, 6));
        match index % 3 {
            0 => soup.push([a, b, c]),
            1 => soup.push([a, b, (a + b) / 2 + I64Vec3::new(0, 1, i64::from(index % 2))]),
            _ => soup.extend([[a, b, c], [a, c, a + c - b]]),
        }
    }
    soup
}

#[test]
fn truth_agrees_with_integers_on_a_hundred_thousand_rays() {
    let (mut inside, mut borders, mut missed) = (0, 0, 0);
    for scene in 0..100 {
        let key = Key::new(scene, 0, 0);
        let soup = soup(key);
        let faces = soup.iter().map(|corners| Face { corners: corners.map(I64Vec3::as_vec3), object: 0 });
        let geometry = Geometry::from_faces(faces.collect(), vec![SHEET]);
        for ray in 0..1000 {
            let from = lattice(key, 1000 + ray, 0);
            // Every other ray is aimed at a corner, at the middle of an edge, or at a point of a face.
            let [a, b, c] = soup[ray as usize % soup.len()];
            let to = match ray % 8 {
                0 => from + (a - from) * 2,
                2 => from + (a + b - from * 2),
                4 => from + (a + b + c - from * 3),
                6 => from + (a + c - from * 2),
                _ => lattice(key, 1000 + ray, 3),
            };
            let crossings = soup.iter().map(|corners| crossing(from, to, *corners));
            let (sure, border) = crossings.fold((false, 0), |(sure, border), crossing| {
                (sure || crossing == Crossing::Inside, border + i32::from(crossing == Crossing::Border))
            });
            let found = geometry.occluded(from.as_dvec3(), to.as_dvec3());
            match (sure, border) {
                (true, _) => assert!(found, "scene {scene}, ray {ray}: {from} to {to} crosses a face"),
                (false, 0) => assert!(!found, "scene {scene}, ray {ray}: {from} to {to} crosses none"),
                // An edge that two faces share has no gap.
                (false, 2..) if ray % 8 == 6 && ray as usize % soup.len() % 4 == 2 => {
                    assert!(found, "scene {scene}, ray {ray}");
                }
                _ => {}
            }
            inside += i32::from(sure);
            borders += i32::from(!sure && border > 0);
            missed += i32::from(!sure && border == 0);
        }
    }
    // Every kind is there, slivers and edges included.
    assert!(inside > 20_000 && borders > 1_000 && missed > 10_000, "{inside} {borders} {missed}");
}

/// A scene of half units: boxes on a floor and sheets between them, with the places that are tested.
struct Yard {
    faces: Vec<Face>,
    /// On the faces, by weights that halve exactly, and free in space.
    points: Vec<SurfacePoint>,
    light: DVec4,
}

const YARD: [Body; 4] = [SOLID, SOLID, SOLID, SHEET];

fn halves(key: Key, index: u32, reach: f64) -> DVec3 {
    let at = |axis: u32| (f64::from(key.signed(index, axis)) * 2.0 * reach).round() / 2.0;
    DVec3::new(at(0), at(1).abs(), at(2))
}

fn yard(seed: u32, directional: bool) -> Yard {
    let key = Key::new(seed, 1, 0);
    let mut faces = floor(64.0, 0).to_vec();
    for object in 1..3 {
        let (low, size) = (halves(key, object, 20.0) * DVec3::new(1.0, 0.0, 1.0), halves(key, object + 10, 10.0).abs());
        faces.extend(cuboid(low, low + size + 0.5, DMat3::IDENTITY, object));
    }
    for sheet in 0..4 {
        let corner = |index: u32| halves(key, 40 + sheet * 8 + index, 20.0).as_vec3();
        faces.push(Face { corners: [corner(0), corner(1), corner(2)], object: 3 });
    }
    let mut points = Vec::new();
    for (index, face) in (0..).zip(&faces) {
        let [a, b, c] = face.corners.map(Vec3::as_dvec3);
        let facing = normal(face);
        for (s, t) in [(0.25, 0.25), (0.5, 0.25), (0.0, 0.5), (0.5, 0.5), (0.0, 0.0)] {
            let position = a + (b - a) * s + (c - a) * t;
            if facing.is_finite() {
                points.push(SurfacePoint { object: face.object, ..SurfacePoint::at(position, facing.as_vec3()) });
            }
        }
        let free = halves(key, 500 + index, 30.0) + DVec3::new(0.125, 0.25, 0.0);
        points.push(SurfacePoint { object: 9, ..SurfacePoint::at(free, Vec3::Y) });
    }
    let light = halves(key, 900, 30.0) + DVec3::Y * 12.0;
    let light = light.extend(if directional { 0.0 } else { 1.0 });
    // A point that sees the light exactly past an edge lies on a shadow's border: both answers are right there.
    points.retain(|point| faces.iter().all(|face| !sees_past_border(point.position, light, face)));
    Yard { faces, points, light }
}

/// Whether the light's ray to a point goes exactly through a face's border, all of eighths of a unit.
fn sees_past_border(point: DVec3, light: DVec4, face: &Face) -> bool {
    let eighths = |at: DVec3| (at * 8.0).as_i64vec3();
    let (from, toward) = (eighths(point), eighths(light.truncate()));
    // As far as any face of a yard reaches along a direction whose steps are halves.
    let to = if light.w == 0.0 { from + toward * 64 } else { toward };
    crossing(from, to, face.corners.map(|corner| eighths(corner.as_dvec3()))) == Crossing::Border
}

/// What is in shadow after everything was moved and then made larger.
fn shadows(yard: &Yard, by: DVec3, factor: f64, more: &[Face]) -> Vec<f32> {
    let to = |at: DVec3| (at + by) * factor;
    let exact = |at: Vec3| {
        let there = to(at.as_dvec3()).as_vec3();
        assert_eq!(there.as_dvec3(), to(at.as_dvec3()), "the move is exact");
        there
    };
    let faces = yard.faces.iter().map(|face| Face { corners: face.corners.map(exact), ..*face });
    let geometry = Geometry::from_faces(faces.chain(more.iter().copied()).collect(), YARD.to_vec());
    let light = if yard.light.w == 0.0 { yard.light } else { to(yard.light.truncate()).extend(1.0) };
    let truth = RayCast::everywhere(&geometry, light);
    yard.points.iter().map(|point| truth.at(&SurfacePoint { position: to(point.position), ..*point })).collect()
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(60))]

    #[test]
    fn truth_does_not_change_where_a_scene_is_moved_by_exact_amounts(
        seed in any::<u32>(), directional in any::<bool>(), power in 1..22i32, way in proptest::array::uniform3(-1..=1i32),
    ) {
        let yard = yard(seed, directional);
        // At 2²² steps of f32 are halves.
        let by = DVec3::from(way.map(f64::from)) * (2f64.powi(power) - 256.0).max(1.0);
        prop_assert_eq!(shadows(&yard, DVec3::ZERO, 1.0, &[]), shadows(&yard, by, 1.0, &[]));
    }

    #[test]
    fn truth_does_not_change_with_a_power_of_two(seed in any::<u32>(), directional in any::<bool>(), power in -40..40i32) {
        let yard = yard(seed, directional);
        prop_assert_eq!(shadows(&yard, DVec3::ZERO, 1.0, &[]), shadows(&yard, DVec3::ZERO, 2f64.powi(power), &[]));
    }

    #[test]
    fn truth_does_not_change_with_what_no_ray_meets(seed in any::<u32>(), directional in any::<bool>(), size in 1.0..1e9f32) {
        let yard = yard(seed, directional);
        // Below all that is tested, and the light is above.
        let corner = |x: f32, z: f32| Vec3::new(x * size, -200.0 - size, z * size);
        let below = rectangle([corner(-1.0, -1.0), corner(-1.0, 1.0), corner(1.0, 1.0), corner(1.0, -1.0)], 1);
        prop_assert_eq!(shadows(&yard, DVec3::ZERO, 1.0, &[]), shadows(&yard, DVec3::ZERO, 1.0, &below));
    }
}

#[test]
fn a_box_far_away_shadows_as_it_does_near() {
    for offset in [0.0, 1024.0, 65_536.0, 1_048_576.0, 4_194_304.0] {
        let along = |x: f64, y: f64, z: f64| DVec3::new(offset + x, y, z);
        let faces = cuboid(along(-0.5, 0.0, -0.5), along(0.5, 1.0, 0.5), DMat3::IDENTITY, 0);
        let geometry = Geometry::from_faces(faces, vec![SOLID]);
        let truth = RayCast::everywhere(&geometry, DVec4::new(1.0, 0.25, 0.0, 0.0));
        assert_eq!(truth.at(&SurfacePoint::at(along(-1.5, 0.0, 0.0), Vec3::Y)), 1.0, "at {offset}");
        assert_eq!(truth.at(&SurfacePoint::at(along(-5.5, 0.0, 0.0), Vec3::Y)), 0.0, "beyond its shadow, at {offset}");
    }
}

#[test]
fn shadows_begin_at_a_contact() {
    // A box on a floor, the light behind it: 10⁻⁹ before the wall is dark, on whichever object.
    let mut faces = floor(8.0, 0).to_vec();
    faces.extend(cuboid(DVec3::new(0.0, 0.0, -1.0), DVec3::new(1.0, 2.0, 1.0), DMat3::IDENTITY, 1));
    let geometry = Geometry::from_faces(faces, vec![SOLID, SOLID]);
    let truth = RayCast::everywhere(&geometry, DVec4::new(1.0, 1.0, 0.0, 0.0));
    for gap in [1e-9, 1e-6, 1e-3, 1.0] {
        assert_eq!(truth.at(&SurfacePoint::at(DVec3::new(-gap, 0.0, 0.0), Vec3::Y)), 1.0, "{gap}");
    }
    assert_eq!(truth.at(&SurfacePoint::at(DVec3::new(-2.1, 0.0, 0.0), Vec3::Y)), 0.0);
}

#[test]
fn a_surface_that_holds_the_light_blocks_none_of_it() {
    let geometry = Geometry::from_faces(floor(8.0, 1).to_vec(), vec![SOLID, SHEET]);
    for lamp in [DVec3::ZERO, DVec3::new(0.3, 0.0, -0.7), DVec3::new(8.0, 0.0, 8.0)] {
        let truth = RayCast::everywhere(&geometry, lamp.extend(1.0));
        for side in [-1.0, 1.0] {
            for step in 0..60 {
                let wall = lamp + DVec3::new(5.0, side * (1.0 + f64::from(step) / 10.0), 0.3);
                assert_eq!(truth.at(&SurfacePoint::at(wall, Vec3::NEG_X)), 0.0, "{lamp} {wall}");
            }
        }
        // A light a millimetre above it shines on its own side alone.
        let above = RayCast::everywhere(&geometry, (lamp + DVec3::Y * 1e-3).extend(1.0));
        let wall = |y: f64| SurfacePoint::at(DVec3::new(-4.0, y, 0.2), Vec3::X);
        assert_eq!((above.at(&wall(1.0)), above.at(&wall(-1.0))), (0.0, 1.0), "{lamp}");
    }
}

/// A point that was rounded to f32 lies beside its surface, whether it names its object or not.
#[test]
fn rounded_points_do_not_shadow_themselves_whatever_object_they_name() {
    let turn = DMat3::from_rotation_z(0.37) * DMat3::from_rotation_x(-0.21);
    let lift = DVec3::new(1.0, 2.0, -3.0);
    let faces: Vec<Face> = floor(50.0, 1)
        .iter()
        .map(|face| Face { corners: face.corners.map(|at| (turn * at.as_dvec3() + lift).as_vec3()), object: 1 })
        .collect();
    let up = normal(&faces[0]);
    let geometry = Geometry::from_faces(faces.clone(), vec![SOLID, SHEET]);
    let truth = RayCast::everywhere(&geometry, (up + up.any_orthonormal_vector() * 3.0).extend(0.0));
    let key = Key::new(5, 0, 0);
    for i in 0..2000 {
        let [a, b, c] = faces[i as usize % 2].corners.map(Vec3::as_dvec3);
        let (s, t) = (f64::from(key.unit(i, 0)) * 0.5, f64::from(key.unit(i, 1)) * 0.5);
        let position = (a + (b - a) * s + (c - a) * t).as_vec3();
        for object in [0, 1, 7] {
            let point = SurfacePoint { object, ..SurfacePoint::at(position, up.as_vec3()) };
            assert_eq!(truth.at(&point), 0.0, "{position} of object {object}");
        }
    }
}
