//! How time and memory grow, as a table and as curves on logarithmic axes.

use super::page::{Facts, escaped, short};
use anyhow::{Context as _, bail, ensure};
use std::fmt::Write;

/// All that one run printed.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Scale {
    pub points: Vec<Point>,
    /// Threads that the machine has.
    pub threads: u32,
}

/// One quantity of one size of a series.
#[derive(Clone, Debug, PartialEq)]
pub struct Point {
    pub series: String,
    pub size: f64,
    pub what: String,
    pub unit: String,
    pub value: f64,
}

/// What is known of a series beside its points.
struct Axis {
    name: &'static str,
    title: &'static str,
    /// Whether sizes are sides of squares.
    square: bool,
}

const AXES: [Axis; 3] = [
    Axis { name: "triangles", title: "triangles streamed into a map of 1024²", square: false },
    Axis { name: "maps", title: "texels of a map of the bicycle shop", square: true },
    Axis { name: "pictures", title: "pixels of a picture of the bicycle shop", square: true },
];

impl Axis {
    /// Where a size stands on the axis: what time is proportional to where nothing else counts.
    fn along(&self, size: f64) -> f64 {
        if self.square { size * size } else { size }
    }

    fn label(&self, size: f64) -> String {
        match size.log10() {
            _ if self.square => format!("{size}²"),
            // A power of ten, whose exponent is one digit.
            decade => format!(
                "10{}",
                ["⁰", "¹", "²", "³", "⁴", "⁵", "⁶", "⁷", "⁸", "⁹"][decade.round().clamp(0.0, 9.0) as usize]
            ),
        }
    }
}

impl Scale {
    /// From what the program printed: lines of fields between tabs.
    pub fn parse(text: &str) -> anyhow::Result<Self> {
        let mut scale = Self::default();
        for line in text.lines() {
            scale.line(line).with_context(|| format!("a line of the program's: {line:?}"))?;
        }
        ensure!(!scale.points.is_empty(), "the program printed no point");
        Ok(scale)
    }

    fn line(&mut self, line: &str) -> anyhow::Result<()> {
        match line.split('\t').collect::<Vec<_>>().as_slice() {
            ["fact", "threads", value] => self.threads = value.parse()?,
            ["point", series, size, what, unit, value] => self.points.push(Point {
                series: (*series).into(),
                size: size.parse()?,
                what: (*what).into(),
                unit: (*unit).into(),
                value: value.parse()?,
            }),
            _ => bail!("it is neither a point nor a fact"),
        }
        Ok(())
    }

    /// What is measured in a unit, each with its points by size.
    fn curves(&self, series: &str, seconds: bool) -> Vec<(&str, Vec<(f64, f64)>)> {
        let mut curves: Vec<(&str, Vec<(f64, f64)>)> = Vec::new();
        for point in self.points.iter().filter(|point| point.series == series && (point.unit == "s") == seconds) {
            match curves.iter_mut().find(|(what, _)| *what == point.what) {
                Some((_, points)) => points.push((point.size, point.value)),
                None => curves.push((&point.what, vec![(point.size, point.value)])),
            }
        }
        curves
    }

    fn heading(&self, facts: &Facts) -> Vec<String> {
        let mut lines = vec![
            format!("Processor: {}. Compiler: {}. {} threads.", facts.processor, facts.rustc, self.threads),
            "Wall time and the most memory held at once, each point once in a process of its own; default flags."
                .into(),
        ];
        if facts.quick {
            lines.push("A quick run of small sizes: its numbers mean nothing.".into());
        }
        lines
    }
}

