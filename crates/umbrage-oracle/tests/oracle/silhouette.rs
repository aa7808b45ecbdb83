//! The mask for second depth: how far pixels lie from silhouettes in the light's view.
use glam::{DVec3, UVec2, Vec3};
use umbrage_oracle::metrics::silhouette_distance;
use umbrage_oracle::{Geometry, RayCast};
use umbrage_plane::{SurfacePoint, View};
use umbrage_sample::Key;
use umbrage_scene::{Material, Mesh, Object, Scene, Shape, gallery};

/// Above the origin, looking down on 64 × 64 world units; a texel is `64 / side` of them.
fn sun(side: u32) -> View {
    let size = UVec2::splat(side);
    View::orthographic(DVec3::Y * 50.0, DVec3::ZERO, DVec3::NEG_Z, 32.0, 1.0, 100.0, size).unwrap()
}

fn lamp(height: f64) -> View {
    let size = UVec2::splat(64);
    View::perspective(DVec3::Y * height, DVec3::ZERO, DVec3::NEG_Z, 2.0, 1.0, 100.0, size).unwrap()
}

fn scene(meshes: Vec<Mesh>) -> Scene {
    let object = |mesh| Object::two_sided("thing", Shape::Mesh(mesh), Material::matt(Vec3::ONE));
    Scene {
        name: String::new(),
        origin: DVec3::ZERO,
        objects: meshes.into_iter().map(object).collect(),
        lights: vec![],
        ambient: Vec3::ZERO,
        background: Vec3::ZERO,
        camera: sun(64),
    }
}

fn near(found: &[f32], expected: &[f32]) {
    for (a, b) in found.iter().zip(expected) {
        assert!((a - b).abs() < 1e-3, "{found:?} is not {expected:?}");
    }
}

#[test]
fn a_box_has_its_outline_and_no_creases() {
    let cube = scene(vec![Mesh::cuboid(Vec3::splat(-10.0), Vec3::splat(10.0))]);
    let places = [(0.0, 0.0), (7.0, 3.0), (9.5, 9.5), (12.0, 0.0), (13.0, 14.0), (-17.0, 0.0), (25.0, 0.0)];
    let at = places.map(|(x, z)| Vec3::new(x, -12.0, z));
    // The diagonals of top and bottom are creases: the middle is as far as can be.
    near(&silhouette_distance(&sun(64), &cube, &at, 8.0), &[8.0, 3.0, 0.5, 2.0, 5.0, 7.0, 8.0]);
    near(&silhouette_distance(&sun(128), &cube, &at, 8.0), &[8.0, 6.0, 1.0, 4.0, 8.0, 8.0, 8.0]);
    near(&silhouette_distance(&sun(64), &cube, &at, 20.0)[..1], &[10.0]);
    // In perspective the top edges, nearer to the light, have the outline: at height 10 of 20 they fall on ±20 of the floor.
    let on_floor = [18.0, 20.0, 24.0].map(|x| Vec3::new(x, -0.0, 0.0));
    let flat = scene(vec![Mesh::cuboid(Vec3::new(-10.0, 5.0, -10.0), Vec3::new(10.0, 10.0, 10.0))]);
    let view = lamp(20.0);
    let texel = view.texel_world(20.0).x as f32;
    let expected = [2.0 / texel, 0.0, 4.0 / texel];
    near(&silhouette_distance(&view, &flat, &on_floor, 8.0), &expected);
}

#[test]
fn open_edges_count_whichever_way_a_sheet_is_wound() {
    let corners = [(-10.0, 10.0), (10.0, 10.0), (10.0, -10.0), (-10.0, -10.0)].map(|(x, z)| Vec3::new(x, 0.0, z));
    let up = Mesh::sheet(corners, 4);
    let mut mixed = up.clone();
    for triangle in mixed.triangles.iter_mut().step_by(2) {
        triangle.swap(0, 1);
    }
    let mut down = up.clone();
    down.triangles.iter_mut().for_each(|triangle| triangle.swap(0, 1));
    for sheet in [up, mixed, down] {
        let at = [Vec3::ZERO, Vec3::new(2.5, 0.0, 2.5), Vec3::new(8.0, 0.0, 0.0), Vec3::new(0.0, -9.0, 13.0)];
        near(&silhouette_distance(&sun(64), &scene(vec![sheet]), &at, 6.0), &[6.0, 6.0, 2.0, 3.0]);
    }
}

