//! Makes figures one after another and writes what a reader opens: `index.html`, `report.json`, `timings.json`.

use crate::figure::{Context, Figure, Verdict};
use crate::folder::{self, Timings};
use crate::page;
use crate::record::{FigureRecord, Report};
use anyhow::Context as _;
use indicatif::{HumanDuration, ProgressBar, ProgressState, ProgressStyle};
use std::collections::BTreeMap;
use std::fmt::Write as _;
use std::path::{Path, PathBuf};
use std::time::{Duration, Instant};

/// What a run makes and where it puts it.
pub struct Run<'a> {
    /// In the order of the gallery.
    pub figures: Vec<&'a Figure>,
    /// What every figure is asked.
    pub context: Context,
    /// Worker threads; `None` is one a core. Changes no bit.
    pub threads: Option<usize>,
    /// The folder that is filled.
    pub out: PathBuf,
}

impl Run<'_> {
    /// Makes what is not there yet, then writes report and gallery.
    pub fn make(&self) -> anyhow::Result<Report> {
        std::fs::create_dir_all(&self.out).with_context(|| self.out.display().to_string())?;
        let program = program()?;
        let pool = rayon::ThreadPoolBuilder::new().num_threads(self.threads.unwrap_or(0)).build()?;
        let progress = Progress::new(self.figures.len());
        let mut report = Report { figures: Vec::new() };
        let mut timings = BTreeMap::new();
        for figure in &self.figures {
            progress.begin(figure);
            let key = self.key(&program, figure);
            let (record, seconds, fresh) = if let Some((record, seconds)) = folder::reuse(&self.out, figure.id, &key) {
                (record, seconds, false)
            } else {
                let (record, seconds) =
                    pool.install(|| self.make_one(figure, &key)).with_context(|| figure.id.to_string())?;
                (record, seconds, true)
            };
            progress.end(&record, &seconds, fresh);
            timings.insert(figure.id, seconds);
            report.figures.push(record);
        }
        progress.finish();
        self.write("timings.json", &(serde_json::to_string_pretty(&timings)? + "\n"))?;
        self.write("index.html", &page::html(&report, self.context.quick, &self.plots(&report)?))?;
        self.write("report.json", &report.json()?)?;
        Ok(report)
    }

    fn make_one(&self, figure: &Figure, key: &str) -> anyhow::Result<(FigureRecord, Timings)> {
        let start = Instant::now();
        let made = (figure.make)(&self.context)?;
        let judged = made.measures.iter().any(|measure| measure.pass().is_some());
        anyhow::ensure!(judged || self.context.quick, "no measure is judged: there is nothing to call reproduced");
        let mut timings = vec![("total".to_string(), start.elapsed().as_secs_f64())];
        timings.extend(made.timings.iter().cloned());
        let record = folder::write(&self.out, figure, &made, key, &timings)?;
        Ok((record, timings))
    }

    /// Stands for everything that a figure's bytes could depend on. The storage changes none of them, which is what a run
    /// with another storage is there to show: it must not be handed the old files. The threads are left out.
    fn key(&self, program: &str, figure: &Figure) -> String {
        let Context { quick, seed, storage } = self.context;
        folder::fingerprint(&(program, figure.id, quick, seed, format!("{storage:?}")))
    }

    /// The SVG texts that the gallery holds, by figure and name.
    fn plots(&self, report: &Report) -> anyhow::Result<BTreeMap<(String, String), String>> {
        let mut plots = BTreeMap::new();
        for figure in &report.figures {
            for name in &figure.plots {
                let path = self.out.join(&figure.id).join(format!("{name}.svg"));
                let svg = std::fs::read_to_string(&path).with_context(|| path.display().to_string())?;
                plots.insert((figure.id.clone(), name.clone()), svg);
            }
        }
        Ok(plots)
    }

    fn write(&self, name: &str, text: &str) -> anyhow::Result<()> {
        Ok(umbrage_io::write_bytes(&self.out.join(name), text.as_bytes())?)
    }
}

/// A hash of this program's own bytes: a figure made by another build is made again.
fn program() -> anyhow::Result<String> {
    let path = std::env::current_exe().context("this program's own path")?;
    Ok(folder::fingerprint(&std::fs::read(&path).with_context(|| path.display().to_string())?))
}

