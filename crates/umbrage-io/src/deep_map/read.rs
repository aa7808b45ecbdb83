use super::columns::{Column, Columns, Light};
use super::content::{EPSILON, numbers};
use super::opacity::Opacities;
use super::packing::unpack;
use crate::error::Fault;
use crate::shadow_map::{Channel, Nearest, Preface, check_digest, digest};
use exr::meta::BlockDescription;
use exr::meta::header::Header;
use exr::prelude::{AttributeValue, Compression, Text, Vec2};
use glam::Vec3;
use umbrage_depth::{DeepMap, DepthMap, Step, Stored};

/// Bytes before a row's packed table: its number and three lengths.
const ROW_HEAD: usize = 28;

/// Depths from here on mean that no surface was seen (C-5).
const NO_SURFACE: f32 = 1e30;

pub(super) fn decode(bytes: &[u8], most_steps: u64) -> Result<DeepMap, Fault> {
    let file = Preface::read_as(
        |header| check_form(header).map(|()| Channel::ONLY),
        bytes,
        bytes.len() as u64,
        most_steps,
        u64::MAX,
    )?;
    let header = &file.meta.headers[0];
    let columns = Columns::of(header)?;
    let epsilon = match header.own_attributes.other.get(&Text::from(EPSILON)) {
        Some(AttributeValue::F32(epsilon)) => *epsilon,
        Some(other) => return Err(Fault::new(EPSILON, format!("{other:?}"), "expected a 32-bit number")),
        None => 0.0,
    };
    let size = file.view.size().as_ivec2();
    let window = file.layout.window();
    let (mut left, mut broken) = (most_steps, None);
    let rows = (0..size.y).map_while(|y| {
        let mut row: Vec<Vec<Step>> = vec![Vec::new(); size.x as usize];
        if (window.min.y..window.max.y).contains(&y) {
            let texels = &mut row[window.min.x as usize..window.max.x as usize];
            let index = (y - window.min.y) as usize;
            let filled = read_row(&file, &columns, bytes, index, &mut left, texels);
            broken = filled.err();
        }
        broken.is_none().then_some(row)
    });
    let map = DeepMap::new(file.view, epsilon, rows.flatten());
    if let Some(fault) = broken {
        return Err(fault);
    }
    let map = map.map_err(|error| Fault::new("samples", "no map", error))?;
    check_digest(file.digest, digest(map.view(), Stored::First, numbers(&map).map(f32::to_bits)))?;
    Ok(map)
}

/// One part of deep scan lines, stored without loss.
fn check_form(header: &Header) -> Result<(), Fault> {
    if !header.deep {
        return Err(Fault::new("type", "flat", "a deep map has several depths a texel"));
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

/// Fills the texels of a row, of at most `left` steps together, which is lessened by as many.
fn read_row(
    file: &Preface,
    columns: &Columns,
    bytes: &[u8],
    index: usize,
    left: &mut u64,
    texels: &mut [Vec<Step>],
) -> Result<(), Fault> {
    let offset = file.offsets[index];
    let broken =
        |value: &dyn ToString, problem: &str| Fault::new(file.layout.name(index, offset), value.to_string(), problem);
    let block = bytes.get(offset as usize..).unwrap_or_default();
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
    let packing = file.meta.headers[0].compression;
    let table = unpack(packing, table, texels.len() * 4).map_err(|problem| broken(&packed_table, &problem))?;
    let ends = ends(&table).ok_or_else(|| broken(&"a table", "numbers of samples that fall"))?;
    let count = ends.last().copied().unwrap_or(0);
    *left = left.checked_sub(count as u64).ok_or_else(|| broken(&count, "more samples than are allowed in all"))?;
    let expected = count.checked_mul(columns.stride).filter(|expected| *expected == length);
    let expected = expected.ok_or_else(|| broken(&length, &format!("{count} samples need another length")))?;
    let samples = unpack(packing, samples, expected).map_err(|problem| broken(&packed_samples, &problem))?;
    let mut start = 0;
    let nearest = Nearest::of(&file.view, file.digest);
    for (texel, end) in texels.iter_mut().zip(ends) {
        *texel = steps(columns, nearest, &samples, count, start..end).map_err(|(column, value, problem)| {
            Fault::new(format!("{}: channel {}", file.layout.name(index, offset), column.name()), value, problem)
        })?;
        start = end;
    }
    Ok(())
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

/// A texel's steps from its samples, or a channel's value that will not do.
fn steps<'a>(
    columns: &'a Columns,
    nearest: Nearest,
    row: &[u8],
    count: usize,
    samples: std::ops::Range<usize>,
) -> Result<Vec<Step>, Wrong<'a>> {
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
            samples.map(step).collect()
        }
        Light::Opacity(opacities) => {
            let mut surfaces = Vec::new();
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
                if depth < NO_SURFACE {
                    surfaces.push((depth, Vec3::from_array(opacity.map(|opacity| opacity.clamp(0.0, 1.0)))));
                }
            }
            Ok(in_order(surfaces))
        }
    }
}

/// Surfaces in any order as steps; those at one depth are one.
fn in_order(mut surfaces: Vec<(f32, Vec3)>) -> Vec<Step> {
    surfaces.sort_by(|a, b| a.0.total_cmp(&b.0));
    let mut steps: Vec<Step> = Vec::with_capacity(surfaces.len());
    let mut passes = Vec3::ONE;
    for (depth, opacity) in surfaces {
        passes *= Vec3::ONE - opacity;
        match steps.last_mut() {
            Some(last) if last.depth == depth => last.passes = passes,
            _ => steps.push(Step { depth, passes }),
        }
    }
    steps
}
