use super::columns::{Column, Columns, Light};
use super::content::{EPSILON, numbers};
use super::opacity::Opacities;
use super::packing::unpack;
use super::volumes::{VOLUME_BOUND, Volume, in_order};
use crate::error::Fault;
use crate::map_options::MapOptions;
use crate::shadow_map::{Channel, Nearest, Parts, Preface, check_digest, digest};
use exr::meta::BlockDescription;
use exr::meta::header::Header;
use exr::prelude::{AttributeValue, Compression, Text, Vec2};
use glam::Vec3;
use umbrage_depth::{DeepMap, Step};

/// Bytes before a row's packed table: its number and three lengths.
const ROW_HEAD: usize = 28;

/// Depths from here on mean that no surface was seen.
const NO_SURFACE: f32 = 1e30;

/// The map of a part, and the cone of the light around which it is one of several.
pub(crate) fn deep(
    parts: &Parts,
    part: usize,
    bytes: &[u8],
    options: &MapOptions,
) -> Result<(DeepMap, Option<f64>), Fault> {
    let header = parts.header(part);
    check_form(header)?;
    let columns = Columns::of(header, options.channel.as_deref())?;
    let file = Preface::new(parts, part, Channel::ONLY, options.view.as_ref(), options.most_texels)?;
    let epsilon = match header.own_attributes.other.get(&Text::from(EPSILON)) {
        Some(AttributeValue::F32(epsilon)) => *epsilon,
        Some(other) => return Err(Fault::new(EPSILON, format!("{other:?}"), "expected a 32-bit number")),
        None => 0.0,
    };
    let size = file.view.size().as_ivec2();
    let window = file.layout.window();
    let (mut left, mut broken, mut worst) = (options.most_texels, None, epsilon);
    let rows = (0..size.y).map_while(|y| {
        let mut row: Vec<Vec<Step>> = vec![Vec::new(); size.x as usize];
        if (window.min.y..window.max.y).contains(&y) {
            let texels = &mut row[window.min.x as usize..window.max.x as usize];
            let index = (y - window.min.y) as usize;
            match read_row(&file, &columns, bytes, index, &mut left, texels) {
                // A bound that is none stays, and is refused.
                Ok(bound) => worst = if (0.0..bound).contains(&worst) { bound } else { worst },
                Err(fault) => broken = Some(fault),
            }
        }
        broken.is_none().then_some(row)
    });
    // What rows leave is known when the last of them is read.
    let texels: Vec<Vec<Step>> = rows.flatten().collect();
    if let Some(fault) = broken {
        return Err(fault);
    }
    let map = DeepMap::new(file.view, worst, texels);
    let map = map.map_err(|error| Fault::new("samples", "no map", error))?;
    check_digest(file.digest, digest(file.head(), numbers(&map).map(f32::to_bits)))?;
    Ok((map, file.light_cone))
}

/// One part of deep scan lines, stored without loss.
fn check_form(header: &Header) -> Result<(), Fault> {
    if !header.deep {
        return Err(Fault::new("type", "flat", "a deep map has several depths per texel"));
    }
    if header.blocks != BlockDescription::ScanLines {
        return Err(Fault::new("type", "deeptile", "deep maps are read from deepscanline only"));
    }
    if header.deep_data_version != Some(1) {
        return Err(Fault::new("version", format!("{:?}", header.deep_data_version), "deep data are of version 1"));
    }
    if let Some(channel) = header.channels.list.iter().find(|channel| channel.sampling != Vec2(1, 1)) {
        let field = format!("channel {} sampling", channel.name);
        return Err(Fault::new(field, format!("{:?}", channel.sampling), "not 1, 1"));
    }
    match header.compression {
        Compression::Uncompressed | Compression::RLE | Compression::ZIP1 => Ok(()),
        other => Err(Fault::new("compression", other, "deep data are packed by none, RLE or ZIPS")),
    }
}

