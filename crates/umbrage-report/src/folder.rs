//! A finished figure on disk: written beside its place and moved there whole, so that a killed run leaves no torn figure.

use crate::made::Made;
use crate::panel::Panel;
use crate::record::{FigureRecord, Heading, MeasureRecord};
use crate::text::{csv_field, file_stem};
use anyhow::{Context as _, bail, ensure};
use serde::{Deserialize, Serialize};
use std::collections::BTreeMap;
use std::hash::{DefaultHasher, Hash, Hasher};
use std::path::Path;

/// `figure.json`: the record, and what shows whether it may be used again.
#[derive(Serialize, Deserialize)]
struct Kept {
    /// Stands for the program that made the figure.
    program: String,
    /// What the figure depends on beside the program.
    settings: String,
    /// Every other file of the folder with a hash of its bytes.
    files: BTreeMap<String, String>,
    /// The record.
    figure: FigureRecord,
}

const RECORD: &str = "figure.json";
const TIMINGS: &str = "timings.json";

/// Seconds by name, in the order in which they were taken.
pub type Timings = Vec<(String, f64)>;

/// What a figure's bytes depend on: the program that makes it, and the settings of the run. The threads are left out.
#[derive(Clone, Copy)]
pub struct Origin<'a> {
    /// Stands for the program's own bytes.
    pub program: &'a str,
    /// The settings as text.
    pub settings: &'a str,
}

/// A hash as text. It only ever meets hashes made by the same program, so the standard hasher serves.
pub fn fingerprint(value: &(impl Hash + ?Sized)) -> String {
    let mut hasher = DefaultHasher::new();
    value.hash(&mut hasher);
    format!("{:016x}", hasher.finish())
}

/// The figure that stands in `out`, if every file of it is still as it was written. Its record says how its origin differs
/// from `origin`, if it does.
pub fn kept(out: &Path, id: &str, origin: Origin) -> Option<(FigureRecord, Timings)> {
    let folder = out.join(id);
    let kept: Kept = serde_json::from_slice(&std::fs::read(folder.join(RECORD)).ok()?).ok()?;
    let whole = |(name, hash): (&String, &String)| {
        std::fs::read(folder.join(name)).is_ok_and(|bytes| fingerprint(&bytes) == *hash)
    };
    if kept.figure.id != id || !kept.files.iter().all(whole) {
        return None;
    }
    let timings = serde_json::from_slice(&std::fs::read(folder.join(TIMINGS)).ok()?).ok()?;
    let earlier = if kept.settings != origin.settings {
        Some(format!("made with other settings: {}", kept.settings))
    } else if kept.program != origin.program {
        Some("made by another build of the program".into())
    } else {
        None
    };
    Some((FigureRecord { earlier, ..kept.figure }, timings))
}

/// Writes a figure's folder: into `.<id>.part` first, then renamed over `<id>`.
pub fn write(
    out: &Path,
    heading: &Heading,
    made: &Made,
    origin: Origin,
    timings: &Timings,
) -> anyhow::Result<FigureRecord> {
    check_against(made)?;
    check_names(made)?;
    let part = out.join(format!(".{}.part", heading.id));
    let place = out.join(&heading.id);
    remove(&part)?;
    std::fs::create_dir_all(&part).with_context(|| part.display().to_string())?;
    let record = FigureRecord::new(heading, made);
    let mut hashes = BTreeMap::new();
    for (name, bytes) in files(made, &record, timings)? {
        ensure!(hashes.insert(name.clone(), fingerprint(&bytes)).is_none(), "two files are called {name}");
        umbrage_io::write_bytes(&part.join(name), &bytes)?;
    }
    let Origin { program, settings } = origin;
    let kept = Kept { program: program.into(), settings: settings.into(), files: hashes, figure: record };
    umbrage_io::write_bytes(&part.join(RECORD), (serde_json::to_string_pretty(&kept)? + "\n").as_bytes())?;
    remove(&place)?;
    std::fs::rename(&part, &place).with_context(|| place.display().to_string())?;
    Ok(kept.figure)
}

