//! `umbrage info`.

use crate::args::{Cli, InfoArgs};
use crate::maps;
use crate::shell::Shell;
use anyhow::{Context, bail};
use glam::UVec2;
use serde_json::{Value, json};
use umbrage_depth::{DepthMap, Map, Storage};
use umbrage_io::{NamedMap, depth_view, write_png_grey};
use umbrage_plane::{Projection, TexelRect, View};

/// Most pixels of a picture of maps.
const MOST_PIXELS: u64 = 1 << 28;

pub fn run(cli: &Cli, args: &InfoArgs, shell: &mut Shell<'_>) -> anyhow::Result<()> {
    let maps = maps::read(&args.maps, cli.max_memory, shell)?;
    let file = args.maps.map.display().to_string();
    if cli.json {
        let mut facts = match maps.as_slice() {
            [one] => Facts::of(one).json(),
            several => json!({ "parts": several.iter().map(|named| Facts::of(named).json()).collect::<Vec<_>>() }),
        };
        facts["file"] = json!(file);
        writeln!(shell.out, "{facts}")?;
    } else {
        for (index, named) in maps.iter().enumerate() {
            if index > 0 {
                writeln!(shell.out)?;
            }
            Facts::of(named).print(shell)?;
        }
    }
    if let Some(path) = &args.picture {
        let (size, grey) = side_by_side(&maps).with_context(|| file.clone())?;
        write_png_grey(path, size, &grey)?;
    }
    Ok(())
}

/// What is reported of a map.
struct Facts<'a> {
    name: &'a str,
    view: View,
    keeps: String,
    projection: String,
    /// How many texels have a surface; the nearest and the farthest of them.
    filled: usize,
    range: [f32; 2],
    /// Bytes by storage.
    bytes: Vec<(&'static str, usize)>,
    light_cone: Option<f64>,
}

impl<'a> Facts<'a> {
    fn of(named: &'a NamedMap) -> Self {
        let NamedMap { name, map, light_cone } = named;
        let view = *map.view();
        let texels = TexelRect::of_size(view.size()).texels();
        let depths: Vec<f32> = texels.map(|texel| map.depth(texel)).filter(|depth| depth.is_finite()).collect();
        let (nearest, farthest) =
            depths.iter().fold((f32::INFINITY, f32::NEG_INFINITY), |(a, b), d| (a.min(*d), b.max(*d)));
        let keeps = match map {
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
                bytes.push((name, plain(map).kept(storage).allocated()));
            }
        }
        let (filled, range, light_cone) = (depths.len(), [nearest, farthest], *light_cone);
        Self { name, view, keeps, projection, filled, range, bytes, light_cone }
    }

    fn json(&self) -> Value {
        let Self { name, view, keeps, projection, filled, range: [nearest, farthest], bytes, light_cone } = self;
        let bytes: serde_json::Map<_, _> = bytes.iter().map(|(name, bytes)| ((*name).into(), json!(bytes))).collect();
        json!({
            "part": name, "size": view.size().to_array(), "keeps": keeps, "projection": projection,
            "light": view.light().to_array(), "ahead": view.ahead().to_array(), "near": view.near(), "far": view.far(),
            "texels_with_a_surface": filled, "nearest": nearest, "farthest": farthest, "bytes": bytes,
            "light_cone_cos": light_cone,
        })
    }

    fn print(&self, shell: &mut Shell<'_>) -> std::io::Result<()> {
        let Self { name, view, keeps, projection, filled, range: [nearest, farthest], bytes, light_cone } = self;
        let place = if view.is_perspective() { "at" } else { "toward" };
        let (size, eye, ahead) = (view.size(), view.light().truncate(), view.ahead());
        writeln!(shell.out, "part      {name}")?;
        writeln!(shell.out, "size      {} x {} texels", size.x, size.y)?;
        writeln!(shell.out, "keeps     {keeps}")?;
        writeln!(shell.out, "view      {projection}, from {} to {}", view.near(), view.far())?;
        writeln!(shell.out, "light     {place} {} {} {}", eye.x, eye.y, eye.z)?;
        writeln!(shell.out, "looking   {} {} {}", ahead.x, ahead.y, ahead.z)?;
        if let Some(cosine) = light_cone {
            writeln!(shell.out, "cone      {:.4} degrees, of the light as a whole", 2.0 * cosine.acos().to_degrees())?;
        }
        match filled {
            0 => writeln!(shell.out, "depths    none: the map is empty")?,
            count => writeln!(shell.out, "depths    {nearest} to {farthest}, in {count} texels")?,
        }
        for (name, bytes) in bytes {
            writeln!(shell.out, "bytes     {bytes} ({name})")?;
        }
        Ok(())
    }
}

/// The depths of maps in grey, from left to right, white below those that are lower than others.
fn side_by_side(maps: &[NamedMap]) -> anyhow::Result<(UVec2, Vec<f32>)> {
    let sizes = maps.iter().map(|named| named.map.view().size());
    let size = sizes.fold(UVec2::ZERO, |all, size| UVec2::new(all.x.saturating_add(size.x), all.y.max(size.y)));
    if u64::from(size.x) * u64::from(size.y) > MOST_PIXELS {
        bail!("--picture: {} x {} are more than {MOST_PIXELS} pixels; --part NAME draws one part", size.x, size.y);
    }
    let mut grey = vec![1.0; size.x as usize * size.y as usize];
    let mut left = 0;
    for NamedMap { map, .. } in maps {
        let width = map.view().size().x as usize;
        for (own, all) in depth_view(map).chunks_exact(width).zip(grey.chunks_exact_mut(size.x as usize)) {
            all[left..left + width].copy_from_slice(own);
        }
        left += width;
    }
    Ok((size, grey))
}

/// One depth for each texel of a map of facets; another map as it is.
fn plain(map: &Map) -> Map {
    match map {
        Map::Facets(map) => umbrage_depth::Raw::copy_of(map).into(),
        map => map.clone(),
    }
}
