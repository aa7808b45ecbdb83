//! rays against bodies whose shadows are known.
use crate::bodies::{cuboid, floor, normal, rectangle, sphere};
use glam::{DMat3, DQuat, DVec3, DVec4, Vec3};
use proptest::prelude::*;
use umbrage_oracle::{Body, Face, Geometry, RayCast, predict};
use umbrage_plane::SurfacePoint;
use umbrage_sample::Key;
use umbrage_shadow::Shadow;

const SOLID: Body = Body { casts: true, solid: true, passes: Vec3::ZERO };
const SHEET: Body = Body { casts: true, solid: false, passes: Vec3::ZERO };

fn direction() -> impl Strategy<Value = DVec3> {
    (-1.0..1.0, 0.0..std::f64::consts::TAU).prop_map(|(y, around): (f64, f64)| {
        let ring = (1.0 - y * y).sqrt();
        DVec3::new(ring * around.cos(), y, ring * around.sin())
    })
}

/// A point of a face, rounded to f32 as a picture's positions are. Often on an edge or close to one.
fn point_of(face: &Face, key: Key, sample: u32) -> Vec3 {
    let [a, b, c] = face.corners.map(Vec3::as_dvec3);
    let (mut s, mut t) = (f64::from(key.unit(sample, 0)), f64::from(key.unit(sample, 1)));
    match sample % 4 {
        0 => t = 0.0,
        1 => s = 1e-7,
        _ => {}
    }
    if s + t > 1.0 {
        (s, t) = (1.0 - s, 1.0 - t);
    }
    (a + (b - a) * s + (c - a) * t).as_vec3()
}

/// On a convex body a point is dark exactly where it does not face the light.
fn convex_is_right(faces: Vec<Face>, light: DVec4) -> Result<(), TestCaseError> {
    let geometry = Geometry::from_faces(faces, vec![SOLID]);
    let truth = RayCast::everywhere(&geometry, light);
    for (index, face) in geometry.faces().iter().enumerate() {
        for sample in 0..8 {
            let position = point_of(face, Key::new(1, 0, 0).region(index as u32), sample);
            let normal = normal(face);
            let cosine = normal.dot((light.truncate() - position.as_dvec3() * light.w).normalize());
            if cosine.abs() > 1e-5 {
                let shadow = truth.at(&SurfacePoint::at(position, normal.as_vec3()));
                prop_assert_eq!(shadow, if cosine > 0.0 { 0.0 } else { 1.0 }, "cosine {} at {}", cosine, position);
            }
        }
    }
    Ok(())
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(48))]

    #[test]
    fn x5_convex_bodies_do_not_shadow_themselves(
        toward in direction(), axis in direction(), angle in 0.0..6.3f64, centre in direction(), scale in -2.0..3.0f64,
        directional in any::<bool>(),
    ) {
        let size = 10f64.powf(scale);
        let light = if directional { toward.extend(0.0) } else { (toward * size * 9.0).extend(1.0) };
        let turn = DMat3::from_quat(DQuat::from_axis_angle(axis, angle));
        let half = DVec3::new(1.0, 0.7, 0.2) * size;
        convex_is_right(cuboid(centre * size - half, centre * size + half, turn, 0), light)?;
        convex_is_right(sphere(centre * size, size, 24, 0), light)?;
    }

    #[test]
    fn closed_surfaces_have_no_gaps(corner in 0usize..3, face in 0usize..1000, along in 0.0..1.0f64, inside in direction()) {
        let faces = sphere(DVec3::new(3.0, -2.0, 40.0), 5.0, 32, 0);
        let target = faces[face % faces.len()].corners;
        let geometry = Geometry::from_faces(faces, vec![SOLID]);
        let origin = DVec3::new(3.0, -2.0, 40.0) + inside * 2.0;
        // At a vertex, along an edge, and a rounding beside it.
        for place in [0.0, along, 1.0] {
            let at = target[corner].as_dvec3().lerp(target[(corner + 1) % 3].as_dvec3(), place);
            prop_assert!(geometry.first_hit(origin, at - origin).is_some());
            prop_assert!(geometry.occluded_toward(origin, at - origin));
            prop_assert!(geometry.occluded(origin, origin + (at - origin) * 1.01));
            prop_assert!(!geometry.occluded(origin, origin + (at - origin) * 0.9));
        }
    }

    #[test]
    fn tree_agrees_with_asking_every_face(seed in any::<u32>(), origin in direction(), way in direction()) {
        let key = Key::new(seed, 0, 0);
        let faces: Vec<Face> = (0..60)
            .map(|i| {
                let corner = |c| Vec3::new(key.signed(i, c), key.signed(i, c + 1), key.signed(i, c + 2));
                // Some are flat in an axis, some slivers, some points.
                let a = corner(0);
                let (b, c) = (corner(1), corner(3));
                let corners = match i % 4 {
                    0 => [a, b, c],
                    1 => [a, Vec3::new(a.x, b.y, b.z), Vec3::new(a.x, c.y, c.z)],
                    2 => [a, a + (b - a) * 1e-6, c],
                    _ => [a, a, a],
                };
                Face { corners, object: 0 }
            })
            .collect();
        let geometry = Geometry::from_faces(faces.clone(), vec![SHEET]);
        for (origin, way) in [(origin * 2.0, way - origin * 2.0), (origin * 0.3, way), (origin * 0.3, DVec3::X * way.x)] {
            let mut expected: Vec<u32> = (0..faces.len() as u32)
                .filter(|&i| moller_trumbore(&faces[i as usize], origin, way).is_some_and(|t| t > 1e-12))
                .collect();
            let mut found: Vec<u32> = geometry.hits(origin, way).iter().map(|hit| hit.face).collect();
            let first = geometry.first_hit(origin, way).map(|hit| hit.face);
            prop_assert_eq!(first, found.first().copied());
            found.sort_unstable();
            expected.sort_unstable();
            prop_assert_eq!(found, expected);
        }
    }
}

