//! Makes figures one after another and writes what a reader opens: `index.html`, `report.json`, `timings.json`.

use crate::folder::{self, Timings};
use crate::made::{Made, Verdict};
use crate::page;
use crate::record::{FigureRecord, Heading, Report};
use anyhow::Context as _;
use indicatif::{HumanDuration, ProgressBar, ProgressState, ProgressStyle};
use std::collections::BTreeMap;
use std::fmt::Write as _;
use std::path::{Path, PathBuf};
use std::time::{Duration, Instant};

/// A figure of a run: what it is called, and how it is made.
pub struct Entry<'a> {
    /// What it is called.
    pub heading: Heading,
    /// Makes it, inside the run's pool of threads.
    pub make: Box<dyn Fn() -> anyhow::Result<Made> + Send + Sync + 'a>,
}

/// What a run makes and where it puts it.
pub struct Run<'a> {
    /// In the order of the gallery.
    pub entries: Vec<Entry<'a>>,
    /// Smaller pictures and fewer samples: a figure of which nothing is judged is no fault then.
    pub quick: bool,
    /// Stands for all that the entries' pictures and numbers depend on beside this program: a figure that was made with other
    /// settings is made again.
    pub settings: String,
    /// Worker threads; `None` is one a core. They must change no bit.
    pub threads: Option<usize>,
    /// The folder that is filled.
    pub out: PathBuf,
}

