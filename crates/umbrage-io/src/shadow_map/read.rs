use super::channel::Channel;
use super::layout::check_packing;
use super::parts::Parts;
use super::{Layout, Nearest, matrices, text};
use crate::error::Fault;
use crate::map_options::GivenView;
use exr::meta::header::{Header, LayerAttributes};
use exr::prelude::{AttributeValue, Text};
use glam::{IVec2, UVec2};
use umbrage_depth::Stored;
use umbrage_plane::{Kind, TexelRect, View};

/// A part that holds a map, checked, without its blocks.
#[derive(Debug)]
pub(crate) struct Preface<'a> {
    pub parts: &'a Parts,
    pub part: usize,
    pub view: View,
    /// Which surface the depths belong to; the nearest in files of other makers.
    pub stored: Stored,
    /// Cosine of half the angle of the light's cone, where the map is one of several that have none of their own.
    pub light_cone: Option<f64>,
    /// Of view and depths; files of other makers have none.
    pub digest: Option<u64>,
    pub layout: Layout,
    /// The rectangle outside of which no surface was seen, whatever the file holds there: tools that fill a cropped file up to its
    /// display window, as `maketx` does, put 0 or NaN there. The whole map where the file does not say.
    pub seen: TexelRect,
}

impl<'a> Preface<'a> {
    /// Of a part, whose depths are `channel`; another maker's stand as `given` says, where it does.
    pub fn new(
        parts: &'a Parts,
        part: usize,
        channel: Channel,
        given: Option<&GivenView>,
        most_texels: u64,
    ) -> Result<Self, Fault> {
        let header = parts.header(part);
        let display = display(header)?;
        let text::Description { view, stored, light_cone, window: seen, digest } = described(header, display, given)?;
        // All parts of a file share the display window: smaller maps are in its upper left.
        let (size, shared) = (view.size(), parts.count() > 1);
        if size != display && !(shared && size.cmple(display).all()) {
            let problem = format!("displayWindow is {} x {}", display.x, display.y);
            return Err(Fault::new("comments: size", format!("{} x {}", size.x, size.y), problem));
        }
        if u64::from(size.x) * u64::from(size.y) > most_texels {
            let shown = format!("{} x {}", size.x, size.y);
            return Err(Fault::new("displayWindow", shown, format!("more than the allowed {most_texels} texels")));
        }
        let layout = Layout::new(header, parts.mark(part), window(header, size)?, channel)?;
        Ok(Self { parts, part, view, stored, light_cone, digest, layout, seen })
    }

    pub fn offsets(&self) -> &[u64] {
        self.parts.offsets(self.part)
    }

    pub fn head(&self) -> text::Head<'_> {
        text::Head { view: &self.view, stored: self.stored, light_cone: self.light_cone }
    }
}

/// The part of a flat map.
pub(crate) fn flat<'a>(
    parts: &'a Parts,
    part: usize,
    channel: Option<&str>,
    given: Option<&GivenView>,
    most_texels: u64,
    notes: Option<&mut Vec<Fault>>,
) -> Result<Preface<'a>, Fault> {
    let header = parts.header(part);
    if header.deep {
        return Err(Fault::new("type", "deep", "a shadow map has one depth per texel"));
    }
    let channel = Channel::of_depths(header, channel)?;
    // Our own maps are never packed with a loss, and would not be what was written.
    check_packing(header, notes.filter(|_| !is_ours(header)))?;
    Preface::new(parts, part, channel, given, most_texels)
}

/// The depths of a file, whose bytes are these, row by row.
pub(crate) fn depths(file: &Preface<'_>, bytes: &[u8]) -> Result<Vec<f32>, Fault> {
    let size = file.view.size();
    let texels = size.x as usize * size.y as usize;
    let mut depths: Vec<f32> = Vec::new();
    depths.try_reserve_exact(texels).map_err(|full| Fault::new("displayWindow", texels, full))?;
    depths.resize(texels, f32::INFINITY);
    let nearest = Nearest::of(&file.view, file.digest);
    for (index, &offset) in file.offsets().iter().enumerate() {
        let samples = file.layout.samples(&file.parts.meta, &bytes[offset as usize..], index, offset)?;
        let area = file.layout.area(index);
        let samples = area.texels().zip(samples.as_chunks::<4>().0);
        for (texel, sample) in samples.filter(|(texel, _)| file.seen.contains(*texel)) {
            let depth = nearest
                .check(f32::from_ne_bytes(*sample), || format!("channel Z at texel {}, {}", texel.x, texel.y))?;
            depths[texel.y as usize * size.x as usize + texel.x as usize] = depth;
        }
    }
    check_digest(file.digest, text::digest(file.head(), depths.iter().map(|depth| depth.to_bits())))?;
    Ok(depths)
}

