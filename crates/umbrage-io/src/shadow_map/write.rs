use super::words::Words;
use super::{matrices, text};
use crate::error::Fault;
use exr::block::{self, BlockIndex, writer::ChunksWriter};
use exr::meta::BlockDescription;
use exr::meta::attribute::{LevelMode, TileDescription};
use exr::meta::header::{Header, LayerAttributes};
use exr::prelude::{AttributeValue, ChannelDescription, Compression, IntegerBounds, LineOrder, SampleType, Text, Vec2};
use glam::IVec2;
use std::io::Cursor;
use umbrage_depth::DepthMap;
use umbrage_plane::{TexelRect, View};

/// Side of a tile, texels.
const TILE: usize = 64;

/// A map's file; with `words`, one of two parts.
pub(crate) fn encode(map: &impl DepthMap, words: Option<&Words<'_>>) -> Result<Vec<u8>, Fault> {
    let view = map.view();
    let window = stored_window(map);
    let texels = TexelRect::of_size(view.size()).texels();
    let comments = text::of_map(view, map.stored(), window, texels.map(|texel| map.depth(texel)));
    let mut bytes = Cursor::new(Vec::new());
    let further = words.map(|words| words.header().with_display_window(display(view)));
    let headers = std::iter::once(header(view, window, &comments)).chain(further).collect();
    let written = block::write(&mut bytes, headers, true, |meta, writer| {
        let mut compressor = writer.sequential_blocks_compressor(&meta);
        let samples = |block: BlockIndex| match words {
            Some(words) if block.layer > 0 => words.samples(block),
            _ => samples(map, window, block),
        };
        for (index, block) in meta.collect_ordered_block_data(samples) {
            compressor.compress_block(index, block)?;
        }
        Ok(())
    });
    let size = view.size();
    written.map_err(|error| Fault::new("shadow map", format!("{} x {}", size.x, size.y), error))?;
    Ok(bytes.into_inner())
}

/// The smallest rectangle around the finite depths (R87-19); one texel, as EXR needs it, when there are none.
pub(crate) fn stored_window(map: &impl DepthMap) -> TexelRect {
    let whole = TexelRect::of_size(map.view().size());
    let side = TILE as i32;
    let cells = TexelRect::new(IVec2::ZERO, (whole.max + side - 1) / side).texels();
    let blocks = cells.map(|cell| TexelRect::new(cell * side, (cell + 1) * side).intersect(whole));
    let filled = blocks.filter(|block| map.range(*block).min < f32::INFINITY);
    let finite = filled.flat_map(TexelRect::texels).filter(|texel| map.depth(*texel).is_finite());
    let one = |texel: IVec2| TexelRect::new(texel, texel + IVec2::ONE);
    let window = finite.fold(TexelRect::EMPTY, |window, texel| window.union(one(texel)));
    if window.is_empty() { one(IVec2::ZERO) } else { window }
}

/// What every map's file says of its view.
pub(crate) fn attributes(view: &View, window: TexelRect, comments: &str) -> LayerAttributes {
    let [world_to_camera, world_to_ndc] = matrices::of_view(view);
    let mut attributes = LayerAttributes {
        layer_position: Vec2(window.min.x, window.min.y),
        world_to_camera: Some(world_to_camera),
        world_to_normalized_device: Some(world_to_ndc),
        near_clip_plane: Some(view.near() as f32),
        far_clip_plane: Some(view.far() as f32),
        comments: Some(Text::from(comments)),
        software_name: Some(Text::from(text::SOFTWARE)),
        ..LayerAttributes::named("shadow")
    };
    // The crate keeps other attributes in a hash map: more than one would be written in a different order each time.
    attributes.other.insert(Text::from("textureformat"), AttributeValue::Text(Text::from("Shadow")));
    attributes
}

/// A channel of floats, one a texel or deep.
pub(crate) fn channel(name: &str) -> ChannelDescription {
    ChannelDescription {
        name: Text::from(name),
        sample_type: SampleType::F32,
        quantize_linearly: false,
        sampling: Vec2(1, 1),
    }
}

/// The display window: the whole map.
pub(crate) fn display(view: &View) -> IntegerBounds {
    IntegerBounds::from_dimensions(Vec2(view.size().x as usize, view.size().y as usize))
}

fn header(view: &View, window: TexelRect, comments: &str) -> Header {
    let sides = window.size();
    let tiles = TileDescription {
        tile_size: Vec2(TILE, TILE),
        level_mode: LevelMode::Singular,
        rounding_mode: exr::math::RoundingMode::Down,
    };
    let channels = std::iter::once(channel("Z")).collect();
    Header::new(Text::from("shadow"), Vec2(sides.x as usize, sides.y as usize), channels)
        .with_encoding(Compression::ZIP16, BlockDescription::Tiles(tiles), LineOrder::Increasing)
        .with_attributes(attributes(view, window, comments))
        .with_display_window(display(view))
}

/// A block's depths as the coder wants them: rows of native-endian floats.
fn samples(map: &impl DepthMap, window: TexelRect, block: BlockIndex) -> Vec<u8> {
    let first = window.min + IVec2::new(block.pixel_position.x() as i32, block.pixel_position.y() as i32);
    let sides = IVec2::new(block.pixel_size.x() as i32, block.pixel_size.y() as i32);
    TexelRect::new(first, first + sides).texels().flat_map(|texel| map.depth(texel).to_ne_bytes()).collect()
}
