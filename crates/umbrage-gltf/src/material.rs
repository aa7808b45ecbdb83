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
    /// The fraction of the light that passes one surface, per channel; where it blends that at an alpha of 1.
    pub passes: Vec3,
    /// Whether the texture's alpha says how much light passes.
    pub blends: bool,
    /// Whether alpha makes a difference to the surface.
    pub has_alpha: bool,
    /// Whether nothing of it is there: a mask whose alpha is below its cutoff everywhere, or what blends with an alpha of 0.
    pub absent: bool,
}

const PLAIN: Surface = Surface {
    material: Material::matt(Vec3::ONE),
    laid: None,
    cutoff: None,
    passes: Vec3::ZERO,
    blends: false,
    has_alpha: false,
    absent: false,
};

/// The surface of a primitive, by its material. The base colour is what a matt surface reflects, of metals too.
pub(crate) fn surface(file: &File, primitive: &At) -> Result<Surface, GltfError> {
    let Some(number) = primitive.index("material", file.count("materials")?, "materials")? else { return Ok(PLAIN) };
    let at = file.member("materials", number)?;
    let (masked, blended) = match at.text("alphaMode")? {
        None | Some("OPAQUE") => (false, false),
        Some("MASK") => (true, false),
        Some("BLEND") => (false, true),
        Some(_) => return Err(at.wrong("alphaMode", "OPAQUE, MASK or BLEND")),
    };
    let (mut colour, mut laid) = ([1.0; 4], None);
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
                    let alpha = if blended { ", and its alpha counts as 1" } else { "" };
                    file.note(Level::Always, format!("{} is not shown{alpha}: {fault}", texture.path));
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
    let passes = Vec3::splat(if blended { 1.0 - alpha } else { 0.0 });
    let absent = (masked && below && laid.is_none()) || (blended && alpha == 0.0);
    let least = laid.as_ref().filter(|_| blended).map_or(1.0, |laid: &Laid| laid.texture.least_alpha());
    let cutoff = match &laid {
        // The factor's alpha is divided out of the comparison.
        Some(_) if masked => Some(cutoff as f32 / alpha),
        // Nothing is there where all light passes.
        Some(_) if blended && least == 0.0 => Some(f32::MIN_POSITIVE),
        _ => None,
    };
    Ok(Surface { material, laid, cutoff, passes, blends: least < 1.0, has_alpha: masked || blended, absent })
}
