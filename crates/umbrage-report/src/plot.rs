//! Small line and scatter plots as SVG text: the same bytes for the same points.
//!
//! Ink is `currentColor` and the series' colours are custom properties with fallbacks, so that a plot inside the gallery
//! follows its theme and a plot opened alone is readable too.

use crate::text::{escape, proper, short};
use std::fmt::Write;

const WIDTH: f64 = 520.0;
const LEFT: f64 = 72.0;
const RIGHT: f64 = 20.0;
const TOP: f64 = 40.0;
const INNER_HEIGHT: f64 = 280.0;
const BELOW: f64 = 56.0;
const LEGEND_ROW: f64 = 21.0;

/// Mid tones that hold against white and against black alike; told apart without red against green.
const COLOURS: [&str; 6] = ["#3b78c2", "#c8681e", "#2f8f78", "#a14e9b", "#8a7a1f", "#6b6f76"];

/// How an axis is divided.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Scale {
    Linear,
    Log,
}

/// One axis: its label and its division.
#[derive(Clone, Debug)]
pub struct Axis {
    label: String,
    scale: Scale,
}

impl Axis {
    /// Equal steps are equal differences.
    pub fn linear(label: &str) -> Self {
        Self { label: label.into(), scale: Scale::Linear }
    }

    /// Equal steps are equal ratios. Points that are not positive are left out.
    pub fn log(label: &str) -> Self {
        Self { label: label.into(), scale: Scale::Log }
    }

    /// Where a value stands along the axis before it is scaled to the paper; `None` where it cannot stand.
    fn place(&self, value: f64) -> Option<f64> {
        let at = match self.scale {
            Scale::Linear => value,
            Scale::Log => value.log10(),
        };
        at.is_finite().then_some(at)
    }
}

/// Points that belong together.
#[derive(Clone, Debug)]
pub struct Series {
    name: String,
    points: Vec<(f64, f64)>,
    joined: bool,
}

impl Series {
    /// Points joined in their order.
    pub fn line(name: &str, points: Vec<(f64, f64)>) -> Self {
        Self { name: name.into(), points, joined: true }
    }

    /// Points alone.
    pub fn dots(name: &str, points: Vec<(f64, f64)>) -> Self {
        Self { name: name.into(), points, joined: false }
    }

    /// Series whose names differ only behind the last comma ("slope, predicted", "slope, measured") share a colour.
    fn family(&self) -> &str {
        self.name.rsplit_once(',').map_or(&self.name, |(family, _)| family)
    }
}

/// A plot of several series over the same two axes. Points with NaN or ∞ are left out.
#[derive(Clone, Debug)]
pub struct Plot {
    title: String,
    x: Axis,
    y: Axis,
    series: Vec<Series>,
    texels: bool,
}

/// An axis laid on paper: from the values' places to pixels.
struct Span {
    low: f64,
    high: f64,
    from: f64,
    to: f64,
}

impl Span {
    /// Encloses the places with a small margin; places all alike, or none, get a span of their own.
    fn around(places: impl Iterator<Item = f64>, from: f64, to: f64) -> Self {
        let (mut low, mut high) = places.fold((f64::INFINITY, f64::NEG_INFINITY), |(l, h), p| (l.min(p), h.max(p)));
        if low > high {
            (low, high) = (0.0, 1.0);
        }
        let margin = if high > low { (high - low) * 0.04 } else { (low.abs() * 0.1).max(0.5) };
        Self { low: low - margin, high: high + margin, from, to }
    }

    /// Pixels for a difference of 1.
    fn unit(&self) -> f64 {
        (self.to - self.from).abs() / (self.high - self.low)
    }

    /// Reaches further on both sides, until a difference of 1 takes so many pixels.
    fn widen(&mut self, unit: f64) {
        let (middle, half) = (f64::midpoint(self.low, self.high), (self.to - self.from).abs() / unit / 2.0);
        (self.low, self.high) = (middle - half, middle + half);
    }

    fn at(&self, place: f64) -> f64 {
        self.from + (place - self.low) / (self.high - self.low) * (self.to - self.from)
    }

    fn holds(&self, place: f64) -> bool {
        (self.low..=self.high).contains(&place)
    }