/// Tells on standard error what is being made: a bar in a terminal, a line a figure everywhere.
struct Progress {
    bar: ProgressBar,
}

impl Progress {
    fn new(figures: usize) -> Self {
        let left = |state: &ProgressState, text: &mut dyn std::fmt::Write| {
            // Before the first figure is finished there is nothing to reckon with.
            let known = state.pos() > 0;
            let _ = if known { write!(text, "{} left", HumanDuration(state.eta())) } else { text.write_str("…") };
        };
        let style = ProgressStyle::with_template("{bar:24} {pos}/{len}  {msg}  {elapsed}, {left}")
            .unwrap_or_else(|_| ProgressStyle::default_bar())
            .with_key("left", left);
        let bar = ProgressBar::new(figures as u64).with_style(style);
        bar.enable_steady_tick(Duration::from_millis(200));
        Self { bar }
    }

    fn begin(&self, figure: &Figure) {
        self.bar.set_message(format!("{} {}", figure.id, figure.title));
    }

    fn end(&self, record: &FigureRecord, timings: &Timings, fresh: bool) {
        let seconds = timings.first().map_or(0.0, |total| total.1);
        let spent = if fresh { format!("{seconds:6.1} s") } else { "   kept ".into() };
        let mut line = format!("{spent}  {:10}  {}: {}", record.verdict.word(), record.id, record.title);
        for warning in record.note.split("Warning: ").skip(1) {
            let _ = write!(line, "\n{:23}warning: {}", "", warning.trim());
        }
        if record.verdict == Verdict::Missed {
            for measure in record.measures.iter().filter(|measure| measure.pass == Some(false)) {
                let (name, value, bound) = (&measure.name, measure.value_text(), &measure.bound);
                let _ = write!(line, "\n{:23}{name} is {value}, must be {bound}", "");
            }
        }
        if self.bar.is_hidden() {
            eprintln!("{line}");
        } else {
            self.bar.println(line);
        }
        self.bar.inc(1);
    }

    fn finish(&self) {
        self.bar.finish_and_clear();
    }
}

