//! What is wrong with a scene before a map of it is made: values to act on, each with its line for people.

use crate::predict::{Stored, severe_perspective};
use crate::thin::too_thin;
use umbrage_plane::View;
use umbrage_scene::{Light, Scene, Shape};

/// Something about a light and a scene that will show in the picture.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum Diagnostic {
    /// A caster that the light's view does not wholly hold: its shadow is cut off (Williams 1978; W78-8).
    #[error(
        "light {light:?}: object {object:?} casts but lies partly outside the light's view: its shadow is cut off there"
    )]
    CasterOutside {
        /// The light's name.
        light: String,
        /// The object's name.
        object: String,
    },
    /// Integer depth is too coarse at the farthest receiver (Williams 1978; W78-9).
    #[error(
        "light {light:?}: at distance {farthest} a step of {bits}-bit depth is {step} world units, more than half the bias {bias}: \
         raise the near plane, the bits or the bias"
    )]
    SeverePerspective {
        /// The light's name.
        light: String,
        /// Bits of the depth.
        bits: u32,
        /// Axial distance of the farthest receiver.
        farthest: f64,
        /// The quantisation step there, world units.
        step: f64,
        /// The bias, world units.
        bias: f64,
    },
    /// Under the midpoint rule a single sheet leaves nothing to compare with where its receiver is not in the map (Woo 1992; W92-9).
    #[error(
        "light {light:?}: sheet {object:?} loses its shadow under the midpoint rule on {receiver:?}, which does not cast: let the receiver cast"
    )]
    VanishedShadow {
        /// The light's name.
        light: String,
        /// The sheet's name.
        object: String,
        /// The receiver's name.
        receiver: String,
    },
    /// An open mesh that claims to bound a solid: back faces and second surfaces are missing (Wang & Molnar 1994; WM94-14).
    #[error("object {object:?} is flagged solid but its mesh is open: flag it two-sided, or its shadow may vanish")]
    OpenSolid {
        /// The object's name.
        object: String,
    },
    /// A caster's texels span more depth than it is thick: whatever is stored inside it shadows it (Wang & Molnar 1994; WM94-17).
    #[error(
        "light {light:?}: object {object:?} is {thickness:.4} world units thick where depth changes by {step:.4} over the filter: \
         a map of {side_needed} texels a side would do"
    )]
    TooThin {
        /// The light's name.
        light: String,
        /// The object's name.
        object: String,
        /// Along the light's axis, world units.
        thickness: f64,
        /// What depth may be wrong by there, world units: τ·slope·(filter half-extent + ½), summed over the map's axes.
        step: f64,
        /// Texels along the map's longer side that bring the step down to what is stored behind the surface; `u32::MAX`
        /// when none does.
        side_needed: u32,
    },
}

/// What a light's map is going to be used for.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Plan {
    /// Bits of integer depth; `None` for floats.
    pub depth_bits: Option<u32>,
    /// The bias, world units.
    pub bias_world: f64,
    /// What the map keeps.
    pub stored: Stored,
    /// Tangent of the steepest angle between a caster's surface and the map's plane that must be free of error, ≥ 0 (WM94-17).
    /// 0 does not ask.
    pub slope: f64,
    /// Half-extent of the filter, texels.
    pub filter_half: f64,
}

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
