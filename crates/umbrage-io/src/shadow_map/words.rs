//! A second part behind the depths, which holds the facets: 32-bit words, row after row.

use super::channel::Channel;
use super::layout::check_packing;
use super::{Layout, text};
use crate::error::Fault;
use exr::block::BlockIndex;
use exr::meta::header::{Header, LayerAttributes};
use exr::meta::{BlockDescription, MetaData};
use exr::prelude::{ChannelDescription, Compression, LineOrder, SampleType, Text, Vec2};
use glam::UVec2;
use umbrage_plane::TexelRect;

/// The name of the part and of its one channel.
const NAME: &str = "facets";

/// Words in a row.
const ROW: usize = 1024;

/// Longest side that is read, so that adding a block's side to a place cannot overflow.
const MOST_SIDE: i32 = 1 << 30;

/// What a file is to keep beside its depths.
#[derive(Debug)]
pub(crate) struct Words<'a> {
    /// The part's `comments`, which say what the words are.
    pub(crate) comments: String,
    pub(crate) words: &'a [u32],
}

impl Words<'_> {
    pub(super) fn header(&self) -> Header {
        let channel = ChannelDescription {
            name: Text::from(NAME),
            sample_type: SampleType::U32,
            quantize_linearly: false,
            sampling: Vec2(1, 1),
        };
        let attributes = LayerAttributes {
            comments: Some(Text::from(self.comments.as_str())),
            software_name: Some(Text::from(text::SOFTWARE)),
            ..LayerAttributes::named(NAME)
        };
        let size = Vec2(ROW, self.words.len().div_ceil(ROW).max(1));
        Header::new(Text::from(NAME), size, std::iter::once(channel).collect())
            .with_encoding(Compression::ZIP16, BlockDescription::ScanLines, LineOrder::Increasing)
            .with_attributes(attributes)
    }

    /// A block as the coder wants it, native-endian; 0 behind the last word.
    pub(super) fn samples(&self, block: BlockIndex) -> Vec<u8> {
        let first = block.pixel_position.y() * ROW;
        let words = (first..first + block.pixel_size.area()).map(|index| self.words.get(index).copied().unwrap_or(0));
        words.flat_map(u32::to_ne_bytes).collect()
    }
}

/// Where a file has its words.
#[derive(Debug)]
pub(crate) struct WordPart {
    pub(super) layout: Layout,
    pub(super) offsets: Vec<u64>,
}

impl WordPart {
    /// The number of the part in its file.
    pub(super) const PART: usize = 1;

    /// The blocks that a header describes, if it is that of such a part.
    pub(super) fn layout(header: &Header) -> Result<Layout, Fault> {
        let layout = || {
            if header.deep || header.blocks != BlockDescription::ScanLines {
                let form = if header.deep { "deep" } else { "tiled" };
                return Err(Fault::new("type", form, "words are read from scan lines"));
            }
            let channels = &header.channels.list;
            match channels.as_slice() {
                [only] if only.name.as_slice() == NAME.as_bytes() => {
                    if only.sample_type != SampleType::U32 || only.sampling != Vec2(1, 1) {
                        let value = format!("{:?} {:?}", only.sample_type, only.sampling);
                        return Err(Fault::new("channel", value, "not of 32-bit whole numbers, one a pixel"));
                    }
                }
                _ => {
                    let names = channels.iter().map(|channel| channel.name.to_string()).collect::<Vec<_>>().join(", ");
                    return Err(Fault::new("channels", names, format!("not the one channel {NAME}")));
                }
            }
            check_packing(header)?;
            let data = header.data_window();
            let side = |length: usize| i32::try_from(length).ok().filter(|side| (1..=MOST_SIDE).contains(side));
            let sides = side(data.size.x()).zip(side(data.size.y())).filter(|_| data.position == Vec2(0, 0));
            let Some((columns, rows)) = sides else {
                let (at, sides) = (data.position, data.size);
                let value = format!("{} x {} at {}, {}", sides.x(), sides.y(), at.x(), at.y());
                return Err(Fault::new("dataWindow", value, "empty, too large or not at 0, 0"));
            };
            let window = TexelRect::of_size(UVec2::new(columns as u32, rows as u32));
            Layout::new(header, Some(Self::PART), window, Channel::ONLY)
        };
        layout().map_err(in_part)
    }

    /// What the part says of its words.
    pub(crate) fn comments(meta: &MetaData) -> Option<String> {
        meta.headers.get(Self::PART)?.own_attributes.comments.as_ref().map(Text::to_string)
    }

    /// All words of the part, from the bytes of the whole file; those that fill the last row are included. At most `most`.
    pub(crate) fn read(&self, meta: &MetaData, bytes: &[u8], most: u64) -> Result<Vec<u32>, Fault> {
        let sides = self.layout.window().size();
        let shown = format!("{} x {}", sides.x, sides.y);
        if u64::from(sides.x) * u64::from(sides.y) > most {
            return Err(in_part(Fault::new("dataWindow", shown, format!("more than the allowed {most} words"))));
        }
        let mut words: Vec<u32> = Vec::new();
        for (index, &offset) in self.offsets.iter().enumerate() {
            // A block is bounded by the bytes that the file has for it, the whole only by what the header says: memory is taken block by
            // block.
            let block = bytes.get(offset as usize..).unwrap_or_default();
            let samples = self.layout.samples(meta, block, index, offset).map_err(in_part)?;
            let samples = samples.as_chunks::<4>().0;
            words.try_reserve(samples.len()).map_err(|full| in_part(Fault::new("dataWindow", &shown, full)))?;
            words.extend(samples.iter().map(|sample| u32::from_ne_bytes(*sample)));
        }
        Ok(words)
    }
}

/// A fault as that of the part.
pub(crate) fn in_part(fault: Fault) -> Fault {
    Fault { field: format!("part {NAME}: {}", fault.field), ..fault }
}
