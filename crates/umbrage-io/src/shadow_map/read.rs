use super::{matrices, text};
use crate::error::Fault;
use exr::block::UncompressedBlock;
use exr::block::chunk::{Chunk, CompressedBlock, CompressedScanLineBlock, CompressedTileBlock, TileCoordinates};
use exr::meta::attribute::LevelMode;
use exr::meta::header::Header;
use exr::meta::{BlockDescription, MetaData};
use exr::prelude::{Compression, SampleType, Vec2};
use glam::{IVec2, UVec2};
use umbrage_plane::{TexelRect, View};

/// Deflate makes no more than 1032 bytes of one; a block that claims more is not worth taking memory for.
const MOST_BYTES_PER_BYTE: usize = 1100;

pub(crate) fn decode(bytes: &[u8], most_texels: u64) -> Result<(View, Vec<f32>), Fault> {
    let mut rest = bytes;
    let meta =
        MetaData::read_from_buffered(&mut rest, true).map_err(|error| Fault::new("header", "unreadable", error))?;
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
    let offsets = offsets(rest, bytes.len(), layout.count())?;
    let (view, digest) = view(header, size)?;
    let texels = size.x as usize * size.y as usize;
    let mut depths: Vec<f32> = Vec::new();
    depths.try_reserve_exact(texels).map_err(|full| Fault::new("displayWindow", texels, full))?;
    depths.resize(texels, f32::INFINITY);
    for (index, offset) in offsets.into_iter().enumerate() {
        let samples = layout.samples(&meta, bytes, index, offset)?;
        let area = layout.area(index);
        for (texel, sample) in area.texels().zip(samples.as_chunks::<4>().0) {
            depths[texel.y as usize * size.x as usize + texel.x as usize] = f32::from_ne_bytes(*sample);
        }
    }
    let found = text::digest(&view, depths.iter().copied());
    match digest {
        Some(written) if written != found => {
            let problem = format!("view and depths make {found:016x}: they are not what was written");
            Err(Fault::new("comments: digest", format!("{written:016x}"), problem))
        }
        _ => Ok((view, depths)),
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

/// How the stored rectangle is cut into blocks.
struct Layout {
    /// Relative to the display window.
    window: TexelRect,
    /// Largest sides of a block.
    block: IVec2,
    columns: usize,
    rows: usize,
    tiled: bool,
    /// First row of the data window as the file counts.
    first_row: i32,
}

impl Layout {
    fn new(header: &Header, window: TexelRect) -> Result<Self, Fault> {
        let sides = window.size();
        let (block, tiled) = match header.blocks {
            BlockDescription::ScanLines => (Vec2(sides.x as usize, header.compression.scan_lines_per_block()), false),
            BlockDescription::Tiles(tiles) if tiles.level_mode == LevelMode::Singular => (tiles.tile_size, true),
            BlockDescription::Tiles(tiles) => {
                return Err(Fault::new("tiles", format!("{:?}", tiles.level_mode), "a shadow map has one level"));
            }
        };
        let side = |length: usize| u32::try_from(length).ok().filter(|side| (1..=32_768).contains(side));
        let block = side(block.x()).zip(side(block.y())).map(UVec2::from).ok_or_else(|| {
            Fault::new("tiles", format!("{} x {}", block.x(), block.y()), "not within 1..=32768 on each side")
        })?;
        let blocks = (sides + block - 1) / block;
        Ok(Self {
            window,
            block: block.as_ivec2(),
            columns: blocks.x as usize,
            rows: blocks.y as usize,
            tiled,
            first_row: header.own_attributes.layer_position.y(),
        })
    }

    fn count(&self) -> usize {
        self.columns * self.rows
    }

    /// A block's place in its grid.
    fn cell(&self, index: usize) -> IVec2 {
        IVec2::new((index % self.columns) as i32, (index / self.columns) as i32)
    }

    /// A block's texels.
    fn area(&self, index: usize) -> TexelRect {
        let min = self.window.min + self.cell(index) * self.block;
        TexelRect::new(min, min + self.block).intersect(self.window)
    }

    /// A block's decoded bytes: four a texel.
    fn samples(&self, meta: &MetaData, file: &[u8], index: usize, offset: usize) -> Result<Vec<u8>, Fault> {
        let cell = self.cell(index);
        let broken = |value: &dyn ToString, problem: &str| {
            Fault::new(format!("block {}, {} at byte {offset}", cell.x, cell.y), value.to_string(), problem)
        };
        let mut words = Words { rest: &file[offset..] };
        let mut word = |what: &str| words.next().ok_or_else(|| broken(&"cut off", what));
        let (found, expected) = if self.tiled {
            let found = [word("tile x")?, word("tile y")?, word("level x")?, word("level y")?];
            (found, [cell.x, cell.y, 0, 0])
        } else {
            ([word("row")?, 0, 0, 0], [self.first_row + cell.y * self.block.y, 0, 0, 0])
        };
        if found != expected {
            return Err(broken(&format!("{found:?}"), &format!("the block there should be {expected:?}")));
        }
        let length = word("length")?;
        let packed = usize::try_from(length).ok().and_then(|length| words.rest.get(..length));
        let packed = packed.ok_or_else(|| broken(&length, "not a length within the file"))?;
        let expected = self.area(index).area() * 4;
        if packed.is_empty() || packed.len() > expected || packed.len().saturating_mul(MOST_BYTES_PER_BYTE) < expected {
            return Err(broken(&packed.len(), &format!("no such number of bytes packs {expected}")));
        }
        let compressed_pixels_le = packed.to_vec();
        let compressed_block = if self.tiled {
            let coordinates =
                TileCoordinates { tile_index: Vec2(cell.x as usize, cell.y as usize), level_index: Vec2(0, 0) };
            CompressedBlock::Tile(CompressedTileBlock { coordinates, compressed_pixels_le })
        } else {
            CompressedBlock::ScanLine(CompressedScanLineBlock { y_coordinate: found[0], compressed_pixels_le })
        };
        let chunk = Chunk { layer_index: 0, compressed_block };
        let samples = UncompressedBlock::decompress_chunk(chunk, meta, true);
        let samples = samples.map_err(|error| broken(&"damaged", &error.to_string()))?.data;
        if samples.len() != expected {
            return Err(broken(&samples.len(), &format!("should unpack to {expected} bytes")));
        }
        Ok(samples)
    }
}

/// Little-endian 32-bit numbers, one after the other.
struct Words<'a> {
    rest: &'a [u8],
}

impl Words<'_> {
    fn next(&mut self) -> Option<i32> {
        let (word, rest) = self.rest.split_first_chunk::<4>()?;
        self.rest = rest;
        Some(i32::from_le_bytes(*word))
    }
}

