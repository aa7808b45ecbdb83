use crate::error::Fault;
use crate::shadow_map::place;
use exr::meta::header::Header;
use exr::prelude::{SampleType, f16};

/// Where a channel's samples are in a row, in bytes of one sample of all channels before it, and what they are.
#[derive(Clone, Debug)]
pub(super) struct Column {
    name: String,
    start: usize,
    half: bool,
}

/// What a sample lets through.
#[derive(Debug)]
pub(super) enum Light {
    /// Files of ours: all that passes behind the surface, in red, green and blue. Beside it the opacities, to the mean of the channels,
    /// red, green and blue, as far as they are there.
    Passes([Column; 3], [Option<Column>; 4]),
    /// The opacity of the surface alone, to red, green and blue.
    Opacity([Column; 3]),
}

/// The channels that matter; others are passed over.
#[derive(Debug)]
pub(super) struct Columns {
    pub(super) depth: Column,
    /// The depth at which a sample ends, where it is not a surface.
    pub(super) back: Option<Column>,
    pub(super) light: Light,
    /// Bytes of one sample of all channels.
    pub(super) stride: usize,
}

impl Columns {
    /// Those of a header; `wanted` is what the channel of depths is called, in whose layer the others stand.
    pub(super) fn of(header: &Header, wanted: Option<&str>) -> Result<Self, Fault> {
        let channels = &header.channels.list;
        let depth = place(header, wanted).map(|index| channels[index].name.to_string());
        let layer = depth.as_deref().and_then(|name| name.rsplit_once('.')).map(|(layer, _)| format!("{layer}."));
        let layer = layer.unwrap_or_default();
        let column = |name: &str| {
            let at = channels.iter().position(|channel| channel.name.as_slice() == name.as_bytes())?;
            let start = channels[..at].iter().map(|channel| channel.sample_type.bytes_per_sample()).sum();
            let kind = channels[at].sample_type;
            let column = Column { name: name.into(), start, half: kind == SampleType::F16 };
            let whole = || Fault::new(format!("channel {name}"), "of whole numbers", "not of floats");
            Some(if kind == SampleType::U32 { Err(whole()) } else { Ok(column) })
        };
        let column = |name: &str| column(name).transpose();
        let find = |name: &str| column(&format!("{layer}{name}"));
        let all = |names: [&str; 3]| {
            let [a, b, c] = names.map(find);
            Ok::<_, Fault>(a?.zip(b?).zip(c?).map(|((a, b), c)| [a, b, c]))
        };
        let listed = || channels.iter().map(|channel| channel.name.to_string()).collect::<Vec<_>>().join(", ");
        let missing = |problem: &str| Fault::new("channels", listed(), problem);
        let no_depth = || missing(&format!("no {}, the depth of a sample", wanted.unwrap_or("Z")));
        let depth = depth.as_deref().map(column).transpose()?.flatten().ok_or_else(no_depth)?;
        let back = find("ZBack")?;
        if let Some(half) = std::iter::once(&depth).chain(&back).find(|column| column.half) {
            return Err(Fault::new(format!("channel {}", half.name), "F16", "not 32-bit float"));
        }
        let grey = |name: &str| Ok::<_, Fault>(find(name)?.map(|column| [(); 3].map(|()| column.clone())));
        let passes = all(["passes.R", "passes.G", "passes.B"])?.or(grey("passes.Y")?);
        let light = if let Some(passes) = passes {
            if back.is_some() {
                return Err(Fault::new(
                    "channels",
                    listed(),
                    "ZBack does not go with those named passes, which are of surfaces",
                ));
            }
            let [mean, red, green, blue] = ["A", "AR", "AG", "AB"].map(find);
            Light::Passes(passes, [mean?, red?, green?, blue?])
        } else {
            let opacity = all(["AR", "AG", "AB"])?.or(grey("A")?);
            Light::Opacity(opacity.ok_or_else(|| missing("neither A nor AR, AG, AB, the opacity of a sample"))?)
        };
        let stride = channels.iter().map(|channel| channel.sample_type.bytes_per_sample()).sum();
        Ok(Self { depth, back, light, stride })
    }
}

impl Column {
    /// As the file calls it.
    pub(super) fn name(&self) -> &str {
        &self.name
    }

    /// True when a sample read from here may have been written as `value`; halves are other makers' and not checked.
    pub(super) fn holds(&self, sample: f32, value: f32) -> bool {
        self.half || sample == value
    }

    /// The value of one of a row's `count` samples; NaN where there are no such bytes.
    pub(super) fn value(&self, row: &[u8], count: usize, sample: usize) -> f32 {
        let rest = row.get(self.start * count..).unwrap_or_default();
        let half = |rest: &[u8]| rest.as_chunks::<2>().0.get(sample).map(|bytes| f16::from_le_bytes(*bytes).to_f32());
        let float = |rest: &[u8]| rest.as_chunks::<4>().0.get(sample).map(|bytes| f32::from_le_bytes(*bytes));
        if self.half { half(rest) } else { float(rest) }.unwrap_or(f32::NAN)
    }
}
