use crate::Texture;
use glam::{DVec2, Vec3};
use std::cmp::Ordering;
use std::sync::Arc;

/// What changes over an object's surface: its colour, whether anything is there, and how much light passes. The default is one colour
/// without holes, which passes alike everywhere.
///
/// All are found by the place in the texture that [`Mesh::uvs`](crate::Mesh::uvs) give.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Cover {
    /// Its colour multiplies [`Material::diffuse`](crate::Material::diffuse). Without one, colour and alpha are 1.
    pub texture: Option<Arc<Texture>>,
    /// The alpha test: nothing of the object is where the texture's alpha is below this. Light passes there, and the camera sees what is
    /// behind. `None` never tests. To multiply alpha by a factor, divide this by the factor, which may be 0: a positive cutoff becomes
    /// +∞, where nothing is there, and a cutoff of 0 becomes NaN, where everything is, as nothing is below NaN.
    pub cutoff: Option<f32>,
    /// Whether the texture's alpha says how much light passes: all of it where alpha is 0, what
    /// [`Object::passes`](crate::Object::passes) says where it is 1, and a mean of the two by alpha between them.
    pub blends: bool,
}

impl Cover {
    /// A texture without holes, whatever its alpha.
    pub fn textured(texture: Arc<Texture>) -> Self {
        Self { texture: Some(texture), ..Self::default() }
    }

    /// A texture with holes where its alpha is below `cutoff`.
    pub fn cut_out(texture: Arc<Texture>, cutoff: f32) -> Self {
        Self { cutoff: Some(cutoff), ..Self::textured(texture) }
    }

    /// A texture whose alpha says how much light passes, without holes.
    pub fn blended(texture: Arc<Texture>) -> Self {
        Self { blends: true, ..Self::textured(texture) }
    }

    /// Whether [`Cover::is_there`] has to be evaluated.
    pub fn has_holes(&self) -> bool {
        self.cutoff.is_some()
    }

    /// Whether anything is at a place in the texture.
    pub fn is_there(&self, uv: DVec2) -> bool {
        let Some(cutoff) = self.cutoff else { return true };
        let alpha = self.texture.as_ref().map_or(1.0, |texture| texture.sample(uv).w);
        alpha.partial_cmp(&cutoff) != Some(Ordering::Less)
    }

    /// What passes of the light at a place in the texture, linear RGB, where `opaque` passes at an alpha of 1.
    pub fn passes(&self, opaque: Vec3, uv: DVec2) -> Vec3 {
        let Some(texture) = self.texture.as_ref().filter(|_| self.blends) else { return opaque };
        let alpha = texture.sample(uv).w.clamp(0.0, 1.0);
        Vec3::ONE - (Vec3::ONE - opaque) * alpha
    }

    /// What multiplies the diffuse colour at a place in the texture, linear RGB.
    pub fn colour(&self, uv: DVec2) -> Vec3 {
        self.texture.as_ref().map_or(Vec3::ONE, |texture| texture.sample(uv).truncate())
    }
}
