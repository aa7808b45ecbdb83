//! The bowling film (WM94-F15).

use super::rays::{bounds, object};
use glam::{UVec2, Vec3};
use umbrage_scene::{Mesh, Scene, gallery};

const PINS: std::ops::RangeInclusive<u32> = 1..=10;

fn film() -> impl Iterator<Item = Scene> {
    (0..=gallery::BOWLING_FRAMES).map(gallery::bowling)
}

#[test]
fn wm94_f15_what_stands_still_is_the_same_in_every_frame() {
    let first = gallery::bowling(0);
    assert_eq!((first.camera.size(), first.lights[0].view.size()), (UVec2::new(640, 512), UVec2::splat(512)));
    assert_eq!(first.objects.len(), 25);
    for scene in film() {
        assert_eq!(scene.objects[..4], first.objects[..4]);
        assert_eq!((&scene.lights, &scene.camera), (&first.lights, &first.camera));
        let moving = |id: &u32| *id > 3;
        assert!(!scene.casters_outside(&scene.lights[0].view).iter().any(moving), "what moves is in the map");
        for object in &scene.objects {
            let mesh = object.shape.mesh_for(&scene.camera);
            assert!(mesh.is_closed() && object.solid, "{}", object.name);
        }
    }
    assert_eq!(gallery::bowling(gallery::BOWLING_FRAMES + 5), gallery::bowling(gallery::BOWLING_FRAMES));
    assert_ne!(gallery::bowling(3).objects[4], first.objects[4], "the ball rolls");
}

#[test]
fn wm94_f15_pins_stand_then_fall() {
    let standing = |scene: &Scene| {
        let upright = |number: &u32| {
            let (low, high) = bounds(scene, &format!("pin {number}"));
            low.y.abs() < 1e-4 && (high.y - 15.0).abs() < 1e-4
        };
        PINS.filter(upright).count()
    };
    let counts: Vec<usize> = film().map(|scene| standing(&scene)).collect();
    assert_eq!((counts[0], counts[8], *counts.last().expect("frames")), (10, 10, 1), "{counts:?}");
    assert!(counts.is_sorted_by(|a, b| a >= b), "{counts:?}");
    let last = gallery::bowling(gallery::BOWLING_FRAMES);
    for scene in film() {
        for number in PINS {
            let (low, high) = bounds(&scene, &format!("pin {number}"));
            assert!(low.y > -0.03 && low.x.min(-high.x) > -30.25 && low.z > -56.0, "{number}: {low} {high}");
        }
    }
    assert!(PINS.filter(|number| bounds(&last, &format!("pin {number}")).1.y < 6.0).count() >= 7, "they lie");
}

/// No two things that move run into one another: no vertex of one is inside another.
#[test]
fn wm94_f15_pins_and_ball_keep_apart() {
    for (frame, scene) in film().enumerate() {
        let names: Vec<String> = PINS.map(|number| format!("pin {number}")).chain(["ball".into()]).collect();
        let meshes: Vec<Mesh> =
            names.iter().map(|name| object(&scene, name).shape.mesh_for(&scene.camera).into_owned()).collect();
        for (a, one) in meshes.iter().enumerate() {
            for (b, other) in meshes.iter().enumerate().filter(|(b, _)| *b != a) {
                let (low, high) = other.bounds().expect("not empty");
                let within = |at: &&Vec3| at.cmpge(low).all() && at.cmple(high).all();
                let inside = one.positions.iter().filter(within).filter(|at| holds(other, **at)).count();
                assert_eq!(inside, 0, "frame {frame}: {} in {}", names[a], names[b]);
            }
        }
    }
}

/// Whether a convex part or the whole of a closed mesh surrounds a point: a ray leaves it an odd number of times.
fn holds(mesh: &Mesh, at: Vec3) -> bool {
    let way = Vec3::new(0.31, 0.92, 0.24);
    let crossed = |triangle: &usize| {
        let [a, b, c] = mesh.corners(*triangle);
        let (ab, ac) = (b - a, c - a);
        let across = way.cross(ac);
        let volume = ab.dot(across);
        let (u, turned) = ((at - a).dot(across) / volume, (at - a).cross(ab));
        let (v, t) = (way.dot(turned) / volume, ac.dot(turned) / volume);
        volume != 0.0 && u >= 0.0 && v >= 0.0 && u + v <= 1.0 && t > 0.0
    };
    (0..mesh.triangles.len()).filter(crossed).count() % 2 == 1
}
