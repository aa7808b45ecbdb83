//! `umbrage info`.

use crate::args::{Cli, InfoArgs};
use crate::memory::Need;
use crate::shell::Shell;
use anyhow::Context;
use serde_json::json;
use std::path::Path;
use umbrage_depth::{DepthMap, Map, Storage};
use umbrage_io::{depth_view, file_bytes, read_map, write_png_grey};
use umbrage_plane::{Projection, TexelRect};

/// Reads a map, if its file and its texels are as many as may be read.
///
/// # Errors
/// One line with the file.
pub fn read(path: &Path, max_memory: Option<u64>) -> anyhow::Result<Map> {
    let need = Need { file_bytes: file_bytes(path)?, ..Need::default() };
    need.check(max_memory).with_context(|| path.display().to_string())?;
    Ok(read_map(path, need.texels_left(max_memory))?)
}

pub fn run(cli: &Cli, args: &InfoArgs, shell: &mut Shell<'_>) -> anyhow::Result<()> {
    let map = read(&args.map, cli.max_memory)?;
    let view = *map.view();
    let size = view.size();
    let depths = || TexelRect::of_size(size).texels().map(|texel| map.depth(texel)).filter(|depth| depth.is_finite());
    let (nearest, farthest) = depths().fold((f32::INFINITY, f32::NEG_INFINITY), |(a, b), d| (a.min(d), b.max(d)));
    let kept = match &map {
        Map::Facets(map) => format!("facets, {} texels refined", map.refined()),
        Map::Deep(map) => format!("all surfaces, to {} of what passes", map.epsilon()),
        _ => format!("{} surface", map.stored().name()),
    };
    let projection = match view.projection() {
        Projection::Perspective { k, .. } => {
            format!("perspective, {:.4} degrees high", 2.0 * (1.0 / k.y).atan().to_degrees())
        }
        Projection::Orthographic { half, .. } => format!("orthographic, {} units high", 2.0 * half.y),
    };
    let mut bytes = vec![("this", map.allocated())];
    if !matches!(map, Map::Deep(_)) {
        for (name, storage) in [("raw", Storage::Raw), ("bbox", Storage::Bbox), ("tiled", Storage::Tiled)] {
            bytes.push((name, plain(&map).kept(storage).allocated()));
        }
    }
    let (eye, ahead) = (view.light(), view.ahead());
    if cli.json {
        let bytes: serde_json::Map<_, _> = bytes.iter().map(|(name, bytes)| ((*name).into(), json!(bytes))).collect();
        let facts = json!({
            "file": args.map.display().to_string(), "size": [size.x, size.y], "keeps": kept, "projection": projection,
            "light": eye.to_array(), "ahead": ahead.to_array(), "near": view.near(), "far": view.far(),
            "texels_with_a_surface": depths().count(), "nearest": nearest, "farthest": farthest, "bytes": bytes,
        });
        writeln!(shell.out, "{facts}")?;
    } else {
        let place = if view.is_perspective() { "at" } else { "toward" };
        let eye = eye.truncate();
        writeln!(shell.out, "size      {} x {} texels", size.x, size.y)?;
        writeln!(shell.out, "keeps     {kept}")?;
        writeln!(shell.out, "view      {projection}, from {} to {}", view.near(), view.far())?;
        writeln!(shell.out, "light     {place} {} {} {}", eye.x, eye.y, eye.z)?;
        writeln!(shell.out, "looking   {} {} {}", ahead.x, ahead.y, ahead.z)?;
        match depths().count() {
            0 => writeln!(shell.out, "depths    none: the map is empty")?,
            count => writeln!(shell.out, "depths    {nearest} to {farthest}, in {count} texels")?,
        }
        for (name, bytes) in bytes {
            writeln!(shell.out, "bytes     {bytes} ({name})")?;
        }
    }
    if let Some(path) = &args.picture {
        write_png_grey(path, size, &depth_view(&map))?;
    }
    Ok(())
}

/// One depth for each texel of a map of facets; another map as it is.
fn plain(map: &Map) -> Map {
    match map {
        Map::Facets(map) => umbrage_depth::Raw::copy_of(map).into(),
        map => map.clone(),
    }
}
