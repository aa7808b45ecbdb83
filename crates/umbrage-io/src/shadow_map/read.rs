use super::channel::Channel;
use super::layout::check_packing;
use super::words::WordPart;
use super::{Layout, Nearest, matrices, text};
use crate::error::Fault;
use exr::meta::MetaData;
use exr::meta::header::{Header, LayerAttributes};
use exr::prelude::{AttributeValue, Text};
use glam::{IVec2, UVec2};
use std::io::{BufRead, Read};
use umbrage_depth::Stored;
use umbrage_plane::{TexelRect, View};

/// Longer headers are not read.
const MOST_HEADER_BYTES: u64 = 1 << 20;

/// What a file holds before its blocks, checked.
#[derive(Debug)]
pub(crate) struct Preface {
    pub(crate) meta: MetaData,
    pub(crate) view: View,
    /// Which surface the depths belong to; the nearest in files of other makers.
    pub stored: Stored,
    /// Of view and depths; files of other makers have none.
    pub(crate) digest: Option<u64>,
    pub(crate) layout: Layout,
    /// The rectangle outside of which no surface was seen, whatever the file holds there: tools that fill a cropped file up to its
    /// display window, as `maketx` does, put 0 or NaN there. The whole map where the file does not say.
    pub(crate) seen: TexelRect,
    /// Where the file has each block; all different, all behind the tables and inside the file.
    pub(crate) offsets: Vec<u64>,
    /// The part of words behind the depths, in files that have one.
    pub(crate) words: Option<WordPart>,
}

impl Preface {
    /// From the start of a file of `length` bytes, of which nothing behind the offset table is asked for.
    pub(crate) fn read(file: impl BufRead, length: u64, most_texels: u64, most_blocks: u64) -> Result<Self, Fault> {
        Self::read_as(check_form, file, length, most_texels, most_blocks)
    }

    /// The same for another form of map than the flat one: `check_form` refuses what is not of it.
    pub(crate) fn read_as(
        check_form: impl FnOnce(&Header) -> Result<Channel, Fault>,
        file: impl BufRead,
        length: u64,
        most_texels: u64,
        most_blocks: u64,
    ) -> Result<Self, Fault> {
        let most = length.min(MOST_HEADER_BYTES);
        let mut file = file.take(most);
        let meta = MetaData::read_from_buffered(&mut file, true);
        let position = most - file.limit();
        let meta = meta.map_err(|error| match position {
            MOST_HEADER_BYTES => Fault::new("header", "unreadable", format!("it passes {position} bytes")),
            _ => Fault::new("header", "unreadable", error),
        })?;
        let several = meta.requirements.has_multiple_layers;
        let (header, words) = match meta.headers.as_slice() {
            [header] if !several => (header, None),
            [header, words] if several && !header.deep => (header, Some(words)),
            [_] => return Err(Fault::new("version", "flagged as of several parts", "the file has one")),
            parts => return Err(Fault::new("parts", parts.len(), "a shadow map has one, and at most one of facets")),
        };
        let channel = check_form(header)?;
        let (size, window) = windows(header, most_texels)?;
        let layout = Layout::new(header, several.then_some(0), window, channel)?;
        let words = words.map(WordPart::layout).transpose()?;
        let blocks = layout.count();
        let all = blocks + words.as_ref().map_or(0, Layout::count);
        if all as u64 > most_blocks {
            return Err(Fault::new("offset table", all, format!("more than the allowed {most_blocks} blocks")));
        }
        file.set_limit(length - position);
        let mut offsets = offsets(file, position, length, all)?;
        let behind = offsets.split_off(blocks);
        let words = words.map(|layout| WordPart { layout, offsets: behind });
        let text::Description { view, stored, window: seen, digest } = described(header, size)?;
        Ok(Self { meta, view, stored, digest, layout, seen, offsets, words })
    }
}

/// The depths of a file, whose bytes are these, row by row.
pub(crate) fn depths(file: &Preface, bytes: &[u8]) -> Result<Vec<f32>, Fault> {
    let size = file.view.size();
    let texels = size.x as usize * size.y as usize;
    let mut depths: Vec<f32> = Vec::new();
    depths.try_reserve_exact(texels).map_err(|full| Fault::new("displayWindow", texels, full))?;
    depths.resize(texels, f32::INFINITY);
    let nearest = Nearest::of(&file.view, file.digest);
    for (index, &offset) in file.offsets.iter().enumerate() {
        let samples = file.layout.samples(&file.meta, &bytes[offset as usize..], index, offset)?;
        let area = file.layout.area(index);
        let samples = area.texels().zip(samples.as_chunks::<4>().0);
        for (texel, sample) in samples.filter(|(texel, _)| file.seen.contains(*texel)) {
            let depth = nearest
                .check(f32::from_ne_bytes(*sample), || format!("channel Z at texel {}, {}", texel.x, texel.y))?;
            depths[texel.y as usize * size.x as usize + texel.x as usize] = depth;
        }
    }
    check_digest(file.digest, text::digest(&file.view, file.stored, depths.iter().map(|depth| depth.to_bits())))?;
    Ok(depths)
}

/// A file of ours holds what was written.
pub(crate) fn check_digest(written: Option<u64>, found: u64) -> Result<(), Fault> {
    match written {
        Some(written) if written != found => {
            let problem = format!("what the file holds makes {found:016x}, which is not what was written");
            Err(Fault::new("comments: digest", format!("{written:016x}"), problem))
        }
        _ => Ok(()),
    }
}

