//! Rays against a scene's triangles, one by one.

use glam::{DVec2, DVec3, Vec3};
use umbrage_plane::View;
use umbrage_scene::{Object, Scene};

pub(crate) fn object<'a>(scene: &'a Scene, name: &str) -> &'a Object {
    scene.objects.iter().find(|object| object.name == name).expect("an object of that name")
}

pub(crate) fn bounds(scene: &Scene, name: &str) -> (Vec3, Vec3) {
    object(scene, name).shape.mesh_for(&scene.camera).bounds().expect("not empty")
}

/// Texel of a world point that lies before the view and inside its window.
pub(crate) fn texel(view: &View, at: DVec3) -> Option<DVec2> {
    let eye = view.world_to_eye().transform_point3(at);
    let texel = view.eye_to_texel(eye);
    let inside = texel.cmpge(DVec2::ZERO).all() && texel.cmple(view.size().as_dvec2()).all();
    (eye.z < 0.0 && inside).then_some(texel)
}

/// Ids of the objects whose surface is met between `from` and `to`, sorted, once a triangle.
pub(crate) fn met(scene: &Scene, from: DVec3, to: DVec3) -> Vec<usize> {
    let way = to - from;
    let mut ids = Vec::new();
    for (id, object) in scene.objects.iter().enumerate() {
        let mesh = object.shape.mesh_for(&scene.camera);
        for triangle in 0..mesh.triangles.len() {
            let [a, b, c] = mesh.corners(triangle).map(Vec3::as_dvec3);
            let (ab, ac) = (b - a, c - a);
            let across = way.cross(ac);
            let volume = ab.dot(across);
            let (u, turned) = ((from - a).dot(across) / volume, (from - a).cross(ab));
            let (v, t) = (way.dot(turned) / volume, ac.dot(turned) / volume);
            if volume != 0.0 && u >= 0.0 && v >= 0.0 && u + v <= 1.0 && t > 1e-4 && t < 1.0 - 1e-4 {
                ids.push(id);
            }
        }
    }
    ids
}

/// What lies between a point and light 0.
pub(crate) fn before_light(scene: &Scene, at: DVec3) -> Vec<usize> {
    met(scene, at, at + scene.lights[0].view.toward_eye(at) * 400.0)
}

/// Whether the camera sees a point.
pub(crate) fn seen(scene: &Scene, at: DVec3) -> bool {
    texel(&scene.camera, at).is_some() && met(scene, at, scene.camera.light().truncate()).is_empty()
}

pub(crate) fn on_floor(half: f64, steps: u32) -> impl Iterator<Item = DVec3> {
    let at = move |step: u32| half * (2.0 * (f64::from(step) + 0.37) / f64::from(steps) - 1.0);
    (0..steps * steps).map(move |step| DVec3::new(at(step % steps), 0.0, at(step / steps)))
}
