//! Makes figures one after another and writes what a reader opens: `index.html`, `report.json`, `timings.json`.

use crate::article::Beside;
use crate::folder::{self, Origin, Timings};
use crate::made::{Made, Verdict};
use crate::page::{self, Words};
use crate::record::{FigureRecord, Heading, Report};
use crate::text::figures;
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
    /// Every figure of the gallery, in its order.
    pub entries: Vec<Entry<'a>>,
    /// What stands on top of the page.
    pub words: Words,
    /// The ids of the figures that are made; none makes all. The others stay on the page if the folder holds them.
    pub only: Vec<String>,
    /// Smaller pictures and fewer samples: a figure of which nothing is judged is not a fault then.
    pub quick: bool,
    /// Stands for all that the entries' pictures and numbers depend on beside this program, in words: a figure that was made
    /// with other settings is made again.
    pub settings: String,
    /// Worker threads; `None` is one per core. They must change no bit.
    pub threads: Option<usize>,
    /// The folder that is filled.
    pub out: PathBuf,
}

/// What stands on the page, by the figure's place in the gallery.
type Standing = BTreeMap<usize, (FigureRecord, Timings)>;

impl Run<'_> {
    /// Makes what is chosen and not there yet. The page and the report in the folder are written anew after each figure that
    /// is made, so that a run that is stopped leaves them whole; they hold all figures that the folder does, each that
    /// another build or other settings made marked as such. The report that is returned holds the figures that were chosen.
    ///
    /// # Errors
    /// When a figure fails, judges nothing in a full run, or names two of its things alike; when a file cannot be written.
    pub fn make(&self) -> anyhow::Result<Report> {
        std::fs::create_dir_all(&self.out).with_context(|| self.out.display().to_string())?;
        let program = program()?;
        let origin = Origin { program: &program, settings: &self.settings };
        let pool = rayon::ThreadPoolBuilder::new().num_threads(self.threads.unwrap_or(0)).build()?;
        let mut standing: Standing = self
            .entries
            .iter()
            .enumerate()
            .filter_map(|(place, entry)| Some((place, folder::kept(&self.out, &entry.heading.id, origin)?)))
            .collect();
        let asked = |entry: &Entry| self.only.is_empty() || self.only.contains(&entry.heading.id);
        let progress = Progress::new(self.entries.iter().filter(|entry| asked(entry)).count());
        let mut report = Report { figures: Vec::new() };
        for (place, entry) in self.entries.iter().enumerate().filter(|(_, entry)| asked(entry)) {
            progress.begin(&entry.heading);
            let fresh = standing.get(&place).is_none_or(|(record, _)| record.earlier.is_some());
            if fresh {
                let made = pool.install(|| self.make_one(entry, origin)).with_context(|| entry.heading.id.clone())?;
                standing.insert(place, made);
                self.write_all(&standing)?;
            }
            let (record, seconds) = &standing[&place];
            progress.end(record, seconds, fresh);
            report.figures.push(record.clone());
        }
        progress.finish(standing.len() - report.figures.len());
        self.write_all(&standing)?;
        Ok(report)
    }

    fn make_one(&self, entry: &Entry, origin: Origin) -> anyhow::Result<(FigureRecord, Timings)> {
        let start = Instant::now();
        let made = (entry.make)()?;
        let judged = made.measures.iter().any(|measure| measure.pass().is_some());
        anyhow::ensure!(judged || self.quick, "no measure is judged: there is nothing to call reproduced");
        let mut timings = vec![("total".to_string(), start.elapsed().as_secs_f64())];
        timings.extend(made.timings.iter().cloned());
        let record = folder::write(&self.out, &entry.heading, &made, origin, &timings)?;
        Ok((record, timings))
    }

    /// Writes what a reader opens.
    fn write_all(&self, standing: &Standing) -> anyhow::Result<()> {
        let timings: BTreeMap<&str, &Timings> =
            standing.values().map(|(record, seconds)| (record.id.as_str(), seconds)).collect();
        let report = Report { figures: standing.values().map(|(record, _)| record.clone()).collect() };
        self.write("timings.json", &(serde_json::to_string_pretty(&timings)? + "\n"))?;
        self.write("index.html", &page::html(&report, &self.words, self.quick, &self.beside(&report)?))?;
        self.write("report.json", &report.json()?)
    }

    /// What the gallery holds of the figures' folders, by figure and name.
    fn beside(&self, report: &Report) -> anyhow::Result<Beside> {
        let mut beside = Beside::default();
        for figure in &report.figures {
            let read = |name: &str, extension: &str| {
                let path = self.out.join(&figure.id).join(format!("{name}.{extension}"));
                std::fs::read_to_string(&path).with_context(|| path.display().to_string())
            };
            for name in &figure.plots {
                beside.plots.insert((figure.id.clone(), name.clone()), read(name, "svg")?);
            }
            for name in &figure.run_tables {
                let table =
                    serde_json::from_str(&read(name, "json")?).with_context(|| format!("{} {name}", figure.id))?;
                beside.tables.insert((figure.id.clone(), name.clone()), table);
            }
        }
        Ok(beside)
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
                let (name, value, bound) = (&measure.name, measure.value_text(), measure.bound_text());
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

    fn finish(&self, others: usize) {
        self.bar.finish_and_clear();
        if others > 0 {
            eprintln!("{} from earlier runs on the page", figures(others));
        }
    }
}