/// A file of ours holds what was written.
pub(crate) fn check_digest(written: Option<u64>, found: u64) -> Result<(), Fault> {
    match written {
        Some(written) if written != found => {
            let problem = format!("what the file holds makes {found:016x}, which is not what was written");
            Err(Fault::new("comments: digest", format!("{written:016x}"), problem))
        }
        _ => Ok(()),
    }
}

/// Sides of the display window.
fn display(header: &Header) -> Result<UVec2, Fault> {
    let size = header.shared_attributes.display_window.size;
    let side = |length: usize| u32::try_from(length).ok().filter(|side| (1..=32_768).contains(side));
    side(size.x()).zip(side(size.y())).map(UVec2::from).ok_or_else(|| {
        let shown = format!("{} x {}", size.x(), size.y());
        Fault::new("displayWindow", shown, "not within 1..=32768 on each side")
    })
}

/// The rectangle that is stored of a map of this size in the upper left of the display window.
fn window(header: &Header, size: UVec2) -> Result<TexelRect, Fault> {
    let (display, data) = (header.shared_attributes.display_window.position, header.data_window());
    let axis = |data_min: i32, data_size: usize, display_min: i32, map_size: u32| {
        let min = i64::from(data_min) - i64::from(display_min);
        let end = i64::try_from(data_size).ok()?.checked_add(min)?;
        (min >= 0 && end > min && end <= i64::from(map_size)).then_some((min as i32, end as i32))
    };
    let x = axis(data.position.x(), data.size.x(), display.x(), size.x);
    let y = axis(data.position.y(), data.size.y(), display.y(), size.y);
    let window = x.zip(y).map(|(x, y)| TexelRect::new(IVec2::new(x.0, y.0), IVec2::new(x.1, y.1)));
    window.ok_or_else(|| {
        let (at, sides) = (data.position, data.size);
        let value = format!("{} x {} at {}, {}", sides.x(), sides.y(), at.x(), at.y());
        Fault::new("dataWindow", value, "empty or not inside displayWindow")
    })
}

/// What our text says, or what was given, or what the attributes that every tool writes say.
fn described(header: &Header, size: UVec2, given: Option<&GivenView>) -> Result<text::Description, Fault> {
    let attributes = &header.own_attributes;
    if let Some(found) = attributes.comments.as_ref().and_then(|comments| text::to_view(&comments.to_string())) {
        if given.is_some() {
            return Err(Fault::new("view", "given", "a map that Umbrage wrote has its own"));
        }
        return found;
    }
    if is_ours(header) {
        return Err(Fault::new("comments", "no view", "the file is one of umbrage, which writes one"));
    }
    let view = match given {
        Some(given) => {
            let GivenView { world_to_camera, world_to_screen, near, far, depth } = given;
            matrices::to_view(world_to_camera, world_to_screen, [*near, *far], size)?.with_kind(*depth)
        }
        None => by_attributes(header, size)?.with_kind(Kind::Axial),
    };
    let window = TexelRect::of_size(size);
    Ok(text::Description { view, stored: Stored::First, light_cone: None, window, digest: None })
}

fn by_attributes(header: &Header, size: UVec2) -> Result<View, Fault> {
    let attributes = &header.own_attributes;
    let missing = |field: &str| Fault::new(field, "missing", "a shadow map needs it, or a view that is given");
    let other = |name: &str| match attributes.other.get(&Text::from(name)) {
        Some(AttributeValue::Matrix4x4(matrix)) => Some(*matrix),
        _ => None,
    };
    let camera = attributes.world_to_camera.or_else(|| other("worldtocamera")).or_else(|| other("Nl"));
    let screen = attributes.world_to_normalized_device.or_else(|| other("worldtoscreen")).or_else(|| other("NP"));
    matrices::to_view(
        &camera.ok_or_else(|| missing("worldToCamera"))?.map(f64::from),
        &screen.ok_or_else(|| missing("worldToNDC"))?.map(f64::from),
        [attributes.near_clip_plane, attributes.far_clip_plane].map(|plane| plane.map(f64::from)),
        size,
    )
}

/// Whether a header has any mark of our own files. Damage to one mark must not turn a file of ours into one of another maker, which has
/// no digest to check the depths by.
fn is_ours(header: &Header) -> bool {
    let LayerAttributes { comments, software_name, other, .. } = &header.own_attributes;
    let texts = [comments, software_name].into_iter().flatten().map(Text::as_slice);
    let others = other.values().filter_map(|value| match value {
        AttributeValue::Text(text) => Some(text.as_slice()),
        AttributeValue::Custom { bytes, .. } => Some(bytes.as_slice()),
        _ => None,
    });
    texts.chain(others).any(text::is_ours)
}
