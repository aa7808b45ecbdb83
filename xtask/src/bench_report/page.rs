//! The report as a Markdown table and as bars.

use super::limits;
use super::rows::{Goal, Report, Row};
use std::fmt::Write;

/// What was measured under one set of flags.
#[derive(Clone, Debug)]
pub struct Column {
    pub flags: &'static str,
    pub report: Report,
}

/// What all columns have in common.
#[derive(Clone, Debug)]
pub struct Facts {
    pub processor: String,
    pub rustc: String,
    pub quick: bool,
}

/// Where and how it was measured, a sentence each.
fn heading(facts: &Facts, columns: &[Column]) -> Vec<String> {
    let mut lines = vec![
        format!("Processor: {}. Compiler: {}.", facts.processor, facts.rustc),
        "One thread, processor time, medians of interleaved runs in one process; rows of two threads are wall time."
            .into(),
        "Freed memory stays with the process, as peers keep their buffers: no run but the first pays for the system's pages.".into(),
    ];
    for Column { flags, report } in columns {
        lines.push(format!(
            "{flags}: kernels run with {}; two threads that only spin do {:.2} times as much as one.",
            report.instructions, report.spin
        ));
    }
    if facts.quick {
        lines.push("A quick run of small workloads, each once: its numbers mean nothing.".into());
    }
    lines
}

/// The table.
pub fn markdown(facts: &Facts, columns: &[Column]) -> String {
    let mut text = String::from("# Ours beside peers\n\n");
    for line in heading(facts, columns) {
        let _ = writeln!(text, "* {line}");
    }
    let mut group = "";
    for (index, row) in columns[0].report.rows.iter().enumerate() {
        if row.group != group {
            group = &row.group;
            let _ = write!(
                text,
                "\n## {}\n\n| what | flags | unit | ours | peer | peer's | ratio | goal | |\n",
                capital(group)
            );
            text.push_str("|---|---|---|---|---|---|---|---|---|\n");
        }
        for Column { flags, report } in columns {
            if let Some(row) = report.rows.get(index).filter(|other| other.what == row.what) {
                let _ = writeln!(text, "{}", line(row, flags));
            }
        }
    }
    let judged = columns.iter().flat_map(|column| &column.report.rows).filter_map(Row::met);
    let (met, missed): (Vec<bool>, Vec<bool>) = judged.partition(|met| *met);
    let _ = writeln!(text, "\n{} goals met, {} missed.", met.len(), missed.len());
    for Column { flags, report } in columns {
        let lines: Vec<String> = report.rows.iter().filter_map(|row| limits::line(row, &report.rows)).collect();
        if !lines.is_empty() {
            let _ = writeln!(text, "\n## What holds back the missed ones, {flags}\n\n{}", lines.join("\n"));
        }
    }
    text
}

fn line(row: &Row, flags: &str) -> String {
    let Row { what, unit, ours, peer, theirs, goal, .. } = row;
    let goal = match goal {
        Goal::Faster(times) => format!("≥ {times} times as fast"),
        Goal::Within(times) => format!("≤ {times} times the peer"),
        Goal::Free => String::new(),
    };
    let ratio = match row.goal {
        Goal::Faster(_) => format!("{} times as fast", short(row.ratio())),
        _ => format!("{} times the peer", short(row.ratio())),
    };
    let met = match row.met() {
        Some(true) => "met",
        Some(false) => "**missed**",
        None => "",
    };
    format!("| {what} | {flags} | {unit} | {} | {peer} | {} | {ratio} | {goal} | {met} |", short(*ours), short(*theirs))
}

/// Three digits that count.
pub fn short(value: f64) -> String {
    match value.abs() {
        large if large >= 100.0 => format!("{value:.0}"),
        middle if middle >= 10.0 => format!("{value:.1}"),
        middle if middle >= 1.0 => format!("{value:.2}"),
        _ => format!("{value:.3}"),
    }
}

fn capital(text: &str) -> String {
    let mut letters = text.chars();
    letters.next().map_or_else(String::new, |first| first.to_uppercase().chain(letters).collect())
}

const WIDTH: f64 = 1060.0;
const LEFT: f64 = 400.0;
const RIGHT: f64 = 960.0;
const BAR: f64 = 9.0;
/// Ours and the peer's under each set of flags.
const INKS: [[&str; 2]; 2] = [["#3b78c2", "#6b6f76"], ["#c8681e", "#b3b6bb"]];

/// Bars of every row on a logarithmic axis: ours and below it the peer's, under each set of flags.
pub fn svg(facts: &Facts, columns: &[Column]) -> String {
    let mut body = String::new();
    let mut y = 30.0;
    let write = |body: &mut String, x: f64, y: f64, anchor: &str, text: &str| {
        let _ = writeln!(body, "<text x=\"{x:.1}\" y=\"{y:.1}\" text-anchor=\"{anchor}\">{}</text>", escaped(text));
    };
    for line in heading(facts, columns) {
        write(&mut body, 16.0, y, "start", &line);
        y += 18.0;
    }
    let keys = columns.iter().zip(INKS).flat_map(|(column, inks)| {
        ["ours", "peer"].into_iter().zip(inks).map(|(whose, ink)| (ink, format!("{whose}, {}", column.flags)))
    });
    for (index, (ink, key)) in keys.enumerate() {
        let x = 16.0 + 240.0 * index as f64;
        let _ = writeln!(body, "<rect x=\"{x}\" y=\"{:.1}\" width=\"14\" height=\"{BAR}\" fill=\"{ink}\"/>", y - BAR);
        write(&mut body, x + 20.0, y, "start", &key);
    }
    let rows = &columns[0].report.rows;
    let mut from = 0;
    while let Some(first) = rows.get(from) {
        let length =
            rows[from..].iter().take_while(|row| (&row.group, &row.unit) == (&first.group, &first.unit)).count();
        let indices = from..from + length;
        y += 40.0;
        y = group(&mut body, y, columns, indices);
        from += length;
    }
    let height = y + 20.0;
    format!(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {WIDTH} {height:.0}\" role=\"img\" \
         aria-label=\"Ours beside peers\" font-family=\"system-ui, sans-serif\" font-size=\"12\">\n\
         <rect width=\"100%\" height=\"100%\" fill=\"#fff\"/>\n{body}</svg>\n"
    )
}

