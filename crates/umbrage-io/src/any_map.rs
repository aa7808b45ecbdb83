//! Files of any maps: one, or several by their names.

use crate::deep_map::{deep, deep_part};
use crate::error::{Fault, IoError};
use crate::facet_map::{facet_parts, facets};
use crate::file::read_bytes;
use crate::map_options::MapOptions;
use crate::named::light_of;
use crate::shadow_map::{About, FACETS, Found, Parts, encode_parts, facets_of, flat, found, only, part, raw};
use crate::write_file::write_bytes;
use glam::UVec2;
use std::path::Path;
use umbrage_depth::{DepthMap, Map};
use umbrage_plane::TexelRect;

/// A map in a file, by its name.
#[derive(Clone, Debug)]
pub struct NamedMap {
    /// What its part is called: the light's name, with a dot and one of [`CUBE_FACES`](crate::CUBE_FACES) or
    /// [`FACES_AHEAD`](crate::FACES_AHEAD) behind it where the map is one of several around the light.
    pub name: String,
    /// The map.
    pub map: Map,
    /// Cosine of half the angle of the light's cone, 0..1, about the axis of the map `NAME.ahead`, where the map is one of several that have
    /// no cone of their own: beyond it everything is in shadow.
    pub light_cone: Option<f64>,
}

/// What a file holds.
#[derive(Clone, Debug)]
pub struct Maps {
    /// Its maps, in the order of its parts; one at least.
    pub maps: Vec<NamedMap>,
    /// Warnings: lossy compression, and parts that hold no map.
    pub notes: Vec<Fault>,
}

/// A file of maps as bytes; the same bytes for the same maps. Each is a part named after it, or, as in
/// [`encode_facet_map`](crate::encode_facet_map), two where it holds facets: that of the facets is named `NAME.facets`, in a file of one map
/// `facets`. Of a map of moments the depths alone are written, from which they can be made again.
///
/// The parts of an EXR file share a display window: it is as large as the largest map, and smaller ones are in its upper left.
///
/// # Errors
/// A [`Fault`] if there are no maps or more than 2048 parts; if a name is empty, longer than 255 bytes, has characters outside printable
/// Latin-1, or occurs twice; if `light_cone` is outside 0..1; and for every error of [`encode_facet_map`](crate::encode_facet_map) and
/// [`encode_deep_map`](crate::encode_deep_map).
pub fn encode_maps(maps: &[NamedMap]) -> Result<Vec<u8>, Fault> {
    let display = maps.iter().fold(UVec2::ZERO, |most, named| most.max(named.map.view().size()));
    let of_facets = |name: &str| if maps.len() == 1 { FACETS.to_owned() } else { facets_of(name) };
    let mut parts = Vec::new();
    for NamedMap { name, map, light_cone } in maps {
        if let Err(error) = map.view().with_cone(*light_cone) {
            return Err(Fault::new("light_cone", format!("{light_cone:?}"), error).in_part(name));
        }
        let about = About { name, light_cone: *light_cone, display };
        match map {
            Map::Facets(map) => parts.extend(facet_parts(map, about, &of_facets(name))?),
            Map::Deep(map) => parts.push(deep_part(map, about)?),
            Map::Raw(map) => parts.push(part(map, about)?),
            Map::Bbox(map) => parts.push(part(map, about)?),
            Map::Tiled(map) => parts.push(part(map, about)?),
            Map::Moments(map) => parts.push(part(map, about)?),
        }
    }
    encode_parts(&parts)
}

/// Writes a file of maps, as a whole or not at all.
///
/// # Errors
/// [`IoError`], when the system refuses or [`encode_maps`] does.
pub fn write_maps(path: &Path, maps: &[NamedMap]) -> Result<(), IoError> {
    write_bytes(path, &encode_maps(maps).map_err(|fault| fault.in_file(path))?)
}

/// Reads the maps of a file, or those of them that are wanted, of any kind: one of facets where the file has a part of them, a deep one where
/// its samples are deep, otherwise a shadow map. What was written is read again bit for bit.
///
/// Files of other makers are taken as [`read_shadow_map`](crate::read_shadow_map) and [`read_deep_map`](crate::read_deep_map) take them, each
/// of their parts by itself; parts without a channel of depths are passed over, with a note. Beside what those take, PXR24 and B44 are
/// read, with a note that they are lossy.
///
/// # Errors
/// [`IoError`]: one line with the file, the part where it has several, the field and its value, when the system refuses, the file has no map
/// of the wanted name, or one that is wanted is damaged, hostile or too large.
pub fn read_maps(path: &Path, options: &MapOptions) -> Result<Maps, IoError> {
    decode_maps(&read_within(path, options.most_texels)?, options).map_err(|fault| fault.in_file(path))
}