#[test]
fn places_the_map_does_not_hold_have_no_distance() {
    let cube = scene(vec![Mesh::cuboid(Vec3::splat(-10.0), Vec3::splat(10.0))]);
    let outside = [Vec3::X * 33.0, Vec3::NAN, Vec3::Z * -32.5];
    assert!(silhouette_distance(&sun(64), &cube, &outside, 8.0).iter().all(|distance| distance.is_nan()));
    let behind = [Vec3::Y * 25.0, Vec3::Y * 20.0];
    assert!(silhouette_distance(&lamp(20.0), &cube, &behind, 8.0).iter().all(|distance| distance.is_nan()));
    assert!(silhouette_distance(&sun(64), &cube, &[Vec3::ZERO], f32::NAN)[0].is_nan());
    assert_eq!(silhouette_distance(&sun(64), &scene(vec![]), &[Vec3::ZERO], 8.0), [8.0]);
    assert_eq!(silhouette_distance(&sun(64), &cube, &[Vec3::ZERO], 0.0), [0.0]);
}

#[test]
fn edges_that_pass_the_light_are_cut_there() {
    // A tall thin blade from below the floor to above the light, its side 5 to the right of the light.
    let blade = scene(vec![Mesh::cuboid(Vec3::new(5.0, -10.0, -40.0), Vec3::new(6.0, 60.0, 40.0))]);
    let at = [Vec3::ZERO, Vec3::new(4.0, -10.0, 0.0)];
    let found = silhouette_distance(&lamp(20.0), &blade, &at, 8.0);
    let texel = lamp(20.0).texel_world(30.0).x as f32;
    // Both see the foot of the blade's near side.
    near(&found, &[5.0 / texel, 1.0 / texel]);
}

/// Asking every segment by hand gives the same as the squares.
#[test]
fn squares_lose_no_segment() {
    let corner = |key: Key, i: u32| Vec3::new(40.0 * key.signed(i, 0), 9.0 * key.signed(i, 1), 40.0 * key.signed(i, 2));
    for round in 0..20 {
        let key = Key::new(round, 0, 0);
        let corners = [corner(key, 0), corner(key, 1), corner(key, 2)];
        let normals = vec![Vec3::Y; 3];
        let (positions, triangles, surfaces) = (corners.to_vec(), vec![[0, 1, 2]], vec![0]);
        let lone = Mesh { positions, normals, triangles, surfaces, ..Mesh::default() };
        let at: Vec<Vec3> =
            (0..400).map(|i| Vec3::new(31.9 * key.signed(i, 4), -9.0, 31.9 * key.signed(i, 5))).collect();
        let found = silhouette_distance(&sun(64), &scene(vec![lone]), &at, 11.0);
        for (at, found) in at.iter().zip(found) {
            let flat = corners.map(|corner| corner.with_y(at.y));
            let to_edge = |i: usize| {
                let (a, along) = (flat[i], flat[(i + 1) % 3] - flat[i]);
                let t = ((*at - a).dot(along) / along.length_squared()).clamp(0.0, 1.0);
                at.distance(a + along * t)
            };
            let expected = to_edge(0).min(to_edge(1)).min(to_edge(2)).min(11.0);
            assert!((found - expected).abs() < 1e-3, "{at}: {found} is not {expected}");
        }
    }
}

/// Where truth changes between two places of the plane, a silhouette lies between them in the light's view.
#[test]
fn x5_true_shadow_edges_are_silhouettes() {
    let scene = gallery::sphere_plane();
    let view = scene.lights[0].view;
    let geometry = Geometry::new(&scene, &view);
    let truth = RayCast::new(&geometry, &view);
    let slab = &scene.objects[1];
    let (low, high) = match &slab.shape {
        Shape::Mesh(mesh) => mesh.bounds().unwrap(),
        Shape::Patches(_) => unreachable!("a slab is a mesh"),
    };
    let (steps, mut edges) = (300, 0);
    let at = |i: u32, j: u32| {
        let share = |k: u32| (k as f32 + 0.5) / steps as f32;
        Vec3::new(low.x + (high.x - low.x) * share(i), low.y + (high.y - low.y) * share(j), high.z)
    };
    let places: Vec<Vec3> = (0..steps * steps).map(|index| at(index % steps, index / steps)).collect();
    let far = silhouette_distance(&view, &scene, &places, 50.0);
    for (row, far) in places.chunks(steps as usize).zip(far.chunks(steps as usize)) {
        let dark: Vec<f32> =
            row.iter().map(|&at| truth.at(&SurfacePoint { object: 1, ..SurfacePoint::at(at, Vec3::Z) })).collect();
        for i in 1..row.len() {
            if dark[i] != dark[i - 1] && !far[i].is_nan() && !far[i - 1].is_nan() {
                let texel = |at: Vec3| view.eye_to_texel(view.world_to_eye().transform_point3(at.as_dvec3()));
                let apart = texel(row[i]).distance(texel(row[i - 1])) as f32;
                assert!(far[i] + far[i - 1] <= apart + 1e-3, "{} and {} at {apart}: {}", far[i], far[i - 1], row[i]);
                edges += 1;
            }
        }
    }
    assert!(edges > 20, "{edges}");
}
