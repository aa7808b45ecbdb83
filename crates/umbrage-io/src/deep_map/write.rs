use super::content::{COLOUR, EPSILON, GREY, is_grey, numbers};
use super::opacity::Opacities;
use super::packing::{PACKING, pack};
use crate::error::Fault;
use crate::shadow_map::{About, Part, comments, stored_window};
use exr::meta::BlockDescription;
use exr::prelude::{AttributeValue, LineOrder};
use glam::IVec2;
use umbrage_depth::{DeepMap, DepthMap, Step};
use umbrage_plane::TexelRect;

/// A map's part.
pub(crate) fn deep_part<'a>(map: &'a DeepMap, about: About<'a>) -> Result<Part<'a>, Fault> {
    let window = stored_window(map);
    let names: &[&str] = if is_grey(map) { &GREY } else { &COLOUR };
    let comments = comments(about.head(map), window, numbers(map));
    let mut header = about.header(map.view(), &comments, window, names)?.with_encoding(
        PACKING,
        BlockDescription::ScanLines,
        LineOrder::Increasing,
    );
    header.deep_data_version = Some(1);
    header.max_samples_per_pixel =
        TexelRect::of_size(map.view().size()).texels().map(|texel| map.steps(texel).len()).max();
    let block = move |index: usize| {
        let y = window.min.y + index as i32;
        row(map, TexelRect::new(IVec2::new(window.min.x, y), IVec2::new(window.max.x, y + 1)), names)
    };
    let further = Some((EPSILON, AttributeValue::F32(map.epsilon())));
    Ok(Part { header, further, deep: true, block: Box::new(block) })
}

/// A row's number, the three lengths, the packed table of how many samples there are up to and with each texel, and the packed samples,
/// channel after channel.
fn row(map: &DeepMap, texels: TexelRect, names: &[&str]) -> Result<Vec<u8>, String> {
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
    let mut bytes = texels.min.y.to_le_bytes().to_vec();
    for length in [table.len() as u64, samples.len() as u64, length] {
        bytes.extend(length.to_le_bytes());
    }
    bytes.extend(table);
    bytes.extend(samples);
    Ok(bytes)
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
