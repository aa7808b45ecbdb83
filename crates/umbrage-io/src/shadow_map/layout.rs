use super::channel::Channel;
use crate::error::Fault;
use exr::block::UncompressedBlock;
use exr::block::chunk::{Chunk, CompressedBlock, CompressedScanLineBlock, CompressedTileBlock, TileCoordinates};
use exr::meta::attribute::LevelMode;
use exr::meta::header::Header;
use exr::meta::{BlockDescription, MetaData};
use exr::prelude::{Compression, IntegerBounds, Vec2};
use glam::{IVec2, UVec2};
use umbrage_plane::TexelRect;

/// Deflate makes no more than 1032 bytes of one; a block that claims more is not worth taking memory for.
pub(crate) const MOST_BYTES_PER_BYTE: usize = 1100;

/// Most bytes before a block's packed samples: its part, its coordinates, its level, its length.
const BLOCK_HEAD: usize = 24;

/// Refuses what is not packed without loss by coders that are known to bear hostile bytes. Where there are `notes`, two lossy ones are noted
/// and taken too.
pub(super) fn check_packing(header: &Header, notes: Option<&mut Vec<Fault>>) -> Result<(), Fault> {
    let (lossy, name) = match header.compression {
        Compression::Uncompressed | Compression::RLE | Compression::ZIP1 | Compression::ZIP16 | Compression::PIZ => {
            return Ok(());
        }
        Compression::PXR24 => (true, "PXR24"),
        Compression::B44 => (true, "B44"),
        Compression::B44A => (true, "B44A"),
        Compression::DWAA(_) => (false, "DWAA"),
        Compression::DWAB(_) => (false, "DWAB"),
        Compression::HTJ2K32 | Compression::HTJ2K256 => (false, "HTJ2K"),
    };
    match notes {
        Some(notes) if lossy => {
            let problem = "a lossy packing: depths may be off by more than a bias that fits the map allows";
            notes.push(Fault::new("compression", name, problem));
            Ok(())
        }
        Some(_) => {
            Err(Fault::new("compression", name, "maps are read from none, RLE, ZIPS, ZIP, PIZ, PXR24 and B44 only"))
        }
        None => {
            let problem = "maps are read from none, RLE, ZIPS, ZIP and PIZ only, which keep every bit";
            Err(Fault::new("compression", name, problem))
        }
    }
}

/// Refuses a part of several levels.
pub(super) fn check_levels(header: &Header) -> Result<(), Fault> {
    match header.blocks {
        BlockDescription::Tiles(tiles) if tiles.level_mode != LevelMode::Singular => {
            Err(Fault::new("tiles", format!("{:?}", tiles.level_mode), "a shadow map has one level"))
        }
        _ => Ok(()),
    }
}

/// How the stored rectangle of a part is cut into blocks.
#[derive(Debug)]
pub(crate) struct Layout {
    /// Which part of the file, where there are several: each block then begins with its number.
    part: Option<usize>,
    /// Relative to the display window.
    window: TexelRect,
    /// Largest sides of a block.
    block: IVec2,
    columns: usize,
    rows: usize,
    tiled: bool,
    /// What of each block is wanted.
    channel: Channel,
    /// First row of the data window as the file counts.
    first_row: i32,
}

impl Layout {
    pub(super) fn new(
        header: &Header,
        part: Option<usize>,
        window: TexelRect,
        channel: Channel,
    ) -> Result<Self, Fault> {
        let sides = window.size();
        let (block, tiled) = match header.blocks {
            BlockDescription::ScanLines => (Vec2(sides.x as usize, header.compression.scan_lines_per_block()), false),
            BlockDescription::Tiles(tiles) => (tiles.tile_size, true),
        };
        check_levels(header)?;
        let side = |length: usize| u32::try_from(length).ok().filter(|side| (1..=32_768).contains(side));
        let block = side(block.x()).zip(side(block.y())).map(UVec2::from).ok_or_else(|| {
            Fault::new("tiles", format!("{} x {}", block.x(), block.y()), "not within 1..=32768 on each side")
        })?;
        let blocks = (sides + block - 1) / block;
        Ok(Self {
            part,
            window,
            block: block.as_ivec2(),
            columns: blocks.x as usize,
            rows: blocks.y as usize,
            tiled,
            channel,
            first_row: header.own_attributes.layer_position.y(),
        })
    }

    /// Number of blocks.
    pub(crate) fn count(&self) -> usize {
        self.columns * self.rows
    }

    /// The stored rectangle, relative to the display window.
    pub(crate) fn window(&self) -> TexelRect {
        self.window
    }

    /// False when the blocks are scan lines.
    pub(crate) fn is_tiled(&self) -> bool {
        self.tiled
    }

    /// The block that holds a texel of the window.
    pub(crate) fn index(&self, texel: IVec2) -> usize {
        let cell = ((texel - self.window.min) / self.block).as_uvec2();
        cell.y as usize * self.columns + cell.x as usize
    }

    /// The row that a block of scan lines begins with, as the file counts.
    pub(crate) fn row(&self, index: usize) -> i32 {
        self.first_row + self.cell(index).y * self.block.y
    }