    /// Places and labels of the ticks.
    fn ticks(&self, scale: Scale) -> Vec<(f64, String)> {
        match scale {
            Scale::Linear => {
                let step = nice_step((self.high - self.low) / 6.0);
                let first = (self.low / step).ceil() as i64;
                let last = (self.high / step).floor() as i64;
                (first..=last).map(|i| i as f64 * step).map(|value| (value, short(value, 6))).collect()
            }
            Scale::Log => {
                let leads: &[f64] = match self.high - self.low {
                    wide if wide > 3.0 => &[1.0],
                    middle if middle > 1.2 => &[1.0, 3.0],
                    _ => &[1.0, 2.0, 5.0],
                };
                let decades = self.low.floor() as i32..=self.high.ceil() as i32;
                let values = decades.flat_map(|decade| leads.iter().map(move |lead| lead * 10f64.powi(decade)));
                let ticks = values.map(|value| (value.log10(), short(value, 6)));
                ticks.filter(|(place, _)| self.holds(*place)).collect()
            }
        }
    }
}

/// The next of 1, 2 or 5 times a power of ten.
fn nice_step(rough: f64) -> f64 {
    let decade = 10f64.powf(rough.log10().floor());
    let lead = rough / decade;
    decade
        * if lead <= 1.0 {
            1.0
        } else if lead <= 2.0 {
            2.0
        } else if lead <= 5.0 {
            5.0
        } else {
            10.0
        }
}

impl Plot {
    /// An empty plot.
    pub fn new(title: &str, x: Axis, y: Axis) -> Self {
        Self { title: title.into(), x, y, series: Vec::new(), texels: false }
    }

    /// Draws a plane of texels: one unit is as long on either axis, and y grows downward. For linear axes.
    pub fn equal(mut self) -> Self {
        self.texels = true;
        self
    }

    /// Adds a series.
    #[expect(clippy::should_implement_trait, reason = "a builder's step, not a sum")]
    pub fn add(mut self, series: Series) -> Self {
        self.series.push(series);
        self
    }

    /// The points of a series that can stand on both axes, as places.
    fn places<'a>(&'a self, series: &'a Series) -> impl Iterator<Item = (f64, f64)> + 'a {
        series.points.iter().filter_map(|&(x, y)| Some((self.x.place(x)?, self.y.place(y)?)))
    }

    /// The SVG text.
    pub fn svg(&self) -> String {
        let bottom = TOP + INNER_HEIGHT;
        let all = || self.series.iter().flat_map(|series| self.places(series));
        let mut across = Span::around(all().map(|p| p.0), LEFT, WIDTH - RIGHT);
        let mut up = Span::around(all().map(|p| p.1), bottom, TOP);
        if self.texels {
            (up.from, up.to) = (TOP, bottom);
            let unit = across.unit().min(up.unit());
            across.widen(unit);
            up.widen(unit);
        }
        let height = bottom + BELOW + LEGEND_ROW * self.series.len().div_ceil(self.legend_columns()) as f64 + 8.0;
        let mut svg = format!(
            "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {WIDTH} {height}\" role=\"img\" aria-label=\"{0}\" \
             font-family=\"system-ui, sans-serif\" font-size=\"14\" fill=\"currentColor\">\n<title>{0}</title>\n\
             <text x=\"{LEFT}\" y=\"22\" font-size=\"15\" font-weight=\"600\">{0}</text>\n",
            escape(&proper(&self.title))
        );
        self.draw_axes(&mut svg, &across, &up, bottom);
        for series in &self.series {
            self.draw_series(&mut svg, series, &across, &up);
        }
        self.draw_legend(&mut svg, bottom + BELOW);
        svg.push_str("</svg>\n");
        svg
    }

