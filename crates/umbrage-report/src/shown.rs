//! A page of figures that somebody else has made.

use crate::article::Beside;
use crate::folder::{self, Origin};
use crate::made::Made;
use crate::page::{self, Words};
use crate::record::{FigureRecord, Heading, Report};
use crate::text::file_stem;
use std::path::Path;

/// Writes a folder for each figure and the page over them, `index.html`, into a folder that exists. Figures of the same ids that stand there are replaced, and
/// nothing is judged: a figure may be without a bound. Returns what the page shows.
///
/// A claim that is empty is not shown.
///
/// # Errors
/// When a figure names two of its things alike, or compares a panel with one that it does not have; when a file cannot be written.
pub fn show(out: &Path, words: &Words, figures: &[(Heading, Made)]) -> anyhow::Result<Report> {
    let origin = Origin { program: "", settings: "" };
    let (mut records, mut beside): (Vec<FigureRecord>, _) = (Vec::new(), Beside::default());
    for (heading, made) in figures {
        records.push(folder::write(out, heading, made, origin, &made.timings)?);
        for (name, svg) in &made.plots {
            beside.plots.insert((heading.id.clone(), file_stem(name)), svg.clone());
        }
        for table in &made.run_tables {
            beside.tables.insert((heading.id.clone(), file_stem(&table.name)), table.clone());
        }
    }
    let report = Report { figures: records };
    let page = page::html(&report, words, false, &beside);
    umbrage_io::write_bytes(&out.join("index.html"), page.as_bytes())?;
    Ok(report)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{Measure, Panel, Role, Table};
    use glam::UVec2;

    #[test]
    fn figures_without_a_bound_are_shown_too() {
        let out = std::env::temp_dir().join(format!("umbrage-report-{}-shown", std::process::id()));
        let _ = std::fs::remove_dir_all(&out);
        std::fs::create_dir_all(&out).unwrap();
        let panel = |name: &str| Panel::grey(name, name, UVec2::new(2, 1), vec![0.0, 1.0]);
        let made = Made {
            panels: vec![panel("own").against("truth"), panel("truth").role(Role::Truth)],
            run_tables: vec![Table { name: "times".into(), head: vec!["ms".into()], rows: vec![vec!["12.5".into()]] }],
            measures: vec![Measure::info("m", 0.5, "")],
            ..Made::default()
        };
        let heading = |id: &str| Heading {
            id: id.into(),
            paper: "P".into(),
            title: "T".into(),
            claim: String::new(),
            look: String::new(),
        };
        let words = Words { title: "A & B".into(), heading: "H".into(), lead: "L".into(), questions: Vec::new() };
        let report = show(&out, &words, &[(heading("a"), made.clone()), (heading("b"), made)]).unwrap();
        assert_eq!(report.figures.len(), 2);
        let page = std::fs::read_to_string(out.join("index.html")).unwrap();
        assert!(page.contains("<title>A &amp; B</title>") && page.contains("<h1>H</h1>") && page.contains("12.5"));
        assert!(!page.contains("Must show") && !page.contains("The figures of the papers"));
        assert!(out.join("b/own.png").exists() && !out.join("report.json").exists());
        std::fs::remove_dir_all(&out).unwrap();
    }
}
