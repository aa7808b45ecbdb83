use super::channel::Channel;
use super::file::{self, Part, part_name};
use super::{Layout, matrices, text};
use crate::error::Fault;
use exr::meta::BlockDescription;
use exr::meta::attribute::{LevelMode, TileDescription};
use exr::meta::header::{Header, LayerAttributes};
use exr::prelude::{AttributeValue, ChannelDescription, Compression, IntegerBounds, LineOrder, SampleType, Text, Vec2};
use glam::{IVec2, UVec2};
use umbrage_depth::DepthMap;
use umbrage_plane::{TexelRect, View};

/// Side of a tile of a file, texels.
pub(super) const TILE: usize = 64;

/// What a map is called that is the only one of its file.
pub(crate) const ONLY: &str = "shadow";

/// What a part is about, beside its map.
#[derive(Clone, Copy, Debug)]
pub(crate) struct About<'a> {
    /// What it is called.
    pub name: &'a str,
    /// Cosine of half the angle of the light's cone, where the map is one of several that have none of their own.
    pub light_cone: Option<f64>,
    /// Columns and rows of the file's display window, which all parts share; the map is in its upper left.
    pub display: UVec2,
}

impl About<'_> {
    /// The only map of a file.
    pub fn only(map: &impl DepthMap) -> Self {
        Self { name: ONLY, light_cone: None, display: map.view().size() }
    }

    pub fn head(self, map: &impl DepthMap) -> text::Head<'_> {
        text::Head { view: map.view(), stored: map.stored(), light_cone: self.light_cone }
    }

    /// A header with what every map's says of its view.
    pub fn header(self, view: &View, comments: &str, window: TexelRect, channels: &[&str]) -> Result<Header, Fault> {
        let name = part_name(self.name)?;
        let [world_to_camera, world_to_ndc] = matrices::of_view(view, self.display);
        let mut attributes = LayerAttributes {
            layer_position: Vec2(window.min.x, window.min.y),
            world_to_camera: Some(world_to_camera),
            world_to_normalized_device: Some(world_to_ndc),
            near_clip_plane: Some(view.near() as f32),
            far_clip_plane: Some(view.far() as f32),
            comments: Some(Text::from(comments)),
            software_name: Some(Text::from(text::SOFTWARE)),
            ..LayerAttributes::named(name.clone())
        };
        // The crate keeps other attributes in a hash map: more than one would be written in a different order each time.
        attributes.other.insert(Text::from("textureformat"), AttributeValue::Text(Text::from("Shadow")));
        let sides = window.size();
        let channels = channels.iter().map(|name| channel(name)).collect();
        Ok(Header::new(name, Vec2(sides.x as usize, sides.y as usize), channels)
            .with_attributes(attributes)
            .with_display_window(display(self.display)))
    }
}

/// The file of the only map.
pub(crate) fn encode(map: &impl DepthMap) -> Result<Vec<u8>, Fault> {
    file::encode(&[part(map, About::only(map))?])
}

/// A map's part.
pub(crate) fn part<'a>(map: &'a impl DepthMap, about: About<'a>) -> Result<Part<'a>, Fault> {
    let window = stored_window(map);
    let texels = TexelRect::of_size(map.view().size()).texels();
    let comments = text::of_map(about.head(map), window, texels.map(|texel| map.depth(texel)));
    let header = tiled(about.header(map.view(), &comments, window, &["Z"])?);
    let layout = Layout::new(&header, None, window, Channel::ONLY)?;
    let again = header.clone();
    let block = move |index: usize| {
        let depths = layout.area(index).texels().flat_map(|texel| map.depth(texel).to_ne_bytes());
        layout.pack(&again, index, depths.collect())
    };
    Ok(Part { header, further: None, deep: false, block: Box::new(block) })
}

/// A header of a part in tiles.
pub(super) fn tiled(header: Header) -> Header {
    let tiles = TileDescription {
        tile_size: Vec2(TILE, TILE),
        level_mode: LevelMode::Singular,
        rounding_mode: exr::math::RoundingMode::Down,
    };
    header.with_encoding(Compression::ZIP16, BlockDescription::Tiles(tiles), LineOrder::Increasing)
}

/// The smallest rectangle around the finite depths (Reeves 1987); one texel, as EXR needs it, when there are none.
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

/// A channel of floats, one per texel or deep.
fn channel(name: &str) -> ChannelDescription {
    ChannelDescription {
        name: Text::from(name),
        sample_type: SampleType::F32,
        quantize_linearly: false,
        sampling: Vec2(1, 1),
    }
}

/// A display window of so many columns and rows.
pub(super) fn display(size: UVec2) -> IntegerBounds {
    IntegerBounds::from_dimensions(Vec2(size.x as usize, size.y as usize))
}
