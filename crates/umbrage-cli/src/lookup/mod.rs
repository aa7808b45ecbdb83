//! `umbrage lookup`.

mod line;

use crate::args::{Cli, LookupArgs};
use crate::shell::Shell;
use crate::{maps, stage};
use anyhow::{Context, bail};
use line::{is_header, point};
use std::io::{BufRead, Read};
use umbrage_depth::{DepthMap, Map, Storage, Stored};
use umbrage_io::NamedMap;
use umbrage_plane::{Rules, SurfacePoint};
use umbrage_recipe::{PresetName, Recipe};
use umbrage_sample::Key;
use umbrage_shadow::{Bounded, Shadow};

/// Points that are looked up together; their number changes no result.
const BATCH: usize = 4096;

/// Most bytes of a line: room for twelve numbers of any sensible length.
const MOST_LINE: u64 = 4096;

pub fn run(cli: &Cli, args: &LookupArgs, shell: &mut Shell<'_>) -> anyhow::Result<()> {
    let path = &args.maps.map;
    let maps = maps::of_one_light(maps::read(&args.maps, cli.max_memory, shell)?, path)?;
    let recipe = if let Some(text) = &args.recipe {
        let side = maps.iter().map(|named| named.map.view().size().max_element()).max();
        stage::recipe(text, side.unwrap_or(0))?
    } else {
        let (recipe, why) = own(&maps[0].map);
        shell.note(&format!("recipe: {recipe} ({why})"));
        recipe
    };
    let shadow = over(&recipe, maps).with_context(|| path.display().to_string())?;
    let mut batch = Batch { shadow: &*shadow, key: Key::new(cli.seed, 0, 0), points: Vec::new(), lines: Vec::new() };
    let (mut number, mut text) = (0u64, Vec::new());
    loop {
        text.clear();
        // A line that never ends must not fill the memory.
        let read = (&mut *shell.input).take(MOST_LINE).read_until(b'\n', &mut text).context("standard input")?;
        if read == 0 {
            break;
        }
        number += 1;
        let whole = text.ends_with(b"\n") || (read as u64) < MOST_LINE;
        let region = number as u32;
        let found = if whole { point(&String::from_utf8_lossy(&text), region) } else { Err(line::Fault::length()) };
        match found {
            Ok(None) => continue,
            Ok(Some(point)) => batch.add(Some(point)),
            Err(_) if number == 1 && whole && is_header(&String::from_utf8_lossy(&text)) => continue,
            Err(_) if args.keep_going => {
                batch.add(None);
                if !whole {
                    skip_line(shell.input)?;
                }
            }
            Err(fault) => {
                batch.finish(shell)?;
                shell.out.flush()?;
                bail!("standard input: line {number}: {fault}");
            }
        }
        if batch.lines.len() == BATCH {
            batch.finish(shell)?;
        }
    }
    batch.finish(shell)
}

/// The algorithm over the maps of a light, within the cone of the light as a whole.
fn over(recipe: &Recipe, maps: Vec<NamedMap>) -> anyhow::Result<Box<dyn Shadow>> {
    let (view, cone) = (*maps[0].map.view(), maps[0].light_cone.filter(|_| maps.len() > 1));
    let maps = maps.into_iter().map(|named| named.map).collect();
    let shadow = recipe.bind_around(maps, Storage::Tiled)?;
    if cone.is_none() {
        return Ok(shadow);
    }
    let view = view.with_rules(Rules::SPOT).with_cone(cone)?;
    Ok(Box::new(Bounded { view, by_cone: true, shadow }))
}

/// The recipe that a map was made for, and how that is known.
fn own(map: &Map) -> (Recipe, &'static str) {
    if map.facets().is_some() {
        return (PresetName::Auto.into(), "the map holds facets");
    }
    if map.translucent().is_some() {
        let deep = "reeves87,stored=deep".parse().unwrap_or_else(|_| PresetName::Reeves87.into());
        return (deep, "the map holds all surfaces");
    }
    match map.stored() {
        Stored::Midpoint => (PresetName::Woo92.into(), "the map holds midpoints"),
        Stored::Second | Stored::BackFace => (PresetName::WangMolnar94.into(), "the map holds second surfaces"),
        _ => (PresetName::Reeves87.into(), "the map holds first surfaces"),
    }
}

/// Lines that wait for their results.
struct Batch<'a> {
    shadow: &'a dyn Shadow,
    key: Key,
    points: Vec<SurfacePoint>,
    /// Whether each line is a point.
    lines: Vec<bool>,
}

impl Batch<'_> {
    fn add(&mut self, point: Option<SurfacePoint>) {
        self.lines.push(point.is_some());
        self.points.extend(point);
    }

    /// Writes the results of all lines.
    fn finish(&mut self, shell: &mut Shell<'_>) -> anyhow::Result<()> {
        let mut fractions = vec![0.0; self.points.len()];
        self.shadow.fractions(&self.points, self.key, &mut fractions);
        let mut fractions = fractions.into_iter();
        for is_point in self.lines.drain(..) {
            match if is_point { fractions.next() } else { None } {
                Some(fraction) => writeln!(shell.out, "{fraction:.9}")?,
                None => writeln!(shell.out, "NaN")?,
            }
        }
        self.points.clear();
        Ok(())
    }
}

/// Reads on to the next line.
fn skip_line(input: &mut dyn BufRead) -> anyhow::Result<()> {
    loop {
        let buffer = input.fill_buf().context("standard input")?;
        let end = buffer.iter().position(|byte| *byte == b'\n');
        let (length, done) = (end.map_or(buffer.len(), |end| end + 1), end.is_some() || buffer.is_empty());
        input.consume(length);
        if done {
            return Ok(());
        }
    }
}
