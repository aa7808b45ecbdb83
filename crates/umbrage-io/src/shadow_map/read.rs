use super::{Layout, Nearest, matrices, text};
use crate::error::Fault;
use exr::meta::MetaData;
use exr::meta::header::Header;
use exr::prelude::{Compression, SampleType, Vec2};
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
    /// Where the file has each block; all different, all behind the table and inside the file.
    pub(crate) offsets: Vec<u64>,
}

impl Preface {
    /// From the start of a file of `length` bytes, of which nothing behind the offset table is asked for.
    pub(crate) fn read(file: impl BufRead, length: u64, most_texels: u64, most_blocks: u64) -> Result<Self, Fault> {
        Self::read_as(check_form, file, length, most_texels, most_blocks)
    }

    /// The same for another form of map than the flat one: `check_form` refuses what is not of it.
    pub(crate) fn read_as(
        check_form: impl FnOnce(&Header) -> Result<(), Fault>,
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
        if meta.requirements.has_multiple_layers {
            return Err(Fault::new("version", "flagged as of several parts", "a shadow map is a file of one part"));
        }
        let header = match meta.headers.as_slice() {
            [header] => header,
            parts => return Err(Fault::new("parts", parts.len(), "a shadow map has one")),
        };
        check_form(header)?;
        let (size, window) = windows(header, most_texels)?;
        let layout = Layout::new(header, window)?;
        let blocks = layout.count();
        if blocks as u64 > most_blocks {
            return Err(Fault::new("offset table", blocks, format!("more than the allowed {most_blocks} blocks")));
        }
        file.set_limit(length - position);
        let offsets = offsets(file, position, length, blocks)?;
        let text::Description { view, stored, window: seen, digest } = described(header, size)?;
        Ok(Self { meta, view, stored, digest, layout, seen, offsets })
    }
}

pub(crate) fn decode(bytes: &[u8], most_texels: u64) -> Result<(View, Stored, Vec<f32>), Fault> {
    let file = Preface::read(bytes, bytes.len() as u64, most_texels, u64::MAX)?;
    let size = file.view.size();
    let texels = size.x as usize * size.y as usize;
    let mut depths: Vec<f32> = Vec::new();
    depths.try_reserve_exact(texels).map_err(|full| Fault::new("displayWindow", texels, full))?;
    depths.resize(texels, f32::INFINITY);
    let nearest = Nearest::of(&file.view, file.digest);
    for (index, offset) in file.offsets.into_iter().enumerate() {
        let samples = file.layout.samples(&file.meta, &bytes[offset as usize..], index, offset)?;
        let area = file.layout.area(index);
        let samples = area.texels().zip(samples.as_chunks::<4>().0);
        for (texel, sample) in samples.filter(|(texel, _)| file.seen.contains(*texel)) {
            let depth = nearest
                .check(f32::from_ne_bytes(*sample), || format!("channel Z at texel {}, {}", texel.x, texel.y))?;
            depths[texel.y as usize * size.x as usize + texel.x as usize] = depth;
        }
    }
    check_digest(file.digest, text::digest(&file.view, file.stored, depths.iter().copied()))?;
    Ok((file.view, file.stored, depths))
}

/// A file of ours holds what was written.
pub(crate) fn check_digest(written: Option<u64>, found: u64) -> Result<(), Fault> {
    match written {
        Some(written) if written != found => {
            let problem = format!("view and depths make {found:016x}: they are not what was written");
            Err(Fault::new("comments: digest", format!("{written:016x}"), problem))
        }
        _ => Ok(()),
    }
}

/// One flat channel Z of floats, stored without loss, on one level.
fn check_form(header: &Header) -> Result<(), Fault> {
    if header.deep {
        return Err(Fault::new("type", "deep", "a shadow map has one depth a texel"));
    }
    let channels = &header.channels.list;
    let names = channels.iter().map(|channel| channel.name.to_string()).collect::<Vec<_>>().join(", ");
    match channels.as_slice() {
        [only] if only.name.as_slice() == b"Z" => {
            if only.sample_type != SampleType::F32 {
                return Err(Fault::new("channel Z", format!("{:?}", only.sample_type), "not 32-bit float"));
            }
            if only.sampling != Vec2(1, 1) {
                return Err(Fault::new("channel Z sampling", format!("{:?}", only.sampling), "not 1, 1"));
            }
        }
        _ => return Err(Fault::new("channels", names, "not the one channel Z")),
    }
    match header.compression {
        Compression::Uncompressed | Compression::RLE | Compression::ZIP1 | Compression::ZIP16 => Ok(()),
        lossy_or_rare => {
            let problem = "depths are read from none, RLE, ZIPS and ZIP only, which keep every bit";
            Err(Fault::new("compression", lossy_or_rare, problem))
        }
    }
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

/// The offset table: every block after it, inside the file and in a place of its own. `file` starts with the table, which is at
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
    if attributes.software_name.as_ref().is_some_and(|name| name.as_slice() == text::SOFTWARE.as_bytes()) {
        return Err(Fault::new("comments", "no view", "software is umbrage, which writes one"));
    }
    let missing = |field: &str| Fault::new(field, "missing", "a shadow map needs it");
    let view = matrices::to_view(
        attributes.world_to_camera.as_ref().ok_or_else(|| missing("worldToCamera"))?,
        attributes.world_to_normalized_device.as_ref().ok_or_else(|| missing("worldToNDC"))?,
        attributes.near_clip_plane.ok_or_else(|| missing("near"))?,
        attributes.far_clip_plane.ok_or_else(|| missing("far"))?,
        size,
    )?;
    Ok(text::Description { view, stored: Stored::First, window: TexelRect::of_size(size), digest: None })
}
