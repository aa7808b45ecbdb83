//! Good EXR files of a few texels, ours and others'.

use crate::exr_file::ExrFile;
use crate::exr_part::Chunk;
use crate::mutate::Dice;
use exr::meta::BlockDescription;
use exr::meta::attribute::{LevelMode, TileDescription};
use exr::meta::header::Header;
use exr::prelude::{ChannelDescription, Compression, IntegerBounds, LineOrder, SampleType, Text, Vec2};
use glam::{DVec3, IVec2, UVec2, Vec3};
use std::sync::LazyLock;
use umbrage_depth::{DeepMap, DepthMap, Map, Raw, Step};
use umbrage_io::{encode_deep_map, encode_facet_map, encode_shadow_map};
use umbrage_plane::{TexelRect, View};
use umbrage_raster::Triangle;
use umbrage_recipe::{PresetName, Recipe};

/// What tiles may be packed by, as files number it, and as the library calls it.
pub(crate) const CODERS: [(u8, Compression); 5] = [
    (0, Compression::Uncompressed),
    (1, Compression::RLE),
    (2, Compression::ZIP1),
    (3, Compression::ZIP16),
    (4, Compression::PIZ),
];

/// A spot light's view of so many texels.
///
/// # Panics
/// When a side is 0 or too long for a view.
pub fn view(size: UVec2) -> View {
    View::perspective(DVec3::new(1.5, 2.0, 9.0), DVec3::ZERO, DVec3::Y, 0.9, 1.0, 30.0, size).expect("a view")
}

/// A map with a surface in all but some texels of a view.
///
/// # Panics
/// Never: the depths are those of a map.
pub fn map(view: &View) -> Raw {
    let texels = view.size().element_product();
    let depth = |index: u32| if index % 7 == 3 { f32::INFINITY } else { 3.0 + (index as f32).sqrt() / 3.0 };
    Raw::new(*view, (0..texels).map(depth).collect()).expect("depths")
}

/// Our file of a map of 8 × 8 texels.
///
/// # Panics
/// When it cannot be written.
pub fn flat() -> Vec<u8> {
    encode_shadow_map(&map(&view(UVec2::splat(8)))).expect("written")
}

/// Our file of a deep map of 6 × 5 texels, grey or coloured.
///
/// # Panics
/// When it cannot be written.
pub fn deep(coloured: bool) -> Vec<u8> {
    let size = UVec2::new(6, 5);
    let texel = |index: u32| -> Vec<Step> {
        let share = |step: u32| 1.0 - (step + 1) as f32 / 4.0;
        let passes = |step: u32| {
            if coloured { Vec3::new(share(step), 0.9 * share(step), 0.0) } else { Vec3::splat(share(step)) }
        };
        (0..index % 4).map(|step| Step { depth: 3.0 + (index + 5 * step) as f32 / 4.0, passes: passes(step) }).collect()
    };
    let texels = (0..size.element_product()).map(texel);
    encode_deep_map(&DeepMap::new(view(size), 0.0, texels).expect("a map")).expect("written")
}

/// Our file of a map of facets of 8 × 8 texels.
///
/// # Panics
/// When it cannot be written.
pub fn facets() -> Vec<u8> {
    let triangles = [(1.0, 0), (3.0, 1), (-1.0, 2)].map(|(height, object)| {
        let corners = [DVec3::new(-3.0, -2.0, height), DVec3::new(3.0, -1.0, height), DVec3::new(0.5, 3.0, 1.0)];
        Triangle { corners, object, sheet: true }
    });
    let Map::Facets(map) = Recipe::from(PresetName::Auto).bake(&view(UVec2::splat(8)), triangles) else {
        panic!("auto stores facets")
    };
    encode_facet_map(&map).expect("written")
}

/// A file of ours as another maker would write it: without the view in full precision, and so without a digest.
///
/// # Panics
/// When the file is not one of ours.
pub fn foreign(file: &[u8]) -> Vec<u8> {
    let mut file = ExrFile::parse(file).expect("a file of ours");
    let part = &mut file.parts[0];
    part.remove("comments");
    part.remove("software");
    let order: Vec<usize> = (0..part.chunks.len()).collect();
    file.to_bytes(&order)
}

/// Our file of a map that is stored whole, and nothing packed in it.
fn unpacked(map: &Raw) -> ExrFile {
    let mut file = ExrFile::parse(&encode_shadow_map(map).expect("written")).expect("a file of ours");
    let part = &mut file.parts[0];
    let size = map.view().size();
    assert_eq!(part.sides(), Ok([size.x as usize, size.y as usize]), "a map that is stored whole");
    part.set("compression", "compression", &[0]);
    file
}

