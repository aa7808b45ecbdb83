use crate::{Frame, NOTHING, rays_where};
use glam::DVec3;
use umbrage_plane::{TexelRect, View};
use umbrage_scene::Scene;

/// The points that the camera sees and a light may reach, one for each pixel and for those one beyond each side of the picture: what a map
/// is [fitted](View::fitted) to. Left out is what turns its back to the light on closed things, which is dark without a map.
///
/// # Panics
/// As [`Soup::all`](crate::Soup::all).
#[must_use]
pub fn receivers(scene: &Scene, light: &View) -> Vec<DVec3> {
    let size = scene.camera.size().as_ivec2();
    let mut wider = scene.clone();
    // A picture of the greatest size has no room for more.
    wider.camera = scene.camera.window(TexelRect::new(glam::IVec2::NEG_ONE, size + 1)).unwrap_or(scene.camera);
    wider.lights.clear();
    let seen = rays_where(&wider, &[], &Frame::CENTRES, |_| true);
    let reached = |i: &usize| {
        let toward = light.toward_eye(seen.position[*i]).as_vec3();
        !scene.objects[seen.object[*i] as usize].is_solid() || seen.normal[*i].dot(toward) > 0.0
    };
    let pixels = (0..seen.object.len()).filter(|i| seen.object[*i] != NOTHING);
    pixels.filter(reached).map(|i| seen.position[i]).collect()
}