/// A flat channel of depths, stored without loss.
fn check_form(header: &Header) -> Result<Channel, Fault> {
    if header.deep {
        return Err(Fault::new("type", "deep", "a shadow map has one depth a texel"));
    }
    let channel = Channel::of_depths(header)?;
    check_packing(header)?;
    Ok(channel)
}

/// The map's size and the rectangle that is stored of it, relative to the display window.
fn windows(header: &Header, most_texels: u64) -> Result<(UVec2, TexelRect), Fault> {
    let (display, data) = (header.shared_attributes.display_window, header.data_window());
    let side = |length: usize| u32::try_from(length).ok().filter(|side| (1..=32_768).contains(side));
    let size = side(display.size.x()).zip(side(display.size.y())).map(UVec2::from);
    let shown = format!("{} x {}", display.size.x(), display.size.y());
    let size = size.ok_or_else(|| Fault::new("displayWindow", &shown, "not within 1..=32768 on each side"))?;
    if u64::from(size.x) * u64::from(size.y) > most_texels {
        return Err(Fault::new("displayWindow", shown, format!("more than the allowed {most_texels} texels")));
    }
    let axis = |data_min: i32, data_size: usize, display_min: i32, display_size: u32| {
        let min = i64::from(data_min) - i64::from(display_min);
        let end = i64::try_from(data_size).ok()?.checked_add(min)?;
        (min >= 0 && end > min && end <= i64::from(display_size)).then_some((min as i32, end as i32))
    };
    let x = axis(data.position.x(), data.size.x(), display.position.x(), size.x);
    let y = axis(data.position.y(), data.size.y(), display.position.y(), size.y);
    let window = x.zip(y).map(|(x, y)| TexelRect::new(IVec2::new(x.0, y.0), IVec2::new(x.1, y.1)));
    let window = window.ok_or_else(|| {
        let (at, sides) = (data.position, data.size);
        let value = format!("{} x {} at {}, {}", sides.x(), sides.y(), at.x(), at.y());
        Fault::new("dataWindow", value, "empty or not inside displayWindow")
    })?;
    Ok((size, window))
}

/// The offset tables of all parts, one behind the other: every block after them, inside the file and in a place of its own. `file` starts with the first table, which is at
/// byte `position` of `length`.
fn offsets(mut file: impl Read, position: u64, length: u64, count: usize) -> Result<Vec<u64>, Fault> {
    let first = position + count as u64 * 8;
    if first > length {
        let problem = format!("{count} blocks need more");
        return Err(Fault::new("offset table", format!("{} bytes left", length - position), problem));
    }
    let mut offsets = Vec::new();
    offsets.try_reserve_exact(count).map_err(|full| Fault::new("offset table", count, full))?;
    for index in 0..count {
        let mut entry = [0; 8];
        file.read_exact(&mut entry).map_err(|error| Fault::new("offset table", "unreadable", error))?;
        let offset = u64::from_le_bytes(entry);
        if !(first..length).contains(&offset) {
            let problem = format!("block {index} is not within bytes {first}..{length}");
            return Err(Fault::new("offset table", offset, problem));
        }
        offsets.push(offset);
    }
    let mut sorted = offsets.clone();
    sorted.sort_unstable();
    match sorted.windows(2).find(|pair| pair[0] == pair[1]) {
        Some(pair) => Err(Fault::new("offset table", pair[0], "two blocks in one place")),
        None => Ok(offsets),
    }
}

/// What our text says, or what the attributes that every tool writes say.
fn described(header: &Header, size: UVec2) -> Result<text::Description, Fault> {
    let attributes = &header.own_attributes;
    if let Some(found) = attributes.comments.as_ref().and_then(|comments| text::to_view(&comments.to_string())) {
        let found = found?;
        let (inside, outside) = (found.view.size(), size);
        return if inside == outside {
            Ok(found)
        } else {
            let problem = format!("displayWindow is {} x {}", outside.x, outside.y);
            Err(Fault::new("comments: size", format!("{} x {}", inside.x, inside.y), problem))
        };
    }
    if is_ours(header) {
        return Err(Fault::new("comments", "no view", "the file is one of umbrage, which writes one"));
    }
    let missing = |field: &str| Fault::new(field, "missing", "a shadow map needs it");
    let other = |name: &str| match attributes.other.get(&Text::from(name)) {
        Some(AttributeValue::Matrix4x4(matrix)) => Some(*matrix),
        _ => None,
    };
    let camera = attributes.world_to_camera.or_else(|| other("worldtocamera")).or_else(|| other("Nl"));
    let screen = attributes.world_to_normalized_device.or_else(|| other("worldtoscreen")).or_else(|| other("NP"));
    let view = matrices::to_view(
        &camera.ok_or_else(|| missing("worldToCamera"))?,
        &screen.ok_or_else(|| missing("worldToNDC"))?,
        [attributes.near_clip_plane, attributes.far_clip_plane],
        size,
    )?;
    Ok(text::Description { view, stored: Stored::First, window: TexelRect::of_size(size), digest: None })
}

/// Whether anything in a header is what only our files have: whoever damages one place of it does not make it a file of another
/// maker, whose depths no digest vouches for.
fn is_ours(header: &Header) -> bool {
    let LayerAttributes { comments, software_name, other, .. } = &header.own_attributes;
    let texts = [comments, software_name].into_iter().flatten().map(Text::as_slice);
    let others = other.values().filter_map(|value| match value {
        AttributeValue::Text(text) => Some(text.as_slice()),
        AttributeValue::Custom { bytes, .. } => Some(bytes.as_slice()),
        _ => None,
    });
    texts.chain(others).any(text::is_ours)
}
