use glam::{DMat4, DVec3, Vec3};
use proptest::prelude::*;
use umbrage_scene::{Mesh, MeshError};

/// Volume that the triangles enclose; positive when they are counter-clockwise from outside.
fn volume(mesh: &Mesh) -> f64 {
    let six = (0..mesh.triangles.len()).map(|triangle| {
        let [a, b, c] = mesh.corners(triangle).map(Vec3::as_dvec3);
        a.dot(b.cross(c))
    });
    six.sum::<f64>() / 6.0
}

/// How far a vertex normal may turn from its triangle's own.
fn least_agreement(mesh: &Mesh) -> f64 {
    let agree = |triangle: usize| {
        let [a, b, c] = mesh.corners(triangle).map(Vec3::as_dvec3);
        let face = (b - a).cross(c - a).normalize();
        mesh.triangles[triangle].map(|vertex| face.dot(mesh.normals[vertex as usize].as_dvec3()))
    };
    (0..mesh.triangles.len()).flat_map(agree).fold(1.0, f64::min)
}

#[test]
fn x_1_solids_are_closed_and_face_outward() {
    let (at, high) = (Vec3::new(1.0, -2.0, 3.0), Vec3::new(2.0, 1.5, 3.5));
    let tau = std::f64::consts::TAU;
    let solids = [
        (Mesh::sphere(at, 2.0, Mesh::FINE), tau / 1.5 * 8.0, 0.999),
        (Mesh::cuboid(at, high), 1.0 * 3.5 * 0.5, 0.999),
        (Mesh::cylinder(at, high, 0.5, 128), tau / 2.0 * 0.25 * f64::from((high - at).length()), 0.999),
        (Mesh::torus(at, high, 2.0, 0.5, 128), tau * tau / 2.0 * 2.0 * 0.25, 0.99),
        // A truncated cone, and a ring of square section.
        (Mesh::lathe(at, high, &[(0.0, 0.0), (2.0, 0.0), (1.0, 3.0), (0.0, 3.0)], 256), tau / 2.0 * 7.0, 0.999),
        (Mesh::lathe(at, high, &[(2.0, 0.0), (3.0, 0.0), (3.0, 1.0), (2.0, 1.0)], 256), tau / 2.0 * 5.0, 0.999),
        // Mitres take from the inside of a bend what they add to its outside.
        (
            Mesh::tube(&[at, at + Vec3::X * 3.0, at + Vec3::X * 3.0 + Vec3::Y * 4.0], 0.5, 128),
            tau / 2.0 * 0.25 * 7.0,
            0.7,
        ),
        (Mesh::tube(&[at, high], 0.5, 128), tau / 2.0 * 0.25 * f64::from((high - at).length()), 0.999),
    ];
    for (solid, expected, agreement) in solids {
        assert_eq!(solid.check(), Ok(()));
        assert!(solid.is_closed());
        assert!((volume(&solid) / expected - 1.0).abs() < 3e-3, "{} instead of {expected}", volume(&solid));
        assert!(least_agreement(&solid) > agreement, "{}", least_agreement(&solid));
        assert!(solid.normals.iter().all(|normal| (normal.length() - 1.0).abs() < 1e-6));
    }
}

#[test]
fn counts() {
    let sphere = Mesh::sphere(Vec3::ZERO, 1.0, 256);
    assert_eq!((sphere.positions.len(), sphere.triangles.len()), (127 * 256 + 2, 126 * 512 + 512));
    let cuboid = Mesh::cuboid(Vec3::ZERO, Vec3::ONE);
    assert_eq!((cuboid.positions.len(), cuboid.triangles.len()), (24, 12));
    assert_eq!(cuboid.surfaces, [0, 0, 1, 1, 2, 2, 3, 3, 4, 4, 5, 5]);
    assert_eq!(Mesh::sheet([Vec3::ZERO, Vec3::X, Vec3::ONE, Vec3::Y], 3).triangles.len(), 18);
    assert_eq!(Mesh::cylinder(Vec3::ZERO, Vec3::Z, 1.0, 5).triangles.len(), 20);
}

#[test]
fn a_sphere_lies_on_its_sphere_and_reaches_its_extent() {
    let centre = Vec3::new(4.0, 5.0, 6.0);
    let sphere = Mesh::sphere(centre, 12.0, Mesh::FINE);
    let off = |at: &Vec3| ((at.as_dvec3() - centre.as_dvec3()).length() - 12.0).abs();
    assert!(sphere.positions.iter().all(|at| off(at) < 2e-6));
    assert_eq!(sphere.bounds(), Some((centre - 12.0, centre + 12.0)));
    let sagitta = (0..sphere.triangles.len()).map(|triangle| {
        let middle = sphere.corners(triangle).map(Vec3::as_dvec3).iter().sum::<DVec3>() / 3.0;
        12.0 - (middle - centre.as_dvec3()).length()
    });
    assert!(sagitta.fold(0.0, f64::max) < 12.0 / 4000.0);
}

#[test]
fn a_lathe_creases_where_its_profile_turns_sharply() {
    let turned = |profile: &[(f32, f32)]| Mesh::lathe(Vec3::ZERO, Vec3::Y, profile, 16);
    let drum = turned(&[(0.0, 0.0), (1.0, 0.0), (1.0, 2.0), (0.0, 2.0)]);
    assert_eq!(drum.surfaces.iter().max(), Some(&2), "base, side, top");
    let barrel = turned(&[(0.0, 0.0), (1.0, 0.0), (1.3, 1.0), (1.0, 2.0), (0.0, 2.0)]);
    assert_eq!(barrel.surfaces.iter().max(), Some(&2), "two legs of side are one surface");
    let waist = barrel.positions.iter().zip(&barrel.normals).filter(|(at, _)| at.y == 1.0);
    assert!(waist.clone().count() == 32 && waist.clone().all(|(_, normal)| normal.y.abs() < 1e-6));
    assert_eq!(turned(&[]), Mesh::default());
    assert_eq!(turned(&[(0.0, 0.0), (0.0, 1.0)]), Mesh::default(), "the axis alone has no surface");
    assert_eq!(Mesh::tube(&[Vec3::ONE], 1.0, 8), Mesh::default());
}

