//! Base colour textures: images, how they are sampled, and where a primitive's vertices lie in them.

use crate::GltfError;
use crate::accessor::{Accessor, Component, Wanted};
use crate::error::quoted;
use crate::file::File;
use crate::image::{self, ImageError};
use crate::json::At;
use crate::uri;
use glam::{DMat2, DVec2, UVec2, Vec2};
use std::borrow::Cow;
use std::sync::Arc;
use umbrage_scene::{Interpolation, Texture, Wrap};

/// Bytes for each texel of an image: decoded, and once more as it is kept.
const TEXEL: u64 = 12;

const PLACES: Wanted = Wanted {
    kind: "VEC2",
    lanes: 2,
    of: &[Component::F32, Component::U8, Component::U16],
    quantised: &[Component::I8, Component::I16],
};

/// The texture that a field names, and where it lies on a primitive.
#[derive(Clone, Debug)]
pub(crate) struct Laid {
    pub texture: Arc<Texture>,
    /// Which set of the primitive's texture coordinates it lies by.
    set: u64,
    /// What is done to them: KHR_texture_transform.
    turned: DMat2,
    offset: DVec2,
}

impl Laid {
    /// Reads what a field with a texture's number says. The texture is read once for all that name it.
    pub fn open(file: &File, at: &At) -> Result<Self, GltfError> {
        let (mut set, mut turned, mut offset) = (at.whole("texCoord")?.unwrap_or(0), DMat2::IDENTITY, DVec2::ZERO);
        if let Some(moved) = at.extension("KHR_texture_transform") {
            set = moved.whole("texCoord")?.unwrap_or(set);
            let angle = moved.number("rotation")?.unwrap_or(0.0);
            let scale = DVec2::from_array(moved.numbers("scale")?.unwrap_or([1.0; 2]));
            offset = DVec2::from_array(moved.numbers("offset")?.unwrap_or([0.0; 2]));
            // Counter-clockwise on a page whose v runs down.
            turned = DMat2::from_angle(-angle) * DMat2::from_diagonal(scale);
        }
        let count = file.count("textures")?;
        let number =
            at.index("index", count, "textures")?.ok_or_else(|| at.wrong("index", "the number of a texture"))?;
        let known = file.textures.borrow().get(&number).cloned();
        let texture = if let Some(texture) = known {
            texture
        } else {
            let texture = Arc::new(texture(file, &file.member("textures", number)?)?);
            file.textures.borrow_mut().insert(number, Arc::clone(&texture));
            texture
        };
        Ok(Self { texture, set, turned, offset })
    }

    /// Where vertices lie in the texture; all at (0, 0) on a primitive without such coordinates.
    pub fn places(&self, file: &File, attributes: &At, ids: &[u32], count: usize) -> Result<Vec<Vec2>, GltfError> {
        let name = format!("TEXCOORD_{}", self.set);
        let Some(found) = Accessor::of(file, attributes, &name, &PLACES)? else {
            return Ok(vec![Vec2::ZERO; ids.len()]);
        };
        let found = found.counting(count, &attributes.path_of(&name), "one per position")?;
        let place = |id: &u32| {
            let uv = self.turned * DVec2::from_array(found.get(*id as usize)) + self.offset;
            let uv = uv.as_vec2();
            if uv.is_finite() { uv } else { Vec2::ZERO }
        };
        Ok(ids.iter().map(place).collect())
    }
}

fn texture(file: &File, at: &At) -> Result<Texture, GltfError> {
    let images = file.count("images")?;
    let image = at.index("source", images, "images")?.ok_or_else(|| at.wrong("source", "the number of an image"))?;
    let image = file.member("images", image)?;
    let (size, texels) = texels(file, &image)?;
    let texture =
        Texture::srgb(size, texels).map_err(|fault| GltfError::field(&image.path, fault, "an image with texels"))?;
    let samplers = file.count("samplers")?;
    let Some(sampler) = at.index("sampler", samplers, "samplers")? else { return Ok(texture) };
    let sampler = file.member("samplers", sampler)?;
    let wrap = |name: &str| match sampler.whole(name)? {
        None | Some(10_497) => Ok(Wrap::Repeat),
        Some(33_648) => Ok(Wrap::Mirror),
        Some(33_071) => Ok(Wrap::Clamp),
        Some(_) => Err(sampler.wrong(name, "10497, 33071 or 33648")),
    };
    let hard = sampler.whole("magFilter")? == Some(9728);
    let texture = texture.with_wrap([wrap("wrapS")?, wrap("wrapT")?]);
    Ok(if hard { texture.with_interpolation(Interpolation::Nearest) } else { texture })
}

/// The columns and rows of an image, and its texels as they are coded.
fn texels(file: &File, at: &At) -> Result<(UVec2, Vec<[u8; 4]>), GltfError> {
    let bytes = match at.text("uri")? {
        Some(address) => Cow::from(uri::fetch(&at.path_of("uri"), address, usize::MAX, file.folder, &file.budget)?),
        None => Cow::from(file.view_bytes(at)?),
    };
    let allow = |size: UVec2| file.budget.charge(&at.path, u64::from(size.x) * u64::from(size.y), TEXEL);
    image::decode(&bytes, allow).map_err(|fault| match fault {
        ImageError::Unreadable(fault) => {
            GltfError::field(&at.path, quoted(&fault), "a PNG or JPEG image without faults")
        }
        ImageError::Refused(fault) => fault,
    })
}
