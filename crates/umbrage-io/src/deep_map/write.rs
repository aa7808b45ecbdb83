use super::content::{COLOUR, EPSILON, GREY, is_grey, numbers};
use super::opacity::Opacities;
use super::packing::{PACKING, pack};
use crate::error::Fault;
use crate::shadow_map::{attributes, channel, comments, display, stored_window};
use exr::meta::attribute::{self, BlockType};
use exr::meta::header::{Header, standard_names};
use exr::meta::{BlockDescription, Requirements, magic_number, sequence_end};
use exr::prelude::{AttributeValue, LineOrder, Text, Vec2};
use glam::IVec2;
use umbrage_depth::{DeepMap, DepthMap, Step, Stored};
use umbrage_plane::TexelRect;

pub(super) fn encode(map: &DeepMap) -> Result<Vec<u8>, Fault> {
    let window = stored_window(map);
    let mut bytes = Vec::new();
    let names: &[&str] = if is_grey(map) { &GREY } else { &COLOUR };
    let size = map.view().size();
    let failed = |error| Fault::new("deep map", format!("{} x {}", size.x, size.y), error);
    write_header(map, window, names, &mut bytes).map_err(|error| failed(error.to_string()))?;
    let rows = window.size().y as usize;
    let table = bytes.len();
    bytes.resize(table + 8 * rows, 0);
    for (index, y) in (window.min.y..window.max.y).enumerate() {
        let offset = bytes.len() as u64;
        bytes[table + 8 * index..][..8].copy_from_slice(&offset.to_le_bytes());
        let texels = TexelRect::new(IVec2::new(window.min.x, y), IVec2::new(window.max.x, y + 1));
        write_row(map, texels, names, &mut bytes).map_err(failed)?;
    }
    Ok(bytes)
}

/// The library writes headers of flat images only; the parts of one are the same.
fn write_header(map: &DeepMap, window: TexelRect, names: &[&str], bytes: &mut Vec<u8>) -> exr::error::UnitResult {
    let (view, sides) = (map.view(), window.size());
    let comments = comments(view, Stored::First, window, numbers(map));
    let channels = names.iter().map(|name| channel(name)).collect();
    let mut header = Header::new(Text::from("shadow"), Vec2(sides.x as usize, sides.y as usize), channels)
        .with_encoding(PACKING, BlockDescription::ScanLines, LineOrder::Increasing)
        .with_attributes(attributes(view, window, &comments))
        .with_display_window(display(view));
    header.deep_data_version = Some(1);
    let most = TexelRect::of_size(view.size()).texels().map(|texel| map.steps(texel).len()).max();
    header.max_samples_per_pixel = most;
    magic_number::write(bytes)?;
    let flags = Requirements {
        file_format_version: 2,
        is_single_layer_and_tiled: false,
        has_long_names: false,
        has_deep_data: true,
        has_multiple_layers: false,
    };
    flags.write(bytes)?;
    for (name, value) in header.all_named_attributes() {
        let deep = AttributeValue::BlockType(BlockType::DeepScanLine);
        let value = if name == standard_names::BLOCK_TYPE { deep } else { value };
        attribute::write(name, &value, bytes)?;
    }
    attribute::write(EPSILON.as_bytes(), &AttributeValue::F32(map.epsilon()), bytes)?;
    sequence_end::write(bytes)
}

/// A row's number, the three lengths, the packed table of how many samples there are up to and with each texel, and the packed samples,
/// channel after channel.
fn write_row(map: &DeepMap, texels: TexelRect, names: &[&str], bytes: &mut Vec<u8>) -> Result<(), String> {
    let mut table = Vec::new();
    let mut samples: Vec<(Step, [f32; 4])> = Vec::new();
    for texel in texels.texels() {
        let mut opacities = Opacities::start();
        samples.extend(map.steps(texel).iter().map(|step| (*step, opacities.next(step))));
        let count =
            i32::try_from(samples.len()).map_err(|_| "more samples in a row than can be counted".to_string())?;
        table.extend(count.to_le_bytes());
    }
    let values = names.iter().flat_map(|name| samples.iter().map(|(step, opacities)| value(name, step, *opacities)));
    let unpacked: Vec<u8> = values.flat_map(f32::to_le_bytes).collect();
    let length = unpacked.len() as u64;
    let (table, samples) = (pack(table)?, pack(unpacked)?);
    bytes.extend(texels.min.y.to_le_bytes());
    for length in [table.len() as u64, samples.len() as u64, length] {
        bytes.extend(length.to_le_bytes());
    }
    bytes.extend(table);
    bytes.extend(samples);
    Ok(())
}

/// What a sample has in a channel of [`GREY`] or [`COLOUR`].
fn value(channel: &str, step: &Step, [mean, red, green, blue]: [f32; 4]) -> f32 {
    match channel {
        "A" => mean,
        "AR" => red,
        "AG" => green,
        "AB" => blue,
        "Z" => step.depth,
        "passes.G" => step.passes.y,
        "passes.B" => step.passes.z,
        _ => step.passes.x,
    }
}