/// The table.
pub fn markdown(facts: &Facts, scale: &Scale) -> String {
    let mut text = String::from("# How time and memory grow\n\n");
    for line in scale.heading(facts) {
        let _ = writeln!(text, "* {line}");
    }
    for axis in &AXES {
        let curves = [scale.curves(axis.name, true), scale.curves(axis.name, false)].concat();
        let Some((_, sizes)) = curves.first() else { continue };
        let _ = write!(text, "\n## By {}\n\n| |", axis.title);
        for (what, _) in &curves {
            let unit = scale.points.iter().find(|point| point.what == *what).map_or("", |point| &point.unit);
            let _ = write!(text, " {what}, {unit} |");
        }
        let _ = writeln!(text, "\n|---|{}", "---|".repeat(curves.len()));
        for (row, (size, _)) in sizes.iter().enumerate() {
            let _ = write!(text, "| {} |", axis.label(*size));
            for (_, points) in &curves {
                let _ = write!(text, " {} |", points.get(row).map_or(String::new(), |(_, value)| short(*value)));
            }
            text.push('\n');
        }
    }
    text
}

const PANEL: (f64, f64) = (330.0, 250.0);
const GAP: (f64, f64) = (70.0, 80.0);
const TOP: f64 = 100.0;
const INKS: [&str; 3] = ["#3b78c2", "#c8681e", "#2f8f5b"];

/// Two rows of panels: time above, memory below.
pub fn svg(facts: &Facts, scale: &Scale) -> String {
    let mut body = String::new();
    for (row, line) in (0u8..).zip(scale.heading(facts)) {
        let _ = writeln!(body, "<text x=\"16\" y=\"{}\">{}</text>", 26.0 + 18.0 * f64::from(row), escaped(&line));
    }
    let _ = writeln!(body, "<text x=\"16\" y=\"{TOP}\" fill=\"#666\">Dashed: proportional to the axis.</text>");
    for (column, axis) in (0u8..).zip(&AXES) {
        for (row, seconds) in [(0.0, true), (1.0, false)] {
            let x = GAP.0 + f64::from(column) * (PANEL.0 + GAP.0);
            let y = TOP + 40.0 + row * (PANEL.1 + GAP.1);
            panel(&mut body, (x, y), axis, if seconds { "s" } else { "MiB" }, &scale.curves(axis.name, seconds));
        }
    }
    let width = GAP.0 + 3.0 * (PANEL.0 + GAP.0);
    let height = TOP + 40.0 + 2.0 * (PANEL.1 + GAP.1);
    format!(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {width} {height}\" role=\"img\" \
         aria-label=\"How time and memory grow\" font-family=\"system-ui, sans-serif\" font-size=\"12\">\n\
         <rect width=\"100%\" height=\"100%\" fill=\"#fff\"/>\n{body}</svg>\n"
    )
}

/// Decades around values, the lower one and the upper one, never the same.
fn decades(values: impl Iterator<Item = f64>) -> (f64, f64) {
    let (low, high) = values.fold((f64::INFINITY, 0.0_f64), |(low, high), value| (low.min(value), high.max(value)));
    let low = low.max(1e-6).log10().floor();
    (low, high.max(1e-6).log10().ceil().max(low + 1.0))
}