impl Run<'_> {
    /// Makes what is not there yet, then writes report and gallery.
    ///
    /// # Errors
    /// When a figure fails, judges nothing in a full run, or names two of its things alike; when a file cannot be written.
    pub fn make(&self) -> anyhow::Result<Report> {
        std::fs::create_dir_all(&self.out).with_context(|| self.out.display().to_string())?;
        let program = program()?;
        let pool = rayon::ThreadPoolBuilder::new().num_threads(self.threads.unwrap_or(0)).build()?;
        let progress = Progress::new(self.entries.len());
        let mut report = Report { figures: Vec::new() };
        let mut timings = BTreeMap::new();
        for entry in &self.entries {
            let id = &entry.heading.id;
            progress.begin(&entry.heading);
            let key = self.key(&program, id);
            let (record, seconds, fresh) = if let Some((record, seconds)) = folder::reuse(&self.out, id, &key) {
                (record, seconds, false)
            } else {
                let (record, seconds) = pool.install(|| self.make_one(entry, &key)).with_context(|| id.clone())?;
                (record, seconds, true)
            };
            progress.end(&record, &seconds, fresh);
            timings.insert(id, seconds);
            report.figures.push(record);
        }
        progress.finish();
        self.write("timings.json", &(serde_json::to_string_pretty(&timings)? + "\n"))?;
        self.write("index.html", &page::html(&report, self.quick, &self.plots(&report)?))?;
        self.write("report.json", &report.json()?)?;
        Ok(report)
    }

    fn make_one(&self, entry: &Entry, key: &str) -> anyhow::Result<(FigureRecord, Timings)> {
        let start = Instant::now();
        let made = (entry.make)()?;
        let judged = made.measures.iter().any(|measure| measure.pass().is_some());
        anyhow::ensure!(judged || self.quick, "no measure is judged: there is nothing to call reproduced");
        let mut timings = vec![("total".to_string(), start.elapsed().as_secs_f64())];
        timings.extend(made.timings.iter().cloned());
        let record = folder::write(&self.out, &entry.heading, &made, key, &timings)?;
        Ok((record, timings))
    }

    /// Stands for everything that a figure's bytes could depend on. The threads are left out.
    fn key(&self, program: &str, id: &str) -> String {
        folder::fingerprint(&(program, id, &self.settings))
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

/// Reports on standard error what is being made: a bar in a terminal, a line a figure everywhere.
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

    fn begin(&self, heading: &Heading) {
        self.bar.set_message(format!("{} {}", heading.id, heading.title));
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
    use crate::measure::Measure;
    use crate::panel::{Panel, Role};
    use glam::UVec2;
    use std::sync::atomic::{AtomicU32, Ordering};

    fn panel(name: &str) -> Panel {
        Panel::grey(name, "a <caption>", UVec2::new(2, 1), vec![0.0, 1.0]).zoom(3)
    }

    fn result() -> Made {
        Made {
            panels: vec![panel("the result").with("bias", 1).against("truth"), panel("truth").role(Role::Truth)],
            plots: vec![("curve".into(), "<svg></svg>".into())],
            measures: vec![Measure::at_most("m", 0.1 + 0.2, "px", 0.919_999_999_999_999_9)],
            ..Made::default()
        }
    }

    fn run<'a>(make: impl Fn() -> Made + Send + Sync + 'a, out: &Path, threads: usize, seed: u32) -> Run<'a> {
        let heading =
            Heading { id: "T-1".into(), paper: "Umbrage".into(), title: "Title".into(), claim: "Claim".into() };
        let entries = vec![Entry { heading, make: Box::new(move || Ok(make())) }];
        Run { entries, quick: true, settings: format!("seed {seed}"), threads: Some(threads), out: out.into() }
    }

    /// A folder of this test alone, empty at the start.
    fn folder(name: &str) -> PathBuf {
        let folder = std::env::temp_dir().join(format!("umbrage-report-{}-{name}", std::process::id()));
        let _ = std::fs::remove_dir_all(&folder);
        folder
    }

    #[test]
    fn x8_a_finished_figure_is_kept_until_something_of_it_changes() {
        let (out, count) = (folder("reuse"), AtomicU32::new(0));
        let make = || {
            count.fetch_add(1, Ordering::Relaxed);
            result()
        };
        let made = || count.load(Ordering::Relaxed);
        let bytes = || std::fs::read(out.join("report.json")).unwrap();
        run(make, &out, 1, 0).make().unwrap();
        let report = bytes();
        assert_eq!(made(), 1);
        run(make, &out, 2, 0).make().unwrap();
        assert_eq!((made(), bytes()), (1, report.clone()), "another number of threads makes nothing new");
        run(make, &out, 2, 7).make().unwrap();
        assert_eq!(made(), 2, "another seed does");
        umbrage_io::write_bytes(&out.join("T-1/the-result.png"), b"torn").unwrap();
        run(make, &out, 2, 7).make().unwrap();
        assert_eq!((made(), bytes()), (3, report), "a file that is not as it was written does");
        std::fs::remove_file(out.join("T-1/timings.json")).unwrap();
        run(make, &out, 2, 7).make().unwrap();
        assert_eq!(made(), 4, "a lost file does");
        let png = umbrage_io::read_png(&out.join("T-1/the-result.png")).unwrap();
        assert_eq!((png.size, png.rgb[2], png.rgb[3]), (UVec2::new(6, 3), [0; 3], [255; 3]), "x7 replicated");
        let left: Vec<_> = std::fs::read_dir(&out).unwrap().map(|entry| entry.unwrap().file_name()).collect();
        assert!(left.iter().all(|name| !name.to_string_lossy().starts_with('.')), "{left:?}");
        std::fs::remove_dir_all(&out).unwrap();
    }

    #[test]
    fn an_unfinished_folder_is_never_taken_for_a_figure() {
        let out = folder("part");
        let alone = || Made { panels: vec![panel("result").against("truth")], ..Made::default() };
        std::fs::create_dir_all(out.join(".T-1.part")).unwrap();
        umbrage_io::write_bytes(&out.join(".T-1.part/figure.json"), b"{").unwrap();
        let failure = format!("{:#}", run(alone, &out, 1, 0).make().unwrap_err());
        assert_eq!(failure, "T-1: panel result is compared with truth, which the figure does not have");
        assert!(!out.join("T-1").exists() && !out.join("report.json").exists());
        std::fs::remove_dir_all(&out).unwrap();
    }
}
