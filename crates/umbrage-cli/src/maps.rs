//! Files of maps that a command reads.

use crate::args::MapArgs;
use crate::memory::Need;
use crate::shell::{Shell, Usage};
use anyhow::{Context, bail};
use serde_json::Value;
use std::path::Path;
use umbrage_io::{
    CUBE_FACES, FACES_AHEAD, GivenView, MapOptions, NamedMap, file_bytes, light_of, read_bytes, read_maps,
};
use umbrage_plane::Kind;

/// The longest text of a view that is read, bytes.
const MOST_VIEW_BYTES: u64 = 1 << 16;

/// Reads the wanted maps of a file, if the file is not too large.
///
/// # Errors
/// One line with the file.
pub fn read(args: &MapArgs, max_memory: Option<u64>, shell: &mut Shell<'_>) -> anyhow::Result<Vec<NamedMap>> {
    let (path, shown) = (&args.map, args.map.display().to_string());
    let view = args.view.as_deref().map(view).transpose()?;
    let file_bytes = file_bytes(path)?;
    let need = Need { file_bytes, ..Need::default() };
    need.check(max_memory).with_context(|| shown.clone())?;
    let options = MapOptions::default().with_part(args.part.clone()).with_channel(args.channel.clone()).with_view(view);
    let options = options.with_most_texels(need.texels_left(max_memory));
    let read = read_maps(path, &options)?;
    for note in read.notes {
        shell.note(&format!("note: {shown}: {note}"));
    }
    Ok(read.maps)
}

/// The maps of the only light among them, in the order of its views.
///
/// # Errors
/// One line that names the lights, or the maps that a light lacks.
pub fn of_one_light(mut maps: Vec<NamedMap>, path: &Path) -> anyhow::Result<Vec<NamedMap>> {
    let file = path.display();
    if maps.len() == 1 {
        return Ok(maps);
    }
    let mut lights: Vec<&str> = maps.iter().map(|named| light_of(&named.name)).collect();
    lights.dedup();
    if lights.len() > 1 {
        let lights = lights.join(", ");
        return Err(
            Usage(format!("{file}: there are maps of several lights, --part NAME chooses one: {lights}")).into()
        );
    }
    let light = lights.concat();
    let names = |faces: &[&str]| faces.iter().map(|face| format!("{light}.{face}")).collect::<Vec<_>>();
    let ahead = maps.iter().any(|named| names(&FACES_AHEAD).contains(&named.name));
    let wanted = if ahead { names(&FACES_AHEAD) } else { names(&CUBE_FACES) };
    let there = |name: &&String| maps.iter().any(|named| named.name == **name);
    if let Some(missing) = wanted.iter().find(|name| !there(name)) {
        bail!("{file}: part {missing} is missing: light {light} has {} maps", wanted.len());
    }
    if let Some(other) = maps.iter().find(|named| !wanted.contains(&named.name)) {
        bail!("{file}: part {} is none of the {} maps of light {light}", other.name, wanted.len());
    }
    maps.sort_by_key(|named| wanted.iter().position(|name| *name == named.name));
    Ok(maps)
}

/// A view as given on the command line: JSON, or the name of a file that holds it.
fn view(text: &str) -> anyhow::Result<GivenView> {
    if text.trim_start().starts_with('{') {
        return parsed(text).map_err(|problem| Usage(format!("--view: {problem}")).into());
    }
    let bytes = read_bytes(Path::new(text), MOST_VIEW_BYTES)?;
    let read = std::str::from_utf8(&bytes).map_err(|_| "not text".to_owned()).and_then(parsed);
    read.map_err(|problem| anyhow::anyhow!("{text}: {problem}"))
}

fn parsed(text: &str) -> Result<GivenView, String> {
    const FIELDS: [&str; 5] = ["worldtocamera", "worldtoscreen", "near", "far", "depth"];
    let value: Value = serde_json::from_str(text).map_err(|error| format!("not JSON: {error}"))?;
    let fields = value.as_object().ok_or_else(|| format!("expected an object of {}", FIELDS.join(", ")))?;
    if let Some(other) = fields.keys().find(|name| !FIELDS.contains(&name.as_str())) {
        return Err(format!("{other:?} is not known: expected {}", FIELDS.join(", ")));
    }
    let matrix = |name: &str| {
        let given = fields.get(name).and_then(Value::as_array).filter(|numbers| numbers.len() == 16);
        let numbers = given.and_then(|numbers| numbers.iter().map(Value::as_f64).collect::<Option<Vec<f64>>>());
        let matrix = numbers.and_then(|numbers| <[f64; 16]>::try_from(numbers).ok());
        matrix.ok_or_else(|| format!("{name}: expected an array of 16 numbers"))
    };
    let plane = |name: &str| match fields.get(name) {
        None => Ok(None),
        Some(value) => value.as_f64().map(Some).ok_or_else(|| format!("{name} is {value}: expected a number")),
    };
    let depth = match fields.get("depth").map(|depth| depth.as_str()) {
        None | Some(Some("axial")) => Kind::Axial,
        Some(Some("radial")) => Kind::Radial,
        Some(Some("screen")) => Kind::Screen,
        Some(_) => return Err(format!("depth is {}: expected axial, radial or screen", fields["depth"])),
    };
    Ok(GivenView {
        world_to_camera: matrix("worldtocamera")?,
        world_to_screen: matrix("worldtoscreen")?,
        near: plane("near")?,
        far: plane("far")?,
        depth,
    })
}