#[test]
fn a_transformed_mesh_keeps_its_outside_out() {
    let map = DMat4::from_rotation_x(0.7) * DMat4::from_scale(DVec3::new(-1.0, 0.25, 3.0));
    let pressed = Mesh::sphere(Vec3::ZERO, 1.0, 128).transformed(&map);
    assert!(pressed.is_closed());
    assert!(volume(&pressed) > 3.0, "four thirds of pi, times three quarters");
    assert!(least_agreement(&pressed) > 0.9, "{}", least_agreement(&pressed));
    assert!(pressed.normals.iter().all(|normal| (normal.length() - 1.0).abs() < 1e-6));
}

#[test]
fn a_sheet_is_open_and_faces_front() {
    let sheet = Mesh::sheet([Vec3::ZERO, Vec3::X, Vec3::new(1.0, 1.0, 0.0), Vec3::Y], 4);
    assert_eq!(sheet.open_edges(), 16);
    assert!(sheet.normals.iter().all(|normal| *normal == Vec3::Z));
    assert!(least_agreement(&sheet) > 0.999);
}

#[test]
fn closedness_sees_a_hole_a_turned_face_and_a_doubled_one() {
    let whole = Mesh::cuboid(Vec3::ZERO, Vec3::ONE);
    let mut hole = whole.clone();
    hole.triangles.pop();
    assert_eq!(hole.open_edges(), 3);
    let mut turned = whole.clone();
    turned.triangles[0].swap(1, 2);
    assert!(!turned.is_closed());
    let mut doubled = whole.clone();
    doubled.triangles.push(whole.triangles[0]);
    assert!(!doubled.is_closed());
    let mut negative_zero = whole;
    negative_zero.positions[0].x *= -1.0;
    assert!(negative_zero.is_closed(), "-0 and 0 are one place");
}

#[test]
fn appended_meshes_keep_their_triangles_and_surfaces_apart() {
    let mut both = Mesh::cuboid(Vec3::ZERO, Vec3::ONE);
    let other = Mesh::sphere(Vec3::splat(5.0), 1.0, 8);
    both.append(&other);
    assert_eq!(both.check(), Ok(()));
    assert!(both.is_closed());
    assert_eq!(both.corners(12), other.corners(0));
    assert_eq!(both.surfaces[12..], vec![6; other.triangles.len()]);
    let mut from_nothing = Mesh::default();
    from_nothing.append(&other);
    assert_eq!(from_nothing, other);
    assert_eq!(Mesh::default().bounds(), None);
}

#[test]
fn every_fault_is_named() {
    let good = Mesh::cuboid(Vec3::ZERO, Vec3::ONE);
    let broken = |change: fn(&mut Mesh)| {
        let mut mesh = good.clone();
        change(&mut mesh);
        mesh.check().expect_err("the mesh is broken")
    };
    assert_eq!(broken(|mesh| mesh.normals.truncate(3)), MeshError::Normals { positions: 24, normals: 3 });
    assert_eq!(broken(|mesh| mesh.surfaces.truncate(3)), MeshError::Surfaces { triangles: 12, surfaces: 3 });
    assert_eq!(broken(|mesh| mesh.triangles[7][1] = 24), MeshError::Index { triangle: 7, vertex: 24, vertices: 24 });
    assert_eq!(broken(|mesh| mesh.positions[9].y = f32::NAN), MeshError::NotFinite { vertex: 9 });
    assert_eq!(broken(|mesh| mesh.normals[4].z = f32::INFINITY), MeshError::NotFinite { vertex: 4 });
}

proptest! {
    #[test]
    fn solids_stay_closed_wherever_and_however_coarse(
        x in -1e3f32..1e3, y in -1e3f32..1e3, z in -1e3f32..1e3, radius in 0.01f32..100.0, segments in 0u32..40,
    ) {
        let at = Vec3::new(x, y, z);
        prop_assert!(Mesh::sphere(at, radius, segments).is_closed());
        prop_assert!(Mesh::cylinder(at, at + Vec3::new(y, z, 1.0), radius, segments).is_closed());
        prop_assert!(Mesh::torus(at, Vec3::new(z, 1.0, x), 2.0 * radius, radius, segments).is_closed());
        prop_assert!(Mesh::cuboid(at, at + radius).is_closed());
        let profile = [(0.0, -radius), (radius, 0.0), (0.5 * radius, radius), (0.0, radius)];
        prop_assert!(Mesh::lathe(at, Vec3::new(z, 1.0, x), &profile, segments).is_closed());
        let ring = [(radius, 0.0), (2.0 * radius, 0.0), (1.5 * radius, radius)];
        prop_assert!(Mesh::lathe(at, Vec3::new(z, 1.0, x), &ring, segments).is_closed());
        let bent = [at, at + Vec3::X * 4.0 * radius, at + Vec3::new(7.0, 2.0, 1.0) * radius];
        let tube = Mesh::tube(&bent, radius, segments);
        prop_assert!(tube.is_closed());
        let mirrored = DMat4::from_scale(DVec3::new(-1.0, 2.0, 0.5));
        prop_assert!(tube.transformed(&mirrored).is_closed());
    }
}