/// A chunk that holds the depths of a part of a map.
fn chunk(map: &Raw, place: Vec<i32>, texels: TexelRect) -> Chunk {
    let texels = texels.intersect(TexelRect::of_size(map.view().size())).texels();
    Chunk { place, packed: texels.flat_map(|texel| map.depth(texel).to_le_bytes()).collect(), ..Chunk::default() }
}

/// The file of a map with tiles of this many texels per side, not compressed, which lie in the file in any order.
///
/// # Panics
/// When the map cannot be written, or is not seen in every texel of its border.
pub fn cut_into_tiles(map: &Raw, side: u8, mut dice: Dice) -> Vec<u8> {
    let (mut file, side) = (unpacked(map), i32::from(side));
    let part = &mut file.parts[0];
    let sides = [side.to_le_bytes(), side.to_le_bytes()].concat();
    part.set("tiles", "tiledesc", &[sides, vec![0]].concat());
    part.set("lineOrder", "lineOrder", &[2]);
    let grid = TexelRect::new(IVec2::ZERO, (map.view().size().as_ivec2() + side - 1) / side);
    let tile = |at: IVec2| chunk(map, vec![at.x, at.y, 0, 0], TexelRect::new(at * side, (at + 1) * side));
    part.chunks = grid.texels().map(tile).collect();
    part.set("chunkCount", "int", &(part.chunks.len() as i32).to_le_bytes());
    let mut order: Vec<usize> = (0..part.chunks.len()).collect();
    for last in (1..order.len()).rev() {
        order.swap(last, dice.below(last + 1));
    }
    file.to_bytes(&order)
}

/// The file of a map as scan lines, not packed, the last of which comes first.
///
/// # Panics
/// As [`cut_into_tiles`].
pub fn cut_into_rows(map: &Raw) -> Vec<u8> {
    let (mut file, size) = (unpacked(map), map.view().size().as_ivec2());
    file.version = 2;
    let part = &mut file.parts[0];
    part.remove("tiles");
    part.set("type", "string", b"scanlineimage");
    part.set("lineOrder", "lineOrder", &[1]);
    let row = |y: i32| chunk(map, vec![y], TexelRect::new(IVec2::new(0, y), IVec2::new(size.x, y + 1)));
    part.chunks = (0..size.y).map(row).collect();
    part.set("chunkCount", "int", &size.y.to_le_bytes());
    let order: Vec<usize> = (0..part.chunks.len()).rev().collect();
    file.to_bytes(&order)
}

/// The file of a map of 8 × 8 texels without a digest whose one tile is these bytes.
pub(crate) fn tile_packed_by(coder: u8, packed: &[u8]) -> Vec<u8> {
    static FILE: LazyLock<ExrFile> = LazyLock::new(|| ExrFile::parse(&foreign(&flat())).expect("a file of ours"));
    let mut file = FILE.clone();
    file.parts[0].set("compression", "compression", &[coder]);
    file.parts[0].chunks[0].packed = packed.to_vec();
    file.to_bytes(&[0])
}

/// What [`exr_blocks`](crate::exr_blocks) takes: the number of a coder, and 8 × 8 depths that it has packed.
pub(crate) fn blocks() -> Vec<Vec<u8>> {
    let map = map(&view(UVec2::splat(8)));
    let channel = ChannelDescription {
        name: Text::from("Z"),
        sample_type: SampleType::F32,
        quantize_linearly: false,
        sampling: Vec2(1, 1),
    };
    let tiles = TileDescription {
        tile_size: Vec2(64, 64),
        level_mode: LevelMode::Singular,
        rounding_mode: exr::math::RoundingMode::Down,
    };
    let block = |(coder, compression): (u8, Compression)| {
        let header = Header::new(Text::from("shadow"), Vec2(8, 8), std::iter::once(channel.clone()).collect());
        let header = header.with_encoding(compression, BlockDescription::Tiles(tiles), LineOrder::Increasing);
        let samples = map.depths().iter().flat_map(|depth| depth.to_ne_bytes()).collect();
        let area = IntegerBounds::from_dimensions(Vec2(8, 8));
        let packed = compression.compress_image_section_to_le(&header, samples, area).expect("packed");
        [vec![coder], packed].concat()
    };
    CODERS.map(block).to_vec()
}
