//! What the repository keeps of the figures, and whether the code still makes it: the README's pictures at full size, and
//! the numbers of a quick run.

use crate::catalogue;
use crate::figure::Context;
use crate::run::Run;
use anyhow::Context as _;
use glam::UVec2;
use std::path::Path;
use umbrage_report::Report;
use umbrage_report::text::{csv_field, file_stem, rounded};

/// A picture of the README: its file, and the figure and panel that it is.
pub struct Picture {
    /// From the repository's root.
    pub file: &'static str,
    /// The figure's id.
    pub figure: &'static str,
    /// The panel's name.
    pub panel: &'static str,
}

/// The README's pictures.
pub const PICTURES: &[Picture] = &[
    Picture { file: "fixtures/readme/engine.png", figure: "U-auto", panel: "chairs-engine" },
    Picture { file: "fixtures/readme/default.png", figure: "U-auto", panel: "chairs-auto" },
    Picture { file: "fixtures/readme/robot.png", figure: "W78-F8", panel: "robot" },
    Picture { file: "fixtures/readme/lamps.png", figure: "R87-F12", panel: "c-jittered" },
    Picture { file: "fixtures/readme/plant.png", figure: "B06-deep", panel: "plant" },
];

/// The numbers of a quick run with seed 0.
const NUMBERS: &str = "fixtures/figures.csv";

/// How far one code of a picture may be from the kept one: another machine's mathematics rounds differently.
const CODES_APART: u8 = 3;
/// The fraction of pixels that may be farther off: a comparison of nearly equal depths may come out differently there.
const PIXELS_APART: f64 = 0.001;
/// How far a number may be from the kept one, as a fraction of it.
const NUMBERS_APART: f64 = 1e-3;

/// What the code makes now, file by file.
pub struct Goldens {
    files: Vec<(&'static str, Vec<u8>)>,
}

/// Makes everything that is kept: the README's figures at full size in `readme` below the run's folder, all quick figures
/// in `quick`. A gallery that stands in the run's folder stays as it is. Where the run is of some figures only, so is the
/// comparison.
///
/// # Errors
/// When a figure fails or a file cannot be written or read again.
pub fn all(run: &Run) -> anyhow::Result<Goldens> {
    let shown = |id: &str| PICTURES.iter().any(|picture| picture.figure == id);
    let full = Run {
        figures: run.figures.iter().copied().filter(|figure| shown(figure.id)).collect(),
        context: Context { quick: false, ..run.context.clone() },
        threads: run.threads,
        out: run.out.join("readme"),
    };
    let mut files = Vec::new();
    if !full.figures.is_empty() {
        full.make()?;
    }
    for picture in PICTURES.iter().filter(|picture| full.figures.iter().any(|figure| figure.id == picture.figure)) {
        let path = full.out.join(picture.figure).join(format!("{}.png", file_stem(picture.panel)));
        files.push((picture.file, std::fs::read(&path).with_context(|| path.display().to_string())?));
    }
    let quick = Run {
        figures: run.figures.clone(),
        context: Context { quick: true, ..run.context.clone() },
        threads: run.threads,
        out: run.out.join("quick"),
    };
    files.push((NUMBERS, numbers(&quick.make()?).into_bytes()));
    Ok(Goldens { files })
}

impl Goldens {
    /// Writes the files into the repository at `root`.
    ///
    /// # Errors
    /// When one cannot be written.
    pub fn write(&self, root: &Path) -> anyhow::Result<()> {
        for (file, bytes) in &self.files {
            let path = root.join(file);
            if let Some(folder) = path.parent() {
                std::fs::create_dir_all(folder).with_context(|| folder.display().to_string())?;
            }
            umbrage_io::write_bytes(&path, bytes)?;
            println!("{file}");
        }
        Ok(())
    }