/// One line about a report, and where to look.
pub fn summary(report: &Report, out: &Path) -> String {
    format!(
        "{}: {} reproduced, {} with a caveat, {} missed, {} not judged. Open {}",
        figures(report.figures.len()),
        report.count(Verdict::Reproduced),
        report.count(Verdict::Caveat),
        report.count(Verdict::Missed),
        report.count(Verdict::NotJudged),
        out.join("index.html").display()
    )
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::made::Table;
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
        let heading = Heading {
            id: "T-1".into(),
            paper: "Umbrage".into(),
            title: "Title".into(),
            claim: "Claim".into(),
            look: String::new(),
        };
        let entries = vec![Entry { heading, make: Box::new(move || Ok(make())) }];
        Run {
            entries,
            words: Words::default(),
            only: Vec::new(),
            quick: true,
            settings: format!("seed {seed}"),
            threads: Some(threads),
            out: out.into(),
        }
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

    fn many<'a>(ids: &[&str], only: &[&str], out: &Path, quick: bool) -> Run<'a> {
        let entry = |id: &&str| {
            let heading = Heading {
                id: (*id).into(),
                paper: "P".into(),
                title: "T".into(),
                claim: "C".into(),
                look: String::new(),
            };
            Entry { heading, make: Box::new(|| Ok(result())) }
        };
        Run {
            entries: ids.iter().map(entry).collect(),
            words: Words::default(),
            only: only.iter().map(ToString::to_string).collect(),
            quick,
            settings: format!("quick {quick}"),
            threads: Some(1),
            out: out.into(),
        }
    }

    fn on_page(out: &Path) -> Vec<(String, bool)> {
        let report: Report = serde_json::from_slice(&std::fs::read(out.join("report.json")).unwrap()).unwrap();
        let page = std::fs::read_to_string(out.join("index.html")).unwrap();
        assert!(report.figures.iter().all(|figure| page.contains(&format!("<article id=\"{}\"", figure.id))));
        report.figures.into_iter().map(|figure| (figure.id, figure.earlier.is_some())).collect()
    }

    #[test]
    fn a_run_of_some_figures_keeps_the_others_on_the_page_and_in_the_report() {
        let out = folder("only");
        let ids = ["A", "B", "C"];
        let now = |id: &str| (id.to_string(), false);
        many(&ids, &["C"], &out, true).make().unwrap();
        assert_eq!(on_page(&out), [now("C")]);
        let asked = many(&ids, &["A"], &out, true).make().unwrap();
        assert_eq!(asked.figures.len(), 1, "what is judged is what was chosen");
        assert_eq!(on_page(&out), [now("A"), now("C")], "in the order of the gallery");
        many(&ids, &["B"], &out, false).make().unwrap();
        assert_eq!(
            on_page(&out),
            [("A".into(), true), now("B"), ("C".into(), true)],
            "what other settings made is marked"
        );
        let page = std::fs::read_to_string(out.join("index.html")).unwrap();
        assert!(page.contains("made with other settings: quick true"));
        umbrage_io::write_bytes(&out.join("A/curve.svg"), b"torn").unwrap();
        many(&ids, &["B"], &out, false).make().unwrap();
        assert_eq!(on_page(&out), [now("B"), ("C".into(), true)], "a torn figure is not shown");
        many(&ids, &[], &out, true).make().unwrap();
        assert_eq!(on_page(&out), ids.map(now));
        std::fs::remove_dir_all(&out).unwrap();
    }

    #[test]
    fn a_run_that_fails_leaves_what_it_made_on_the_page() {
        let out = folder("fails");
        let mut run = many(&["A", "B", "C"], &[], &out, true);
        run.entries[1].make = Box::new(|| anyhow::bail!("out of paper"));
        assert_eq!(format!("{:#}", run.make().unwrap_err()), "B: out of paper");
        assert_eq!(on_page(&out), [("A".to_string(), false)]);
        std::fs::remove_dir_all(&out).unwrap();
    }

    #[test]
    fn tables_of_a_run_are_on_the_page_and_not_in_the_report() {
        let out = folder("table");
        let table = || Table { name: "seconds".into(), head: vec!["s".into()], rows: vec![vec!["12.75".into()]] };
        run(|| Made { run_tables: vec![table()], ..result() }, &out, 1, 0).make().unwrap();
        let text = |name: &str| std::fs::read_to_string(out.join(name)).unwrap();
        assert!(text("index.html").contains("12.75") && !text("report.json").contains("12.75"));
        std::fs::remove_dir_all(&out).unwrap();
    }

    #[test]
    fn one_figure_is_not_said_to_be_several() {
        let out = folder("one");
        let report = many(&["A"], &[], &out, true).make().unwrap();
        let line = summary(&report, Path::new("out"));
        assert!(line.starts_with("1 figure: 1 reproduced, 0 with a caveat, 0 missed, 0 not judged."), "{line}");
        std::fs::remove_dir_all(&out).unwrap();
    }
}
