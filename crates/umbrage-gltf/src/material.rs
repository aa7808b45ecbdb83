//! What a primitive's surface looks like, and what light passes it.

use crate::GltfError;
use crate::file::File;
use crate::json::At;
use crate::note::Level;
use crate::texture::Laid;
use glam::Vec3;
use umbrage_scene::Material;

/// A surface as a scene knows it.
#[derive(Clone, Debug)]
pub(crate) struct Surface {
    pub material: Material,
    /// The texture of the base colour, and how it lies.
    pub laid: Option<Laid>,
    /// The alpha of the texture below which nothing is there.
    pub cutoff: Option<f32>,
    /// The fraction of the light that passes one surface, per channel.
    pub passes: Vec3,
    /// Whether nothing of it is there: a mask whose alpha is below its cutoff everywhere.
    pub absent: bool,
}

const PLAIN: Surface =
    Surface { material: Material::matt(Vec3::ONE), laid: None, cutoff: None, passes: Vec3::ZERO, absent: false };

/// The surface of a primitive, by its material. The base colour is what a matt surface reflects, of metals too.
pub(crate) fn surface(file: &File, primitive: &At) -> Result<Surface, GltfError> {
    let Some(number) = primitive.index("material", file.count("materials")?, "materials")? else { return Ok(PLAIN) };
    let at = file.member("materials", number)?;
    let (mut colour, mut laid, masked) = ([1.0; 4], None, at.text("alphaMode")? == Some("MASK"));
    if let Some(base) = at.get("pbrMetallicRoughness") {
        colour = base.numbers("baseColorFactor")?.unwrap_or(colour);
        if !colour.iter().all(|channel| (0.0..=1.0).contains(channel)) {
            return Err(GltfError::field(
                base.path_of("baseColorFactor"),
                format!("{colour:?}"),
                "numbers from 0 to 1",
            ));
        }
        if let Some(texture) = base.get("baseColorTexture") {
            match Laid::open(file, &texture) {
                Ok(found) => laid = Some(found),
                // A shadow is right without its caster's colour, but not without its holes.
                Err(fault) if !masked && !matches!(fault, GltfError::Budget { .. }) => {
                    file.note(Level::Always, format!("{} is not shown: {fault}", texture.path));
                }
                Err(fault) => return Err(fault),
            }
        }
    }
    for name in ["normalTexture", "occlusionTexture", "emissiveTexture"] {
        if let Some(texture) = at.get(name) {
            file.note(Level::Verbose, format!("{} is not shown", texture.path));
        }
    }
    let [red, green, blue, alpha] = colour.map(|channel| channel as f32);
    let material = Material::matt(Vec3::new(red, green, blue));
    let cutoff = at.number_in("alphaCutoff", 0.5, |cutoff| cutoff >= 0.0, "a number from 0")?;
    let below = f64::from(alpha) < f64::from(cutoff as f32);
    let (passes, absent) = match at.text("alphaMode")? {
        None | Some("OPAQUE") => (0.0, false),
        Some("MASK") => (0.0, below && laid.is_none()),
        Some("BLEND") => (1.0 - alpha, false),
        Some(_) => return Err(at.wrong("alphaMode", "OPAQUE, MASK or BLEND")),
    };
    // The factor's alpha is divided out of the comparison.
    let cutoff = (masked && laid.is_some()).then(|| cutoff as f32 / alpha);
    Ok(Surface { material, laid, cutoff, passes: Vec3::splat(passes), absent })
}