    /// What differs from the files of the repository at `root`, one line each.
    pub fn compare(&self, root: &Path) -> Vec<String> {
        let mut findings = Vec::new();
        for (file, made) in &self.files {
            match std::fs::read(root.join(file)) {
                Err(error) => findings.push(format!("{file}: {error}")),
                Ok(kept) if Path::new(file).extension().is_some_and(|end| end == "png") => {
                    findings.extend(picture_differs(&kept, made).map(|how| format!("{file}: {how}")));
                }
                Ok(kept) => {
                    let (kept, made) = (String::from_utf8_lossy(&kept), String::from_utf8_lossy(made));
                    findings.extend(numbers_differ(&kept, &made).into_iter().map(|how| format!("{file}: {how}")));
                }
            }
        }
        findings
    }
}

/// How two PNG files, given as bytes, differ by more than the tolerance; `None` where they do not.
pub fn picture_differs(kept: &[u8], made: &[u8]) -> Option<String> {
    let (kept, made) = match (umbrage_io::decode_png(kept), umbrage_io::decode_png(made)) {
        (Ok(kept), Ok(made)) => (kept, made),
        (Err(fault), _) | (_, Err(fault)) => return Some(fault.to_string()),
    };
    if kept.size != made.size {
        let UVec2 { x, y } = made.size;
        return Some(format!("is {} × {}, but the code makes {x} × {y}", kept.size.x, kept.size.y));
    }
    let apart = |pair: &(&[u8; 3], &[u8; 3])| pair.0.iter().zip(pair.1).any(|(a, b)| a.abs_diff(*b) > CODES_APART);
    let count = kept.rgb.iter().zip(&made.rgb).filter(apart).count();
    let share = count as f64 / kept.rgb.len().max(1) as f64;
    (share > PIXELS_APART).then(|| format!("{count} pixels differ by more than {CODES_APART} codes"))
}

/// The numbers of a report as CSV, to six digits.
fn numbers(report: &Report) -> String {
    let rows = report.figures.iter().flat_map(|figure| {
        figure.measures.iter().map(|measure| {
            let value = measure.value.map(|value| rounded(value, 6).to_string()).unwrap_or_default();
            format!("{},{},{value},{}\n", figure.id, csv_field(&measure.name), csv_field(&measure.unit))
        })
    });
    std::iter::once("figure,measure,value,unit\n".to_string()).chain(rows).collect()
}

/// Rows as (everything but the value, value), of the figures that `of` names.
fn rows(csv: &str) -> Vec<(String, String)> {
    let cut = |line: &str| {
        // The value is the field before the last, and neither holds a comma: units are plain.
        let (rest, unit) = line.rsplit_once(',')?;
        let (name, value) = rest.rsplit_once(',')?;
        Some((format!("{name} [{unit}]"), value.to_string()))
    };
    csv.lines().skip(1).filter_map(cut).collect()
}

fn figure_of(row: &str) -> &str {
    row.split(',').next().unwrap_or(row)
}

/// What differs between the kept and the made numbers, both CSV, one finding a line. Figures that were not made are passed over, unless they are no longer in
/// the catalogue.
pub fn numbers_differ(kept: &str, made: &str) -> Vec<String> {
    let (kept, made) = (rows(kept), rows(made));
    let was_made = |row: &str| made.iter().any(|(name, _)| figure_of(name) == figure_of(row));
    let exists = |row: &str| catalogue::figures().any(|figure| figure.id == figure_of(row));
    let mut findings = Vec::new();
    for (name, value) in &made {
        match kept.iter().find(|(other, _)| other == name) {
            None => findings.push(format!("does not hold {name}")),
            Some((_, old)) if !alike(old, value) => {
                findings.push(format!("{name} is {old}, but the code makes {value}"));
            }
            Some(_) => {}
        }
    }
    let gone = |name: &str| !made.iter().any(|(other, _)| other == name) && (was_made(name) || !exists(name));
    findings
        .extend(kept.iter().filter(|(name, _)| gone(name)).map(|(name, _)| format!("the code no longer makes {name}")));
    findings
}

fn alike(old: &str, new: &str) -> bool {
    match (old.parse::<f64>(), new.parse::<f64>()) {
        (Ok(old), Ok(new)) => (old - new).abs() <= NUMBERS_APART * old.abs().max(new.abs()).max(1e-6),
        _ => old == new,
    }
}