    fn draw_axes(&self, svg: &mut String, across: &Span, up: &Span, bottom: f64) {
        let right = WIDTH - RIGHT;
        svg.push_str("<g stroke=\"currentColor\" stroke-width=\"1\">\n");
        for (place, _) in across.ticks(self.x.scale) {
            let x = pixel(across.at(place));
            let _ = writeln!(svg, "<path d=\"M{x} {TOP}V{bottom}\" opacity=\".13\"/>");
        }
        for (place, _) in up.ticks(self.y.scale) {
            let y = pixel(up.at(place));
            let _ = writeln!(svg, "<path d=\"M{LEFT} {y}H{right}\" opacity=\".13\"/>");
        }
        let _ = writeln!(svg, "<path d=\"M{LEFT} {TOP}V{bottom}H{right}\" fill=\"none\" opacity=\".6\"/>\n</g>");
        for (place, label) in across.ticks(self.x.scale) {
            let x = pixel(across.at(place));
            let _ = writeln!(svg, "<text x=\"{x}\" y=\"{}\" text-anchor=\"middle\">{label}</text>", bottom + 18.0);
        }
        for (place, label) in up.ticks(self.y.scale) {
            let y = pixel(up.at(place) + 4.5);
            let _ = writeln!(svg, "<text x=\"{}\" y=\"{y}\" text-anchor=\"end\">{label}</text>", LEFT - 8.0);
        }
        let (middle, centre) = (f64::midpoint(LEFT, right), f64::midpoint(TOP, bottom));
        let _ = writeln!(
            svg,
            "<text x=\"{middle}\" y=\"{}\" text-anchor=\"middle\">{}</text>\n\
             <text transform=\"translate(16 {centre}) rotate(-90)\" text-anchor=\"middle\">{}</text>",
            bottom + 40.0,
            escape(&proper(&self.x.label)),
            escape(&proper(&self.y.label))
        );
    }

    fn colour(&self, series: &Series) -> String {
        ink(self.family(series) % COLOURS.len())
    }

    /// Families beyond the number of colours begin again, dashed.
    fn dash(&self, series: &Series) -> &'static str {
        if self.family(series) >= COLOURS.len() { " stroke-dasharray=\"6 3\"" } else { "" }
    }

    /// The number of a series' family, in the order of their first series.
    fn family(&self, series: &Series) -> usize {
        let mut families: Vec<&str> = Vec::new();
        for family in self.series.iter().map(Series::family) {
            if !families.contains(&family) {
                families.push(family);
            }
        }
        families.iter().position(|family| *family == series.family()).unwrap_or(0)
    }

    fn draw_series(&self, svg: &mut String, series: &Series, across: &Span, up: &Span) {
        const MOST_MARKED: usize = 24;
        let points: Vec<(f64, f64)> = self.places(series).map(|(x, y)| (across.at(x), up.at(y))).collect();
        let _ = writeln!(svg, "<g style=\"color:{}\">", self.colour(series));
        if series.joined && !points.is_empty() {
            let corners: Vec<String> = points.iter().map(|&(x, y)| format!("{} {}", pixel(x), pixel(y))).collect();
            let path = corners.join("L");
            let style = "fill=\"none\" stroke=\"currentColor\" stroke-width=\"1.8\" stroke-linejoin=\"round\"";
            let _ = writeln!(svg, "<path d=\"M{path}\" {style}{}/>", self.dash(series));
        }
        if !series.joined || points.len() <= MOST_MARKED {
            let radius = if points.len() > 60 { 1.8 } else { 3.0 };
            for (x, y) in points {
                let _ = writeln!(svg, "<circle cx=\"{}\" cy=\"{}\" r=\"{radius}\"/>", pixel(x), pixel(y));
            }
        }
        svg.push_str("</g>\n");
    }

    /// Two where the names are short enough to stand side by side.
    fn legend_columns(&self) -> usize {
        const SHORT: usize = 25;
        if self.series.iter().all(|series| series.name.chars().count() <= SHORT) { 2 } else { 1 }
    }

    fn draw_legend(&self, svg: &mut String, top: f64) {
        let columns = self.legend_columns();
        for (index, series) in self.series.iter().enumerate() {
            let x = LEFT + (index % columns) as f64 * (WIDTH - LEFT - RIGHT) / columns as f64;
            let y = top + (index / columns) as f64 * LEGEND_ROW + 8.0;
            let mark = if series.joined {
                format!("<path d=\"M{x} {y}h18\" stroke=\"currentColor\" stroke-width=\"2.4\"{}/>", self.dash(series))
            } else {
                format!("<circle cx=\"{}\" cy=\"{y}\" r=\"3\"/>", x + 9.0)
            };
            let _ = writeln!(
                svg,
                "<g style=\"color:{}\">{mark}</g><text x=\"{}\" y=\"{}\">{}</text>",
                self.colour(series),
                x + 25.0,
                y + 4.5,
                escape(&proper(&series.name))
            );
        }
    }
}