/// Möller & Trumbore 1997 in f64, another formula than the one tested.
fn moller_trumbore(face: &Face, origin: DVec3, way: DVec3) -> Option<f64> {
    let [a, b, c] = face.corners.map(Vec3::as_dvec3);
    let (ab, ac) = (b - a, c - a);
    let p = way.cross(ac);
    let determinant = ab.dot(p);
    if determinant == 0.0 {
        return None;
    }
    let s = origin - a;
    let u = s.dot(p) / determinant;
    let q = s.cross(ab);
    let v = way.dot(q) / determinant;
    (u >= 0.0 && v >= 0.0 && u + v <= 1.0).then(|| ac.dot(q) / determinant)
}

#[test]
fn d16_shadow_of_a_sphere_on_a_floor() {
    let (centre, radius) = (DVec3::new(0.5, 3.0, -0.25), 1.25);
    let ball = sphere(centre, radius, 96, 0);
    // No vertex lies outside the sphere by more than a rounding, no face inside this one.
    let inner = ball.iter().map(|face| normal(face).dot(face.corners[0].as_dvec3() - centre)).fold(radius, f64::min);
    assert!(inner > radius * 0.997);
    let geometry = Geometry::from_faces(ball.into_iter().chain(floor(100.0, 1)).collect(), vec![SOLID, SOLID]);
    let key = Key::new(7, 0, 0);
    for light in [DVec4::new(6.0, 12.0, 2.0, 1.0), DVec4::new(3.0, 5.0, -1.0, 0.0)] {
        let truth = RayCast::everywhere(&geometry, light);
        let (mut dark, mut undecided) = (0, 0);
        for sample in 0..10_000 {
            let position = Vec3::new(key.signed(sample, 0) * 6.0 - 1.0, 0.0, key.signed(sample, 1) * 6.0);
            let from = position.as_dvec3();
            let way = (light.truncate() - from * light.w).normalize();
            let miss = (centre - from).cross(way).length();
            let shadow = truth.at(&SurfacePoint { object: 1, ..SurfacePoint::at(position, Vec3::Y) });
            if miss < inner - 1e-6 {
                assert_eq!(shadow, 1.0, "at {position}");
                dark += 1;
            } else if miss > radius + 1e-6 {
                assert_eq!(shadow, 0.0, "at {position}");
            } else {
                undecided += 1;
            }
        }
        assert!(dark > 300, "the shadow was not met: {dark}");
        assert!(undecided < 20, "the mesh bounds its error badly: {undecided}");
    }
}

