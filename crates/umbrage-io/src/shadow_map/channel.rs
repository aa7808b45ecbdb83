//! Which channel of a file holds the depths.

use crate::error::Fault;
use exr::meta::header::Header;
use exr::prelude::{SampleType, Vec2, f16};

/// Where a block has the samples of one channel: rows one after the other, and in each row the samples of all channels, channel by channel.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Channel {
    /// Bytes that a row has for each texel before them, and for each texel in all.
    before: usize,
    texel: usize,
    half: bool,
}

impl Channel {
    /// The one channel of a part whose samples take four bytes.
    pub const ONLY: Self = Self { before: 0, texel: 4, half: false };

    /// The depths of a header, as floats of 16 or 32 bits: the channel `wanted`, or else `Z`, or the only one whose name ends in `.Z`.
    pub fn of_depths(header: &Header, wanted: Option<&str>) -> Result<Self, Fault> {
        let channels = &header.channels.list;
        let Some(index) = place(header, wanted) else {
            let names = channels.iter().map(|channel| channel.name.to_string()).collect::<Vec<_>>().join(", ");
            return Err(Fault::new("channels", names, format!("no channel {} among them", wanted.unwrap_or("Z"))));
        };
        let depths = &channels[index];
        let field = format!("channel {}", depths.name);
        if depths.sample_type == SampleType::U32 {
            return Err(Fault::new(field, "U32", "not of floats"));
        }
        if let Some(coarse) = channels.iter().find(|channel| channel.sampling != Vec2(1, 1)) {
            let problem = "not 1, 1";
            return Err(Fault::new(
                format!("channel {} sampling", coarse.name),
                format!("{:?}", coarse.sampling),
                problem,
            ));
        }
        let bytes = |channels: &[exr::prelude::ChannelDescription]| -> usize {
            channels.iter().map(|channel| channel.sample_type.bytes_per_sample()).sum()
        };
        let half = depths.sample_type == SampleType::F16;
        Ok(Self { before: bytes(&channels[..index]), texel: bytes(channels), half })
    }

    /// Bytes of a texel, all channels together.
    pub fn texel_bytes(self) -> usize {
        self.texel
    }

    /// The channel's samples of a block whose rows are of `width` texels, as 32 bits each, of the block's bytes; all native-endian.
    pub fn of_block(self, block: Vec<u8>, width: usize) -> Vec<u8> {
        if self.texel == 4 && !self.half {
            return block;
        }
        let bytes = if self.half { 2 } else { 4 };
        let row = |row: &[u8]| -> Vec<u8> {
            let samples = &row[width * self.before..width * (self.before + bytes)];
            if !self.half {
                return samples.to_vec();
            }
            let wide = |half: &[u8; 2]| f32::from(f16::from_ne_bytes(*half)).to_ne_bytes();
            samples.as_chunks::<2>().0.iter().flat_map(wide).collect()
        };
        block.chunks_exact(width * self.texel).flat_map(row).collect()
    }
}

/// Which of a header's channels holds the depths, flat or deep: the one called `wanted`, or else `Z`, or the only one whose name ends in `.Z`.
pub(crate) fn place(header: &Header, wanted: Option<&str>) -> Option<usize> {
    let named = |fits: &dyn Fn(&str) -> bool| {
        let channels = header.channels.list.iter().enumerate();
        let mut fitting = channels.filter(|(_, channel)| fits(&channel.name.to_string()));
        fitting.next().filter(|_| fitting.next().is_none()).map(|(index, _)| index)
    };
    let layered = |name: &str| name.rsplit_once('.').is_some_and(|(_, last)| last == "Z");
    match wanted {
        Some(wanted) => named(&|name| name == wanted),
        None => named(&|name| name == "Z").or_else(|| named(&layered)),
    }
}