/// The offset table: every block after it, inside the file and in a place of its own. `rest` starts with the table and ends the file.
fn offsets(rest: &[u8], length: usize, count: usize) -> Result<Vec<usize>, Fault> {
    let cut_off =
        || Fault::new("offset table", format!("{} bytes left", rest.len()), format!("{count} blocks need more"));
    let table_bytes = count.checked_mul(8).ok_or_else(cut_off)?;
    let (table, blocks) = rest.split_at_checked(table_bytes).ok_or_else(cut_off)?;
    let first = length - blocks.len();
    let mut offsets = Vec::with_capacity(count);
    for (index, entry) in table.as_chunks::<8>().0.iter().enumerate() {
        let offset = u64::from_le_bytes(*entry);
        let inside = usize::try_from(offset).ok().filter(|offset| (first..length).contains(offset));
        let problem = || format!("block {index} is not within bytes {first}..{length}");
        offsets.push(inside.ok_or_else(|| Fault::new("offset table", offset, problem()))?);
    }
    let mut sorted = offsets.clone();
    sorted.sort_unstable();
    match sorted.windows(2).find(|pair| pair[0] == pair[1]) {
        Some(pair) => Err(Fault::new("offset table", pair[0], "two blocks in one place")),
        None => Ok(offsets),
    }
}

/// The view from our text, with the digest that belongs to it, or from the attributes that every tool writes.
fn view(header: &Header, size: UVec2) -> Result<(View, Option<u64>), Fault> {
    let attributes = &header.own_attributes;
    if let Some(view) = attributes.comments.as_ref().and_then(|comments| text::to_view(&comments.to_string())) {
        let (view, digest) = view?;
        let (inside, outside) = (view.size(), size);
        return if inside == outside {
            Ok((view, Some(digest)))
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
    Ok((view, None))
}
