//! What is wrong with a scene before a map of it is made: values to act on, each with its line for people.

use crate::predict::severe_perspective;
use crate::thin::too_thin;
use crate::{Diagnostic, Plan};
use umbrage_depth::Stored;
use umbrage_plane::View;
use umbrage_scene::{Light, Scene, Shape};

impl Default for Plan {
    /// Float depth of the first surface with Reeves' smaller bias.
    fn default() -> Self {
        Self { depth_bits: None, bias_world: 0.3, stored: Stored::First, slope: 0.0, filter_half: 0.0 }
    }
}

/// Everything that is known to go wrong with a light of a scene, in a fixed order. Lights that do not cast have nothing wrong.
///
/// # Panics
/// When the scene's origin is not finite.
pub fn diagnose(scene: &Scene, light: &Light, plan: &Plan) -> Vec<Diagnostic> {
    if !light.casts {
        return Vec::new();
    }
    let name = |id: u32| scene.objects[id as usize].name.clone();
    let outside = scene.casters_outside(&light.view).into_iter();
    let mut found: Vec<Diagnostic> =
        outside.map(|id| Diagnostic::CasterOutside { light: light.name.clone(), object: name(id) }).collect();
    let farthest = farthest_receiver(scene, &light.view);
    if let (Some(bits), Some(farthest)) = (plan.depth_bits, farthest)
        && let Some(step) = severe_perspective(&light.view, bits, farthest, plan.bias_world)
    {
        let (light, bias) = (light.name.clone(), plan.bias_world);
        found.push(Diagnostic::SeverePerspective { light, bits, farthest, step, bias });
    }
    if plan.stored == Stored::Midpoint
        && let Some(receiver) = scene.objects.iter().find(|object| object.receives && !object.casts)
    {
        for object in scene.objects.iter().filter(|object| object.casts && !object.solid) {
            let (light, object, receiver) = (light.name.clone(), object.name.clone(), receiver.name.clone());
            found.push(Diagnostic::VanishedShadow { light, object, receiver });
        }
    }
    for object in scene.objects.iter().filter(|object| object.casts && object.solid) {
        let closed = match &object.shape {
            Shape::Mesh(mesh) => mesh.is_closed(),
            // Cut alike for any view, and closed or not for all.
            patches @ Shape::Patches(_) => patches.mesh_for(&light.view).is_closed(),
        };
        if !closed {
            found.push(Diagnostic::OpenSolid { object: object.name.clone() });
        }
    }
    found.extend(scene.objects.iter().filter_map(|object| too_thin(scene, object, light, plan)));
    found
}

/// The largest axial distance of anything that receives, inside the light's range.
fn farthest_receiver(scene: &Scene, light: &View) -> Option<f64> {
    let hulls = scene.objects.iter().filter(|object| object.receives).flat_map(|object| scene.hull(object));
    let distances = hulls.map(|at| -light.world_to_eye().transform_point3(at).z);
    distances.filter(|zeta| *zeta > light.near()).map(|zeta| zeta.min(light.far())).reduce(f64::max)
}