    /// A block's place in its grid.
    fn cell(&self, index: usize) -> IVec2 {
        IVec2::new((index % self.columns) as i32, (index / self.columns) as i32)
    }

    /// A block's texels.
    pub(crate) fn area(&self, index: usize) -> TexelRect {
        let min = self.window.min + self.cell(index) * self.block;
        TexelRect::new(min, min + self.block).intersect(self.window)
    }

    /// More bytes than these of the file never belong to a block.
    pub(crate) fn most_bytes(&self, index: usize) -> usize {
        BLOCK_HEAD + self.area(index).area() * self.channel.texel_bytes()
    }

    /// What a fault in a block is said of.
    pub(crate) fn name(&self, index: usize, offset: u64) -> String {
        let cell = self.cell(index);
        format!("block {}, {} at byte {offset}", cell.x, cell.y)
    }

    /// A block behind its part's number, where the file has several parts.
    pub(crate) fn unmarked<'a>(&self, block: &'a [u8], index: usize, offset: u64) -> Result<&'a [u8], Fault> {
        let Some(part) = self.part else { return Ok(block) };
        let broken =
            |value: &dyn ToString, problem: &str| Fault::new(self.name(index, offset), value.to_string(), problem);
        let (found, rest) = block.split_first_chunk::<4>().ok_or_else(|| broken(&"cut off", "part"))?;
        let found = i32::from_le_bytes(*found);
        if usize::try_from(found) == Ok(part) {
            return Ok(rest);
        }
        Err(broken(&found, &format!("the block there should be of part {part}")))
    }

    /// The wanted channel's samples of a block, decoded: four bytes for each texel. `block` holds the file from `offset` on, as far as the file goes or farther than
    /// the block does.
    pub(crate) fn samples(&self, meta: &MetaData, block: &[u8], index: usize, offset: u64) -> Result<Vec<u8>, Fault> {
        let cell = self.cell(index);
        let broken =
            |value: &dyn ToString, problem: &str| Fault::new(self.name(index, offset), value.to_string(), problem);
        let mut words = Words { rest: self.unmarked(block, index, offset)? };
        let mut word = |what: &str| words.next().ok_or_else(|| broken(&"cut off", what));
        let (found, expected) = if self.tiled {
            let found = [word("tile x")?, word("tile y")?, word("level x")?, word("level y")?];
            (found, [cell.x, cell.y, 0, 0])
        } else {
            ([word("row")?, 0, 0, 0], [self.row(index), 0, 0, 0])
        };
        if found != expected {
            return Err(broken(&format!("{found:?}"), &format!("the block there should be {expected:?}")));
        }
        let length = word("length")?;
        let expected = self.area(index).area() * self.channel.texel_bytes();
        let packs =
            |length: &usize| (1..=expected).contains(length) && length.saturating_mul(MOST_BYTES_PER_BYTE) >= expected;
        let packed = usize::try_from(length).ok().filter(packs);
        let packed = packed.ok_or_else(|| broken(&length, &format!("no such number of bytes packs {expected}")))?;
        let packed = words.rest.get(..packed).ok_or_else(|| broken(&length, "not a length within the file"))?;
        let compressed_pixels_le = packed.to_vec();
        let compressed_block = if self.tiled {
            let coordinates =
                TileCoordinates { tile_index: Vec2(cell.x as usize, cell.y as usize), level_index: Vec2(0, 0) };
            CompressedBlock::Tile(CompressedTileBlock { coordinates, compressed_pixels_le })
        } else {
            CompressedBlock::ScanLine(CompressedScanLineBlock { y_coordinate: found[0], compressed_pixels_le })
        };
        let chunk = Chunk { layer_index: self.part.unwrap_or(0), compressed_block };
        let samples = UncompressedBlock::decompress_chunk(chunk, meta, true);
        let samples = samples.map_err(|error| broken(&"damaged", &error.to_string()))?.data;
        if samples.len() != expected {
            return Err(broken(&samples.len(), &format!("should unpack to {expected} bytes")));
        }
        Ok(self.channel.of_block(samples, self.area(index).size().x as usize))
    }

    /// A block as a file has it behind its part's number, of all samples of its texels: rows of native-endian numbers.
    pub(super) fn pack(&self, header: &Header, index: usize, samples: Vec<u8>) -> Result<Vec<u8>, String> {
        let (cell, area) = (self.cell(index), self.area(index));
        let (first, sides) = (area.min - self.window.min, area.size());
        let section = IntegerBounds::new(Vec2(first.x, first.y), Vec2(sides.x as usize, sides.y as usize));
        let packed = header.compression.compress_image_section_to_le(header, samples, section);
        let packed = packed.map_err(|error| error.to_string())?;
        let length = i32::try_from(packed.len()).map_err(|error| error.to_string())?;
        let head = if self.tiled { vec![cell.x, cell.y, 0, 0, length] } else { vec![self.row(index), length] };
        Ok(head.into_iter().flat_map(i32::to_le_bytes).chain(packed).collect())
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
