//! A part beside that of the depths, which holds the facets: 32-bit words, row after row.

use super::channel::Channel;
use super::file::{Part, part_name};
use super::layout::check_packing;
use super::parts::Parts;
use super::write::display;
use super::{Layout, text};
use crate::error::Fault;
use exr::meta::BlockDescription;
use exr::meta::header::{Header, LayerAttributes};
use exr::prelude::{ChannelDescription, Compression, LineOrder, SampleType, Text, Vec2};
use glam::UVec2;
use umbrage_plane::TexelRect;

/// The name of its one channel, and of the part in a file of one map.
pub(crate) const NAME: &str = "facets";

/// Words in a row.
const ROW: usize = 1024;

/// Longest side that is read, so that adding a block's side to a place cannot overflow.
const MOST_SIDE: i32 = 1 << 30;

/// The first words of the part's `comments`.
pub(crate) const SIGNATURE: &str = "umbrage facets";

/// Whether a part holds words, by its channel or by its `comments`, so that neither can be lost without notice.
pub(super) fn is_words(header: &Header) -> bool {
    let named = header.channels.list.iter().any(|channel| channel.name.as_slice() == NAME.as_bytes());
    let comments = header.own_attributes.comments.as_ref();
    named || comments.is_some_and(|comments| comments.as_slice().starts_with(SIGNATURE.as_bytes()))
}

/// A part of words; `comments` say what they are.
pub(crate) fn words_part(name: &str, comments: &str, words: Vec<u32>, size: UVec2) -> Result<Part<'static>, Fault> {
    let channel = ChannelDescription {
        name: Text::from(NAME),
        sample_type: SampleType::U32,
        quantize_linearly: false,
        sampling: Vec2(1, 1),
    };
    let name = part_name(name)?;
    let attributes = LayerAttributes {
        comments: Some(Text::from(comments)),
        software_name: Some(Text::from(text::SOFTWARE)),
        ..LayerAttributes::named(name.clone())
    };
    let sides = UVec2::new(ROW as u32, words.len().div_ceil(ROW).max(1) as u32);
    let header = Header::new(name, Vec2(sides.x as usize, sides.y as usize), std::iter::once(channel).collect())
        .with_encoding(Compression::ZIP16, BlockDescription::ScanLines, LineOrder::Increasing)
        .with_attributes(attributes)
        .with_display_window(display(size));
    let layout = Layout::new(&header, None, TexelRect::of_size(sides), Channel::ONLY)?;
    let again = header.clone();
    let block = move |index: usize| {
        let area = layout.area(index);
        // 0 behind the last word.
        let word = |place: usize| words.get(place).copied().unwrap_or(0);
        let places = (area.min.y as usize * ROW..).take(area.area());
        layout.pack(&again, index, places.map(word).flat_map(u32::to_ne_bytes).collect())
    };
    Ok(Part { header, further: None, deep: false, block: Box::new(block) })
}

/// Where a file has its words.
#[derive(Debug)]
pub(crate) struct WordPart<'a> {
    parts: &'a Parts,
    part: usize,
    layout: Layout,
}

impl<'a> WordPart<'a> {
    /// A part of a file, if it is of that kind.
    pub(crate) fn new(parts: &'a Parts, part: usize) -> Result<Self, Fault> {
        let header = parts.header(part);
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
                        return Err(Fault::new("channel", value, "not of 32-bit whole numbers, one per pixel"));
                    }
                }
                _ => {
                    let names = channels.iter().map(|channel| channel.name.to_string()).collect::<Vec<_>>().join(", ");
                    return Err(Fault::new("channels", names, format!("not the one channel {NAME}")));
                }
            }
            check_packing(header, None)?;
            let data = header.data_window();
            let side = |length: usize| i32::try_from(length).ok().filter(|side| (1..=MOST_SIDE).contains(side));
            let sides = side(data.size.x()).zip(side(data.size.y())).filter(|_| data.position == Vec2(0, 0));
            let Some((columns, rows)) = sides else {
                let (at, sides) = (data.position, data.size);
                let value = format!("{} x {} at {}, {}", sides.x(), sides.y(), at.x(), at.y());
                return Err(Fault::new("dataWindow", value, "empty, too large or not at 0, 0"));
            };
            let window = TexelRect::of_size(UVec2::new(columns as u32, rows as u32));
            Layout::new(header, parts.mark(part), window, Channel::ONLY)
        };
        layout().map(|layout| Self { parts, part, layout })
    }

    /// What the part says of its words.
    pub(crate) fn comments(&self) -> Option<String> {
        self.parts.header(self.part).own_attributes.comments.as_ref().map(Text::to_string)
    }

    /// All words of the part, from the bytes of the whole file; those that fill the last row are included. At most `most`.
    pub(crate) fn read(&self, bytes: &[u8], most: u64) -> Result<Vec<u32>, Fault> {
        let sides = self.layout.window().size();
        let shown = format!("{} x {}", sides.x, sides.y);
        if u64::from(sides.x) * u64::from(sides.y) > most {
            return Err(Fault::new("dataWindow", shown, format!("more than the allowed {most} words")));
        }
        let mut words: Vec<u32> = Vec::new();
        for (index, &offset) in self.parts.offsets(self.part).iter().enumerate() {
            // A block is bounded by the bytes that the file has for it, the whole only by what the header says: memory is taken block by
            // block.
            let block = bytes.get(offset as usize..).unwrap_or_default();
            let samples = self.layout.samples(&self.parts.meta, block, index, offset)?;
            let samples = samples.as_chunks::<4>().0;
            words.try_reserve(samples.len()).map_err(|full| Fault::new("dataWindow", &shown, full))?;
            words.extend(samples.iter().map(|sample| u32::from_ne_bytes(*sample)));
        }
        Ok(words)
    }
}