#[test]
fn m7_shadows_begin_at_the_contact() {
    let block = cuboid(DVec3::new(-2.0, 0.0, -5.0), DVec3::new(2.0, 3.0, 5.0), DMat3::IDENTITY, 0);
    let geometry = Geometry::from_faces(block.into_iter().chain(floor(100.0, 1)).collect(), vec![SOLID, SOLID]);
    let truth = RayCast::everywhere(&geometry, DVec4::new(-1.0, 0.4, 0.0, 0.0));
    let at = |x: f32| truth.at(&SurfacePoint { object: 1, ..SurfacePoint::at(Vec3::new(x, 0.0, 0.3), Vec3::Y) });
    for distance in [1e-4, 1e-3, 0.1, 7.0, 7.4999] {
        assert_eq!(at(2.0 + distance), 1.0, "behind the block, {distance} from its foot");
        assert_eq!(at(-2.0 - distance), 0.0, "before the block, {distance} from its foot");
    }
    assert_eq!(at(9.5 + 1e-4), 0.0, "beyond the shadow's end");
    assert_eq!(at(0.0), 1.0, "under the block");
}

#[test]
fn sheets_do_not_shadow_the_point_they_carry() {
    let card = rectangle([Vec3::ZERO, Vec3::X, Vec3::X + Vec3::Z, Vec3::Z], 0);
    let geometry = Geometry::from_faces(card.to_vec(), vec![SHEET]);
    for toward in [DVec3::Y, DVec3::new(0.9, -0.1, 0.0)] {
        let truth = RayCast::everywhere(&geometry, toward.extend(0.0));
        for side in [Vec3::Y, Vec3::NEG_Y] {
            assert_eq!(truth.at(&SurfacePoint::at(Vec3::new(0.5, 0.0, 0.25), side)), 0.0);
        }
        let behind = Vec3::new(0.5, -0.1 * toward.y.signum() as f32, 0.5);
        let expected = if toward.y > 0.5 { 1.0 } else { 0.0 };
        assert_eq!(truth.at(&SurfacePoint::at(behind, Vec3::Y)), expected);
    }
}

#[test]
fn nothing_to_hit() {
    let nowhere = Face { corners: [Vec3::NAN, Vec3::X, Vec3::Y], object: 0 };
    for faces in [vec![], vec![nowhere]] {
        let geometry = Geometry::from_faces(faces, vec![]);
        assert!(geometry.faces().is_empty());
        assert_eq!(geometry.first_hit(DVec3::ZERO, DVec3::X), None);
        assert!(!geometry.occluded(DVec3::ZERO, DVec3::X));
    }
    let geometry = Geometry::from_faces(floor(1.0, 0).to_vec(), vec![]);
    assert_eq!(geometry.first_hit(DVec3::Y, DVec3::ZERO), None);
    assert!(!geometry.occluded(DVec3::Y, DVec3::Y));
    assert_eq!(geometry.body(9), Body::default());
}

