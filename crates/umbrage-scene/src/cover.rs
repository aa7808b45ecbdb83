use crate::Texture;
use glam::{DVec2, Vec3};
use std::cmp::Ordering;
use std::sync::Arc;

/// What changes over an object's surface: its colour, and whether anything is there. The default is one colour without holes.
///
/// Both are found by the place in the texture that [`Mesh::uvs`](crate::Mesh::uvs) give.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Cover {
    /// Its colour multiplies [`Material::diffuse`](crate::Material::diffuse). Without one, colour and alpha are 1.
    pub texture: Option<Arc<Texture>>,
    /// The alpha test: nothing of the object is where the texture's alpha is below this. Light passes there, and the camera sees what is
    /// behind. `None` never asks. To multiply alpha by a factor, divide this by the factor, which may be 0: a positive cutoff becomes
    /// +∞, where nothing is there, and a cutoff of 0 becomes NaN, where everything is, as nothing is below NaN.
    pub cutoff: Option<f32>,
}

impl Cover {
    /// A texture without holes, whatever its alpha.
    pub fn textured(texture: Arc<Texture>) -> Self {
        Self { texture: Some(texture), cutoff: None }
    }

    /// A texture with holes where its alpha is below `cutoff`.
    pub fn cut_out(texture: Arc<Texture>, cutoff: f32) -> Self {
        Self { texture: Some(texture), cutoff: Some(cutoff) }
    }

    /// Whether [`Cover::is_there`] has to be asked.
    pub fn has_holes(&self) -> bool {
        self.cutoff.is_some()
    }

    /// Whether anything is at a place in the texture.
    pub fn is_there(&self, uv: DVec2) -> bool {
        let Some(cutoff) = self.cutoff else { return true };
        let alpha = self.texture.as_ref().map_or(1.0, |texture| texture.sample(uv).w);
        alpha.partial_cmp(&cutoff) != Some(Ordering::Less)
    }

    /// What multiplies the diffuse colour at a place in the texture, linear RGB.
    pub fn colour(&self, uv: DVec2) -> Vec3 {
        self.texture.as_ref().map_or(Vec3::ONE, |texture| texture.sample(uv).truncate())
    }
}