/// Curves on logarithmic axes, the upper left at a place.
fn panel(body: &mut String, (left, top): (f64, f64), axis: &Axis, unit: &str, curves: &[(&str, Vec<(f64, f64)>)]) {
    let sizes: Vec<f64> =
        curves.first().map_or(Vec::new(), |(_, points)| points.iter().map(|(size, _)| *size).collect());
    let (Some(first), Some(last)) = (sizes.first(), sizes.last()) else { return };
    let (from, to) = (axis.along(*first).log10(), axis.along(*last).log10());
    let (low, high) = decades(curves.iter().flat_map(|(_, points)| points.iter().map(|(_, value)| *value)));
    let x = |size: f64| left + (axis.along(size).log10() - from) / (to - from).max(1e-9) * PANEL.0;
    let y = |value: f64| top + PANEL.1 - (value.max(1e-6).log10() - low) / (high - low) * PANEL.1;
    let title = format!("{unit}, by {}", axis.title);
    let _ = writeln!(body, "<text x=\"{left}\" y=\"{:.1}\" font-weight=\"600\">{}</text>", top - 12.0, escaped(&title));
    for decade in low as i32..=high as i32 {
        let value = 10f64.powi(decade);
        let _ = writeln!(
            body,
            "<path d=\"M{left} {0:.1}h{1}\" stroke=\"#000\" stroke-opacity=\".15\"/>\n\
             <text x=\"{2:.1}\" y=\"{3:.1}\" text-anchor=\"end\" font-size=\"10\">{value}</text>",
            y(value),
            PANEL.0,
            left - 5.0,
            y(value) + 3.0
        );
    }
    for size in &sizes {
        let _ = writeln!(
            body,
            "<path d=\"M{0:.1} {top}v{1}\" stroke=\"#000\" stroke-opacity=\".08\"/>\n\
             <text x=\"{0:.1}\" y=\"{2:.1}\" text-anchor=\"middle\" font-size=\"10\">{3}</text>",
            x(*size),
            PANEL.1,
            top + PANEL.1 + 14.0,
            axis.label(*size)
        );
    }
    for (index, ((what, points), ink)) in curves.iter().zip(INKS).enumerate() {
        let line: Vec<String> =
            points.iter().map(|(size, value)| format!("{:.1},{:.1}", x(*size), y(*value))).collect();
        let _ = writeln!(
            body,
            "<polyline points=\"{}\" fill=\"none\" stroke=\"{ink}\" stroke-width=\"2\"/>",
            line.join(" ")
        );
        for (size, value) in points {
            let _ = writeln!(body, "<circle cx=\"{:.1}\" cy=\"{:.1}\" r=\"3\" fill=\"{ink}\"/>", x(*size), y(*value));
        }
        let (x, y) = (left + 10.0, top + 18.0 + 16.0 * index as f64);
        let _ = writeln!(body, "<text x=\"{x:.1}\" y=\"{y:.1}\" fill=\"{ink}\">{}</text>", escaped(what));
    }
    // Through the last point of the first curve, as far down as the panel reaches.
    if let Some(value) = curves.first().and_then(|(_, points)| points.last()).map(|(_, value)| *value) {
        let decades = (value.log10() - low).min(to - from).max(0.0);
        let start = (left + (to - from - decades) / (to - from).max(1e-9) * PANEL.0, y(value / 10f64.powf(decades)));
        let _ = writeln!(
            body,
            "<path d=\"M{:.1} {:.1}L{:.1} {:.1}\" stroke=\"#666\" stroke-dasharray=\"4 4\" fill=\"none\"/>",
            start.0,
            start.1,
            x(*last),
            y(value)
        );
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const TEXT: &str = "point\ttriangles\t1000\tbake\ts\t0.01\npoint\ttriangles\t1000\tpeak memory\tMiB\t10\n\
                        point\ttriangles\t10000\tbake\ts\t0.1\npoint\ttriangles\t10000\tpeak memory\tMiB\t20\n\
                        point\tmaps\t256\tbake to disk\ts\t0.5\npoint\tmaps\t256\tfile\tMiB\t0.3\nfact\tthreads\t2\n";

    fn facts() -> Facts {
        Facts { processor: "P".into(), rustc: "R".into(), quick: false }
    }

    #[test]
    fn each_size_is_a_row_and_each_quantity_a_column() {
        let text = markdown(&facts(), &Scale::parse(TEXT).unwrap());
        assert!(
            text.contains(
                "| | bake, s | peak memory, MiB |\n|---|---|---|\n| 10³ | 0.010 | 10.0 |\n| 10⁴ | 0.100 | 20.0 |\n"
            ),
            "{text}"
        );
        assert!(text.contains("| 256² | 0.500 | 0.300 |\n"), "{text}");
    }

    #[test]
    fn curves_are_finite_with_any_number_of_points() {
        let text = svg(&facts(), &Scale::parse(TEXT).unwrap());
        assert!(!text.contains("NaN") && !text.contains("inf"), "{text}");
        // Four quantities.
        assert_eq!((text.matches("<polyline").count(), text.matches("<circle").count()), (4, 6));
    }

    #[test]
    fn what_is_no_point_is_refused() {
        for text in ["", "point\tmaps", "fact\tthreads\tmany", "point\tmaps\tbig\tfile\tMiB\t1", "row\ta"] {
            assert!(Scale::parse(text).is_err(), "{text:?}");
        }
    }
}