/// The colour of a series: the theme's own, and one for a drawing that is opened alone.
pub(crate) fn ink(index: usize) -> String {
    format!("var(--series-{}, {})", index + 1, COLOURS[index])
}

/// A coordinate with two digits at most.
pub(crate) fn pixel(value: f64) -> String {
    let text = format!("{value:.2}");
    let text = text.trim_end_matches('0').trim_end_matches('.');
    if text == "-0" { "0".into() } else { text.into() }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn points_that_cannot_stand_on_an_axis_are_left_out() {
        let points = vec![(1.0, 0.0), (10.0, f64::NAN), (100.0, 0.1), (1000.0, f64::INFINITY), (-1.0, 0.3)];
        let svg = Plot::new("t", Axis::log("x"), Axis::linear("y")).add(Series::dots("s", points)).svg();
        // Two points and the legend's mark.
        assert_eq!(svg.matches("<circle").count(), 3);
        assert!(!svg.contains("NaN") && !svg.contains("inf"), "{svg}");
    }

    #[test]
    fn a_plot_without_points_or_with_one_has_axes() {
        for points in [vec![], vec![(3.0, 3.0)], vec![(0.0, 0.0)]] {
            let svg = Plot::new("t", Axis::linear("x"), Axis::log("y")).add(Series::line("s", points)).svg();
            assert!(!svg.contains("NaN") && !svg.contains("inf"), "{svg}");
        }
    }

    #[test]
    fn linear_ticks_are_round_numbers_inside_the_span() {
        let span = Span::around([0.0, 0.8].into_iter(), 0.0, 1.0);
        let labels: Vec<String> = span.ticks(Scale::Linear).into_iter().map(|tick| tick.1).collect();
        assert_eq!(labels, ["0", "0.2", "0.4", "0.6", "0.8"]);
    }

    #[test]
    fn log_ticks_follow_the_decades() {
        let span = Span::around([4.0f64, 256.0].map(f64::log10).into_iter(), 0.0, 1.0);
        let labels: Vec<String> = span.ticks(Scale::Log).into_iter().map(|tick| tick.1).collect();
        assert_eq!(labels, ["10", "30", "100", "300"]);
    }

    #[test]
    fn a_plane_of_texels_keeps_squares_square_and_rows_downward() {
        let corners = vec![(0.0, 0.0), (10.0, 10.0)];
        let svg = Plot::new("t", Axis::linear("x"), Axis::linear("y")).equal().add(Series::line("s", corners)).svg();
        let path = svg.split("<path d=\"M").find(|path| path.contains("stroke-width=\"1.8\"")).unwrap();
        let numbers: Vec<f64> =
            path.split('"').next().unwrap().split([' ', 'L']).map(|number| number.parse().unwrap()).collect();
        assert!(numbers[3] > numbers[1], "{numbers:?}");
        assert!((numbers[2] - numbers[0] - (numbers[3] - numbers[1])).abs() < 0.02, "{numbers:?}");
    }

    #[test]
    fn names_are_escaped_and_families_share_a_colour() {
        let plot = Plot::new("a < b", Axis::linear("x & y"), Axis::linear("\"z\""))
            .add(Series::line("slope, predicted", vec![(0.0, 0.0)]))
            .add(Series::dots("slope, measured", vec![(0.0, 0.0)]))
            .add(Series::dots("<other>", vec![(0.0, 0.0)]));
        let svg = plot.svg();
        assert!(svg.contains("a &lt; b") && svg.contains("x &amp; y") && svg.contains("&lt;other&gt;"), "{svg}");
        assert_eq!(plot.colour(&plot.series[0]), plot.colour(&plot.series[1]));
        assert_ne!(plot.colour(&plot.series[0]), plot.colour(&plot.series[2]));
    }
}