#[test]
fn a_batch_is_its_points() {
    let geometry = Geometry::from_faces(
        sphere(DVec3::Y * 2.0, 1.0, 24, 0).into_iter().chain(floor(9.0, 1)).collect(),
        vec![SOLID, SOLID],
    );
    let truth = RayCast::everywhere(&geometry, DVec4::new(1.0, 5.0, 0.0, 1.0));
    let key = Key::new(3, 0, 0);
    let points: Vec<SurfacePoint> = (0..500)
        .map(|i| SurfacePoint {
            region: i,
            object: 1,
            ..SurfacePoint::at(Vec3::new(key.signed(i, 0), 0.0, key.signed(i, 1)) * 3.0, Vec3::Y)
        })
        .collect();
    let mut out = vec![f32::NAN; points.len()];
    truth.fractions(&points, key, &mut out);
    assert!(out.contains(&0.0) && out.contains(&1.0));
    for (point, shadow) in points.iter().zip(out) {
        assert_eq!(truth.fraction(point, key), shadow);
    }
}

#[test]
fn a_batch_of_points_far_apart_is_its_points() {
    let key = Key::new(8, 0, 0);
    let ball = |i: u32| {
        let at = [0, 1, 2].map(|axis| f64::from(key.signed(i, axis)) * 6.0);
        sphere(DVec3::from(at), 0.3 + 0.5 * f64::from(key.unit(i, 3)), 12, i)
    };
    let balls = 60;
    let faces: Vec<Face> = (0..balls).flat_map(ball).collect();
    // Neighbours in the list lie on different bodies, and on both sides of them.
    let points: Vec<SurfacePoint> = (0..2000u32)
        .map(|i| {
            let face = &faces[(i as usize * 977) % faces.len()];
            let (at, normal) = (point_of(face, key, i), normal(face));
            SurfacePoint { region: i, object: face.object, ..SurfacePoint::at(at, normal.as_vec3()) }
        })
        .collect();
    let geometry = Geometry::from_faces(faces, vec![SOLID; balls as usize]);
    for light in [DVec4::new(0.5, 9.0, -0.2, 1.0), DVec4::new(0.0, 1.0, 0.0, 0.0), DVec4::new(0.3, 0.5, -0.8, 0.0)] {
        let truth = RayCast::everywhere(&geometry, light);
        let mut out = vec![f32::NAN; points.len()];
        truth.fractions(&points, key, &mut out);
        assert!(out.contains(&0.0) && out.contains(&1.0), "{light}");
        for (point, shadow) in points.iter().zip(out) {
            assert_eq!(truth.at(point), shadow, "{light}: {point:?}");
        }
    }
}

#[test]
fn v46c_d19_lit_share_of_a_disc() {
    let geometry = Geometry::from_faces(sphere(DVec3::ZERO, 1.0, 256, 0), vec![SOLID]);
    for degrees in [80.0f64, 100.0] {
        let angle = degrees.to_radians();
        let truth = RayCast::everywhere(&geometry, DVec4::new(-angle.sin(), 0.0, angle.cos(), 0.0));
        let (mut lit, mut all, mut limb) = (0u32, 0u32, f64::NEG_INFINITY);
        for i in 0..300 * 300 {
            let at = DVec3::new(f64::from(i % 300) - 149.5, f64::from(i / 300) - 149.5, 300.0) / 150.0;
            let Some(hit) = geometry.first_hit(at, DVec3::NEG_Z) else { continue };
            all += 1;
            if truth.at(&SurfacePoint::at(hit.position.as_vec3(), hit.normal.as_vec3())) == 0.0 {
                lit += 1;
                limb = limb.max(if at.y.abs() < 0.01 { at.x } else { f64::NEG_INFINITY });
            }
        }
        let share = f64::from(lit) / f64::from(all);
        assert!((share - predict::lit_share(angle)).abs() < 0.01, "{degrees}°: {share}");
        // The light is on the left: the terminator lies left of the centre for more than 90°.
        assert!((limb + predict::terminator_offset(angle)).abs() < 0.02, "{degrees}°: {limb}");
    }
}