/// As [`read_maps`], from bytes.
///
/// # Errors
/// A [`Fault`], as [`read_maps`].
pub fn decode_maps(bytes: &[u8], options: &MapOptions) -> Result<Maps, Fault> {
    let parts = Parts::read(bytes, bytes.len() as u64, u64::MAX)?;
    let (all, others) = found(&parts, options.channel.as_deref())?;
    let several = all.len() + others.len() > 1;
    let mut notes = Vec::new();
    if !others.is_empty() {
        let problem = format!("no channel {} in them: left alone", options.channel.as_deref().unwrap_or("Z"));
        notes.push(Fault::new("parts", others.join(", "), problem));
    }
    let (mut options, mut maps) = (options.clone(), Vec::new());
    for found in wanted(all, options.part.as_deref())? {
        let of_part = |fault: Fault| if several { fault.in_part(&found.name) } else { fault };
        let before = notes.len();
        let named = read(&parts, &found, bytes, &options, &mut notes).map_err(of_part)?;
        let new = notes.split_off(before);
        notes.extend(new.into_iter().map(of_part));
        options.most_texels = options.most_texels.saturating_sub(taken(&named.map));
        maps.push(named);
    }
    Ok(Maps { maps, notes })
}

/// Reads the only map of a file, of any kind. It takes at most `most_texels` texels, or steps of a deep map.
///
/// # Errors
/// As [`read_shadow_map`](crate::read_shadow_map) of the kind that the file is of; also for a file of several maps, which are named.
pub fn read_map(path: &Path, most_texels: u64) -> Result<Map, IoError> {
    decode_map(&read_within(path, most_texels)?, most_texels).map_err(|fault| fault.in_file(path))
}

/// As [`read_map`], from bytes.
///
/// # Errors
/// A [`Fault`], when the bytes are not a map of that size.
pub fn decode_map(bytes: &[u8], most_texels: u64) -> Result<Map, Fault> {
    let parts = Parts::read(bytes, bytes.len() as u64, u64::MAX)?;
    let options = MapOptions::default().with_most_texels(most_texels);
    read(&parts, &only(&parts)?, bytes, &options, None).map(|named| named.map)
}

fn read_within(path: &Path, most_texels: u64) -> Result<Vec<u8>, IoError> {
    read_bytes(path, most_texels.saturating_mul(48).saturating_add(1 << 24))
}

/// The maps of a name, or those of the light of that name.
fn wanted(maps: Vec<Found>, part: Option<&str>) -> Result<Vec<Found>, Fault> {
    let Some(part) = part else { return Ok(maps) };
    let names = maps.iter().map(|map| map.name.as_str()).collect::<Vec<_>>().join(", ");
    let is_called = |map: &Found| map.name == part;
    let exact = maps.iter().any(is_called);
    let wanted = |map: &Found| if exact { is_called(map) } else { light_of(&map.name) == part };
    let wanted: Vec<Found> = maps.into_iter().filter(wanted).collect();
    if wanted.is_empty() { Err(Fault::new("part", part, format!("the file has {names}"))) } else { Ok(wanted) }
}

/// One map; what is to be noted of it goes into `notes`, and is refused where there are none.
fn read<'n>(
    parts: &Parts,
    found: &Found,
    bytes: &[u8],
    options: &MapOptions,
    notes: impl Into<Option<&'n mut Vec<Fault>>>,
) -> Result<NamedMap, Fault> {
    let MapOptions { most_texels, channel, view, .. } = options;
    let name = found.name.clone();
    if parts.header(found.part).deep {
        let (map, light_cone) = deep(parts, found.part, bytes, options)?;
        return Ok(NamedMap { name, map: map.into(), light_cone });
    }
    let file = flat(parts, found.part, channel.as_deref(), view.as_ref(), *most_texels, notes.into())?;
    let map = if found.words.is_some() {
        facets(&file, found, bytes, *most_texels)?.into()
    } else {
        raw(&file, bytes)?.into()
    };
    Ok(NamedMap { name, map, light_cone: file.light_cone })
}

/// How much of a budget a map takes: its texels, or its steps where they are more.
fn taken(map: &Map) -> u64 {
    let whole = TexelRect::of_size(map.view().size());
    let steps = match map {
        Map::Deep(map) => whole.texels().map(|texel| map.steps(texel).len() as u64).sum(),
        _ => 0,
    };
    steps.max(whole.area() as u64)
}
