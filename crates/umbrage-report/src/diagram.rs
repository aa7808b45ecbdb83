//! Diagrams of slices through a scene as SVG text: shapes in world coordinates, one unit as long across as up, y upward.
//!
//! Inks and themes are those of [`plot`]: `currentColor` and the series' custom properties.

use crate::plot::{self, pixel};
use crate::text::{escape, proper};
use glam::DVec2;
use std::fmt::Write;

const WIDTH: f64 = 640.0;
const MARGIN: f64 = 10.0;
const TOP: f64 = 34.0;
const KEY_ROW: f64 = 21.0;

/// What a shape is drawn with.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Ink {
    /// The text's colour.
    Plain,
    /// The same, weak: what only helps to read the rest.
    Faint,
    /// One of the six colours of series, from 0.
    Series(usize),
}

impl Ink {
    /// Colour and opacity as style.
    fn style(self) -> String {
        match self {
            Self::Plain => "color:currentColor".into(),
            Self::Faint => "color:currentColor;opacity:.38".into(),
            Self::Series(index) => format!("color:{}", plot::ink(index)),
        }
    }
}

/// How a key's row, and a shape, looks.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Mark {
    /// A line of a width in pixels.
    Line(f64),
    /// A dashed thin line.
    Dashes,
    /// Full dots of a radius in pixels.
    Dots(f64),
    /// Hollow dots of a radius in pixels.
    Rings(f64),
    /// A filled area with an outline.
    Area,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Anchor {
    Start,
    Middle,
    End,
}

/// A drawing under way.
#[derive(Clone, Debug)]
pub struct Diagram {
    title: String,
    low: DVec2,
    high: DVec2,
    body: String,
    keys: Vec<(Mark, Ink, String)>,
}

impl Diagram {
    /// An empty drawing of the world between two corners.
    pub fn new(title: &str, low: DVec2, high: DVec2) -> Self {
        Self { title: title.into(), low, high, body: String::new(), keys: Vec::new() }
    }

    /// Adds points as a mark: joined for lines and areas, alone for dots and rings. Those that are not finite are left out, and break lines.
    pub fn draw(mut self, mark: Mark, ink: Ink, points: &[DVec2]) -> Self {
        let style = ink.style();
        let _ = writeln!(self.body, "<g style=\"{style}\">");
        match mark {
            Mark::Line(width) => self.path(points, &stroke(width)),
            Mark::Dashes => self.path(points, &format!("{} stroke-dasharray=\"5 4\"", stroke(1.2))),
            Mark::Area => {
                let path = self.joined(points);
                let _ = writeln!(
                    self.body,
                    "<path d=\"{path}Z\" fill=\"currentColor\" fill-opacity=\".13\" stroke=\"currentColor\" stroke-width=\"1.2\" stroke-opacity=\".55\" stroke-linejoin=\"round\"/>"
                );
            }
            Mark::Dots(radius) => self.circles(points, radius, ""),
            Mark::Rings(radius) => {
                self.circles(points, radius, " fill=\"none\" stroke=\"currentColor\" stroke-width=\"1.5\"");
            }
        }
        self.body.push_str("</g>\n");
        self
    }

    /// Adds many separate pieces of line.
    pub fn pieces(mut self, width: f64, ink: Ink, pieces: impl IntoIterator<Item = [DVec2; 2]>) -> Self {
        let paths: String = pieces.into_iter().map(|piece| self.joined(&piece)).collect();
        if !paths.is_empty() {
            let _ = writeln!(self.body, "<g style=\"{}\"><path d=\"{paths}\" {}/></g>", ink.style(), stroke(width));
        }
        self
    }

    /// Adds a straight arrow.
    pub fn arrow(self, ink: Ink, from: DVec2, to: DVec2) -> Self {
        let unit = 1.0 / self.scale();
        let along = (to - from).normalize_or_zero() * unit;
        let barb = |turn: f64| to - along.rotate(DVec2::from_angle(turn)) * 10.0;
        self.draw(Mark::Line(1.8), ink, &[from, to]).draw(Mark::Line(1.8), ink, &[barb(0.42), to, barb(-0.42)])
    }

    /// Adds text whose middle stands at a place.
    pub fn text(self, ink: Ink, at: DVec2, text: &str) -> Self {
        self.write(ink, at, text, Anchor::Middle)
    }

    /// Adds text that begins at a place.
    pub fn text_from(self, ink: Ink, at: DVec2, text: &str) -> Self {
        self.write(ink, at, text, Anchor::Start)
    }

    /// Adds text that ends at a place.
    pub fn text_to(self, ink: Ink, at: DVec2, text: &str) -> Self {
        self.write(ink, at, text, Anchor::End)
    }

    fn write(mut self, ink: Ink, at: DVec2, text: &str, anchor: Anchor) -> Self {
        let at = self.place(at);
        let anchor = match anchor {
            Anchor::Start => "start",
            Anchor::Middle => "middle",
            Anchor::End => "end",
        };
        let _ = writeln!(
            self.body,
            "<text style=\"{}\" fill=\"currentColor\" x=\"{}\" y=\"{}\" text-anchor=\"{anchor}\">{}</text>",
            ink.style(),
            pixel(at.x),
            pixel(at.y + 4.5),
            escape(&proper(text))
        );
        self
    }

    /// Says below the drawing what a mark means.
    pub fn key(mut self, mark: Mark, ink: Ink, name: &str) -> Self {
        self.keys.push((mark, ink, name.into()));
        self
    }

