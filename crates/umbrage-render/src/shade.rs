use crate::camera::Region;
use glam::Vec3;
use umbrage_plane::SurfacePoint;
use umbrage_scene::{Light, Material, Scene};

/// The light that a region sends to the camera: ambient, and per light Lambert and Blinn terms scaled by its
/// transmittance. Highlights never appear in shadow, because the shadow is part of the shading (Williams 1978, Reeves 1987).
pub(crate) fn shade(
    scene: &Scene,
    (region, point): (&Region, &SurfacePoint),
    toward_eye: Vec3,
    transmittance: &[Vec3],
) -> Vec3 {
    let material = &scene.objects[point.object as usize].material;
    let material = Material { diffuse: material.diffuse * region.texture, ..*material };
    let mut colour = scene.ambient * material.diffuse;
    for (light, arrives) in scene.lights.iter().zip(transmittance) {
        colour += reflect(&material, light, (region, point), toward_eye, *arrives);
    }
    colour
}

fn reflect(
    material: &Material,
    light: &Light,
    (region, point): (&Region, &SurfacePoint),
    toward_eye: Vec3,
    passes: Vec3,
) -> Vec3 {
    let (toward_light, incident) = light.arriving(point.position, passes);
    let cosine = region.shading_normal.dot(toward_light);
    if cosine <= 0.0 {
        return Vec3::ZERO;
    }
    let matt = material.diffuse * cosine;
    // Most of the time would go into the powers of highlights that nothing of is seen.
    if material.specular == Vec3::ZERO || incident == Vec3::ZERO {
        return incident * matt;
    }
    let half = (toward_light + toward_eye).normalize_or_zero();
    let highlight = region.shading_normal.dot(half).max(0.0).powf(material.shininess);
    incident * (matt + material.specular * highlight)
}