/// Bars of the rows of one group and unit, from `y` downward; where they end.
fn group(body: &mut String, mut y: f64, columns: &[Column], rows: std::ops::Range<usize>) -> f64 {
    let of = |column: &Column| column.report.rows.get(rows.clone()).unwrap_or_default().to_vec();
    let all: Vec<Row> = columns.iter().flat_map(of).collect();
    let values = all.iter().flat_map(|row| [row.ours, row.theirs]).filter(|value| *value > 0.0);
    let (low, high) = values.fold((f64::INFINITY, 0.0_f64), |(low, high), value| (low.min(value), high.max(value)));
    let (low, high) = (low.log10().floor(), high.log10().ceil().max(low.log10().floor() + 1.0));
    let place = |value: f64| LEFT + (value.max(1e-9).log10() - low).max(0.0) / (high - low) * (RIGHT - LEFT);
    let top = y;
    let Some(first) = all.first() else { return y };
    let _ = writeln!(
        body,
        "<text x=\"16\" y=\"{y:.1}\" font-size=\"14\" font-weight=\"600\">{}, {}</text>",
        escaped(&capital(&first.group)),
        first.unit
    );
    y += 12.0;
    let mut bars = String::new();
    for index in rows {
        let row = &columns[0].report.rows[index];
        let label = format!("{} | {}", row.what, row.peer);
        let mut bar = |ink: &str, value: f64, note: &str| {
            let width = (place(value) - LEFT).max(1.0);
            let _ = writeln!(
                bars,
                "<rect x=\"{LEFT}\" y=\"{y:.1}\" width=\"{width:.1}\" height=\"{BAR}\" fill=\"{ink}\"/>\n\
                 <text x=\"{:.1}\" y=\"{:.1}\" font-size=\"10\">{}{note}</text>",
                LEFT + width + 4.0,
                y + BAR - 0.5,
                short(value)
            );
            y += BAR + 1.0;
        };
        for (column, [ink, peers_ink]) in columns.iter().zip(INKS) {
            let Some(row) = column.report.rows.get(index) else { continue };
            bar(ink, row.ours, if row.met() == Some(false) { " goal missed" } else { "" });
            bar(peers_ink, row.theirs, "");
        }
        let middle = y - (BAR + 1.0) * columns.len() as f64 + 4.0;
        let _ = writeln!(
            bars,
            "<text x=\"{}\" y=\"{middle:.1}\" text-anchor=\"end\" font-size=\"11\">{}</text>",
            LEFT - 8.0,
            escaped(&label)
        );
        y += 5.0;
    }
    for decade in low as i32..=high as i32 {
        let value = 10f64.powi(decade);
        let x = place(value);
        let _ = writeln!(
            body,
            "<path d=\"M{x:.1} {:.1}V{y:.1}\" stroke=\"#000\" stroke-opacity=\".15\"/>\n\
             <text x=\"{x:.1}\" y=\"{:.1}\" text-anchor=\"middle\" font-size=\"10\">{value}</text>",
            top + 6.0,
            top + 2.0
        );
    }
    body.push_str(&bars);
    y
}

pub fn escaped(text: &str) -> String {
    text.replace('&', "&amp;").replace('<', "&lt;").replace('>', "&gt;")
}

#[cfg(test)]
mod tests {
    use super::*;

    fn column(flags: &'static str) -> Column {
        let row = |group: &str, ours, goal| Row {
            group: group.into(),
            what: "a < b".into(),
            unit: "ms".into(),
            ours,
            peer: "euc".into(),
            theirs: 20.0,
            goal,
        };
        let rows = vec![
            row("pass 1", 2.0, Goal::Faster(8.0)),
            row("pass 1", 30.0, Goal::Within(1.1)),
            row("memory", 1.0, Goal::Free),
        ];
        Column { flags, report: Report { rows, spin: 1.5, instructions: "Avx2".into() } }
    }

    fn facts() -> Facts {
        Facts { processor: "P".into(), rustc: "R".into(), quick: false }
    }

    #[test]
    fn every_row_stands_in_the_table_once_for_each_set_of_flags() {
        let text = markdown(&facts(), &[column("default flags"), column("native")]);
        assert_eq!(text.matches("| a < b | default flags |").count(), 3);
        assert_eq!(text.matches("| a < b | native |").count(), 3);
        assert!(text.contains("| 2.00 | euc | 20.0 | 10.0 times as fast | ≥ 8 times as fast | met |"), "{text}");
        assert!(text.contains("\n2 goals met, 2 missed.\n"), "{text}");
        assert!(text.contains("\n## What holds back the missed ones, native\n\n* a < b, beside euc: "), "{text}");
    }

    #[test]
    fn bars_are_finite_and_names_are_escaped() {
        let text = svg(&facts(), &[column("default flags")]);
        assert!(text.contains("a &lt; b") && !text.contains("NaN") && !text.contains("inf"), "{text}");
        // A ground, two keys, and two bars for each of three rows.
        assert_eq!(text.matches("<rect").count(), 1 + 2 + 6);
        assert_eq!(text.matches("goal missed").count(), 1);
    }
}