    /// [`Diagram::draw`] and [`Diagram::key`] together.
    pub fn named(self, mark: Mark, ink: Ink, points: &[DVec2], name: &str) -> Self {
        self.draw(mark, ink, points).key(mark, ink, name)
    }

    /// The SVG text.
    pub fn svg(&self) -> String {
        let (inner, down) = (WIDTH - 2.0 * MARGIN, self.height());
        let columns = if self.keys.iter().all(|key| key.2.chars().count() <= 36) { 2 } else { 1 };
        let below = TOP + down + 18.0;
        let height = below + KEY_ROW * self.keys.len().div_ceil(columns) as f64;
        // The inner drawing cuts off what reaches out of it.
        let mut svg = format!(
            "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {WIDTH} {}\" role=\"img\" aria-label=\"{1}\" \
             font-family=\"system-ui, sans-serif\" font-size=\"14\" fill=\"currentColor\">\n<title>{1}</title>\n\
             <text x=\"{MARGIN}\" y=\"22\" font-size=\"15\" font-weight=\"600\">{1}</text>\n\
             <svg x=\"{MARGIN}\" y=\"{TOP}\" width=\"{inner}\" height=\"{2}\" viewBox=\"0 0 {inner} {2}\" overflow=\"hidden\">\n",
            pixel(height),
            escape(&proper(&self.title)),
            pixel(down),
        );
        svg.push_str(&self.body);
        svg.push_str("</svg>\n");
        for (index, (mark, ink, name)) in self.keys.iter().enumerate() {
            let x = MARGIN + (index % columns) as f64 * inner / columns as f64;
            let y = below + (index / columns) as f64 * KEY_ROW;
            let _ = writeln!(
                svg,
                "<g style=\"{}\">{}</g><text x=\"{}\" y=\"{}\">{}</text>",
                ink.style(),
                sample(*mark, x, y),
                pixel(x + 28.0),
                pixel(y + 4.5),
                escape(&proper(name))
            );
        }
        svg.push_str("</svg>\n");
        svg
    }

    /// Pixels for a world unit.
    pub fn scale(&self) -> f64 {
        (WIDTH - 2.0 * MARGIN) / (self.high.x - self.low.x)
    }

    fn height(&self) -> f64 {
        (self.high.y - self.low.y) * self.scale()
    }

    fn place(&self, at: DVec2) -> DVec2 {
        DVec2::new(at.x - self.low.x, self.high.y - at.y) * self.scale()
    }

    fn path(&mut self, points: &[DVec2], stroke: &str) {
        let path = self.joined(points);
        let _ = writeln!(self.body, "<path d=\"{path}\" {stroke}/>");
    }

    fn joined(&self, points: &[DVec2]) -> String {
        let mut path = String::new();
        let mut command = 'M';
        for &point in points {
            if point.is_finite() {
                let at = self.place(point);
                let _ = write!(path, "{command}{} {}", pixel(at.x), pixel(at.y));
                command = 'L';
            } else {
                command = 'M';
            }
        }
        path
    }

    fn circles(&mut self, points: &[DVec2], radius: f64, style: &str) {
        for &point in points.iter().filter(|point| point.is_finite()) {
            let at = self.place(point);
            let _ = writeln!(
                self.body,
                "<circle cx=\"{}\" cy=\"{}\" r=\"{}\"{style}/>",
                pixel(at.x),
                pixel(at.y),
                pixel(radius)
            );
        }
    }
}

fn stroke(width: f64) -> String {
    format!("fill=\"none\" stroke=\"currentColor\" stroke-width=\"{}\" stroke-linejoin=\"round\"", pixel(width))
}

/// A mark as a key shows it.
fn sample(mark: Mark, x: f64, y: f64) -> String {
    let (x, y, middle) = (pixel(x), pixel(y), pixel(x + 10.0));
    match mark {
        Mark::Line(width) => format!("<path d=\"M{x} {y}h20\" {}/>", stroke(width)),
        Mark::Dashes => format!("<path d=\"M{x} {y}h20\" {} stroke-dasharray=\"5 4\"/>", stroke(1.2)),
        Mark::Dots(radius) => format!("<circle cx=\"{middle}\" cy=\"{y}\" r=\"{}\"/>", pixel(radius)),
        Mark::Rings(radius) => {
            format!("<circle cx=\"{middle}\" cy=\"{y}\" r=\"{}\" {}/>", pixel(radius), stroke(1.5))
        }
        Mark::Area => format!(
            "<path d=\"M{x} {y}m0 -6h20v12h-20z\" fill=\"currentColor\" fill-opacity=\".13\" stroke=\"currentColor\" stroke-opacity=\".55\"/>"
        ),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn up_is_up_and_what_is_not_finite_breaks_a_line() {
        let points = [DVec2::ZERO, DVec2::ONE, DVec2::NAN, DVec2::new(2.0, 2.0), DVec2::new(2.0, 0.0)];
        let svg = Diagram::new("t", DVec2::ZERO, DVec2::splat(2.0)).draw(Mark::Line(1.0), Ink::Plain, &points).svg();
        assert!(svg.contains("M0 620L310 310M620 0L620 620"), "{svg}");
        assert!(!svg.contains("NaN"), "{svg}");
    }

    #[test]
    fn text_and_keys_are_escaped() {
        let svg = Diagram::new("a < b", DVec2::ZERO, DVec2::ONE)
            .text(Ink::Plain, DVec2::ZERO, "x & y")
            .key(Mark::Dots(3.0), Ink::Series(0), "\"z\"")
            .svg();
        assert!(svg.contains("a &lt; b") && svg.contains("x &amp; y") && svg.contains("&quot;z&quot;"), "{svg}");
    }
}