/// A panel as the bytes of a PNG file, pixels replicated by its zoom.
pub fn png(panel: &Panel) -> anyhow::Result<Vec<u8>> {
    ensure!(panel.zoom > 0, "panel {} has zoom 0", panel.name);
    let (size, pixels) = umbrage_io::replicate(panel.size, &panel.pixels, panel.zoom);
    Ok(umbrage_io::encode_png(size, &pixels)?)
}

fn files(made: &Made, record: &FigureRecord, timings: &Timings) -> anyhow::Result<Vec<(String, Vec<u8>)>> {
    let mut files = Vec::new();
    for panel in &made.panels {
        files.push((file_name(&panel.name, "png")?, png(panel).with_context(|| format!("panel {}", panel.name))?));
    }
    for (name, svg) in &made.plots {
        files.push((file_name(name, "svg")?, svg.clone().into_bytes()));
    }
    for table in &made.tables {
        let lines = std::iter::once(&table.head).chain(&table.rows);
        files.push((file_name(&table.name, "csv")?, csv(lines).into_bytes()));
    }
    for table in &made.run_tables {
        files.push((file_name(&table.name, "json")?, (serde_json::to_string_pretty(table)? + "\n").into_bytes()));
    }
    files.push(("measures.csv".into(), measures_csv(&record.measures).into_bytes()));
    files.push((TIMINGS.into(), (serde_json::to_string_pretty(timings)? + "\n").into_bytes()));
    Ok(files)
}

/// A panel's, plot's or table's file.
fn file_name(name: &str, extension: &str) -> anyhow::Result<String> {
    let stem = file_stem(name);
    ensure!(!stem.is_empty(), "{name:?} leaves nothing to name a file by");
    Ok(format!("{stem}.{extension}"))
}

/// Measures are told apart by their names.
fn check_names(made: &Made) -> anyhow::Result<()> {
    let mut names: Vec<&str> = made.measures.iter().map(|measure| measure.name.as_str()).collect();
    names.sort_unstable();
    match names.windows(2).find(|pair| pair[0] == pair[1]) {
        Some(pair) => bail!("two measures are called {:?}", pair[0]),
        None => Ok(()),
    }
}

/// A wipe needs a partner of the same shape.
fn check_against(made: &Made) -> anyhow::Result<()> {
    for panel in &made.panels {
        let Some(name) = &panel.against else { continue };
        match made.panels.iter().find(|other| other.name == *name) {
            None => bail!("panel {} is compared with {name}, which the figure does not have", panel.name),
            Some(other) => ensure!(
                panel.size * panel.zoom == other.size * other.zoom,
                "panel {} is compared with {name}, which has another size",
                panel.name
            ),
        }
    }
    Ok(())
}

fn csv<'a>(rows: impl Iterator<Item = &'a Vec<String>>) -> String {
    rows.map(|row| row.iter().map(|field| csv_field(field)).collect::<Vec<_>>().join(",") + "\n").collect()
}

fn measures_csv(measures: &[MeasureRecord]) -> String {
    let head = ["measure", "value", "unit", "bound", "pass"].map(String::from).to_vec();
    let rows: Vec<Vec<String>> = measures
        .iter()
        .map(|measure| {
            vec![
                measure.name.clone(),
                measure.value.map(|value| value.to_string()).unwrap_or_default(),
                measure.unit.clone(),
                measure.bound.to_string(),
                measure.pass.map(|pass| pass.to_string()).unwrap_or_default(),
            ]
        })
        .collect();
    csv(std::iter::once(&head).chain(&rows))
}

fn remove(folder: &Path) -> anyhow::Result<()> {
    match std::fs::remove_dir_all(folder) {
        Err(error) if error.kind() != std::io::ErrorKind::NotFound => {
            Err(error).with_context(|| folder.display().to_string())
        }
        _ => Ok(()),
    }
}