/// One line about a report, and where to look.
pub fn summary(report: &Report, out: &Path) -> String {
    format!(
        "{} figures: {} reproduced, {} with a caveat, {} missed. Open {}",
        report.figures.len(),
        report.count(Verdict::Reproduced),
        report.count(Verdict::Caveat),
        report.count(Verdict::Missed),
        out.join("index.html").display()
    )
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::figure::{Made, Measure, Panel, Paper, Role};
    use glam::UVec2;
    use std::sync::atomic::{AtomicU32, Ordering};
    use umbrage_render::Storage;

    fn panel(name: &str) -> Panel {
        Panel::grey(name, "a <caption>", UVec2::new(2, 1), vec![0.0, 1.0]).zoom(3)
    }

    static MADE: AtomicU32 = AtomicU32::new(0);

    #[expect(clippy::unnecessary_wraps, reason = "all figures are made by functions of one type")]
    fn make(_: &Context) -> anyhow::Result<Made> {
        MADE.fetch_add(1, Ordering::Relaxed);
        Ok(Made {
            panels: vec![panel("the result").with("bias", 1).against("truth"), panel("truth").role(Role::Truth)],
            plots: vec![("curve".into(), "<svg></svg>".into())],
            measures: vec![Measure::at_most("m", 0.1 + 0.2, "px", 0.919_999_999_999_999_9)],
            ..Made::default()
        })
    }

    #[expect(clippy::unnecessary_wraps, reason = "all figures are made by functions of one type")]
    fn alone(_: &Context) -> anyhow::Result<Made> {
        Ok(Made { panels: vec![panel("result").against("truth")], ..Made::default() })
    }

    fn figure(make: fn(&Context) -> anyhow::Result<Made>) -> Figure {
        Figure { id: "T-1", paper: Paper::Umbrage, title: "Title", claim: "Claim", make }
    }

    fn run<'a>(figure: &'a Figure, out: &Path, threads: usize, seed: u32) -> Run<'a> {
        let context = Context { quick: true, seed, storage: Storage::Tiled };
        Run { figures: vec![figure], context, threads: Some(threads), out: out.into() }
    }

    /// A folder of this test alone, empty at the start.
    fn folder(name: &str) -> PathBuf {
        let folder = std::env::temp_dir().join(format!("umbrage-xtask-{}-{name}", std::process::id()));
        let _ = std::fs::remove_dir_all(&folder);
        folder
    }

    #[test]
    fn x8_a_finished_figure_is_kept_until_something_of_it_changes() {
        let (out, figure) = (folder("reuse"), figure(make));
        let made = || MADE.load(Ordering::Relaxed);
        let bytes = || std::fs::read(out.join("report.json")).unwrap();
        run(&figure, &out, 1, 0).make().unwrap();
        let report = bytes();
        assert_eq!(made(), 1);
        run(&figure, &out, 2, 0).make().unwrap();
        assert_eq!((made(), bytes()), (1, report.clone()), "another number of threads makes nothing new");
        run(&figure, &out, 2, 7).make().unwrap();
        assert_eq!(made(), 2, "another seed does");
        umbrage_io::write_bytes(&out.join("T-1/the-result.png"), b"torn").unwrap();
        run(&figure, &out, 2, 7).make().unwrap();
        assert_eq!((made(), bytes()), (3, report), "a file that is not as it was written does");
        std::fs::remove_file(out.join("T-1/timings.json")).unwrap();
        run(&figure, &out, 2, 7).make().unwrap();
        assert_eq!(made(), 4, "a lost file does");
        let png = umbrage_io::read_png(&out.join("T-1/the-result.png")).unwrap();
        assert_eq!((png.size, png.rgb[2], png.rgb[3]), (UVec2::new(6, 3), [0; 3], [255; 3]), "x7 replicated");
        let left: Vec<_> = std::fs::read_dir(&out).unwrap().map(|entry| entry.unwrap().file_name()).collect();
        assert!(left.iter().all(|name| !name.to_string_lossy().starts_with('.')), "{left:?}");
        std::fs::remove_dir_all(&out).unwrap();
    }

    #[test]
    fn an_unfinished_folder_is_never_taken_for_a_figure() {
        let (out, figure) = (folder("part"), figure(alone));
        std::fs::create_dir_all(out.join(".T-1.part")).unwrap();
        umbrage_io::write_bytes(&out.join(".T-1.part/figure.json"), b"{").unwrap();
        let failure = format!("{:#}", run(&figure, &out, 1, 0).make().unwrap_err());
        assert_eq!(failure, "T-1: panel result is compared with truth, which the figure does not have");
        assert!(!out.join("T-1").exists() && !out.join("report.json").exists());
        std::fs::remove_dir_all(&out).unwrap();
    }

    /// Real figures under every storage and several numbers of threads: the same bytes of everything that is written.
    #[test]
    fn c9_x8_threads_and_storages_change_no_byte() {
        let chosen = ["W78-F4", "R87-F2", "R87-F6", "U-acne"];
        let figures: Vec<&Figure> =
            crate::figures::FIGURES.iter().copied().filter(|figure| chosen.contains(&figure.id)).collect();
        let bytes = |storage, threads| {
            let out = folder(&format!("{storage:?}-{threads}"));
            let context = Context { quick: true, seed: 0, storage };
            Run { figures: figures.clone(), context, threads: Some(threads), out: out.clone() }.make().unwrap();
            let mut files = vec![("report.json".to_string(), std::fs::read(out.join("report.json")).unwrap())];
            for id in chosen {
                for entry in std::fs::read_dir(out.join(id)).unwrap() {
                    let path = entry.unwrap().path();
                    let name = path.file_name().unwrap().to_string_lossy().into_owned();
                    // The record names the storage it was made with, the timings tell times.
                    if name != "figure.json" && name != "timings.json" {
                        files.push((format!("{id}/{name}"), std::fs::read(&path).unwrap()));
                    }
                }
            }
            files.sort();
            std::fs::remove_dir_all(&out).unwrap();
            files
        };
        let expected = bytes(Storage::Raw, 1);
        assert!(expected.len() > 15);
        for (storage, threads) in [(Storage::Bbox, 2), (Storage::Tiled, 4)] {
            let found = bytes(storage, threads);
            let differing: Vec<&str> =
                found.iter().zip(&expected).filter(|(a, b)| a != b).map(|(a, _)| a.0.as_str()).collect();
            assert!(differing.is_empty() && found.len() == expected.len(), "{storage:?}: {differing:?}");
        }
    }
}