/// Fills the texels of a row, of at most `left` steps together, which is lessened by as many. How far they may be off.
fn read_row(
    file: &Preface<'_>,
    columns: &Columns,
    bytes: &[u8],
    index: usize,
    left: &mut u64,
    texels: &mut [Vec<Step>],
) -> Result<f32, Fault> {
    let offset = file.offsets()[index];
    let broken =
        |value: &dyn ToString, problem: &str| Fault::new(file.layout.name(index, offset), value.to_string(), problem);
    let block = bytes.get(offset as usize..).unwrap_or_default();
    let block = file.layout.unmarked(block, index, offset)?;
    let (head, rest) = block.split_first_chunk::<ROW_HEAD>().ok_or_else(|| broken(&"cut off", "row and lengths"))?;
    let row = i32::from_le_bytes([head[0], head[1], head[2], head[3]]);
    if row != file.layout.row(index) {
        return Err(broken(&row, &format!("the row there should be {}", file.layout.row(index))));
    }
    let [packed_table, packed_samples, length] = [4, 12, 20].map(|at| {
        let word = head[at..].first_chunk::<8>().copied().unwrap_or_default();
        usize::try_from(u64::from_le_bytes(word)).unwrap_or(usize::MAX)
    });
    let no_place = |length: &usize| broken(length, "not a length within the file");
    let (table, rest) = rest.split_at_checked(packed_table).ok_or_else(|| no_place(&packed_table))?;
    let samples = rest.get(..packed_samples).ok_or_else(|| no_place(&packed_samples))?;
    let packing = file.parts.header(file.part).compression;
    let table = unpack(packing, table, texels.len() * 4).map_err(|problem| broken(&packed_table, &problem))?;
    let ends = ends(&table).ok_or_else(|| broken(&"a table", "numbers of samples that fall"))?;
    let count = ends.last().copied().unwrap_or(0);
    let too_many = |count: usize| broken(&count, "more samples than are allowed in all");
    *left = left.checked_sub(count as u64).ok_or_else(|| too_many(count))?;
    let expected = count.checked_mul(columns.stride).filter(|expected| *expected == length);
    let expected = expected.ok_or_else(|| broken(&length, &format!("{count} samples need another length")))?;
    let samples = unpack(packing, samples, expected).map_err(|problem| broken(&packed_samples, &problem))?;
    let (mut start, mut bound) = (0, 0.0);
    let nearest = Nearest::of(&file.view, file.digest);
    for (texel, end) in texels.iter_mut().zip(ends) {
        let (steps, is_bounded) =
            steps(columns, nearest, &samples, count, start..end).map_err(|(column, value, problem)| {
                Fault::new(format!("{}: channel {}", file.layout.name(index, offset), column.name()), value, problem)
            })?;
        // A volume has more steps than samples.
        *left =
            left.checked_sub(steps.len().saturating_sub(end - start) as u64).ok_or_else(|| too_many(steps.len()))?;
        bound = if is_bounded { VOLUME_BOUND } else { bound };
        (*texel, start) = (steps, end);
    }
    Ok(bound)
}

/// Behind each texel's last sample; never falling.
fn ends(table: &[u8]) -> Option<Vec<usize>> {
    let ends = table.as_chunks::<4>().0.iter().map(|end| usize::try_from(i32::from_le_bytes(*end)).ok());
    let ends: Vec<usize> = ends.collect::<Option<_>>()?;
    ends.is_sorted().then_some(ends)
}

type Wrong<'a> = (&'a Column, f32, String);

/// How far a sum of roundings may take an opacity past 0 or 1.
const OPACITY_ROUNDING: f32 = 1e-5;

/// A texel's steps from its samples, and whether they only come near to what a volume lets through; or a channel's value that will not do.
fn steps<'a>(
    columns: &'a Columns,
    nearest: Nearest,
    row: &[u8],
    count: usize,
    samples: std::ops::Range<usize>,
) -> Result<(Vec<Step>, bool), Wrong<'a>> {
    let depth = |sample: usize| columns.depth.value(row, count, sample);
    match &columns.light {
        Light::Passes(passes, opacities) => {
            let mut expected = Opacities::start();
            let step = |sample: usize| {
                let passes = Vec3::from_array(passes.each_ref().map(|column| column.value(row, count, sample)));
                let step = Step { depth: depth(sample), passes };
                let written = opacities.iter().zip(expected.next(&step));
                for (column, opacity) in written.filter_map(|(column, opacity)| Some((column.as_ref()?, opacity))) {
                    let found = column.value(row, count, sample);
                    if !column.holds(found, opacity) {
                        return Err((column, found, "not what belongs to the channels named passes".into()));
                    }
                }
                Ok(step)
            };
            samples.map(step).collect::<Result<_, _>>().map(|steps| (steps, false))
        }
        Light::Opacity(opacities) => {
            let mut volumes = Vec::new();
            for sample in samples {
                let opacity = opacities.each_ref().map(|column| column.value(row, count, sample));
                let possible = -OPACITY_ROUNDING..=1.0 + OPACITY_ROUNDING;
                if let Some(at) = opacity.iter().position(|opacity| !possible.contains(opacity)) {
                    return Err((&opacities[at], opacity[at], "not an opacity within 0..=1".into()));
                }
                let depth = depth(sample);
                if depth.is_nan() {
                    return Err((&columns.depth, depth, "not a depth".into()));
                }
                if nearest.refuses(depth) {
                    return Err((&columns.depth, depth, nearest.to_string()));
                }
                if depth >= NO_SURFACE {
                    continue;
                }
                let mut back = depth;
                if let Some(column) = &columns.back {
                    back = column.value(row, count, sample);
                    if !(depth..NO_SURFACE).contains(&back) {
                        return Err((column, back, format!("a sample from {depth} on cannot end there")));
                    }
                }
                let passes = Vec3::from_array(opacity.map(|opacity| 1.0 - opacity.clamp(0.0, 1.0)));
                volumes.push(Volume { front: depth, back, passes });
            }
            Ok(in_order(volumes))
        }
    }
}
